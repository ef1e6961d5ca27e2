"""Common parts of figures of motions: names, styles, and curves that pass through the events."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from vibroimpact import errors
from vibroimpact.errors import InputError
from vibroimpact.figures.finish import in_unit
from vibroimpact.figures.legends import add_legend
from vibroimpact.figures.notebook import new_axes
from vibroimpact.figures.style import MOTIONS, SWEEPS, CurveStyle, lay_out
from vibroimpact.measurements.read import is_measured
from vibroimpact.model import Harmonic, Record
from vibroimpact.model.names import literal
from vibroimpact.model.quantities import FORCE, TIME, Scale
from vibroimpact.model.units import pretty
from vibroimpact.response.contacts import contacts
from vibroimpact.response.motion_phases import (
    contact_intervals,
    parting_velocity,
    recorded,
)
from vibroimpact.response.sine_fit import forcing_sine, slope

_Array = NDArray[np.float64]

MOST_CYCLES = 12
"""Largest number of forcing cycles in which neighbouring contacts can still be distinguished."""


class DrawnMotion(NamedTuple):
    """One motion as it is drawn: values over t/T, with the values before and after each event."""

    look: CurveStyle
    at: _Array
    """Time in forcing cycles, or in seconds for a motion through a `Record`."""
    values: dict[str, _Array]
    """Values by variable: displacement, velocity, acceleration, ``clearance.right``; under a force
    on the mass also the transmitted and the applied force."""
    touching: list[tuple[str, float, float]]
    """Stop of each contact, and its start and end in forcing cycles."""
    peaks: tuple[_Array, _Array]
    """Times (forcing cycles) and values of the peaks of the acceleration during contact."""
    gaps: dict[str, float]
    """Gap (m) on each side with a bumper."""

    @property
    def is_long(self) -> bool:
        """Whether there are so many cycles that their curves in a plane must be thin."""
        return bool(self.at[-1] - self.at[0] > 20.0)

    @property
    def loops(self) -> dict[str, Any]:
        """Keywords of `Axes.plot` for a curve in a plane."""
        how = self.look._replace(width=1.2)
        how = how._replace(dashes="-", width=0.25) if self.is_long else how
        return {**how.line, "label": how.label, "zorder": 3}


def by_name(data: Any, alone: str = "") -> dict[str, Any]:
    """Return datasets by name: those of a mapping, or one dataset alone."""
    several = isinstance(data, Mapping) and not isinstance(data, xr.Dataset)
    return {str(name): one for name, one in data.items()} if several else {alone: data}


def named(
    motions: xr.Dataset | Mapping[str, xr.Dataset], records: bool = False
) -> dict[str, xr.Dataset]:
    """Return the motions by name. A single motion has the name "motion".

    Raises
    ------
    InputError
        If there is no motion, if a dataset does not contain a motion with samples, or if a motion
        through a `Record` is passed without ``records``.
    """
    # A dataset is a mapping, too.
    named_motions = by_name(motions, "motion")
    if not named_motions:
        raise InputError(
            "motions: empty; pass at least one motion, the result of steady or simulate"
        )
    for motion in named_motions.values():
        if not _seen(motion):
            recorded(motion, records=records)
    return named_motions


def cycles_shown(motions: dict[str, xr.Dataset], cycles: float | None, least: int) -> float:
    """Return the number of forcing cycles to draw: as requested, or whole periods.

    Whole periods have at least `least` cycles. If the common period of the motions is longer than
    `MOST_CYCLES`, whole periods of the motion with the longest period are drawn.

    Raises
    ------
    InputError
        If the requested number is not greater than 0.
    """
    if cycles is not None:
        if not 0.0 < cycles < math.inf:
            raise InputError(f"cycles: {cycles!r}; use a finite number greater than 0")
        return cycles
    periods = [
        round(origin.cycles)
        for motion in motions.values()
        if not _seen(motion) and (origin := recorded(motion)).periodic
    ]
    shared = math.lcm(*periods)
    if shared > MOST_CYCLES:
        shared = max(periods)
    return float(shared * math.ceil(least / shared))


def cycles_label(motions: Mapping[str, xr.Dataset]) -> str:
    """Return the label of a time axis in cycles, which are not forcing cycles if nothing shakes."""
    periods = set()
    for motion in motions.values():
        shaken = None if _seen(motion) else recorded(motion).shaking
        if not isinstance(shaken, Harmonic) or shaken.amplitude != 0.0:
            return "time in forcing cycles $t/T$ (–)"
        periods.add(shaken.period)
    if len(periods) > 1:
        return "time in cycles $t/T$ (–)"
    length = pretty(float(f"{periods.pop():.4g}"), TIME)
    return f"time in cycles of {length} $t/T$ (–)"


def looks(names: list[str]) -> list[CurveStyle]:
    """Return the style of each motion: that of a sweep if its name contains a direction."""
    spare = iter([*MOTIONS, *MOTIONS] * (1 + len(names) // len(MOTIONS)))
    styles = []
    for name in names:
        known = [look for key, look in SWEEPS.items() if key in name]
        look = known[0] if len(known) == 1 else next(spare)
        styles.append(look._replace(label=literal(name)))
    return styles


def drawn_motions(motions: dict[str, xr.Dataset], cycles: float = math.inf) -> list[DrawnMotion]:
    """Return the curves of motions: the last cycles of a simulation, the first of others.

    A periodic motion is repeated to fill the cycles. If `cycles` is infinite, it is drawn once.
    Measured motions are shifted by whole cycles to the start of the others.
    """
    drawn = [
        _drawn_motion(motion, look, cycles)
        for motion, look in zip(motions.values(), looks(list(motions)), strict=True)
    ]
    of_model = [c.at[0] for c, m in zip(drawn, motions.values(), strict=True) if not _seen(m)]
    if not of_model:
        return drawn
    return [
        curve._replace(at=curve.at + math.floor(min(of_model) + 1e-9) - math.floor(curve.at[0]))
        if _seen(motion) and "cycle" not in motion and len(curve.at)
        else curve
        for curve, motion in zip(drawn, motions.values(), strict=True)
    ]


def _seen(motion: xr.Dataset) -> bool:
    """Return whether a motion was measured."""
    return is_measured(motion) and "event_time" not in motion


def check_axes(ax: object, field: str) -> Axes:
    """Return axes.

    Raises
    ------
    InputError
        If the value is not Axes.
    """
    if not isinstance(ax, Axes):
        raise InputError(f"{field}: {errors.shown(ax)}; pass Axes of matplotlib")
    return ax


def axes_or_new(ax: object, size: tuple[float, float], title: str | None) -> Axes:
    """Return the axes that were passed, or the axes of a new figure.

    Raises
    ------
    InputError
        If the value is not Axes.
    """
    if isinstance(ax, Axes):
        lay_out(ax)
        return ax
    if ax is not None:
        raise InputError(
            f"ax: {errors.shown(ax)} is not an Axes of matplotlib; pass an Axes or None"
        )
    made: Axes = new_axes(1, 1, size)[0, 0]
    if title:
        # Above the legend, which is above the axes.
        made.figure.suptitle(title, fontsize="medium")
    return made


def name_lines(ax: Axes, curves: list[DrawnMotion]) -> None:
    """Add a legend above the axes if there is more than one motion: curves, then marks."""
    if len(curves) > 1:
        handles, _ = ax.get_legend_handles_labels()
        handles.sort(key=lambda handle: not isinstance(handle, Line2D))
        add_legend(ax, handles, columns=3)


def _measured(motion: xr.Dataset, look: CurveStyle, cycles: float) -> DrawnMotion:
    """Return the curves of a measured history. A cycle starts where the sine of the base has θ = 0.

    If the velocity was not measured, it is the smoothed derivative of the displacement.
    """
    time = motion["time"].values
    base, moved = (
        motion[name].values if name in motion else None
        for name in ("base_acceleration", "displacement")
    )
    sine = forcing_sine(time, base, moved, motion.attrs.get("frequency"))
    at = time
    if sine is not None:
        at = sine.frequency * time + (sine.phase / (2.0 * math.pi) if base is not None else 0.0)
        at = at - math.floor(at[0])
    values = {}
    for name in ("displacement", "velocity", "acceleration"):
        held = motion[name].values if name in motion else np.full(len(time), np.nan)
        if name == "velocity" and name not in motion and moved is not None:
            known = np.isfinite(moved)
            held = np.full(len(time), np.nan)
            held[known] = slope(time[known], moved[known], sine)
        values[name] = held
    curve = DrawnMotion(look, at, values, [], (np.empty(0), np.empty(0)), {})
    last = min(float(at[-1]), math.ceil(at[0]) + cycles)
    return curve if math.isinf(cycles) else _clipped(curve, float(math.ceil(at[0])), last)


def _drawn_motion(motion: xr.Dataset, look: CurveStyle, cycles: float) -> DrawnMotion:
    if _seen(motion):
        return _measured(motion, look, cycles)
    origin = recorded(motion, records=True)
    shaken = origin.shaking
    if isinstance(shaken, Record):
        frequency, at = 1.0, motion["time"].values
        events = motion["event_time"].values
    else:
        frequency, at = shaken.frequency, motion["cycle"].values
        events = motion["event_cycle"].values + motion["event_cycle_time"].values * frequency
    times = np.concatenate([at, events, events])
    order = np.argsort(times, kind="stable")

    def merged(name: str, before: str, behind: str) -> _Array:
        parts = [motion[name].values, motion[before].values, motion[behind].values]
        return np.asarray(np.concatenate(parts)[order], dtype=float)

    arrival, parting = motion["event_velocity"].values, parting_velocity(motion, origin.oscillator)
    values = {
        "displacement": merged("displacement", "event_displacement", "event_displacement"),
        "velocity": np.concatenate([motion["velocity"].values, arrival, parting])[order],
        "acceleration": merged(
            "acceleration", "event_acceleration_before", "event_acceleration_after"
        ),
    }
    if not (isinstance(shaken, Record) or shaken.moves_base):
        values["transmitted_force"] = merged(
            "transmitted_force", "event_transmitted_force_before", "event_transmitted_force_after"
        )
        values["applied_force"] = shaken.at(2.0 * math.pi * times[order] + shaken.phase)
    gaps = {}
    stops = motion["stop"].values.tolist()
    for name in stops:
        gaps[name] = getattr(origin.oscillator, name).gap
        facing = 1.0 if name == "right" else -1.0
        deformation = motion["event_deformation"].sel(stop=name).values
        distance = deformation - facing * motion["event_displacement"].values
        clearance = np.where(motion["event_stop"].values == name, 0.0, gaps[name] + distance)
        parts = [motion["clearance"].sel(stop=name).values, clearance, clearance]
        values[f"clearance.{name}"] = np.concatenate(parts)[order]
    touching = [
        (name, float(begin), float(end))
        for name in stops
        for begin, end in contact_intervals(motion, name, events, float(at[-1]))
    ]
    log = motion if "contact_peak_time" in motion else contacts(motion)
    peak_at = log["contact_peak_time"].values * frequency
    peak = _signed(
        log["contact_peak_acceleration"].values, peak_at, times[order], values["acceleration"]
    )
    curve = DrawnMotion(look, times[order], values, touching, (peak_at, peak), gaps)
    if math.isinf(cycles):
        return curve
    if origin.periodic:
        return _clipped(_repeated(curve, origin.cycles, cycles), 0.0, cycles)
    if "period" in motion:  # steady, but not periodic: its record begins anywhere
        return _clipped(curve, 0.0, cycles)
    return _clipped(curve, max(float(at[0]), float(at[-1]) - cycles), float(at[-1]))


def _signed(peaks: _Array, peak_at: _Array, at: _Array, values: _Array) -> _Array:
    """Return peaks of an absolute value with the sign that the curve has there.

    The curve may jump at a peak. The sign is that of the value whose size is nearest to the peak,
    of those beside it and before and after an event.
    """
    beside = np.searchsorted(at, peak_at)[:, np.newaxis] + np.arange(-2, 3)
    neighbours = values[np.clip(beside, 0, len(values) - 1)]
    nearest = np.argmin(np.abs(np.abs(neighbours) - peaks[:, np.newaxis]), axis=1)
    signed: _Array = np.copysign(peaks, neighbours[np.arange(len(peaks)), nearest])
    return signed


def _repeated(curve: DrawnMotion, period: float, cycles: float) -> DrawnMotion:
    turns = np.arange(-1, math.ceil(cycles / period) + 1) * period
    return curve._replace(
        at=np.concatenate([curve.at + turn for turn in turns]),
        values={name: np.tile(value, len(turns)) for name, value in curve.values.items()},
        touching=_joined([(s, a + turn, b + turn) for turn in turns for s, a, b in curve.touching]),
        peaks=(
            np.concatenate([curve.peaks[0] + turn for turn in turns]),
            np.tile(curve.peaks[1], len(turns)),
        ),
    )


def _joined(touching: list[tuple[str, float, float]]) -> list[tuple[str, float, float]]:
    """Join the two parts of a contact that continues across the end of the period."""
    joined: list[tuple[str, float, float]] = []
    for side, begin, end in sorted(touching, key=lambda contact: contact[1]):
        if joined and joined[-1][0] == side and begin - joined[-1][2] < 1e-9:
            joined[-1] = (side, joined[-1][1], end)
        else:
            joined.append((side, begin, end))
    return joined


def _clipped(curve: DrawnMotion, first: float, last: float) -> DrawnMotion:
    inside = (curve.at >= first) & (curve.at <= last)
    seen = (curve.peaks[0] >= first) & (curve.peaks[0] <= last)
    return curve._replace(
        at=curve.at[inside],
        values={name: value[inside] for name, value in curve.values.items()},
        touching=[
            (s, max(a, first), min(b, last))
            for s, a, b in curve.touching
            if b >= first and a <= last
        ],
        peaks=(curve.peaks[0][seen], curve.peaks[1][seen]),
    )


def force_unit(curves: list[DrawnMotion]) -> Scale:
    """Return the unit in which the transmitted forces of motions under a force are drawn."""
    largest = [
        float(np.nanmax(np.abs(curve.values[name]), initial=0.0))
        for curve in curves
        for name in ("transmitted_force", "applied_force")
    ]
    return FORCE.unit(*largest)


def gap_lines(ax: Axes, curves: list[DrawnMotion], *, horizontal: bool) -> None:
    """Draw dashed lines at the positions of the undeformed bumpers (mm)."""
    gaps = {
        (1 if name == "right" else -1) * gap for curve in curves for name, gap in curve.gaps.items()
    }
    for gap in sorted(gaps):
        draw = ax.axhline if horizontal else ax.axvline
        draw(in_unit(1e3) * gap, color="black", linestyle="--", linewidth=0.8, zorder=2)
