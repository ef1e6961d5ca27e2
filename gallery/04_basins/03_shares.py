"""
Basin stability along a sweep
=============================

An upward sweep follows the motion with impacts until this motion no longer exists. Its basin of
attraction shrinks at much lower frequencies. Basin stability is the share of random initial states
that lead to the motion. It measures how well the motion withstands a disturbance. The figure also
shows the uncertainty of this share.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import basin_shares

shares = vi.basin_stability(
    "B2-G1-A3", frequency=2.0, parameter="frequency", values=np.linspace(1.5, 2.7, 13), states=400
)
basin_shares(shares)
