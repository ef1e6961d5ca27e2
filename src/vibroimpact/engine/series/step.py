"""One Taylor step, as a formula: the series of the motion about a state, and where it ends.

The equation of motion, x″ = shaken − stiffness x − damping x′ − laws(x + offset, x′, z), gives each
coefficient from those before it. The step's length is known from coefficients some orders before
the last; that it holds is certified at its end by the last ones and by the equation itself.
"""

from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

from vibroimpact.engine.series import layout as at
from vibroimpact.engine.series import program
from vibroimpact.engine.series.algebra import Rate, Series, Shifted, StateSeries
from vibroimpact.engine.series.code_generation import LANES
from vibroimpact.engine.series.functions import cosine, exponential, power, sine, tanh
from vibroimpact.engine.series.laws import contact, drag, hysteresis, own, polynomial
from vibroimpact.engine.series.laws import exponential as hardening
from vibroimpact.engine.series.step_ends import (
    Along,
    along_of,
    end_of,
    memory_end,
    sums,
)
from vibroimpact.engine.series.summation import tree

EARLY = 6
"""How many coefficients before the last the length of a step is known: the rest of the step's code
need not wait for the last."""

TOLERANCE = 2.0**-55
"""What the last terms may be, as a share of the motion's size."""

LAST = 8.0
"""How many times that they may be where the length had to be guessed."""

BALANCED = 2.0**-46
"""What may be missing from the equation of motion at the step's end, as a share of the motion's
size. It grows with the 19th power of the time or faster, so that the step's end is off by less than
a 400th of it."""

ROUNDING = 2.0**-53

LAWS = (polynomial, hardening, hysteresis, drag, own)
"""Of isolators."""


class Shape(NamedTuple):
    """What a kernel is made for: of each of `LAWS` what it has, and the curved stops that push.

    `push` and `other` are 0 for none, 1 for k δⁿ (1 + χ δ′), 2 with a viscous part, and for a
    formula its side and its operations.
    """

    laws: tuple[tuple[Any, ...], ...]
    push: Any = 0
    other: Any = 0


class LawNumbers:
    """The numbers of a mode's forces by name, and functions for formulas."""

    def __init__(self, machine: Any) -> None:
        self._machine = machine
        self._loaded: dict[str, Any] = {}

    def __getattr__(self, name: str) -> Any:
        if name not in self._loaded:
            self._loaded[name] = self._machine.load(at.NUMBERS + at.NAMES.index(name))
        return self._loaded[name]

    def exp(self, one: Any) -> Any:
        """Return e to the power of a number or a series."""
        return exponential(self._machine, one)

    def power(self, one: Any, exponent: Any) -> Any:
        """Return a to the power of b."""
        return power(self._machine, one, exponent)

    def inverse(self, one: Any) -> Any:
        """Return 1 over a number or a series."""
        return 1.0 / one

    def sine(self, one: Any) -> Any:
        """Return the sine of a number or a series."""
        return sine(self._machine, one)

    def cosine(self, one: Any) -> Any:
        """Return the cosine of a number or a series."""
        return cosine(self._machine, one)

    def tanh(self, one: Any) -> Any:
        """Return the hyperbolic tangent of a number or a series."""
        return tanh(self._machine, one)[0]

    def size_of(self, one: Any, sign: Any) -> Any:
        """Return the absolute value of a number or a series of a sign."""
        return sign * one

    def formula_number(self, place: int) -> Any:
        """Return a number of a user's formula, by its place in the rig's vector."""
        return self._machine.load(place)


def isolator(law: LawNumbers, shape: Any, u: Any, v: Any, z: Any) -> list[Any]:
    """What the laws of an isolator pull back with, each."""
    pairs = zip(LAWS, shape.laws, strict=True)
    return [module.force(law, part, u, v, z) for module, part in pairs if part]


def memory(law: LawNumbers, shape: Any, u: Any, v: Any, z: Any) -> Any:
    """z′, or None where an isolator has no memory."""
    part = shape.laws[LAWS.index(hysteresis)]
    return hysteresis.flow(law, part, u, v, z) if part else None


def pushes(law: LawNumbers, shape: Shape, x: Any, v: Any) -> list[Any]:
    """What stops push with that follow a power of their deformation."""
    forces = []
    if shape.push:
        forces.append(contact.force(law, "push", shape.push, x, v))
    if shape.other:
        forces.append(-contact.force(law, "other", shape.other, law.apart - x, -v))
    return forces


def begun(machine: Any, shape: Shape) -> None:
    """Write the series of a step from (x, x′, z), and the values at its end.

    The arguments are the state, the motion's size, how long the step may be, and what the shaking
    is now: that of its table's even terms, and that of the odd ones.
    """
    x, v, z, size, longest, now, after = machine.arguments
    law = LawNumbers(machine)
    degree = at.DEGREE
    last = degree - EARLY
    along, memo = StateSeries(machine, [x, v]), StateSeries(machine, [z])
    rate = Rate(along)
    u = Shifted(along, x + law.offset)
    forces = isolator(law, shape, u, rate, memo) + pushes(law, shape, along, rate)
    flow = memory(law, shape, u, rate, memo)
    stiffness, damping, hold = law.stiffness, law.damping, None
    for force in forces:
        stiffness = added(stiffness, force.slopes.get(along))
        damping = added(damping, force.slopes.get(rate))
        hold = added(hold, force.slopes.get(memo))
    machine.store(at.X, x)
    machine.store(at.X + 1, v)
    if flow is not None:
        machine.store(at.Z, z)
        machine.store(at.Z + degree, 0.0)  # which a step in a root has written
    stiffness, damping, hold = -stiffness, -damping, hold if hold is None else -hold
    h = None
    for n in range(degree - 1):
        share = 1.0 / ((n + 1) * (n + 2))
        total = machine.load(at.SHAKES + n) * (after if n % 2 else now)
        if n == 0:
            total = total + law.load
            # All at once: what is linear in the state is not taken apart.
            for force in forces:
                total = machine.fma(force[0], -1.0, total)
            total = machine.fma(-law.stiffness, x, total)
            new = machine.fma(-law.damping * (1.0 / (n + 2)), v, total * share)
        else:
            total = machine.fma(stiffness, along[n], total)
            for force in forces:
                total = force.add_older(n, total, -1.0)
            new = total * share
            if hold is not None:
                new = machine.fma(hold * share, memo[n], new)
            new = machine.fma(damping * (1.0 / (n + 2)), along[n + 1], new)
        if flow is not None:
            if n == 0:
                made = flow[0]
            else:
                by = 1.0 / (n + 1)
                made = flow.add_older(n, 0.0, by)
                for newest, slope in flow.slopes.items():
                    if newest is not rate:
                        made = machine.fma(slope * by, newest[n], made)
                if rate in flow.slopes:
                    made = machine.fma(flow.slopes[rate], along[n + 1], made)
            memo.coefficients.append(made)
            machine.store(at.Z + n + 1, made)
        along.coefficients.append(new)
        machine.store(at.X + n + 2, new)
        if n + 2 == last:
            h = reach(machine, along, memo if flow is not None else None, size, last)
            h = machine.least(h, longest)
    memo.coefficients.append(0.0)
    ended(machine, shape, law, along, memo if flow is not None else None, h, size)


def added(one: Any, other: Any) -> Any:
    """Add two numbers, either of which may be missing."""
    return other if one is None else one if other is None else one + other


def reach(machine: Any, along: Series, memo: Any, size: Any, last: int) -> Any:
    """How far the series reach, by two coefficients: (size/|a_m|)^(1/m) TOLERANCE^(1/degree)."""
    whole = machine.bits(size)

    def radius(m: int) -> Any:
        one = machine.absolute(along[m])
        if memo is not None:
            one = one + machine.absolute(memo[m - 1])
        share = math.log2(TOLERANCE) / at.DEGREE + 1023.0
        return machine.fma(
            machine.bits(one), -1.0 / m, machine.fma(whole, 1.0 / m, share * 2.0**52)
        )

    return machine.of_bits(machine.least(radius(last), radius(last - 1)))


def again(machine: Any, shape: Shape) -> None:
    """Find the end of the series in hand at another time."""
    size, h = machine.arguments[3:5]
    along = StateSeries(machine, [machine.load(at.X + n) for n in range(at.DEGREE + 1)])
    memo = None
    if shape.laws[LAWS.index(hysteresis)]:
        memo = StateSeries(machine, [machine.load(at.Z + n) for n in range(at.DEGREE)])
        memo.coefficients.append(0.0)
    ended(machine, shape, LawNumbers(machine), along, memo, h, size)


def memory_off(
    machine: Any, shape: Any, off: Any, moved: Any, ends: tuple[Any, Any]
) -> tuple[Any, Any]:
    """By how much the memory's equation is missed, and how large the memory is on the step."""
    exponent = shape.laws[LAWS.index(hysteresis)][0]
    rounding = machine.absolute(moved) * (4.0 * ROUNDING * max(exponent, 1))
    extent = machine.most(machine.absolute(ends[0]), machine.absolute(ends[1]))
    return machine.absolute(off) / (machine.fma(extent, BALANCED, rounding) + 1e-300), extent


def ended(
    machine: Any, shape: Shape, law: LawNumbers, along: Series, memo: Any, h: Any, size: Any
) -> None:
    """Write the values at the end of a step."""
    degree = at.DEGREE
    step = along_of(machine, h)
    totals = sums(machine, along, step.reached)
    x, v = end_of(machine, totals, along[0], step)
    highest = h
    for _ in range(4):  # h¹⁶
        highest = highest * highest
    almost = highest * (h * h) * h
    last = machine.absolute(along[degree] * h)
    last = machine.most(last, machine.absolute(along[degree - 1]) * 0.5)
    z, missing = 0.0, None
    u = x + law.offset
    if memo is not None:
        kept = sums(machine, memo, step.reached)
        z = memory_end(machine, kept, memo[0], step)
        last = machine.most(last, machine.absolute(memo[degree - 1]) * 0.5)
        off = kept.rate - memory(law, shape, u, v, z) * h
        missing, _ = memory_off(machine, shape, off, v * h, (memo[0], z))
    pull = machine.fma(law.stiffness, x, law.damping * v)
    depth = x
    if shape.push or shape.other:
        depth = machine.most(machine.least(x, law.apart) if shape.other else x, 0.0)
    pull = tree(
        [
            pull,
            *isolator(law, shape, u, past(machine, shape, law, v), z),
            *pushes(law, shape, depth, v),
        ]
    )
    whole = machine.most(size, machine.absolute(x))
    excess = (last * almost) * ((1.0 / (LAST * TOLERANCE)) / whole)
    if missing is not None:
        excess = machine.most(missing, excess)
    bent = bends_of(machine, shape, law, along, step)
    if bent is not None:
        excess = machine.most(overbent(bent), excess)
    machine.store(at.FOUND + at.F_EXCESS, excess)
    machine.store(at.FOUND + at.F_OWES, machine.fma(pull, h * h, totals.gain))
    machine.store(at.FOUND + at.F_WEIGHT, h * h)


def overbent(bent: Any) -> Any:
    """By how much a step is too long that passes so much of a bend; its inverse shortens it."""
    square = bent * bent
    eighth = square * square * (square * square)
    return eighth * eighth * square * bent  # its 19th power


def points_of(machine: Any, along: Series, step: Along) -> list[tuple[Any, Any]]:
    """Where a step begins, and how far its coordinate and the rate of that may go, each way."""
    far: Any = None
    fast: Any = None
    for i, powers_of_h in enumerate(step.reached):
        orders = [LANES * i + j + 1 for j in range(LANES)]
        sizes = (machine.lanes([along[n] for n in orders]) * powers_of_h).absolute()
        far = sizes if far is None else far + sizes
        fast = sizes.times([n if n > 1 else 0 for n in orders], fast)  # the first is the rate now
    x, v = along[0], along[1]
    move, speed = far.total(), fast.total() * step.inverse
    return [(x, v), (x + move, v), (x - move, v), (x, v + speed), (x, v - speed)]


def bends_of(machine: Any, shape: Shape, law: LawNumbers, along: Series, step: Along) -> Any:
    """By how much users' formulas may bend on a step, over what a series shows; None if nowhere."""
    own_law = shape.laws[LAWS.index(own)]
    if not own_law and not any(isinstance(one, tuple) for one in (shape.push, shape.other)):
        return None
    points = points_of(machine, along, step)
    bends = []
    if own_law:
        at_points = [(one + law.offset, rate * law.per_unit) for one, rate in points]
        bends.append(program.bends(machine, law, own_law, 0, at_points))
    for kind, facing in ((shape.push, 1.0), (shape.other, -1.0)):
        if not isinstance(kind, tuple):
            continue
        at_points = [
            (
                machine.most(one if facing > 0.0 else law.apart - one, 0.0),
                rate * law.per_unit * facing,
            )
            for one, rate in points
        ]
        bends.append(program.bends(machine, law, kind[1], kind[0], at_points))
    some = [one for one in bends if one is not None]
    return functools.reduce(machine.most, some) if some else None


def past(machine: Any, shape: Shape, law: LawNumbers, v: Any) -> Any:
    """The velocity at the end, none behind a turn: powers that are not whole end there."""
    if shape.laws[LAWS.index(drag)] == (0,):
        return law.way * machine.most(law.way * v, 0.0)
    return v
