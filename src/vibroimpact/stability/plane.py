"""A rig and its forcing over two parameters."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import parameters as par
from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator
from vibroimpact.stability.family import Family, Parameter, family, parameter, system_vector

_Array = NDArray[np.float64]

_AGREE = 1e-9

RATES = [par.BUMPER + par.RATE, par.BUMPER + par.WIDTH + par.RATE]


class Plane(NamedTuple):
    """A rig over two parameters p and q: base + p · first + q · second + p q · both."""

    family: Family
    """Along p, at the q where the plane was made."""
    other: Parameter
    value: float
    """q where the plane was made."""
    base: _Array
    first: _Array
    second: _Array
    both: _Array

    def at_vectors(self, q: float) -> Family:
        """The family along p at a value of q, as the engine sees it: its rig is still the old."""
        return self.family._replace(
            base=_sum(self.base, q * self.second), direction=self.first + q * self.both
        )


def _sum(base: _Array, change: _Array) -> _Array:
    """Their sum, infinite where the base is."""
    return np.where(change != 0.0, base + change, base)


def plane(oscillator: Oscillator, excitation: Harmonic, names: tuple[str, str]) -> Plane:
    """Prepare a rig for being followed over two parameters.

    Raises
    ------
    InputError
        If there is no such parameter, the rig has none, or the two do not go together.
    """
    first = family(oscillator, excitation, names[0])
    other = parameter(names[1], "parameters")
    if other.name == first.parameter.name:
        raise InputError(f"parameters: {names[0]!r} twice; two different ones are accepted")
    p, q = first.value, other.read(oscillator, excitation)
    steps = (p or 1.0, q or 1.0)

    def vector(i: float, j: float, swapped: bool = False) -> _Array:
        writes = [(first.parameter, p + i * steps[0]), (other, q + j * steps[1])]
        setting = (oscillator, excitation)
        for varied, value in reversed(writes) if swapped else writes:
            setting = varied.write(*setting, value)
        return system_vector(*setting)

    corners = [vector(0, 0), vector(1, 0), vector(0, 1), vector(1, 1), vector(2, 5)]
    same = np.all([corner == corners[0] for corner in corners], axis=0)
    here, along, across, diagonal, far = (np.where(same, 0.0, corner) for corner in corners)
    both = (diagonal - along - across + here) / (steps[0] * steps[1])
    p_slope = (along - here) / steps[0] - q * both
    q_slope = (across - here) / steps[1] - p * both
    base = here - p * p_slope - q * q_slope - p * q * both
    p2, q2 = p + 2.0 * steps[0], q + 5.0 * steps[1]
    guess = base + p2 * p_slope + q2 * q_slope + p2 * q2 * both
    swapped = np.where(same, 0.0, vector(2, 5, swapped=True))
    straight = np.ones(len(far), dtype=bool)
    for target in (guess, swapped):
        straight &= np.abs(target - far) <= _AGREE * np.maximum(np.abs(far), np.abs(target))
    straight[RATES] = True  # the engine takes them from stiffness and damping
    if not straight.all():
        raise InputError(
            f"parameters: {names[0]!r} and {names[1]!r} are not independent of each other; a pair "
            "such as 'frequency' and 'gap', or 'stiffness_ratio' and 'gap_ratio', is accepted"
        )
    return Plane(first, other, q, np.where(same, corners[0], base), p_slope, q_slope, both)
