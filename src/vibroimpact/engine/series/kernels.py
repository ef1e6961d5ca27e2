"""Kernels of steps, made for the laws that a rig has, and called by their address in its plan.

The flow itself is compiled once for all laws. What depends on a law is a small function of straight
code for each shape of a rig; it is made when a rig first asks for it, in a fraction of a second.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from enum import IntEnum
from typing import Any

import numpy as np
from llvmlite import binding, ir

from vibroimpact.engine import parameters as par
from vibroimpact.engine.compiler import PLAIN, intrinsic, overload, types
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.series import layout as at
from vibroimpact.engine.series import program, root_variable, slopes, step
from vibroimpact.engine.series.code_generation import REAL, WHOLE, Code, Plain
from vibroimpact.engine.series.laws import drag
from vibroimpact.engine.series.root_variable import Rooted
from vibroimpact.engine.series.step import LAWS, Shape
from vibroimpact.law_numbers import WORDS

NUMBERS = 7
"""Arguments of a kernel besides the plan."""

AGAIN, SLOPES = 1, 2
"""From a slot that begins a step to that which finds its end at another time, and to that of the
forces' slopes on it."""

ASKS = 1
"""From the slot of a formula's value to that of its series over the step in hand."""

STRIDE = 3
"""From a slot to the next."""

MOST = 16
"""Power of a root that a kernel is made for; its code grows with it."""

CALM = 15
"""From a slot to that where a drag is left out whose power is not a whole number."""

_SQUARE, _ANY_POWER, _BITS = 8, 16, 1023
"""Of `laws_code`: a drag of the velocity's square, one of any power; all bits but the memory's."""


class Slot(IntEnum):
    """Where the addresses of a plan's kernels stand: by the stops that push by a power."""

    FREE = 0
    STOP = 3  # of each
    BOTH = 9
    OTHER = 12
    ROOT = 30  # of each stop
    OWN = 36  # of the isolator, then of each stop


def pushed(rig: Any, stop: int) -> Any:
    """What a `Shape` says of a stop."""
    kind = rig[par.stop_at(stop) + par.KIND]
    if kind == par.FORMULA:
        return stop + 1, program.unpack(rig, stop + 1)
    return {par.POWER_LAW: 1, par.JANKOWSKI: 2}.get(kind, 0)


Kernel = tuple[tuple[Callable[..., None], ...], Any]
"""Formulae of a step, of its end at another time and of slopes; the shape they are made for."""


def kernels(rig: Any) -> dict[int, Kernel]:
    """Each kernel that a rig may call, by slot."""
    laws = tuple(module.shape(rig) for module in LAWS)
    right, left = pushed(rig, 0), pushed(rig, 1)
    found: dict[int, Shape] = {Slot.FREE: Shape(laws)}
    for stop, push in enumerate((right, left)):
        if push:
            found[Slot.STOP + STRIDE * stop] = Shape(laws, push)
    if rig[par.stop_at(0) + par.GAP] + rig[par.stop_at(1) + par.GAP] < 0.0 and left:
        found[Slot.OTHER] = Shape(laws, 0, left)
        if right:
            found[Slot.BOTH] = Shape(laws, right, left)
    formulas = step.begun, step.again, slopes.slopes
    every: dict[int, Kernel] = {int(slot): (formulas, shape) for slot, shape in found.items()}
    if laws[LAWS.index(drag)] == (0,):
        calm = tuple(() if module is drag else law for module, law in zip(LAWS, laws, strict=True))
        for slot, shape in found.items():
            every[slot + CALM] = formulas, shape._replace(laws=calm)
    for which in range(3):
        symbols = program.unpack(rig, which)
        if symbols:
            every[Slot.OWN + STRIDE * which] = (
                (slopes.valued, slopes.event_series),
                (which, symbols),
            )
    for stop in range(2):
        deep = rooted(rig, stop, laws)
        if deep is not None:
            every[Slot.ROOT + STRIDE * stop] = (root_variable.rooted, root_variable.again), deep
    return every


def rooted(rig: Any, stop: int, laws: tuple[Any, ...]) -> Rooted | None:
    """The shape of the kernel in a root of a stop's deformation, if there is one."""
    kind = pushed(rig, stop)
    if kind not in (1, 2) or rig[par.DRAG] not in (1.0, 2.0):
        return None
    at_stop = par.stop_at(stop)
    exponent = float(rig[at_stop + par.EXPONENT])
    for which in (2, 3, 4):
        power = round(which * exponent)
        if power == which * exponent and power <= MOST and (kind == 1 or which == 4):
            return Rooted(laws, which, power, kind == 2, rig[par.FORCING] != par.SEVERAL)
    return None


def laws_code(rig: Any) -> int:
    """Return which kernels a rig needs: a bit for each law, and the power of the memory."""
    code = 0
    code += 1 if rig[par.CUBIC] != 0.0 else 0
    code += 2 if rig[par.QUINTIC] != 0.0 else 0
    code += 4 if rig[par.SINH] != 0.0 else 0
    if rig[par.DRAG] != 1.0 and rig[par.DAMPING] != 0.0:
        code += _SQUARE if rig[par.DRAG] == 2.0 else _ANY_POWER
    for stop in range(2):
        at_stop = par.stop_at(stop)
        if rig[at_stop + par.KIND] == par.POWER_LAW:
            code += 32 << 2 * stop
        elif rig[at_stop + par.KIND] == par.JANKOWSKI:
            code += 64 << 2 * stop
    if rig[par.stop_at(0) + par.GAP] + rig[par.stop_at(1) + par.GAP] < 0.0:
        code += 512
    if rig[par.HYSTERETIC] != 0.0:
        bends = rig[par.KNEE] != 0.0 or rig[par.TURNING] != 0.0
        code += 1024 * (1 + (int(rig[par.SHARPNESS]) if bends else 0))
    return code


def covers(made: int, needed: int) -> bool:
    """Whether kernels made for some laws have all that are needed; both as `laws_code` gives."""
    if made & _ANY_POWER:
        needed &= ~_SQUARE
    if (made & _BITS) & (needed & _BITS) != needed & _BITS:
        return False
    return needed <= _BITS or needed >> 10 == made >> 10


_code, _covers = kernel(laws_code), kernel(covers)


@kernel
def lacks(plan: Vector) -> bool:
    """Whether a rig has laws that the kernels of its plan do not have: it was made for another."""
    for i in range(3 * WORDS):
        needed = plan[par.OWN + i // WORDS * par.OWN_WIDTH + i % WORDS]
        if needed != plan[at.MADE + i] and needed != 0.0:
            return True
    return not _covers(int(plan[at.LAWS]), _code(plan))


@kernel
def drags_any_power(plan: Vector) -> bool:
    """Whether the kernels of a plan have a drag of any power of the velocity, 2 among them."""
    return int(plan[at.LAWS]) & _ANY_POWER != 0


def operations(rig: Vector) -> Vector:
    """The operations of a rig's own formulas, as its vector packs them."""
    blocks = rig[par.OWN : par.OWN + 3 * par.OWN_WIDTH].reshape(3, par.OWN_WIDTH)
    return blocks[:, :WORDS].ravel()


def prepare(memory: Vector, rig: Vector) -> None:
    """Write the addresses of a rig's kernels into the memory of its plan."""
    memory[at.LAWS] = float(laws_code(rig))
    memory[at.MADE : at.MADE + 3 * WORDS] = operations(rig)
    memory[at.ROOTS : at.ROOTS + 4] = np.nan
    addresses = memory.view(np.int64)
    for slot, (formulas, shape) in kernels(rig).items():
        if Slot.ROOT <= slot < Slot.OWN:
            stop = (slot - Slot.ROOT) // STRIDE
            exponent = rig[par.stop_at(stop) + par.EXPONENT]
            memory[at.ROOTS + 2 * stop : at.ROOTS + 2 * stop + 2] = exponent, shape.root
        if not PLAIN:
            for i, formula in enumerate(formulas):
                addresses[at.KERNELS + slot + i] = address(formula, shape)


_lock = threading.Lock()
_made: dict[tuple[Callable[..., None], Any], tuple[Any, int]] = {}


def address(formula: Callable[..., None], shape: Any) -> int:
    """Where the machine code of a formula for a shape stands."""
    return made_once(formula, shape, _emitted)


def made_once(
    formula: Callable[..., None], shape: Any, emit: Callable[[Callable[..., None], Any], ir.Module]
) -> int:
    """As `address`, of code that is made in another way.

    Code is kept as long as the process, because plans hold its address: some MB a shape, which
    depends on the structure of a rig alone and on no value.
    """
    key = (formula, shape)
    found = _made.get(key)
    if found is None:
        with _lock:
            found = _made.get(key) or machine_code(emit(formula, shape))
            _made[key] = found
    return found[1]


def _emitted(formula: Callable[..., None], shape: Any) -> ir.Module:
    module = ir.Module(name=formula.__name__)
    kind = ir.FunctionType(ir.VoidType(), [REAL.as_pointer()] + [REAL] * NUMBERS)
    function = ir.Function(module, kind, name="kernel")
    function.args[0].add_attribute("noalias")
    builder = ir.IRBuilder(function.append_basic_block())
    formula(Code(builder, function.args[0], function.args[1:]), shape)
    builder.ret_void()
    return module


def machine_code(emitted: ir.Module) -> tuple[Any, int]:
    """Compile for this processor; the engine that holds the code, and the address of `kernel`."""
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    target = binding.Target.from_default_triple()
    machine = target.create_target_machine(
        cpu=binding.get_host_cpu_name(),
        features=binding.get_host_cpu_features().flatten(),
        opt=3,
        codemodel="small",
    )
    module = binding.parse_assembly(str(emitted))
    module.verify()
    options = binding.create_pipeline_tuning_options(speed_level=3)
    options.slp_vectorization = False  # it takes apart what is side by side already
    builder = binding.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    engine = binding.create_mcjit_compiler(module, machine)
    engine.finalize_object()
    return engine, engine.get_function_address("kernel")


def run(
    plan: Vector,
    slot: int,
    x: float,
    v: float,
    z: float,
    size: float,
    h: float,
    now: float,
    after: float,
) -> None:
    """Call the kernel of a slot: FOUND of the plan is what it finds."""
    formulas, shape = kernels(plan)[slot - slot % STRIDE]
    formulas[slot % STRIDE](Plain(plan, (x, v, z, size, h, now, after)), shape)


@intrinsic
def _call(
    typing: Any,
    plan: Any,
    slot: Any,
    x: Any,
    v: Any,
    z: Any,
    size: Any,
    h: Any,
    now: Any,
    after: Any,
) -> Any:
    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        plan, slot, *numbers = args
        if isinstance(signature.args[0], types.Array):  # in tests
            plan = context.make_array(signature.args[0])(context, builder, plan).data
        place = builder.add(slot, WHOLE(at.KERNELS))
        cell = builder.gep(plan, [place], inbounds=True, source_etype=REAL)
        cell = builder.bitcast(cell, WHOLE.as_pointer())
        where = builder.load(cell, typ=WHOLE)
        kind = ir.FunctionType(ir.VoidType(), [REAL.as_pointer()] + [REAL] * NUMBERS)
        builder.call(builder.inttoptr(where, kind.as_pointer()), [plan, *numbers])
        return context.get_dummy_value()

    real = types.float64
    return types.void(plan, types.int64, *[real] * NUMBERS), build


@overload(run, strict=False)
def _run(
    plan: Any, slot: Any, x: Any, v: Any, z: Any, size: Any, h: Any, now: Any, after: Any
) -> Any:
    return lambda plan, slot, x, v, z, size, h, now, after: _call(  # type: ignore[call-arg]
        plan, slot, x, v, z, size, h, now, after
    )
