"""The forces of every isolator and stop to as many digits as mpmath carries.

Only tests use it. It shares no code with the package: each law is written here from its source,
plainly, with what it remembers as an explicit number. A reference integrator needs of a law

- its force, given displacement, velocity and memory;
- the rate at which its memory changes;
- where its formula changes: `branch`, a number or a pair of signs that is constant on a smooth
  piece of the motion. Within one branch force and rate are analytic.

Units are SI. u is the displacement of the mass relative to the base and v its velocity; a force on
the left-hand side of M u'' + force = -M A_t is positive where it pulls the mass to the left. Of a
stop, d is the depth to which the mass has gone into it and w = d' the velocity of that; the mirror
image of a left stop is the caller's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mpmath import mp, mpf

Number = Any
"""A float or an mpf."""


def sign(x: Number) -> int:
    """-1, 0 or 1."""
    return (x > 0) - (x < 0)


def viscous(damping: Number, exponent: Number, v: Number) -> mpf:
    """c |v|^a sgn v, N; analytic away from v = 0."""
    return mpf(damping) * abs(mpf(v)) ** mpf(exponent) * sign(v)


@dataclass(frozen=True)
class Linear:
    """K u."""

    stiffness: Number

    def force(self, u: Number, v: Number, z: Number = 0) -> mpf:
        """Without the dashpot, N."""
        return mpf(self.stiffness) * u

    def rate(self, u: Number, v: Number, z: Number = 0) -> mpf:
        """Of the memory, which it has none of."""
        return mpf(0)

    def branch(self, u: Number, v: Number, z: Number = 0) -> int:
        """One formula everywhere."""
        return 0


@dataclass(frozen=True)
class Friction(Linear):
    """K u + F sgn v. At v = 0 friction is whatever holds the mass, up to F: see `held`."""

    friction: Number

    def force(self, u: Number, v: Number, z: Number = 0) -> mpf:
        """Without the dashpot, N, while it slides."""
        return mpf(self.stiffness) * u + mpf(self.friction) * sign(v)

    def held(self, others: Number) -> bool:
        """Whether friction holds the mass at v = 0 against all other forces together."""
        return abs(mpf(others)) <= mpf(self.friction)

    def branch(self, u: Number, v: Number, z: Number = 0) -> int:
        """Which way it slides; 0 is at rest."""
        return sign(v)


@dataclass(frozen=True)
class Bilinear:
    """k_p u + (k_e - k_p) z; z follows u, but never beyond u_y = F_y/k_e."""

    elastic: Number
    post_yield: Number
    yield_force: Number

    @property
    def limit(self) -> mpf:
        """u_y, m."""
        return mpf(self.yield_force) / mpf(self.elastic)

    def force(self, u: Number, v: Number, z: Number) -> mpf:
        """Without the dashpot, N."""
        k_p = mpf(self.post_yield)
        return k_p * u + (mpf(self.elastic) - k_p) * z

    def rate(self, u: Number, v: Number, z: Number) -> mpf:
        """z', m/s: v, or 0 where it yields on."""
        return mpf(0) if self.branch(u, v, z) else mpf(v)

    def branch(self, u: Number, v: Number, z: Number) -> int:
        """0 is elastic; 1 and -1 yield to the right and left."""
        return sign(v) if abs(mpf(z)) >= self.limit and v * z > 0 else 0


@dataclass(frozen=True)
class Polynomial:
    """K u + k3 u^3 + k5 u^5."""

    stiffness: Number
    cubic: Number
    quintic: Number

    def force(self, u: Number, v: Number, z: Number = 0) -> mpf:
        """Without the dashpot, N."""
        u = mpf(u)
        return mpf(self.stiffness) * u + mpf(self.cubic) * u**3 + mpf(self.quintic) * u**5

    def rate(self, u: Number, v: Number, z: Number = 0) -> mpf:
        """Of the memory, which it has none of."""
        return mpf(0)

    def branch(self, u: Number, v: Number, z: Number = 0) -> int:
        """One formula everywhere."""
        return 0


@dataclass(frozen=True)
class BoucWen:
    """k_p u + (k_e - k_p) z, z' = v (1 - |z/u_y|^n (gamma + beta sgn(v z)))."""

    elastic: Number
    post_yield: Number
    yield_force: Number
    exponent: int
    beta: Number
    gamma: Number

    def force(self, u: Number, v: Number, z: Number) -> mpf:
        """Without the dashpot, N."""
        k_p = mpf(self.post_yield)
        return k_p * u + (mpf(self.elastic) - k_p) * z

    def rate(self, u: Number, v: Number, z: Number) -> mpf:
        """z', m/s."""
        limit = mpf(self.yield_force) / mpf(self.elastic)
        shape = mpf(self.gamma) + mpf(self.beta) * sign(v) * sign(z)
        return mpf(v) * (1 - (abs(mpf(z)) / limit) ** self.exponent * shape)

    def branch(self, u: Number, v: Number, z: Number) -> tuple[int, int]:
        """The signs of v and z, by which |z| and sgn(v z) are analytic."""
        return sign(v), sign(z)


@dataclass(frozen=True)
class Exponential:
    """Vaiana, Sessa, Marmo and Rosati (2018), in the form of its published algorithm.

    Between reversals, with s = sgn v,

        f = Q (e^(b u) - e^(-b u) - 2 b u) + k_b u + s fbar - s (k_a - k_b)/a e^(-a (s u - u_j)),

    fbar = (k_a - k_b)/(2 a). At a reversal, from displacement u_P and force f_P on,

        u_j = s u_P + 1/a ln( s a/(k_a - k_b) (Q (...) + k_b u_P + s fbar - f_P) ).

    The memory z is the hysteretic part of f, z = s fbar - s (k_a - k_b)/a e^(-a (s u - u_j)), which
    a reversal leaves as it is; its rate follows by differentiation, z' = a (fbar v - z |v|).
    """

    reversal: Number
    final: Number
    decay: Number
    hardening: Number
    hardening_force: Number

    @property
    def bound(self) -> mpf:
        """fbar, N."""
        return (mpf(self.reversal) - mpf(self.final)) / (2 * mpf(self.decay))

    def elastic_force(self, u: Number) -> mpf:
        """What has no memory, N."""
        x = mpf(self.hardening) * u
        return mpf(self.hardening_force) * (mp.exp(x) - mp.exp(-x) - 2 * x) + mpf(self.final) * u

    def force(self, u: Number, v: Number, z: Number) -> mpf:
        """Without the dashpot, N."""
        return self.elastic_force(u) + z

    def rate(self, u: Number, v: Number, z: Number) -> mpf:
        """z', N/s."""
        return mpf(self.decay) * (self.bound * v - mpf(z) * abs(mpf(v)))

    def branch(self, u: Number, v: Number, z: Number) -> int:
        """The direction."""
        return sign(v)

    def after_reversal(self, s: int, u_p: Number, f_p: Number) -> mpf:
        """u_j of the branch in the direction s that leaves (u_P, f_P)."""
        a, steep = mpf(self.decay), mpf(self.reversal) - mpf(self.final)
        missing = self.elastic_force(u_p) + s * self.bound - f_p
        return s * mpf(u_p) + mp.log(s * a / steep * missing) / a

    def on_branch(self, s: int, u: Number, u_j: Number) -> mpf:
        """The force, N, on the branch in the direction s with this u_j."""
        a, steep = mpf(self.decay), mpf(self.reversal) - mpf(self.final)
        faded = steep / a * mp.exp(-a * (s * mpf(u) - u_j))
        return self.elastic_force(u) + s * self.bound - s * faded


def kelvin_voigt(stiffness: Number, damping: Number, d: Number, w: Number) -> mpf:
    """K d + C w, N; the contact ends where it falls to zero."""
    return mpf(stiffness) * d + mpf(damping) * w


def power_contact(stiffness: Number, exponent: Number, chi: Number, d: Number, w: Number) -> mpf:
    """k d^n (1 + chi w) for d > 0, never pulling, N."""
    if d <= 0:
        return mpf(0)
    return max(mpf(0), mpf(stiffness) * mpf(d) ** mpf(exponent) * (1 + mpf(chi) * w))


def jankowski_ratio(restitution: Number) -> mpf:
    """The xi of Jankowski (2006), 9 sqrt 5/2 (1 - e^2)/(e (e (9 pi - 16) + 16))."""
    e = mpf(restitution)
    return 9 * mp.sqrt(5) / 2 * (1 - e**2) / (e * (e * (9 * mp.pi - 16) + 16))


def jankowski_contact(stiffness: Number, xi: Number, mass: Number, d: Number, w: Number) -> mpf:
    """k d^1.5, and 2 xi sqrt(m k sqrt d) w with it while it closes, N."""
    if d <= 0:
        return mpf(0)
    k = mpf(stiffness)
    hertz = k * mpf(d) ** mpf("1.5")
    return hertz + 2 * mpf(xi) * mp.sqrt(mpf(mass) * k * mp.sqrt(d)) * w if w > 0 else hertz


def dissipation(restitution: Number, relation: str) -> mpf:
    """d = chi v0 of a restitution, by each of the relations in use."""
    e = mpf(restitution)
    if relation == "hunt-crossley":
        return 3 * (1 - e) / 2
    if relation == "lankarani-nikravesh":
        return 3 * (1 - e**2) / 4
    if relation == "flores":
        return 8 * (1 - e) / (5 * e)
    if relation == "gonthier":
        return (1 - e**2) / e
    assert relation == "exact"
    if e == 1:
        return mpf(0)

    def excess(d: mpf) -> mpf:
        return mp.log((1 + d) / (1 - e * d)) - d * (1 + e)

    with mp.extradps(20):
        low, high = 3 * (1 - e) / 4, (1 - mpf(10) ** (-mp.dps)) / e
        while high - low > mp.eps * low:
            middle = (low + high) / 2
            low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    return +low
