"""Three smooth laws between two stops, each forced as problem P is, and where they end.

In flight ``x'' + c x' + restoring(x, z) = a cos(Omega t)``; on either side is a stop at one gap.
The laws are those that Taylor series can follow, with what each needs besides: events where a
formula changes its branch, and a new unknown where a power begins.
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Smooth:
    """One of the problems.

    Attributes
    ----------
    cubic
        Of the isolator's force, beside ``x``.
    elastic, post_yield, yield_force
        Of Bouc and Wen's law with n = 1, beta = gamma = 1/2; None where the isolator has no memory.
    power
        Whether a stop presses with ``k d^1.5 (1 + chi d')``, else with ``k d + c d'`` as in P.
    stiffness, dissipation
        ``k`` and, of a stop, ``chi`` or ``c``.
    """

    name: str
    amplitude: float
    gap: float
    stiffness: float
    dissipation: float
    end: dict[int, tuple[float, float]]
    power: bool = False
    cubic: float = 0.0
    hysteretic: tuple[float, float, float] | None = None
    damping: float = 0.1
    frequency: float = 1.2

    @property
    def period(self) -> float:
        """Forcing period."""
        return math.tau / self.frequency

    def error(self, periods: int, x: float, v: float) -> float:
        """Greater of the errors of x and x' after so many periods from rest."""
        true_x, true_v = self.end[periods]
        return max(abs(x - true_x), abs(v - true_v))


_DUFFING = {
    50: (1.04907934411533637, 0.60356688661257709),
    200: (1.0490793441620474675, 0.60356688645627571),
}
_HUNT_CROSSLEY = {
    50: (1.0889057034974743929, 0.85064394161649852),
    200: (1.0889057034974773588, 0.85064394161649030),
}
_BOUC_WEN = {
    50: (0.52913488120020345834, 0.79833857414172560),
    200: (0.52913488120020345392, 0.79833857414172557),
}
# From integrations with 25 digits; each motion has become periodic before 100 periods.

DUFFING = Smooth(
    "Duffing's isolator, Kelvin-Voigt bumpers", 0.6, 1.0, 20.0, 0.4, _DUFFING, cubic=0.5
)
HUNT_CROSSLEY = Smooth(
    "linear isolator, Hunt-Crossley stops", 0.6, 1.0, 40.0, 0.3, _HUNT_CROSSLEY, power=True
)
BOUC_WEN = Smooth(
    "Bouc and Wen's isolator, Kelvin-Voigt bumpers",
    0.8,
    0.7,
    20.0,
    0.4,
    _BOUC_WEN,
    hysteretic=(2.0, 0.5, 0.5),
)
SMOOTH = (DUFFING, HUNT_CROSSLEY, BOUC_WEN)
