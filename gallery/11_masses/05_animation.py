"""
An animation for a talk
=======================

``save_animation`` writes the motion of an assembly as a GIF file, or as an HTML page with a slider.
The gaps, the displacements and the deformations of the stops have one scale: the bodies meet on
the screen when they meet in the motion. The picture shows the masses at rest.
"""

import tempfile
from pathlib import Path

import vibroimpact as vi
from vibroimpact.figures import assembly_drawing, save_animation

neighbours = vi.Assembly(
    masses={"west": "200 t", "east": "250 t"},
    links={
        "frame_west": vi.Link("ground", "west", vi.Isolator("30 MN/m", "0.2 MN s/m")),
        "frame_east": vi.Link("ground", "east", vi.Isolator("90 MN/m", "0.4 MN s/m")),
    },
    stops={"pounding": vi.Link("west", "east", vi.Bumper("500 MN/m", "2 MN s/m", "2 cm"))},
)
motion = vi.simulate(vi.Rig(neighbours, vi.Harmonic("0.1 g", "1.9 Hz")), 10)
folder = Path(tempfile.mkdtemp())  # such as the folder of the slides
save_animation(motion, folder / "neighbours.html", title="Pounding neighbours", duration=20)
assembly_drawing(neighbours)
