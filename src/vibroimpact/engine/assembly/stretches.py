"""A stretch of several masses measured: ranges, forces, impulses, work and losses.

On a piece each channel is a power series, whose extremes are found as those of a sweep
(`measures`). Gauss–Legendre quadrature with 12 points integrates a product of two of them to
rounding.
"""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.channels import close_stretch, drift_ends, observed, pieces
from vibroimpact.engine.assembly.events import LEVELS, closing
from vibroimpact.engine.assembly.measures import extend_range, staying, stops_of
from vibroimpact.engine.assembly.mode import hold
from vibroimpact.engine.channels import DEFORMATION, FORCE, evaluate, series_room
from vibroimpact.engine.event import CONTACT, GIVEN_UP, IMPACT, LIMIT, at_stop, kind_of, stop_of
from vibroimpact.engine.jit import Vector, apart, kernel
from vibroimpact.engine.memory import beyond, stack
from vibroimpact.engine.observers import phases, record
from vibroimpact.engine.observers.phases import DRIFT, MASS, STOP, SYSTEM, begin_row
from vibroimpact.engine.quadrature import ABSCISSAE, WEIGHTS
from vibroimpact.engine.state import FRESH

_AT_REST = 1e-12
"""A closing speed below this share of the largest speed is none: rest begins without an impact."""

_range_room = stack(2)


@kernel
def width(plan: Vector) -> int:
    """Length of the row of a phase."""
    masses, stops, drifts = int(plan[at.MASSES]), stops_of(plan), int(plan[at.DRIFTS])
    found: int = SYSTEM + MASS * masses + STOP * stops + DRIFT * drifts
    return found


@kernel
def _range_of(plan: Vector, c: int) -> int:
    """Where in a row the range of an observed channel stands."""
    n = int(plan[at.MASSES])
    if c < n:
        return SYSTEM + MASS * c + phases.U_LEAST
    if c < 2 * n:
        return SYSTEM + MASS * (c - n) + phases.A_LEAST
    if c == 2 * n:
        return phases.CARRIED_LEAST
    drift = SYSTEM + MASS * n + STOP * stops_of(plan) + DRIFT * (c - 2 * n - 1)
    return drift + phases.D_LEAST


_stays = staying(_range_of)


@kernel
def _velocities(plan: Vector, tau: float, v: Vector, waves: Vector) -> None:
    """Write the velocities, then that of the ground, and the forcing on a piece."""
    n, w = int(plan[at.MASSES]), int(plan[at.WAVES])
    row, order, series = int(plan[at.ROW]), int(plan[at.ORDER]), int(plan[at.SERIES]) + n + 1
    for i in range(n + 1):
        v[i] = 0.0
    for q in range(w):
        waves[q] = 0.0
    for j in range(order, -1, -1):
        here = beyond(plan, series + j * row)
        now = beyond(here, n + 1)
        for i in range(n):
            v[i] = v[i] * tau + here[i]
        for q in range(w):
            waves[q] = waves[q] * tau + now[q]


@kernel
def _left_without_speed(plan: Vector, fresh: float, f: int) -> bool:
    """Whether the bodies had just left a rigid stop without speed, by what a state says of it."""
    rest = int(fresh) // LEVELS
    while rest > 0:
        if rest % 256 // 4 - 1 == f:
            return rest % 4 >= 2
        rest //= 256
    return False


@kernel
def recorded_kind(plan: Vector, fresh: float) -> float:
    """What the event is that ends the last stretch; `fresh` as of the state before that.

    Where bodies come to rest on a rigid stop, an impact comes first, unless they have no speed any
    more.
    """
    n, event = int(plan[at.MASSES]), int(plan[at.EVENT])
    kind, f = kind_of(event), stop_of(event)
    if kind != IMPACT:
        return record.CONTACT_BEGINS if kind == CONTACT else record.DETACHMENT
    if int(plan[at.MODE]) >> f & 1 == 0:
        return record.IMPACT
    v, fastest = beyond(plan, int(plan[at.END]) + n), 0.0
    for i in range(n):
        fastest = max(fastest, abs(v[i]))
    moving = abs(closing(plan, f, v)) > _AT_REST * fastest
    again = plan[at.LENGTH] == 0.0 and _left_without_speed(plan, fresh, f)
    struck = moving and not again
    return record.IMPACT if struck else record.CONTACT_BEGINS


@apart
def _add_event(plan: Vector, before: Vector, row: Vector) -> None:
    """Write what the event is that ends a phase, and what the impact takes.

    Other rests that the bodies lean on get impulses, too.
    """
    n, count, event = int(plan[at.MASSES]), int(plan[at.STOPS]), int(plan[at.EVENT])
    f = stop_of(event)
    row[phases.KIND], row[phases.AT_STOP] = recorded_kind(plan, before[FRESH]), float(f)
    if kind_of(event) != IMPACT:
        return
    ahead, behind = beyond(plan, int(plan[at.END]) + n), beyond(plan, int(plan[at.Y]) + n)
    room = beyond(plan, int(plan[at.SCRATCH]))
    change, impulses = room, beyond(room, n)
    lost = 0.0
    for i in range(n):
        change[i] = ahead[i] - behind[i]
    for i in range(n):
        for j in range(n):
            mass = plan[int(plan[at.MASS]) + i * n + j]
            lost += 0.5 * change[i] * mass * (ahead[j] + behind[j])
    of_stops = beyond(row, SYSTEM + MASS * n)
    struck = closing(plan, f, change) / plan[int(plan[at.COUPLING]) + f * count + f]
    if int(plan[at.MODE]) >> f & 1:
        listed = int(plan[at.RESTING_LIST])
        for j in range(int(plan[at.RESTING])):
            impulses[j] = closing(plan, int(plan[listed + j]), change)
        hold(plan, impulses)
        for j in range(int(plan[at.RESTING])):
            g = int(plan[listed + j])
            if g == f:
                struck = impulses[j]
            elif plan[int(plan[at.STOP]) + g * at.STOP_WIDTH + at.KIND] == at.RIGID:
                of_stops[STOP * g + phases.IMPULSE] += impulses[j]
    if row[phases.KIND] == record.IMPACT:
        row[phases.STRUCK] = struck
        of_stops[STOP * f + phases.HIT] = lost


@apart
def _add_ends(plan: Vector, row: Vector) -> None:
    """Write the velocities at the end, how fast stops are met, and what free ones have lost."""
    n, mode = int(plan[at.MASSES]), int(plan[at.STRETCH_MODE])
    stops = stops_of(plan)
    happens = kind_of(int(plan[at.EVENT])) not in (LIMIT, GIVEN_UP)
    y = beyond(plan, int(plan[at.END] if happens else plan[at.Y]))
    deformation = beyond(plan, int(plan[at.END_DEFORMATION] if happens else plan[at.DEFORMATION]))
    before, behind = beyond(plan, int(plan[at.START_DEFORMATION])), int(plan[at.Y]) + n
    row[phases.TOUCHED] = float(mode & ((1 << stops) - 1))
    for i in range(n):
        row[SYSTEM + MASS * i + phases.ARRIVAL] = y[n + i]
        row[SYSTEM + MASS * i + phases.PARTING] = plan[behind + i]
    for f in range(stops):
        one, stop = (
            int(plan[at.STOP]) + f * at.STOP_WIDTH,
            beyond(row, SYSTEM + MASS * n + STOP * f),
        )
        speed = closing(plan, f, beyond(y, n))
        if plan[one + at.KIND] == at.KELVIN_VOIGT:
            if plan[one + at.STOP_DAMPING] > 0.0:  # a relaxing face recedes
                speed += plan[one + at.RELAXATION] * deformation[f]
            if mode >> f & 1 == 0:
                freed = before[f] * before[f] - deformation[f] * deformation[f]
                stop[phases.LOSES] += 0.5 * plan[one + at.STOP_STIFFNESS] * freed
        stop[phases.CLOSING] = speed


def _powers(channels: Any) -> Any:
    """Make what adds the powers on a piece, with what the stretches of a flow show."""
    series = channels.series

    def add_powers_of_masses(plan: Vector, row: Vector, a: Vector) -> None:
        """Add the work of the shaking and what is lost on a piece, at the nodes of a quadrature."""
        n, w, stops = int(plan[at.MASSES]), int(plan[at.WAVES]), stops_of(plan)
        mode, length = int(plan[at.MODE]), plan[at.PIECE_LENGTH]
        mass, push, damping = int(plan[at.MASS]), int(plan[at.PUSH]), int(plan[at.DAMPING])
        v = beyond(plan, int(plan[at.SCRATCH]))
        waves = beyond(v, n + 1)
        of_stops = beyond(row, SYSTEM + MASS * n)
        of_drifts = beyond(of_stops, STOP * stops)
        for k in range(len(WEIGHTS)):
            share = WEIGHTS[k] * length
            _velocities(plan, ABSCISSAE[k], v, waves)
            for i in range(n):
                momentum, pushed, damped = 0.0, 0.0, 0.0
                for j in range(n):
                    momentum += plan[mass + i * n + j] * v[j]
                for q in range(w):
                    pushed += plan[push + i * w + q] * waves[q]
                begin, end = int(plan[at.ROWS]) + 2 * i, int(plan[at.ROWS]) + 2 * i + 1
                for j in range(int(plan[begin]), int(plan[end])):
                    damped += plan[damping + i * n + j] * v[j]
                row[phases.WORK] += share * momentum * pushed
                row[phases.LOST] += share * momentum * damped
            for d in range(int(plan[at.DRIFTS])):
                left, right = drift_ends(plan, d)
                rate = v[right] - v[left]
                dashpot = plan[int(plan[at.DRIFT]) + d * at.DRIFT_WIDTH + at.DRIFT_DAMPING]
                of_drifts[DRIFT * d + phases.D_LOST] += share * dashpot * rate * rate
            for f in range(stops):
                one = int(plan[at.STOP]) + f * at.STOP_WIDTH
                if mode >> f & 1 == 0 or plan[one + at.KIND] == at.RIGID:
                    continue
                rate = v[int(plan[one + at.LEFT])] - v[int(plan[one + at.RIGHT])]
                if plan[one + at.KIND] == at.KELVIN_VOIGT:
                    lost = plan[one + at.STOP_DAMPING] * rate * rate
                else:  # what it takes up while it is touched, it gives back or loses
                    order = series(plan, FORCE, f, a)
                    lost = rate * evaluate(a, order, ABSCISSAE[k])
                of_stops[STOP * f + phases.LOSES] += share * lost

    return apart(add_powers_of_masses)


def measuring(channels: Any) -> Any:
    """Make what adds a stretch of a flow to a row, with what its stretches show.

    It is called with the plan, the state before the stretch, whether more than ranges, impulses and
    impacts is looked for, and the row.
    """
    open_stretch, open_piece, series = channels.open_stretch, channels.open_piece, channels.series
    add_powers_of_masses = _powers(channels)

    def measure(plan: Vector, before: Vector, everything: bool, row: Vector) -> None:
        n, stops, mode = int(plan[at.MASSES]), stops_of(plan), int(plan[at.STRETCH_MODE])
        a, b, range_ = series_room(), series_room(), _range_room()
        of_stops = beyond(row, SYSTEM + MASS * n)
        count = 2 * n + 1 + int(plan[at.DRIFTS])
        left = pieces(plan) if plan[at.LENGTH] > 0.0 else 0
        if not everything and _stays(plan, count, row):
            left = 0
        if left > 0:
            open_stretch(plan)
        for piece in range(left):
            open_piece(plan, piece)
            for c in range(count):
                order = observed(plan, c, a, b)
                extend_range(plan, b, order, beyond(row, _range_of(plan, c)))
            for f in range(stops):
                if mode >> f & 1 == 0:
                    continue
                stop = beyond(of_stops, STOP * f)
                order = series(plan, FORCE, f, a)
                for j in range(order + 1):
                    stop[phases.IMPULSE] += plan[at.PIECE_LENGTH] * a[j] / (j + 1)
                range_[0], range_[1] = -math.inf, stop[phases.FORCE]
                extend_range(plan, a, order, range_)
                stop[phases.FORCE] = range_[1]
                order = series(plan, DEFORMATION, f, a)
                range_[0], range_[1] = -math.inf, stop[phases.DEPTH]
                extend_range(plan, a, order, range_)
                stop[phases.DEPTH] = range_[1]
            if everything:
                add_powers_of_masses(plan, row, a)
        if left > 0:
            close_stretch(plan)
        if everything:
            _add_ends(plan, row)
        if at_stop(int(plan[at.EVENT])):
            _add_event(plan, before, row)

    return kernel(measure)


def demanding(channels: Any) -> tuple[Any, Any]:
    """Make `flow.measure` and `flow.demand` of a flow's channels."""
    add = measuring(channels)

    def measure(plan: Vector, before: Vector, ended: Vector, after: Vector, row: Vector) -> None:
        add(plan, before, True, row)

    def demand(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
        whole = width(plan)
        hits = beyond(notes, whole)
        row = notes
        everything = hits[stops_of(plan)] != 0.0
        row[phases.KIND], row[phases.STRUCK] = phases.NOTHING, 0.0
        add(plan, before, everything, row)
        if row[phases.KIND] not in (record.CONTACT_BEGINS, record.IMPACT):
            return
        f = int(row[phases.AT_STOP])
        stop = int(plan[at.STOP]) + f * at.STOP_WIDTH
        if row[phases.KIND] == record.IMPACT:
            of = beyond(row, SYSTEM + MASS * int(plan[at.MASSES]) + STOP * f)
            of[phases.FORCE] = math.inf
            of[phases.IMPULSE] += row[phases.STRUCK]
            of[phases.LOSES] += of[phases.HIT]
            of[phases.HIT] = 0.0
            hits[f] += 1.0
        elif plan[stop + at.KIND] != at.RIGID:
            hits[f] += 1.0

    return kernel(measure), kernel(demand)


@kernel
def start_demand(plan: Vector, notes: Vector, everything: int) -> None:
    """Begin the row of a whole motion.

    Then come the contacts begun at each stop, and whether energies are looked for. Impulses
    and losses of impacts are added to those of the stop.
    """
    whole, stops = width(plan), stops_of(plan)
    begin_row(notes, int(plan[at.MASSES]), int(plan[at.DRIFTS]), whole)
    for f in range(stops):
        notes[whole + f] = 0.0
    notes[whole + stops] = float(everything)
