"""States of assemblies: by names, as components of a dataset, and as the engine's vectors."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine.assembly.curved.layout import NEW
from vibroimpact.engine.assembly.events import KEPT, LEVELS
from vibroimpact.engine.assembly.plan import state_width
from vibroimpact.engine.state import FIRST, FRESH, MODE
from vibroimpact.engine.stops import memory_laws
from vibroimpact.errors import InputError, shown
from vibroimpact.model import Assembly, AssemblyState, State
from vibroimpact.model.assembly.state import NEAR_ZERO
from vibroimpact.model.stops import Stop
from vibroimpact.response.assembly_rig import link_parts
from vibroimpact.response.engine_input import TOUCHING

_Array = NDArray[np.float64]

_AT_REST = 1e-14
"""A closing speed below this share of the bodies' speeds is rounding."""
_PARTS = ("displacement", "velocity", "deformation", "touching", "memory")


def component_names(assembly: Assembly) -> list[str]:
    """Return the names of the components of a state in a dataset, such as ``velocity.roof``."""
    masses, stops = assembly.names, tuple(assembly.stops)
    of = dict(zip(_PARTS, (masses, masses, stops, stops, remembering(assembly)), strict=True))
    return [*(f"{part}.{name}" for part in _PARTS for name in of[part]), "phase"]


def remembering(assembly: Assembly) -> tuple[str, ...]:
    """Return the names of the links with a memory."""
    return tuple(name for name, link in assembly.links.items() if link.isolator.remembers)


def memory_places(assembly: Assembly) -> dict[str, int]:
    """Return where the memory of each such link stands in an engine's state."""
    rows = link_parts(assembly)
    first = FIRST + 2 * len(assembly.names) + len(assembly.stops)
    return {
        name: first + next(i for i, (of, yields) in enumerate(rows) if of == name and yields)
        for name in remembering(assembly)
    }


def state_components(assembly: Assembly, vector: _Array, phase: float) -> _Array:
    """Return an engine's state as the components of a dataset's state."""
    count = len(assembly.stops)
    end = FIRST + 2 * len(assembly.names)
    mode = int(vector[MODE])
    touching = [float(mode >> f & 1) for f in range(count)]
    deformations = np.maximum(vector[end : end + count], 0.0)
    memories = [vector[place] for place in memory_places(assembly).values()]
    angle = phase % (2.0 * math.pi)
    components = [*vector[FIRST:end], *deformations, *touching, *memories, angle]
    return np.array(components) + 0.0  # no negative zeros


def assembly_state_from(assembly: Assembly, vector: _Array, phase: float) -> AssemblyState:
    """Return an engine's state at a forcing phase as a state by names."""
    components = state_components(assembly, vector, phase).tolist()
    return _state_of(dict(zip(component_names(assembly), components, strict=True)), phase)


def as_assembly_state(start: Any, assembly: Assembly) -> AssemblyState:
    """Accept a `State` by names, a dataset of `simulate`, or its ``final_state``.

    Raises
    ------
    InputError
        If the value is none of them, or names what the assembly has not.
    """
    if isinstance(start, xr.Dataset) and "final_state" in start:
        start = start["final_state"]
    if isinstance(start, xr.DataArray) and start.dims == ("component",):
        start = _from_components(start, assembly)
    if isinstance(start, AssemblyState):
        start.check_names(assembly)
        return start
    if isinstance(start, State):
        raise InputError(
            f"start: {start} is the state of one mass; pass values by name, such as "
            f'State(displacement={{"{assembly.names[0]}": 0.01}})'
        )
    raise InputError(
        f"start: {shown(start)} is not a state; pass a State by name, such as "
        f'State(displacement={{"{assembly.names[0]}": 0.01}}), the result of simulate, or its '
        "final_state"
    )


def _from_components(start: xr.DataArray, assembly: Assembly) -> AssemblyState:
    components = {str(name): float(start.sel(component=name)) for name in start["component"].values}
    wanted = component_names(assembly)
    if sorted(components) != sorted(wanted):
        other = next((one for one in components if one not in wanted), None)
        what = (
            f"it has {other!r}, which this assembly has not"
            if other is not None
            else f"it has no {next(one for one in wanted if one not in components)!r}"
        )
        raise InputError(f"start: {what}; pass a state of the same masses and stops")
    return _state_of(components, components["phase"])


def _state_of(components: dict[str, float], phase: float) -> AssemblyState:
    """Return the state with these components, but with another way to write its phase."""
    values: dict[str, dict[str, float]] = {part: {} for part in _PARTS}
    for name, value in components.items():
        if name != "phase":
            part, _, of = name.partition(".")
            values[part][of] = value
    touching = [name for name, value in values.pop("touching").items() if value]
    return AssemblyState(**values, phase=phase, touching=touching)


def assembly_vector(assembly: Assembly, state: AssemblyState) -> _Array:
    """Return the state as the engine's vector, absent values deduced.

    Raises
    ------
    InputError
        If the state claims a contact or a deformation that is not possible.
    """
    n = len(assembly.names)
    u = np.array([state.displacement.get(name, 0.0) for name in assembly.names])
    v = np.array([state.velocity.get(name, 0.0) for name in assembly.names])
    deformations = np.zeros(len(assembly.stops))
    mode, zeros = 0, {}
    frequency = assembly.angular_frequency
    fastest = max(float(np.abs(v).max()), frequency * float(np.abs(u).max()))
    farthest = max(float(np.abs(u).max()), fastest / (frequency or math.inf))
    for f, (name, stop) in enumerate(assembly.stops.items()):
        w, law = assembly.closing(stop), stop.stop
        reach, closing = float(w @ u) - law.gap, float(w @ v)
        speeds = float(np.abs(w) @ np.abs(v))
        slack = TOUCHING * max(
            abs(law.gap),
            float(np.abs(w) @ np.abs(u)),
            speeds / (assembly.angular_frequency or math.inf),
        )
        said = None if state.touching is None else name in state.touching
        if law.rigid:
            d = state.deformation.get(name, 0.0)
            if d:
                raise InputError(
                    f"start.deformation.{name}: {d:g} m, but a rigid stop does not deform; pass 0"
                )
            still = abs(closing) <= _AT_REST * speeds
            touches = reach >= -slack and still and said is not False
            if said:  # what the engine holds at rest has the rounding of the whole motion
                still = abs(closing) <= max(_AT_REST * speeds, TOUCHING * fastest, NEAR_ZERO)
                touches = reach >= -max(slack, TOUCHING * farthest, NEAR_ZERO) and still
            why = f"are {-reach:g} m apart and close at {closing:g} m/s"
        elif law.remembers:
            d = state.deformation.get(name, 0.0)
            touches = reach > d + slack or (bool(said) and reach >= d - slack)
            if touches and said is False:
                raise InputError(
                    f"start.touching: {name!r} is missing, but its face, which stands at {d:g} m, "
                    f"is pressed in to {reach:g} m; add it to touching, or change deformation"
                )
            if touches and _formulas(law)[0].rate is None:
                d = reach
            why = f"do not press it (distance {d - reach:g} m)"
        elif (pair := law.spring_and_dashpot) is None:
            touches, d = _on_curved(state.deformation.get(name), reach, slack, said, closing)
            why = f"do not press it (distance {-reach:g} m)"
        else:
            touches, d = _on_bumper(name, pair, state, reach, closing, speeds, slack, said)
            why = f"do not press it (distance {d - reach:g} m, closing speed {closing:g} m/s)"
        if said and not touches:
            raise InputError(
                f"start.touching: {name!r}, but {stop.left} and {stop.right} {why}; remove it from "
                "touching"
            )
        deformations[f] = d
        if touches:
            mode |= 1 << f
        elif abs(reach - d) <= slack and (order := _parting(law, d, closing, speeds)):
            zeros[f] = order
    rows = link_parts(assembly)
    vector = np.zeros(state_width(n, len(assembly.stops) + len(rows)))
    vector[MODE] = float(mode)
    vector[FRESH] = _packed(zeros) + (NEW if rows else 0.0)
    for name, place in memory_places(assembly).items():
        vector[place] = state.memory.get(name, 0.0)
    vector[FIRST : FIRST + n] = u
    vector[FIRST + n : FIRST + 2 * n] = v
    vector[FIRST + 2 * n : FIRST + 2 * n + len(deformations)] = deformations
    return vector


def _on_bumper(
    name: str,
    pair: tuple[float, float],
    state: AssemblyState,
    reach: float,
    closing: float,
    speeds: float,
    slack: float,
    said: bool | None,
) -> tuple[bool, float]:
    """Whether a bumper of this spring and dashpot is pressed, and its deformation (m)."""
    stiffness, damping = pair
    deformation = state.deformation.get(name)
    # Stated contact makes the deformation that of the bodies, to the last digit.
    d = max(reach, 0.0) if deformation is None else deformation
    if reach > d + max(slack, NEAR_ZERO):
        raise InputError(
            f"start.deformation.{name}: {d:g} m, but the displacements compress this bumper by "
            f"{reach:g} m; pass at least {reach:g} m, or leave it out"
        )
    d = max(d, reach)  # rounding
    touches = d - reach <= (max(slack, NEAR_ZERO) if said else slack)
    force = stiffness * d + damping * closing
    rounding = stiffness * max(TOUCHING * d, NEAR_ZERO) + damping * max(
        TOUCHING * speeds, NEAR_ZERO
    )
    if damping == 0.0 and not touches:
        d = 0.0  # without a dashpot a free bumper is at rest at once
    if said is not None:
        if not said and touches and damping == 0.0 and d > slack:
            raise InputError(
                f"start.touching: {name!r} is missing, but the bumper is compressed by {d:g} m and "
                "has no dashpot, so it stays in contact; add it to touching"
            )
        return said and touches and force >= -rounding, d
    begins = d <= slack and closing > 0.0
    return touches and force > 0.0 and not begins, d


def _on_curved(
    stated_speed: float | None, reach: float, slack: float, said: bool | None, closing: float
) -> tuple[bool, float]:
    """Whether a stop without memory is pressed, and the speed at which it was met (m/s).

    At its face bodies that close are about to meet it, unless the state says that they have.
    """
    touches = reach > slack or (bool(said) and reach >= -max(slack, NEAR_ZERO))
    met = stated_speed if stated_speed is not None else closing if abs(reach) <= slack else 0.0
    return touches, max(met, 0.0) if touches else 0.0


def _parting(law: Stop, d: float, closing: float, speeds: float) -> int:
    """Return the order of the zero of a clearance that bodies at the face just leave, or 0.

    The face of a relaxing bumper is left without relative speed, any other one at that of the
    bodies.
    """
    if law.remembers:
        recedes = free_rate(law, d) - closing
        return 0 if recedes < 0.0 else 1 if recedes > 0.0 else 2
    if (pair := law.spring_and_dashpot) is not None and d > 0.0:
        spring = pair[0] * d
        return 2 if abs(spring + pair[1] * closing) <= TOUCHING * spring else 0
    if closing > 0.0 and closing > _AT_REST * speeds:
        return 0
    return 1 if closing < -_AT_REST * speeds else 2


def _formulas(law: Stop) -> tuple[memory_laws.MemoryLaw, tuple[float, ...]]:
    """Return the formulas of a stop with a memory, and their numbers."""
    made: Any = law.engine_numbers()
    return memory_laws.LAWS[made.law], made.numbers


def free_rate(law: Stop, memory: float) -> float:
    """Return the rate (m/s) of the memory (m) of a stop while nothing touches it."""
    formulas, of = _formulas(law)
    return float(formulas.free_rate(of, memory))


def _packed(zeros: dict[int, int]) -> float:
    """Return known zeros as the engine keeps them; see `engine.assembly.events.pack_fresh`."""
    packed = 0
    for f, order in list(zeros.items())[:KEPT]:
        packed = packed * 256 + 4 * (f + 1) + order
    return float(LEVELS * packed)
