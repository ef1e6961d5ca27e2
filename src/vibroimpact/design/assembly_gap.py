"""The gaps with which the bodies of an assembly do not meet, from their motion without stops."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.stops import part_names
from vibroimpact.earthquakes.peak_demands import ScaledRecord, peaks
from vibroimpact.earthquakes.suites import quantiles
from vibroimpact.engine.assembly.plan import Drift
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Assembly, Harmonic, Record, equilibrium
from vibroimpact.response.engine_system import engine_system
from vibroimpact.tasks.threads import Progress, Workers

_Array = NDArray[np.float64]

_WIDE = 20
"""Half-widths of a resonance on either side of it at which the closing is sampled."""
_FAR = 1e9
"""A frequency so many times the largest natural one stands for infinity."""
_UNDAMPED = 1e-12
"""Decay of a mode over its frequency that is none."""
_GROWS = (
    "shaking: without stops the motion of the masses grows without bound, so no gap is wide "
    "enough; add damping, or reduce the span of frequencies"
)


def gaps_for_records(
    assembly: Assembly,
    records: dict[str, Record],
    fractile: float,
    tail: float | None,
    workers: Workers,
    progress: Progress | None,
) -> xr.Dataset:
    """Return the fractile over records of the largest closing displacement at each stop.

    Raises
    ------
    InputError
        If the motion without stops cannot be computed.
    """
    _closing(assembly)
    free = assembly.without_stops()
    # What closes at a stop is the drift of its bodies the other way.
    closing = [Drift(*assembly.ends(stop)[::-1]) for stop in assembly.stops.values()]
    runs = [ScaledRecord(free, record, np.ones(1), closing) for record in records.values()]
    peak_values = peaks(runs, tail=tail, threads=workers, progress=progress)
    for status in map(Status, peak_values["status"][:, 0].tolist()):
        if status is Status.NOT_FINITE:
            raise InputError(_GROWS)
        if status is not Status.DONE:
            raise InputError(
                f"shaking: the motion without stops could not be computed: {status.advice}"
            )
    reached = peak_values["drift_max"][:, 0]
    (gap,) = quantiles(reached, [fractile], 0)
    return xr.Dataset(
        {"required_gap": ("stop", gap), "peak_closing": (("record", "stop"), reached)},
        {"stop": assembly.part_names["stop"], "record": list(records)},
    )


def gaps_for_sines(assembly: Assembly, sine: Harmonic, span: tuple[Any, Any]) -> xr.Dataset:
    """Return the largest closing displacement at each stop, of sines at all frequencies of a span.

    An end that is None is 0, or infinity.

    Raises
    ------
    InputError
        If a mode without damping lies in the span.
    """
    free = assembly.without_stops()
    n = len(free.names)
    m, c, k = free.mass_matrix, free.damping_matrix, free.stiffness_matrix
    flow = np.block(
        [[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]]
    )
    rates = np.linalg.eigvals(flow)
    rates = rates[np.abs(rates) > 1e-9 * np.abs(rates).max()]  # the others are of free masses
    size = np.abs(rates)
    low = 1e-9 * size.min() if span[0] is None else math.tau * span[0]
    high = _FAR * size.max() if span[1] is None else math.tau * span[1]
    undamped = (-rates.real <= _UNDAMPED * size) & (low <= size) & (size <= high)
    if undamped.any():
        raise InputError(_GROWS)
    near = np.linspace(-_WIDE, _WIDE, 40 * _WIDE + 1)
    peaks = (np.abs(rates.imag)[:, np.newaxis] - np.outer(rates.real, near)).ravel()
    grid = np.concatenate([np.geomspace(low, high, 4000), peaks, [low, high]])
    grid = np.unique(grid[(grid >= low) & (grid <= high)])
    on = None if sine.moves_base else free.names.index(sine.on or free.names[0])
    weights = m @ free.influence if on is None else np.eye(n)[on] * float(m[on, on])
    closing = _closing(assembly)

    def reach(omega: _Array) -> _Array:
        """Return the amplitude of the closing displacement, shape (frequency, stop)."""
        forcing = np.asarray(sine.acceleration(float(m[on, on]) if on is not None else 1.0, omega))
        w = omega[:, np.newaxis, np.newaxis]
        stiff = k - w**2 * m + 1j * w * c
        # At rest in free flight, far beyond resonance, the solution loses no digits.
        u = np.linalg.solve(stiff, np.broadcast_to(weights[:, np.newaxis], (len(omega), n, 1)))
        amplitude: _Array = (
            np.abs(np.einsum("fi,wi->wf", closing, u[..., 0])) * forcing[:, np.newaxis]
        )
        return amplitude

    swing = reach(grid)
    best, at = swing.max(axis=0), grid[swing.argmax(axis=0)]
    for f, i in enumerate(swing.argmax(axis=0)):
        if 0 < i < len(grid) - 1:
            at[f], best[f] = _refined(lambda x, f=f: reach(x)[:, f], grid[i - 1], grid[i + 1])
    rest = equilibrium(free).displacement
    still = closing @ np.array([rest.get(name, 0.0) for name in free.names])
    return xr.Dataset(
        {
            "required_gap": ("stop", best + still),
            "displacement_frequency": ("stop", at / math.tau),
        },
        part_names(assembly, "stop"),
    )


def _refined(function: Any, low: float, high: float) -> tuple[float, float]:
    """Return where a function is largest between two places, and its value there."""
    for _ in range(8):
        x = np.linspace(low, high, 41)
        values = function(x)
        i = int(values.argmax())
        low, high = x[max(i - 1, 0)], x[min(i + 1, 40)]
    return float(x[i]), float(values[i])


def _closing(assembly: Assembly) -> _Array:
    if not assembly.stops:
        raise InputError(
            "rig: the assembly has no stops, so no gap is required; add the stops, with any gap, "
            "between the bodies that may meet"
        )
    return engine_system(assembly).closing
