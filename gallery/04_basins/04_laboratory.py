"""
Basins of a laboratory rig
==========================

At 0.7 Hz, a published rig has two coexisting motions of nearly the same size. In contrast to a
fractal border, the border of these basins is smooth. A slightly more accurate initial state
therefore gives a slightly better prediction. In darker regions, more cycles pass until the final
motion is certain.
"""

import vibroimpact as vi
from vibroimpact.figures import basin_portrait

found = vi.basins("B3-10mm-A3", frequency="0.7 Hz", nodes=300)
basin_portrait(found)
