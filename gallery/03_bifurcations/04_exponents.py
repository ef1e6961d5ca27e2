"""
Lyapunov exponents over the frequency
=====================================

The largest Lyapunov exponent is the rate at which two neighbouring motions separate. Where it is
positive, the motion is chaotic and cannot be predicted for long. Each exponent is an average over
many cycles. The band around a curve shows the uncertainty of this average: its half-width is twice
the standard uncertainty.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import exponent_curves

rigs = {"gap 5 mm": "B3-10mm-A3", "gap 7.5 mm": "B3-G1-A3"}
exponents = vi.lyapunov_exponents(rigs, np.linspace(0.9, 1.3, 171), cycles=1500)
exponent_curves(exponents)
