"""Energy of a force over a displacement, for laws without a closed form of it."""

from __future__ import annotations

from collections.abc import Callable


def integral_of(force: Callable[[float], float], displacement: float) -> float:
    """Return the work (J) of a force (N) from 0 to a displacement (m), by adaptive quadrature."""
    from scipy.integrate import quad

    # With the full output, a corner of the force that limits the accuracy is no warning.
    return float(quad(force, 0.0, displacement, epsabs=0.0, epsrel=1e-13, full_output=1)[0])
