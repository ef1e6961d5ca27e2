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
            max(abs(a - b) for a, b in zip(values, exact, strict=True)) / max(map(abs, exact))
            for values, exact in ((end[:n], true[:n]), (end[n : 2 * n], true[n:]))
        )


NEIGHBOURS = Masses(
    "two masses, a bumper between them",
    (1.2, 0.9),
    (Link(GROUND, 0, 130.0, 0.9), Link(GROUND, 1, 222.0, 1.1)),
    (Bumper(0, 1, 2.5e4, 25.0, 0.012), Bumper(GROUND, 0, 3.0e4, 30.0, 0.02)),
    3.0,
    1.9,
    0.3,
    {
        50: (
            0.012627499281849241,
            0.020400950313890988,
            -0.239280015162687241,
            -0.320371612558876190,
        ),
        500: (
            0.012627499281922680,
            0.020400950313408833,
            -0.239280015164843799,
            -0.320371612562715424,
        ),
    },
)
"""A second bumper stands on the left of the first mass."""

FRAME = Masses(
    "four masses at a wall",
    (1.0, 1.0, 1.0, 1.0),
    (Link(GROUND, 0, 400.0, 0.8), *(Link(i, i + 1, 500.0, 0.8) for i in range(3))),
    (Bumper(3, GROUND, 2.0e4, 20.0, 0.02),),
    3.0,
    1.2,
    0.3,
    {
        50: (
            -0.016097032295097167,
            -0.036631981327607752,
            -0.029016470314041728,
            0.003576749001156451,
            0.296125997391871833,
            -0.528213253982182379,
            -0.095740225949863744,
            -0.495841206274728410,
        ),
        500: (
            -0.016098233323563004,
            -0.036632312830946417,
            -0.029016685275014296,
            0.003576907911198363,
            0.296104342392137669,
            -0.528225245233846714,
            -0.095738743197556182,
            -0.495848493088371478,
        ),
    },
)

CUBIC_NEIGHBOURS = replace(
    NEIGHBOURS,
    name="two masses, a cubic link",
    links=(NEIGHBOURS.links[0], NEIGHBOURS.links[1]._replace(cubic=2e5)),
    reference={
        50: (
            0.010843747859763050,
            0.005468219427053491,
            -0.212216115990843296,
            -0.302913064011367596,
        ),
        500: (
            0.010843751959837824,
            0.005468223840885421,
            -0.212216109221917296,
            -0.302913070761159189,
        ),
    },
)

CUBIC_FRAME = replace(
    FRAME,
    name="four masses, a cubic link",
    links=(FRAME.links[0]._replace(cubic=1e5), *FRAME.links[1:]),
    hertz=1.0,
    reference={
        50: (
            0.000170163907087644,
            -0.007391380919068964,
            -0.025912795998672563,
            -0.036270390072814996,
            0.149340913637094018,
            0.337534324375709325,
            -0.125112963241590383,
            -0.223125845947491238,
        ),
        500: (
            0.000170165907291245,
            -0.007391385041811542,
            -0.025912810099363395,
            -0.036270401235834173,
            0.149340898557418775,
            0.337534160724830530,
            -0.125112892246139862,
            -0.223125603939875896,
        ),
    },
)

ASSEMBLIES = (NEIGHBOURS, FRAME, CUBIC_NEIGHBOURS, CUBIC_FRAME)
