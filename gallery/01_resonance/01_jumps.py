"""
Sweeping up and down gives different curves
===========================================

This figure shows two frequency sweeps of one rig. The upward sweep follows the motion that hits
both bumpers until this motion no longer exists. The downward sweep stays in free flight, without
contact, as long as possible. The two curves therefore jump at different frequencies. In the shaded
range between the two jumps (hysteresis), two steady motions coexist at every frequency.
"""

import vibroimpact as vi
from vibroimpact.figures import resonance_curves

# The code names a published rig: bumper 2, gap 1, acceleration 3.
curves = vi.sweep("B2-G1-A3", [k / 50 for k in range(25, 201)])
resonance_curves(curves)

# %%
# The excursion is the largest minus the smallest value. η is the excursion divided by the largest
# excursion without bumpers. In this rig, the bumpers reduce the displacement to a third, but they
# increase the acceleration by a factor of nearly three.
