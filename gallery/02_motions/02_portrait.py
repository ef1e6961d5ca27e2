"""
Velocity over displacement
==========================

A steady motion is a closed curve. Diamonds are the points of the stroboscopic section, one a
cycle; dashed lines are the bumpers at rest. Beyond them the curve is pressed flat.
"""

import vibroimpact as vi
from vibroimpact.figures import phase_portrait

case = vi.laboratory.case("B2-G1-A3")
first, second = vi.coexisting_motions(
    vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, "2 Hz")), samples=1024
)
phase_portrait({"forward": first, "backward": second})
