"""
Basin borders are stable manifolds
==================================

A saddle is an unstable periodic motion. The solid curves are its stable manifold, that is, the
initial states that lead to the saddle. They are the border between the basins of two steady
motions. The dashed curves are the unstable manifold of the saddle, which leads to the two steady
motions.
"""

import vibroimpact as vi
from vibroimpact.figures import basin_portrait

oscillator = vi.Oscillator(1.0, vi.Isolator(1.0, 0.06), vi.Bumper(30.0, 0.6, 0.5), None)
rig = vi.Rig(oscillator, vi.Harmonic(1.0, 0.5411))
curves = vi.manifolds(rig, longest=40.0)
found = vi.basins(rig, nodes=300)
basin_portrait(found, manifolds=curves)
