"""How a kernel finds what depends on the flow: by the type of its plan.

Two flows answer the same questions: tables of closed-form motion where all laws are linear, Taylor
series elsewhere. A third, for isolators that yield or slide, has tables of its own and leaves all
that is not said there to the Taylor flow. Each is a folder whose modules have these kernels:

    build(plan, amplitude, omega)           make the plan for one forcing
    too_much_work(plan, period)             whether one cycle takes too long
    undisturbed(plan, motion, clock, dying)  free flight that touches nothing any more, if known
    stiff_rate(plan)                        what makes a velocity of a displacement (1/s)

    begin(plan, motion, length), has_piece(plan, cursor), next_piece(plan, cursor)
    write_cursor(plan, cursor, buffer), read_cursor(plan, buffer)  a cursor in memory
    bound_window(plan, cursor, before, seen, buffer)  bounds over a window of pieces
    enclosed(plan, cursor, buffer)          between which bounds a piece lies, then
    expanded(plan, cursor, series), expanded_force(…), accelerated(…), moment(…)
    sample_stretch(plan, cursor, before, …)  the motion at instants of a stretch
    coordinate(plan, motion)                the mode's own
    displacement(plan, mode, x), acceleration(plan, motion)

    acceleration_of(plan, motion)           ü from all forces
    isolator_force(plan, u, v, z)           what the isolator pulls back with, per unit mass
    springs(plan, motion)                   its tangent stiffness, per unit mass
    stop_deformation(plan, motion, stop)    how far a stop is deformed (m)
    stop_push(plan, motion, stop)           what a pressed stop pushes with
    stop_power(…), isolator_power(…)        what they lose, per unit mass
    unreturned_energy(plan, before, after, stop)  what a stop loses that has ceased to push
    rest_level(plan, motion, stop)          what presses a resting mass on its rigid stop

    carry(plan, stretch, q, rows)           disturbances through a stretch, and what is lost
"""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Any

from vibroimpact.engine.compiler import overload
from vibroimpact.engine.jit import CHOSEN
from vibroimpact.engine.parameters import LINEAR, laws

_MODULES: dict[int, tuple[ModuleType, ...]] = {}


def answer(laws: int, *modules: ModuleType) -> None:
    """Say which modules answer for a flow, the first of them that can."""
    _MODULES[laws] = modules


def _found(laws: int, name: str) -> Any:
    for module in _MODULES[laws]:
        one = vars(module).get(name)
        if one is not None and one.__module__ == module.__name__:  # not what it imports
            return one
    raise AttributeError(f"the flow of {('linear', 'curved', 'yielding')[laws]} laws has no {name}")


def _by_flow(name: str) -> Callable[..., Any]:
    def plain(plan: Any, *args: Any) -> Any:
        return _found(laws(plan), name)(plan, *args)

    plain.__name__ = name

    @overload(plain, jit_options=CHOSEN, strict=False)  # type: ignore[arg-type]
    def _chosen(plan: Any, *args: Any) -> Any:
        return _found(getattr(plan, "laws", LINEAR), name).py_func

    return plain


build = _by_flow("build")
too_much_work = _by_flow("too_much_work")
undisturbed = _by_flow("undisturbed")
stiff_rate = _by_flow("stiff_rate")
begin = _by_flow("begin")
has_piece = _by_flow("has_piece")
next_piece = _by_flow("next_piece")
write_cursor = _by_flow("write_cursor")
read_cursor = _by_flow("read_cursor")
bound_window = _by_flow("bound_window")
enclosed = _by_flow("enclosed")
expanded = _by_flow("expanded")
expanded_force = _by_flow("expanded_force")
accelerated = _by_flow("accelerated")
moment = _by_flow("moment")
sample_stretch = _by_flow("sample_stretch")
displacement = _by_flow("displacement")
acceleration = _by_flow("acceleration")
acceleration_of = _by_flow("acceleration_of")
isolator_force = _by_flow("isolator_force")
springs = _by_flow("springs")
stop_deformation = _by_flow("stop_deformation")
stop_push = _by_flow("stop_push")
stop_power = _by_flow("stop_power")
isolator_power = _by_flow("isolator_power")
unreturned_energy = _by_flow("unreturned_energy")
rest_level = _by_flow("rest_level")
coordinate = _by_flow("coordinate")
carry = _by_flow("carry")
