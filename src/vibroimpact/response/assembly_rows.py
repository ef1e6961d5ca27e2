"""What the engine measures of motions, as variables by mass and stop."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import orbit, section_map
from vibroimpact.engine.state import MODE
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model.system import System
from vibroimpact.response.hold_rows import MAX_EVENTS, results_of

if TYPE_CHECKING:
    from vibroimpact.response.prepared_rig import PreparedRig

_Array = NDArray[np.float64]


def check_alike(systems: Mapping[str, System], field: str, *parts: str) -> None:
    """Raise an error unless all are assemblies with parts of the same names.

    `field` is the argument in messages, and `parts` are "mass", "link" and "stop".
    """
    first = next(iter(systems.values()))
    for name, one in systems.items():
        if not (first.by_mass and one.by_mass):
            raise InputError(
                f"{field}[{name!r}]: an Oscillator beside an Assembly; pass rigs with the same "
                "parts"
            )
        for part in parts:
            mine, wanted = (rig.part_names[part].tolist() for rig in (one, first))
            if mine != wanted:
                raise InputError(
                    f"{field}[{name!r}]: its {part} names are {', '.join(mine) or 'none'}, "
                    f"not those of the first rig, {', '.join(wanted) or 'none'}; pass rigs "
                    "with the same parts"
                )


def measured_over(engine: PreparedRig, state: _Array, cycles: int) -> _Array:
    """Return the row that the engine measures of a motion of an assembly over some cycles."""
    states, shaking = engine.states, engine.shaking
    system = np.append(engine.vector, [shaking.amplitude, shaking.frequency])
    row = np.full(results_of(engine.vector), np.nan)
    facts = np.zeros(section_map.CONTACTS + states.stops)
    facts[section_map.MODE] = state[MODE]
    point, limit = np.append(states.point(state), 0.0), MAX_EVENTS
    outcome = orbit.measure_orbit(system, shaking.phase, point, facts, cycles, limit, row)
    if outcome != Status.DONE:
        row[:] = np.nan
    return row


def range_variables(
    name: str, least: _Array, most: _Array, dims: tuple[str, ...]
) -> dict[str, tuple[tuple[str, ...], _Array]]:
    """Return the excursion, the largest, the least and the peak of a quantity as variables."""
    return {
        f"{name}_excursion": (dims, most - least),
        f"{name}_max": (dims, most + 0.0),
        f"{name}_min": (dims, least + 0.0),
        f"peak_{name}": (dims, np.maximum(np.abs(least), np.abs(most))),
    }
