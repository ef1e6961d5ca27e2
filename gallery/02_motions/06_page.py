"""
A motion on one page
====================

Phase portrait, spectrum and time history of three motions of one rig: a periodic one, one with
twice the period, and a chaotic one. The line below each heading states the type of the motion.
"""

import vibroimpact as vi
from vibroimpact.figures import motion_page

motions = {f"{hertz} Hz": vi.steady("B3-10mm-A3", frequency=hertz) for hertz in (1.3, 1.107, 1.06)}
motion_page(motions)
