"""
Hysteresis cycle: where the energy goes
=======================================

Absolute acceleration over displacement. Times the mass, the acceleration is the force on it, and
the area of the cycle is the energy that isolator and bumpers dissipate in one period. The spikes
are the bumpers.
"""

import vibroimpact as vi
from vibroimpact.figures import hysteresis_cycle

case = vi.laboratory.case("B2-G1-A3")
found = vi.coexisting_motions(case, frequency="2 Hz")
first, second = (
    vi.steady(case, found.isel(attractor=number), frequency="2 Hz", samples=1024)
    for number in (0, 1)
)
hysteresis_cycle({"forward": first, "backward": second})
