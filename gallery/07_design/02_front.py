"""
What no other design beats
==========================

Displacement costs acceleration. Each point is a design; those on the front are the only ones
worth talking about, for every other has one that is better in both.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import pareto_front

case = vi.laboratory.case("B2-G1-A3")
vary = {"gap": np.linspace(5e-3, 40e-3, 15), "proportional_stiffness": np.geomspace(5e4, 2e6, 12)}
designs = vi.design_chart(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.0)), vary)
pareto_front(designs)
