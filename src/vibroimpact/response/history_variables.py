"""What the engine writes down of a motion, as a dataset's variables."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.datasets.stops import by_stop, stop_names
from vibroimpact.engine.motion import LEFT, RIGHT
from vibroimpact.engine.observers import record
from vibroimpact.model.oscillator import Oscillator

EVENTS_AT_ONCE = 20_000
"""Room for events between two calls of the engine."""


def sampled(out: NDArray[np.float64], oscillator: Oscillator) -> dict[str, Any]:
    """The samples; what the isolator remembers, if it does.

    Deformations are positive when compressed. The engine has the opposite sign on the left, which
    is changed in place, because long motions are not kept twice.
    """
    rows = {
        "displacement": record.DISPLACEMENT,
        "velocity": record.VELOCITY,
        "acceleration": record.ACCELERATION,
        **({"isolator_memory": record.MEMORY} if oscillator.isolator.remembers else {}),
    }
    samples: dict[str, Any] = {name: ("time", out[row]) for name, row in rows.items()}
    np.negative(out[record.LEFT_FACE], out=out[record.LEFT_FACE])
    out[record.LEFT_FACE] += 0.0  # no -0.0
    faces = slice(record.RIGHT_FACE, record.LEFT_FACE + 1)
    apart = slice(record.RIGHT_CLEARANCE, record.LEFT_CLEARANCE + 1)
    touched = out[record.CONTACT]
    both = touched == record.TOUCHING[RIGHT | LEFT]
    touching = [both | (touched == record.TOUCHING[side]) for side in (RIGHT, LEFT)]
    by_side = {
        "deformation": out[faces].T,
        "clearance": out[apart].T,
        "touching": np.column_stack(touching),
    }
    return samples | {
        name: (("time", "stop"), by_stop(oscillator, values)) for name, values in by_side.items()
    }


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
    parts: list[NDArray[np.float64]], period: float, oscillator: Oscillator
) -> dict[str, Any]:
    """The contacts and detachments, in cycles or steps of this length (s).

    Columns are joined one by one, so that the parts are not kept a third time.
    """
    integers = {
        "event_cycle": record.E_CYCLE,
        "event_contact": record.E_KIND,
    }
    columns = {
        "event_cycle_time": record.E_TIME,
        "event_displacement": record.E_U,
        "event_velocity": record.E_V,
        "event_acceleration_before": record.E_BEFORE,
        "event_acceleration_after": record.E_BEHIND,
        **({"event_isolator_memory": record.E_MEMORY} if oscillator.isolator.remembers else {}),
    }

    def column(at: int) -> NDArray[np.float64]:
        return np.concatenate([part[:, at] for part in parts])

    time = column(record.E_CYCLE) * period + column(record.E_TIME)
    deformation = np.column_stack([column(record.E_RIGHT), 0.0 - column(record.E_LEFT)])
    return {
        "event_time": ("event", time),
        "event_stop": ("event", stop_names(column(record.E_SIDE))),
        "event_deformation": (("event", "stop"), by_stop(oscillator, deformation)),
        **{name: ("event", column(at).astype(np.int64)) for name, at in integers.items()},
        **{name: ("event", column(at) + 0.0) for name, at in columns.items()},  # no -0.0
    }
