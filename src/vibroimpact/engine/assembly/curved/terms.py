"""The series of all masses with curved laws, order by order."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved import tape as op
from vibroimpact.engine.assembly.curved.branches import way_of_slide
from vibroimpact.engine.assembly.series import Places, drive, expanding, places, restrain
from vibroimpact.engine.jit import Vector, apart, kernel
from vibroimpact.engine.memory import beyond

_T = at.TERMS
(
    _CONSTANT, _ADD, _SUBTRACT, _NEGATE, _MULTIPLY, _SCALE, _SHIFT, _POWER, _EXP, _SINE, _COSINE,
    _TANH, _FLAT,
) = range(op.CONSTANT, op.FLAT + 1)  # fmt: skip


@kernel
def row_of(plan: Vector, f: int) -> int:
    """Where the numbers of a row's law begin."""
    return int(plan[at.LAWS]) + f * of.WIDTH


@kernel
def node(plan: Vector, row: int, which: int, base: int) -> int:
    """Where the series of what goes into a row's law, or comes out, begins."""
    return base + int(plan[row + which]) * _T


@kernel
def _product(plan: Vector, a: int, b: int, k: int) -> float:
    total = 0.0
    for j in range(k + 1):
        total += plan[a + j] * plan[b + k - j]
    return total


@kernel
def _driven(plan: Vector, a: int, b: int, k: int) -> float:
    """Σ j a_j b_(k−j) / k: coefficient k of what has the slope a′ b."""
    total = 0.0
    for j in range(1, k + 1):
        total += j * plan[a + j] * plan[b + k - j]
    return total / k


@kernel
def first(plan: Vector, row: int, begin: int, end: int, base: int) -> None:
    """Write coefficient 0 of what operations of a law make, their constants included."""
    tape = int(plan[at.TAPE])
    for i in range(begin, end):
        one = tape + i * of.OP_WIDTH
        code = int(plan[one])
        if code == op.INPUT:
            continue
        out = base + i * _T
        if code == _CONSTANT:
            value = plan[one + 3]
            plan[out] = plan[row + int(value)] if plan[one + 1] != 0.0 else value
            continue
        x = plan[base + int(plan[one + 1]) * _T]
        y = plan[base + int(plan[one + 2]) * _T]
        if code in (_ADD, _SHIFT):
            plan[out] = x + y
        elif code == _SUBTRACT:
            plan[out] = x - y
        elif code == _NEGATE:
            plan[out] = -x
        elif code in (_MULTIPLY, _SCALE):
            plan[out] = x * y
        elif code == _POWER:
            plan[out] = x**y if x > 0.0 or y == -1.0 else 0.0
        elif code == _EXP:
            plan[out] = math.exp(x)
        elif code == _SINE:
            plan[out] = math.sin(x)
        elif code == _COSINE:
            plan[out] = math.cos(x)
        elif code == _TANH:
            plan[out] = math.tanh(x)
        elif code == _FLAT:
            small = math.exp(-2.0 * abs(x))
            plan[out] = 4.0 * small / ((1.0 + small) * (1.0 + small))


@kernel
def further(plan: Vector, begin: int, end: int, k: int, base: int) -> None:
    """Write coefficient k > 0 of what operations of a law make."""
    tape = int(plan[at.TAPE])
    for i in range(begin, end):
        one = tape + i * of.OP_WIDTH
        code = int(plan[one])
        if code == op.INPUT:
            continue
        out = base + i * _T
        a, b = base + int(plan[one + 1]) * _T, base + int(plan[one + 2]) * _T
        if code == _ADD:
            plan[out + k] = plan[a + k] + plan[b + k]
        elif code == _SHIFT:
            plan[out + k] = plan[a + k]
        elif code == _SUBTRACT:
            plan[out + k] = plan[a + k] - plan[b + k]
        elif code == _NEGATE:
            plan[out + k] = -plan[a + k]
        elif code == _SCALE:
            plan[out + k] = plan[a + k] * plan[b]
        elif code == _MULTIPLY:
            plan[out + k] = _product(plan, a, b, k)
        elif code == _POWER:
            total, more = 0.0, plan[b] + 1.0
            for j in range(1, k + 1):
                total += (more * j - k) * plan[a + j] * plan[out + k - j]
            plan[out + k] = total / (k * plan[a])
        elif code == _EXP:
            plan[out + k] = _driven(plan, a, out, k)
        elif code in (_SINE, _TANH):
            plan[out + k] = _driven(plan, a, b, k)
        elif code == _COSINE:
            plan[out + k] = -_driven(plan, a, b, k)
        elif code == _FLAT:
            plan[out + k] = -_product(plan, b, b, k)


@kernel
def push(plan: Vector, of_: Places, here: Vector, k: int, base: int, into: int) -> None:
    """Add what curved rows do to the accelerations of order k; `here` is u, 0, v, 0.

    Where a law remembers, z of this order stands in its node.
    """
    n = of_.masses
    mode = int(plan[at.MODE])
    for f in range(int(plan[at.STOPS])):
        row, one = row_of(plan, f), of_.stops + f * at.STOP_WIDTH
        behaviour = int(plan[row + of.BEHAVIOUR])
        if behaviour == 0 or plan[row + of.ACTIVE] == 0.0:
            continue
        if behaviour == of.FRICTION:
            if k > 0 or mode >> f & 1:
                continue
            force = plan[row + _FRICTION] * -way_of_slide(plan, f, mode)
        else:
            left, right = int(plan[one + at.LEFT]), int(plan[one + at.RIGHT])
            x, v = here[left] - here[right], here[n + 1 + left] - here[n + 1 + right]
            link = plan[one + at.KIND] == at.LINK
            if link:
                x, v = -x, -v
            elif k == 0:
                x = max(x - plan[one + at.GAP], 0.0)
            plan[node(plan, row, of.S_NODE, base) + k] = x
            plan[node(plan, row, of.V_NODE, base) + k] = v
            begin, end = int(plan[row + of.FIRST_OP]), int(plan[row + of.LAST_OP])
            if k == 0:
                first(plan, row, begin, end, base)
            else:
                further(plan, begin + int(plan[row + of.CONSTANTS]), end, k, base)
            force = plan[node(plan, row, of.FORCE_NODE, base) + k]
            if link:
                force = -force
        for i in range(int(plan[one + at.FIRST]), int(plan[one + at.BEHIND])):
            plan[into + i] -= plan[of_.response + f * n + i] * force


_FRICTION = of.NUMBERS + par.FRICTION


@apart
def expand_slopes(plan: Vector) -> None:
    """Write the series of the slopes of all forces that act, over the series in hand."""
    base = int(plan[at.NODES])
    for f in range(int(plan[at.STOPS])):
        row = row_of(plan, f)
        behaviour = int(plan[row + of.BEHAVIOUR])
        if behaviour in (0, of.FRICTION) or plan[row + of.ACTIVE] == 0.0:
            continue
        begin, end = int(plan[row + of.LAST_OP]), int(plan[row + of.LAST_SLOPE])
        first(plan, row, begin, end, base)
        begin += int(plan[row + of.SLOPE_CONSTANTS])
        for k in range(1, int(plan[at.ORDER]) + 1):
            further(plan, begin, end, k, base)


@kernel
def remembers(plan: Vector, row: int) -> bool:
    """Whether a row has a memory that the series carry."""
    return int(plan[row + of.BEHAVIOUR]) in (of.HYSTERETIC, of.BILINEAR)


@kernel
def _begin(plan: Vector, deformation: Vector) -> None:
    for f in range(int(plan[at.STOPS])):
        law = row_of(plan, f)
        if remembers(plan, law):
            plan[node(plan, law, of.Z_NODE, int(plan[at.NODES]))] = deformation[f]


@kernel
def _push(plan: Vector, of_: Places, here: Vector, j: int, after: int) -> None:
    push(plan, of_, here, j, int(plan[at.NODES]), after)


@kernel
def _grow(plan: Vector, factor: float, j: int) -> None:
    base = int(plan[at.NODES])
    for f in range(int(plan[at.STOPS])):
        law = row_of(plan, f)
        if remembers(plan, law):
            grown = plan[node(plan, law, of.FLOW_NODE, base) + j]
            plan[node(plan, law, of.Z_NODE, base) + j + 1] = factor * grown


expand_all = expanding(_begin, _push, _grow)


@apart
def shorten(plan: Vector, tau: float) -> None:
    """Turn the series in hand into series on this share of their length."""
    n, w, count = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.STOPS])
    row, base = 2 * (n + 1), int(plan[at.NODES])
    series, waves, forces = (
        int(plan[at.SERIES]),
        int(plan[at.WAVE_SERIES]),
        int(plan[at.FORCE_SERIES]),
    )
    power = 1.0
    for j in range(1, int(plan[at.ORDER]) + 1):
        power *= tau
        for i in range(row):
            plan[series + j * row + i] *= power
        for q in range(w):
            plan[waves + j * w + q] *= power
        for p in range(count):
            plan[forces + j * count + p] *= power
        for f in range(count):
            law = row_of(plan, f)
            if plan[law + of.ACTIVE] == 0.0:
                continue
            begin = int(plan[law + of.FIRST_OP]) + int(plan[law + of.CONSTANTS])
            for i in range(begin, int(plan[law + of.LAST_OP])):
                plan[base + i * _T + j] *= power
    plan[at.PIECE_LENGTH] *= tau


@apart
def accelerations_of_all(plan: Vector, y: Vector, deformation: Vector, place: int) -> None:
    """Write the accelerations of a state y, u, v, w, in the mode that was entered.

    After n + 1 of them follow the forces of those pressed and of those held. What the laws make
    stands in the nodes of a point.
    """
    of_ = places(plan)
    n, base = of_.masses, int(plan[at.POINT])
    here = beyond(plan, int(plan[at.SCRATCH]))
    for i in range(n):
        here[i], here[n + 1 + i] = y[i], y[n + i]
    here[n], here[2 * n + 1] = 0.0, 0.0
    forces = beyond(plan, place + n + 1)
    for p in range(of_.pressed):
        forces[p] = deformation[int(plan[of_.pressed_list + p])]
    for f in range(int(plan[at.STOPS])):
        law = row_of(plan, f)
        if remembers(plan, law):
            plan[node(plan, law, of.Z_NODE, base)] = deformation[f]
    drive(plan, of_, here, beyond(y, 2 * n), forces, 1.0, place)
    push(plan, of_, here, 0, base, place)
    restrain(plan, of_, beyond(forces, of_.pressed), place)
