"""
Sweeping up and down gives different curves
===========================================

A frequency sweep upwards follows the motion that hits both bumpers until this motion is lost. A
sweep downwards stays in free flight as long as it can. Between the two jumps (shaded: the
hysteresis), two motions exist at every frequency.
"""

import vibroimpact as vi
from vibroimpact.figures import resonance_curves

# A published rig: bumper 2, gap 1, acceleration 3.
curves = vi.sweep("B2-G1-A3", [k / 50 for k in range(25, 201)])
resonance_curves(curves)

# %%
# η is the excursion divided by the largest excursion without bumpers. Here the bumpers reduce the
# displacement to a third and increase the acceleration nearly three times.
