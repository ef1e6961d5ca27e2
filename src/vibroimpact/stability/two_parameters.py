"""A rig and its forcing over two parameters."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.model.parameters import Parameter
from vibroimpact.model.rig import Rig
from vibroimpact.stability.parameter_family import RATES, Family, family, make_uneven, numbers

_Array = NDArray[np.float64]

_AGREE = 1e-9


class ParameterPlane(NamedTuple):
    """A rig over two parameters p and q, each of which moves it along its own straight line."""

    family: Family
    """Along p, at the q where the plane was made."""
    other: Parameter
    value: float
    """q where the plane was made."""
    second: _Array
    """How the engine's system vector moves with q."""
    symmetric: bool
    """Whether each motion's mirror image is a motion, whatever p and q."""

    def at_vectors(self, q: float) -> Family:
        """The family along p at a value of q, as the engine sees it: its rig is still the old."""
        change = (q - self.value) * self.second
        base = self.family.base
        return self.family._replace(base=np.where(change != 0.0, base + change, base))


def plane(rig: Rig, names: tuple[str, str]) -> ParameterPlane:
    """Prepare a rig for being followed over two parameters.

    Raises
    ------
    InputError
        If there is no such parameter, the rig has none, or the two do not go together.
    """
    first = family(rig, names[0])
    second = family(rig, names[1])
    other = second.parameter
    for one in (first, second):
        if not one.straight:
            raise InputError(
                f"vary: no curve can be followed along {one.parameter.name!r}, because the "
                "equations of this rig do not depend linearly on it; use the frequency, the "
                "amplitude, a gap, a force, or another stiffness or damping; branch accepts any "
                "parameter"
            )
    both = first.symmetric and second.symmetric
    if second.uneven:
        make_uneven(first.base)
    made = ParameterPlane(first, other, second.value, second.direction, both)
    p, q = first.parameter.beside(first.value, 3.0), other.beside(second.value, 6.0)
    guess = made.at_vectors(q).system(p)
    writes = [(first.parameter, p), (other, q)]
    straight = np.ones(len(guess), dtype=bool)
    for order in (writes, writes[::-1]):
        there = rig
        for varied, value in order:
            there = varied.vary(there, value)
        true = numbers(there, first.uneven or second.uneven)
        with np.errstate(invalid="ignore"):
            error = np.abs(guess - true)
        straight &= (guess == true) | (error <= _AGREE * np.maximum(np.abs(true), np.abs(guess)))
    if not first.of_several_masses:
        straight[RATES] = True  # they follow from stiffness and damping
    if not straight.all():
        raise InputError(
            f"vary: {names[0]!r} and {names[1]!r} are not independent of each other; pass "
            "another pair, such as 'frequency' and 'gap', or 'stiffness_ratio' and 'gap_ratio'"
        )
    return made
