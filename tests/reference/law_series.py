"""The laws of isolators and stops as series of a step; beside them, the same as plain formulae.

Everything is polynomial in the unknowns. Roots vanish by what is integrated: a curved stop has the
depth w^q with q so large that its force is a whole power of w, and a dashpot of an exponent that is
no whole number has the speed s^r.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from mpmath import mp, mpf

import vibroimpact as vi
from reference import laws_mpmath as laws
from reference.jets import Jet, Tape, Unknown

FINEST = 16
"""The largest denominator of an exponent."""


def fraction(exponent: float) -> Fraction:
    """An exponent as p/q.

    Raises
    ------
    ValueError
        If it is not one of a small denominator, exactly.
    """
    ratio = Fraction(exponent)
    if ratio.denominator > FINEST:
        raise ValueError(f"exponent: {exponent} is no small fraction")
    return ratio


def law_of(isolator: Any) -> Any:
    """The plain formulae of an isolator."""
    one = isolator
    if isinstance(one, vi.FrictionIsolator):
        return laws.Friction(one.stiffness, one.friction)
    if isinstance(one, vi.BilinearIsolator):
        return laws.Bilinear(one.elastic_stiffness, one.post_yield_stiffness, one.yield_force)
    if isinstance(one, vi.PolynomialIsolator):
        return laws.Polynomial(one.stiffness, one.cubic, one.quintic)
    if isinstance(one, vi.BoucWenIsolator):
        stiffness = (one.elastic_stiffness, one.post_yield_stiffness, one.yield_force)
        return laws.BoucWen(*stiffness, one.exponent, one.beta, one.gamma)
    if isinstance(one, vi.ExponentialIsolator):
        stiffness = (one.reversal_stiffness, one.final_stiffness, one.decay)
        return laws.Exponential(*stiffness, one.hardening, one.hardening_force)
    assert isinstance(one, vi.Isolator)
    return laws.Linear(one.stiffness)


def restoring(
    law: Any, tape: Tape, u: Jet, du: Jet | None, z: Unknown, way: int, branch: int, here: mpf
) -> Jet:
    """The force without dashpot and friction; it says the rate of the memory z.

    `du` is the change of u with the independent variable, None where nothing moves; `way` the
    sign of the velocity; `branch` whether a bilinear law yields, or the sign of Bouc and Wen's z;
    `here` is the value of u.
    """
    still = tape.constant(0)
    z.rate = still
    if isinstance(law, laws.Bilinear):
        k_p = mpf(law.post_yield)
        if du is not None and not branch:
            z.rate = du
        return u * k_p + z * (mpf(law.elastic) - k_p)
    if isinstance(law, laws.BoucWen):
        k_p = mpf(law.post_yield)
        if du is not None:
            size = (z * (branch / law_limit(law))).power(law.exponent)
            shape = mpf(law.gamma) + mpf(law.beta) * way * branch
            z.rate = du - du * size * shape
        return u * k_p + z * (mpf(law.elastic) - k_p)
    if isinstance(law, laws.Exponential):
        beta = mpf(law.hardening)
        if du is not None:
            z.rate = (du * law.bound - z * du * way) * mpf(law.decay)
        if not beta:
            return u * mpf(law.final) + z
        grow, fade = (Unknown(tape, mp.exp(sign * beta * here)) for sign in (1, -1))
        grow.rate, fade.rate = (
            (grow * du * beta, fade * du * -beta) if du is not None else (still, still)
        )
        return (grow - fade - u * (2 * beta)) * mpf(law.hardening_force) + u * mpf(law.final) + z
    if isinstance(law, laws.Polynomial):
        force = u * mpf(law.stiffness)
        if law.cubic or law.quintic:
            square = u * u
            bent = square * mpf(law.quintic) + mpf(law.cubic) if law.quintic else None
            force = force + u * square * (bent if bent is not None else mpf(law.cubic))
        return force
    return u * mpf(law.stiffness)


def law_limit(law: laws.BoucWen) -> mpf:
    """u_y, m."""
    return mpf(law.yield_force) / mpf(law.elastic)
