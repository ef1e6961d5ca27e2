"""
Basin stability along a sweep
=============================

An upward frequency sweep follows the motion with impacts until this motion no longer exists. The
basin of attraction of the motion (the initial states that lead to it) already shrinks at much lower
frequencies. The basin stability of a motion is the share of random initial states that lead to it.
This share measures how well the motion withstands a disturbance. The figure also shows the
uncertainty of the share.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import basin_shares

shares = vi.basin_stability(
    "B2-G1-A3", frequency=2.0, vary={"frequency": np.linspace(1.5, 2.7, 13)}, states=400
)
basin_shares(shares)
