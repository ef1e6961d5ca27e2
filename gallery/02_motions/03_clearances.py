"""
What opens and closes
=====================

The distance of the mass from each bumper. Below, magnified: when the mass leaves, the bumper is
still deformed and comes back behind it, so that the clearance begins to open with no speed at
all. That is why a sign test at fixed steps sees contacts that are none, or misses those that are.
"""

import vibroimpact as vi
from vibroimpact.figures import clearances

case = vi.laboratory.case("B3-10mm-A3")
motion = vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, "1.12 Hz")), samples=2048)
clearances(motion)
