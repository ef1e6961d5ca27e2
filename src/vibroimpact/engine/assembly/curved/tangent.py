"""What becomes of small disturbances under curved laws; see `assembly.tangent`.

A disturbance is a row (δu, δv, δ of each row's number: a deformation, a memory, the speed at which
a stop was met) at a fixed phase. Along a stretch it obeys the linear equation with the slopes of
the laws, whose series are on the tape. Where a branch of a law begins, forces are continuous but
for those of friction. There, and at stops, δv += (a⁻ − a⁺) δt with the delay δt = −δg/ġ of the
event.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.acceleration import drive, places, restrain
from vibroimpact.engine.assembly.channels import close_stretch, fade
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved.advance import reopen
from vibroimpact.engine.assembly.curved.branches import side_of
from vibroimpact.engine.assembly.curved.numbers import enter, size_of
from vibroimpact.engine.assembly.curved.step import travel
from vibroimpact.engine.assembly.curved.terms import (
    accelerations_of_all,
    expand_over,
    expand_slopes,
    node,
    remembers,
    row_of,
)
from vibroimpact.engine.assembly.events import closing, halt
from vibroimpact.engine.assembly.tangent import disturbing, meet, note, reflect
from vibroimpact.engine.event import (
    CONTACT,
    DETACHMENT,
    GIVEN_UP,
    IMPACT,
    LIMIT,
    kind_of,
    stop_of,
)
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.state import DAMPING

_LAST = 2.0**-47
"""What the last term of the slopes may be."""
_REACH = 1.6
"""Of a disturbance's own rate times the step; of exp(1.6) the series leaves out 5e-15."""
_DISSIPATION = of.NUMBERS + par.BUMPER + par.DISSIPATION
_CHI = of.NAMES + 14


@kernel
def tie(plan: Vector, row: Vector) -> None:
    """What a row's number is bound to in the present mode."""
    n, mode = int(plan[at.MASSES]), int(plan[at.MODE])
    for f in range(int(plan[at.STOPS])):
        one, law = int(plan[at.STOP]) + f * at.STOP_WIDTH, row_of(plan, f)
        kind, touched = plan[one + at.KIND], mode >> f & 1 == 1
        if kind == at.RIGID:
            row[2 * n + f] = 0.0
        elif kind == at.KELVIN_VOIGT:
            if touched:
                row[2 * n + f] = closing(plan, f, row)
            elif plan[one + at.STOP_DAMPING] == 0.0:
                row[2 * n + f] = 0.0
        elif touched and plan[law + of.TIED] != 0.0:
            row[2 * n + f] = closing(plan, f, row)
        elif kind == at.PUSHING and not remembers(plan, law):
            if not touched or not plan[law + _DISSIPATION] < 0.0:
                row[2 * n + f] = 0.0
        elif not remembers(plan, law) or _yields(plan, f, mode):
            row[2 * n + f] = 0.0


@kernel
def _yields(plan: Vector, f: int, mode: int) -> bool:
    behaviour = int(plan[row_of(plan, f) + of.BEHAVIOUR])
    return bool(behaviour == of.BILINEAR and side_of(plan, f, mode) < 0.0)


unit_disturbances = disturbing(tie)


@kernel
def _convolved(plan: Vector, a: int, b: int, stride: int, k: int) -> float:
    total = 0.0
    for j in range(k + 1):
        total += plan[a + k - j] * plan[b + j * stride]
    return total


@kernel
def _difference(plan: Vector, a: int, b: int, c: int, stride: int, k: int) -> float:
    """Coefficient k of series a times the difference of two others, whose terms are apart."""
    total = 0.0
    for j in range(k + 1):
        total += plan[a + k - j] * (plan[b + j * stride] - plan[c + j * stride])
    return total


@kernel
def _moved(plan: Vector, row: Vector, h: float) -> None:
    """Carry one disturbance over the step in hand, over the series of the motion."""
    of_ = places(plan)
    n, w, count = of_.masses, of_.waves, int(plan[at.STOPS])
    width, v, order = int(plan[at.ROW]), n + 1, int(plan[at.ORDER])
    series, none = int(plan[at.SERIES]), beyond(plan, int(plan[at.OUTPUTS]))
    forces, base, point = int(plan[at.FORCE_SERIES]), int(plan[at.NODES]), int(plan[at.POINT])
    for q in range(w):
        none[q] = 0.0
    for i in range(n):
        plan[series + i], plan[series + v + i] = row[i], row[n + i]
    plan[series + n], plan[series + v + n] = 0.0, 0.0
    for f in range(count):
        law = row_of(plan, f)
        if remembers(plan, law):
            plan[node(plan, law, of.Z_NODE, point)] = row[2 * n + f]
    for k in range(order):
        here, force = series + k * width, forces + k * count
        after = here + width + v
        for p in range(of_.pressed):
            one = of_.stops + int(plan[of_.pressed_list + p]) * at.STOP_WIDTH
            left, right = int(plan[one + at.LEFT]), int(plan[one + at.RIGHT])
            plan[force + p] = plan[here + left] - plan[here + right]
        held = beyond(plan, force)
        drive(plan, of_, beyond(plan, here), none, held, 0.0, after)
        factor = h / (k + 1)
        for f in range(count):
            law, one = row_of(plan, f), of_.stops + f * at.STOP_WIDTH
            behaviour = int(plan[law + of.BEHAVIOUR])
            if behaviour in (0, of.FRICTION):
                continue
            left, right = series + int(plan[one + at.LEFT]), series + int(plan[one + at.RIGHT])
            push = 0.0
            if plan[law + of.ACTIVE] != 0.0:
                by_s, by_v = node(plan, law, of.BY_S, base), node(plan, law, of.BY_V, base)
                push = _difference(plan, by_s, left, right, width, k)
                push += _difference(plan, by_v, left + v, right + v, width, k)
                if behaviour == of.POWER and row[2 * n + f] != 0.0:
                    chi = plan[node(plan, law, of.BY_CHI, base) + k]
                    met = plan[int(plan[at.PIECE_DEFORMATION]) + f]
                    if met > 0.0:
                        push -= chi * plan[law + _CHI] / met * row[2 * n + f]
            if remembers(plan, law):
                z = node(plan, law, of.Z_NODE, point)
                sign = 1.0 if behaviour == of.MEMORY_STOP else -1.0
                push += sign * _convolved(plan, node(plan, law, of.BY_Z, base), z, 1, k)
                by_v = node(plan, law, of.FLOW_BY_V, base)
                grown = sign * _difference(plan, by_v, left + v, right + v, width, k)
                if behaviour == of.MEMORY_STOP:
                    by_s = node(plan, law, of.FLOW_BY_S, base)
                    grown += _difference(plan, by_s, left, right, width, k)
                by_z = node(plan, law, of.FLOW_BY_Z, base)
                plan[z + k + 1] = factor * (grown + _convolved(plan, by_z, z, 1, k))
            for i in range(int(plan[one + at.FIRST]), int(plan[one + at.BEHIND])):
                plan[after + i] -= plan[of_.response + f * n + i] * push
        restrain(plan, of_, beyond(held, of_.pressed), after)
        for i in range(n):
            plan[here + width + i] = factor * plan[here + v + i]
            plan[after + i] *= factor
        plan[here + width + n], plan[after + n] = 0.0, 0.0
    for i in range(n):
        for part in range(2):
            first, total = series + part * v + i, 0.0
            for k in range(order, -1, -1):
                total += plan[first + k * width]
            row[part * n + i] = total
    for f in range(count):
        law = row_of(plan, f)
        if remembers(plan, law):
            z, total = node(plan, law, of.Z_NODE, point), 0.0
            for k in range(order, -1, -1):
                total += plan[z + k]
            row[2 * n + f] = total


@kernel
def _too_long(plan: Vector, h: float) -> float:
    """By how much a step is too long for disturbances, if above 1."""
    count, base, last = int(plan[at.STOPS]), int(plan[at.NODES]), int(plan[at.ORDER])
    most: float = plan[at.RATE] * h / _REACH
    for f in range(count):
        law = row_of(plan, f)
        if int(plan[law + of.BEHAVIOUR]) in (0, of.FRICTION) or plan[law + of.ACTIVE] == 0.0:
            continue
        meets = plan[int(plan[at.COUPLING]) + f * count + f]
        by_s, by_v = node(plan, law, of.BY_S, base), node(plan, law, of.BY_V, base)
        own = max(abs(plan[by_v]) * meets, math.sqrt(abs(plan[by_s]) * meets))
        if int(plan[law + of.BEHAVIOUR]) == of.MEMORY_STOP:
            own = max(own, abs(plan[node(plan, law, of.FLOW_BY_Z, base)]))
        most = max(most, own * h / _REACH)
        for k in range(last - 1, last + 1):
            term = (abs(plan[by_v + k]) + abs(plan[by_s + k]) * h) * meets * h
            if term > _LAST:
                most = max(most, 1.1 * (term / _LAST) ** (1.0 / (last - 1)))
    return most


@kernel
def _lost(plan: Vector, h: float) -> float:
    """What curved laws take of a volume on the step in hand, as an exponent."""
    count, base, total = int(plan[at.STOPS]), int(plan[at.NODES]), 0.0
    for f in range(count):
        law = row_of(plan, f)
        if int(plan[law + of.BEHAVIOUR]) in (0, of.FRICTION) or plan[law + of.ACTIVE] == 0.0:
            continue
        meets = plan[int(plan[at.COUPLING]) + f * count + f]
        by_v, by_z = node(plan, law, of.BY_V, base), node(plan, law, of.FLOW_BY_Z, base)
        for k in range(int(plan[at.ORDER]) + 1):
            total += h * meets * plan[by_v + k] / (k + 1)
            if remembers(plan, law):
                total -= h * plan[by_z + k] / (k + 1)
    return total


@not_inlined
def carry_along_series(plan: Vector, q: Vector, rows: int) -> float:
    """Carry the rows of q through the last stretch and its event.

    Returns what curved laws took of a volume of (u, v, z), as an exponent.
    """
    n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
    width, event, lost = 2 * n + count, int(plan[at.EVENT]), 0.0
    reopen(plan)
    y = beyond(plan, int(plan[at.PIECE_Y]))
    deformation = beyond(plan, int(plan[at.PIECE_DEFORMATION]))
    left = plan[at.LENGTH]
    least = 1e-6 * left
    while left > 0.0:
        h = left
        for _ in range(60):
            expand_over(plan, y, deformation, h)
            expand_slopes(plan)
            excess = _too_long(plan, h)
            if excess <= 1.0 or h <= least:
                break
            h = max(h / max(excess, 1.05), least)
        lost += _lost(plan, h)
        travel(plan, y, deformation, 1.0)
        fade(plan, deformation, h)
        for i in range(rows):
            row = beyond(q, i * width)
            _moved(plan, row, h)
            fade(plan, beyond(row, 2 * n), h)
        left = 0.0 if h >= left else left - h
    here = int(plan[at.ROOM])
    there = here + 2 * (n + 1 + count)
    rates = there + 2 * (n + 1 + count)
    jumps = kind_of(event) not in (LIMIT, GIVEN_UP)
    if jumps:
        accelerations_of_all(
            plan,
            beyond(plan, int(plan[at.END])),
            beyond(plan, int(plan[at.END_DEFORMATION])),
            here,
        )
        _rates(plan, rates)
    before = int(plan[at.STRETCH_MODE])
    close_stretch(plan)
    if not jumps:
        return lost
    now, numbers = beyond(plan, int(plan[at.Y])), beyond(plan, int(plan[at.DEFORMATION]))
    enter(plan, now, numbers, size_of(plan, now))
    accelerations_of_all(plan, now, numbers, there)
    _rates(plan, rates + count)
    for i in range(rows):
        _jump(plan, beyond(q, i * width), before, here, there, rates)
    return lost


@kernel
def _rates(plan: Vector, into: int) -> None:
    """Write z′ of each row, as the laws were evaluated last."""
    for f in range(int(plan[at.STOPS])):
        law, rate = row_of(plan, f), 0.0
        if remembers(plan, law):
            rate = plan[node(plan, law, of.FLOW_NODE, int(plan[at.POINT]))]
        plan[into + f] = rate


@kernel
def _jump(plan: Vector, row: Vector, before: int, here: int, there: int, rates: int) -> None:
    n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
    event, mode = int(plan[at.EVENT]), int(plan[at.MODE])
    f, happens = stop_of(event), kind_of(event)
    one, law = int(plan[at.STOP]) + f * at.STOP_WIDTH, row_of(plan, f)
    kind, late = plan[one + at.KIND], 0.0
    arrived = beyond(plan, int(plan[at.END]) + n)
    speed = closing(plan, f, arrived)
    if happens == IMPACT:
        late = -closing(plan, f, row) / speed if speed > 0.0 else 0.0
        for g in range(count):
            row[2 * n + g] += (plan[rates + g] - plan[rates + count + g]) * late
        reflect(plan, row, beyond(plan, here), beyond(plan, there))
    elif int(plan[law + of.BEHAVIOUR]) == of.MEMORY_STOP:
        recedes = plan[rates + f] - speed
        if happens == CONTACT and recedes != 0.0:
            late = (closing(plan, f, row) - row[2 * n + f]) / recedes
            for i in range(n):
                row[n + i] += (plan[here + i] - plan[there + i]) * late
            for g in range(count):
                row[2 * n + g] += (plan[rates + g] - plan[rates + count + g]) * late
    elif kind == at.PUSHING and happens in (CONTACT, DETACHMENT):
        if speed != 0.0:
            late = -closing(plan, f, row) / speed
        met = closing(plan, f, beyond(row, n)) + late * closing(plan, f, beyond(plan, here))
        for i in range(n):
            row[n + i] += (plan[here + i] - plan[there + i]) * late
        row[2 * n + f] = met if happens == CONTACT and speed > 0.0 else 0.0
    elif happens == CONTACT:
        meet(plan, row)
    elif int(plan[law + of.BEHAVIOUR]) == of.FRICTION and not before >> f & 1:
        gains = closing(plan, f, beyond(plan, here))
        late = -closing(plan, f, beyond(row, n)) / gains if gains != 0.0 else 0.0
        for i in range(n):
            row[n + i] += (plan[here + i] - plan[there + i]) * late
        if mode >> f & 1:
            halt(plan, row)
    tie(plan, row)


@kernel
def tangent(
    plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector, q: Vector
) -> None:
    """See `flow.tangent`."""
    note(plan, notes)
    lost = carry_along_series(plan, q, 2 * int(plan[at.MASSES]) + int(plan[at.STOPS]))
    notes[DAMPING] += lost
