"""
Sweeping up and down gives different curves
===========================================

This figure shows an upward and a downward frequency sweep of one rig: a mass on an isolator between
two bumpers. The upward sweep follows the motion that hits both bumpers until this motion no longer
exists. The downward sweep follows the motion without contact (free flight) as long as possible. The
two curves therefore jump at different frequencies. In the shaded range between the two jumps
(hysteresis), two steady motions coexist at every frequency.
"""

import vibroimpact as vi
from vibroimpact.figures import resonance_curves

# The code names a published rig: bumper 2, gap 1, acceleration 3.
curves = vi.sweep("B2-G1-A3", [k / 50 for k in range(25, 201)])
resonance_curves(curves)

# %%
# The excursion of a quantity is its largest minus its smallest value. η is the excursion divided by
# the largest excursion of the same rig without bumpers. In this rig, the bumpers reduce the largest
# displacement to a third of its value without bumpers. They increase the largest acceleration by a
# factor of nearly three.
