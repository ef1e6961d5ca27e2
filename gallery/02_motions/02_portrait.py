"""
Phase portrait
==============

Velocity over displacement: a steady periodic motion is a closed curve. Diamonds are the points of
the stroboscopic section, one per forcing cycle. Dashed lines are the undeformed bumpers; beyond
them the curve is flattened.
"""

import vibroimpact as vi
from vibroimpact.figures import phase_portrait

first, second = vi.coexisting_motions("B2-G1-A3", frequency="2 Hz", samples=1024)
phase_portrait({"forward": first, "backward": second})
