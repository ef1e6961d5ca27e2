"""The motion at the selected frequency: its type, its history, its spectrum and its impacts."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.datasets.stops import of_stop
from vibroimpact.explorer.pictures.numbers import axis, forcing, forcings, one, short
from vibroimpact.explorer.state import PageState
from vibroimpact.facts import motions as facts_of
from vibroimpact.facts.tables import as_text
from vibroimpact.figures.finish import in_unit
from vibroimpact.model import Harmonic
from vibroimpact.model.quantities import FORCE
from vibroimpact.model.rig import Rig
from vibroimpact.model.written_units import as_first_argument, unitless
from vibroimpact.response.simulate import compute_history
from vibroimpact.response.spectrum import fourier_spectrum
from vibroimpact.stability.steady import steady

AXES = {
    "time": "time (s)",
    "displacement": "displacement (mm)",
    "velocity": "velocity (mm/s)",
    "force": "force ({})",
    "spectrum": "frequency (Hz)",
}
SAMPLES = 160
"""Of a cycle, so that a curve is smooth on the page."""
MOST_CYCLES = 8
"""Of a motion that is drawn; one that does not repeat is drawn as long."""
WINDOW, _GROWTH = 40, 2000
"""Cycles that are recorded, and over which the growth of disturbances is averaged."""
HIGHEST = 16.0
"""Order up to which lines of the spectrum are drawn."""


def at(state: PageState, data: xr.Dataset) -> tuple[Harmonic, xr.DataArray, float]:
    """Return the excitation, the state and the period of the selected motion, from a sweep.

    They belong to the frequency of the sweep that is nearest to the selected frequency.
    """
    held = data.sel(direction=state.direction).sel(
        frequency=state.shaking.frequency, method="nearest"
    )
    shaken = state.shaking.replace(frequency=float(held["frequency"]))
    return shaken, held["section"], float(held["period"])


@as_first_argument
def quick(state: PageState, data: xr.Dataset) -> dict[str, Any]:
    """Return the motion from the end of the sweep's simulation, while a knob is turned."""
    shaken, section, period = at(state, data)
    cycles = int(period) if 0 < period <= MOST_CYCLES else MOST_CYCLES
    motion = compute_history(Rig(state.oscillator, shaken), cycles, section, SAMPLES)
    return {**_drawn(state, motion, shaken), "fine": False}


@as_first_argument
def careful(state: PageState, data: xr.Dataset) -> dict[str, Any]:
    """Return the classified motion, with its spectrum, and the impacts that are drawn."""
    shaken, section, _ = at(state, data)
    motion = steady(
        Rig(state.oscillator, shaken), section, SAMPLES, window=WINDOW, exponent_cycles=_GROWTH
    )
    motions = {shaken.frequency: {f"{state.direction} branch": motion}}
    drawn = motion.isel(time=slice(MOST_CYCLES * SAMPLES + 1))
    return {
        **_drawn(state, drawn, shaken),
        "fine": True,
        "words": facts_of.words(motion),
        "table": as_text(facts_of.text(motions)),
        "spectrum": _spectrum(motion),
        "hits": [
            {"time": one(start), "stop": str(stop), "speed": one(in_unit(1e3) * speed)}
            for start, stop, speed in zip(
                motion["contact_start"].values,
                motion["contact_stop"].values,
                motion["contact_closing_speed"].values,
                strict=True,
            )
            if start < drawn["time"].values[-1]
        ],
    }


def _spectrum(motion: xr.Dataset) -> dict[str, Any]:
    """The lines of the displacement, the mean left out."""
    lines = fourier_spectrum(motion, HIGHEST).isel(order=slice(1, None))
    return {
        "frequency": forcings(lines["line_frequency"].values, 5),
        "displacement": short(in_unit(1e3) * lines["displacement_amplitude"].values),
    }


def _drawn(state: PageState, motion: xr.Dataset, shaken: Harmonic) -> dict[str, Any]:
    """The curves of a motion in mm and mm/s, or without units, and their axes."""
    rig = state.oscillator
    time = motion["time"].values
    force = motion["transmitted_force"].values
    faces, gaps = {}, {}
    for side, stop, sign in (("right", rig.right, 1.0), ("left", rig.left, -1.0)):
        gaps[side] = None if stop is None else one(in_unit(1e3) * sign * stop.gap)
        deformed = of_stop(motion, "deformation", side).values
        face = None if stop is None else short(in_unit(1e3) * sign * (stop.gap + deformed))
        faces[side] = face
    unit = FORCE.unit(float(np.nanmax(np.abs(force), initial=0.0)))
    return {
        "picture": "motion",
        "direction": state.direction,
        "frequency": forcing(shaken.frequency),
        "cycle": shaken.period,
        "seconds": not unitless(),
        "axes": {name: axis(label.format(unit.symbol)) for name, label in AXES.items()},
        "time": short(time, 6),
        "displacement": short(in_unit(1e3) * motion["displacement"].values),
        "velocity": short(in_unit(1e3) * motion["velocity"].values),
        "force": short(force / unit.size),
        **faces,
        "touching": {
            str(stop): motion["touching"].sel(stop=stop).values.astype(int).tolist()
            for stop in motion["stop"].values
        },
        "gaps": gaps,
    }
