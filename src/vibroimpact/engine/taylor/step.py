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

ROUNDING = 2.0**-53
"""Of a number, as a share of it."""

_TOLERANCE = 2.0**-57
"""What the last terms may be, as a share of the motion's size: below rounding, 2**-53."""

_BALANCED = 2.0**-46
"""What may be missing from the equation of motion at the step's end, as a share of the motion's
size. It grows with the 21st power of the time or faster, so that the step's end is off by less than
a 500th of it: less than the last terms may be."""

_CUT = 24
"""How often a step is shortened at most: each time to a quarter at least."""

_GONE = 1e50
"""A motion of this size (m) was pushed away for ever and is about to leave the range of numbers."""

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
    natural: float,
    longest: float,
) -> float:
    """Write the series of a step from this state, at most `longest` seconds long.

    `unit` is the time in which the series are written, `natural` one in which the motion changes
    (s).

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
    size = max(abs(u), abs(v) * unit, plan[MOST] * squared)
    reach = reached(plan, size, hysteretic)
    length = reach * unit
    if not length < longest:
        length = longest
        reach = longest / unit
    scale(plan, reach, hysteretic != 0.0)
    size = max(size, abs(x))
    if drag != 0.0 and exponent > 1.0 and exponent != 2.0:
        # Where the mass turns a step is much shorter than the motion's time: the velocity must be
        # right there, too.
        size = max(size, abs(v) * natural, plan[MOST] * natural * natural)
    else:
        natural = 0.0
    return certified(plan, frame, laws, size, natural, length)


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
def certified(
    plan: Vector, frame: Frame, laws: Laws, size: float, natural: float, length: float
) -> float:
    """Shorten the step in hand until its end obeys the equation of motion; return its length.

    The last terms of a series are blind to a power that begins beyond them, as z^30 from z = 0.
    A step shorter than `natural` (s) may be off by the same share of the velocity.
    """
    for _ in range(_CUT if size < _GONE else 0):
        allowed = size * length / natural if length < natural else size
        excess = unbalanced(plan, frame, laws, allowed, length)
        if excess <= 1.0:
            break
        share = 0.25
        if excess < math.inf:
            share = max(0.9 * excess ** (-1.0 / (DEGREE - 1)), share)
        scale(plan, share, plan[par.HYSTERETIC] != 0.0)
        length *= share
    return length


@kernel
def unbalanced(plan: Vector, frame: Frame, laws: Laws, size: float, length: float) -> float:
    """What is missing from the equation of motion at the step's end, over a share of `size` (m)."""
    branch, push, other, apart, drag = laws
    hysteretic = plan[par.HYSTERETIC]
    x, moved, gained, shaken = plan[X], 0.0, 0.0, plan[SHAKEN]
    for n in range(1, DEGREE + 1):
        x += plan[X + n]
        moved += n * plan[X + n]
        gained += (n * (n - 1)) * plan[X + n]
    for n in range(1, DEGREE - 1):
        shaken += plan[SHAKEN + n]
    v = moved / length
    u = x + frame.offset
    squared = u * u
    force = frame.stiffness * x + frame.damping * v
    force += (plan[par.CUBIC] + plan[par.QUINTIC] * squared) * (squared * u)
    if plan[par.SINH] != 0.0:
        force += 2.0 * plan[par.SINH] * math.sinh(plan[par.SINH_RATE] * u)
    if drag != 0.0:
        # Behind a turn the series of other powers are not followed.
        speed = abs(v) if plan[par.DRAG] == 2.0 else max(branch.way * v, 0.0)
        force += branch.way * drag * speed ** plan[par.DRAG]
    force += pushed_by(push, x, v) - pushed_by(other, apart - x, -v)
    missing = 0.0
    if hysteretic != 0.0:
        sharpness = int(plan[par.SHARPNESS])
        z, flowed = plan[Z], 0.0
        for n in range(1, DEGREE + 1):
            z += plan[Z + n]
            flowed += n * plan[Z + n]
        force += hysteretic * z
        missing = abs(flowed - moved * (branch.slope - branch.bend * z**sharpness))
        # Rounding: a power multiplies that of z.
        rounding = (4.0 * ROUNDING * sharpness) * abs(moved)
        missing /= _BALANCED * max(abs(plan[Z]), abs(z)) + rounding + 1e-300
    most: float = max(abs(gained - shaken + length * length * force) / (_BALANCED * size), missing)
    return most if most == most else math.inf


@inlined
def pushed_by(push: Push, deformation: float, closing: float) -> float:
    """What a stop pushes with by its law, where the series goes on: it may pull."""
    if push.stiffness == 0.0 or not deformation > 0.0:
        return 0.0
    force: float = push.stiffness * deformation**push.exponent * (1.0 + push.dissipation * closing)
    if push.viscous != 0.0:
        force += push.viscous * math.sqrt(math.sqrt(deformation)) * closing
    return force


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
def headed(plan: Vector, h: float, mirrored: bool) -> None:
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


@kernel
def spread(plan: Vector, series: int) -> float:
    """How far a series may go from its first coefficient, over the step."""
    total = 0.0
    for n in range(1, DEGREE + 1):
        total += abs(plan[series + n])
    return total
