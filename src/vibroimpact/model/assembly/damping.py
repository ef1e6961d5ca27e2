"""Damping of an assembly that its modes determine: modal and Rayleigh damping.

It is added to the dashpots of the links.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Self, TypeAlias

import numpy as np
from numpy.typing import NDArray
from pydantic import field_validator

from vibroimpact.arguments import check_list, is_list
from vibroimpact.errors import InputError
from vibroimpact.model.law_registry import Kinds, Named
from vibroimpact.model.quantities import DIMENSIONLESS, TIME, Quantity, Scale
from vibroimpact.model.validation import Accepts, takes_fields

Matrix: TypeAlias = NDArray[np.float64]

_RATE = Quantity("rate", (("second", -1),), "1/s", "0.3 1/s", 0.3, (Scale(0.0, 1.0, "1/s"),))
_RATIO = Accepts(DIMENSIONLESS, minimum=0.0)


@dataclass(frozen=True, eq=False)
class Modes:
    """Undamped modes without stops.

    Modes are compared by identity, so that equal assemblies stay equal once one has them.
    """

    omega: NDArray[np.float64]
    """Angular frequencies (rad/s), ascending. 0 for a free motion."""
    shapes: NDArray[np.float64]
    """Modes in columns, with Φᵀ M Φ = 1."""


class Damping(Named):
    """Damping that the modes determine; derive from it, and provide `matrix`."""

    def check_modes(self, count: int) -> None:
        """Raise an error unless it can damp so many modes; by default it damps any number.

        Raises
        ------
        InputError
            If it cannot.
        """

    def matrix(self, mass: Matrix, stiffness: Matrix, modes: Modes) -> Matrix:
        """Return C (N s/m) for the mass matrix, the stiffness matrix and the modes."""
        raise NotImplementedError


class ModalDamping(Damping):
    """Viscous damping with a damping ratio of each mode.

    The damping matrix is C = M Φ diag(2 ζ_j ω_j) Φᵀ M, with the modes Φ (Φᵀ M Φ = 1) of the masses
    on the initial stiffness of all links. A mode without stiffness has no modal damping.

    Parameters
    ----------
    ratio
        Damping ratio ζ of all modes, at least 0, or a string such as ``"5 %"``; or a list with one
        ratio per mode, in the order of the natural frequencies.

    Raises
    ------
    InputError
        If a ratio is invalid.
    """

    kind: ClassVar[str] = "modal"
    usual: ClassVar[bool] = True

    ratio: float | tuple[float, ...]

    @takes_fields
    def __init__(self, ratio: Any) -> None: ...

    @field_validator("ratio", mode="before")
    @classmethod
    def _one_or_each(cls, value: Any) -> Any:
        if not is_list(value):
            return _RATIO(value)
        ratios = enumerate(check_list(value, "ratio"), 1)
        return tuple(_RATIO.at(one, f"mode {i}") for i, one in ratios)

    def check_modes(self, count: int) -> None:
        """Raise an error unless there is one ratio, or one per mode."""
        if isinstance(self.ratio, tuple) and len(self.ratio) != count:
            raise InputError(
                f"damping.ratio: {len(self.ratio)} ratios for {count} modes; pass one ratio, or "
                f"{count}"
            )

    def matrix(self, mass: Matrix, stiffness: Matrix, modes: Modes) -> Matrix:
        """Return C = M Φ diag(2 ζ_j ω_j) Φᵀ M (N s/m)."""
        weighted = mass @ modes.shapes
        ratios = np.broadcast_to(np.asarray(self.ratio, dtype=float), modes.omega.shape)
        return np.asarray((weighted * (2.0 * ratios * modes.omega)) @ weighted.T)


class RayleighDamping(Damping):
    """Viscous damping proportional to the masses and the stiffness, C = α M + β K.

    K is the initial stiffness of all links. A mode of the angular frequency ω has the damping ratio
    (α/ω + β ω)/2.

    Parameters
    ----------
    mass_factor
        Factor α of the mass matrix in 1/s, at least 0. It damps motion relative to the base.
    stiffness_factor
        Factor β of the stiffness matrix in s, at least 0; or a string such as ``"2 ms"``.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or is less than 0.
    """

    kind: ClassVar[str] = "rayleigh"

    mass_factor: Annotated[float, Accepts(_RATE, minimum=0.0)] = 0.0
    stiffness_factor: Annotated[float, Accepts(TIME, minimum=0.0)] = 0.0

    @takes_fields
    def __init__(
        self, mass_factor: float | str = 0.0, stiffness_factor: float | str = 0.0
    ) -> None: ...

    @classmethod
    def from_ratio(cls, ratio: float, first: float, second: float) -> Self:
        """Return the damping with one damping ratio at two angular frequencies (rad/s).

        Between the two, the damping ratio is smaller; outside of them, it is larger.
        """
        total = first + second
        return cls(2.0 * ratio * first * second / total, 2.0 * ratio / total)

    def matrix(self, mass: Matrix, stiffness: Matrix, modes: Modes) -> Matrix:
        """Return C = α M + β K (N s/m)."""
        return self.mass_factor * mass + self.stiffness_factor * stiffness


AnyDamping: TypeAlias = ModalDamping | RayleighDamping
DAMPINGS = Kinds(ModalDamping, RayleighDamping)
