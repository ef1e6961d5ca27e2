"""
A rig of the laboratory
=======================

At 0.7 Hz two motions of nearly the same size coexist in a published rig. Here the border is
smooth: a start that is known a little better is told a little better. Darker colours take more
cycles until it is sure where a start leads.
"""

import vibroimpact as vi
from vibroimpact.figures import basin_portrait

found = vi.basins("B3-10mm-A3", frequency="0.7 Hz", nodes=300)
basin_portrait(found)
