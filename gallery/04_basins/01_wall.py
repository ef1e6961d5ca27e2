"""
Basins of four motions of a ball on a wall
==========================================

A mass on a spring hits a rigid wall. Each point of the figure is an initial state, that is, a
displacement and a velocity. The colour of the point shows the steady motion to which this state
leads. There are four such motions, with periods of 4 to 24 cycles. The borders of the basins are
fractal. If an initial state lies near a border, a more accurate measurement of this state therefore
hardly improves the prediction.
"""

import vibroimpact as vi
from vibroimpact.figures import basin_portrait

wall = vi.RigidStop(restitution=0.9, gap=0.0)
ball = vi.Oscillator(1.0, vi.Isolator(stiffness=1.0, damping=0.02), right=wall, left=None)
found = vi.basins(vi.Rig(ball, vi.Harmonic(1.0, 0.5252)), (-1.05, 0.0), (-1.25, 1.25), nodes=300)
print(f"uncertainty exponent {found['uncertainty_exponent'].item():.2f}, of 1 for a smooth border")
basin_portrait(found)
