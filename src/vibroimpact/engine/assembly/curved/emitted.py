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
from vibroimpact.engine.series.code_generation import REAL, WHOLE, Code, Number
from vibroimpact.engine.series.kernels import machine_code

MASSES = 8
"""Whose accelerations stand in one block of a mode's matrix."""
MOST = 12_000
"""Products and sums, on which the time to compile depends."""
_KNOWN = (op.ADD, op.SUBTRACT, op.NEGATE, op.MULTIPLY, op.SCALE, op.SHIFT)
_POINTERS, _NUMBERS = 6, 2


class Row(NamedTuple):
    """A curved link: its ends, the nodes of what goes in and out, and its operations."""

    left: int
    right: int
    s: int
    v: int
    force: int
    place: int
    acts: tuple[int, ...]
    operations: tuple[tuple[int, int, int, int], ...]


class Shape(NamedTuple):
    """What the code is made for."""

    masses: int
    waves: int
    row: int
    recorded: bool
    stiffness: tuple[tuple[int, ...], ...]
    damping: tuple[tuple[int, ...], ...]
    driven: tuple[bool, ...]
    rows: tuple[Row, ...]


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
            acts = tuple(np.flatnonzero(response[f]).tolist())
            rows.append(Row(*ends, *nodes, place, acts, tuple(operations)))
        place += int(laws[f, of.BEHAVIOUR] != 0)
    shape = Shape(
        n,
        waves,
        row,
        bool(vector[at.RECORD]),
        *(
            tuple(tuple(np.flatnonzero(one).tolist()) for one in of_all)
            for of_all in (stiff, damped)
        ),
        tuple((block(at.SHAPE, n, waves) != 0.0).any(1).tolist()),
        tuple(rows),
    )
    return shape if _work(shape) <= MOST else None


def _work(shape: Shape) -> int:
    order = of.ORDER
    linear = sum(map(len, shape.stiffness)) + sum(map(len, shape.damping))
    linear += shape.masses * (2 + shape.waves // 2) + sum(len(row.acts) for row in shape.rows)
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
        memory.view(np.int64)[cell] = address(shape)
        memory[cell + 1] = float(forbidden(vector))


def same_code(vector: Vector, other: Vector) -> bool:
    """Whether one code serves two rigs with curved laws."""
    return shape_of(vector) == shape_of(other) and forbidden(vector) == forbidden(other)


_lock = threading.Lock()
_made: dict[Shape, tuple[Any, int]] = {}


def address(shape: Shape) -> int:
    """Where the machine code for a shape stands."""
    with _lock:
        if shape not in _made:
            _made[shape] = machine_code(_emitted(shape))
        return _made[shape][1]


def _type() -> Any:
    return ir.FunctionType(ir.VoidType(), [REAL.as_pointer()] * _POINTERS + [REAL] * _NUMBERS)


def _emitted(shape: Shape) -> ir.Module:
    module = ir.Module(name="assembly")
    function = ir.Function(module, _type(), name="kernel")
    for one in function.args[:_POINTERS]:
        one.add_attribute("noalias")
    builder = ir.IRBuilder(function.append_basic_block())
    memories = [Code(builder, one, ()) for one in function.args[:_POINTERS]]
    numbers = [Number(builder, one) for one in function.args[_POINTERS:]]
    _expanded(shape, memories, numbers)
    builder.ret_void()
    return module


def _expanded(shape: Shape, memories: list[Any], numbers: list[Any]) -> None:
    """Write all coefficients from 1 on."""
    series, nodes, matrix, stiff, forces, begun = memories
    unit, omega = numbers
    n, order = shape.masses, of.ORDER
    v = n + 1
    fma = series.fma
    u_now = [series.load(i) for i in range(n)]
    v_now = [series.load(v + i) for i in range(n)]
    waves = [series.load(2 * v + q) for q in range(shape.waves)]
    turning = _turning(shape, series, matrix, waves, unit, omega)
    known: dict[int, list[Any]] = {}

    def node(one: int) -> list[Any]:
        if one not in known:
            known[one] = [nodes.load(one * at.TERMS)]
        return known[one]

    accelerations = [begun.load(i) for i in range(n)]
    for k in range(order + 1):
        if k > 0:
            pushed = [_force(row, nodes, node, u_now, v_now, k) for row in shape.rows]
            for i in range(n):
                total = turning(i, k)
                for q in shape.stiffness[i]:
                    total = fma(stiff.load(8 * q + i), u_now[q], total)
                for row, force in zip(shape.rows, pushed, strict=True):
                    if i in row.acts:
                        total = fma(forces.load(8 * row.place + i), force, total)
                for q in shape.damping[i]:
                    total = fma(stiff.load(8 * (n + q) + i), v_now[q], total)
                accelerations[i] = total
        if k == order:
            break
        factor = unit * (1.0 / (k + 1))
        u_now = [factor * one for one in v_now]
        v_now = [factor * one for one in accelerations]
        for i in range(n):
            series.store((k + 1) * shape.row + i, u_now[i])
            series.store((k + 1) * shape.row + v + i, v_now[i])


def _turning(
    shape: Shape, series: Any, matrix: Any, waves: list[Any], unit: Any, omega: Any
) -> Any:
    """Write the series of the forcing; what it adds to the accelerations, a function of order."""
    n, fma = shape.masses, series.fma
    v, order, column = n + 1, of.ORDER, 8 * 2 * (n + 1)
    if shape.recorded:
        slope = unit * waves[1]
        for k in range(1, order + 1):
            series.store(k * shape.row + 2 * v, slope if k == 1 else 0.0)
            series.store(k * shape.row + 2 * v + 1, 0.0)
        return lambda i, k: matrix.load(column + i) * slope if k == 1 and shape.driven[i] else 0.0
    powers: list[list[Any]] = []
    for q in range(0, shape.waves, 2):
        turn = unit * omega * float(q // 2 + 1)
        sine, cosine, power = waves[q], waves[q + 1], turn
        powers.append([None])
        for k in range(1, order + 1):
            sine, cosine = cosine, -sine
            powers[-1].append(power)
            series.store(k * shape.row + 2 * v + q, power * sine)
            series.store(k * shape.row + 2 * v + q + 1, power * cosine)
            if k < order:
                power = power * (turn * (1.0 / (k + 1)))
    parts = []
    for i in range(n):
        pairs = []
        for q in range(0, shape.waves, 2) if shape.driven[i] else ():
            by = [matrix.load(column + 8 * (q + part) + i) for part in range(2)]
            even = fma(by[0], waves[q], by[1] * waves[q + 1])
            odd = fma(by[0], waves[q + 1], -(by[1] * waves[q]))
            pairs.append((even, odd, -even, -odd))
        parts.append(pairs)

    def added(i: int, k: int) -> Any:
        total: Any = 0.0
        for pair, power in zip(parts[i], powers, strict=False):
            total = fma(power[k], pair[k % 4], total)
        return total

    return added


def _force(row: Row, nodes: Any, node: Any, u: list[Any], v: list[Any], k: int) -> Any:
    """Write coefficient k > 0 of what a link's law makes; the force as it closes the link."""

    def keep(one: int, value: Any) -> None:
        node(one).append(value)
        nodes.store(one * at.TERMS + k, value)

    keep(row.s, _apart(row, u))
    nodes.store(row.v * at.TERMS + k, _apart(row, v))
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


def _apart(row: Row, values: list[Any]) -> Any:
    n = len(values)
    if row.left == n:
        return values[row.right]
    return values[row.right] - values[row.left] if row.right < n else -values[row.left]


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
    stiff: int,
    forces: int,
    begun: int,
    unit: float,
    omega: float,
) -> None:
    """Run the code of a plan, whose address is in a cell, on these places of the plan."""
    raise NotImplementedError


@intrinsic
def _call(
    typing: Any,
    plan: Any,
    cell: Any,
    series: Any,
    nodes: Any,
    matrix: Any,
    stiff: Any,
    forces: Any,
    begun: Any,
    unit: Any,
    omega: Any,
) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        plan, cell, *rest = args
        places = [
            builder.gep(plan, [one], inbounds=True, source_etype=REAL)
            for one in (cell, *rest[:_POINTERS])
        ]
        where = builder.load(builder.bitcast(places[0], WHOLE.as_pointer()), typ=WHOLE)
        code = builder.inttoptr(where, _type().as_pointer())
        builder.call(code, [*places[1:], *rest[_POINTERS:]])
        return context.get_dummy_value()

    whole, real = types.int64, types.float64
    return types.void(plan, whole, *[whole] * _POINTERS, *[real] * _NUMBERS), build


@overload(call, strict=False)
def _run(
    plan: Any,
    cell: Any,
    series: Any,
    nodes: Any,
    matrix: Any,
    stiff: Any,
    forces: Any,
    begun: Any,
    unit: Any,
    omega: Any,
) -> Any:
    def implementation(  # type: ignore[no-untyped-def]
        plan, cell, series, nodes, matrix, stiff, forces, begun, unit, omega
    ):
        return _call(plan, cell, series, nodes, matrix, stiff, forces, begun, unit, omega)

    return implementation
