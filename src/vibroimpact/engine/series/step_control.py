"""One step from a state: numbers for its kernel, the shaking, and a length that is certified."""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import count, plane, stepped, value, wave
from vibroimpact.engine.forcing.several import raised
from vibroimpact.engine.jit import Vector, inlined, kernel, not_inlined
from vibroimpact.engine.linear.layout import RATE, SCALED_A, SCALED_W, WAVE_C, WAVE_S, H
from vibroimpact.engine.series.kernels import AGAIN, CALM, STRIDE, Slot, drags_any_power, lacks, run
from vibroimpact.engine.series.layout import (
    A_T,
    DEGREE,
    F_EXCESS,
    F_H,
    F_OWES,
    F_T,
    F_WEIGHT,
    F_X,
    FOUND,
    HEADER,
    LACKING,
    NAMES,
    NUMBERS,
    NUMBERS_UNIT,
    OVERFLOWED,
    SHAKEN,
    SHAKES,
    SHAKES_UNIT,
    UNIT,
    X,
    Z,
)
from vibroimpact.engine.series.step import BALANCED
from vibroimpact.engine.series.values import Frame, Laws
from vibroimpact.engine.state import Clock

ROUNDING = 2.0**-53
"""Of a number, as a share of it."""

_CUT = 100
"""How often a step is shortened at most. Far sooner it is so short that any is right."""

_LEAST_SHARE = 2.0**-10
"""To which a step is shortened at once at most."""

_GONE = 1e50
"""A motion of this size (m) was pushed away for ever and is about to leave the range of numbers."""

_FREE, _STOP = int(Slot.FREE), int(Slot.STOP)
_BOTH, _OTHER = int(Slot.BOTH), int(Slot.OTHER)
_ROOT = int(Slot.ROOT)
(
    _K, _C, _OFFSET, _CUBIC, _QUINTIC, _SINH, _STEEP, _HYSTERETIC, _SLOPE, _BEND, _DRAG, _POWER,
    _PUSH, _PUSH_N, _PUSH_CHI, _PUSH_C, _OTHER_K, _OTHER_N, _OTHER_CHI, _OTHER_C, _APART, _LOAD,
    _RATE, _WAY, _CLOSING, _SIDE, _PER_UNIT, _OWN_WEIGHT,
) = range(NUMBERS, NUMBERS + len(NAMES))  # fmt: skip


@kernel
def prepare(plan: Vector, rate: float) -> None:
    """Choose the unit of time, by a rate of the motion (1/s)."""
    unit = 1.0
    if rate > 0.0 and rate < 1e150:
        unit = 2.0 ** -math.floor(math.log2(rate))
    plan[UNIT] = unit
    plan[SHAKES_UNIT], plan[NUMBERS_UNIT] = 0.0, 0.0
    plan[Z + DEGREE] = 0.0
    plan[LACKING] = 1.0 if lacks(plan) else 0.0


@not_inlined
def tabulate(plan: Vector, unit: float) -> None:
    """Write what one sine or line is in a unit of time: even terms and odd ones."""
    plan[SHAKES_UNIT] = unit
    _, rate, closes, _, _ = wave(plan, 1, False)
    term = unit * unit
    for n in range(DEGREE):
        plan[SHAKES + n] = -term if n % 4 > 1 else term
        term *= rate * unit / (n + 1)
        if n == 1 and closes == 0.0:
            term = 0.0


@inlined
def shaken(plan: Vector, sign: float, clock: Clock, unit: float) -> tuple[float, float]:
    """What −sign A_t is now: factors of the even and the odd terms of its table."""
    s, c = clock
    if count(plan) == 1:
        if plan[SHAKES_UNIT] != unit:
            tabulate(plan, unit)
        amplitude, _, closes, sine, cosine = wave(plan, 1, False)
        amplitude *= -sign
        return amplitude * (sine * s + cosine * c), amplitude * (sine * c - closes * cosine * s)
    shake(plan, sign, clock, unit, SHAKES)
    return 1.0, 1.0


@not_inlined
def shake(plan: Vector, sign: float, clock: Clock, unit: float, into: int) -> None:
    """Write the series of −sign A_t, in units of time."""
    s, c = clock
    squared = unit * unit
    for n in range(DEGREE + 1):
        plan[into + n] = 0.0
    sn, cn = clock
    for part in range(1, count(plan) + 1):
        amplitude, rate, closes, sine, cosine = wave(plan, part, False)
        amplitude *= -sign * squared
        now = amplitude * (sine * sn + cosine * cn)
        after = amplitude * (sine * cn - closes * cosine * sn) * (rate * unit)
        turn = -closes * (rate * unit) * (rate * unit)
        for n in range(DEGREE):
            plan[into + n] += now
            now, after = after, turn * now / ((n + 1) * (n + 2))
        sn, cn = raised(s, c, sn, cn)


@not_inlined
def number_isolator(plan: Vector, unit: float) -> None:
    """Write the numbers of an isolator's forces that are the same in all modes."""
    squared = unit * unit
    plan[NUMBERS_UNIT] = unit
    plan[_CUBIC], plan[_QUINTIC] = plan[par.CUBIC] * squared, plan[par.QUINTIC] * squared
    plan[_SINH], plan[_STEEP] = plan[par.SINH] * squared, plan[par.SINH_RATE]
    plan[_HYSTERETIC] = plan[par.HYSTERETIC] * squared
    plan[_POWER] = plan[par.DRAG]
    plan[_PER_UNIT] = 1.0 / unit
    plan[_OWN_WEIGHT] = plan[par.OWN + par.OWN_PER_MASS] * squared


@inlined
def number(plan: Vector, frame: Frame, laws: Laws, unit: float) -> None:
    """Write the numbers of a mode's forces, in units of time."""
    squared = unit * unit
    branch, push, other, distance_between, drag = laws
    if plan[NUMBERS_UNIT] != unit:
        number_isolator(plan, unit)
    plan[_K], plan[_C] = frame.stiffness * squared, frame.damping * unit
    plan[_OFFSET] = frame.offset
    plan[_SLOPE], plan[_BEND] = branch.slope, branch.bend
    plan[_WAY], plan[_SIDE] = branch.way, branch.side
    _, rate, closes, _, _ = wave(plan, 1, False)
    plan[_RATE], plan[_CLOSING] = rate * unit, -closes * rate * unit
    plan[_LOAD] = (frame.load - branch.way * plan[par.FRICTION]) * squared
    plan[_DRAG] = 0.0
    if drag != 0.0:
        # A square is one of the velocity in units of time; any power is one of that in m/s, for a
        # high power of a unit may leave the range of numbers.
        plan[_DRAG] = drag * branch.way * (squared if drags_any_power(plan) else 1.0)
    if push.stiffness != 0.0 or other.stiffness != 0.0:
        plan[_APART] = distance_between
        for at, one in ((_PUSH, push), (_OTHER_K, other)):
            plan[at], plan[at + 1] = one.stiffness * squared, one.exponent
            plan[at + 2], plan[at + 3] = one.dissipation / unit, one.viscous * unit


@inlined
def slot_of(plan: Vector, laws: Laws, left: bool) -> int:
    """Which kernel has the stops that push, and the drag if it is not left out."""
    slot = _FREE
    if laws.push.stiffness != 0.0:
        alone = _STOP + STRIDE if left else _STOP
        slot = _BOTH if laws.other.stiffness != 0.0 else alone
    elif laws.other.stiffness != 0.0:
        slot = _OTHER
    if laws.drag == 0.0 and drags_any_power(plan):
        slot += CALM
    return slot


class StepClock(NamedTuple):
    """A frame's sign, the clock at a step's beginning, and the unit of time that it is written in.

    `per_unit` is its inverse; both are powers of two.
    """

    sign: float
    clock: Clock
    unit: float
    per_unit: float


@inlined
def excess_of(
    plan: Vector, by: StepClock, t: float, size: float, fine: float
) -> tuple[float, Clock]:
    """By how much a step is too long, if above 1; and the clock at its end, a time later.

    Its last terms must be small, and its end must obey the equation of motion: terms are blind to a
    power that begins beyond them, as z^30 from z = 0.
    """
    s, c = stepped(plan, by.clock[0], by.clock[1], t * by.unit)
    pulled = by.sign * value(plan, s, c) * (by.unit * by.unit) - plan[_LOAD]
    off = abs(plan[FOUND + F_OWES] + pulled * plan[FOUND + F_WEIGHT])
    # Of a size that is smaller than the displacement's own, the velocity must be right.
    whole = BALANCED * (size if fine > 1.0 else max(size, abs(plan[FOUND + F_X])))
    excess: float = plan[FOUND + F_EXCESS]
    if not off <= whole:
        excess = max(excess, off / whole)
        if not excess < math.inf:
            excess = math.inf
    return excess, (s, c)


@inlined
def lasts(plan: Vector, slot: int, h: float) -> float:
    """How long a step takes: in a root the time is not the variable."""
    return plan[FOUND + F_T] if slot >= _ROOT else h


@not_inlined
def shortened(
    plan: Vector, slot: int, excess: float, by: StepClock, h: float, size: float, fine: float
) -> tuple[float, Clock]:
    """Shorten the step in hand until it is right; return its length and the clock there.

    `fine` is by how much smaller `size` is than the motion's, if above 1.
    """
    after = by.clock
    for _ in range(_CUT):
        share = _LEAST_SHARE
        if excess < math.inf:
            share = max(0.9 * excess ** (-1.0 / (DEGREE - 1)), share)
        h *= share
        run(plan, slot + AGAIN, 0.0, 0.0, 0.0, size, h, 0.0, 0.0)
        excess, after = excess_of(plan, by, lasts(plan, slot, h), size, fine)
        if excess <= 1.0 or not size < _GONE:
            return h, after
    plan[LACKING] = 1.0 if excess < math.inf else OVERFLOWED
    return h, after


@inlined
def certified_step(
    plan: Vector,
    slot: int,
    x: float,
    v: float,
    z: float,
    by: StepClock,
    size: float,
    fine: float,
    longest: float,
) -> tuple[float, Clock]:
    """Write the series of a step and what is at its end; return its length and the clock there.

    If `fine` is above 1, it may be off by that share of `size` only.
    """
    if fine > 1.0:
        size /= fine
    now, after = shaken(plan, by.sign, by.clock, by.unit)
    run(plan, slot, x, v, z, size, longest, now, after)
    plan[FOUND + A_T] = -math.inf
    h: float = plan[FOUND + F_H]
    excess, there = excess_of(plan, by, lasts(plan, slot, h), size, fine)
    if not excess <= 1.0 and size < _GONE:
        h, there = shortened(plan, slot, excess, by, h, size, fine)
    return h, there


@kernel
def scale(plan: Vector, reach: float, hysteretic: bool) -> None:
    """Turn series in units of time into series in steps."""
    power = 1.0
    for n in range(DEGREE + 1):
        plan[X + n] *= power
        if hysteretic:
            plan[Z + n] *= power
        power *= reach


@kernel
def hold_still(
    plan: Vector, frame: Frame, x: float, z: float, clock: Clock, length: float
) -> float:
    """Write the series of a mass that is held, for so many seconds; return them."""
    shake(plan, frame.sign, clock, length, SHAKEN)
    plan[SHAKEN] += frame.load * length * length
    for n in range(DEGREE + 1):
        plan[X + n], plan[Z + n] = 0.0, 0.0
    plan[X], plan[Z] = x, z
    return length


@kernel
def write_header(plan: Vector, h: float, mirrored: bool) -> None:
    """Write the header of pieces of this length, as a table's, mirrored or not."""
    for n in range(1, count(plan) + 1):
        part = wave(plan, n, mirrored)
        there = HEADER + plane(plan, n)
        plan[there + H], plan[there + RATE] = h, 1.0 / h
        plan[there + SCALED_W] = part.rate * h
        plan[there + SCALED_A] = part.amplitude * h * h
        plan[there + WAVE_S] = plan[there + SCALED_A] * part.sine
        plan[there + WAVE_C] = plan[there + SCALED_A] * part.cosine


@kernel
def at(plan: Vector, series: int, y: float) -> tuple[float, float]:
    """Value and slope of a step's series at y."""
    p = plan[series + DEGREE]
    p1 = 0.0
    for n in range(DEGREE - 1, -1, -1):
        p1 = p1 * y + p
        p = p * y + plan[series + n]
    return p, p1
