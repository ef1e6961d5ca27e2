"""Gauss–Legendre quadrature with 12 points on [0, 1]."""

from __future__ import annotations

import numpy as np

_X, _W = np.polynomial.legendre.leggauss(12)
ABSCISSAE = tuple(float(x) for x in 0.5 * _X + 0.5)
WEIGHTS = tuple(float(w) for w in 0.5 * _W)
