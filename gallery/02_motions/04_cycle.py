"""
Hysteresis cycle: where the energy goes
=======================================

Absolute acceleration over displacement. Times the mass, the acceleration is the force on it, and
the area of the cycle is the energy that isolator and bumpers dissipate in one period. The spikes
are the bumpers.
"""

import vibroimpact as vi
from vibroimpact.figures import hysteresis_cycle

first, second = vi.coexisting_motions("B2-G1-A3", frequency="2 Hz", samples=1024)
hysteresis_cycle({"forward": first, "backward": second})
