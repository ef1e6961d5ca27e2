"""What the engine writes down of a motion, as a dataset's variables."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.observers import record
from vibroimpact.model.isolators import AnyIsolator
from vibroimpact.model.oscillator import Oscillator

EVENTS_AT_ONCE = 20_000
"""Room for events between two calls of the engine."""


def sampled(out: NDArray[np.float64], isolator: AnyIsolator) -> dict[str, Any]:
    """The samples; what the isolator remembers, if it does."""
    rows = {
        "displacement": record.DISPLACEMENT,
        "velocity": record.VELOCITY,
        "acceleration": record.ACCELERATION,
        "right_bumper": record.RIGHT_FACE,
        "left_bumper": record.LEFT_FACE,
        "right_clearance": record.RIGHT_CLEARANCE,
        "left_clearance": record.LEFT_CLEARANCE,
        **({"isolator_memory": record.MEMORY} if isolator.remembers else {}),
    }
    samples: dict[str, Any] = {name: ("time", out[row]) for name, row in rows.items()}
    return {**samples, "contact": ("time", out[record.CONTACT].astype(np.int64))}


def transmitted(
    variables: dict[str, Any],
    oscillator: Oscillator,
    force: NDArray[np.float64] | float = 0.0,
    event_force: NDArray[np.float64] | float = 0.0,
) -> dict[str, Any]:
    """The force of isolator and stops on the base (N): F(t) + F_0 − M times the acceleration.

    Parameters
    ----------
    variables
        Those of `sampled` and `listed`.
    force, event_force
        Force F(t) on the mass (N) at the samples and at the events; 0 if the base moves.
    """
    found = {
        "transmitted_force": ("acceleration", force),
        "event_transmitted_force_before": ("event_acceleration_before", event_force),
        "event_transmitted_force_after": ("event_acceleration_after", event_force),
    }
    made = {}
    for name, (acceleration, pushed) in found.items():
        dim, values = variables[acceleration]
        carried = -oscillator.mass * values
        carried += pushed + oscillator.force
        carried += 0.0  # no -0.0
        made[name] = (dim, carried)
    return made


def listed(
    parts: list[NDArray[np.float64]], period: float, isolator: AnyIsolator
) -> dict[str, Any]:
    """The contacts and detachments, in cycles or steps of this length (s).

    Columns are joined one by one, so that the parts are not kept a third time.
    """
    integers = {
        "event_cycle": record.E_CYCLE,
        "event_contact": record.E_KIND,
        "event_side": record.E_SIDE,
    }
    columns = {
        "event_cycle_time": record.E_TIME,
        "event_displacement": record.E_U,
        "event_velocity": record.E_V,
        "event_right_bumper": record.E_RIGHT,
        "event_left_bumper": record.E_LEFT,
        "event_acceleration_before": record.E_BEFORE,
        "event_acceleration_after": record.E_BEHIND,
        **({"event_isolator_memory": record.E_MEMORY} if isolator.remembers else {}),
    }

    def column(at: int) -> NDArray[np.float64]:
        return np.concatenate([part[:, at] for part in parts])

    time = column(record.E_CYCLE) * period + column(record.E_TIME)
    return {
        "event_time": ("event", time),
        **{name: ("event", column(at).astype(np.int64)) for name, at in integers.items()},
        **{name: ("event", column(at) + 0.0) for name, at in columns.items()},  # no -0.0
    }
