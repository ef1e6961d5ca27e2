"""Problem P: one bounded, impacting motion that every engine in the comparison integrates."""

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Problem:
    """A harmonically forced oscillator between two equal deformable stops.

    In flight ``x'' + 2 zeta x' + x = a cos(Omega t)``, and a free bumper relaxes by
    ``c r' + k r = 0``. In contact the bumper follows the mass, ``r = x - gap`` on the right and
    ``l = x + gap`` on the left (so ``l`` is negative when pressed), and its force
    ``k r + c r'`` resists the mass. Contact starts when the clearance (``gap + r - x`` on the
    right) falls to zero, and ends when that force falls to zero: a bumper never pulls. All
    quantities are dimensionless; the motion starts at rest, with both bumpers relaxed, at t = 0.

    Attributes
    ----------
    damping_ratio
        ``zeta``.
    amplitude, frequency
        ``a`` and ``Omega``.
    gap
        Distance from rest to either undeformed bumper.
    bumper_stiffness, bumper_damping
        ``k`` and ``c`` of either bumper.
    """

    damping_ratio: float = 0.05
    amplitude: float = 0.6
    frequency: float = 1.2
    gap: float = 1.0
    bumper_stiffness: float = 20.0
    bumper_damping: float = 0.4

    @property
    def period(self) -> float:
        """Forcing period."""
        return math.tau / self.frequency

    @property
    def relaxation_rate(self) -> float:
        """Rate ``k / c`` at which a free bumper's deformation decays."""
        return self.bumper_stiffness / self.bumper_damping


P = Problem()

REFERENCE = {
    50: (1.0691656920496341, 0.79245481484797497),
    1000: (1.0691656920622690, 0.79245481482734604),
}
"""x and x' of problem P after so many periods, from an integration with 50 digits."""


def state_error(periods: int, x: float, v: float) -> float:
    """Greater of the errors of x and x' in problem P."""
    true_x, true_v = REFERENCE[periods]
    return max(abs(x - true_x), abs(v - true_v))
