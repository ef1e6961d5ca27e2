"""
Sobol indices: which parameter matters
======================================

Sobol indices divide the variance of the largest acceleration among the uncertain parameters. The
figure shows two indices for each parameter. The first index is the contribution of the parameter
alone. The second index is its total contribution, including interactions with other parameters. In
this rig, the stiffness of the bumpers contributes most. It is therefore most useful to measure this
stiffness more accurately.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import sensitivity_bars

grid = np.arange(1.5, 3.6, 0.05)


def peak(rigs):
    return vi.sweeps(rigs, grid)[["peak_acceleration"]].max(("direction", "frequency"))


spread = {
    "gap": "normal:5%",
    "stops.stiffness": "lognormal:0.2",
    "isolator.damping": "lognormal:0.1",
}
found = vi.sensitivity("B2-G1-A3", spread, peak, "peak_acceleration", 128, resamples=100)
sensitivity_bars(found)
