"""One Taylor step: the series of the motion about a state, and how far they reach.

The equation of motion, x″ = load − stiffness x − damping x′ − law(x + offset, x′, z) − sign A_t
with z′ = x′ (slope − bend zⁿ), gives each coefficient from those before it. All are written in
y = t/step, so that they reach from 0 to 1.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import count, plane, wave
from vibroimpact.engine.forcing.several import raised
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.layout import MOST, RATE, SCALED_A, SCALED_W, WAVE_C, WAVE_S, H
from vibroimpact.engine.motion import Clock
from vibroimpact.engine.taylor.frame import Branch, Frame, Push
from vibroimpact.engine.taylor.layout import (
    BENT,
    CUBE,
    DEGREE,
    DRAG,
    FALLING,
    FIFTH,
    HEADER,
    POWERS,
    PRESSED,
    PUSH,
    RISING,
    ROOM,
    SHAKEN,
    SPEED,
    SQUARE,
    U,
    X,
    Z,
)

_TOLERANCE = 2.0**-57
"""What the last terms may be, as a share of the motion's size: below rounding, 2**-53."""

_FARTHEST = 6.0  # units of time; a motion that rests has no rate of its own


@inlined
def convolved(plan: Vector, a: int, b: int, n: int) -> float:
    """Coefficient n of the product of two series."""
    even = 0.0
    odd = 0.0
    for j in range(0, n, 2):
        even += plan[a + j] * plan[b + n - j]
        odd += plan[a + j + 1] * plan[b + n - j - 1]
    if n % 2 == 0:
        even += plan[a + n] * plan[b]
    return even + odd


@inlined
def pushed(plan: Vector, a: int, n: int) -> float:
    """Coefficient n of the product of a series and x′."""
    even = 0.0
    odd = 0.0
    for j in range(0, n, 2):
        even += plan[a + n - j] * ((j + 1) * plan[X + j + 1])
        odd += plan[a + n - j - 1] * ((j + 2) * plan[X + j + 2])
    if n % 2 == 0:
        even += plan[a] * ((n + 1) * plan[X + n + 1])
    return even + odd


@kernel
def shake(plan: Vector, frame: Frame, clock: Clock, unit: float) -> None:
    """Write the series of load − sign A_t, in units of time."""
    squared = unit * unit
    for n in range(DEGREE + 1):
        plan[SHAKEN + n] = 0.0
    sn, cn = clock
    for part in range(1, count(plan) + 1):
        amplitude, rate, closes, sine, cosine = wave(plan, part, False)
        amplitude *= -frame.sign * squared
        now = amplitude * (sine * sn + cosine * cn)
        after = amplitude * (sine * cn - closes * cosine * sn) * (rate * unit)
        turn = -closes * (rate * unit) * (rate * unit)
        for n in range(DEGREE):
            plan[SHAKEN + n] += now
            now, after = after, turn * now / ((n + 1) * (n + 2))
        sn, cn = raised(clock[0], clock[1], sn, cn)
    plan[SHAKEN] += frame.load * squared


@inlined
def raised_to(plan: Vector, base: int, exponent: float, into: int, n: int) -> None:
    """Coefficient n of a power of a series that does not begin with 0."""
    if n == 0:
        plan[into] = plan[base] ** exponent
        return
    total = 0.0
    for j in range(1, n + 1):
        total += ((exponent + 1.0) * j - n) * plan[base + j] * plan[into + n - j]
    plan[into + n] = total / (n * plan[base])


@kernel
def pressed(
    plan: Vector, push: Push, sign: float, deformation: int, into: int, unit: float, n: int
) -> float:
    """Coefficient n of what a power-law stop pushes with, `sign` being that of δ′ to x′."""
    raised_to(plan, deformation, push.exponent, into, n)
    force = plan[into + n]
    if push.dissipation != 0.0:
        force += sign * push.dissipation / unit * pushed(plan, into, n)
    force *= push.stiffness
    if push.viscous != 0.0:
        raised_to(plan, deformation, 0.25, into + ROOM, n)
        force += sign * push.viscous / unit * pushed(plan, into + ROOM, n)
    return force * unit * unit  # type: ignore[no-any-return]


class Laws(NamedTuple):
    """Which forces of a mode are not linear: stops that push, the isolator's branch, its drag.

    `push` belongs to the stop that the coordinate is of, `other` to one that is pressed besides,
    by minus the coordinate and `apart`. Where a force is nothing beside the others it is left
    out, for its power begins there: stiffness and drag are 0.
    """

    branch: Branch
    push: Push
    other: Push
    apart: float
    drag: float


@kernel
def step(
    plan: Vector,
    frame: Frame,
    laws: Laws,
    x: float,
    v: float,
    z: float,
    clock: Clock,
    unit: float,
    longest: float,
) -> float:
    """Write the series of a step from this state, at most `longest` seconds long.

    `unit` is a time in which the motion changes (s).

    Returns
    -------
    float
        Its length in seconds.
    """
    u = x + frame.offset
    shake(plan, frame, clock, unit)
    squared = unit * unit
    branch, push, other, apart, drag = laws
    plan[SHAKEN] -= branch.way * plan[par.FRICTION] * squared
    k, c = frame.stiffness * squared, frame.damping * unit
    cubic, quintic = plan[par.CUBIC] * squared, plan[par.QUINTIC] * squared
    sinh, steep = plan[par.SINH] * squared, plan[par.SINH_RATE]
    hysteretic = plan[par.HYSTERETIC] * squared
    exponent = plan[par.DRAG]
    drag *= branch.way * squared / unit**exponent
    sharpness = int(plan[par.SHARPNESS])
    polynomial = cubic != 0.0 or quintic != 0.0
    plan[X], plan[X + 1] = x, v * unit
    plan[U], plan[U + 1] = u, v * unit
    plan[PRESSED], plan[PRESSED + 1] = apart - x, -v * unit
    plan[Z], plan[Z + DEGREE] = z, 0.0
    if sinh != 0.0:
        plan[RISING], plan[FALLING] = math.exp(steep * u), math.exp(-steep * u)
    for n in range(DEGREE - 1):
        force = k * plan[X + n] + c * ((n + 1) * plan[X + n + 1])
        if polynomial:
            plan[SQUARE + n] = convolved(plan, U, U, n)
            plan[CUBE + n] = convolved(plan, SQUARE, U, n)
            force += cubic * plan[CUBE + n]
            if quintic != 0.0:
                plan[FIFTH + n] = convolved(plan, SQUARE, CUBE, n)
                force += quintic * plan[FIFTH + n]
        if sinh != 0.0:
            force += sinh * (plan[RISING + n] - plan[FALLING + n])
            plan[RISING + n + 1] = steep * pushed(plan, RISING, n) / (n + 1)
            plan[FALLING + n + 1] = -steep * pushed(plan, FALLING, n) / (n + 1)
        if hysteretic != 0.0:
            force += hysteretic * plan[Z + n]
            power = Z
            for m in range(sharpness - 1):
                into = POWERS + m * ROOM
                plan[into + n] = convolved(plan, power, Z, n)
                power = into
            plan[BENT + n] = -branch.bend * plan[power + n]
            if n == 0:
                plan[BENT] += branch.slope
            plan[Z + n + 1] = pushed(plan, BENT, n) / (n + 1)
        if drag != 0.0:
            plan[SPEED + n] = branch.way * ((n + 1) * plan[X + n + 1])
            if exponent == 2.0:
                plan[DRAG + n] = convolved(plan, SPEED, SPEED, n)
            else:
                raised_to(plan, SPEED, exponent, DRAG, n)
            force += drag * plan[DRAG + n]
        if push.stiffness != 0.0:
            force += pressed(plan, push, 1.0, X, PUSH, unit, n)
        if other.stiffness != 0.0:
            force -= pressed(plan, other, -1.0, PRESSED, PUSH + 4 * ROOM, unit, n)
        new = (plan[SHAKEN + n] - force) * (1.0 / ((n + 1) * (n + 2)))
        plan[X + n + 2], plan[U + n + 2], plan[PRESSED + n + 2] = new, new, -new
    reach = reached(plan, max(abs(u), abs(v) * unit, plan[MOST] * squared), hysteretic)
    length = reach * unit
    if not length < longest:
        length = longest
        reach = longest / unit
    scale(plan, reach, hysteretic != 0.0)
    return length


@kernel
def reached(plan: Vector, size: float, hysteretic: float) -> float:
    """How far the series reach, in units of time, for a motion of this size."""
    share = min(hysteretic, 1.0)
    reach = _FARTHEST
    for n in range(DEGREE - 2, DEGREE + 1):
        last = abs(plan[X + n])
        if hysteretic != 0.0:
            last += share * abs(plan[Z + n])
        if last > 0.0:
            reach = min(reach, (_TOLERANCE * size / last) ** (1.0 / n))
    return reach


@kernel
def stay(plan: Vector, frame: Frame, x: float, z: float, clock: Clock, length: float) -> float:
    """Write the series of a mass that is held, for so many seconds; return them."""
    shake(plan, frame, clock, length)
    for n in range(DEGREE + 1):
        plan[X + n], plan[Z + n] = 0.0, 0.0
    plan[X], plan[Z] = x, z
    return length


@kernel
def scale(plan: Vector, reach: float, hysteretic: bool) -> None:
    """Turn series in units of time into series in steps."""
    power = 1.0
    squared = reach * reach
    for n in range(DEGREE + 1):
        plan[X + n] *= power
        plan[SHAKEN + n] *= power * squared
        if hysteretic:
            plan[Z + n] *= power
        power *= reach


@kernel
def headed(plan: Vector, h: float) -> None:
    """Write the header of pieces of this length, as a table's."""
    for n in range(1, count(plan) + 1):
        part = wave(plan, n, False)
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
