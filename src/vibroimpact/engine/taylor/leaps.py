"""A leap from a motion: when one is tried, what is watched on it, and where it ends."""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import pace, turned, value
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
    TURNED,
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
from vibroimpact.engine.taylor.frame import branch_of, frame_of
from vibroimpact.engine.taylor.layout import NODES, NODES_A
from vibroimpact.engine.taylor.leap import (
    Forces,
    bent_by,
    forces_of,
    landed,
    leapt,
    pulled,
    shake_nodes,
)
from vibroimpact.engine.taylor.nodes import COUNT, PLACES
from vibroimpact.engine.taylor.pieces import coordinate, placed

DETACHED_LEFT, YIELDS, UNBENT, EASED = 16, 17, 18, 19
"""Events of a step besides those of a stretch."""

NO_LEAP = -1

_REACH = 1.75
"""Of a leap, in units of time."""

_FADED = 1e-18
"""A bumper's memory, as a share of its gap's scale, that does not move where it is met."""


@kernel
def smooth(plan: Vector, motion: Motion) -> bool:
    """Whether the isolator's forces are sums of powers, and the mass does not start from rest.

    A memory of Bouc and Wen's that bends with a power of itself is left to steps: it saturates
    within so short a way that leaps are no longer.
    """
    return bool(
        plan[par.SINH] == 0.0
        and (plan[par.DRAG] == 1.0 or plan[par.DRAG] == 2.0)
        and (plan[par.SHARPNESS] == 1.0 or plan[par.HYSTERETIC] == 0.0)
        and not motion.fresh & ~BOTH
    )


@kernel
def leaps(plan: Vector, motion: Motion) -> bool:
    """Whether a leap is worth trying: forces that are smooth, and no start from rest."""
    mode = motion.mode
    if not smooth(plan, motion):
        return False
    if mode == FLIGHT:
        return not overlapping(plan)
    if mode == BOTH or overlapping(plan):
        return False
    kind = plan[par.BUMPER + par.WIDTH * (mode - 1) + par.KIND]
    return bool(kind == par.KELVIN_VOIGT)


@kernel
def longest_of(plan: Vector, forces: Forces, x: float, v: float) -> tuple[float, float]:
    """How long a leap from here may be, and a time in which the motion changes (s).

    A line of a record ends no leap, but nothing moves for longer than it lasts.
    """
    line = plan[par.INTERVAL]
    slow = forces.damping + pace(plan) + abs((abs(forces.drag) + abs(forces.bend)) * v) + 1e-300
    base = forces.stiffness + forces.hysteretic
    u = abs(x + forces.offset)
    unit = 1.0
    for _ in range(2):
        squared = u * u
        k = base + 3.0 * abs(forces.cubic) * squared + 5.0 * abs(forces.quintic) * squared * squared
        unit = 1.0 / (math.sqrt(max(k, 0.0)) + slow)
        u = max(u, abs(x + forces.offset + v * min(unit, line)))
    return _REACH * unit, unit / (1.0 + unit / line)


@kernel
def shorter(excess: float) -> float:
    """How much shorter or longer the next leap may be: its last term goes with its length to 17."""
    share: float = 0.87 * (excess + 1e-6) ** (-1.0 / 17.0)
    return min(max(share, 0.4), 1.5)


class Leap(NamedTuple):
    """What a leap came to: its event (NO_LEAP if there was none), when, and the motion there."""

    event: int
    t: float
    motion: Motion
    next: float


@kernel
def leap_on(plan: Vector, motion: Motion, limit: float, hint: float) -> Leap:
    """Leap on from a motion, for the time `limit` and for `hint` at most, to the first event."""
    mode, _, _, _, right, left, _, age, clock = motion
    frame = frame_of(plan, mode)
    sign = frame.sign
    x, v, z = coordinate(plan, motion), sign * motion.v, sign * motion.z
    branch = branch_of(plan, motion, sign)
    forces = forces_of(plan, frame, branch)
    longest, unit = longest_of(plan, forces, x, v)
    h = min(longest if hint == math.inf else hint, 1.4 * longest)
    if limit < 2.0 * h:
        h = limit if limit < h else 0.5 * limit
    steady = frame.load - branch.way * plan[par.FRICTION]
    excess = 2.0
    a = 0.0
    for _ in range(4):
        shake_nodes(plan, frame, steady, clock, h)
        a = steady - sign * value(plan, clock[0], clock[1]) - pulled(forces, x, v, z)
        excess = leapt(plan, forces, x, v, z, a, h, unit)
        if excess <= 1.0:
            break
        h *= shorter(excess)
    if not excess <= 1.0:
        return Leap(NO_LEAP, 0.0, motion, h)
    x1, v1, z1 = landed(plan, forces, x, v, z, h)
    hysteretic = forces.hysteretic != 0.0
    bent = bends(plan, h, hysteretic)
    event, y = watched(plan, motion, forces, branch.way, a, h, bent, (x, v, z), (x1, v1, z1))
    if event == NO_LEAP:
        return Leap(NO_LEAP, 0.0, motion, h)
    t = h
    if event != LIMIT:
        t = y * h
        expand_nodes(plan, hysteretic)
        x1, v1, _, z1, _ = state_at(plan, y, hysteretic)
    if forces.slope == 0.0 or not hysteretic:
        z1 = z  # exactly, where a spring yields
    if not mode & RIGHT:
        right = relaxed(right, plan[par.BUMPER + par.RATE], t)
    if not mode & LEFT:
        left = relaxed(left, plan[par.BUMPER + par.WIDTH + par.RATE], t)
    clock = turned(plan, clock[0], clock[1], t)
    there = Motion(mode, 0, 0.0, sign * v1, right, left, sign * z1, age + t, clock)
    return Leap(event, t, placed(plan, there, x1), h * shorter(excess))


@kernel
def watched(
    plan: Vector,
    motion: Motion,
    forces: Forces,
    way: float,
    a: float,
    h: float,
    bent: Bends,
    begin: tuple[float, float, float],
    end: tuple[float, float, float],
) -> tuple[int, float]:
    """The first event on the leap: what (LIMIT if none), and where; or NO_LEAP."""
    mode, fresh = motion.mode, motion.fresh
    x, v, _ = begin
    x1, v1, _ = end
    event, first = LIMIT, NONE
    if mode:
        at = par.BUMPER + par.WIDTH * (mode - 1)
        k, c = plan[at + par.BUMPER_STIFFNESS], plan[at + par.BUMPER_DAMPING]
        start = k * x + c * v
        if fresh == mode:
            start = max(start, 0.0)
        watch = Watch(0.0, k, c, 0.0, start, h * (k * v + c * a), k * x1 + c * v1)
        y = first_zero(plan, watch, bent, h, first)
        if y == UNSURE:
            return NO_LEAP, 0.0
        if y < first:
            event, first = DETACHED if mode == RIGHT else DETACHED_LEFT, y
    else:
        for side in range(1, 3):
            at = par.BUMPER + par.WIDTH * (side - 1)
            if plan[at + par.KIND] == par.ABSENT:
                continue
            facing = 1.0 if side == RIGHT else -1.0
            gap = plan[at + par.GAP]
            memory = motion.right if side == RIGHT else motion.left
            start = gap - facing * x
            if start < 0.0 and memory > 0.0:
                # Just left, with the bumper still on its way: it opens while the mass falls back.
                if not falls_back(plan, side, motion, x1, bent, h):
                    return NO_LEAP, 0.0
                continue
            if fresh & BOTH == side:
                start = 0.0
            watch = Watch(gap, -facing, 0.0, 0.0, start, -h * facing * v, gap - facing * x1)
            y = first_zero(plan, watch, bent, h, first)
            faded = relaxed(memory, plan[at + par.RATE], y * h)
            if y == UNSURE or (y < first and faded > _FADED * (gap + abs(x))):
                return NO_LEAP, 0.0
            if y < first:
                event, first = side, y
    return branches(plan, motion, forces, way, a, 1.0, h, bent, begin, end, (event, first))


@kernel
def branches(
    plan: Vector,
    motion: Motion,
    forces: Forces,
    way: float,
    a: float,
    pace: float,
    h: float,
    bent: Bends,
    begin: tuple[float, float, float],
    end: tuple[float, float, float],
    found: tuple[int, float],
) -> tuple[int, float]:
    """Take the ends of the isolator's branch into account: `pace` is dt over the variable's own."""
    _, v, z = begin
    _, v1, z1 = end
    event, first = found
    hysteretic = plan[par.HYSTERETIC] != 0.0
    if hysteretic or plan[par.DRAG] != 1.0 or plan[par.FRICTION] != 0.0:
        watch = Watch(0.0, 0.0, way, 0.0, way * v, h * way * a, way * v1)
        y = first_zero(plan, watch, bent, h, first)
        if y == UNSURE:
            return NO_LEAP, 0.0
        if y < first:
            event, first = TURNED, y
    if hysteretic:
        watch = Watch(0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0)
        limit = plan[par.YIELD]
        rate = h * pace * bent_by(forces, z) * v
        which = YIELDS
        if limit < math.inf:
            if abs(z) < limit or way * z < 0.0:
                watch = Watch(limit, 0.0, 0.0, -way, limit - way * z, -way * rate, limit - way * z1)
        elif plan[par.KNEE] != 0.0:
            facing = math.copysign(1.0, z) if z != 0.0 else way
            watch = Watch(0.0, 0.0, 0.0, facing, facing * z, facing * rate, facing * z1)
            which = UNBENT
        if watch.by_z != 0.0:
            y = first_zero(plan, watch, bent, h, first)
            if y == UNSURE:
                return NO_LEAP, 0.0
            if y < first:
                event, first = which, y
    return event, first


@kernel
def falls_back(plan: Vector, side: int, motion: Motion, x1: float, bent: Bends, h: float) -> bool:
    """Whether a mass that leaves a damped bumper no slower than that relaxes is rid of it.

    Its clearance is m (exp(−r t) − 1 + r t) − ∬ ẍ, m being the bumper's deformation. The first
    part is above m r²t²/3 up to r t = 1 and above its tangent there from then on. Once the mass is
    back within the gap it cannot be reached by what relaxes.
    """
    at = par.BUMPER + par.WIDTH * (side - 1)
    facing, gap, rate = (1.0 if side == RIGHT else -1.0), plan[at + par.GAP], plan[at + par.RATE]
    memory = motion.right if side == RIGHT else motion.left
    if motion.fresh & BOTH != side and not (
        facing * motion.v + rate * memory <= 0.0 and facing * motion.u - gap <= memory
    ):
        return False
    most = 0.0
    for i in range(COUNT):
        # Between two nodes the acceleration changes by so much at most.
        most = max(most, facing * plan[NODES_A + i] + 0.1 * bent.v / h)
        clear = gap - facing * plan[NODES + i]
        if clear > 0.0 or i == COUNT - 1:
            t = h * (PLACES[i] if clear > 0.0 else 1.0)
            opens = memory * (0.632 * rate * t - 0.265)
            if most > 0.0 and not (
                memory * rate * rate > 1.5 * most and (rate * t < 1.0 or opens > 0.5 * most * t * t)
            ):
                return False
            if not clear > 0.0:
                return True
            watch = Watch(gap, -facing, 0.0, 0.0, clear, 0.0, gap - facing * x1)
            return bool(first_zero(plan, watch, bent, h, NONE, i + 1) == NONE)
    return True
