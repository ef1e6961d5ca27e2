"""A motion from event to event, and over a length of time."""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.acceleration import places
from vibroimpact.engine.assembly.events import JUMPED, pack_fresh, speeds, switch_mode, unpack_fresh
from vibroimpact.engine.assembly.mode import RATES_KEPT, enter_mode
from vibroimpact.engine.assembly.rates import HEAD, rates_of_mode
from vibroimpact.engine.assembly.roots import first_fall
from vibroimpact.engine.assembly.series import (
    expand_state,
    to_bernstein,
    travel_by_series,
    watched_series,
)
from vibroimpact.engine.assembly.tables import (
    LEVELS,
    STEP_LENGTH,
    WIDTH,
    exact_rows,
    gather,
    table_of_mode,
    travel_by_tables,
)
from vibroimpact.engine.assembly.tables import is_clear as is_clear_on_leap
from vibroimpact.engine.event import GIVEN_UP, LIMIT, PASSED, event_of
from vibroimpact.engine.event_loop import unobserved
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.state import ARRIVAL, FIRST, FRESH, MODE, STEP

_SAME = 1e-12
"""Share of a step within which events are simultaneous, so that the stop's number decides."""

_WRONG = 1e-14
"""A watched function below zero by more than this share of what it is made of is so by a jump, not
by rounding."""

_ROUNDING = 2e-16
"""A watched function that goes below zero by no more than this share is a touch."""
_TINY = 1e-300

_DUST = 2.0**-48
"""A derivative below this share of what it is made of is rounding."""
_ORDERS = 6
"""Of a zero, at most."""
_DIFFERENCES = tuple(
    math.comb(at.DEGREE, k)
    * (float((-1) ** (k - i) * math.comb(k, i)) if i <= k else 2.0**k if i == 7 else 0.0)
    for k in range(_ORDERS)
    for i in range(8)
)
"""Power coefficients of Bernstein ones; the last of eight bounds their sum of magnitudes."""

_NOTHING = 1e-20
"""Share of a clearance's size below which a deformation changes no digit of it."""
_FORGOTTEN = 1e-40
"""A free deformation below this (m) has relaxed."""


@kernel
def begin(plan: Vector, amplitude: float, omega: float) -> None:
    """Take a forcing; of a record, the amplitude is a bound on its values and not used."""
    n, w = int(plan[at.MASSES]), int(plan[at.WAVES])
    shape, push = int(plan[at.SHAPE]), int(plan[at.PUSH])
    factor = amplitude
    for _ in range(int(plan[at.POWER])):
        factor *= omega
    if plan[at.RECORD] != 0.0:
        factor = 1.0
        plan[at.HIGHEST] = 0.0
    else:
        plan[at.HIGHEST] = omega * (w // 2)
    plan[at.AMPLITUDE], plan[at.OMEGA] = factor, omega
    for i in range(n * w):
        plan[push + i] = factor * plan[shape + i]
    plan[at.MODE] = -1.0
    for i in range(RATES_KEPT):
        plan[int(plan[at.RATE_OF]) + 2 * i] = -1.0
    enter_mode(plan, 0)
    plan[at.STIFF_RATE] = plan[at.RATE]
    plan[at.UNIT] = 2.0 ** -math.floor(math.log2(max(plan[at.RATE], 1e-200)))
    plan[at.USED] = 0.0
    for i in range(2 * int(max(plan[at.SLOTS], 1.0))):
        plan[int(plan[at.KEYS]) + i] = -1.0
    for i in range(int(plan[at.RATES_SLOTS])):
        plan[int(plan[at.RATES_MODE]) + i] = -1.0


@kernel
def build(plan: Vector, amplitude: float, omega: float) -> None:
    """As `begin`; tables are made when a mode is entered."""
    begin(plan, amplitude, omega)


@not_inlined
def load_motion(plan: Vector, state: Vector, s: float, c: float) -> None:
    """Take up a motion at a section, where the clock is s, c."""
    n, w, count = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.STOPS])
    y, deformation = beyond(plan, int(plan[at.Y])), beyond(plan, int(plan[at.DEFORMATION]))
    for i in range(2 * n):
        y[i] = state[FIRST + i]
    for f in range(count):
        deformation[f] = state[FIRST + 2 * n + f]
    if plan[at.RECORD] != 0.0:
        y[2 * n], y[2 * n + 1] = s, c
    else:  # the harmonics' phasors are powers of the fundamental's
        sine, cosine = s, c
        for q in range(w // 2):
            y[2 * n + 2 * q], y[2 * n + 2 * q + 1] = sine, cosine
            sine, cosine = sine * c + cosine * s, cosine * c - sine * s
    y[2 * n + w] = 1.0
    unpack_fresh(plan, state[FRESH])
    plan[at.AGE] = state[FIRST + 2 * n + count]
    enter_mode(plan, int(state[MODE]))


@not_inlined
def store_motion(plan: Vector, state: Vector) -> None:
    """Write the motion as a state with its clock."""
    n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
    y, deformation = int(plan[at.Y]), int(plan[at.DEFORMATION])
    state[MODE], state[FRESH] = plan[at.MODE], pack_fresh(plan)
    for i in range(2 * n):
        state[FIRST + i] = plan[y + i]
    for f in range(count):
        state[FIRST + 2 * n + f] = plan[deformation + f]
    end = FIRST + 2 * n + count
    state[end] = plan[at.AGE]
    state[end + 1], state[end + 2] = plan[y + 2 * n], plan[y + 2 * n + 1]


@kernel
def relax(plan: Vector, mode: int, deformation: Vector, t: float) -> None:
    """Let the free Kelvin–Voigt stops' deformations decay."""
    stops = int(plan[at.STOP])
    for f in range(int(plan[at.STOPS])):
        if deformation[f] > 0.0 and not mode >> f & 1:
            left = deformation[f] * math.exp(-plan[stops + f * at.STOP_WIDTH + at.RELAXATION] * t)
            deformation[f] = left if left > _FORGOTTEN else 0.0


@kernel
def _parts_of(plan: Vector, result: int) -> float:
    """The size of what a result of the mode's matrix is made of, but for curved laws."""
    of = places(plan)
    rates = rates_of_mode(plan, of)
    n, y = of.masses, int(plan[at.Y])
    row = rates.place + result // 8 * rates.block + HEAD + result % 8
    total: float = abs(plan[row + 8 * rates.width])
    for i in range(n):
        total += abs(plan[row + 8 * i] * plan[y + i])
        total += abs(plan[row + 8 * (n + 1 + i)] * plan[y + n + i])
    for q in range(of.waves):
        total += abs(plan[row + 8 * (rates.waves + q)] * plan[y + 2 * n + q])
    for p in range(of.pressed):
        d = plan[int(plan[at.DEFORMATION]) + int(plan[of.pressed_list + p])]
        total += abs(plan[row + 8 * (rates.width + 1 + p)] * d)
    return total


@not_inlined
def held_size(plan: Vector, f: int) -> float:
    """The size of what the force at a resting stop is made of.

    It is a difference of what its bodies would do, which may already be one in the mode's matrix.
    """
    n, count, j = int(plan[at.MASSES]), int(plan[at.STOPS]), 0
    while int(plan[int(plan[at.RESTING_LIST]) + j]) != f:
        j += 1
    one, inertia = int(plan[at.STOP]) + f * at.STOP_WIDTH, 1.0
    inertia /= plan[int(plan[at.COUPLING]) + f * count + f]
    total: float = _parts_of(plan, n + int(plan[at.PRESSED]) + j)
    for end in (at.LEFT, at.RIGHT):
        i = int(plan[one + end])
        if i < n:
            total += inertia * _parts_of(plan, i)
            if plan[at.CURVED] > 0.0:
                row, first = int(plan[at.ROW]), int(plan[at.SERIES]) + n + 1
                total += inertia * abs(plan[first + row + i]) / plan[at.PIECE_LENGTH]
    return total


@kernel
def magnitude(plan: Vector, f: int, mode: int, b: Vector) -> float:
    """The size of what a watched function is made of, by which its rounding is measured."""
    n = int(plan[at.MASSES])
    y, one = beyond(plan, int(plan[at.Y])), int(plan[at.STOP]) + f * at.STOP_WIDTH
    d = abs(plan[int(plan[at.DEFORMATION]) + f])
    if mode >> f & 1 == 0:
        size: float = abs(plan[one + at.GAP]) + speeds(plan, f, y) + d
    elif plan[one + at.KIND] == at.KELVIN_VOIGT:
        size = plan[one + at.STOP_STIFFNESS] * d
        size += plan[one + at.STOP_DAMPING] * speeds(plan, f, beyond(y, n))
    else:
        size = 0.0
        for j in range(at.DEGREE + 1):
            size = max(size, 100.0 * abs(b[j]))
        size = max(size, held_size(plan, f))
    return size


@not_inlined
def expand_watched(plan: Vector, f: int, mode: int, length: float) -> None:
    """Write a watched function by its series; tables leave in it the rounding of all that moves."""
    y, deformation = beyond(plan, int(plan[at.Y])), beyond(plan, int(plan[at.DEFORMATION]))
    expand_state(plan, y, deformation, length)
    a = beyond(plan, int(plan[at.COEFFICIENTS]))
    watched_series(plan, f, mode, a)
    to_bernstein(plan, a, beyond(plan, int(plan[at.BERNSTEIN])))


@kernel
def sizes(plan: Vector) -> tuple[float, float, float]:
    """Displacements, speeds, and what accelerations are made of, at most."""
    n, w, rate = int(plan[at.MASSES]), int(plan[at.WAVES]), plan[at.RATE]
    y, far, speed, driven = int(plan[at.Y]), 0.0, 0.0, 0.0
    for i in range(n):
        here = abs(plan[int(plan[at.CONSTANT]) + i])
        for q in range(w):
            here += abs(plan[int(plan[at.PUSH]) + i * w + q] * plan[y + 2 * n + q])
        far, speed = max(far, abs(plan[y + i])), max(speed, abs(plan[y + n + i]))
        driven = max(driven, here)
    return far, speed, driven + rate * (speed + rate * far)


@not_inlined
def order_of_zero(
    plan: Vector, f: int, mode: int, d: float, x: float, length: float, zeros: int
) -> int:
    """The order of the zero with which a watched function begins: what is rounding is zero.

    What touches may part by a high derivative, before which no sign of a rounding may decide.
    """
    pressed, one = mode >> f & 1 == 1, int(plan[at.STOP]) + f * at.STOP_WIDTH
    a, b = beyond(plan, int(plan[at.COEFFICIENTS])), beyond(plan, int(plan[at.BERNSTEIN]))
    far, speed, acceleration = sizes(plan)
    stiffness, damping, held = 1.0, 0.0, 0.0
    if pressed and plan[one + at.KIND] != at.KELVIN_VOIGT:
        stiffness, held = 0.0, held_size(plan, f)
    elif pressed:
        stiffness, damping = plan[one + at.STOP_STIFFNESS], plan[one + at.STOP_DAMPING]
    moved = far + length * (speed + length * acceleration)
    blurred = _DUST * (stiffness + damping * plan[at.RATE]) * moved
    by_tables = plan[at.TABLE_NOW] > 0.0 and zeros > 0
    if by_tables and zeros > 2:
        expand_watched(plan, f, mode, length)
        by_tables = False
    order, share, memory, size, faster = zeros, _DUST, d, speed, acceleration
    for k in range(1, 3 if d > 0.0 else _ORDERS):
        share *= length / k
        memory *= -x / k
        held *= plan[at.RATE]
        if k >= order:
            coefficient = a[k]
            if by_tables:
                coefficient = 0.0
                for i in range(k + 1):
                    coefficient += _DIFFERENCES[8 * k + i] * b[i]
                if abs(coefficient + memory) <= _DIFFERENCES[8 * k + 7] * blurred:
                    expand_watched(plan, f, mode, length)
                    by_tables, coefficient = False, a[k]
            if abs(coefficient + memory) > share * (stiffness * size + damping * faster + held):
                break
            order = k + 1
        size, faster = faster, faster * plan[at.RATE]
    if order > 2 and d == 0.0:
        # What degree 15 leaves of higher powers is none on the step, but has a curvature at 0: to
        # take off that would be seen at the end.
        if by_tables:
            expand_watched(plan, f, mode, length)
        for k in range(order):
            a[k] = 0.0
        to_bernstein(plan, a, b)
        for k in range(order):
            b[k] = 0.0
    if not pressed:
        plan[int(plan[at.ZEROS]) + f] = float(min(order, 3))
    return order


@kernel
def _reach(plan: Vector, f: int, mode: int) -> float:
    """How far the motion goes in the time in which it changes, by which an event is misplaced (m).

    Bodies that part so slowly that they have not left that rounding have not met again.
    """
    if mode >> f & 1:
        return 0.0
    n, fastest = int(plan[at.MASSES]), 0.0
    for i in range(n):
        fastest = max(fastest, abs(plan[int(plan[at.Y]) + n + i]))
    distance: float = fastest / max(plan[at.STIFF_RATE], 1e-200)
    return distance


@kernel
def first_event(plan: Vector, f: int, mode: int, length: float, end: float) -> float:
    """When a stop's watched function first falls to zero, as a share of the step, or NONE."""
    b = beyond(plan, int(plan[at.BERNSTEIN]))
    zeros = int(plan[int(plan[at.ZEROS]) + f])
    d, x, size = 0.0, 0.0, magnitude(plan, f, mode, b)
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    if mode >> f & 1 == 0:
        d = plan[int(plan[at.DEFORMATION]) + f]
        if d > _NOTHING * size and plan[one + at.KIND] == at.KELVIN_VOIGT:
            x = plan[one + at.RELAXATION] * length
        else:
            d = 0.0
    if zeros == 0 and b[0] + d <= 0.0 and plan[at.TABLE_NOW] > 0.0:
        expand_watched(plan, f, mode, length)
    if zeros == 0 and b[0] + d < -_WRONG * (size + _reach(plan, f, mode)):
        if mode >> f & 1:
            plan[int(plan[at.ZEROS]) + f] = float(JUMPED)
        return 0.0
    if zeros > 0 or b[0] + d <= 0.0:
        zeros = order_of_zero(plan, f, mode, d, x, length, zeros)
    return first_fall(b, d, x, end, zeros, _ROUNDING * size + _TINY, plan, True)


@kernel
def is_positive(a: Vector, order: int) -> bool:
    """Whether the size of a power series' terms alone shows that it is positive on [0, 1]."""
    least, other = a[0], 0.0
    for j in range(1, order, 2):  # two sums, as each waits for itself
        least += min(a[j], 0.0)
        other += min(a[j + 1], 0.0)
    if order % 2 == 1:
        least += min(a[order], 0.0)
    is_proved: bool = least + other > 0.0
    return is_proved


@kernel
def remember(plan: Vector, target: int, deformations: int) -> None:
    """Keep the present state."""
    n, w, count = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.STOPS])
    y, deformation = int(plan[at.Y]), int(plan[at.DEFORMATION])
    for i in range(2 * n + w + 1):
        plan[target + i] = plan[y + i]
    for f in range(count):
        plan[deformations + f] = plan[deformation + f]


@not_inlined
def stretch_by_tables(plan: Vector, place: int, left: float) -> int:
    """As `advance`, in a mode that has tables: a leap, a step, or the way to an event."""
    n, w, count = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.STOPS])
    mode = int(plan[at.MODE])
    zeros = beyond(plan, int(plan[at.ZEROS]))
    base = 2 * n + w + 1
    x = beyond(plan, int(plan[at.SCRATCH]))
    width = int(plan[place + WIDTH])
    buffer = beyond(x, (width + 7) // 8 * 8)
    gather(plan, x)
    h = plan[place + STEP_LENGTH]
    level = LEVELS - 1 - int(plan[at.LEVEL])
    while level > 0 and h * (1 << (level - 1)) >= left:
        level -= 1
    clear, all_clear = 0, False
    while True:  # the longest leap on which nothing can happen
        all_clear = True
        for f in range(count):
            if clear >> f & 1:
                continue
            if zeros[f] == 0.0 and is_clear_on_leap(plan, place, level, f, x, buffer):
                clear |= 1 << f
            else:
                all_clear = False
                if level > 0:
                    break
        if all_clear or level == 0:
            break
        level -= 1
    hit, end = -1, 1.0
    time = min(h * (1 << level), left)
    if all_clear:
        plan[at.LEVEL] = max(LEVELS - 2.0 - level, 0.0)
    else:
        plan[at.LEVEL] = LEVELS - 2.0
        b = beyond(plan, int(plan[at.BERNSTEIN]))
        end = time / h
        for f in range(count):
            if clear >> f & 1:
                continue
            limit = end if hit < 0 else end - _SAME
            if limit < 0.0:
                break
            exact_rows(plan, place, f, x, b)
            tau = first_event(plan, f, mode, h, limit)
            if tau <= limit:
                hit, end = f, tau
        if hit >= 0:
            time = end * h
    plan[at.PIECE_LENGTH] = h
    plan[at.PIECES] = max(math.ceil(time / h - _SAME), 1.0)
    if time > 0.0:
        travel_by_tables(plan, place, time, x, buffer)
        relax(plan, mode, beyond(plan, int(plan[at.DEFORMATION])), time)
        y, deformation = int(plan[at.Y]), int(plan[at.DEFORMATION])
        for i in range(base):
            plan[y + i] = x[i]
        for j in range(int(plan[at.PRESSED])):
            f = int(plan[int(plan[at.PRESSED_LIST]) + j])
            plan[deformation + f] = x[base + j]
    return finish(plan, mode, hit, time, end > _SAME)


@not_inlined
def next_stretch(plan: Vector, left: float) -> int:
    """Go on to the next event, at most for a step and for the time that is left.

    Returns what ended the stretch; its length is `plan[LENGTH]`. The stretch is kept
    in the plan, for `channels` and `tangent`.
    """
    n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
    y, deformation = beyond(plan, int(plan[at.Y])), beyond(plan, int(plan[at.DEFORMATION]))
    zeros = beyond(plan, int(plan[at.ZEROS]))
    mode = int(plan[at.MODE])
    plan[at.STEPS] += 1.0
    remember(plan, int(plan[at.START]), int(plan[at.START_DEFORMATION]))
    plan[at.STRETCH_MODE], plan[at.PIECES], plan[at.PIECE] = plan[at.MODE], 1.0, 0.0
    total = 0.0
    for i in range(2 * n):
        total += abs(y[i])
    if not total < 1e200:
        plan[at.EVENT], plan[at.LENGTH] = float(GIVEN_UP), 0.0
        return GIVEN_UP
    place = table_of_mode(plan)
    if place > 0:
        return stretch_by_tables(plan, place, left)
    h = at.STEP / max(plan[at.RATE], 1e-200)
    length = left if left <= h else min(h, 0.5 * left)
    expand_state(plan, y, deformation, length)
    a, b = beyond(plan, int(plan[at.COEFFICIENTS])), beyond(plan, int(plan[at.BERNSTEIN]))
    hit, end = -1, 1.0
    for f in range(count):
        watched_series(plan, f, mode, a)
        if zeros[f] == 0.0 and is_positive(a, int(plan[at.ORDER])):
            continue
        limit = end if hit < 0 else end - _SAME
        if limit < 0.0:
            break
        to_bernstein(plan, a, b)
        tau = first_event(plan, f, mode, length, limit)
        if tau <= limit:
            hit, end = f, tau
    if hit < 0 or end > 0.0:
        travel_by_series(plan, y, deformation, end)
        relax(plan, mode, deformation, end * length)
    return finish(plan, mode, hit, end * length, end > _SAME)


@kernel
def finish(plan: Vector, mode: int, hit: int, length: float, moved: bool) -> int:
    """End a stretch, by the event of a stop or by none."""
    y, deformation = beyond(plan, int(plan[at.Y])), beyond(plan, int(plan[at.DEFORMATION]))
    if moved:
        for f in range(int(plan[at.STOPS])):
            plan[int(plan[at.ZEROS]) + f] = 0.0
    plan[at.LENGTH], plan[at.AT_ONCE] = length, 0.0 if moved else 1.0
    plan[at.AGE] += length
    event = LIMIT
    if hit >= 0:
        remember(plan, int(plan[at.END]), int(plan[at.END_DEFORMATION]))
        mode, kind = switch_mode(plan, mode, hit, y, deformation)
        event = event_of(kind, hit)
        enter_mode(plan, mode)
        plan[at.AGE] = 0.0
        plan[at.LEVEL] = LEVELS - 1.0
    plan[at.EVENT] = float(event)
    return event


def advancing(next_stretch: Any) -> Any:
    """Make `flow.advance` of what goes on to the next event."""

    def advance(plan: Vector, before: Vector, limit: float, ended: Vector, after: Vector) -> int:
        """See `flow.advance`; a step ends a stretch, too, which is kept in the plan."""
        clock = FIRST + 2 * int(plan[at.MASSES]) + int(plan[at.STOPS]) + 1
        load_motion(plan, before, before[clock], before[clock + 1])
        plan[at.ORDERED_BEFORE] = plan[at.ORDERED]
        event = next_stretch(plan, limit)
        ended[STEP], ended[ARRIVAL] = plan[at.LENGTH], 0.0
        passed = event == LIMIT and plan[at.LENGTH] < limit
        if event == LIMIT and not passed:
            # A section begins as if the motion did: it is the same wherever it is taken up.
            plan[at.LEVEL] = 0.0
        store_motion(plan, after)
        return PASSED if passed else int(event)

    return kernel(advance)


advance = advancing(next_stretch)


@kernel
def cycle(plan: Vector, state: Vector, s: float, c: float, length: float, max_events: int) -> int:
    """See `flow.cycle`; a stretch takes so long that `advance` is not merged into the loop."""
    events: int = unobserved(plan, state, s, c, length, max_events)
    return events
