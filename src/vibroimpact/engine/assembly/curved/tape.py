"""A law as a list of operations on series: the formula, run with symbols."""

from __future__ import annotations

from typing import Any

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.series import layout as series
from vibroimpact.engine.series.code_generation import whole_power
from vibroimpact.engine.series.laws import contact
from vibroimpact.engine.series.slopes import Dual, Varying
from vibroimpact.engine.series.step import LawNumbers, Shape, isolator, memory
from vibroimpact.engine.stops.memory_laws import NUMBERS, MemoryLaw

(
    INPUT,
    CONSTANT,
    ADD,
    SUBTRACT,
    NEGATE,
    MULTIPLY,
    SCALE,
    SHIFT,
    POWER,
    EXPONENTIAL,
    SINE,
    COSINE,
    TANH,
    FLAT,
) = range(14)
"""Operations. SCALE and SHIFT are by a constant; SINE and COSINE, TANH and FLAT go by pairs."""


class Node:
    """A series, or a constant, that a formula makes."""

    def __init__(self, tape: Tape, code: int, *of: Node, value: float = 0.0) -> None:
        self.tape, self.code, self.of, self.value = tape, code, of, value
        self.constant: bool = code == CONSTANT or (
            code != INPUT and all(one.constant for one in of)
        )
        self.partner: Node | None = None
        (tape.constants if self.constant else tape.series).append(self)

    def _made(self, code: int, *of: Node) -> Node:
        return Node(self.tape, code, *of)

    def _other(self, other: Any) -> Node:
        return other if isinstance(other, Node) else self.tape.number(float(other))

    def __add__(self, other: Any) -> Any:
        if not isinstance(other, _KNOWN):
            return NotImplemented
        other = self._other(other)
        if self.constant == other.constant:
            return self._made(ADD, self, other)
        return self._made(SHIFT, *((other, self) if self.constant else (self, other)))

    def __sub__(self, other: Any) -> Any:
        if not isinstance(other, _KNOWN):
            return NotImplemented
        other = self._other(other)
        if self.constant == other.constant:
            return self._made(SUBTRACT, self, other)
        return self + -other

    def __rsub__(self, other: Any) -> Any:
        return self._other(other) - self

    def __neg__(self) -> Node:
        return self._made(NEGATE, self)

    def __mul__(self, other: Any) -> Any:
        if not isinstance(other, _KNOWN):
            return NotImplemented
        if not isinstance(other, Node) and other == 1.0:
            return self
        other = self._other(other)
        if self.constant == other.constant:
            return self._made(MULTIPLY, self, other)
        return self._made(SCALE, *((other, self) if self.constant else (self, other)))

    def __truediv__(self, other: Any) -> Any:
        return self * (1.0 / self._other(other))

    def __rtruediv__(self, other: Any) -> Any:
        return self._other(other) * self._made(POWER, self, self.tape.number(-1.0))

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    __radd__, __rmul__ = __add__, __mul__


_KNOWN = (Node, float, int)


class Tape:
    """The machine with which a formula is run, see `code_generation.Code`."""

    def __init__(self) -> None:
        self.constants: list[Node] = []
        self.series: list[Node] = []

    def load(self, place: int) -> Node:
        """Return a number of the row, by its place in the plan of one mass."""
        named = place >= series.NUMBERS
        row = of.NAMES + place - series.NUMBERS if named else of.NUMBERS + place
        return Node(self, CONSTANT, value=float(row))

    def number(self, value: float) -> Node:
        """Return a number that the formula has itself."""
        one = Node(self, CONSTANT, value=value)
        one.partner = one  # which marks a value that is the number
        return one

    def exponential(self, one: Node) -> Node:
        """Return e to this power."""
        return Node(self, EXPONENTIAL, one)

    def power(self, one: Node, exponent: Any) -> Node:
        """Return a real power."""
        return Node(self, POWER, one, one._other(exponent))

    def sine(self, one: Node) -> Node:
        """Return the sine."""
        return self._pair(one, SINE, COSINE)[0]

    def cosine(self, one: Node) -> Node:
        """Return the cosine."""
        return self._pair(one, SINE, COSINE)[1]

    def tanh(self, one: Node) -> tuple[Node, Node]:
        """Return the hyperbolic tangent and its slope."""
        return self._pair(one, TANH, FLAT)

    def _pair(self, one: Node, first: int, second: int) -> tuple[Node, Node]:
        pair = Node(self, first, one), Node(self, second, one)
        pair[0].partner, pair[1].partner = pair[1], pair[0]
        return pair

    def of(self, value: Any, like: Node) -> Node:
        """Return a value as a series, like one that is known."""
        if isinstance(value, Node) and not value.constant:
            return value
        made: Node = like * 0.0 + value
        return made


def written(nodes: list[Node], places: dict[Node, int]) -> list[list[float]]:
    """Return operations; `places` are those of the nodes of these and of those before."""
    rows = []
    for one in nodes:
        a = [float(places[node]) for node in one.of]
        if one.code == CONSTANT:  # from the row unless it is its own partner
            a = [0.0 if one.partner is one else 1.0]
        elif one.partner is not None:
            a.append(float(places[one.partner]))
        rows.append([float(one.code), *a, *[0.0] * (2 - len(a)), one.value])
    return rows


class Symbols(LawNumbers):
    """The numbers of a law and its functions, for symbols."""

    def tanh(self, one: Any) -> Any:
        """Return the hyperbolic tangent."""
        return self._machine.tanh(one)[0]


class VaryingSymbols(Varying):
    """The same for symbols with derivatives."""

    def __getattr__(self, name: str) -> Any:
        number = super().__getattr__(name)
        return Dual(number, {"chi": 1.0}) if name == "push_dissipation" else number

    def tanh(self, one: Any) -> Any:
        """Return the hyperbolic tangent."""
        return one.scaled(*self._machine.tanh(one.value))


class LawTape:
    """The operations of a law, and where what goes in and comes out stands."""

    def __init__(self, shape: Shape, begin: int) -> None:
        tape = Tape()
        s, v, z = (Node(tape, INPUT) for _ in range(3))
        force, flow = _run(Symbols(tape), shape, s, v, z)
        raw = force.of[0] if isinstance(shape.push, tuple) else None
        force = tape.of(force, s)
        nodes = [*tape.constants, *tape.series]
        self.known = len(tape.constants) + 3
        self.rows: list[list[float]] = []
        places = {one: begin + i for i, one in enumerate(nodes)}
        self.rows += written(nodes, places)
        key_nodes = (s, v, z, force, flow, raw)
        self.nodes = [-1 if one is None else places[one] for one in key_nodes]
        known = [len(tape.constants), len(tape.series)]
        moved = (Dual(one, {name: 1.0}) for one, name in ((s, "s"), (v, "v"), (z, "z")))
        force, flow = _run(VaryingSymbols(tape), shape, *moved)
        slopes = [force.by.get(name, 0.0) for name in ("s", "v", "z", "chi")]
        slopes += [0.0 if flow is None else flow.by.get(name, 0.0) for name in ("v", "z", "s")]
        series = [tape.of(one, s) for one in slopes]
        more = [*tape.constants[known[0] :], *tape.series[known[1] :]]
        places |= {one: begin + len(nodes) + i for i, one in enumerate(more)}
        self.slope_rows = written(more, places)
        self.slope_constants = len(tape.constants) - known[0]
        self.slopes = [places[one] for one in series]


def _run(law: Any, shape: Shape, s: Any, v: Any, z: Any) -> tuple[Any, Any]:
    """The force of a law, and the rate of its memory, or None.

    A stop with a memory is followed while it is free, too.
    """
    if isinstance(shape.push, MemoryLaw):
        first = par.BUMPER + par.RESTITUTION
        numbers = [law.formula_number(first + i) for i in range(NUMBERS)]
        pressed = law.own_weight
        rate = v if shape.push.rate is None else shape.push.rate(numbers, s, v, z)
        rate = rate * pressed + shape.push.free_rate(numbers, z) * (1.0 - pressed)
        return shape.push.force(numbers, s, v, z) * pressed, rate
    if shape.push:
        return contact.force(law, "push", shape.push, s, v), None
    parts = isolator(law, shape, s, v, z)
    force = parts[0]
    for part in parts[1:]:
        force = force + part
    return force, memory(law, shape, s, v, z)


def shape_of(vector: Any, push: Any) -> Shape:
    """Return what a row of one law has, by its numbers as those of a rig."""
    from vibroimpact.engine.series.step import LAWS

    if push:
        return Shape(tuple(() for _ in LAWS), push)
    return Shape(tuple(module.shape(vector) for module in LAWS))
