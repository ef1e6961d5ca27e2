"""The vibrating mass, its isolator and its two stops (the paper's Fig. 1).

``M ü + C u̇ + K u + (contact force) = -M A_t(t)``, with ``u`` the displacement relative to
the base. A stop pushes and never pulls.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Self

from pydantic import model_validator

from vibroimpact.errors import InputError
from vibroimpact.model.isolators import Isolator
from vibroimpact.model.kinds import Kinds
from vibroimpact.model.quantities import FORCE, LENGTH, MASS
from vibroimpact.model.stops import STOPS, Bumper, RigidStop, Stop
from vibroimpact.model.units import pretty
from vibroimpact.model.validation import Accepts, Model, constructor


class Oscillator(Model):
    """A mass on an isolator, between two stops that may differ or be absent.

    Parameters
    ----------
    mass
        M in kg, greater than 0; or text such as ``"550 kg"``.
    isolator
        Its `Isolator`, or a mapping with the isolator's fields.
    right
        What is met at positive displacement: a `Bumper`, a `RigidStop`, a mapping with the
        fields of one (with its ``kind`` if it is no bumper), or None.
    left
        What is met at negative displacement, likewise.
    force
        A constant force on the mass in N, positive to the right, such as its weight or wind; or
        text such as ``"-5.4 kN"``.

    Raises
    ------
    InputError
        If a value cannot be used; the message has its path, such as ``right.gap``. If two
        rigid stops leave the mass no room.
    """

    _quiet: ClassVar[Mapping[str, Any]] = {"force": 0.0}

    mass: Annotated[float, Accepts(MASS, above=0.0)]
    isolator: Annotated[Isolator, Kinds(Isolator)]
    right: Annotated[Bumper | RigidStop | None, STOPS] = None
    left: Annotated[Bumper | RigidStop | None, STOPS] = None
    force: Annotated[float, Accepts(FORCE)] = 0.0

    @constructor
    def __init__(
        self,
        mass: float | str,
        isolator: Isolator | Mapping[str, Any],
        right: Stop | Mapping[str, Any] | None = None,
        left: Stop | Mapping[str, Any] | None = None,
        force: float | str = 0.0,
    ) -> None:
        super().__init__(mass=mass, isolator=isolator, right=right, left=left, force=force)

    @model_validator(mode="after")
    def _frequency_exists(self) -> Self:
        # Each may be a float while their ratio or product is none.
        k, m = self.isolator.stiffness, self.mass
        if k == 0.0:
            return self
        if not (0.0 < k / m < math.inf and 0.0 < k * m < math.inf):
            raise InputError(
                f"an isolator of {k:g} N/m under {m:g} kg has a natural frequency or a critical "
                "damping outside the range of floating-point numbers; moderate values are accepted"
            )
        return self

    @model_validator(mode="after")
    def _held(self) -> Self:
        """Without a spring, stops or a dashpot must bound the motion."""
        if self.isolator.stiffness > 0.0:
            return self
        against = self.right if self.force > 0.0 else self.left
        if (self.force and against is None) or not self.stops:
            raise InputError(
                f"isolator.stiffness: 0, and nothing holds the mass against a force of "
                f"{pretty(self.force, FORCE)}; a stop on that side or a stiffness greater than 0 "
                "is accepted"
            )
        return self

    @model_validator(mode="after")
    def _room_between_walls(self) -> Self:
        if isinstance(self.right, RigidStop) and isinstance(self.left, RigidStop):
            right, left = self.right.gap, self.left.gap
            if not right + left > 0.0:
                raise InputError(
                    f"right.gap: {pretty(right, LENGTH)} and left.gap: {pretty(left, LENGTH)} "
                    "leave no room between two rigid stops; a sum greater than 0 is accepted"
                )
        return self

    @property
    def stops(self) -> tuple[Stop, ...]:
        """The stops that are there, the right one first."""
        return tuple(stop for stop in (self.right, self.left) if stop is not None)

    @property
    def angular_frequency(self) -> float:
        """Undamped natural angular frequency without stops, ω0 = √(K/M), in rad/s; may be 0."""
        return math.sqrt(self.isolator.stiffness / self.mass)

    @property
    def natural_frequency(self) -> float:
        """Undamped natural frequency without stops, ω0/2π, in Hz.

        Raises
        ------
        InputError
            If the isolator has no stiffness.
        """
        self._springs("natural frequency")
        return self.angular_frequency / math.tau

    @property
    def damping_ratio(self) -> float:
        """Damping factor of the isolator, ξ = C/(2√(K M)) (the paper's Section 7).

        Raises
        ------
        InputError
            If the isolator has no stiffness.
        """
        self._springs("damping ratio")
        return self.isolator.damping / (2.0 * math.sqrt(self.isolator.stiffness * self.mass))

    def _springs(self, what: str) -> None:
        if self.isolator.stiffness == 0.0:
            raise InputError(
                f"isolator.stiffness: 0, so that there is no {what}; a stiffness greater than 0 "
                "is accepted, or values that need none, such as frequencies in Hz"
            )

    @property
    def symmetric(self) -> bool:
        """Whether it is its own mirror image."""
        return self.right == self.left and self.force == 0.0

    def mirrored(self) -> Oscillator:
        """Return its mirror image: right and left exchanged, and the force turned round."""
        return self.replace(right=self.left, left=self.right, force=-self.force + 0.0)

    def without_bumpers(self) -> Oscillator:
        """Return the same mass and isolator in free flight."""
        return self.replace(right=None, left=None)
