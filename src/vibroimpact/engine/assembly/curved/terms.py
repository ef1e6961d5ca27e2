"""The series of all masses with curved laws, order by order."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.acceleration import Places, places
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved import tape as op
from vibroimpact.engine.assembly.curved.branches import way_of_slide
from vibroimpact.engine.assembly.curved.emitted import call
from vibroimpact.engine.assembly.rates import HEAD, apply_rates, closed_place, rates_of_mode
from vibroimpact.engine.assembly.series import expanding
from vibroimpact.engine.assembly.vectors import convolve, convolve_weighted
from vibroimpact.engine.jit import Vector, inlined, kernel, not_inlined
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
    """Coefficient k > 0 of a product; what is computed last is added last, as it is waited for."""
    known: float = convolve(plan, a + 1, b + k - 1, k - 1)
    total: float = known + plan[a] * plan[b + k] + plan[a + k] * plan[b]
    return total


@kernel
def _driven(plan: Vector, a: int, b: int, k: int) -> float:
    """Σ j a_j b_(k−j) / k: coefficient k > 0 of what has the slope a′ b."""
    known: float = convolve_weighted(plan, a + 1, b + k - 1, k - 1, 1.0, 1.0)
    total: float = known / k + plan[a + k] * plan[b]
    return total


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


@inlined
def _coefficient(plan: Vector, code: int, out: int, a: int, b: int, k: int) -> None:
    """Write coefficient k > 0 of one operation."""
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
        more = plan[b] + 1.0
        known = convolve_weighted(plan, a + 1, out + k - 1, k - 1, more - k, more)
        plan[out + k] = (known / k + plan[b] * plan[a + k] * plan[out]) / plan[a]
    elif code == _EXP:
        plan[out + k] = _driven(plan, a, out, k)
    elif code in (_SINE, _TANH):
        plan[out + k] = _driven(plan, a, b, k)
    elif code == _COSINE:
        plan[out + k] = -_driven(plan, a, b, k)
    elif code == _FLAT:
        plan[out + k] = -_product(plan, b, b, k)


@kernel
def further(plan: Vector, begin: int, end: int, k: int, last: int, base: int) -> None:
    """Write coefficients k > 0 to `last` of what operations of a law make, one after the other."""
    tape = int(plan[at.TAPE])
    for i in range(begin, end):
        one = tape + i * of.OP_WIDTH
        code = int(plan[one])
        if code == op.INPUT:
            continue
        out = base + i * _T
        a, b = base + int(plan[one + 1]) * _T, base + int(plan[one + 2]) * _T
        for m in range(k, last + 1):
            _coefficient(plan, code, out, a, b, m)


@inlined
def _strain(plan: Vector, row: int, one: int, here: Vector, k: int, base: int) -> None:
    """Write s and s′ of a row, of order k."""
    n = int(plan[at.MASSES])
    left, right = int(plan[one + at.LEFT]), int(plan[one + at.RIGHT])
    x, v = here[left] - here[right], here[n + 1 + left] - here[n + 1 + right]
    if plan[one + at.KIND] == at.LINK:
        x, v = -x, -v
    elif k == 0:
        x -= plan[one + at.GAP]
        if int(plan[row + of.BEHAVIOUR]) != of.MEMORY_STOP:
            x = max(x, 0.0)
    plan[node(plan, row, of.S_NODE, base) + k] = x
    plan[node(plan, row, of.V_NODE, base) + k] = v


@kernel
def push(plan: Vector, of_: Places, here: Vector, k: int, base: int, forces: Vector) -> None:
    """Write the forces of curved rows of order k, as they close; `here` is u, 0, v, 0.

    Where a law remembers, z of this order stands in its node.
    """
    mode, place = int(plan[at.MODE]), -1
    for f in range(int(plan[at.STOPS])):
        row, one = row_of(plan, f), of_.stops + f * at.STOP_WIDTH
        behaviour = int(plan[row + of.BEHAVIOUR])
        if behaviour == 0:
            continue
        place += 1
        force = 0.0
        if behaviour == of.FRICTION:
            if k == 0 and not mode >> f & 1:
                force = plan[row + _FRICTION] * -way_of_slide(plan, f, mode)
        elif plan[row + of.ACTIVE] != 0.0:
            link = plan[one + at.KIND] == at.LINK
            # What depends on s alone is written two orders at once.
            alone = behaviour == of.SMOOTH
            if k == 0 or k % 2 == 1 or not alone:
                _strain(plan, row, one, here, k, base)
                begin, end = int(plan[row + of.FIRST_OP]), int(plan[row + of.LAST_OP])
                if k == 0:
                    first(plan, row, begin, end, base)
                else:
                    last = k
                    if alone and k < int(plan[at.ORDER]):
                        last = k + 1
                        _strain(plan, row, one, beyond(here, int(plan[at.ROW])), last, base)
                    further(plan, begin + int(plan[row + of.KNOWN]), end, k, last, base)
            force = plan[node(plan, row, of.FORCE_NODE, base) + k]
            if link:
                force = -force
        forces[place] = force


_FRICTION = of.NUMBERS + par.FRICTION


@not_inlined
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
            further(plan, begin, end, k, k, base)


@kernel
def remembers(plan: Vector, row: int) -> bool:
    """Whether a row has a memory that the series carry."""
    return int(plan[row + of.BEHAVIOUR]) in (of.HYSTERETIC, of.BILINEAR, of.MEMORY_STOP)


@kernel
def _begin(plan: Vector, deformation: Vector) -> None:
    for f in range(int(plan[at.STOPS])):
        law = row_of(plan, f)
        if remembers(plan, law):
            plan[node(plan, law, of.Z_NODE, int(plan[at.NODES]))] = deformation[f]


@kernel
def _grow(plan: Vector, factor: float, j: int) -> None:
    base = int(plan[at.NODES])
    for f in range(int(plan[at.STOPS])):
        law = row_of(plan, f)
        if remembers(plan, law):
            grown = plan[node(plan, law, of.FLOW_NODE, base) + j]
            plan[node(plan, law, of.Z_NODE, base) + j + 1] = factor * grown


_expand = expanding(_begin, push, _grow)


@kernel
def coded(plan: Vector) -> bool:
    """Whether the series in this mode are written by code that was made for the assembly."""
    forbidden = int(plan[int(plan[at.CODE]) + 2]) - 1
    return forbidden >= 0 and int(plan[at.MODE]) & forbidden == 0


@kernel
def run_code(plan: Vector, which: int, y: Vector, unit: float, number: float) -> None:
    """Run its code: `emitted.expanded` (0) or `emitted.ended` (1)."""
    of_ = places(plan)
    rates = rates_of_mode(plan, of_)
    matrix = rates.place + HEAD
    memory = (
        int(plan[at.SERIES]),
        int(plan[at.NODES]),
        matrix,
        closed_place(plan, rates.place, of_.masses),
        matrix + 8 * (rates.width + 1 + of_.pressed),
        int(plan[at.OUTPUTS]),
        int(plan[at.KEPT_Y]),
        int(plan[at.LAWS]),
    )
    call(plan, int(plan[at.CODE]) + which, memory, y, unit, number)


@kernel
def expand_all(plan: Vector, y: Vector, deformation: Vector, length: float, order: int) -> None:
    """Write the series of all masses in t / length; of `ORDER` or, by code, `CODE_ORDER`."""
    if order != of.ORDER or not coded(plan):
        _expand(plan, y, deformation, length, order)
        return
    _expand_by_code(plan, y, deformation, length)


@not_inlined
def _expand_by_code(plan: Vector, y: Vector, deformation: Vector, length: float) -> None:
    of_ = places(plan)
    n, row, count = of_.masses, int(plan[at.ROW]), int(plan[at.STOPS])
    plan[at.ORDER], plan[at.PIECE_LENGTH] = float(of.CODE_ORDER), length
    plan[at.MOVED] = y[2 * n + of_.waves]
    rates = rates_of_mode(plan, of_)
    inputs = beyond(plan, rates.place + HEAD + 8 * rates.width)
    begun = beyond(plan, int(plan[at.OUTPUTS]))
    for i in range(8):
        begun[i] = inputs[i]
    for p in range(of_.pressed):
        d = deformation[int(plan[of_.pressed_list + p])]
        for i in range(8):
            begun[i] += inputs[8 * (1 + p) + i] * d
    run_code(plan, 0, y, length, plan[at.OMEGA])
    for p in range(of_.pressed):
        f = int(plan[of_.pressed_list + p])
        one = of_.stops + f * at.STOP_WIDTH
        k, c = plan[one + at.STOP_STIFFNESS], plan[one + at.STOP_DAMPING]
        left = beyond(plan, int(plan[at.SERIES]) + int(plan[one + at.LEFT]))
        right = beyond(plan, int(plan[at.SERIES]) + int(plan[one + at.RIGHT]))
        forces, v = beyond(plan, int(plan[at.FORCE_SERIES]) + p), n + 1
        forces[0] = k * deformation[f] + c * (left[v] - right[v])
        for j in range(1, of.CODE_ORDER + 1):
            here = j * row
            forces[j * count] = k * (left[here] - right[here]) + c * (
                left[here + v] - right[here + v]
            )


@kernel
def share_of_unit(plan: Vector, share: float) -> None:
    """Let what is watched of the series in hand be that on a share of their unit."""
    powers, power = int(plan[at.POWERS]), 1.0
    plan[at.SHARE] = share
    for j in range(int(plan[at.ORDER]) + 1):
        plan[powers + j] = power
        power *= share


@not_inlined
def shorten(plan: Vector, share: float) -> None:
    """Turn the series in hand into series on this share of their unit."""
    count, row, base = int(plan[at.STOPS]), int(plan[at.ROW]), int(plan[at.NODES])
    series, forces, power = int(plan[at.SERIES]), int(plan[at.FORCE_SERIES]), 1.0
    for j in range(1, int(plan[at.ORDER]) + 1):
        power *= share
        for i in range(row):
            plan[series + j * row + i] *= power
        for p in range(count):
            plan[forces + j * count + p] *= power
        for f in range(count):
            law = row_of(plan, f)
            if plan[law + of.ACTIVE] != 0.0:
                for i in range(int(plan[law + of.FIRST_OP]), int(plan[law + of.LAST_OP])):
                    if int(plan[int(plan[at.TAPE]) + i * of.OP_WIDTH]) != _CONSTANT:
                        plan[base + i * _T + j] *= power
    plan[at.PIECE_LENGTH] *= share
    share_of_unit(plan, 1.0)


@kernel
def expand_over(plan: Vector, y: Vector, deformation: Vector, length: float) -> None:
    """Write the series of a state over a length of time.

    They are made in a power of two, so that they have the digits with which a step was certified:
    near the limit of a stiff memory, those of another unit would be noise.
    """
    unit = 2.0 ** math.ceil(math.log2(length))
    expand_all(plan, y, deformation, unit, of.ORDER)
    shorten(plan, length / unit)


@not_inlined
def accelerations_of_all(plan: Vector, y: Vector, deformation: Vector, place: int) -> None:
    """Write the accelerations of a state y, u, v, w, in the mode that was entered.

    After n + 1 of them follow the forces of those pressed and of those held. What the laws make
    stands in the nodes of a point.
    """
    of_ = places(plan)
    rates = rates_of_mode(plan, of_)
    n, w, base = of_.masses, of_.waves, int(plan[at.POINT])
    here = beyond(plan, int(plan[at.SCRATCH]))
    for i in range(n):
        here[i], here[n + 1 + i] = y[i], y[n + i]
    here[n], here[2 * n + 1] = 0.0, 0.0
    for q in range(w):
        here[2 * (n + 1) + q] = y[2 * n + q]
    inputs = beyond(plan, int(plan[at.INPUTS]))
    inputs[0] = 1.0
    for p in range(of_.pressed):
        inputs[1 + p] = deformation[int(plan[of_.pressed_list + p])]
    for f in range(int(plan[at.STOPS])):
        law = row_of(plan, f)
        if remembers(plan, law):
            plan[node(plan, law, of.Z_NODE, base)] = deformation[f]
    push(plan, of_, here, 0, base, beyond(inputs, 1 + of_.pressed))
    outputs = beyond(plan, int(plan[at.OUTPUTS]))
    apply_rates(plan, rates, here, inputs, 0, outputs)
    for i in range(n):
        plan[place + i] = outputs[i]
    for p in range(of_.pressed + of_.resting):
        plan[place + n + 1 + p] = outputs[n + p]
