"""
Pareto front of designs
=======================

Each point is a design, that is, a gap and a stiffness of the bumpers. A good design has a small
displacement and a small acceleration, but the two aims are in conflict. The front consists of the
designs that cannot be improved in both quantities at once. For every design off the front, there is
a design on the front that is better in both.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import pareto_front

vary = {"gap": np.linspace(5e-3, 40e-3, 15), "proportional_stiffness": np.geomspace(5e4, 2e6, 12)}
designs = vi.design_chart("B2-G1-A3", vary)
pareto_front(designs)
