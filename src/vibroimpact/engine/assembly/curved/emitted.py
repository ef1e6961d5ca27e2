"""The series of a small assembly as straight code, made for its masses, links and laws.

`terms` writes those of all other assemblies and modes. The code serves each mode in which nothing
rests and no stop of a curved law is touched: what such a mode changes are numbers (`rates`).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved import tape as op
from vibroimpact.engine.compiler import PLAIN, intrinsic, overload, types
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.series.code_generation import REAL, WHOLE, Code, Number
from vibroimpact.engine.series.kernels import made_once

MASSES = 8
"""Whose accelerations stand in one block of a mode's matrix."""
MOST = 4_000
"""Products and sums that are made code of: above, to compile would take more than 2 s."""
_KNOWN = (op.ADD, op.SUBTRACT, op.NEGATE, op.MULTIPLY, op.SCALE, op.SHIFT)
_POINTERS, _NUMBERS = 9, 2


class CurvedLink(NamedTuple):
    """A curved link: its ends, the nodes of s and of its force, its number among curved rows."""

    left: int
    right: int
    s: int
    force: int
    place: int
    constants: tuple[tuple[int, int, float], ...]
    """Node, place among the numbers of all rows, or -1 and the number."""
    operations: tuple[tuple[int, int, int, int], ...]
    """Node, what makes it, of which nodes."""


class AssemblyShape(NamedTuple):
    """What the code is made for."""

    masses: int
    waves: int
    row: int
    recorded: bool
    stiffness: tuple[int, ...]
    damping: tuple[int, ...]
    """By how much the numbers of two masses differ, in a circle, that such a force couples."""
    rows: tuple[CurvedLink, ...]


class Memory(NamedTuple):
    """What code reads and writes: places of a plan."""

    series: Any
    nodes: Any
    matrix: Any
    columns: Any
    forces: Any
    outputs: Any
    kept: Any
    laws: Any
    state: Any


OFF, REACH = 16, 32
"""Where in `outputs`."""


def shape_of(vector: Vector) -> AssemblyShape | None:
    """Return what code is made for, or None if none is."""
    sizes = vector[[at.MASSES, at.STOPS, at.WAVES, at.ROW]].astype(int)
    n, count, waves, row = (int(one) for one in sizes)
    if n > MASSES:
        return None

    def block(index: int, *shape: int) -> Any:
        begin = int(vector[index])
        return vector[begin : begin + int(np.prod(shape))].reshape(shape)

    stiff, damped = block(at.STIFFNESS, n, n) != 0.0, block(at.DAMPING, n, n) != 0.0
    stops, response = block(at.STOP, count, at.STOP_WIDTH), block(at.RESPONSE, count, n) != 0.0
    laws, rows = block(at.LAWS, count, of.WIDTH), []
    place = 0
    for f in range(count):
        kind = stops[f, at.KIND]
        ends = [int(stops[f, end]) for end in (at.LEFT, at.RIGHT)]
        if kind == at.KELVIN_VOIGT:
            for end in ends:
                if end < n:
                    stiff[response[f], end] = damped[response[f], end] = True
        elif laws[f, of.BEHAVIOUR] == of.MEMORY_STOP:
            return None
        elif kind == at.LINK:
            if laws[f, of.BEHAVIOUR] != of.SMOOTH:
                return None
            operations = _operations(vector, laws[f], f)
            if operations is None:
                return None
            s, force = (int(laws[f, one]) for one in (of.S_NODE, of.FORCE_NODE))
            rows.append(CurvedLink(ends[0], ends[1], s, force, place, *operations))
        place += int(laws[f, of.BEHAVIOUR] != 0)
    shape = AssemblyShape(
        n,
        waves,
        row,
        bool(vector[at.RECORD]),
        _differences(stiff),
        (0, *(by for by in _differences(damped) if by != 0)),
        tuple(rows),
    )
    return shape if _work(shape) <= MOST else None


def _operations(vector: Vector, law: Vector, f: int) -> Any:
    """Return constants and operations of a law of a `CurvedLink`; None if they are unknown."""
    first, inputs, last = (int(law[one]) for one in (of.FIRST_OP, of.KNOWN, of.LAST_OP))
    begin = int(vector[at.TAPE])
    tape = vector[begin + first * of.OP_WIDTH : begin + last * of.OP_WIDTH]
    known = {int(law[of.S_NODE])}
    constants, operations = [], []
    for i, (code, a, b, value) in enumerate(tape.reshape(-1, of.OP_WIDTH).tolist()):
        one = first + i
        if code == op.CONSTANT:
            constants.append((one, f * of.WIDTH + int(value) if a else -1, value))
        elif code != op.INPUT:
            needed = {int(a)} if code in (op.NEGATE, op.SHIFT) else {int(a), int(b)}
            if i < inputs or code not in _KNOWN or not needed <= known:
                return None
            operations.append((one, int(code), int(a), int(b)))
        if code != op.INPUT:
            known.add(one)
    return tuple(constants), tuple(operations)


def _differences(pairs: Any) -> tuple[int, ...]:
    n = len(pairs)
    return tuple(sorted({(int(q) - int(i)) % n for i, q in np.argwhere(pairs)}))


def _work(shape: AssemblyShape) -> int:
    order = of.CODE_ORDER
    linear = len(shape.stiffness) + len(shape.damping) + 2 + shape.waves + len(shape.rows)
    products = sum(one[1] == op.MULTIPLY for row in shape.rows for one in row.operations)
    return order * linear + products * order * order // 2


def forbidden(vector: Vector) -> int:
    """Return the bits of the modes in which the code does not hold."""
    bits = 0
    for f in range(int(vector[at.STOPS])):
        kind = vector[int(vector[at.STOP]) + f * at.STOP_WIDTH + at.KIND]
        bits |= (kind != at.KELVIN_VOIGT) << f
    return bits


def prepare(memory: Vector, vector: Vector) -> None:
    """Write into the memory of a plan where its code stands, if there is any."""
    shape = None if PLAIN or not vector[at.CURVED] else shape_of(vector)
    if shape is not None:
        cell = int(vector[at.CODE])
        codes = [made_once(formula, shape, _emitted) for formula in (expanded, ended)]
        memory.view(np.int64)[cell : cell + 2] = codes
        memory[cell + 2] = float(forbidden(vector) + 1)  # 0 where there is none


def same_code(vector: Vector, other: Vector) -> bool:
    """Whether one code serves two rigs with curved laws."""
    return shape_of(vector) == shape_of(other) and forbidden(vector) == forbidden(other)


def _type() -> Any:
    return ir.FunctionType(ir.VoidType(), [REAL.as_pointer()] * _POINTERS + [REAL] * _NUMBERS)


def _emitted(formula: Any, shape: AssemblyShape) -> ir.Module:
    module = ir.Module(name=formula.__name__)
    function = ir.Function(module, _type(), name="kernel")
    builder = ir.IRBuilder(function.append_basic_block())
    memories = [Code(builder, one, ()) for one in function.args[:_POINTERS]]
    formula(shape, Memory(*memories), *(Number(builder, one) for one in function.args[_POINTERS:]))
    builder.ret_void()
    return module


def _width(shape: AssemblyShape) -> int:
    """Numbers side by side: one for each mass, and up to a power of two."""
    return max(1 << (shape.masses - 1).bit_length(), 2)


def _linear(
    differences: tuple[int, ...], columns: Any, begin: int, x: Any, n: int, total: Any
) -> Any:
    """Add what linear forces make of u or of v."""
    for by in differences:
        row = columns.load_lanes(8 * (begin + by), x.kind.count)
        total = row.times(x.turned(by, n), total)
    return total


def expanded(shape: AssemblyShape, memory: Memory, unit: Any, omega: Any) -> None:
    """Write the series of a state in t / unit.

    `outputs` has what constant forces and deformations of pressed stops accelerate.
    """
    series = memory.series
    n, order, width = shape.masses, of.CODE_ORDER, _width(shape)
    v = n + 1
    u_now = memory.state.load_lanes(0, width).first(n)
    v_now = memory.state.load_lanes(n, width).first(n)
    waves = [memory.state.load(2 * n + q) for q in range(shape.waves)]
    series.store_lanes(0, u_now)
    series.store_lanes(v, v_now)
    for q, one in enumerate(waves):
        series.store(2 * v + q, one)
    forcing = _Forcing(shape, memory, waves, unit, omega)
    laws = [_Law(row, memory, _relative(row, u_now, n)) for row in shape.rows]
    acts = [
        memory.forces.load_lanes(8 * law.row.place, width).times([law.factor] * width, None)
        for law in laws
    ]
    accelerations = memory.outputs.load_lanes(0, width).first(n)
    for column, values in ((0, u_now), (v, v_now)):
        for q in range(n):
            by = memory.matrix.load_lanes(8 * (column + q), width).first(n)
            accelerations = by.times([values.lane(q)] * width, accelerations)
    for q, one in enumerate(waves):
        by = memory.matrix.load_lanes(8 * (2 * v + q), width)
        accelerations = by.times([one] * width, accelerations)
    for law, act in zip(laws, acts, strict=True):
        accelerations = act.times([law.begun] * width, accelerations)
    for k in range(order + 1):
        if k > 0:
            total = _linear(shape.stiffness, memory.columns, 0, u_now, n, forcing(k))
            for law, act in zip(laws, acts, strict=True):
                total = act.times(law.force(_relative(law.row, u_now, n), k), total)
            accelerations = _linear(shape.damping, memory.columns, n, v_now, n, total)
        if k == order:
            break
        factor = unit * (1.0 / (k + 1))
        u_now, v_now = v_now * factor, accelerations * factor
        here = (k + 1) * shape.row
        series.store_lanes(here, u_now)
        series.store_lanes(here + v, v_now)
        forcing.store(here + 2 * v, k + 1)


class _Forcing:
    """The forcing: its series, and what it adds to the accelerations of an order k > 0."""

    def __init__(
        self, shape: AssemblyShape, memory: Memory, waves: list[Any], unit: Any, omega: Any
    ) -> None:
        n, width = shape.masses, _width(shape)
        column = 8 * 2 * (n + 1)
        self._series, self._recorded = memory.series, shape.recorded
        by = [memory.matrix.load_lanes(column + 8 * q, width) for q in range(shape.waves)]
        self._parts: list[tuple[Any, ...]] = []
        self._waves: list[tuple[Any, ...]] = []
        self._turns: list[Any] = []
        self._powers: list[list[Any]] = []
        if shape.recorded:
            self._rise = unit * waves[1]
            self._slope = by[0] * self._rise
            self._nothing = memory.series.lanes([0.0] * width)
            return
        for q in range(0, shape.waves, 2):
            turn = unit * omega * float(q // 2 + 1)
            sine, cosine = waves[q], waves[q + 1]
            self._parts.append(
                (
                    by[q].times(sine, by[q + 1] * cosine),
                    by[q].times(cosine, by[q + 1] * -sine),
                )
            )
            lanes = memory.series.lanes
            self._waves.append((lanes([sine, cosine]), lanes([cosine, -sine])))
            self._turns.append(turn)
            self._powers.append([1.0, turn])

    def __call__(self, k: int) -> Any:
        if self._recorded:
            return self._slope if k == 1 else self._nothing
        total = None
        for i, pair in enumerate(self._parts):
            total = pair[k % 2].times(self._power(i, k), total)
        return total

    def _power(self, i: int, k: int) -> Any:
        powers = self._powers[i]
        if k == len(powers):
            by = self._turns[i] * (1.0 / k)
            powers.append(powers[-1] * (by if k % 2 else -by))
        return powers[k]

    def store(self, place: int, k: int) -> None:
        """Write coefficient k > 0 of the forcing."""
        if self._recorded:
            self._series.store(place, self._rise if k == 1 else 0.0)
            self._series.store(place + 1, 0.0)
        for i, pair in enumerate(self._waves):
            self._series.store_lanes(place + 2 * i, pair[k % 2] * self._power(i, k))


def ended(shape: AssemblyShape, memory: Memory, unit: Any, tau: Any) -> None:
    """Write the state at tau of the series in hand, and what is missing from the equations there.

    Into `outputs`: what the displacements have gained, by how much the velocities' growth is off,
    and how far each mass can have gone.
    """
    series, outputs, kept = memory.series, memory.outputs, memory.kept
    n, order, width = shape.masses, of.CODE_ORDER, _width(shape)
    v = n + 1
    square = tau * tau

    def polynomial(coefficient: Any) -> Any:
        parts = []
        for last in (order - 1 + order % 2, order - order % 2):  # odd, even
            total = coefficient(last)
            for k in range(last - 2, 0, -2):
                total = series.fma(total, square, coefficient(k))
            parts.append(total)
        return series.fma(parts[1], tau, parts[0]) * tau

    u = polynomial(lambda k: series.load_lanes(k * shape.row, width))
    reach = polynomial(lambda k: series.load_lanes(k * shape.row, width).absolute())
    gain = polynomial(lambda k: series.load_lanes(k * shape.row + v, width)).first(n)
    grown = polynomial(
        lambda k: series.load_lanes(k * shape.row + v, width).times([float(k)] * width, None)
    )
    u, reach = u.first(n), reach.first(n)
    total = series.load_lanes(shape.row + v, width) * (1.0 / unit)
    waves = []
    for q in range(shape.waves):
        one = polynomial(lambda k, q=q: series.load(k * shape.row + 2 * v + q))
        waves.append(one)
        total = memory.matrix.load_lanes(8 * (2 * v + q), width).times(one, total)
    for row in shape.rows:
        values = {row.s: memory.nodes.load(row.s * at.TERMS) + _relative(row, u, n)}
        for out, code, a, b in row.operations:
            x = values[a] if a in values else memory.nodes.load(a * at.TERMS)
            y = values[b] if b in values else memory.nodes.load(b * at.TERMS)
            values[out] = _value(code, x, y)
        change = memory.nodes.load(row.force * at.TERMS) - values[row.force]
        total = memory.forces.load_lanes(8 * row.place, width).times(change, total)
    total = _linear(shape.stiffness, memory.columns, 0, u, n, total)
    total = _linear(shape.damping, memory.columns, n, gain, n, total)
    off = grown + total * (unit * tau * -1.0)
    outputs.store_lanes(0, u)
    outputs.store(n, 0.0)
    outputs.store_lanes(OFF, off.first(n).absolute())
    outputs.store_lanes(REACH, reach)
    outputs.store(REACH + n, 0.0)
    kept.store_lanes(0, series.load_lanes(0, width) + u)
    kept.store_lanes(n, series.load_lanes(v, width) + gain)
    for q in range(shape.waves):
        kept.store(2 * n + q, series.load(2 * v + q) + waves[q])
    kept.store(2 * n + shape.waves, 1.0)


def _value(code: int, x: Any, y: Any) -> Any:
    if code in (op.ADD, op.SHIFT):
        return x + y
    if code == op.SUBTRACT:
        return x - y
    return -x if code == op.NEGATE else x * y


class _Law:
    """The series of what a law makes of s.

    What depends on the newest coefficient of s does so by a slope: all else is known before.
    """

    def __init__(self, row: CurvedLink, memory: Memory, s: Any) -> None:
        self.row, self._nodes = row, memory.nodes
        nodes = memory.nodes
        values: dict[int, Any] = {row.s: s}
        for one, place, number in row.constants:
            values[one] = number if place < 0 else memory.laws.load(place)
        for out, code, a, b in row.operations:
            values[out] = _value(code, values[a], values.get(b))
        for one, value in values.items():
            nodes.store(one * at.TERMS, value)
        self._last: dict[int, Any] = {}
        # The last factor is one of what the force acts on.
        self.at, self.factor = row.force, -1.0
        _, code, a, b = row.operations[-1]
        if code == op.SCALE:
            self.at, self.factor = a, -self._node(b)
        self.begun = values[self.at]
        self._slopes: dict[int, Any] = {row.s: 1.0}
        for out, code, a, b in row.operations:
            x, y = (self._slopes.get(one, 0.0) for one in (a, b))
            if code == op.SUBTRACT:
                slope = x + -y
            elif code in (op.ADD, op.SHIFT):
                slope = x + y
            elif code == op.NEGATE:
                slope = -x
            elif code == op.SCALE:
                slope = self._node(b) * x
            else:
                slope = nodes.fma(self._node(a), y, self._node(b) * x)
            self._slopes[out] = slope

    def _node(self, one: int, k: int = 0) -> Any:
        return self._nodes.load(one * at.TERMS + k)

    def force(self, s: Any, k: int) -> Any:
        """Write coefficient k > 0; what the law pulls with."""
        nodes, fma = self._nodes, self._nodes.fma
        older: dict[int, Any] = {self.row.s: 0.0}
        newest = {self.row.s: s}
        for out, code, a, b in self.row.operations:
            x, y = older.get(a, 0.0), older.get(b, 0.0)
            if code == op.MULTIPLY:
                total = self._inner(a, b, k)
                total = fma(self._node(a), y, fma(self._node(b), x, total))
            elif code == op.SCALE:
                total = self._node(b) * x
            else:
                total = _value(code, x, y)
            older[out] = total
            newest[out] = fma(self._slopes[out], s, total)
        for out, value in newest.items():
            nodes.store(out * at.TERMS + k, value)
        self._last = newest
        return newest[self.at]

    def _inner(self, a: int, b: int, k: int) -> Any:
        """Σ a_i b_(k−i) over 0 < i < k, the newest last."""
        fma = self._nodes.fma
        places = sorted(range(1, k), key=lambda i: abs(2 * i - k))
        ends = [i for i in places if i in (1, k - 1)] if k > 2 else []
        if a == b:
            places, ends = [i for i in places if 2 * i < k], ends[:1]
        sums: list[Any] = [0.0, 0.0]
        for j, i in enumerate(i for i in places if i not in (1, k - 1) or not ends):
            sums[j % 2] = fma(self._node(a, i), self._node(b, k - i), sums[j % 2])
        total = sums[0] + sums[1] if isinstance(sums[1], Number) else sums[0]
        if a == b:
            if isinstance(total, Number):
                total = total + total
            if k % 2 == 0:
                total = fma(self._node(a, k // 2), self._node(a, k // 2), total)
            if ends:
                total = fma(self._node(a, 1) * 2.0, self._newest(a, k - 1), total)
            return total
        if ends:
            total = fma(self._newest(a, k - 1), self._node(b, 1), total)
            total = fma(self._node(a, 1), self._newest(b, k - 1), total)
        return total

    def _newest(self, one: int, k: int) -> Any:
        return self._last[one] if one in self._last else self._node(one, k)


def _relative(row: CurvedLink, values: Any, n: int) -> Any:
    if row.left == n:
        return values.lane(row.right)
    left = values.lane(row.left)
    return values.lane(row.right) - left if row.right < n else -left


def call(
    plan: Vector, cell: int, places: tuple[int, ...], state: Vector, unit: float, number: float
) -> None:
    """Run the code whose address is in a cell of a plan, on places of it and a state (`Memory`)."""
    raise NotImplementedError


@intrinsic
def _call(
    typing: Any, plan: Any, cell: Any, places: Any, state: Any, unit: Any, number: Any
) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        plan, cell, places, *rest = args

        def at_place(one: Any) -> Any:
            return builder.gep(plan, [one], inbounds=True, source_etype=REAL)

        where = builder.load(builder.bitcast(at_place(cell), WHOLE.as_pointer()), typ=WHOLE)
        code = builder.inttoptr(where, _type().as_pointer())
        memories = [at_place(builder.extract_value(places, i)) for i in range(_POINTERS - 1)]
        builder.call(code, [*memories, *rest])
        return context.get_dummy_value()

    return types.void(plan, types.int64, places, state, types.float64, types.float64), build


@overload(call, strict=False)
def _run(plan: Any, cell: Any, places: Any, state: Any, unit: Any, number: Any) -> Any:
    return lambda plan, cell, places, state, unit, number: _call(  # type: ignore[call-arg]
        plan, cell, places, state, unit, number
    )
