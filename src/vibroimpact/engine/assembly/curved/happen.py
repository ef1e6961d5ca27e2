"""What happens at an event, and which branches of the links hold then."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved.branches import side_of, way_of_slide, with_side, with_way
from vibroimpact.engine.assembly.curved.numbers import enter, size_of
from vibroimpact.engine.assembly.curved.terms import (
    accelerations_of_all,
    expand_all,
    row_of,
)
from vibroimpact.engine.assembly.events import closing, impacts, let_part, speeds, switch_mode
from vibroimpact.engine.assembly.mode import enter_mode, move_alike
from vibroimpact.engine.event import CONTACT, DETACHMENT, IMPACT, TURN
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond

_CHATTERED = 1e-6
"""See `assembly.events`."""
_OVERLOADED = 1e-14
"""Share by which rounding may exceed the largest force of friction, as where it is watched."""
_ZERO = 1e-15
"""Share of a size below which a coefficient is rounding."""
_LIMIT = of.NUMBERS + par.YIELD
_FRICTION = of.NUMBERS + par.FRICTION


@kernel
def _settles(
    plan: Vector, f: int, returned: float, e: float, y: Vector, deformation: Vector
) -> bool:
    """Whether a chatter is completed at once, as `assembly.events.settles`."""
    if e >= 1.0:
        return False
    size = size_of(plan, y)
    enter(plan, y, deformation, size)
    length = 1.0 / plan[at.RATE]
    expand_all(plan, y, deformation, length, 2)
    n = int(plan[at.MASSES])
    row = int(plan[at.ROW])
    first = int(plan[at.SERIES]) + n + 1
    push = closing(plan, f, beyond(plan, first + row)) / length
    jerk = 2.0 * closing(plan, f, beyond(plan, first + 2 * row)) / (length * length)
    if not push > 0.0:
        return False
    lasts = 2.0 * returned / (push * (1.0 - e))
    return bool(lasts * plan[at.RATE] <= _CHATTERED and lasts * abs(jerk) <= _CHATTERED * push)


_impact = impacts(_settles)


@kernel
def is_link(plan: Vector, f: int) -> bool:
    """Whether a row is that of a link."""
    return bool(plan[int(plan[at.STOP]) + f * at.STOP_WIDTH + at.KIND] == at.LINK)


@kernel
def stop_moving(plan: Vector, f: int, y: Vector) -> None:
    """Take the closing speed from a row, by the least change in energy."""
    n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
    v = beyond(y, n)
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    kick = closing(plan, f, v) / plan[int(plan[at.COUPLING]) + f * count + f]
    for i in range(int(plan[one + at.FIRST]), int(plan[one + at.BEHIND])):
        v[i] -= plan[int(plan[at.RESPONSE]) + f * n + i] * kick


@kernel
def _yield_or_not(plan: Vector, mode: int, f: int, rate: float, deformation: Vector) -> int:
    """Let a bilinear spring yield where s goes on at its limit, and be elastic elsewhere."""
    z, limit = deformation[f], plan[row_of(plan, f) + _LIMIT]
    yields = abs(z) >= limit and rate * z > 0.0
    if abs(z) >= limit and not yields:
        place = int(plan[at.ZEROS]) + f
        plan[place] = float(int(plan[place]) | of.SIDE_FRESH)
    new_mode: int = with_side(plan, f, mode, -1.0 if yields else 1.0)
    return new_mode


@kernel
def _follow(plan: Vector, mode: int, f: int, way: float, deformation: Vector) -> int:
    """Let the rows beside a link of friction go as it: a way, or not at all (0).

    Their own events are not seen while it holds, and the one at its beginning need not have been.
    """
    stops = int(plan[at.STOP])
    one = stops + f * at.STOP_WIDTH
    for g in range(int(plan[at.STOPS])):
        other, row = stops + g * at.STOP_WIDTH, row_of(plan, g)
        if g == f or not is_link(plan, g) or plan[row + of.BRANCH] < 0.0 or mode >> g & 1:
            continue
        left, right = plan[other + at.LEFT], plan[other + at.RIGHT]
        if left == plan[one + at.LEFT] and right == plan[one + at.RIGHT]:
            along = way
        elif right == plan[one + at.LEFT] and left == plan[one + at.RIGHT]:
            along = -way
        else:
            continue
        if along != 0.0:
            mode = with_way(plan, g, mode, along)
            fresh = int(plan[int(plan[at.ZEROS]) + g])
            plan[int(plan[at.ZEROS]) + g] = float(fresh | of.V_FRESH)
        if int(plan[row + of.BEHAVIOUR]) == of.BILINEAR:
            mode = _yield_or_not(plan, mode, g, along, deformation)
    return mode


@kernel
def _touch_without_speed(plan: Vector, mode: int, f: int, y: Vector, deformation: Vector) -> None:
    """Let the ends of a link that begins to slide, where they touch at a stop, do so without speed.

    Rounding of their clearance must not give them the time to gain some: laws depend on it.
    """
    stops, zeros = int(plan[at.STOP]), int(plan[at.ZEROS])
    one = stops + f * at.STOP_WIDTH
    ends = plan[one + at.LEFT], plan[one + at.RIGHT]
    for g in range(int(plan[at.STOPS])):
        other = stops + g * at.STOP_WIDTH
        left, right, gap = plan[other + at.LEFT], plan[other + at.RIGHT], plan[other + at.GAP]
        same = (left == ends[0] and right == ends[1]) or (left == ends[1] and right == ends[0])
        if not same or is_link(plan, g) or mode >> g & 1 or deformation[g] > 0.0:
            continue
        if abs(gap - closing(plan, g, y)) <= _ZERO * (abs(gap) + speeds(plan, g, y)):
            plan[zeros + g] = 2.0


@not_inlined
def hold_or_slide(plan: Vector, mode: int, y: Vector, deformation: Vector) -> int:
    """Which links without speed friction holds; the most overloaded slides first.

    The others slide as their ends would go. Returns the mode, which is entered.
    """
    n, count, v = int(plan[at.MASSES]), int(plan[at.STOPS]), beyond(y, int(plan[at.MASSES]))
    some = False
    for f in range(count):
        row = row_of(plan, f)
        if int(plan[row + of.BEHAVIOUR]) != of.FRICTION:
            continue
        rate = closing(plan, f, v)
        if rate == 0.0:
            mode = _follow(plan, mode | 1 << f, f, 0.0, deformation)
            some = True
        else:
            mode = with_way(plan, f, mode & ~(1 << f), -rate)
    enter_mode(plan, mode)
    while some:
        enter(plan, y, deformation, size_of(plan, y))
        place = int(plan[at.ROOM])
        accelerations_of_all(plan, y, deformation, place)
        forces = place + n + 1 + int(plan[at.PRESSED])
        worst, most, force = -1, 1.0 + _OVERLOADED, 0.0
        for j in range(int(plan[at.RESTING])):
            f = int(plan[int(plan[at.RESTING_LIST]) + j])
            if not is_link(plan, f):
                continue
            load = abs(plan[forces + j]) / plan[row_of(plan, f) + _FRICTION]
            if load > most:
                worst, most, force = f, load, plan[forces + j]
        if worst < 0:
            break
        # What holds them apart is gone: they close, and s falls.
        mode = with_way(plan, worst, mode & ~(1 << worst), -force)
        plan[int(plan[at.ZEROS]) + worst] = float(of.V_FRESH)
        _touch_without_speed(plan, mode, worst, y, deformation)
        mode = _follow(plan, mode, worst, way_of_slide(plan, worst, mode), deformation)
        enter_mode(plan, mode)
    return mode


@not_inlined
def decide(plan: Vector, mode: int, y: Vector, deformation: Vector) -> int:
    """Find the branches of all links from a state alone. Returns the mode, which is entered."""
    n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
    v, zeros = beyond(y, n), beyond(plan, int(plan[at.ZEROS]))
    for f in range(count):
        row = row_of(plan, f)
        behaviour = int(plan[row + of.BEHAVIOUR])
        if not is_link(plan, f) or plan[row + of.BRANCH] < 0.0:
            continue
        zeros[f] = 0.0
        rate = -closing(plan, f, v)
        if rate != 0.0:
            mode = with_way(plan, f, mode, rate)
        if behaviour == of.BILINEAR:
            mode = _yield_or_not(plan, mode, f, rate, deformation)
        elif behaviour == of.HYSTERETIC and deformation[f] != 0.0:
            mode = with_side(plan, f, mode, deformation[f])
        elif behaviour == of.OWN and closing(plan, f, y) != 0.0:
            mode = with_side(plan, f, mode, -closing(plan, f, y))
    mode = hold_or_slide(plan, mode, y, deformation)
    size = size_of(plan, y)
    enter(plan, y, deformation, size)
    length = 1.0 / plan[at.STIFF_RATE]
    expand_all(plan, y, deformation, length, 4)
    row_width = int(plan[at.ROW])
    series = int(plan[at.SERIES]) + n + 1
    for f in range(count):
        row = row_of(plan, f)
        behaviour = int(plan[row + of.BEHAVIOUR])
        if not is_link(plan, f) or plan[row + of.BRANCH] < 0.0 or behaviour == of.FRICTION:
            continue
        if closing(plan, f, v) == 0.0:
            one = int(plan[at.STOP]) + f * at.STOP_WIDTH
            left, right = int(plan[one + at.LEFT]), int(plan[one + at.RIGHT])
            way = 0.0
            for j in range(1, 5):
                rate = plan[series + j * row_width + right] - plan[series + j * row_width + left]
                if abs(rate) > _ZERO * size:
                    way = 1.0 if rate > 0.0 else -1.0
                    break
            if way != 0.0:
                mode = with_way(plan, f, mode, way)
            zeros[f] = float(int(zeros[f]) | of.V_FRESH)
        if (behaviour == of.HYSTERETIC and deformation[f] == 0.0) or (
            behaviour == of.OWN and closing(plan, f, y) == 0.0
        ):
            mode = with_side(plan, f, mode, way_of_slide(plan, f, mode))
            zeros[f] = float(int(zeros[f]) | of.SIDE_FRESH)
    enter_mode(plan, mode)
    return mode


@kernel
def _turned(plan: Vector, mode: int, f: int, which: int, y: Vector, deformation: Vector) -> int:
    """Go on to the next branch of a link."""
    row, zeros = row_of(plan, f), beyond(plan, int(plan[at.ZEROS]))
    behaviour = int(plan[row + of.BEHAVIOUR])
    if behaviour == of.FRICTION:
        if mode >> f & 1:
            way = 1.0 if which else -1.0
            zeros[f] = float(of.V_FRESH)
            _touch_without_speed(plan, mode, f, y, deformation)
            mode = with_way(plan, f, mode & ~(1 << f), way)
            return _follow(plan, mode, f, way, deformation)
        zeros[f] = float(of.V_FRESH)
        let_part(plan, mode, f)
        stop_moving(plan, f, y)
        stuck = mode | 1 << f
        enter_mode(plan, stuck)
        move_alike(plan, beyond(y, int(plan[at.MASSES])))
        return hold_or_slide(plan, stuck, y, deformation)
    if behaviour == of.BILINEAR:
        if side_of(plan, f, mode) < 0.0:
            zeros[f] = float(of.SIDE_FRESH)
            return with_side(plan, f, mode, 1.0)
        way = -1.0 if which else 1.0
        deformation[f] = way * plan[row + _LIMIT]
        zeros[f] = 0.0
        return with_way(plan, f, with_side(plan, f, mode, -1.0), way)
    if which == 0:
        zeros[f] = float(of.V_FRESH)
        return with_way(plan, f, mode, -way_of_slide(plan, f, mode))
    zeros[f] = float(of.SIDE_FRESH)
    if behaviour == of.HYSTERETIC:
        deformation[f] = 0.0
    return with_side(plan, f, mode, -side_of(plan, f, mode))


@not_inlined
def switch(
    plan: Vector, mode: int, f: int, which: int, y: Vector, deformation: Vector
) -> tuple[int, int]:
    """Go through an event of a row; the mode, and what it was."""
    one, count = int(plan[at.STOP]) + f * at.STOP_WIDTH, int(plan[at.STOPS])
    kind = plan[one + at.KIND]
    zeros = beyond(plan, int(plan[at.ZEROS]))
    if kind == at.LINK:
        return _turned(plan, mode, f, which, y, deformation), TURN
    if int(plan[row_of(plan, f) + of.BEHAVIOUR]) == of.MEMORY_STOP:
        zeros[f] = 1.0
        # The bodies are at the face, exactly, so that its force begins or ends there.
        deformation[f] = closing(plan, f, y) - plan[one + at.GAP]
        if mode >> f & 1:
            return mode & ~(1 << f), DETACHMENT
        let_part(plan, mode, f)
        return mode | 1 << f, CONTACT
    if kind == at.PUSHING:
        if not mode >> f & 1:
            deformation[f] = abs(closing(plan, f, beyond(y, int(plan[at.MASSES]))))
            zeros[f] = float(of.DEPTH_FRESH)
            return mode | 1 << f, CONTACT
        if which > 0:
            zeros[f] = float(of.RATE_FRESH if which == 1 else of.FORCE_FRESH)
            return mode, TURN
        deformation[f] = 0.0
        zeros[f] = float(of.DEPTH_FRESH)
        return mode & ~(1 << f), DETACHMENT
    if kind == at.RIGID and not mode >> f & 1:
        # Friction passes no impulse on.
        for g in range(count):
            if is_link(plan, g):
                mode &= ~(1 << g)
        enter_mode(plan, mode)
        mode = _impact(plan, mode, f, y, deformation)
        return decide(plan, mode, y, deformation), IMPACT
    mode_and_event: tuple[int, int] = switch_mode(plan, mode, f, y, deformation)
    return mode_and_event
