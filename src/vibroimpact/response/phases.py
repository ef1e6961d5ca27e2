"""The phases of a recorded motion: flights and contacts, each from its exact beginning."""

from __future__ import annotations

import json
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import measure
from vibroimpact.engine.motion import FLIGHT, LEFT, RIGHT
from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Harmonic, Oscillator, State, validate
from vibroimpact.response.start import engine_rig

_Array = NDArray[np.float64]

_COMPONENTS = ("displacement", "velocity", "right_bumper", "left_bumper")


class Recorded(NamedTuple):
    """What a dataset of a motion says of its origin."""

    oscillator: Oscillator
    excitation: Harmonic
    """Its phase is that at the beginning of the record."""
    cycles: float
    """Length of the record."""
    periodic: bool
    """Whether the record is one period of a periodic motion: its end is its beginning."""

    def of_side(self, side: NDArray[np.int64], name: str) -> _Array:
        """A bumper's number for each phase by the bumper pressed; 0 in flight."""
        right, left = (
            getattr(stop, name, 0.0) for stop in (self.oscillator.right, self.oscillator.left)
        )
        return np.where(side == 1, right, np.where(side == -1, left, 0.0))


class Phases(NamedTuple):
    """Phases of a motion, in the order of time: one value each, or one row of a state each."""

    contact: NDArray[np.int64]
    """Bumper pressed: -1 left, 0 none, 1 right."""
    begin: _Array
    """s, from the beginning of the record."""
    angle: _Array
    """The forcing's phase at the beginning, rad; not reduced over the cycles of one record."""
    length: _Array
    """s."""
    first: _Array
    """State at the beginning: u, u̇, u_R, u_L, shape (phase, 4)."""
    last: _Array
    """State at the end, shape (phase, 4)."""

    def take(self, chosen: NDArray[np.int64]) -> Phases:
        """The chosen phases."""
        parts = {name: values[chosen] for name, values in self._asdict().items()}
        return Phases(**parts)


def recorded(motion: xr.Dataset) -> Recorded:
    """Whose motion a dataset holds.

    Raises
    ------
    InputError
        If it is not the dataset of a motion with samples and events.
    """
    held = isinstance(motion, xr.Dataset) and {"event_time", "cycle", "velocity"} <= set(
        motion.variables
    )
    if not held or not motion.sizes["time"]:
        raise InputError(
            "motion: this is no recorded motion; a dataset of steady, or of simulate with samples, "
            "is accepted"
        )
    parameters = json.loads(motion.attrs["parameters"])
    oscillator = validate(Oscillator, parameters["oscillator"], "motion.oscillator")
    assert isinstance(oscillator, Oscillator)
    return Recorded(
        oscillator,
        Harmonic(parameters["amplitude"], parameters["frequency"], parameters["phase"]),
        float(motion["cycle"].values[-1]),
        "period" in motion and int(motion["period"]) > 0,
    )


def beginning(motion: xr.Dataset) -> State:
    """The state at the beginning of a record, with the forcing's phase."""
    values = {name: float(motion[name].values[0]) for name in _COMPONENTS}
    return State(
        **values,
        contact=int(motion["contact"].values[0]),
        phase=json.loads(motion.attrs["parameters"])["phase"],
    )


def phases(motion: xr.Dataset) -> Phases:
    """Cut a recorded motion at its contacts and detachments.

    Raises
    ------
    InputError
        If it is not the dataset of a motion with samples and events.
    """
    return cut(motion, recorded(motion))


def cut(motion: xr.Dataset, origin: Recorded) -> Phases:
    """As `phases`, of a motion whose origin is known."""
    period = origin.excitation.period
    # A motion that was given up has events behind its last sample.
    at = motion["event_cycle"].values + motion["event_cycle_time"].values / period
    motion = motion.isel(event=at <= origin.cycles * (1.0 + 1e-12))
    at_events = np.stack([motion[f"event_{name}"].values for name in _COMPONENTS], axis=-1)
    ends = [np.array([motion[name].values[i] for name in _COMPONENTS]) for i in (0, -1)]
    states = np.vstack([ends[0], at_events, ends[1]])
    kinds, sides = motion["event_contact"].values, motion["event_side"].values
    contact = np.concatenate([motion["contact"].values[:1], kinds * sides])
    if len(kinds):  # the first sample may lie behind an event at once
        contact[0] = 0 if kinds[0] else sides[0]
    # Differences within cycles keep digits that absolute times lose.
    cycle = np.concatenate([[0], motion["event_cycle"].values, [np.floor(origin.cycles)]])
    within = np.concatenate(
        [[0.0], motion["event_cycle_time"].values, [(origin.cycles % 1.0) * period]]
    )
    return Phases(
        contact.astype(np.int64),
        cycle[:-1] * period + within[:-1],
        origin.excitation.phase + 2.0 * np.pi * within[:-1] / period,
        np.maximum(np.diff(cycle) * period + np.diff(within), 0.0),
        states[:-1],
        states[1:],
    )


def measured(origin: Recorded, parts: Phases) -> _Array:
    """Measure phases: rows of `engine.measure`, per unit mass."""
    side = parts.contact
    mode = np.where(side == 1, RIGHT, np.where(side == -1, LEFT, FLIGHT))
    x = np.where(side == 0, parts.first[:, 0], np.where(side == 1, parts.first[:, 2], 0.0))
    x = np.where(side == -1, -parts.first[:, 3], x)
    v = np.where(side == -1, -1.0, 1.0) * parts.first[:, 1]
    table = np.column_stack([mode, x, v, parts.angle, parts.length])
    found = np.zeros((len(side), measure.MEASURES))
    measure.measure_phases(
        engine_rig(origin.oscillator),
        origin.excitation.amplitude,
        origin.excitation.frequency,
        np.ascontiguousarray(table, dtype=np.float64),
        found,
    )
    return found


def relaxation_loss(origin: Recorded, parts: Phases) -> _Array:
    """Energy (J) that each free bumper loses in each phase, shape (phase, 2): right, left.

    What its spring no longer holds at the end.
    """
    lost = np.zeros((len(parts.contact), 2))
    bumpers = (origin.oscillator.right, origin.oscillator.left)
    for i, (side, bumper) in enumerate(zip((1, -1), bumpers, strict=True)):
        if isinstance(bumper, Bumper):
            squares = parts.first[:, 2 + i] ** 2 - parts.last[:, 2 + i] ** 2
            lost[:, i] = np.where(parts.contact != side, 0.5 * bumper.stiffness * squares, 0.0)
    return lost
