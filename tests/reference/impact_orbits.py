"""Orbits with one impact on one rigid stop, in closed form, with their multipliers and borders.

The mass M = 1 on K = 1 and C hits a wall at u = G with restitution e, once in n forcing cycles of
A_t = sin θ, θ' = ω (S. W. Shaw and P. J. Holmes, J. Sound Vib. 90 (1983) 129-155; C. Budd and
F. Dux, Phil. Trans. R. Soc. A 347 (1994) 365-389, for C = 0).

**The orbit.** u = p + h, with p = X cos ψ the steady free flight and h decaying freely. Over
T = 2πn/ω let (h, h') go over into Φ(h, h'), Φ = ((a, b), (c, d)). From an impact at ψ to the next h
returns to q = G - X cos ψ, and h' rises from s to s + (1 + e) v. The first says s = σ q with
σ = (1 - a)/b, the second then v = κ q with κ = (c + (d - 1) σ)/(1 + e). What is left of
s + p' = -e v is

    X ω sin ψ + Λ X cos ψ = Λ G,    Λ = σ + e κ,

with two solutions ψ. They meet, in a fold, at |Λ| G = X √(ω² + Λ²).

**Multipliers.** A disturbance of (u, v) at a fixed time passes an impact by the saltation matrix
((-e, 0), ((a₊ + e a₋)/v, -e)), with the accelerations just before and after it: the disturbed
motion arrives δu/v earlier, and the two accelerations act that much shorter and longer. With Φ over
the flight the multipliers have the product e² exp(-C T) and the sum that follows. One is 1 at the
fold, and one is -1 where the period doubles.
"""

from __future__ import annotations

from typing import NamedTuple

from mpmath import findroot, linspace, matrix, mp, mpc, mpf


class Oscillator(NamedTuple):
    """M = K = A = 1."""

    frequency: float
    """Hz."""
    damping: float
    restitution: float
    gap: float
    cycles: int = 1
    """n."""

    @property
    def omega(self) -> mpf:
        return 2 * mp.pi * mpf(self.frequency)

    @property
    def turning(self) -> mpc:
        """p is the imaginary part of this times exp(iθ)."""
        return -1 / mpc(1 - self.omega**2, mpf(self.damping) * self.omega)

    @property
    def span(self) -> mpf:
        return self.cycles / mpf(self.frequency)

    def flow(self, t: mpf) -> matrix:
        """Free decay of (h, h')."""
        beta = mpf(self.damping) / 2
        w = mp.sqrt(1 - beta**2)
        cosine, sine = mp.cos(w * t), mp.sin(w * t) / w
        return mp.exp(-beta * t) * matrix(
            [[cosine + beta * sine, sine], [-sine, cosine - beta * sine]]
        )

    @property
    def ratios(self) -> tuple[mpf, mpf, mpf]:
        """σ, κ, Λ."""
        e, flow = mpf(self.restitution), self.flow(self.span)
        sigma = (1 - flow[0, 0]) / flow[0, 1]
        kappa = (flow[1, 0] + (flow[1, 1] - 1) * sigma) / (1 + e)
        return sigma, kappa, sigma + e * kappa

    @property
    def fold(self) -> mpf:
        """The gap at which the two orbits meet."""
        _, _, both = self.ratios
        return abs(self.turning) * mp.hypot(self.omega, both) / abs(both)


class Orbit(NamedTuple):
    oscillator: Oscillator
    phase: mpf
    """θ of the impact."""
    velocity: mpf
    """Towards the wall, just before the impact."""

    def after(self, t: mpf) -> tuple[mpf, mpf, mpf]:
        """u, v and θ at a time after the impact, up to the next one."""
        one = self.oscillator
        here = one.turning * mp.expj(self.phase)
        h = matrix(
            [
                mpf(one.gap) - mp.im(here),
                -mpf(one.restitution) * self.velocity - one.omega * mp.re(here),
            ]
        )
        h = one.flow(t) * h
        there = one.turning * mp.expj(self.phase + one.omega * t)
        return (
            h[0] + mp.im(there),
            h[1] + one.omega * mp.re(there),
            self.phase + one.omega * t,
        )

    @property
    def possible(self) -> bool:
        """Whether it hits the wall, and keeps within it between impacts."""
        one = self.oscillator
        times = linspace(0, one.span, 1001)[1:-1]
        return self.velocity > 0 and all(self.after(t)[0] < one.gap for t in times)

    @property
    def trace(self) -> mpf:
        one = self.oscillator
        e, c = mpf(one.restitution), mpf(one.damping)
        push = -mpf(one.gap) - mp.sin(self.phase)
        before, behind = push - c * self.velocity, push + c * e * self.velocity
        flow = one.flow(one.span)
        return -e * (flow[0, 0] + flow[1, 1]) + (behind + e * before) / self.velocity * flow[0, 1]

    @property
    def determinant(self) -> mpf:
        one = self.oscillator
        return mpf(one.restitution) ** 2 * mp.exp(-mpf(one.damping) * one.span)

    @property
    def multipliers(self) -> tuple[mpc, mpc]:
        split = mp.sqrt(mpc(self.trace**2 / 4 - self.determinant))
        return self.trace / 2 + split, self.trace / 2 - split


def orbits(one: Oscillator) -> list[Orbit]:
    """Both orbits; not each is possible."""
    _, kappa, both = one.ratios
    swing = abs(one.turning)
    middle = mp.atan2(one.omega, both)
    share = both * mpf(one.gap) / (swing * mp.hypot(one.omega, both))
    if abs(share) > 1:
        return []
    solutions = []
    for psi in (middle + mp.acos(share), middle - mp.acos(share)):
        q = mpf(one.gap) - swing * mp.cos(psi)
        phase = psi + mp.pi / 2 - mp.arg(one.turning)
        solutions.append(Orbit(one, phase, kappa * q))
    return solutions


def possible_orbits(one: Oscillator) -> list[Orbit]:
    return [orbit for orbit in orbits(one) if orbit.possible]


def doubling(one: Oscillator, low: float, high: float) -> mpf:
    """The frequency between two others at which the period of the stable orbit doubles."""

    def margin(frequency: mpf) -> mpf:
        margins = [
            1 + orbit.trace + orbit.determinant
            for orbit in orbits(one._replace(frequency=frequency))
            if orbit.velocity > 0
        ]
        return max(margins)  # that of the other orbit of the pair is below it

    return findroot(margin, (mpf(low), mpf(high)), solver="anderson")
