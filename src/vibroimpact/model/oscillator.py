"""The vibrating mass, its isolator and its two bumpers (the paper's Fig. 1).

``M ü + C u̇ + K u + (contact force) = -M A_t(t)``, with ``u`` the displacement relative to
the base. A bumper is a massless spring and dashpot in parallel, at its gap from the mass at
rest; it pushes and never pulls.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Self

from pydantic import model_validator

from vibroimpact.errors import InputError
from vibroimpact.model.units import DAMPING, LENGTH, MASS, STIFFNESS
from vibroimpact.model.validation import Accepts, Model, constructor


class Isolator(Model):
    """The linear spring and dashpot that carry the mass (the paper's damper D).

    Parameters
    ----------
    stiffness
        K in N/m, greater than 0; or text such as ``"26.8 kN/m"``.
    damping
        C in N s/m, at least 0; or text such as ``"1.1 kN s/m"``.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    damping: Annotated[float, Accepts(DAMPING, minimum=0.0)]

    @constructor
    def __init__(self, stiffness: float | str, damping: float | str) -> None:
        super().__init__(stiffness=stiffness, damping=damping)


class Bumper(Model):
    """A massless deformable stop: spring and dashpot in parallel (Kelvin-Voigt).

    Parameters
    ----------
    stiffness
        K_j in N/m, greater than 0; or text such as ``"510 kN/m"``.
    damping
        C_j in N s/m, at least 0; or text such as ``"0.9 kN s/m"``.
    gap
        G0_j in m, at least 0: the distance from the mass at rest to the bumper at rest; or
        text such as ``"7.5 mm"``. The total gap of a symmetric rig is twice as large.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    damping: Annotated[float, Accepts(DAMPING, minimum=0.0)]
    gap: Annotated[float, Accepts(LENGTH, minimum=0.0)]

    @constructor
    def __init__(self, stiffness: float | str, damping: float | str, gap: float | str) -> None:
        super().__init__(stiffness=stiffness, damping=damping, gap=gap)


class Oscillator(Model):
    """A mass on an isolator, between two bumpers that may differ or be absent.

    Parameters
    ----------
    mass
        M in kg, greater than 0; or text such as ``"550 kg"``.
    isolator
        Its `Isolator`, or a mapping with the isolator's fields.
    right
        The bumper met at positive displacement, a mapping with its fields, or None.
    left
        The bumper met at negative displacement, a mapping with its fields, or None.

    Raises
    ------
    InputError
        If a value cannot be used; the message has its path, such as ``right.gap``.
    """

    mass: Annotated[float, Accepts(MASS, above=0.0)]
    isolator: Isolator
    right: Bumper | None = None
    left: Bumper | None = None

    @constructor
    def __init__(
        self,
        mass: float | str,
        isolator: Isolator | Mapping[str, Any],
        right: Bumper | Mapping[str, Any] | None = None,
        left: Bumper | Mapping[str, Any] | None = None,
    ) -> None:
        super().__init__(mass=mass, isolator=isolator, right=right, left=left)

    @model_validator(mode="after")
    def _frequency_exists(self) -> Self:
        # Each may be a float while their ratio or product is none.
        k, m = self.isolator.stiffness, self.mass
        if not (0.0 < k / m < math.inf and 0.0 < k * m < math.inf):
            raise InputError(
                f"an isolator of {k:g} N/m under {m:g} kg has a natural frequency or a critical "
                "damping outside the range of floating-point numbers; moderate values are accepted"
            )
        return self

    @property
    def angular_frequency(self) -> float:
        """Undamped natural angular frequency without bumpers, ω0 = √(K/M), in rad/s."""
        return math.sqrt(self.isolator.stiffness / self.mass)

    @property
    def natural_frequency(self) -> float:
        """Undamped natural frequency without bumpers, ω0/2π, in Hz."""
        return self.angular_frequency / math.tau

    @property
    def damping_ratio(self) -> float:
        """Damping factor of the isolator, ξ = C/(2√(K M)) (the paper's Section 7)."""
        return self.isolator.damping / (2.0 * math.sqrt(self.isolator.stiffness * self.mass))

    @property
    def symmetric(self) -> bool:
        """Whether it is its own mirror image."""
        return self.right == self.left

    def mirrored(self) -> Oscillator:
        """Return the oscillator with its right and left bumpers exchanged."""
        return self.replace(right=self.left, left=self.right)

    def without_bumpers(self) -> Oscillator:
        """Return the same mass and isolator in free flight."""
        return self.replace(right=None, left=None)
