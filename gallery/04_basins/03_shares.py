"""
How much of a basin is left
===========================

A sweep upwards follows the motion with impacts until it is lost. Its basin has shrunk long
before: the share of random starts that lead to it, with its uncertainty, says how safe it is from
a push.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import basin_shares

shares = vi.basin_stability(
    "B2-G1-A3", frequency=2.0, parameter="frequency", values=np.linspace(1.5, 2.7, 13), states=400
)
basin_shares(shares)
