"""
Pareto front of designs
=======================

A smaller displacement means a larger acceleration. Each point is a design. The front consists of
the designs that cannot be improved in both quantities at once. For every design off the front,
there is a design on the front that is better in both.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import pareto_front

vary = {"gap": np.linspace(5e-3, 40e-3, 15), "proportional_stiffness": np.geomspace(5e4, 2e6, 12)}
designs = vi.design_chart("B2-G1-A3", vary)
pareto_front(designs)
