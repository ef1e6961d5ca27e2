"""
Basins of a laboratory rig
==========================

At 0.7 Hz, a rig from published laboratory tests has two coexisting motions of nearly the same size.
The border between the basins of these motions is smooth. If an initial state lies near a smooth
border, a slightly more accurate measurement of the state gives a slightly better prediction. (Near
a fractal border, the prediction hardly improves.) In darker regions, more cycles pass until the
final motion is certain.
"""

import vibroimpact as vi
from vibroimpact.figures import basin_portrait

found = vi.basins("B3-10mm-A3", frequency="0.7 Hz", nodes=300)
basin_portrait(found)
