"""Steps while a stop is pressed by a power of its depth, in a root (`series.root_variable`)."""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event import DETACHMENT, EASED, LIMIT, NEITHER, event_of
from vibroimpact.engine.forcing.dispatch import stepped
from vibroimpact.engine.jit import Vector, inlined, kernel, not_inlined
from vibroimpact.engine.motion import BOTH, LEFT, RIGHT, Motion, main_stop
from vibroimpact.engine.series.events import NEVER, Line, first_zero, state_near, summed
from vibroimpact.engine.series.kernels import STRIDE, Slot
from vibroimpact.engine.series.layout import F_T, FOUND, ROOTS, UNIT, T
from vibroimpact.engine.series.step_control import StepClock, certified_step, number
from vibroimpact.engine.series.values import NO_PUSH, Frame, Laws
from vibroimpact.engine.stops.curved import EVEN, curved_stop, push_of
from vibroimpact.engine.stops.places import overlapping
from vibroimpact.engine.taylor.mode_forces import branch_of
from vibroimpact.engine.taylor.pieces import at_coordinate, coordinate
from vibroimpact.engine.taylor.step_events import (
    FirstEvent,
    earlier,
    ends_of,
    starts_still,
    turns,
)
from vibroimpact.engine.taylor.step_setup import branched
from vibroimpact.law_numbers import ABSOLUTE_X

_ROOT = int(Slot.ROOT)

MOST = 50_000
"""Steps to one event, far more than any needs whose rates are those of the rig. A stop that is
met all but without speed may have a dissipation beyond all bounds, and is given up."""


class Pressed(NamedTuple):
    """What the steps of a stretch are made with: way, kernel, unit (s), and χ per unit.

    `size` is about the largest root on the way.
    """

    way: float
    slot: int
    unit: float
    chi: float
    size: float


@kernel
def root_of(plan: Vector, motion: Motion) -> int:
    """In which root of a stop's deformation a motion is followed; 0 if in none."""
    mode, stop = motion.mode, main_stop(motion.mode)
    if mode not in (RIGHT, LEFT) or motion.fresh & ~BOTH or overlapping(plan):
        return 0
    if not curved_stop(plan, stop):
        return 0
    at = par.stop_at(stop)
    if plan[at + par.EXPONENT] != plan[ROOTS + 2 * stop]:
        return 0
    if int(plan[par.OWN + par.OWN_FLAGS]) & ABSOLUTE_X and plan[at + par.GAP] < 0.0:
        return 0  # only steps in time look for where u changes its sign
    return int(plan[ROOTS + 2 * stop + 1])


@kernel
def pressed_by(plan: Vector, motion: Motion, frame: Frame, x: float, root: int) -> Pressed:
    """What the steps of a stretch are made with that begins with this motion; write its numbers."""
    stop = main_stop(motion.mode)
    unit: float = plan[UNIT]
    branch = branch_of(plan, motion, frame.sign)
    v = frame.sign * motion.v
    memory = motion.faces[stop]
    push = push_of(plan, stop, branch.way if v == 0.0 else v, memory)
    drag = plan[par.DAMPING] if plan[par.DRAG] != 1.0 else 0.0
    number(plan, frame, Laws(branch, push, NO_PUSH, 0.0, drag), unit)
    n = push.exponent
    work = (n + 1.0) / push.stiffness * 0.5 * v * v
    if x > 0.0:
        work += x ** (n + 1.0)
    deep = max(work ** (1.0 / (n + 1.0)), 1e-300)
    slot = _ROOT + STRIDE * stop
    return Pressed(branch.way, slot, unit, push.dissipation / unit, root_of_deformation(deep, root))


@inlined
def root_of_deformation(x: float, root: int) -> float:
    """A root of m times a deformation."""
    if root == 2:
        return math.sqrt(2.0 * x)
    if root == 4:
        return math.sqrt(2.0 * math.sqrt(x))
    return (root * x) ** (1.0 / root)  # type: ignore[no-any-return]


@inlined
def raised(w: float, root: int) -> float:
    """A deformation from its root; below 0 where that is."""
    x = w
    for _ in range(1, root):
        x *= w
    return (x if root % 2 or w > 0.0 else -x) / root


@inlined
def follows(chi: float, x: float, v: float, fresh: bool) -> bool:
    """Whether a stop pushes, in a root of whose deformation the motion has a series."""
    return bool(1.0 + chi * v > EVEN and (x > 0.0 or (fresh and v > 0.0)))


@kernel
def share_of(plan: Vector, time: float, last: float, late: float) -> float:
    """At which value of the variable it is so late, if it is later, `late`, at the value `last`."""
    low, high = 0.0, last
    y = last * (time / late)
    for _ in range(80):
        t, rate, _ = summed(plan, T, y)
        over = t - time
        if over > 0.0:
            high = y
        else:
            low = y
        new = y - over / rate if rate > 0.0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - y) <= 1e-15 * last or not low < new < high:
            return new
        y = new
    return y


@not_inlined
def pressed_for(
    plan: Vector, motion: Motion, frame: Frame, root: int, limit: float, begins: bool
) -> tuple[int, float, Motion]:
    """Go on in a root of a stop's deformation, to the first event or as long as that can be.

    `begins` says that the motion is that of a stretch's beginning.

    Returns
    -------
    event, t, motion
        NEITHER if it cannot be followed so any more; free stops are as they were.
    """
    mode, fresh, _, _, faces, _, age, clock = motion
    x, z = coordinate(plan, motion), frame.sign * motion.z
    by = pressed_by(plan, motion, frame, x, root)
    v = frame.sign * motion.v * by.unit
    if not follows(by.chi, x, v, begins and fresh == mode) or starts_still(plan, motion):
        # A rounding of the acceleration is one coefficient of a series in time, but not of this.
        return NEITHER, 0.0, motion
    hysteretic = plan[par.HYSTERETIC] != 0.0
    matters = branched(plan, motion)
    ways = by.way if matters else 0.0
    per_unit = 1.0 / by.unit
    most = limit * per_unit
    w = root_of_deformation(max(x, 0.0), root)
    here = motion
    t = 0.0
    event, leaves = NEITHER, event_of(DETACHMENT, main_stop(mode))
    for _ in range(MOST):
        shaken = StepClock(frame.sign, clock, by.unit, per_unit)
        h, after = certified_step(plan, by.slot, w, v, z, shaken, max(w, by.size), 0.0, math.inf)
        ends = ends_of(plan, h, w, v, z, hysteretic)
        first = FirstEvent(LIMIT, NEVER)
        first = earlier(first, leaves, first_zero(plan, Line(0.0, 1.0, 0.0, 0.0), ends, w))
        if by.chi != 0.0:
            line = Line(1.0, 0.0, by.chi, 0.0)
            first = earlier(first, EASED, first_zero(plan, line, ends, 1.0 + by.chi * v))
        if matters:
            first = turns(plan, here, ways, frame.sign, ends, t, first)
        step, last = plan[FOUND + F_T], h
        if first.event != LIMIT:
            last = first.t
            step, _, _ = summed(plan, T, last)
        event = first.event
        if t + step > most:
            last, step = share_of(plan, most - t, last, step), most - t
            event = LIMIT
        elif event == LIMIT:
            event = NEITHER
        if last < h or event != NEITHER:
            w, v, z1 = state_near(plan, last, h, hysteretic)
            after = stepped(plan, clock[0], clock[1], step * by.unit)
        else:
            w, v, z1 = ends.x1, ends.v1, ends.z1
        clock = after
        z = z1 if hysteretic else z
        t += step
        speed = frame.sign * v * per_unit
        here = Motion(mode, 0, 0.0, speed, faces, frame.sign * z, age, clock)
        if event != NEITHER or not (w > 0.0 and follows(by.chi, w, v, False)):
            break
    return event, t * by.unit, at_coordinate(plan, here, raised(w, root))
