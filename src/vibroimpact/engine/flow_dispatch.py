"""Which flow carries a rig: found by its laws in Python, by the type of its plan in kernels.

A flow of one mass is a kernel

    advance(plan, motion, limit) -> event, t, arrival, motion

that goes on to the next event, and a rule which rigs it can carry. Its functions for the rest of
the engine are those of `one_mass.table`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout as assembly
from vibroimpact.engine.assembly.curved import emitted
from vibroimpact.engine.assembly.plan import write_plan
from vibroimpact.engine.compiler import cgutils, intrinsic, models, overload, register_model, types
from vibroimpact.engine.dispatch import answer
from vibroimpact.engine.flow import OneMass
from vibroimpact.engine.forcing import several
from vibroimpact.engine.jit import CHOSEN, Vector
from vibroimpact.engine.linear import advance as linear_advance
from vibroimpact.engine.linear import carry as linear_carry
from vibroimpact.engine.linear import contact_free, forces, pieces, tables, window_bounds
from vibroimpact.engine.linear.advance import advance_apart
from vibroimpact.engine.linear.any_stops import advance_any
from vibroimpact.engine.linear.layout import PLAN
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.series import kernels
from vibroimpact.engine.taylor import advance as taylor_advance
from vibroimpact.engine.taylor import carry as taylor_carry
from vibroimpact.engine.taylor import laws as taylor_laws
from vibroimpact.engine.taylor import mode_forces, power
from vibroimpact.engine.taylor import pieces as taylor_pieces
from vibroimpact.engine.taylor import plan as taylor_plan
from vibroimpact.engine.taylor.advance import advance_taylor
from vibroimpact.engine.yielding import plan as yielding_plan
from vibroimpact.engine.yielding.advance import advance_yielding
from vibroimpact.engine.yielding.layout import PLAN as YIELDING_PLAN


class Apart(NamedTuple):
    """Bumpers that cannot be touched at once, shaken by one sine."""

    memory: Vector


class AnyStops(NamedTuple):
    """Rigid stops, and bumpers that overlap, shaken by one sine."""

    memory: Vector


class Several(NamedTuple):
    """Any linear stops, shaken by several harmonics."""

    memory: Vector


class Recorded(NamedTuple):
    """Any linear stops, shaken by a record."""

    memory: Vector


class Curved(NamedTuple):
    """Any laws, under any shaking."""

    memory: Vector


class Yielding(NamedTuple):
    """An isolator that yields or slides between linear stops, shaken by one sine."""

    memory: Vector


class YieldingSeveral(NamedTuple):
    """The same, shaken by several harmonics."""

    memory: Vector


class YieldingRecorded(NamedTuple):
    """The same, shaken by a record."""

    memory: Vector


class Masses(NamedTuple):
    """Several masses with linear links between linear stops, under any shaking."""

    memory: Vector


class CurvedMasses(NamedTuple):
    """Several masses with any links between any stops, under any shaking."""

    memory: Vector


SEVERAL_MASSES = (Masses, CurvedMasses)


ADVANCE: dict[type, Callable[..., Any]] = {
    Apart: advance_apart,
    AnyStops: advance_any,
    Several: advance_any,
    Recorded: advance_any,
    Curved: advance_taylor,
    Yielding: advance_yielding,
    YieldingSeveral: advance_yielding,
    YieldingRecorded: advance_yielding,
}
_YIELDING: dict[float, type] = {
    par.HARMONIC: Yielding,
    par.SEVERAL: YieldingSeveral,
    par.RAMP: YieldingRecorded,
}
FLOWS = (*ADVANCE, *SEVERAL_MASSES)
"""Every flow."""
_LAWS = {Curved: par.BENT, **dict.fromkeys(_YIELDING.values(), par.YIELDING)}
_FORCING = {
    Apart: par.HARMONIC,
    AnyStops: par.HARMONIC,
    Several: par.SEVERAL,
    Recorded: par.RAMP,
    **{flow: forcing for forcing, flow in _YIELDING.items()},
}
"""The one forcing that a flow is compiled for. Tables of closed-form motion spend their time in its
functions; a Taylor step does not notice that they are looked up."""

_TAYLOR = (
    taylor_plan,
    mode_forces,
    power,
    taylor_laws,
    taylor_pieces,
    taylor_advance,
    taylor_carry,
)
answer(
    par.LINEAR,
    tables,
    contact_free,
    linear_advance,
    forces,
    pieces,
    window_bounds,
    linear_carry,
)
answer(par.BENT, *_TAYLOR)
answer(par.YIELDING, yielding_plan, *_TAYLOR)


def _flow(rig: Vector) -> type:
    if rig[par.FORCING] == par.MASSES:
        return CurvedMasses if rig[assembly.CURVED] else Masses
    laws = par.laws(rig)
    if laws != par.LINEAR:
        return Curved if laws == par.BENT else _YIELDING[rig[par.FORCING]]
    if rig[par.FORCING] == par.SEVERAL:
        return Several
    if rig[par.FORCING] == par.RAMP:
        return Recorded
    right, left = par.stop_at(0), par.stop_at(1)
    rigid = par.RIGID in (rig[right + par.KIND], rig[left + par.KIND])
    overlapping = rig[right + par.GAP] + rig[left + par.GAP] < 0.0
    return AnyStops if rigid or overlapping else Apart


def _room(size: int) -> Vector:
    """Memory that begins a cache line: vectors of eight numbers within it then cross none.

    The word before it is for the address of the flow's functions.
    """
    memory = np.empty(size + 16)
    start = -(memory.ctypes.data // 8) % 8 + 8
    return memory[start : start + size]


def flow_of(rig: Vector) -> Any:
    """Room for the plan of a rig, of the type that chooses its flow."""
    flow = _flow(rig)
    if flow in SEVERAL_MASSES:
        memory = _room(int(rig[assembly.LENGTH_OF_PLAN]))
        write_plan(rig, memory)
        emitted.prepare(memory, rig)
        return flow(memory)
    if rig[par.FORCING] != par.SEVERAL:
        memory = _room(YIELDING_PLAN if flow in _YIELDING.values() else PLAN)
    else:
        weights = rig[par.WEIGHTS :]
        memory = _room(several.room(len(weights) // 2))
        memory[several.WEIGHTS : several.WEIGHTS + len(weights)] = weights
    if flow in _LAWS:
        kernels.prepare(memory, rig)
    return flow(memory)


def carries(rig: Vector, other: Vector) -> bool:
    """Whether the flow of a rig carries another one as well."""
    if par.MASSES in (rig[par.FORCING], other[par.FORCING]):
        same = bool(rig[par.FORCING] == other[par.FORCING]) and _flow(rig) is _flow(other)
        # What the laws of a curved one are made of stands in the vector, but needs its room.
        length = assembly.LENGTH_OF_PLAN
        if not same or not rig[assembly.CURVED]:
            return same
        return bool(rig[length] == other[length]) and emitted.same_code(rig, other)
    same = rig[par.FORCING] == other[par.FORCING] and rig[par.CURVED] == other[par.CURVED]
    if rig[par.CURVED]:
        same = same and kernels.covers(kernels.laws_code(rig), kernels.laws_code(other))
        same = same and bool((kernels.operations(rig) == kernels.operations(other)).all())
    return bool(same and _flow(rig) in (AnyStops, Curved, _flow(other)))


class PlanType(OneMass):
    """The memory of a plan of one mass, told apart by its flow."""

    def __init__(self, flow: type) -> None:
        self.flow = flow
        self.forcing = _FORCING.get(flow)
        self.laws = _LAWS.get(flow, par.LINEAR)
        super().__init__(types.float64)  # type: ignore[no-untyped-call]
        self.name = f"Plan({flow.__name__})"

    @property
    def key(self) -> Any:
        """What makes two types the same."""
        return self.flow


register_model(PlanType)(models.PointerModel)


@intrinsic
def _plan(typing: Any, given: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        array = builder.extract_value(args[0], 0)
        return cgutils.create_struct_proxy(signature.args[0][0])(  # type: ignore[no-untyped-call]
            context, builder, value=array
        ).data

    return PlanType(given.instance_class)(given), build


def planned(given: Any, rig: Vector) -> Vector:
    """The plan in this memory, with the numbers of a rig; its tables are still to be built."""
    plan = given if isinstance(given, np.ndarray) else given.memory
    for i in range(par.SIZE):
        plan[i] = rig[i]
    return plan


@overload(planned, jit_options=CHOSEN)  # type: ignore[arg-type]
def _planned(given: Any, rig: Any) -> Any:
    of: Any = pointer if isinstance(given, types.Array) else _plan

    def implementation(given: Any, rig: Any) -> Any:
        plan: Any = of(given)
        for i in range(par.SIZE):
            plan[i] = rig[i]
        return plan

    return implementation
