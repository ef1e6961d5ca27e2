"""
Sobol indices: which parameter matters
======================================

Sobol indices divide the variance of the largest acceleration among the uncertain parameters. One
index is the contribution of a parameter alone. The other is its total contribution, including
interactions with other parameters. In this rig, it is most useful to measure the stiffness of the
bumpers more accurately.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import sensitivity_bars

grid = np.arange(1.5, 3.6, 0.05)


def peak(rigs):
    return vi.sweeps(rigs, grid)[["peak_acceleration"]].max(("direction", "frequency"))


spread = {"gap": "normal:5%", "bumper_stiffness": "lognormal:0.2", "damping": "lognormal:0.1"}
found = vi.sensitivity("B2-G1-A3", spread, peak, "peak_acceleration", 128, resamples=100)
sensitivity_bars(found)
