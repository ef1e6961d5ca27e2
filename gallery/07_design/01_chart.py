"""
Design chart: which gap, which bumper?
======================================

This chart shows the largest displacement and the largest acceleration of a machine on an isolator
under sinusoidal shaking. The axes are the gap and the stiffness of the bumpers. Each design is
evaluated at the frequency that is worst for this design. Beyond the thick dashed line, the mass
does not touch the bumpers.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import design_chart

vary = {"gap": np.linspace(5e-3, 40e-3, 15), "proportional_stiffness": np.geomspace(5e4, 2e6, 12)}
designs = vi.design_chart("B2-G1-A3", vary)
design_chart(designs)
