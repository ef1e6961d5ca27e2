"""Leaps while a power-law stop is pressed, in the root of its deformation.

δ^1.5 has no series where contact begins, and steps there can only grow with δ. With δ = w² and a
variable τ in which dt = 2w dτ (Hénon's), w′ = δ̇ and all else has a series in τ, at both ends of the
contact: a few leaps carry the mass from δ = 0 to δ = 0. So it is for every exponent that is a whole
number of halves. The time at the nodes is one more unknown, and the shaking follows it.
"""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import count, pace, turned, value, wave
from vibroimpact.engine.forcing.several import raised
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.evaluate import relaxed
from vibroimpact.engine.linear.roots import NONE
from vibroimpact.engine.linear.tables import overlapping
from vibroimpact.engine.motion import (
    BOTH,
    DETACHED,
    FLIGHT,
    LEFT,
    LIMIT,
    RIGHT,
    Clock,
    Motion,
)
from vibroimpact.engine.taylor.crossing import (
    UNSURE,
    Bends,
    Watch,
    bends,
    expand_nodes,
    first_zero,
    state_at,
)
from vibroimpact.engine.taylor.frame import Frame, Push, branch_of, frame_of, push_of
from vibroimpact.engine.taylor.laws import EVEN
from vibroimpact.engine.taylor.layout import (
    NODES,
    NODES_A,
    NODES_P,
    NODES_R,
    NODES_SHAKEN,
    NODES_T,
    NODES_V,
    NODES_Z,
    SPECTRA,
)
from vibroimpact.engine.taylor.leap import (
    AGREED,
    FADES,
    ROUNDS,
    Forces,
    bent_by,
    changed,
    excess_of,
    flowing,
    forces_of,
    landed,
    own,
    pull,
    pulled,
    saturated,
    seen,
    steadied,
    waves,
)
from vibroimpact.engine.taylor.leaps import (
    DETACHED_LEFT,
    EASED,
    NO_LEAP,
    Leap,
    branches,
    shorter,
    smooth,
)
from vibroimpact.engine.taylor.nodes import (
    COUNT,
    END_OF_ONE,
    PLACES,
    integral,
    nodewise,
    spectrum,
    twice,
)
from vibroimpact.engine.taylor.pieces import coordinate, placed

_REACH = 1.5
"""Of a leap, in units of τ."""

_FARTHEST = 1.0
"""rad, that the shaking may turn on a leap: `waves` is right to there."""

SPECTRUM_T = SPECTRA + 5 * COUNT


_line = nodewise(
    lambda shaken, t, now, after: shaken + (now + after * t), (NODES_SHAKEN, NODES_T), NODES_SHAKEN
)
_angle = nodewise(lambda t, rate: rate * t, (NODES_T,), NODES_P)
_first_push = nodewise(lambda w, v, k, chi: k * w * (1.0 + chi * v), (NODES, NODES_V), NODES_P)
_next_push = nodewise(lambda push, w: push * w, (NODES_P, NODES), NODES_P)


def _accelerated(shaken: Any, push: Any, w: Any, v: Any, z: Any, *numbers: Any) -> Any:
    return (w + w) * (shaken - push - pull(w * w, v, z, *numbers))


_accelerate = nodewise(_accelerated, (NODES_SHAKEN, NODES_P, NODES, NODES_V, NODES_Z), NODES_A)
_saturate = nodewise(lambda w, *numbers: saturated(w * w, *numbers), (NODES,), NODES_Z)
_by_depth = nodewise(lambda rate, w: rate * (w + w), (NODES_R, NODES), NODES_R)


def _ahead(place: Any, h: Any, w: Any, v: Any, a: Any) -> Any:
    t = place * h
    return w + t * (v + (t * a) * (w + t * (v * (1 / 3))))


def _ahead_v(place: Any, h: Any, w: Any, v: Any, a: Any) -> Any:
    t = place * h
    return v + (t * a) * (w + w + t * v)


def _ahead_t(place: Any, h: Any, w: Any, v: Any, a: Any) -> Any:
    t = place * h
    return t * (w + w + t * (v + (t * a) * (w * (2 / 3))))


_guess = nodewise(_ahead, (PLACES,), NODES)
_guess_v = nodewise(_ahead_v, (PLACES,), NODES_V)
_guess_t = nodewise(_ahead_t, (PLACES,), NODES_T)
_guess_z = nodewise(lambda w, z, rate, start: z + rate * (w * w - start), (NODES,), NODES_Z)


@kernel
def presses(plan: Vector, motion: Motion) -> bool:
    """Whether a leap in the root of the deformation is worth trying."""
    mode = motion.mode
    if mode in (FLIGHT, BOTH) or overlapping(plan) or not smooth(plan, motion):
        return False
    at = par.BUMPER + par.WIDTH * (mode - 1)
    halves = 2.0 * plan[at + par.EXPONENT]
    return bool(
        plan[at + par.KIND] == par.POWER_LAW and halves == math.floor(halves) and halves <= 8.0
    )


@kernel
def shake_at(plan: Vector, frame: Frame, steady: float, clock: Clock) -> bool:
    """Write `steady` − sign A_t at the nodes' times; return whether they are near enough."""
    steadied(plan, (steady,))
    sn, cn = clock
    near = True
    for part in range(1, count(plan) + 1):
        amplitude, rate, closes, sine, cosine = wave(plan, part, False)
        amplitude *= -frame.sign
        now = amplitude * (sine * sn + cosine * cn)
        after = amplitude * (sine * cn - closes * cosine * sn)
        if closes == 0.0:
            _line(plan, (now, after * rate))
        else:
            near = near and abs(rate * plan[NODES_T + COUNT - 1]) < _FARTHEST
            _angle(plan, (rate,))
            waves(plan, (now, after))
        sn, cn = raised(clock[0], clock[1], sn, cn)
    return near


@kernel
def rates(plan: Vector, forces: Forces, push: Push) -> None:
    """Write the rates of v and of z, by τ, at the nodes."""
    _first_push(plan, (push.stiffness, push.dissipation))
    for _ in range(int(2.0 * push.exponent) - 1):
        _next_push(plan, ())
    _accelerate(plan, own(forces))
    if forces.hysteretic != 0.0:
        flowing(plan, forces)
        _by_depth(plan, ())


@kernel
def pressed_on(
    plan: Vector,
    frame: Frame,
    forces: Forces,
    push: Push,
    steady: float,
    clock: Clock,
    begin: tuple[float, float, float],
    a: float,
    h: float,
    unit: float,
) -> float:
    """Find the motion at the nodes of the next h of τ, from w, v and z; see `leap.leapt`."""
    w, v, z = begin
    hysteretic = forces.hysteretic != 0.0
    size = max(abs(w), abs(v) * unit, 1e-300)
    bent = bent_by(forces, z)
    _guess(plan, (h, w, v, a))
    _guess_v(plan, (h, w, v, a))
    _guess_t(plan, (h, w, v, a))
    _guess_z(plan, (z, bent, w * w))
    middle = COUNT // 2
    before = 1e-300
    for turn in range(ROUNDS):
        near = shake_at(plan, frame, steady, clock)
        rates(plan, forces, push)
        last, half = plan[NODES + COUNT - 1], plan[NODES + middle]
        integral(plan, NODES_A, NODES_V, h, v, 0.0)
        twice(plan, NODES_A, NODES, h * h, w, v * h)
        integral(plan, NODES, NODES_T, 2.0 * h, 0.0, 0.0)
        change = abs(plan[NODES + COUNT - 1] - last) + abs(plan[NODES + middle] - half)
        if hysteretic:
            memory = seen(plan)
            _saturate(plan, (z, bent, 0.5 * forces.bend, w * w))
            change += size * changed(plan, memory, z)
        if turn > 2 and not near:
            return 4.0
        if not change * min(change / before, 0.25) > 0.25 * AGREED * size:
            break
        before = change
    else:
        return 4.0
    shake_at(plan, frame, steady, clock)
    rates(plan, forces, push)
    integral(plan, NODES_A, NODES_V, h, v, 0.0)
    if hysteretic and not abs(forces.bend * (plan[NODES + COUNT - 1] ** 2 - w * w)) < FADES:
        return 4.0
    return excess_of(plan, h * unit / size, hysteretic, z, h)


@kernel
def unit_of(plan: Vector, frame: Frame, forces: Forces, push: Push, x: float, v: float) -> float:
    """A piece of τ in which the motion changes."""
    n = push.exponent
    base = math.sqrt(max(forces.stiffness + forces.hysteretic, 0.0))
    slow = base + forces.damping + abs(forces.drag * v) + pace(plan)
    work = (n + 1.0) / push.stiffness * 0.5 * v * v
    deep = max(x, work ** (1.0 / (n + 1.0)))
    w = math.sqrt(deep)
    # w″ = −2 k w^(2n+1): its own rate, and that of everything else over dt/dτ = 2 w.
    own = math.sqrt(2.0 * (2.0 * n + 1.0) * push.stiffness * deep**n)
    own += push.dissipation * push.stiffness * deep**n * 2.0 * w
    return 1.0 / (own + 2.0 * w * slow + 1e-300)  # type: ignore[no-any-return]


@kernel
def time_at(plan: Vector, y: float) -> float:
    """The time at a share of the leap."""
    t = 2.0 * y - 1.0
    one, two = 0.0, 0.0
    for n in range(COUNT - 1, -1, -1):
        one, two = (
            plan[SPECTRUM_T + n]
            + (2.0 * n + 1.0) / (n + 1.0) * t * one
            - (n + 1.0) / (n + 2.0) * two,
            one,
        )
    return one


@kernel
def share_of(plan: Vector, time: float, last: float, late: float, h: float) -> float:
    """At which share of the leap it is so late, if it is later at the share `last`.

    Up to a detachment time grows with the share, if ever so slowly; behind one, where w < 0, it
    goes back.
    """
    low, high = 0.0, last
    y = last * (time / late)
    for _ in range(80):
        over = time_at(plan, y) - time
        if over > 0.0:
            high = y
        else:
            low = y
        w, _, _, _, _ = state_at(plan, y, False)
        new = y - over / (2.0 * h * w) if w > 0.0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - y) <= 1e-15 or not low < new < high:
            return new
        y = new
    return y


@kernel
def press_on(plan: Vector, motion: Motion, limit: float, hint: float) -> Leap:
    """Leap on from a motion pressed by a power-law stop; see `leaps.leap_on`. `hint` is of τ."""
    mode, fresh, _, _, right, left, _, age, clock = motion
    frame = frame_of(plan, mode)
    sign = frame.sign
    x, v, z = coordinate(plan, motion), sign * motion.v, sign * motion.z
    nothing = Leap(NO_LEAP, 0.0, motion, math.inf)
    if not x > 0.0:
        if fresh != mode or not v > 0.0:
            return nothing
        x = 0.0
    push = push_of(plan, mode, v, right if mode == RIGHT else left)
    if not 1.0 + push.dissipation * v > EVEN:
        return nothing
    branch = branch_of(plan, motion, sign)
    forces = forces_of(plan, frame, branch)
    unit = unit_of(plan, frame, forces, push, x, v)
    h = min(_REACH * unit if hint == math.inf else hint, 3.0 * unit)
    w = math.sqrt(x)
    steady = frame.load - branch.way * plan[par.FRICTION]
    begin = (w, v, z)
    a = steady - sign * value(plan, clock[0], clock[1]) - pulled(forces, x, v, z)
    a -= push.stiffness * x**push.exponent * (1.0 + push.dissipation * v)
    excess = 2.0
    for _ in range(5):
        excess = pressed_on(plan, frame, forces, push, steady, clock, begin, a, h, unit)
        if excess <= 1.0:
            break
        h *= shorter(excess)
    if not excess <= 1.0:
        return nothing
    w1, v1, z1 = landed(plan, forces, w, v, z, h)
    hysteretic = forces.hysteretic != 0.0
    bent = bends(plan, h, hysteretic)
    event, y = let_out(
        plan, motion, push, branch.way, 2.0 * w * a, h, bent, (w, v, z), (w1, v1, z1), forces
    )
    if event == NO_LEAP:
        return nothing
    whole = 0.0
    for i in range(COUNT):
        whole += END_OF_ONE[i] * plan[NODES + i]
    whole *= 2.0 * h
    t = whole
    if event != LIMIT or whole > limit:
        spectrum(plan, NODES_T, SPECTRUM_T, 1.0, 0.0, 0.0)
        expand_nodes(plan, hysteretic)
        last = 1.0
        if event != LIMIT:
            t, last = time_at(plan, y), y
        if t > limit:
            y = share_of(plan, limit, last, t, h)
            event, t = LIMIT, limit
        w1, v1, _, z1, _ = state_at(plan, y, hysteretic)
    if forces.slope == 0.0 or not hysteretic:
        z1 = z  # exactly, where a spring yields
    if not mode & RIGHT:
        right = relaxed(right, plan[par.BUMPER + par.RATE], t)
    if not mode & LEFT:
        left = relaxed(left, plan[par.BUMPER + par.WIDTH + par.RATE], t)
    clock = turned(plan, clock[0], clock[1], t)
    there = Motion(mode, 0, 0.0, sign * v1, right, left, sign * z1, age + t, clock)
    return Leap(event, t, placed(plan, there, w1 * w1), h * shorter(excess))


@kernel
def let_out(
    plan: Vector,
    motion: Motion,
    push: Push,
    way: float,
    rate: float,
    h: float,
    bent: Bends,
    begin: tuple[float, float, float],
    end: tuple[float, float, float],
    forces: Forces,
) -> tuple[int, float]:
    """The first event on the leap: w or 1 + χ v falls to zero, or a branch of the isolator ends."""
    w, v, _ = begin
    w1, v1, _ = end
    event, first = LIMIT, NONE
    y = first_zero(plan, Watch(0.0, 1.0, 0.0, 0.0, w, h * v, w1), bent, h, first)
    if y == UNSURE:
        return NO_LEAP, 0.0
    if y < first:
        event, first = DETACHED if motion.mode == RIGHT else DETACHED_LEFT, y
    chi = push.dissipation
    if chi != 0.0:
        watch = Watch(1.0, 0.0, chi, 0.0, 1.0 + chi * v, h * chi * rate, 1.0 + chi * v1)
        y = first_zero(plan, watch, bent, h, first)
        if y == UNSURE:
            return NO_LEAP, 0.0
        if y < first:
            event, first = EASED, y
    found = event, first
    return branches(plan, motion, forces, way, rate, 2.0 * w, h, bent, begin, end, found)
