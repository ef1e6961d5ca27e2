"""
What the borders are made of
============================

Solid curves are the states that lead to a saddle, a motion that cannot be held; they are the
border between the two colours. Dashed are the ways on which a saddle is left, one to each motion.
"""

import vibroimpact as vi
from vibroimpact.figures import basin_portrait

rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.06), vi.Bumper(30.0, 0.6, 0.5), None)
shaking = vi.Harmonic(1.0, 0.5411)
curves = vi.manifolds(vi.Rig(rig, shaking), longest=40.0)
found = vi.basins(vi.Rig(rig, shaking), nodes=300)
basin_portrait(found, manifolds=curves)
