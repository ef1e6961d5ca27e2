"""Orbits from which all branches over a parameter are begun: free flight, and what settles."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import excitation_from, motion_parameters
from vibroimpact.engine import batch
from vibroimpact.errors import InputError
from vibroimpact.model import Oscillator, State
from vibroimpact.model.rig import Rig
from vibroimpact.response.analytic_free_response import extremes, harmonics
from vibroimpact.response.engine_input import state_from
from vibroimpact.response.engine_system import engine_rig, system_vector
from vibroimpact.response.hold_rows import Settling
from vibroimpact.stability.fixed_points import Orbit
from vibroimpact.stability.initial_orbit import first_orbit
from vibroimpact.stability.parameter_family import Family, family
from vibroimpact.stability.parameter_sweep import SettledPoint, random_states, rigs_along, stepped
from vibroimpact.tasks.threads import Tally, each

_Array = NDArray[np.float64]
_Phasors = NDArray[np.complex128]

_SAME = 1e-6
"""Two orbits of one period whose extremes agree to this share are one, or mirror images."""


class StartingValues(NamedTuple):
    """The values of the parameter at which branches are begun."""

    fam: Family
    span: tuple[float, float]
    grid: _Array
    every: list[Rig]

    def family_at(self, i: int) -> Family:
        """The family, made at one of the values."""
        return _made(self.fam, float(self.grid[i]))


def _made(fam: Family, value: float) -> Family:
    """The family, made at a value."""
    rig = fam.at(value)
    if not fam.straight:
        return family(rig, fam.parameter.name)
    return fam._replace(value=value, rig=rig)


def values(fam: Family, span: tuple[float, float], count: int) -> StartingValues:
    """So many values over a range of a family's parameter."""
    grid = np.linspace(*span, count)
    grid[0], grid[-1] = span
    return StartingValues(fam, span, grid, rigs_along(fam.parameter, fam.rig, grid))


def free(at: StartingValues) -> Iterator[Orbit]:
    """Steady free flight where it reaches no stop: at the ends of each such range."""
    swings = [_swing(one) for one in at.every]
    flies = [_clear(one.oscillator, swing) for one, swing in zip(at.every, swings, strict=True)]
    edges = np.flatnonzero(np.diff(np.array([False, *flies, False]).astype(int)))
    for i in sorted({int(k) for a, b in edges.reshape(-1, 2) for k in (a, b - 1)}):
        swing, rig = swings[i], at.every[i]
        oscillator, shaken = rig.oscillator, rig.periodic
        assert swing is not None
        order = np.arange(1, len(swing) + 1)
        turned = swing * np.exp(1j * order * shaken.phase)
        u = oscillator.force / oscillator.isolator.initial_stiffness + turned.imag.sum()
        v = shaken.angular_frequency * (order * turned).real.sum()
        try:
            yield first_orbit(
                at.family_at(i), at.span, State(float(u), float(v), phase=shaken.phase), 1
            )
        except InputError:
            continue  # undamped, at resonance


def _swing(rig: Rig) -> _Phasors | None:
    """Phasors of the displacement in free flight; None of laws that have none in closed form."""
    isolator = rig.oscillator.isolator
    if isolator.initial_stiffness == 0.0 or not isolator.linear:
        return None
    with np.errstate(divide="ignore", invalid="ignore"):
        phasors: _Phasors = harmonics(rig, np.array([rig.periodic.frequency]))[0][0]
    return phasors


def _clear(rig: Oscillator, swing: _Phasors | None) -> bool:
    """Whether free flight reaches no stop."""
    if swing is None or not np.isfinite(swing).all():
        return False
    rest = rig.force / rig.isolator.initial_stiffness
    low, high = extremes(swing[np.newaxis])[:, 0] + rest
    right, left = (np.inf if stop is None else stop.gap for stop in (rig.right, rig.left))
    return bool(high < right and -low < left)


def settled(at: StartingValues, longest: int, random: int, seed: int) -> Iterator[Orbit]:
    """Orbits on which motions settle: carried on up and down, and from random starts.

    Each once at each value, mirror images left out.
    """
    batch.sweep.prepare(*(engine_rig(one) for one in at.every))
    count = len(at.grid)
    known: list[list[tuple[int, float, float]]] = [[] for _ in range(count)]
    ways = [_Way(None, 1), _Way(None, -1)]
    carried = each(lambda way, tally: _held(at, way, tally), ways, steps=2 * count)
    states = random_states(itertools.chain(*carried), at.every, random, seed)
    drawn = each(
        lambda way, tally: _held(at, way, tally),
        [_Way(state, 1) for state in states],
        steps=len(states) * count,
    )
    # From the far end of a sweep: there free flight and the large motions are simple.
    for motions, order in zip(
        [*carried, *drawn],
        [range(count)[::-1], range(count), *([range(count)] * random)],
        strict=True,
    ):
        for i in order:
            one = motions[i]
            ends = _ends(one)
            if not 0 < one.motion.period <= longest or _met(one, ends, known[i]):
                continue
            start = state_from(one.motion.state, one.motion.excitation.phase)
            try:
                yield first_orbit(at.family_at(i), at.span, start, one.motion.period)
            except InputError:
                continue  # settled to within the sweep's tolerance, but on the edge of a basin
            known[i].append((one.motion.period, *ends))


class _Way(NamedTuple):
    """How values are held: from one state each, or carried on, up (1) or down (-1)."""

    start: _Array | None
    sense: int


def _held(at: StartingValues, way: _Way, tally: Tally) -> list[SettledPoint]:
    """What motions settle on at each value, in rising order of them."""
    motions: list[SettledPoint] = []
    every = at.every[:: way.sense]
    stepped(every, way.start, Settling(), motions.append, tally, carry=way.start is None)
    return motions[:: way.sense]


def _ends(one: SettledPoint) -> tuple[float, float]:
    """How far a motion goes to both sides; of a symmetric rig the smaller first."""
    ends = float(one.measured.displacement_max), -float(one.measured.displacement_min)
    return (min(ends), max(ends)) if one.motion.symmetric else ends


def _met(
    one: SettledPoint, ends: tuple[float, float], known: list[tuple[int, float, float]]
) -> bool:
    """Whether an orbit of its period that goes as far was met before."""
    size = max(abs(end) for end in ends)
    return any(
        period == one.motion.period
        and max(abs(first - ends[0]), abs(second - ends[1])) <= _SAME * size
        for period, first, second in known
    )


def in_basins(
    fam: Family, span: tuple[float, float], data: Sequence[xr.Dataset], longest: int
) -> Iterator[Orbit]:
    """The periodic motions that datasets of `basins` have, each once; mirror images are no other.

    Raises
    ------
    InputError
        If one is no such dataset, or of another rig, or of a value beyond the range.
    """
    for i, one in enumerate(data):
        here = _made(fam, _value_of(fam, span, one, f"basins[{i}]"))
        for number in one["attractor"].values:
            period = int(one["period"].sel(attractor=number))
            image = int(one["mirror_image"].sel(attractor=number))
            if not 0 < period <= longest or 0 <= image < number:
                continue
            point = one.isel(point=int(np.argmax(one["section_attractor"].values == number)))
            held = point["section_deformation"]
            deformation = {str(stop): float(held.sel(stop=stop)) for stop in held["stop"].values}
            state = State(
                float(point["section_displacement"]),
                float(point["section_velocity"]),
                deformation,
            )
            try:
                yield first_orbit(here, span, state, period)
            except InputError:
                continue  # as of what settles


def _value_of(fam: Family, span: tuple[float, float], one: xr.Dataset, field: str) -> float:
    """The value of the parameter at which basins were found."""
    if not isinstance(one, xr.Dataset) or "basin" not in one or "section_attractor" not in one:
        raise InputError(f"{field}: this is not a result of basins; pass such a result")
    parameters = motion_parameters(one)
    rig = Rig(Oscillator.model_validate(parameters["oscillator"]), excitation_from(parameters))
    value = fam.parameter.read(rig)
    there = fam.at(value)
    alike = np.allclose(system_vector(rig), system_vector(there), 1e-9, 0.0, True)
    if not alike or abs(np.sin(0.5 * (rig.periodic.phase - fam.phase))) > 1e-9:
        raise InputError(
            f"{field}: these basins were computed for another rig, shaking or phase; compute them "
            f"for this rig, in which only the {fam.parameter.name} may differ"
        )
    if not span[0] <= value <= span[1]:
        low, high, own = (fam.written(x) for x in (*span, value))
        raise InputError(
            f"{field}: these basins were computed at {fam.parameter.name} {own}, outside the "
            f"range from {low} to {high}; widen this range, or remove these basins"
        )
    return value
