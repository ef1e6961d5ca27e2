"""The first orbit of a branch: near a state, or where the motion from rest settles."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine.state import MODE
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError, warn_of_result
from vibroimpact.model import AssemblyState, State
from vibroimpact.model.frequency_text import forcing
from vibroimpact.model.written_units import written_for
from vibroimpact.stability.bifurcations import own_mirror
from vibroimpact.stability.chatter import placed_at_rest
from vibroimpact.stability.fixed_points import (
    Orbit,
    Section,
    corrected,
    is_fixed,
    vector_of,
)
from vibroimpact.stability.parameter_family import Family
from vibroimpact.stability.settled_motion import (
    Settled,
    approach,
    reach,
    reach_at_rest,
    state_distance,
)

_Array = NDArray[np.float64]

_SAME = 1e-6
"""Distance, over the motion's size, from the motion from rest of an orbit that is it."""
_SINGULAR = 1e-7
"""A singular value of P' - 1, scaled, below which it counts as singular."""
_RETURNS = 400
"""Forcing cycles over which the motion from rest is watched for close returns."""
_LARGER = (1e3, 1e6)
"""How much larger motions are sought that begin at rest."""
_TRIES = 16
"""Close returns from which Newton's method is tried."""


def first_orbit(
    fam: Family,
    span: tuple[float, float],
    start: State | AssemblyState | xr.DataArray | xr.Dataset | None,
    period: int | None,
    symmetric: bool = True,
) -> Orbit:
    """The orbit near a state; if `symmetric`, as its own mirror image where it is one.

    Raises
    ------
    InputError
        If Newton's method finds none.
    """
    states = fam.layout
    if start is None and not fam.rig.system.stops:
        start = states.read(None)  # there is one orbit, however long motions take to it
    if start is None:
        orbit = _from_rest(fam, span, period)
    else:
        state = states.read(start)
        if state.phase is not None:
            fam = fam.with_phase(state.phase)
        parts, mode = states.near(state)
        point = np.append(parts, fam.value)
        status, orbit = _least(fam, span, period or 1, point, mode)
        if status is not Status.DONE:
            raise _no_orbit(period or 1, status, orbit)
    orbit = placed_at_rest(orbit)
    return symmetric_if_so(orbit) if symmetric else orbit


def _no_orbit(period: int, status: Status, failed: Orbit | None) -> InputError:
    if failed is not None and status is Status.NOT_SETTLED and _neutral(failed):
        return InputError(
            f"start: Newton's method does not converge to an orbit of period {period}, because an "
            "orbit near this state has a Floquet multiplier of 1; add isolator damping, or pass "
            "another start"
        )
    return InputError(
        f"start: Newton's method finds no orbit of period {period} near this state "
        f"({reason_of(status)}); pass a start closer to an orbit, or another period"
    )


def _neutral(orbit: Orbit) -> bool:
    """Whether P' - 1 is singular at a point: a disturbance of state stays as it is."""
    moving = 2 * orbit.section.family.layout.masses
    values = np.linalg.svd(orbit.jacobian[:moving, :moving], compute_uv=False)
    return bool(values[-1] <= _SINGULAR)


def _least(
    fam: Family, span: tuple[float, float], period: int, point: _Array, mode: float
) -> tuple[Status, Orbit]:
    """Newton's method from a point; the orbit with its least period."""
    scale = scales(fam, span, point)
    status, orbit = corrected(Section(fam, period, False, scale), point, mode)
    told_by_none = scale[0] == _least_size(fam) or not fam.rig.system.stops
    if status is Status.NOT_SETTLED and told_by_none:
        # Neither the start nor a gap states the motion's size, which bounds a step; without stops
        # the map is linear, and a step of any length is right.
        for factor in _LARGER:
            wide = scale * np.append(np.full(len(scale) - 1, factor), 1.0)
            status, orbit = corrected(Section(fam, period, False, wide), point, mode)
            if status is Status.DONE:
                section = Section(fam, period, False, scales(fam, span, orbit.point))
                status, orbit = corrected(section, orbit.point, orbit.mode)
                break
    return status, reduced(orbit) if status is Status.DONE else orbit


def _from_rest(fam: Family, span: tuple[float, float], period: int | None) -> Orbit:
    """The orbit on which the motion from rest settles, or one of a given period close to it."""
    states = fam.layout
    begin = states.vector_of(states.read(None))
    rest = approach(fam.rig, begin)
    if rest.status not in (Status.DONE, Status.NOT_SETTLED):
        raise InputError(f"start: the motion from rest could not be computed: {rest.status.advice}")
    if period is None and not rest.period:
        with written_for(fam.rig):
            hertz = forcing(fam.excitation.frequency)
        raise InputError(
            f"start: the motion from rest does not settle at {hertz}; "
            "pass a start near an orbit, and the period of this orbit"
        )
    period = period or rest.period
    repeats = rest.period and period % rest.period == 0
    least, failed, status = None, None, Status.NOT_SETTLED
    for vector in [rest.state] if repeats else _returns(rest, begin, period):
        point = np.append(states.point(vector), fam.value)
        outcome, orbit = _least(fam, span, period, point, float(vector[MODE]))
        if outcome is not Status.DONE:
            status, failed = outcome, orbit
            continue
        # A close return over several cycles may be due to an orbit of fewer.
        if least is None or orbit.section.count == period:
            least = orbit
        if repeats or orbit.section.count == period:
            break
    if least is None:
        raise _no_orbit(period, status, failed)
    _tell_another(rest, least)
    return least


def _returns(rest: Settled, begin: _Array, period: int) -> list[_Array]:
    """Where the motion from rest comes back to itself most closely after so many cycles.

    A motion that does not settle passes near every orbit in its reach again and again, and is
    then nearest to itself a period later.
    """
    sections = [begin]
    for _ in range(_RETURNS + period):
        status, vector = rest.engine.propagate(sections[-1], 1.0)
        if status is not Status.DONE:
            break
        sections.append(vector)
    size = reach(rest, rest.state)
    missed = [
        state_distance(rest, *pair, size) for pair in zip(sections, sections[period:], strict=False)
    ]
    best: list[int] = []
    for i in np.argsort(missed, kind="stable"):
        # Its neighbours belong to the same passage.
        if all(abs(i - other) > period for other in best):
            best.append(int(i))
        if len(best) == _TRIES:
            break
    return [sections[i] for i in best]


def _tell_another(rest: Settled, orbit: Orbit) -> None:
    """Warn if an orbit that was sought where the motion from rest goes is another motion."""
    there = vector_of(orbit)
    if (
        rest.period == orbit.section.count
        and state_distance(rest, there, rest.state, reach(rest, rest.state)) <= _SAME
    ):
        return
    it = f"has period {rest.period}" if rest.period else "does not settle"
    warn_of_result(
        f"the computed orbit has period {orbit.section.count} and is not the motion from rest, "
        f"which {it}; to compute another orbit, pass a start near that orbit"
    )


def reason_of(status: Status) -> str:
    """Why a correction failed, in words."""
    if status is Status.NOT_SETTLED:
        return "it does not converge"
    return status.advice


def reduced(orbit: Orbit) -> Orbit:
    """The orbit with its least period."""
    section = orbit.section
    for count in range(1, section.count):
        simpler = section.with_map(count, mirror=False)
        if section.count % count == 0 and is_fixed(simpler, orbit):
            status, simple = corrected(simpler, orbit.point, orbit.mode)
            return simple if status is Status.DONE else orbit
    return orbit


def symmetric_if_so(orbit: Orbit) -> Orbit:
    """The orbit as a fixed point of the mirrored map, if it is its own mirror image."""
    section = orbit.section
    if not own_mirror(orbit):
        return orbit
    half = section.with_map(section.count, mirror=True)
    status, mirrored = corrected(half, orbit.point, orbit.mode)
    return mirrored if status is Status.DONE else orbit


def _least_size(fam: Family) -> float:
    """Of a displacement where nothing else states one."""
    return 1e-3 * reach_at_rest(fam.rig)


def scales(fam: Family, span: tuple[float, float], point: _Array) -> _Array:
    """Sizes of displacement, velocity, deformations and parameter."""
    states, omega = fam.layout, fam.excitation.angular_frequency
    # The nearer stop: the other may be far out of reach.
    gap = min((one.gap for one in fam.rig.system.stop_laws.values()), default=0.0)
    n = states.masses
    moved = [abs(float(u)) for u in point[:n]]
    moved += [abs(float(v)) / omega for v in point[n : 2 * n]]
    size = max(gap, *moved, _least_size(fam))
    sizes = np.full(states.parts, size)
    sizes[states.velocities()] *= omega
    return np.append(sizes, span[1] - span[0])
