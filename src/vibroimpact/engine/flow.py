# mypy: disable-error-code="empty-body"
"""A flow: how the motions of one class of rigs are computed, as a table of functions.

Whatever asks for a motion (sweeps, orbits, exponents, basins, records) is compiled once and calls
these functions by their addresses, which stand in a table; the word before a plan is the address of
the table. A flow is compiled when a rig first asks for it: a rig pays nothing for laws that it does
not have.

A state is a vector: the mode, what has just happened, the *parts* that make a disturbance (such as
displacement and velocity), the age of the mode (s), and the clock of the forcing, two numbers. It
is carried on in place.

A plan begins with the rig's vector, of which these may vary: so many `numbers`.

To add a flow of one mass, write the kernels that `one_mass.motions` and `one_mass.forces` declare
in a folder, and name them in those declarations; for laws of a new kind, `dispatch.by_laws` gets an
argument, and `parameters.laws` a code that it returns. Then add a class derived from `OneMassFlow`
to `flow_dispatch` and to `ONE_MASS` there; the functions here follow (`one_mass`). For any other
flow, write a module of these functions with the arguments that are declared here, and enter it in
`FLOWS` of `flow_tables`, with its class in `SEVERAL_MASSES` and `flow_class` of `flow_dispatch`,
and its choice in `plain` here.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from operator import attrgetter
from types import ModuleType
from typing import Any, TypeVar

from llvmlite import ir

from vibroimpact.engine.assembly.layout import CURVED
from vibroimpact.engine.compiler import cgutils, excinfo_t, intrinsic, overload, types
from vibroimpact.engine.jit import CHOSEN, Vector
from vibroimpact.engine.parameters import FORCING, MASSES

F = TypeVar("F", bound=Callable[..., Any])

P = types.CPointer(types.float64)  # type: ignore[no-untyped-call]


class OneMassPlan(types.CPointer):
    """The memory of a plan of a flow of one mass."""


_WORD = ir.IntType(64)

SIGNATURES: dict[str, Any] = {}
"""Of each function, by name, in the order of the table."""
GROUPS: dict[str, list[str]] = {}
"""Names of the functions that are compiled together, when an entry first needs one of them: an
entry names its groups (`entry`), `flow_tables` compiles them."""

_compiled_code = attrgetter("library", "fndesc")
"""Of a compiled kernel: its machine code, and what its function is called."""

FLOWS: list[ModuleType] = []
"""The modules of the functions of one mass, of several, and of several with curved laws; set in
`flow_tables`."""


def _function(group: str, returns: Any, *arguments: Any) -> Callable[[F], F]:
    """Declare a function of the table; a kernel that calls it calls that of the plan's flow."""

    def declare(described: F) -> F:
        name = described.__name__
        index = len(SIGNATURES)
        SIGNATURES[name] = declared = returns(P, *arguments)
        GROUPS.setdefault(group, []).append(name)
        names = ", ".join(inspect.signature(described).parameters)

        def plain(plan: Any, *args: Any) -> Any:
            # Without the compiler, a plan itself says of which flow it is.
            several = plan[FORCING] == MASSES
            return getattr(FLOWS[1 + (plan[CURVED] != 0.0) if several else 0], name)(plan, *args)

        call = _indirect(names, declared, index)
        scope: dict[str, Any] = {"call": call}
        exec(f"def chosen({names}): return call({names})", scope)
        chosen = scope["chosen"]
        plain.__doc__, plain.__name__ = described.__doc__, name

        @overload(plain, jit_options=CHOSEN, strict=False)  # type: ignore[arg-type]
        def _called(plan: Any, *args: Any) -> Any:
            return chosen

        return plain  # type: ignore[return-value]

    return declare


def _indirect(names: str, declared: Any, index: int) -> Any:
    """An intrinsic that calls the function at a place of the table of its first argument."""

    def typed(*argument_types: Any) -> tuple[Any, Callable[..., Any]]:
        # Arrays stand for their memory, and a plan whose type names its flow for a plan.
        taken = [
            one if isinstance(one, types.Array | types.CPointer) else kind
            for one, kind in zip(argument_types, declared.args, strict=True)
        ]

        def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            passed = [
                context.make_array(kind)(context, builder, value).data
                if isinstance(kind, types.Array)
                else value
                for kind, value in zip(signature.args, args, strict=True)
            ]
            conv = context.call_conv
            kind = conv.get_function_type(declared.return_type, declared.args)
            words = builder.bitcast(passed[0], _WORD.as_pointer())
            before = builder.gep(words, [ir.Constant(_WORD, -1)], source_etype=_WORD)
            table = builder.inttoptr(builder.load(before, typ=_WORD), _WORD.as_pointer())
            place = builder.gep(table, [ir.Constant(_WORD, index)], source_etype=_WORD)
            function = builder.inttoptr(builder.load(place, typ=_WORD), kind.as_pointer())
            # As numba calls its own: behind room for the result and for an exception, which no
            # kernel raises.
            result = conv.get_return_type(declared.return_type).pointee
            slot = cgutils.alloca_once(builder, result)  # type: ignore[no-untyped-call]
            raised = cgutils.alloca_once(  # type: ignore[no-untyped-call]
                builder, ir.PointerType(excinfo_t)
            )
            builder.call(function, [slot, raised, *passed])
            if declared.return_type == types.void:
                return context.get_dummy_value()
            return builder.load(slot, typ=result)

        return declared.return_type(*taken), build

    scope: dict[str, Any] = {"typed": typed}
    exec(f"def call(typing, {names}): return typed({names})", scope)
    return intrinsic(scope["call"])


def filling(
    plan_type: Callable[[Any], Any], module_of: Callable[[Any], ModuleType], group: str
) -> Any:
    """Make an intrinsic that writes the addresses of a flow's functions into its table.

    It is called with a flow, whose type is that of the kernels' plans, and the table.
    """

    @intrinsic
    def fill(typing: Any, storage: Any, table: Any) -> Any:
        overloads = {}
        module = module_of(storage)
        for name in GROUPS[group]:
            kernel = getattr(module, name)
            declared = SIGNATURES[name]
            arguments = (plan_type(storage), *declared.args[1:])
            types.Dispatcher(kernel).get_call_type(typing, arguments, {})  # compiles it
            overloads[name] = kernel.overloads[arguments]
            returned = types.unliteral(overloads[name].signature.return_type)  # type: ignore[no-untyped-call]
            if returned != declared.return_type:
                raise TypeError(f"{name} returns {returned} instead of {declared.return_type}")

        def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            array = context.make_array(signature.args[1])(context, builder, args[1])
            for name, kernel in overloads.items():
                code, described = _compiled_code(kernel)
                context.active_code_library.add_linking_library(code)
                function = context.declare_function(builder.module, described)
                index = ir.Constant(_WORD, list(SIGNATURES).index(name))
                place = builder.gep(array.data, [index], source_etype=_WORD)
                builder.store(builder.ptrtoint(function, _WORD), place)
            return context.get_dummy_value()

        return types.void(storage, table), build

    return fill


# The functions: the group, what is returned and what follows the plan. P stands for the memory of
# numbers, n for an integer, x for a number.

_N, _X = types.int64, types.float64
_MOTION, _RECORDED, _DISTURBED, _MEASURED = "motion", "recorded", "disturbed", "measured"


@_function(_MOTION, types.void, _X, _X)
def begin(plan: Vector, amplitude: float, omega: float) -> None:
    """Take a forcing: its size (m/s², m or N) and ω (rad/s)."""


@_function(_MOTION, types.void, _X, _X)
def build(plan: Vector, amplitude: float, omega: float) -> None:
    """Take a forcing and make the tables for it."""


@_function(_MOTION, _N, _X)
def too_much_work(plan: Vector, period: float) -> int:
    """Whether one cycle may take too long."""


@_function(_MOTION, _X)
def stiff_rate(plan: Vector) -> float:
    """What makes a velocity of a displacement (1/s)."""


@_function(_MOTION, _N)
def parts(plan: Vector) -> int:
    """How many parts a state has."""


@_function(_MOTION, _N)
def coordinates(plan: Vector) -> int:
    """How many of them, the first ones, are displacements and velocities of masses."""


@_function(_MOTION, _N)
def stops(plan: Vector) -> int:
    """How many stops there are, contacts with which are counted."""


@_function(_MOTION, _N)
def numbers(plan: Vector) -> int:
    """How many numbers of the rig's vector a system may vary; the plan begins with them."""


@_function(_MOTION, types.void)
def complete(plan: Vector) -> None:
    """Put right what follows from the numbers of a rig that have been varied."""


@_function(_MOTION, types.void, P)
def units(plan: Vector, units: Vector) -> None:
    """Write what makes a velocity of each part: 1 for a velocity itself."""


@_function(_MOTION, _X, P)
def size(plan: Vector, state: Vector) -> float:
    """The size of a motion, as a velocity (m/s)."""


@_function(_MOTION, _X, P, _N, _X, _X)
def disturb(plan: Vector, state: Vector, part: int, by: float, period: float) -> float:
    """Change a part by so much, or by as little less if only that can be; return by how much.

    0 where the part does not outlive a period by itself.
    """


@_function(_MOTION, types.void, P)
def place(plan: Vector, state: Vector) -> None:
    """Make of a state the nearest that can be, and its mode of its parts."""


@_function(_MOTION, types.void, P, P)
def point(plan: Vector, state: Vector, point: Vector) -> None:
    """Write a state's parts as a point of the section, signed as in the paper."""


@_function(_MOTION, types.void, P, P)
def at_point(plan: Vector, state: Vector, point: Vector) -> None:
    """Place a state at a point of the section."""


@_function(_MOTION, _N, P, _X, P)
def undisturbed(plan: Vector, state: Vector, dying: float, result: Vector) -> int:
    """Whether a state flies freely and touches nothing any more; then go on to what is left of it.

    Returns 0 if not; 1 if so, and what `measured` writes is written; 2 if it is still to be
    measured.
    """


@_function(_MOTION, _N, P, _X, P, P)
def advance(plan: Vector, before: Vector, limit: float, ended: Vector, after: Vector) -> int:
    """Go on from a state to the next event, or for the time `limit` (s) if that comes first.

    Returns the event (see `event`) and writes the state just after it; of `ended` the length of
    the stretch and the velocity just before the event (`state`).
    """


@_function(_MOTION, _N, P, _X, _X, _X, _N)
def cycle(plan: Vector, state: Vector, s: float, c: float, length: float, max_events: int) -> int:
    """Follow a motion unobserved, see `event_loop.loop`."""


# Observers: each adds what it sees of one stretch to its notes.


@_function(_MOTION, types.void, P, P, P, P)
def extremes(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
    """See `one_mass.extremes`."""


@_function(_MOTION, types.void, P)
def nothing(plan: Vector, notes: Vector) -> None:
    """Begin the notes of `extremes`, before anything is seen."""


@_function(_MOTION, _N, _N)
def look_again(plan: Vector, again: int) -> int:
    """Whether `extremes` must see a motion a second time, for the force on the base.

    If so, the second look begins (1) or ends (0).
    """


@_function(_MOTION, types.void, P, P, _N, P)
def measured(plan: Vector, notes: Vector, other: Vector, cycles: int, result: Vector) -> None:
    """Write what the notes of `extremes` say, and those of a second look, of so many cycles."""


@_function(_DISTURBED, types.void, P, P, P, P)
def margin(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
    """See `one_mass.margin`."""


@_function(_RECORDED, types.void, P, P, P, P, P, P)
def record(
    plan: Vector,
    before: Vector,
    ended: Vector,
    after: Vector,
    notes: Vector,
    samples: Vector,
    events: Vector,
) -> None:
    """See `one_mass.record_layout`."""


@_function(_RECORDED, types.void, P, P, _N, _N)
def write(plan: Vector, state: Vector, samples: Vector, columns: int, at: int) -> None:
    """Write a state as one of the samples of `one_mass.record_layout`."""


@_function(_DISTURBED, types.void, P, P)
def unit_disturbances(plan: Vector, state: Vector, q: Vector) -> None:
    """Write a unit disturbance of each part into the rows of q."""


@_function(_DISTURBED, types.void, P, P, P, P, P)
def tangent(
    plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector, q: Vector
) -> None:
    """Carry disturbances, one for each part, through the last stretch that `advance` went.

    They are the rows of q; rows of 0 stay so. Of the notes (see `state`) the damping and the
    contacts begun are raised.
    """


@_function(_DISTURBED, types.void, P, P)
def mirror(plan: Vector, state: Vector, q: Vector) -> None:
    """Turn a state and its disturbances, a row each, into their mirror image."""


@_function(_MEASURED, types.void, P, P, P, P)
def measure(plan: Vector, before: Vector, ended: Vector, after: Vector, row: Vector) -> None:
    """Add a stretch to the row of its phase, see `observers.phases`."""


@_function(_MEASURED, types.void, P, _N)
def start_demand(plan: Vector, notes: Vector, everything: int) -> None:
    """Begin the notes of `demand`; the number after them says whether energies are looked for."""


@_function(_MEASURED, types.void, P, P, P, P)
def demand(plan: Vector, before: Vector, ended: Vector, after: Vector, notes: Vector) -> None:
    """See `one_mass.demand`."""


# Channels, over which other observers are written.


@_function(_MEASURED, _N, P, P, P)
def first_piece(plan: Vector, before: Vector, ended: Vector, piece: Vector) -> int:
    """Go to the first piece of the last stretch, see `channels`; 0 if there is none."""


@_function(_MEASURED, _N, P, P)
def next_piece(plan: Vector, before: Vector, piece: Vector) -> int:
    """Go to the next piece; 0 if there is none."""


@_function(_MEASURED, _N, P, P, _N, _N, P)
def series(
    plan: Vector, before: Vector, piece: Vector, channel: int, index: int, out: Vector
) -> int:
    """Write the series of a channel of a mass or stop on the piece; return its order."""
