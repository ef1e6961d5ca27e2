"""
Phase portrait
==============

A phase portrait shows the velocity over the displacement. A steady periodic motion is a closed
curve. Diamonds mark the state at a fixed phase of the forcing, once per cycle (stroboscopic
section). Dashed lines are the undeformed bumpers. Beyond these lines, the curve is flattened,
because the bumper stops the mass.
"""

import vibroimpact as vi
from vibroimpact.figures import phase_portrait

case = vi.laboratory.case("B2-G1-A3")
found = vi.coexisting_motions(case, frequency="2 Hz")
first, second = (
    vi.steady(case, found.isel(attractor=number), frequency="2 Hz", samples=1024)
    for number in (0, 1)
)
phase_portrait({"forward": first, "backward": second})
