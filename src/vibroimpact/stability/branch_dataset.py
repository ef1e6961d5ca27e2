"""Branches and their bifurcations as one labelled dataset."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import describe, rig_parameters
from vibroimpact.datasets.stops import part_names
from vibroimpact.engine import orbit
from vibroimpact.engine.status import Status
from vibroimpact.errors import warn_of_result
from vibroimpact.response.analytic_free_response import exciting_force, reference_excursions
from vibroimpact.response.hold_rows import results_of
from vibroimpact.response.outputs import NamedOutput, about, add_outputs, computed
from vibroimpact.response.plausibility import note_unbounded
from vibroimpact.stability import bifurcations
from vibroimpact.stability.bifurcations import Bifurcation
from vibroimpact.stability.branch_styles import VARIABLES, contact_counts
from vibroimpact.stability.fixed_points import MAX_EVENTS, Orbit, vector_of
from vibroimpact.stability.orbit_curve import Station
from vibroimpact.stability.parameter_family import Family

_Array = NDArray[np.float64]

_OF_MASSES = (
    "displacement_excursion",
    "eccentricity",
    "peak_displacement",
    "peak_acceleration",
    "peak_transmitted_force",
)
"""What a bifurcation of an assembly shows."""


class BranchRecord(NamedTuple):
    """A branch as it was followed."""

    stations: list[Station]
    bifurcations: list[Bifurcation]
    ended: tuple[str, str]
    """Why it was not followed further, at its beginning and at its end."""
    closed: bool


def as_dataset(
    followed: list[BranchRecord],
    fam: Family,
    span: tuple[float, float],
    created: str = "branch",
    own: tuple[NamedOutput, ...] = (),
) -> xr.Dataset:
    """Branches as one labelled dataset, with own outputs of the orbits and the bifurcations."""
    name = fam.parameter.name
    stations = [
        (i, s)
        for i, one in enumerate(followed)
        for s in bifurcations.with_critical(one.stations, one.bifurcations)
    ]
    orbits = [s.orbit for _, s in stations]
    rows = _rows(fam, orbits)
    multipliers = np.array([one.multipliers for one in orbits])
    values = {
        "arclength": [s.arclength for _, s in stations],
        "period": [one.section.count for one in orbits],
        "antisymmetric": [one.section.mirror for one in orbits],
        "stable": np.array(
            [-1 if s.critical else int(s.orbit.stable) for _, s in stations], dtype=np.int64
        ),
        "branch": np.array([i for i, _ in stations], dtype=np.int64),
        "piece": np.array([s.piece for _, s in stations], dtype=np.int64),
    }
    variables: dict[str, Any] = {
        **_sizes(fam, orbits, rows, "point"),
        **{key: ("point", np.asarray(value)) for key, value in values.items()},
        "multiplier_real": (("point", "multiplier"), multipliers.real),
        "multiplier_imag": (("point", "multiplier"), multipliers.imag),
        "section": (("point", "component"), np.array([state_of(one) for one in orbits])),
        **_bifurcations(followed, fam),
    }
    coordinates: dict[str, Any] = {
        name: ("point", [one.value for one in orbits]),
        "component": fam.layout.names,
    }
    coordinates |= part_names(fam.rig.system, "mass", "stop")
    doubts = [*fam.layout.doubts_of_rows(rows, "orbits"), *note_unbounded(fam.rig)]
    data = xr.Dataset(variables, coordinates)
    data.attrs["parameter"] = name
    add_outputs(data, own, _output_values(own, orbits))
    critical = _output_values(own, [b.orbit for one in followed for b in one.bifurcations])
    for k, output in enumerate(own):
        data[f"bifurcation_{output.name}"] = ("bifurcation", critical[:, k])
    for i, one in enumerate(followed):
        prefix = f"branch_{i}_" if created == "resonance_diagram" else ""
        data.attrs[f"{prefix}ended_low"], data.attrs[f"{prefix}ended_high"] = one.ended
        data.attrs[f"{prefix}closed"] = int(one.closed)
        unexplained = bifurcations.unexplained(one.stations, one.bifurcations)
        if unexplained:
            data.attrs[f"{prefix}unexplained_changes"] = [v for pair in unexplained for v in pair]
            low, high = (fam.written(end, 9) for end in unexplained[0])
            often = "once" if len(unexplained) == 1 else f"{len(unexplained)} times"
            warn_of_result(
                f"stability changes {often} along this branch without a detected bifurcation, "
                f"first between {name} = {low} and {high}; the list of bifurcations is incomplete "
                "there; to search with smaller steps, narrow the range around these values"
            )
    return describe(
        data,
        f"vibroimpact.{created}",
        {
            **rig_parameters(fam.rig),
            "parameter": name,
            "low": span[0],
            "high": span[1],
            **about(own),
        },
        doubts,
        [fam.parameter, *own, *(one._replace(name=f"bifurcation_{one.name}") for one in own)],
    )


def _output_values(outputs: tuple[NamedOutput, ...], orbits: list[Orbit]) -> _Array:
    """Own outputs of orbits over one period each."""
    if not outputs:
        return np.empty((len(orbits), 0))
    values = [
        computed(
            outputs,
            one.rig,
            one.section.family.layout.state(vector_of(one), one.section.family.phase),
            one.section.count,
            periodic=True,
        )
        for one in orbits
    ]
    return np.reshape(values, (len(orbits), len(outputs)))


def _bifurcations(followed: list[BranchRecord], fam: Family) -> dict[str, Any]:
    """The bifurcations as variables."""
    pairs = [(i, b) for i, one in enumerate(followed) for b in one.bifurcations]
    multipliers = np.array([b.orbit.multipliers for _, b in pairs]).reshape(-1, fam.states)
    orbits = [b.orbit for _, b in pairs]
    several = fam.of_several_masses
    sizes = _sizes(fam, orbits, _rows(fam, orbits), "bifurcation")
    values: dict[str, Any] = {
        "kind": np.array([b.kind for _, b in pairs], dtype=str),
        "value": [b.orbit.value for _, b in pairs],
        "arclength": [b.arclength for _, b in pairs],
        "turns": np.array([int(b.turns) for _, b in pairs], dtype=np.int64),
        "branch": np.array([i for i, _ in pairs], dtype=np.int64),
        "period": np.array([b.orbit.section.count for _, b in pairs], dtype=np.int64),
        "antisymmetric": np.array([b.orbit.section.mirror for _, b in pairs], dtype=bool),
        "contacts": np.array([_contacts(b) for _, b in pairs], dtype=str),
    }
    sections = np.array([state_of(b.orbit) for _, b in pairs]).reshape(-1, len(fam.layout.names))
    return {
        **{f"bifurcation_{name}": sizes[name] for name in (_OF_MASSES if several else VARIABLES)},
        **{
            f"bifurcation_{key}": ("bifurcation", np.asarray(value))
            for key, value in values.items()
        },
        "bifurcation_multiplier_real": (("bifurcation", "multiplier"), multipliers.real),
        "bifurcation_multiplier_imag": (("bifurcation", "multiplier"), multipliers.imag),
        "bifurcation_section": (("bifurcation", "component"), sections),
    }


def _contacts(bifurcation: Bifurcation) -> str:
    """Contacts per period, right (R) and left (L); at a grazing on both sides of it.

    Of an assembly with the names of the stops.
    """
    system = bifurcation.orbit.section.family.layout.system

    def counted(contacts: tuple[int, ...]) -> str:
        if system.by_mass:
            names = zip(contacts, system.counted_stops, strict=True)
            return ", ".join(f"{count} {name}" for count, name in names)
        right, left = contacts
        laws = system.stop_laws
        return contact_counts(right, left, (laws.get("right"), laws.get("left")))

    before = counted(bifurcation.orbit.contacts)
    if bifurcation.contacts_behind == bifurcation.orbit.contacts:
        return before
    return f"{before} | {counted(bifurcation.contacts_behind)}"


def state_of(one: Orbit) -> list[float]:
    """The state at the section as the components of a dataset's state."""
    family = one.section.family
    components: list[float] = family.layout.components(vector_of(one), family.phase).tolist()
    return components


def _rows(fam: Family, orbits: list[Orbit]) -> _Array:
    """Return what the engine measures of orbits."""
    return np.array([_measured(one) for one in orbits]).reshape(-1, results_of(fam.base))


def _sizes(fam: Family, orbits: list[Orbit], rows: _Array, dim: str) -> dict[str, Any]:
    """Return extremes, excursions, contacts per cycle and contact forces of orbits."""
    # Neither the mass nor whether a stop is rigid changes along a branch.
    variables = fam.layout.measured(rows, (dim,))
    if fam.of_several_masses:
        return variables
    free = np.array([reference_excursions(one.rig) for one in orbits]).reshape(-1, 2)
    exciting = np.array([exciting_force(one.rig) for one in orbits])
    for name, of, scale in (
        ("eta_d", "displacement_excursion", free[:, 0]),
        ("eta_a", "acceleration_excursion", free[:, 1]),
        ("transmissibility", "transmitted_force_excursion", exciting),
    ):
        variables[name] = (dim, variables[of][1] / scale)
    return variables


def _measured(one: Orbit) -> _Array:
    """Exact extremes and contacts per cycle; NaN, and a warning, where a limit is met."""
    system = one.section.family.system(one.value)
    result = np.full(results_of(system), np.nan)
    outcome = orbit.measure_orbit(
        system,
        one.section.family.phase,
        one.point,
        one.facts,
        one.section.count,
        2 * MAX_EVENTS,
        result,
    )
    if outcome != Status.DONE:
        result[:] = np.nan
        where = one.section.family.equation(one.value, 9)
        warn_of_result(
            f"the largest values of the orbit at {where} are unknown: {Status(outcome).advice}"
        )
    return result
