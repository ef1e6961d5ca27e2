"""Motions of several masses that other programs integrate as well."""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

GROUND = -1


class Link(NamedTuple):
    """Pushes the right body with ``-(k s + c s' + cubic s^3)``, ``s = u_right - u_left``."""

    left: int
    right: int
    stiffness: float
    damping: float
    cubic: float = 0.0


class Bumper(NamedTuple):
    """Is met at ``u_left - u_right = gap``.

    It is released at zero force, then it relaxes; see `problem.Problem`.
    """

    left: int
    right: int
    stiffness: float
    damping: float
    gap: float


@dataclass(frozen=True, slots=True)
class Masses:
    """Masses on a base of acceleration ``A sin(2 pi f t + phase)``, from rest at t = 0."""

    name: str
    masses: tuple[float, ...]
    links: tuple[Link, ...]
    bumpers: tuple[Bumper, ...]
    amplitude: float
    hertz: float
    phase: float
    reference: dict[int, tuple[float, ...]]
    """u (m) and v (m/s) after so many periods, from an integration with 50 digits."""

    @property
    def period(self) -> float:
        """Forcing period (s)."""
        return 1.0 / self.hertz

    @property
    def omega(self) -> float:
        """Angular frequency of the forcing (rad/s)."""
        return math.tau * self.hertz

    @property
    def curved(self) -> bool:
        """Whether a link is not linear."""
        return any(link.cubic for link in self.links)

    def error(self, periods: int, end: tuple[float, ...]) -> float:
        """Greatest error of the displacements and velocities, over the largest of their kind."""
        true, n = self.reference[periods], len(self.masses)
        return max(
            max(abs(a - b) for a, b in zip(found, exact, strict=True)) / max(map(abs, exact))
            for found, exact in ((end[:n], true[:n]), (end[n : 2 * n], true[n:]))
        )


NEIGHBOURS = Masses(
    "two masses, a bumper between them",
    (1.2, 0.9),
    (Link(GROUND, 0, 130.0, 0.9), Link(GROUND, 1, 222.0, 1.1)),
    (Bumper(0, 1, 2.5e4, 25.0, 0.012), Bumper(GROUND, 0, 3.0e4, 30.0, 0.02)),
    3.0,
    1.9,
    0.3,
    {},
)
"""There is a second bumper, on the left of the first mass."""

FRAME = Masses(
    "four masses at a wall",
    (1.0, 1.0, 1.0, 1.0),
    (Link(GROUND, 0, 400.0, 0.8), *(Link(i, i + 1, 500.0, 0.8) for i in range(3))),
    (Bumper(3, GROUND, 2.0e4, 20.0, 0.02),),
    3.0,
    1.2,
    0.3,
    {},
)


def _cubic(problem: Masses, which: int, cubic: float, reference: dict[int, tuple[float, ...]]):  # type: ignore[no-untyped-def]
    links = list(problem.links)
    links[which] = links[which]._replace(cubic=cubic)
    return replace(
        problem,
        name=f"{problem.name}, a cubic link",
        links=tuple(links),
        reference=reference,
    )


CUBIC_NEIGHBOURS = _cubic(NEIGHBOURS, 1, 2e5, {})
CUBIC_FRAME = replace(_cubic(FRAME, 0, 1e5, {}), hertz=1.0)

ASSEMBLIES = (NEIGHBOURS, FRAME, CUBIC_NEIGHBOURS, CUBIC_FRAME)
