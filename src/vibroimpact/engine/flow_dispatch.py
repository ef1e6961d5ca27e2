"""Which flow carries a rig: a class a flow, found by the rig's laws, stops and forcing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar, NamedTuple

import numpy as np

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout as assembly
from vibroimpact.engine.assembly.curved import emitted
from vibroimpact.engine.assembly.plan import write_plan
from vibroimpact.engine.compiler import cgutils, intrinsic, models, overload, register_model, types
from vibroimpact.engine.flow import OneMassPlan
from vibroimpact.engine.forcing import several
from vibroimpact.engine.jit import CHOSEN, Vector
from vibroimpact.engine.linear.advance import advance_bumpers
from vibroimpact.engine.linear.any_stops import advance_any
from vibroimpact.engine.linear.layout import PLAN
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.series import kernels
from vibroimpact.engine.taylor.advance import advance_taylor
from vibroimpact.engine.yielding.advance import advance_yielding
from vibroimpact.engine.yielding.layout import PLAN as YIELDING_PLAN


class Storage(NamedTuple):
    """Memory for the plan of a rig; its class is the flow that carries the rig."""

    memory: Vector


class OneMassFlow(Storage):
    """A flow of one mass: what a class derived from it declares."""

    advance: ClassVar[Callable[..., Any]]
    """The kernel (plan, motion, limit) that goes on to the next event, or for the time `limit`."""
    laws: ClassVar[int] = par.LINEAR
    """Which kernels of `by_laws` answer for it."""
    forcing: ClassVar[float | None] = par.HARMONIC
    """The one forcing that it is compiled for. Tables of closed-form motion spend their time in its
    functions; a Taylor step does not notice that they are looked up (None)."""


class Bumpers(OneMassFlow):
    """Bumpers that cannot be touched at once, shaken by one sine."""

    advance = advance_bumpers


class AnyStops(OneMassFlow):
    """Rigid stops, and bumpers that overlap, shaken by one sine."""

    advance = advance_any


class Several(OneMassFlow):
    """Any linear stops, shaken by several harmonics."""

    advance = advance_any
    forcing = par.SEVERAL


class Recorded(OneMassFlow):
    """Any linear stops, shaken by a record."""

    advance = advance_any
    forcing = par.RAMP


class Curved(OneMassFlow):
    """Any laws, under any shaking."""

    advance = advance_taylor
    laws = par.BENT
    forcing = None


class Yielding(OneMassFlow):
    """An isolator that yields or slides between linear stops, shaken by one sine."""

    advance = advance_yielding
    laws = par.YIELDING


class YieldingSeveral(OneMassFlow):
    """The same, shaken by several harmonics."""

    advance = advance_yielding
    laws = par.YIELDING
    forcing = par.SEVERAL


class YieldingRecorded(OneMassFlow):
    """The same, shaken by a record."""

    advance = advance_yielding
    laws = par.YIELDING
    forcing = par.RAMP


class Masses(Storage):
    """Several masses with linear links between linear stops, under any shaking."""


class CurvedMasses(Storage):
    """Several masses with any links between any stops, under any shaking."""


ONE_MASS: tuple[type[OneMassFlow], ...] = (
    Bumpers,
    AnyStops,
    Several,
    Recorded,
    Curved,
    Yielding,
    YieldingSeveral,
    YieldingRecorded,
)
SEVERAL_MASSES = (Masses, CurvedMasses)
FLOWS: tuple[type[Storage], ...] = (*ONE_MASS, *SEVERAL_MASSES)


def flow_class(rig: Vector) -> type[Storage]:
    """The flow of a rig."""
    if rig[par.FORCING] == par.MASSES:
        return CurvedMasses if rig[assembly.CURVED] else Masses
    return one_mass_flow(rig)


def one_mass_flow(rig: Vector) -> type[OneMassFlow]:
    """The flow of a rig with one mass."""
    laws, forcing = par.laws(rig), rig[par.FORCING]
    right, left = par.stop_at(0), par.stop_at(1)
    rigid = par.RIGID in (rig[right + par.KIND], rig[left + par.KIND])
    overlapping = rig[right + par.GAP] + rig[left + par.GAP] < 0.0
    carries_all = (
        flow
        for flow in ONE_MASS
        if flow.laws == laws
        and flow.forcing in (None, forcing)
        and not (flow is Bumpers and (rigid or overlapping))
    )
    return next(carries_all)


def _aligned_memory(size: int) -> Vector:
    """Memory that begins a cache line: vectors of eight numbers within it then cross none.

    The word before it is for the address of the flow's functions.
    """
    memory = np.empty(size + 16)
    start = -(memory.ctypes.data // 8) % 8 + 8
    return memory[start : start + size]


def flow_of(rig: Vector) -> Storage:
    """Memory for the plan of a rig, of the class of its flow."""
    if rig[par.FORCING] == par.MASSES:
        memory = _aligned_memory(int(rig[assembly.LENGTH_OF_PLAN]))
        write_plan(rig, memory)
        emitted.prepare(memory, rig)
        return flow_class(rig)(memory)
    flow = one_mass_flow(rig)
    if rig[par.FORCING] != par.SEVERAL:
        memory = _aligned_memory(YIELDING_PLAN if flow.laws == par.YIELDING else PLAN)
    else:
        weights = rig[par.WEIGHTS :]
        memory = _aligned_memory(several.plan_length(len(weights) // 2))
        memory[several.WEIGHTS : several.WEIGHTS + len(weights)] = weights
    if flow.laws != par.LINEAR:
        kernels.prepare(memory, rig)
    return flow(memory)


def carries(rig: Vector, other: Vector) -> bool:
    """Whether the flow of a rig carries another one as well."""
    if par.MASSES in (rig[par.FORCING], other[par.FORCING]):
        same = bool(rig[par.FORCING] == other[par.FORCING]) and flow_class(rig) is flow_class(other)
        # What the laws of a curved one are made of stands in the vector, but needs its room.
        length = assembly.LENGTH_OF_PLAN
        if not same or not rig[assembly.CURVED]:
            return same
        return bool(rig[length] == other[length]) and emitted.same_code(rig, other)
    same = rig[par.FORCING] == other[par.FORCING] and rig[par.CURVED] == other[par.CURVED]
    if rig[par.CURVED]:
        same = same and kernels.covers(kernels.laws_code(rig), kernels.laws_code(other))
        same = same and bool((kernels.operations(rig) == kernels.operations(other)).all())
    return bool(same and flow_class(rig) in (AnyStops, Curved, flow_class(other)))


class PlanType(OneMassPlan):
    """The memory of a plan of one mass, told apart by its flow."""

    def __init__(self, flow: type[OneMassFlow]) -> None:
        self.flow = flow
        self.forcing = flow.forcing
        self.laws = flow.laws
        super().__init__(types.float64)  # type: ignore[no-untyped-call]
        self.name = f"Plan({flow.__name__})"

    @property
    def key(self) -> Any:
        """What makes two types the same."""
        return self.flow


register_model(PlanType)(models.PointerModel)


@intrinsic
def _plan(typing: Any, storage: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        array = builder.extract_value(args[0], 0)
        return cgutils.create_struct_proxy(signature.args[0][0])(  # type: ignore[no-untyped-call]
            context, builder, value=array
        ).data

    return PlanType(storage.instance_class)(storage), build


def planned(storage: Any, rig: Vector) -> Vector:
    """The plan in this memory, with the numbers of a rig; its tables are still to be built."""
    plan = storage if isinstance(storage, np.ndarray) else storage.memory
    for i in range(par.SIZE):
        plan[i] = rig[i]
    return plan


@overload(planned, jit_options=CHOSEN)  # type: ignore[arg-type]
def _planned(storage: Any, rig: Any) -> Any:
    of: Any = pointer if isinstance(storage, types.Array) else _plan

    def implementation(storage: Any, rig: Any) -> Any:
        plan: Any = of(storage)
        for i in range(par.SIZE):
            plan[i] = rig[i]
        return plan

    return implementation
