"""
Up and down are two ways
========================

A sweep upwards holds on to a motion that hits both bumpers until it is lost; a sweep downwards
flies free until it cannot. Between the two jumps, shaded, two motions exist at every frequency.
"""

import vibroimpact as vi
from vibroimpact.figures import resonance_curves

# A published rig: bumper 2, gap 1, acceleration 3.
case = vi.laboratory.case("B2-G1-A3")
curves = vi.sweep(case, [k / 50 for k in range(25, 201)])
resonance_curves(curves)

# %%
# η compares with the largest excursion without bumpers: here the bumpers keep the displacement to
# a third, and pay for it with nearly three times the acceleration.
