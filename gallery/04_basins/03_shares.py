"""
Basin stability along a sweep
=============================

A sweep upwards follows the motion with impacts until this motion is lost. Its basin shrinks long
before. The share of random initial states that lead to it, shown with its uncertainty, measures
how well the motion withstands a disturbance.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import basin_shares

shares = vi.basin_stability(
    "B2-G1-A3", frequency=2.0, parameter="frequency", values=np.linspace(1.5, 2.7, 13), states=400
)
basin_shares(shares)
