"""
A motion on one page
====================

This figure shows three motions of one rig (a mass between two bumpers): a periodic motion, a motion
with twice the period, and a chaotic motion. For each motion, it shows the phase portrait, the
spectrum and the time history. The line below each heading states the type of the motion.
"""

import vibroimpact as vi
from vibroimpact.figures import motion_page

motions = {f"{hertz} Hz": vi.steady("B3-10mm-A3", frequency=hertz) for hertz in (1.3, 1.107, 1.06)}
motion_page(motions)
