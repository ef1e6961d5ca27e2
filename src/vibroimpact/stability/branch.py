"""Branches of periodic orbits along a parameter, stable or not, with their bifurcations."""

from __future__ import annotations

import warnings
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.continuation import arclength
from vibroimpact.engine import hold, orbit, section_map
from vibroimpact.engine import motion as layout
from vibroimpact.engine import parameters as par
from vibroimpact.engine.motion import FLIGHT, LEFT, RIGHT
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator, State, equilibrium
from vibroimpact.model.counts import whole
from vibroimpact.model.rigs import takes_rig
from vibroimpact.response.free_flight import reference_excursions
from vibroimpact.response.start import as_state
from vibroimpact.response.threads import Progress, counted
from vibroimpact.response.variables import COMPONENTS, describe, oscillator_parameters
from vibroimpact.stability import bifurcations
from vibroimpact.stability.bifurcations import Bifurcation, own_mirror
from vibroimpact.stability.family import Family, bounds, family
from vibroimpact.stability.orbits import (
    HELD,
    MAX_EVENTS,
    Orbit,
    Section,
    corrected,
    is_fixed,
    vector_of,
)
from vibroimpact.stability.settled import Settled, apart, approach, reach
from vibroimpact.stability.trace import CLOSED, Branch, Station

_Array = NDArray[np.float64]

_SAME = 1e-6
"""Distance, over the motion's size, from the motion from rest of an orbit that is it."""


class Followed(NamedTuple):
    """A branch as it was followed."""

    stations: list[Station]
    bifurcations: list[Bifurcation]
    ended: tuple[str, str]
    """Why it was not followed further, at its beginning and at its end."""
    closed: bool


@takes_rig
def branch(
    oscillator: Oscillator,
    excitation: Harmonic,
    start: State | xr.DataArray | xr.Dataset | None = None,
    *,
    parameter: str = "frequency",
    low: float | str,
    high: float | str,
    period: int | None = None,
    most_points: int = 5000,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Follow a branch of periodic orbits in both directions from one of its orbits.

    Pseudo-arclength continuation with the exact derivative of the map from section to section;
    it goes round folds and through changes of the contacts. A motion that is its own mirror image
    is followed as such.

    Parameters
    ----------
    oscillator, excitation
        The rig and the forcing of the first orbit; or a laboratory case or its code, and a
        frequency.
    start
        A state near that orbit, at the excitation's phase; None for where the motion from rest
        settles.
    parameter
        What is varied: "frequency", "amplitude", "gap", "right_gap", "left_gap",
        "bumper_stiffness", "bumper_damping", "stiffness", "damping", "stiffness_ratio" (λ, the
        bumpers' relaxation time kept) or "gap_ratio" (δ0).
    low, high
        Range of the parameter, in SI units or as text.
    period
        Of the orbits, in forcing cycles; None for that of the motion from rest, or 1 with a start.
    most_points
        Orbits in each direction after which it is given up.
    progress
        Called with the number of orbits so far as the branch is followed, and with None until
        it has been.

    Returns
    -------
    xarray.Dataset
        Dim ``point`` along the branch: the parameter by its name, ``arclength``, extremes,
        excursions, ``eta_d`` and ``eta_a`` (over the largest free flight of the isolator at any
        frequency), ``eccentricity``, impacts per cycle, ``multiplier_real`` and ``_imag`` (dim
        ``multiplier``, the largest first), ``stable`` and ``section``. Dim ``bifurcation``: kind,
        parameter, state and multipliers of each. The attributes ``ended_low`` and ``ended_high``
        say why the branch ends at its beginning and at its end.

    Raises
    ------
    InputError
        If a value cannot be used, or Newton's method finds no orbit near the start.
    """
    fam = family(oscillator, excitation, parameter)
    span = bounds(fam.parameter, low, high)
    if not span[0] <= fam.value <= span[1]:
        raise InputError(
            f"low: {span[0]:g} to {span[1]:g} leaves out the first orbit's {parameter}, "
            f"{fam.value:g}; a range that holds it is accepted"
        )
    period = None if period is None else whole(period, "period")
    most_points = whole(most_points, "most_points")
    first = first_orbit(fam, span, start, period)
    data = as_dataset([follow_both_ways(first, span, most_points, progress)], fam, span)
    if progress is not None:
        progress(data.sizes["point"], data.sizes["point"])
    return data


def first_orbit(
    fam: Family,
    span: tuple[float, float],
    start: State | xr.DataArray | xr.Dataset | None,
    period: int | None,
    symmetric: bool = True,
) -> Orbit:
    """The orbit near a state; if `symmetric`, as its own mirror image where it is one.

    Raises
    ------
    InputError
        If Newton's method finds none.
    """
    rest = None
    if start is None:
        begin = equilibrium(fam.oscillator).replace(phase=fam.phase)
        rest = approach(fam.oscillator, fam.excitation, begin)
        vector = rest.state
        point = np.array([vector[2], vector[3], vector[4], -vector[5], fam.value])
        mode = float(vector[layout.MODE])
        if rest.status not in (Status.DONE, Status.NOT_SETTLED):
            raise InputError(f"start: the motion from rest is given up: {rest.status.advice}")
        if period is None and not rest.period:
            raise InputError(
                f"start: the motion from rest does not settle at {fam.excitation.frequency:g} Hz; "
                "a state near an orbit, and its period, are accepted"
            )
        period = period or rest.period
    else:
        state = as_state(start)
        if state.phase is not None:
            fam = fam._replace(excitation=fam.excitation.replace(phase=state.phase))
        point = np.array(
            [
                state.displacement,
                state.velocity,
                state.right_bumper or 0.0,
                state.left_bumper or 0.0,
                fam.value,
            ]
        )
        mode = float({1: RIGHT, -1: LEFT}.get(state.contact or 0, FLIGHT))
    period = period or 1
    section = Section(fam, period, False, scales(fam, span, point))
    status, orbit_found = corrected(section, point, mode)
    if status is not Status.DONE:
        raise InputError(
            f"start: Newton's method finds no orbit of period {period} near it "
            f"({told(status)}); a state nearer to one is accepted"
        )
    orbit_found = reduced(orbit_found)
    if rest is not None:
        _tell_another(rest, orbit_found)
    return symmetric_if_so(orbit_found) if symmetric else orbit_found


def _tell_another(rest: Settled, found: Orbit) -> None:
    """Warn if an orbit that was sought where the motion from rest goes is another motion."""
    there = vector_of(found)
    if (
        rest.period == found.section.period
        and apart(rest, there, rest.state, reach(rest, rest.state)) <= _SAME
    ):
        return
    it = f"has period {rest.period}" if rest.period else "does not settle"
    warnings.warn(
        f"this orbit of period {found.section.period} is not the motion from rest, which {it}",
        RuntimeWarning,
        stacklevel=4,
    )


def told(status: Status) -> str:
    """Why a correction failed, in words."""
    if status is Status.NOT_SETTLED:
        return "it does not converge"
    return status.advice


def reduced(found: Orbit) -> Orbit:
    """The orbit with its least period."""
    section = found.section
    for count in range(1, section.count):
        simpler = section.simpler(count, mirror=False)
        if section.count % count == 0 and is_fixed(simpler, found, 1e-9):
            status, simple = corrected(simpler, found.point, found.facts[section_map.MODE])
            return simple if status is Status.DONE else found
    return found


def symmetric_if_so(found: Orbit) -> Orbit:
    """The orbit as a fixed point of the mirrored map, if it is its own mirror image."""
    section = found.section
    if not own_mirror(found, 1e-9):
        return found
    half = section.simpler(section.count, mirror=True)
    status, mirrored = corrected(half, found.point, found.facts[section_map.MODE])
    return mirrored if status is Status.DONE else found


def scales(fam: Family, span: tuple[float, float], point: _Array) -> _Array:
    """Sizes of displacement, velocity, deformations and parameter."""
    rig, shaken = fam.oscillator, fam.excitation
    # The nearer bumper: the other may be far out of reach.
    gap = min((b.gap for b in (rig.right, rig.left) if b is not None), default=0.0)
    omega = shaken.angular_frequency
    size = max(
        gap,
        abs(float(point[0])),
        abs(float(point[1])) / omega,
        1e-3 * shaken.amplitude / rig.angular_frequency**2,
    )
    return np.array([size, size * omega, size, size, span[1] - span[0]])


def follow_both_ways(
    first: Orbit, span: tuple[float, float], most_points: int, progress: Progress | None = None
) -> Followed:
    """Follow a branch both ways from an orbit, and find its bifurcations."""
    traces, told = [], counted(progress)
    for sense in (-1.0, 1.0):
        start = Station(first, first.tangent(sense * HELD), 0.0, 0)
        trace = arclength.follow(Branch(start, *span), start, most_points, told)
        traces.append(trace)
        if trace.ended == CLOSED:
            break
    if len(traces) == 1:
        stations = traces[0].points
    else:
        stations = bifurcations.joined(traces[0].points, traces[1].points)
    return Followed(
        stations,
        list(bifurcations.find(stations)),
        (traces[0].ended, traces[-1].ended),
        len(traces) == 1,
    )


def as_dataset(
    followed: list[Followed], fam: Family, span: tuple[float, float], created: str = "branch"
) -> xr.Dataset:
    """Branches as one labelled dataset."""
    name = fam.parameter.name
    stations = [
        (i, s)
        for i, one in enumerate(followed)
        for s in bifurcations.with_critical(one.stations, one.bifurcations)
    ]
    orbits = [s.orbit for _, s in stations]
    measured = np.array([_measured(one) for one in orbits]).reshape(-1, hold.RESULTS)
    high, low = measured[:, hold.U_MOST], measured[:, hold.U_LEAST]
    top, bottom = measured[:, hold.A_MOST], measured[:, hold.A_LEAST]
    free = np.array([_reference(one) for one in orbits]).reshape(-1, 2)
    multipliers = np.array([one.multipliers for one in orbits]).reshape(-1, 4)
    values = {
        "arclength": [s.arclength for _, s in stations],
        "displacement_max": high,
        "displacement_min": low,
        "displacement_excursion": high - low,
        "acceleration_max": top,
        "acceleration_min": bottom,
        "acceleration_excursion": top - bottom,
        "eta_d": (high - low) / free[:, 0],
        "eta_a": (top - bottom) / free[:, 1],
        "eccentricity": 0.5 * (high + low),
        "impacts_right": measured[:, hold.HITS_RIGHT],
        "impacts_left": measured[:, hold.HITS_LEFT],
        "period": [one.section.period for one in orbits],
        "antisymmetric": [one.section.mirror for one in orbits],
        "stable": np.array(
            [-1 if s.critical else int(s.orbit.stable) for _, s in stations], dtype=np.int64
        ),
        "branch": np.array([i for i, _ in stations], dtype=np.int64),
        "piece": np.array([s.piece for _, s in stations], dtype=np.int64),
    }
    variables: dict[str, Any] = {
        **{key: ("point", np.asarray(value)) for key, value in values.items()},
        "multiplier_real": (("point", "multiplier"), multipliers.real),
        "multiplier_imag": (("point", "multiplier"), multipliers.imag),
        "section": (("point", "component"), np.array([state_of(one) for one in orbits])),
        **_bifurcations(followed),
    }
    coordinates = {name: ("point", [one.value for one in orbits]), "component": COMPONENTS}
    data = xr.Dataset(variables, coordinates)
    data.attrs["parameter"] = name
    for i, one in enumerate(followed):
        prefix = f"branch_{i}_" if created == "resonance_diagram" else ""
        data.attrs[f"{prefix}ended_low"], data.attrs[f"{prefix}ended_high"] = one.ended
        data.attrs[f"{prefix}closed"] = int(one.closed)
    return describe(
        data,
        f"vibroimpact.{created}",
        {
            "oscillator": oscillator_parameters(fam.oscillator),
            "amplitude": fam.excitation.amplitude,
            "frequency": fam.excitation.frequency,
            "phase": fam.phase,
            "parameter": name,
            "low": span[0],
            "high": span[1],
        },
    )


def _bifurcations(followed: list[Followed]) -> dict[str, Any]:
    """The bifurcations as variables."""
    found = [(i, b) for i, one in enumerate(followed) for b in one.bifurcations]
    multipliers = np.array([b.orbit.multipliers for _, b in found]).reshape(-1, 4)
    measured = np.array([_measured(b.orbit) for _, b in found]).reshape(-1, hold.RESULTS)
    free = np.array([_reference(b.orbit) for _, b in found]).reshape(-1, 2)
    excursion = measured[:, hold.U_MOST] - measured[:, hold.U_LEAST]
    peak = measured[:, hold.A_MOST] - measured[:, hold.A_LEAST]
    values: dict[str, Any] = {
        "kind": np.array([b.kind for _, b in found], dtype=str),
        "value": [b.orbit.value for _, b in found],
        "arclength": [b.arclength for _, b in found],
        "turns": np.array([int(b.turns) for _, b in found], dtype=np.int64),
        "branch": np.array([i for i, _ in found], dtype=np.int64),
        "displacement_excursion": excursion,
        "eta_d": excursion / free[:, 0],
        "eta_a": peak / free[:, 1],
        "eccentricity": 0.5 * (measured[:, hold.U_MOST] + measured[:, hold.U_LEAST]),
        "period": np.array([b.orbit.section.period for _, b in found], dtype=np.int64),
        "antisymmetric": np.array([b.orbit.section.mirror for _, b in found], dtype=bool),
        "contacts": np.array([_contacts(b) for _, b in found], dtype=str),
    }
    states = np.array([state_of(b.orbit) for _, b in found]).reshape(-1, len(COMPONENTS))
    return {
        **{
            f"bifurcation_{key}": ("bifurcation", np.asarray(value))
            for key, value in values.items()
        },
        "bifurcation_multiplier_real": (("bifurcation", "multiplier"), multipliers.real),
        "bifurcation_multiplier_imag": (("bifurcation", "multiplier"), multipliers.imag),
        "bifurcation_section": (("bifurcation", "component"), states),
    }


def _contacts(found: Bifurcation) -> str:
    """Contacts per period, right (R) and left (L); at a grazing on both sides of it."""
    before = "{}R {}L".format(*found.orbit.contacts)
    if found.contacts_behind == found.orbit.contacts:
        return before
    return before + " | {}R {}L".format(*found.contacts_behind)


def state_of(one: Orbit) -> list[float]:
    """The state at the section as the components of a dataset's state."""
    mode = int(one.facts[section_map.MODE])
    side = {RIGHT: 1.0, LEFT: -1.0}.get(mode, 0.0)
    return [*one.point[:4], one.section.family.phase, side]


def _measured(one: Orbit) -> _Array:
    """Exact extremes and contacts per cycle; NaN, and a warning, where a limit is met."""
    result = np.full(hold.RESULTS, np.nan)
    outcome = orbit.measure_orbit(
        one.section.family.system(one.value),
        one.section.family.phase,
        one.point,
        one.facts,
        one.section.period,
        2 * MAX_EVENTS,
        result,
    )
    if outcome != Status.DONE:
        result[:] = np.nan
        warnings.warn(
            f"the orbit at {one.value:.9g} has no extremes: {Status(outcome).advice}",
            RuntimeWarning,
            stacklevel=4,
        )
    return result


def _reference(one: Orbit) -> tuple[float, float]:
    """Excursions of displacement and absolute acceleration that η is taken over."""
    system = one.section.family.system(one.value)
    omega = float(np.sqrt(system[par.STIFFNESS]))
    xi = float(system[par.DAMPING]) / (2.0 * omega)
    return reference_excursions(omega, xi, float(system[section_map.AMPLITUDE]))
