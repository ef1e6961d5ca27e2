"""How the forces of a mode change with its state: series over the step in hand, from its formula.

A `Dual` is a number or a series with its derivatives. The formulas of the laws, run with these,
give the slopes by which disturbances grow, and what the stops push with.
"""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import parameters as par
from vibroimpact.engine.series import layout as at
from vibroimpact.engine.series import program
from vibroimpact.engine.series.algebra import Rate, Series, Shifted, StateSeries
from vibroimpact.engine.series.functions import tanh
from vibroimpact.engine.series.laws import drag, hysteresis
from vibroimpact.engine.series.step import LAWS, LawNumbers, Shape, isolator, memory, pushes

_TIMES = {
    "stiffness": 2, "damping": 1, "cubic": 2, "quintic": 2, "sinh": 2, "hysteretic": 2,
    "drag": 2, "push": 2, "push_dissipation": -1, "push_viscous": 1,
    "other": 2, "other_dissipation": -1, "other_viscous": 1,
    "per_unit": -1, "own_weight": 2,
}  # fmt: skip
"""Which power of the step's length takes a number in units of time to one in steps: of a drag
unless it is the square's."""


def times(one: Any, other: Any) -> Any:
    """Multiply, without a product by 1."""
    if isinstance(one, float) and one == 1.0:
        return other
    return one if isinstance(other, float) and other == 1.0 else one * other


class Dual:
    """A number or a series, and its derivatives by some quantities, by their names."""

    def __init__(self, value: Any, by: dict[str, Any]) -> None:
        self.value, self.by = value, by

    def scaled(self, value: Any, slope: Any) -> Dual:
        """Return a function of this, by its value and its derivative."""
        return Dual(value, {name: times(slope, one) for name, one in self.by.items()})

    def __add__(self, other: Any) -> Dual:
        if not isinstance(other, Dual):
            return Dual(self.value + other, self.by)
        by = dict(self.by)
        for name, one in other.by.items():
            by[name] = by[name] + one if name in by else one
        return Dual(self.value + other.value, by)

    def __neg__(self) -> Dual:
        return self.scaled(-self.value, -1.0)

    def __sub__(self, other: Any) -> Dual:
        difference: Dual = self + -other
        return difference

    def __rsub__(self, other: Any) -> Dual:
        difference: Dual = -self + other
        return difference

    def __mul__(self, other: Any) -> Dual:
        if not isinstance(other, Dual):
            return self.scaled(self.value * other, other)
        mine = self.scaled(self.value * other.value, other.value)
        return mine + Dual(0.0, other.scaled(0.0, self.value).by)

    def __pow__(self, exponent: int) -> Dual:
        slope = times(self.value ** (exponent - 1), float(exponent))
        return self.scaled(self.value**exponent, slope)

    __radd__, __rmul__ = __add__, __mul__


class Varying(LawNumbers):
    """As `LawNumbers`, for formulas that are run with `Dual`."""

    def exp(self, one: Any) -> Any:
        """Return e to the power of a number or a series."""
        if not isinstance(one, Dual):
            return super().exp(one)
        value = super().exp(one.value)
        return one.scaled(value, value)

    def power(self, one: Any, exponent: Any) -> Any:
        """Return a to the power of b."""
        if not isinstance(one, Dual):
            return super().power(one, exponent)
        lower = super().power(one.value, exponent - 1.0)
        return one.scaled(lower * one.value, lower * exponent)

    def tanh(self, one: Any) -> Any:
        """Return the hyperbolic tangent of a number or a series."""
        return one.scaled(*tanh(self._machine, one.value))

    def inverse(self, one: Any) -> Any:
        """Return 1 over a number or a series."""
        if not isinstance(one, Dual):
            return super().inverse(one)
        value = super().inverse(one.value)
        return one.scaled(value, -(value * value))

    def sine(self, one: Any) -> Any:
        """Return the sine of a number or a series."""
        return one.scaled(super().sine(one.value), super().cosine(one.value))

    def cosine(self, one: Any) -> Any:
        """Return the cosine of a number or a series."""
        return one.scaled(super().cosine(one.value), -super().sine(one.value))


class Steps(Varying):
    """The numbers of a mode's forces in units of a step, and functions for `Dual`."""

    def __init__(self, machine: Any, h: Any, square: bool) -> None:
        super().__init__(machine)
        self._powers = {0: 1.0, 1: h, 2: h * h, -1: 1.0 / h}
        self._times = {**_TIMES, "drag": 0} if square else _TIMES

    def __getattr__(self, name: str) -> Any:
        if name not in self._loaded:
            number = super().__getattr__(name)
            self._loaded[name] = number * self._powers[self._times.get(name, 0)]
            if name.endswith("_dissipation"):
                self._loaded[name] = Dual(self._loaded[name], {name: 1.0})
        return self._loaded[name]


def slopes(machine: Any, shape: Shape) -> None:
    """Write the slopes of a mode's forces and what its stops push with, in units of a step.

    The argument in place of the longest step is the length of that in hand.
    """
    degree = at.DEGREE
    law = Steps(machine, machine.arguments[4], shape.laws[LAWS.index(drag)] == (2,))
    along = StateSeries(machine, [machine.load(at.X + n) for n in range(degree + 1)])
    rate = Rate(along)
    x, v, z = Dual(along, {"x": 1.0}), Dual(rate, {"v": 1.0}), Dual(0.0, {})
    if shape.laws[LAWS.index(hysteresis)]:
        z = Dual(StateSeries(machine, [machine.load(at.Z + n) for n in range(degree)]), {"z": 1.0})
    u = Dual(Shifted(along, along[0] + law.offset), x.by)
    stops = pushes(law, shape, x, v)
    total = Dual(0.0, {"x": law.stiffness, "v": law.damping})
    for force in [*isolator(law, shape, u, v, z), *stops]:
        total = total + Dual(0.0, force.by)
    outputs = {at.BY_X: total.by["x"], at.BY_V: total.by["v"]}
    names = ("push", "other") if shape.push else ("other",)
    for name, push in zip(names, stops, strict=False):
        i = at.ROOM * ("push", "other").index(name)
        outputs[at.PUSH + i] = push.value if name == "push" else -push.value
        chi = f"{name}_dissipation"
        if chi in push.by:
            outputs[at.BY_CHI + i] = times(push.by[chi], getattr(law, chi).value)
    flow = memory(law, shape, u, v, z)
    if flow is not None:
        outputs[at.BY_Z], outputs[at.BY_Z_OF_Z] = flow.by["v"], -flow.by.get("z", 0.0)
    for place in (at.BY_X, at.BY_V, at.BY_CHI, at.BY_CHI + at.ROOM, at.BY_Z, at.BY_Z_OF_Z):
        outputs.setdefault(place, 0.0)
    for place, one in outputs.items():
        for n in range(degree + 1):
            if n == degree:
                machine.store(place + n, 0.0)
            elif isinstance(one, Series):
                machine.store(place + n, one[n])
            else:
                machine.store(place + n, 0.0 if n else one)


def valued(machine: Any, shape: tuple[int, tuple[int, ...]]) -> None:
    """Write the force of a formula and its slopes, per unit mass.

    The arguments are displacement or deformation, velocity, and the signs of both.
    """
    which, symbols = shape
    u, v, _, side, way, *_ = machine.arguments
    law = Varying(machine)
    moved = Dual(u, {"u": 1.0}), Dual(v, {"v": 1.0})
    force = program.evaluate(law, symbols, which, *moved, (side, way))
    per_mass = law.formula_number(par.OWN + par.OWN_PER_MASS)
    for i, one in enumerate((force.value, force.by.get("u", 0.0), force.by.get("v", 0.0))):
        machine.store(at.OWN_FORCE + i, one * per_mass)


def event_series(machine: Any, shape: tuple[int, tuple[int, ...]]) -> None:
    """Write the series of a stop's formula over the step in hand, in steps, to ASKED.

    The deformation is `level` + `facing` x. The series of x are in units of time.
    """
    which, symbols = shape
    level, facing, _, _, h, way, _ = machine.arguments
    law = LawNumbers(machine)
    along = StateSeries(machine, [machine.load(at.X + n) for n in range(at.DEGREE + 1)])
    rate = Rate(along) * (law.per_unit * facing)
    force = program.evaluate(law, symbols, which, along * facing + level, rate, (1.0, way))
    power = 1.0
    for n in range(at.DEGREE):
        machine.store(at.ASKED + n, force[n] * power)
        power = power * h
    machine.store(at.ASKED + at.DEGREE, 0.0)
