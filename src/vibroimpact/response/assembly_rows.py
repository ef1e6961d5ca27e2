"""What the engine measures of motions, as variables by mass and stop."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.datasets.stops import by_stop, stops_of
from vibroimpact.engine import orbit, section_map, steady_response
from vibroimpact.engine.assembly import measures
from vibroimpact.engine.state import MODE
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Assembly, Oscillator
from vibroimpact.model.rig import System
from vibroimpact.response.hold_rows import MAX_EVENTS, HoldRows, results_of

if TYPE_CHECKING:
    from vibroimpact.response.prepared_rig import PreparedRig

_Array = NDArray[np.float64]


def coordinates(system: System) -> dict[str, _Array]:
    """Return the names of masses, links and stops as coordinates; an oscillator has none."""
    if not isinstance(system, Assembly):
        return {}
    names = {"mass": system.names, "link": system.links, "stop": system.stops}
    return {dim: np.array(list(found), dtype=np.str_) for dim, found in names.items()}


def names_of_parts(system: System) -> dict[str, Any]:
    """Return the names of masses and stops as coordinates; an oscillator has its stops alone."""
    if not isinstance(system, Assembly):
        return {"stop": stops_of(system)}
    names = coordinates(system)
    return {"mass": names["mass"], "stop": names["stop"]}


def check_alike(systems: Mapping[str, System], field: str, *parts: str) -> None:
    """Raise an error unless all are assemblies with parts of the same names.

    Parameters
    ----------
    systems
        What vibrates, by the names of the rigs.
    field
        Name of the argument in messages.
    parts
        ``"mass"``, ``"link"`` and ``"stop"``, as far as they have to agree.

    Raises
    ------
    InputError
        If one of them differs from the first.
    """
    first = coordinates(next(iter(systems.values())))
    for name, one in systems.items():
        mine = coordinates(one)
        if not (first and mine):
            raise InputError(
                f"{field}[{name!r}]: an Oscillator beside an Assembly; pass rigs with the same "
                "parts"
            )
        for part in parts:
            if mine[part].tolist() != first[part].tolist():
                raise InputError(
                    f"{field}[{name!r}]: its {part} names are {', '.join(mine[part]) or 'none'}, "
                    f"not those of the first rig, {', '.join(first[part]) or 'none'}; pass rigs "
                    "with the same parts"
                )


def measured_variables(
    system: System,
    rows: _Array,
    dims: tuple[str, ...],
    prefix: str = "",
    stops: NDArray[np.str_] | None = None,
) -> dict[str, Any]:
    """Return extremes, forces and impacts as variables of a dataset, by mass and stop.

    Parameters
    ----------
    system
        The oscillator or the assembly.
    rows : ndarray, shape (*dims, RESULTS or MEASURED + measures.count(...))
        Rows that the engine writes of holds and orbits.
    dims
        Names of the dims of the rows.
    prefix
        Of the names of the variables.
    stops
        Of an oscillator: names of the stops, as in `by_stop`. Default: those that it has.
    """
    found = (
        _by_mass(system, rows, dims)
        if isinstance(system, Assembly)
        else _of_one_mass(system, HoldRows(rows), dims, stops)
    )
    return {f"{prefix}{name}": value for name, value in found.items()}


def _of_one_mass(
    oscillator: Oscillator, rows: HoldRows, dims: tuple[str, ...], stops: NDArray[np.str_] | None
) -> dict[str, Any]:
    mass = oscillator.mass
    low, high = rows.displacement_min, rows.displacement_max
    carried = mass * rows.transmitted_min, mass * rows.transmitted_max
    values = {
        **range_variables("displacement", low, high, dims),
        **range_variables("acceleration", rows.acceleration_min, rows.acceleration_max, dims),
        **range_variables("transmitted_force", *carried, dims),
        "eccentricity": (dims, 0.5 * (high + low)),
    }
    for name, both in (
        ("impacts", rows.impacts),
        ("peak_force", mass * rows.peak_force),
        ("peak_impulse", mass * rows.peak_impulse),
    ):
        values[name] = ((*dims, "stop"), by_stop(oscillator, both, stops))
    return values


def _by_mass(assembly: Assembly, rows: _Array, dims: tuple[str, ...]) -> dict[str, Any]:
    n, stops = len(assembly.names), len(assembly.stops)
    seen = rows[..., steady_response.MEASURED :]
    base = measures.OF_MASS * n
    masses = seen[..., :base].reshape(*seen.shape[:-1], n, measures.OF_MASS)
    carried = seen[..., base : base + measures.OF_BASE]
    of_stops = seen[..., base + measures.OF_BASE :].reshape(
        *seen.shape[:-1], stops, measures.OF_STOP
    )
    values: dict[str, tuple[tuple[str, ...], _Array]] = {}
    for name, low, high in (
        ("displacement", measures.U_LEAST, measures.U_MOST),
        ("acceleration", measures.A_LEAST, measures.A_MOST),
    ):
        values |= range_variables(name, masses[..., low], masses[..., high], (*dims, "mass"))
    least, most = carried[..., measures.T_LEAST], carried[..., measures.T_MOST]
    values |= range_variables("transmitted_force", least, most, dims)
    ordered = np.nan_to_num(carried[..., measures.ORDERED])
    values["simultaneous_impacts"] = (dims, ordered.astype(np.int64))
    values["eccentricity"] = (
        (*dims, "mass"),
        0.5 * (masses[..., measures.U_LEAST] + masses[..., measures.U_MOST]),
    )
    for name, column in (
        ("impacts", measures.HITS),
        ("peak_force", measures.PUSHED),
        ("peak_impulse", measures.STRUCK),
    ):
        values[name] = ((*dims, "stop"), of_stops[..., column])
    return values


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


def notes_on(assembly: Assembly, rows: _Array, what: str) -> list[str]:
    """Return the doubts about rows: what was decided by a rule, or was not decided."""
    base = steady_response.MEASURED + measures.OF_MASS * len(assembly.names)
    notes = []
    if count := int((rows[..., base + measures.ORDERED] > 0.0).sum()):
        notes.append(
            f"{count} {what} with impacts at the same instant as another impact or rest of the "
            "same mass (simultaneous_impacts); their order is that of the stops in the assembly, "
            "because restitution alone does not determine the result"
        )
    if count := int(np.nansum(rows[..., base + measures.UNDECIDED])):
        notes.append(
            f"the search for an event was given up {count} time{'s' if count > 1 else ''} and "
            "counted as no event; check the orders of magnitude of the input"
        )
    return notes


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
