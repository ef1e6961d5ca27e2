"""
Clearances: how a contact begins and ends
=========================================

The distance of the mass from each bumper. The lower panel magnifies a detachment: when the mass
leaves, the bumper is still deformed and follows it, so that the clearance opens with zero speed.
A sign test at fixed time steps therefore detects contacts that do not exist and misses some that
do.
"""

import vibroimpact as vi
from vibroimpact.figures import clearances

motion = vi.steady("B3-10mm-A3", samples=2048, frequency="1.12 Hz")
clearances(motion)
