"""
Basins of a laboratory rig
==========================

At 0.7 Hz, two motions of nearly the same size coexist in a published rig. Here the border is
smooth: a slightly more accurate initial state gives a slightly better prediction. Darker colours
need more cycles until the final motion is certain.
"""

import vibroimpact as vi
from vibroimpact.figures import basin_portrait

found = vi.basins("B3-10mm-A3", frequency="0.7 Hz", nodes=300)
basin_portrait(found)
