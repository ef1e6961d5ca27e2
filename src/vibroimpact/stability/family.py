"""A rig and its forcing along one parameter: what a branch of orbits is followed in.

Each parameter moves the rig's numbers along a straight line, so that the engine needs only where
the line begins and where it goes.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import parameters as par
from vibroimpact.engine import section_map
from vibroimpact.engine.section_map import PARAMETER
from vibroimpact.errors import InputError
from vibroimpact.model import Oscillator, Repeated
from vibroimpact.model.access import Setting
from vibroimpact.model.parameters import Parameter, followed
from vibroimpact.response.start import engine_rig

_Array = NDArray[np.float64]

_BUMPERS = (par.BUMPER, par.BUMPER + par.WIDTH)
RATES = [at + par.RATE for at in _BUMPERS]
"""Where the bumpers' rates of relaxation stand in the engine's vector."""


class Family(NamedTuple):
    """A rig and its forcing along one parameter."""

    parameter: Parameter
    oscillator: Oscillator
    excitation: Repeated
    value: float
    """The parameter where the family was made."""
    base: _Array
    direction: _Array
    """The engine's system vector is base + p · direction."""

    @property
    def states(self) -> int:
        """Components of a state: the isolator's memory is one only where it has any."""
        remembers = self.base[par.HYSTERETIC] or self.direction[par.HYSTERETIC]
        return PARAMETER if remembers else PARAMETER - 1

    @property
    def phase(self) -> float:
        """Forcing phase of the section, rad."""
        return self.excitation.phase

    @property
    def symmetric(self) -> bool:
        """Whether each motion's mirror image is a motion, all along."""
        here = self.oscillator.symmetric and self.excitation.half_wave
        return here and not self.parameter.name.startswith(("right_", "left_", "force"))

    def at(self, value: float) -> Setting:
        """The rig and its forcing at a value of the parameter."""
        return self.parameter.write(self.oscillator, self.excitation, value)

    def system(self, value: float) -> _Array:
        """The engine's vector at a value of the parameter."""
        vector = self.base.copy()
        moving = self.direction != 0.0
        vector[moving] += value * self.direction[moving]
        for at in _BUMPERS:
            if vector[at + par.KIND] == par.KELVIN_VOIGT and vector[at + par.BUMPER_DAMPING] > 0.0:
                rate = vector[at + par.BUMPER_STIFFNESS] / vector[at + par.BUMPER_DAMPING]
                vector[at + par.RATE] = rate
        return vector


def family(oscillator: Oscillator, excitation: Repeated, name: str) -> Family:
    """Prepare a rig for being followed along a parameter.

    Raises
    ------
    InputError
        If there is no such parameter, or the rig has none.
    """
    varied = followed(name, of=excitation.of).of(oscillator)
    value = varied.read(oscillator, excitation)
    step = varied.beside(value) - value
    here = system_vector(oscillator, excitation)
    there = system_vector(*varied.write(oscillator, excitation, value + step))
    # A rate follows from stiffness and damping, and is infinite without damping.
    here[RATES] = there[RATES] = np.inf
    same = here == there
    difference = np.subtract(there, here, out=np.zeros_like(here), where=~same)
    direction = difference / step
    if here[par.CURVED]:
        _check_straight(varied, oscillator, excitation, value, step, here, direction)
    base = np.subtract(here, value * direction, out=here.copy(), where=~same)
    return Family(varied, oscillator, excitation, value, base, direction)


def _check_straight(
    varied: Parameter,
    oscillator: Oscillator,
    excitation: Repeated,
    value: float,
    step: float,
    here: _Array,
    direction: _Array,
) -> None:
    """Refuse a parameter that no straight line in the engine's numbers follows.

    Raises
    ------
    InputError
        If there is one.
    """
    middle = system_vector(*varied.write(oscillator, excitation, value + 0.5 * step))
    middle[RATES] = np.inf
    moving = direction != 0.0
    along = here[moving] + 0.5 * step * direction[moving]
    if not np.allclose(middle[moving], along, rtol=1e-9, atol=0.0):
        raise InputError(
            f"parameter: {varied.name!r} is not followed under this law, in whose numbers it does "
            "not count in proportion; the frequency, the amplitude, a gap, a force or another "
            "stiffness or damping is accepted"
        )


def system_vector(oscillator: Oscillator, excitation: Repeated) -> _Array:
    """The engine's system vector."""
    rig = engine_rig(oscillator, excitation)
    vector = np.resize(rig, max(section_map.SYSTEM, len(rig)))
    vector[section_map.AMPLITUDE] = excitation.amplitude
    vector[section_map.FREQUENCY] = excitation.frequency
    return vector
