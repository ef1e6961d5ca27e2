"""The stops of the reference for every law: their constants, and their force as a series."""

from __future__ import annotations

from typing import Any

from mpmath import mp, mpf

import vibroimpact as vi
from reference import laws_mpmath as laws
from reference.jets import Jet
from reference.law_series import fraction


class Side:
    """A stop with its sign, 1 right and -1 left."""

    def __init__(self, name: str, sign: int, stop: Any) -> None:
        self.name, self.sign, self.stop = name, sign, stop
        self.gap = mpf(stop.gap)
        self.rigid = isinstance(stop, vi.RigidStop)
        self.curved = isinstance(stop, vi.PowerBumper | vi.JankowskiBumper)
        self.number: mpf | None = None
        if self.curved:
            self.stiffness = mpf(stop.stiffness)
        if isinstance(stop, vi.PowerBumper):
            exponent = fraction(stop.exponent)
            self.root, self.degree = exponent.denominator, exponent.numerator
            self.chi = mpf(stop.dissipation or 0)
            if stop.restitution is not None:
                self.number = laws.dissipation(stop.restitution, stop.relation)
        elif isinstance(stop, vi.JankowskiBumper):
            self.root, self.degree, self.chi = 4, 6, mpf(0)
            xi = laws.jankowski_ratio(stop.restitution)
            self.closing = 2 * xi * mp.sqrt(mpf(stop.mass) * self.stiffness)
        elif isinstance(stop, vi.Bumper):
            self.stiffness, self.damping = mpf(stop.stiffness), mpf(stop.damping)
            self.rate = self.stiffness / self.damping if stop.damping else None

    def held(self, u: mpf) -> mpf:
        """Its force, N, where the mass stands still in it."""
        depth = self.sign * u - self.gap
        if not self.curved:
            return self.stiffness * depth
        return laws.power_contact(self.stiffness, mpf(self.degree) / self.root, 0, depth, 0)

    def pressing(self, u: Jet, v: Jet, w: Jet | None, way: int, chi: mpf) -> tuple[Jet, Jet | None]:
        """Its force, N; and 1 + chi d', below which it would pull, where that may be."""
        inward = v * self.sign
        if w is None:
            depth = u * self.sign - self.gap
            return depth * self.stiffness + inward * self.damping, None
        force = w.power(self.degree) * self.stiffness
        if isinstance(self.stop, vi.JankowskiBumper) and way == self.sign:
            return force + w * inward * self.closing, None
        if not chi:
            return force, None
        margin = inward * chi + 1
        return force * margin, margin


def times(one: Jet, other: Jet | None) -> Jet:
    """A product; None is 1."""
    return one if other is None else one * other
