"""
Clearances: how a contact begins and ends
=========================================

The clearance is the distance between the mass and a bumper. The lower panel magnifies a detachment.
When the mass leaves, the bumper is still deformed and follows the mass. The clearance therefore
opens with zero speed. For this reason, it is not reliable to detect contacts by the sign of the
clearance at fixed time steps. Such a method detects contacts that do not exist, and misses contacts
that do exist.
"""

import vibroimpact as vi
from vibroimpact.figures import clearances

motion = vi.steady("B3-10mm-A3", samples=2048, frequency="1.12 Hz")
clearances(motion)
