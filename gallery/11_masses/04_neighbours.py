"""
Resonance of two neighbours
===========================

Two frames of one storey pound each other. Where the forward sweep and the backward sweep differ,
one of them has contacts and the other has none (hatched). The branches show how the two motions
connect.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import mass_branches, mass_resonance

neighbours = vi.Assembly(
    masses={"west": "200 t", "east": "250 t"},
    links={
        "frame_west": vi.Link("ground", "west", vi.Isolator("30 MN/m", "0.2 MN s/m")),
        "frame_east": vi.Link("ground", "east", vi.Isolator("90 MN/m", "0.4 MN s/m")),
    },
    stops={"pounding": vi.Link("west", "east", vi.Bumper("500 MN/m", "2 MN s/m", "2 cm"))},
)
rig = vi.Rig(neighbours, "0.1 g")
swept = vi.sweep(rig, np.linspace(1.5, 4.0, 126))
mass_resonance(swept)

# %%
mass_resonance(swept, quantity="peak_force")

# %%
branch = vi.branch(rig, vary={"frequency": (1.5, 4.0)}, frequency=1.5)
mass_branches(branch, sweep=swept)
