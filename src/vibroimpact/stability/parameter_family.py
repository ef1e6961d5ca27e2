"""A rig and its forcing along one parameter: what a branch of orbits is followed in.

Nearly each parameter moves the rig's numbers along a straight line, so that the engine needs only
where the line begins and where it goes; of the others, such as a yield force, it is given the line
that touches where it is.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout
from vibroimpact.engine.section_map import AMPLITUDE, FREQUENCY
from vibroimpact.model import Oscillator, Repeated
from vibroimpact.model.parameters import Parameter, parameter
from vibroimpact.model.periodic_shaking import as_periodic
from vibroimpact.model.rig import Rig
from vibroimpact.model.units import pretty
from vibroimpact.model.written_units import written_for
from vibroimpact.response.engine_system import EngineSystem, engine_system, system_vector

_Array = NDArray[np.float64]

_BUMPERS = (par.BUMPER, par.BUMPER + par.WIDTH)
RATES = [at + par.RATE for at in _BUMPERS]
"""Where the bumpers' rates of relaxation stand in the engine's vector."""

_CURVED = (par.CUBIC, par.QUINTIC, par.SINH, par.HYSTERETIC, par.KNEE, par.TURNING, par.DAMPING)
"""Numbers of curved laws that are absent where they are 0."""

_TOUCH = 0.01
"""Of the step to a neighbouring value, by which a touching line is made."""


class Family(NamedTuple):
    """A rig and its forcing along one parameter."""

    parameter: Parameter
    rig: Rig
    value: float
    """The parameter where the family was made."""
    base: _Array
    direction: _Array
    """The engine's system vector is base + p · direction, here at least."""
    straight: bool = True
    """Whether it is so at any p."""
    uneven: bool = False
    """Whether the parameter makes an assembly its own mirror image at one value only."""

    @property
    def oscillator(self) -> Oscillator:
        """What vibrates, if it has one mass."""
        return self.rig.oscillator

    @property
    def layout(self) -> EngineSystem:
        """How states stand in vectors and points."""
        return engine_system(self.rig.system)

    @property
    def excitation(self) -> Repeated:
        """What shakes it."""
        return self.rig.periodic

    def written(self, value: float, digits: int = 6) -> str:
        """Return a value of the parameter as text, with its unit unless the rig has none."""
        with written_for(self.rig):
            return pretty(value, self.parameter.quantity, digits)

    def equation(self, value: float, digits: int = 6) -> str:
        """Return the parameter and its value as text, such as ``"gap = 5 mm"`` or ``"ω = 2"``."""
        text = self.written(value, digits)
        return text if "=" in text else f"{self.parameter.name} = {text}"

    def near(self, value: float) -> Family:
        """The same family with the line that touches at a value of the parameter."""
        if self.straight:
            return self
        step = _TOUCH * (self.parameter.beside(value) - value)
        here, on, back = (_vector(self, value + way * step) for way in (0, 1, -1))
        moves = on != back  # what does not may be infinite
        direction = np.subtract(on, back, out=np.zeros_like(here), where=moves) / (2.0 * step)
        base = np.subtract(here, value * direction, out=here.copy(), where=moves)
        return self._replace(base=base, direction=direction)

    def with_phase(self, phase: float) -> Family:
        """Return the family at another forcing phase of the section."""
        turned = self.rig.periodic.replace(phase=phase)
        return self._replace(rig=self.rig.with_parts(self.rig.system, turned))

    @property
    def one_flow(self) -> bool:
        """Whether the engine's numbers move in proportion, and one flow carries all rigs."""
        if self.of_several_masses:
            return self.straight
        return self.straight and not any(self.direction[at + par.GAP] for at in _BUMPERS)

    @property
    def of_several_masses(self) -> bool:
        """Whether what vibrates is an assembly."""
        return self.rig.system.by_mass

    @property
    def forcing(self) -> tuple[int, int]:
        """Where a system vector has its amplitude and its frequency."""
        if self.of_several_masses:
            return len(self.base) - 2, len(self.base) - 1
        return AMPLITUDE, FREQUENCY

    @property
    def states(self) -> int:
        """Components of a state: the isolator's memory is one only where it has any."""
        if self.of_several_masses:
            return self.layout.parts
        remembers = self.base[par.HYSTERETIC] or self.direction[par.HYSTERETIC]
        return self.layout.parts - (0 if remembers else 1)

    @property
    def phase(self) -> float:
        """Forcing phase of the section, rad."""
        return self.rig.periodic.phase

    @property
    def symmetric(self) -> bool:
        """Whether each motion's mirror image is a motion, all along."""
        if self.of_several_masses:
            alike = self.base[layout.SYMMETRIC] == 1.0 and not self.direction[layout.SYMMETRIC]
            return bool(alike and self.rig.periodic.half_wave)
        here = self.rig.oscillator.symmetric and self.rig.periodic.half_wave
        return here and not (self.parameter.sides or self.parameter.name == "force")

    def at(self, value: float) -> Rig:
        """The rig at a value of the parameter."""
        return self.parameter.vary(self.rig, value)

    def system(self, value: float) -> _Array:
        """The engine's vector at a value of the parameter."""
        if not self.straight:
            return numbers(self.at(value), self.uneven)
        vector = self.base.copy()
        moving = self.direction != 0.0
        vector[moving] += value * self.direction[moving]
        if self.of_several_masses:
            _complete(vector)
            return vector
        for at in _BUMPERS:
            if vector[at + par.KIND] == par.KELVIN_VOIGT and vector[at + par.BUMPER_DAMPING] > 0.0:
                rate = vector[at + par.BUMPER_STIFFNESS] / vector[at + par.BUMPER_DAMPING]
                vector[at + par.RATE] = rate
        return vector

    def flow_rig(self, value: float) -> _Array:
        """Return the engine's vector whose flow carries the rigs beside a value of the parameter.

        It differs from `system` only at a value at which a curved law vanishes or becomes simpler:
        the flow of that rig would lack what the rigs beside it need.
        """
        vector = self.system(value)
        if not self.of_several_masses and vector[par.CURVED]:
            vanishing = [at for at in _CURVED if self.direction[at] and vector[at] == 0.0]
            vector[vanishing] = np.finfo(float).tiny
            if self.direction[par.DRAG] and vector[par.DRAG] in (1.0, 2.0):
                vector[par.DRAG] = np.nextafter(vector[par.DRAG], np.inf)
        return vector


def family(rig: Rig, name: str) -> Family:
    """Prepare a rig for being followed along a parameter.

    Raises
    ------
    InputError
        If there is no such parameter, or the rig has none.
    """
    as_periodic(rig.shaking, "shaking")  # refuses a record
    engine_system(rig.system).check_size()
    varied = parameter(name, rig)
    value = varied.read(rig)
    step = varied.beside(value) - value
    here = system_vector(rig)
    there = system_vector(varied.vary(rig, value + step))
    uneven = False
    if rig.system.by_mass:
        uneven = bool(here[layout.SYMMETRIC] != there[layout.SYMMETRIC])
        for vector in (here, there):
            _make_plain(vector, uneven)
    else:
        # A rate follows from stiffness and damping, and is infinite without damping.
        here[RATES] = there[RATES] = np.inf
    same = here == there
    difference = np.subtract(there, here, out=np.zeros_like(here), where=~same)
    direction = difference / step
    base = np.subtract(here, value * direction, out=here.copy(), where=~same)
    made = Family(varied, rig, value, base, direction, uneven=uneven)
    return made._replace(straight=_straight(made, step))


def _straight(made: Family, step: float) -> bool:
    """Whether the engine's numbers move in proportion to the parameter."""
    middle = made.value + 0.5 * step
    return np.allclose(_vector(made, middle), made.base + middle * made.direction, 1e-9, 0.0)


def _vector(made: Family, value: float) -> _Array:
    """The engine's vector; rates follow from stiffness and damping, and move along no line."""
    vector = system_vector(made.at(value))
    if made.of_several_masses:
        _make_plain(vector, made.uneven)
    else:
        vector[RATES] = made.base[RATES]
    return vector


def numbers(rig: Rig, uneven: bool) -> _Array:
    """Return the engine's vector, of an assembly that is its own mirror image by chance or not."""
    vector = system_vector(rig)
    if rig.system.by_mass and uneven:
        make_uneven(vector)
    return vector


def _make_plain(vector: _Array, uneven: bool) -> None:
    """Take out of an assembly's vector what follows from the rest, and moves along no line."""
    _of_stops(vector)[:, layout.RELAXATION] = np.inf
    if uneven:
        make_uneven(vector)


def make_uneven(vector: _Array) -> None:
    """Take out of an assembly's vector that it is its own mirror image."""
    vector[layout.SYMMETRIC] = 0.0
    _of_stops(vector)[:, layout.PARTNER] = -1.0


def _of_stops(vector: _Array) -> _Array:
    """Return the numbers of the stops of an assembly's vector, a row each, to be written to."""
    first, count = int(vector[layout.STOP]), int(vector[layout.STOPS])
    return vector[first : first + count * layout.STOP_WIDTH].reshape(count, layout.STOP_WIDTH)


def _complete(vector: _Array) -> None:
    """Put right what follows from the numbers of an assembly, as `flow.complete` does."""
    n, stops = int(vector[layout.MASSES]), _of_stops(vector)
    dashpot, spring = stops[:, layout.STOP_DAMPING], stops[:, layout.STOP_STIFFNESS]
    rates = np.full(len(stops), np.inf)
    stops[:, layout.RELAXATION] = np.divide(spring, dashpot, out=rates, where=dashpot > 0.0)
    stops[stops[:, layout.KIND] == layout.LINK, layout.RELAXATION] = 0.0
    sums = int(vector[layout.ROW_SUMS])
    for i, block in enumerate((layout.STIFFNESS, layout.DAMPING)):
        first = int(vector[block])
        rows = vector[first : first + n * n].reshape(n, n)
        vector[sums + i * n : sums + (i + 1) * n] = np.abs(rows).sum(axis=1)
