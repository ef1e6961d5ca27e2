"""The series of a small assembly as straight code, made for its masses, links and laws.

Coefficient 0 of everything, and the accelerations there, come from `terms`, which writes the series
of all other assemblies and modes. The code serves every mode in which nothing rests and no stop of
a curved law is touched: what a mode changes are numbers (`rates`).
"""

from __future__ import annotations

import threading
from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved import tape as op
from vibroimpact.engine.compiler import PLAIN, intrinsic, overload, types
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.series.code_generation import REAL, WHOLE, Code, Lanes, Number
from vibroimpact.engine.series.kernels import machine_code

MASSES = 8
"""Whose accelerations stand in one block of a mode's matrix."""
MOST = 12_000
"""Products and sums, on which the time to compile depends."""
_KNOWN = (op.ADD, op.SUBTRACT, op.NEGATE, op.MULTIPLY, op.SCALE, op.SHIFT)
_POINTERS, _NUMBERS = 7, 2


class Row(NamedTuple):
    """A curved link: its ends, the nodes of what goes in and out, and its operations."""

    left: int
    right: int
    s: int
    v: int
    force: int
    place: int
    operations: tuple[tuple[int, int, int, int], ...]


class Shape(NamedTuple):
    """What the code is made for."""

    masses: int
    waves: int
    row: int
    recorded: bool
    stiffness: tuple[int, ...]
    damping: tuple[int, ...]
    """By how much the numbers of two masses differ, in a circle, that such a force couples."""
    rows: tuple[Row, ...]


class Memory(NamedTuple):
    """What code reads and writes: places of a plan."""

    series: Any
    nodes: Any
    matrix: Any
    columns: Any
    forces: Any
    found: Any
    kept: Any


OFF, REACH = 16, 32
"""Where in `found`."""


def shape_of(vector: Vector) -> Shape | None:
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
    begin = int(vector[at.TAPE])
    place = 0
    for f in range(count):
        kind = stops[f, at.KIND]
        ends = [int(stops[f, end]) for end in (at.LEFT, at.RIGHT)]
        if kind == at.KELVIN_VOIGT:
            for end in ends:
                if end < n:
                    stiff[response[f], end] = damped[response[f], end] = True
        elif kind == at.LINK:
            if laws[f, of.BEHAVIOUR] != of.SMOOTH:
                return None
            law = laws[f, : of.NAMES].astype(int)
            first, last = law[of.FIRST_OP], law[of.LAST_OP]
            tape = vector[begin + first * of.OP_WIDTH : begin + last * of.OP_WIDTH]
            operations = [
                (int(first) + i, *map(int, one[:3]))
                for i, one in enumerate(tape.reshape(-1, of.OP_WIDTH))
                if i >= law[of.KNOWN]
            ]
            if any(one[1] not in _KNOWN for one in operations):
                return None
            nodes = [int(law[one]) for one in (of.S_NODE, of.V_NODE, of.FORCE_NODE)]
            rows.append(Row(*ends, *nodes, place, tuple(operations)))
        place += int(laws[f, of.BEHAVIOUR] != 0)
    shape = Shape(
        n,
        waves,
        row,
        bool(vector[at.RECORD]),
        _differences(stiff),
        (0, *(by for by in _differences(damped) if by != 0)),
        tuple(rows),
    )
    return shape if _work(shape) <= MOST else None


def _differences(pairs: Any) -> tuple[int, ...]:
    n = len(pairs)
    return tuple(sorted({(int(q) - int(i)) % n for i, q in np.argwhere(pairs)}))


def _work(shape: Shape) -> int:
    order = of.ORDER
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
        memory.view(np.int64)[cell : cell + 2] = address(expanded, shape), address(ended, shape)
        memory[cell + 2] = float(forbidden(vector))


def same_code(vector: Vector, other: Vector) -> bool:
    """Whether one code serves two rigs with curved laws."""
    return shape_of(vector) == shape_of(other) and forbidden(vector) == forbidden(other)


_lock = threading.Lock()
_made: dict[tuple[Any, Shape], tuple[Any, int]] = {}


def address(formula: Any, shape: Shape) -> int:
    """Where the machine code of a formula for a shape stands."""
    with _lock:
        if (formula, shape) not in _made:
            _made[formula, shape] = machine_code(_emitted(formula, shape))
        return _made[formula, shape][1]


def _type() -> Any:
    return ir.FunctionType(ir.VoidType(), [REAL.as_pointer()] * _POINTERS + [REAL] * _NUMBERS)


def _emitted(formula: Any, shape: Shape) -> ir.Module:
    module = ir.Module(name=formula.__name__)
    function = ir.Function(module, _type(), name="kernel")
    for one in function.args[:_POINTERS]:
        one.add_attribute("noalias")
    builder = ir.IRBuilder(function.append_basic_block())
    memories = [Code(builder, one, ()) for one in function.args[:_POINTERS]]
    formula(shape, Memory(*memories), *(Number(builder, one) for one in function.args[_POINTERS:]))
    builder.ret_void()
    return module


def _width(shape: Shape) -> int:
    """Numbers side by side: one for each mass, and up to a power of two."""
    return max(1 << (shape.masses - 1).bit_length(), 2)


def _linear(shape: Shape, columns: Any, u: Any, v: Any, total: Any) -> Any:
    """Add what linear forces make of u and v; what v makes, which is waited for, last."""
    n, width = shape.masses, _width(shape)
    for by in shape.stiffness:
        total = columns.load_lanes(8 * by, width).times(u.turned(by, n), total)
    late = None
    for by in shape.damping[1:]:
        late = columns.load_lanes(8 * (n + by), width).times(v.turned(by, n), late)
    total = columns.load_lanes(8 * n, width).times(v, total)
    return total if late is None else total + late


def expanded(shape: Shape, memory: Memory, unit: Any, omega: Any) -> None:
    """Write all coefficients from 1 on, of an expansion in t / unit."""
    series, nodes = memory.series, memory.nodes
    n, order, width = shape.masses, of.ORDER, _width(shape)
    v = n + 1
    u_now = series.load_lanes(0, width).first(n)
    v_now = series.load_lanes(v, width).first(n)
    turning = _turning(shape, memory, unit, omega)
    known: dict[int, list[Any]] = {}

    def node(one: int) -> list[Any]:
        if one not in known:
            known[one] = [nodes.load(one * at.TERMS)]
        return known[one]

    acts = [memory.forces.load_lanes(8 * row.place, width) for row in shape.rows]
    accelerations = memory.found.load_lanes(0, width).first(n)
    for k in range(order + 1):
        if k > 0:
            total = turning(k)
            for row, act in zip(shape.rows, acts, strict=True):
                total = act.times(_force(row, nodes, node, u_now, v_now, k, n), total)
            accelerations = _linear(shape, memory.columns, u_now, v_now, total)
        if k == order:
            break
        factor = unit * (1.0 / (k + 1))
        u_now, v_now = v_now * factor, accelerations * factor
        here = (k + 1) * shape.row
        series.store_lanes(here, u_now)
        series.store_lanes(here + v, v_now)
        _store_waves(shape, series, here + 2 * v, turning.waves[k + 1])


class _turning:
    """The forcing: its series, and what it adds to the accelerations of an order k > 0."""

    def __init__(self, shape: Shape, memory: Memory, unit: Any, omega: Any) -> None:
        n, order, width = shape.masses, of.ORDER, _width(shape)
        column = 8 * 2 * (n + 1)
        waves = [memory.series.load(2 * (n + 1) + q) for q in range(shape.waves)]
        by = [memory.matrix.load_lanes(column + 8 * q, width) for q in range(shape.waves)]
        self.waves: list[list[Any]] = [waves]
        self._parts: list[tuple[Any, ...]] = []
        self._powers: list[list[Any]] = []
        self._slope = None
        if shape.recorded:
            rise = unit * waves[1]
            self._slope = by[0] * rise
            self.waves += [[rise if k == 1 else 0.0, 0.0] for k in range(1, order + 1)]
            return
        self.waves += [[] for _ in range(order)]
        for q in range(0, shape.waves, 2):
            turn = unit * omega * float(q // 2 + 1)
            sine, cosine, power = waves[q], waves[q + 1], turn
            even = by[q].times(sine, by[q + 1] * cosine)
            odd = by[q].times(cosine, by[q + 1] * -sine)
            self._parts.append((even, odd))
            self._powers.append([1.0])
            for k in range(1, order + 1):
                sine, cosine = cosine, -sine
                self._powers[-1].append(power if k % 4 < 2 else -power)
                self.waves[k] += [power * sine, power * cosine]
                if k < order:
                    power = power * (turn * (1.0 / (k + 1)))

    def __call__(self, k: int) -> Any:
        if self._slope is not None:
            return self._slope if k == 1 else self._slope * 0.0
        total = None
        for pair, powers in zip(self._parts, self._powers, strict=True):
            total = pair[k % 2].times(powers[k], total)
        return total


def _store_waves(shape: Shape, series: Any, place: int, waves: list[Any]) -> None:
    for q in range(shape.waves):
        series.store(place + q, waves[q])


def ended(shape: Shape, memory: Memory, unit: Any, tau: Any) -> None:
    """Write the state at tau of the series in hand, and what is missing from the equations there.

    Into `found`: what the displacements have gained, by how much the velocities' growth is off,
    and how far each mass can have gone.
    """
    series, found, kept = memory.series, memory.found, memory.kept
    n, order, width = shape.masses, of.ORDER, _width(shape)
    v = n + 1
    square = tau * tau

    def polynomial(coefficient: Any) -> Any:
        parts = []
        for last in (order - 1 + order % 2, order - order % 2):  # odd, even
            total = coefficient(last)
            for k in range(last - 2, 0, -2):
                total = total.times(square, coefficient(k)) if _side(total) else series.fma(
                    total, square, coefficient(k)
                )
            parts.append(total)
        odd, even = parts
        if _side(odd):
            return even.times(tau, odd) * tau
        return series.fma(even, tau, odd) * tau

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
        values = {row.s: memory.nodes.load(row.s * at.TERMS) + _apart(row, u, n)}
        for out, code, a, b in row.operations:
            x = values[a] if a in values else memory.nodes.load(a * at.TERMS)
            y = values[b] if b in values else memory.nodes.load(b * at.TERMS)
            values[out] = _value(code, x, y)
        change = memory.nodes.load(row.force * at.TERMS) - values[row.force]
        total = memory.forces.load_lanes(8 * row.place, width).times(change, total)
    total = _linear(shape, memory.columns, u, gain, total)
    off = grown + total * (unit * tau * -1.0)
    found.store_lanes(0, u)
    found.store(n, 0.0)
    found.store_lanes(OFF, off.first(n).absolute())
    found.store_lanes(REACH, reach)
    found.store(REACH + n, 0.0)
    kept.store_lanes(0, series.load_lanes(0, width) + u)
    kept.store_lanes(n, series.load_lanes(v, width) + gain)
    for q in range(shape.waves):
        kept.store(2 * n + q, series.load(2 * v + q) + waves[q])
    kept.store(2 * n + shape.waves, 1.0)


def _side(one: Any) -> bool:
    return isinstance(one, Lanes)


def _value(code: int, x: Any, y: Any) -> Any:
    if code in (op.ADD, op.SHIFT):
        return x + y
    if code == op.SUBTRACT:
        return x - y
    return -x if code == op.NEGATE else x * y


def _force(row: Row, nodes: Any, node: Any, u: Any, v: Any, k: int, n: int) -> Any:
    """Write coefficient k > 0 of what a link's law makes; the force as it closes the link."""

    def keep(one: int, value: Any) -> None:
        node(one).append(value)
        nodes.store(one * at.TERMS + k, value)

    keep(row.s, _apart(row, u, n))
    nodes.store(row.v * at.TERMS + k, _apart(row, v, n))
    for out, code, a, b in row.operations:
        x = node(a)[k] if a != row.v else None
        if code == op.ADD:
            keep(out, x + node(b)[k])
        elif code == op.SUBTRACT:
            keep(out, x - node(b)[k])
        elif code == op.NEGATE:
            keep(out, -x)
        elif code == op.SHIFT:
            keep(out, x)
        elif code == op.SCALE:
            keep(out, x * node(b)[0])
        else:
            keep(out, _product(nodes.fma, node(a), node(b), k, a == b))
    return -node(row.force)[k]


def _apart(row: Row, values: Any, n: int) -> Any:
    if row.left == n:
        return values.lane(row.right)
    left = values.lane(row.left)
    return values.lane(row.right) - left if row.right < n else -left


def _product(fma: Any, a: list[Any], b: list[Any], k: int, square: bool) -> Any:
    """Coefficient k of a product; what is computed last is added last, as it is waited for."""
    pairs = [(a[i], b[k - i]) for i in range(1, k)]
    if square:
        pairs = pairs[: (k - 1) // 2]
    sums: list[Any] = [0.0, 0.0]
    for i, (one, other) in enumerate(reversed(pairs)):
        sums[i % 2] = fma(one, other, sums[i % 2])
    total = sums[0] + sums[1] if isinstance(sums[1], Number) else sums[0]
    if not square:
        return fma(a[0], b[k], fma(a[k], b[0], total))
    total = fma(a[0], a[k], total)
    total = total + total
    return fma(a[k // 2], a[k // 2], total) if k % 2 == 0 else total


def call(
    plan: Vector,
    cell: int,
    series: int,
    nodes: int,
    matrix: int,
    columns: int,
    forces: int,
    found: int,
    kept: int,
    unit: float,
    number: float,
) -> None:
    """Run the code whose address is in a cell of a plan on these places of it (`Memory`)."""
    raise NotImplementedError


@intrinsic
def _call(
    typing: Any,
    plan: Any,
    cell: Any,
    series: Any,
    nodes: Any,
    matrix: Any,
    columns: Any,
    forces: Any,
    found: Any,
    kept: Any,
    unit: Any,
    number: Any,
) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        plan, *places = args[: _POINTERS + 2]
        places = [builder.gep(plan, [one], inbounds=True, source_etype=REAL) for one in places]
        where = builder.load(builder.bitcast(places[0], WHOLE.as_pointer()), typ=WHOLE)
        code = builder.inttoptr(where, _type().as_pointer())
        builder.call(code, [*places[1:], *args[_POINTERS + 2 :]])
        return context.get_dummy_value()

    whole, real = types.int64, types.float64
    return types.void(plan, *[whole] * (_POINTERS + 1), *[real] * _NUMBERS), build


@overload(call, strict=False)
def _run(
    plan: Any,
    cell: Any,
    series: Any,
    nodes: Any,
    matrix: Any,
    columns: Any,
    forces: Any,
    found: Any,
    kept: Any,
    unit: Any,
    number: Any,
) -> Any:
    def implementation(  # type: ignore[no-untyped-def]
        plan, cell, series, nodes, matrix, columns, forces, found, kept, unit, number
    ):
        return _call(
            plan, cell, series, nodes, matrix, columns, forces, found, kept, unit, number
        )

    return implementation
