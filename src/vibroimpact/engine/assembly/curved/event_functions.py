"""What is watched of each row: series on a step that may only fall to zero."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.advance import first_event, is_positive, order_of_zero
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved.branches import side_of, way_of_slide
from vibroimpact.engine.assembly.curved.emitted import REACH
from vibroimpact.engine.assembly.curved.terms import coded, first, node, row_of
from vibroimpact.engine.assembly.events import speeds
from vibroimpact.engine.assembly.roots import NONE, first_fall
from vibroimpact.engine.assembly.series import to_bernstein, watched_series
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond

_WRONG = 1e-14
_MARGIN = 1e-6
"""Beside which the rounding of a reach is nothing."""
_ROUNDING = 2e-16
_ZERO = 1e-15
"""Share of a size below which the first coefficients of what begins at zero are rounding."""
_FORMULA = of.NUMBERS + par.OWN
_CHI = of.NAMES + 14
_DAMPING = of.NUMBERS + par.BUMPER + par.BUMPER_DAMPING
_DISSIPATION = of.NUMBERS + par.BUMPER + par.DISSIPATION
_LIMIT = of.NUMBERS + par.YIELD
_FRICTION = of.NUMBERS + par.FRICTION


@not_inlined
def fall(plan: Vector, a: Vector, size: float, fresh: bool, end: float) -> float:
    """When a series first falls through zero, as a share of the step, or NONE.

    `fresh`: it begins at zero; what is rounding of its first coefficients is left out.
    """
    zeros = 0
    if fresh:
        zeros = 1
        while zeros < 3 and abs(a[zeros]) <= _ZERO * size:
            zeros += 1
    share: float = _fall_from(plan, a, size, zeros, end)
    return share


@not_inlined
def _fall_from(plan: Vector, a: Vector, size: float, zeros: int, end: float) -> float:
    """As `fall`, of a series that begins with a zero of this order."""
    order = int(plan[at.ORDER])
    for j in range(zeros):
        a[j] = 0.0
    if zeros == 0 and a[0] < -_WRONG * size:
        return 0.0
    least = a[0]
    for j in range(1, order + 1):
        least += min(a[j], 0.0)
    if least > 0.0:
        return NONE
    b = beyond(plan, int(plan[at.BERNSTEIN]))
    to_bernstein(plan, a, b)
    for j in range(zeros):
        b[j] = 0.0
    share: float = first_fall(b, 0.0, 0.0, end, zeros, _ROUNDING * size + 1e-300, plan)
    return share


@kernel
def relative(plan: Vector, f: int, part: int, sign: float, a: Vector) -> None:
    """Write a sign times the series of u_left − u_right (part 0) or of its rate (1)."""
    n, row, powers = int(plan[at.MASSES]), int(plan[at.ROW]), int(plan[at.POWERS])
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    first = int(plan[at.SERIES]) + part * (n + 1)
    left, right = first + int(plan[one + at.LEFT]), first + int(plan[one + at.RIGHT])
    for j in range(int(plan[at.ORDER]) + 1):
        a[j] = sign * plan[powers + j] * (plan[left + j * row] - plan[right + j * row])


@kernel
def _times(plan: Vector, series: int, sign: float, a: Vector) -> None:
    powers = int(plan[at.POWERS])
    for j in range(int(plan[at.ORDER]) + 1):
        a[j] = sign * plan[powers + j] * plan[series + j]


@kernel
def held_force(plan: Vector, f: int) -> int:
    """Where the force that holds the ends of a row stands in the force series."""
    place, listed = 0, int(plan[at.RESTING_LIST])
    while int(plan[listed + place]) != f:
        place += 1
    return int(plan[at.FORCE_SERIES]) + int(plan[at.PRESSED]) + place


@kernel
def held_alike(plan: Vector, f: int) -> bool:
    """Whether friction holds the two ends of a row together."""
    stops = int(plan[at.STOP])
    one, is_held = stops + f * at.STOP_WIDTH, False
    for j in range(int(plan[at.RESTING])):
        g = int(plan[int(plan[at.RESTING_LIST]) + j])
        other = stops + g * at.STOP_WIDTH
        if plan[other + at.KIND] == at.LINK:
            same = plan[one + at.LEFT] == plan[other + at.LEFT]
            same = same and plan[one + at.RIGHT] == plan[other + at.RIGHT]
            turned = plan[one + at.LEFT] == plan[other + at.RIGHT]
            turned = turned and plan[one + at.RIGHT] == plan[other + at.LEFT]
            is_held = is_held or same or turned
    return is_held


@kernel
def _ways(
    plan: Vector, f: int, sign: float, fresh: bool, size: float, end: float, a: Vector
) -> float:
    """When the closing speed, times a sign, falls to zero."""
    relative(plan, f, 1, sign, a)
    share: float = fall(plan, a, size, fresh, end)
    return share


@kernel
def _of_link(
    plan: Vector, f: int, row: int, mode: int, size: float, end: float, a: Vector
) -> tuple[float, int]:
    behaviour, fresh = int(plan[row + of.BEHAVIOUR]), int(plan[int(plan[at.ZEROS]) + f])
    if behaviour == of.SMOOTH:
        return NONE, 0
    side_fresh, v_fresh = fresh & of.SIDE_FRESH != 0, fresh & of.V_FRESH != 0
    way, side = way_of_slide(plan, f, mode), side_of(plan, f, mode)
    if behaviour == of.FRICTION and mode >> f & 1:
        place, count, most = held_force(plan, f), int(plan[at.STOPS]), 0.0
        powers = int(plan[at.POWERS])
        earliest, which = NONE, 0
        for j in range(int(plan[at.ORDER]) + 1):
            most = max(most, abs(plan[powers + j] * plan[place + j * count]))
        for k in range(2):
            for j in range(int(plan[at.ORDER]) + 1):
                a[j] = plan[powers + j] * plan[place + j * count] * (1.0 if k else -1.0)
            a[0] += plan[row + _FRICTION]
            t = fall(plan, a, plan[row + _FRICTION] + 10.0 * most, False, end)
            if t <= end and t < earliest:
                earliest, which = t, k
        return earliest, which
    if held_alike(plan, f):
        return NONE, 0
    if behaviour == of.BILINEAR and side > 0.0:
        limit = plan[row + _LIMIT]
        z = node(plan, row, of.Z_NODE, int(plan[at.NODES]))
        earliest, which = NONE, 0
        for k in range(2):
            _times(plan, z, 1.0 if k else -1.0, a)
            a[0] += limit
            at_limit = side_fresh and (plan[z] < 0.0) == (k == 1)
            t = fall(plan, a, limit, at_limit, end)
            if t <= end and t < earliest:
                earliest, which = t, k
        return earliest, which
    earliest, which = NONE, 0
    if behaviour != of.OWN or int(plan[row + _FORMULA + par.OWN_FLAGS]) & 2:
        earliest = _ways(plan, f, -way, v_fresh, size, end, a)
    t = NONE
    if behaviour == of.HYSTERETIC:
        z = node(plan, row, of.Z_NODE, int(plan[at.NODES]))
        _times(plan, z, side, a)
        extent = max(abs(plan[z]), size / plan[at.STIFF_RATE])
        t = fall(plan, a, extent, side_fresh, end)
    elif behaviour == of.OWN and int(plan[row + _FORMULA + par.OWN_FLAGS]) & 1:
        relative(plan, f, 0, -side, a)
        t = fall(plan, a, size / plan[at.STIFF_RATE], side_fresh, end)
    if t <= end and t < earliest:
        earliest, which = t, 1
    return earliest, which


@kernel
def _order_of_depth(plan: Vector, f: int, mode: int, length: float) -> int:
    """The order of the zero with which a depth begins, by the rule of a clearance."""
    fresh = int(plan[at.ZEROS]) + f
    kept = plan[fresh]
    order: int = order_of_zero(plan, f, mode & ~(1 << f), 0.0, 0.0, length, 1)
    plan[fresh] = kept
    return order


@kernel
def _of_stop(
    plan: Vector, f: int, row: int, mode: int, length: float, size: float, end: float, a: Vector
) -> tuple[float, int]:
    """Of a curved stop that is touched: release (0), another piece of its law (1, of a force 2)."""
    fresh = int(plan[int(plan[at.ZEROS]) + f])
    gap = plan[int(plan[at.STOP]) + f * at.STOP_WIDTH + at.GAP]
    relative(plan, f, 0, 1.0, a)
    a[0] -= gap
    y = beyond(plan, int(plan[at.Y]))
    zeros = _order_of_depth(plan, f, mode, length) if fresh == of.DEPTH_FRESH else 0
    earliest, which = _fall_from(plan, a, speeds(plan, f, y) + abs(gap), zeros, end), 0
    t, piece, turning = NONE, 1, fresh == of.RATE_FRESH
    active = plan[row + of.ACTIVE] != 0.0
    if int(plan[row + of.BEHAVIOUR]) == of.POWER:
        if active and plan[row + _DAMPING] != 0.0:
            sign = 1.0 if plan[row + of.NAMES + 15] != 0.0 else -1.0
            t = _ways(plan, f, sign, turning, size, end, a)
        elif plan[row + _CHI] != 0.0:
            chi = plan[row + _CHI]
            relative(plan, f, 1, chi, a)
            a[0] += 1.0
            if not active:  # where it turns, its sign is rounding
                for j in range(int(plan[at.ORDER]) + 1):
                    a[j] = -a[j]
            if active or turning or a[0] >= 0.0:
                t = fall(plan, a, 1.0 + chi * size, turning, end)
    else:
        raw = node(plan, row, of.RAW_NODE, int(plan[at.NODES]))
        _times(plan, raw, 1.0 if plan[row + of.NAMES + 27] != 0.0 else -1.0, a)
        most = 0.0
        for j in range(int(plan[at.ORDER]) + 1):
            most = max(most, abs(a[j]))
        begins = fresh == of.FORCE_FRESH or (fresh != 0 and abs(a[0]) <= _WRONG * most)
        t, piece = fall(plan, a, most, begins, end), 2
        if int(plan[row + _FORMULA + par.OWN_WIDTH + par.OWN_FLAGS]) & 2:
            turns = _ways(plan, f, plan[row + of.NAMES + 23], turning, size, end, a)
            if turns < t:
                t, piece = turns, 1
    if t <= end and t < earliest:
        earliest, which = t, piece
    return earliest, which


@kernel
def _of_memory(
    plan: Vector, f: int, row: int, mode: int, length: float, size: float, end: float, a: Vector
) -> float:
    """When a stop with a memory lets its bodies go, or they meet its free face."""
    powers, order, base = int(plan[at.POWERS]), int(plan[at.ORDER]), int(plan[at.NODES])
    fresh, y = plan[int(plan[at.ZEROS]) + f], beyond(plan, int(plan[at.Y]))
    gap = plan[int(plan[at.STOP]) + f * at.STOP_WIDTH + at.GAP]
    if mode >> f & 1:
        _times(plan, node(plan, row, of.FORCE_NODE, base), 1.0, a)
        # Where it is zero its terms are not, and by these, or what they become, it is rounded.
        first(plan, row, int(plan[row + of.LAST_OP]), int(plan[row + of.LAST_SLOPE]), base)
        extent = speeds(plan, f, y) + abs(gap) + size / plan[at.STIFF_RATE]
        most = abs(plan[node(plan, row, of.BY_S, base)]) * extent
        most += abs(plan[node(plan, row, of.BY_V, base)]) * size
        z = node(plan, row, of.Z_NODE, base)
        most += abs(plan[node(plan, row, of.BY_Z, base)] * plan[z])
        begins = fresh != 0.0 and abs(a[0]) <= _WRONG * most
        share: float = fall(plan, a, most, begins, end)
        return share
    z = node(plan, row, of.Z_NODE, base)
    relative(plan, f, 0, -1.0, a)
    a[0] += gap
    for j in range(order + 1):
        a[j] += plan[powers + j] * plan[z + j]
    if fresh == 0.0 and is_positive(a, order):
        return NONE
    to_bernstein(plan, a, beyond(plan, int(plan[at.BERNSTEIN])))
    share = first_event(plan, f, mode, length, end)
    return share


@kernel
def _stays_clear(plan: Vector, f: int) -> bool:
    """Whether a free stop is farther away than its bodies can move, by the code of a step's end."""
    if not coded(plan):
        return False
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    left, right = int(plan[one + at.LEFT]), int(plan[one + at.RIGHT])
    here, reach = beyond(plan, int(plan[at.SERIES])), beyond(plan, int(plan[at.OUTPUTS]) + REACH)
    clear = plan[one + at.GAP] + here[right] - here[left]
    return bool(clear > (1.0 + _MARGIN) * (reach[left] + reach[right]))


@kernel
def first_of(
    plan: Vector, f: int, mode: int, length: float, size: float, end: float
) -> tuple[float, int]:
    """When something happens at a row, as a share of the step, or NONE; and which of its events."""
    row, a = row_of(plan, f), beyond(plan, int(plan[at.COEFFICIENTS]))
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    if plan[one + at.KIND] == at.LINK:
        event: tuple[float, int] = _of_link(plan, f, row, mode, size, end, a)
        return event
    if int(plan[row + of.BEHAVIOUR]) == of.MEMORY_STOP:
        return _of_memory(plan, f, row, mode, length, size, end, a), 0
    if plan[one + at.KIND] == at.PUSHING and mode >> f & 1:
        event = _of_stop(plan, f, row, mode, length, size, end, a)
        return event
    if mode >> f & 1 == 0 and plan[int(plan[at.ZEROS]) + f] == 0.0 and _stays_clear(plan, f):
        return NONE, 0
    watched_series(plan, f, mode, a)
    powers = int(plan[at.POWERS])
    for j in range(int(plan[at.ORDER]) + 1):
        a[j] *= plan[powers + j]
    if plan[int(plan[at.ZEROS]) + f] == 0.0 and is_positive(a, int(plan[at.ORDER])):
        return NONE, 0
    to_bernstein(plan, a, beyond(plan, int(plan[at.BERNSTEIN])))
    return first_event(plan, f, mode, length, end), 0
