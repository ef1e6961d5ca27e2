"""The most informative next test: the information that each candidate would add to a fit.

To first order, a hold at which excursions have the derivatives R (in standard deviations of the
measurement) takes the covariance C of a fit to C − C Rᵀ (1 + R C Rᵀ)⁻¹ R C.

The derivatives are secants over one standard deviation along each axis of C. A hold next to a fold,
which an equally likely rig would have passed, therefore counts as uninformative.
"""

from __future__ import annotations

import json
from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.arguments import check_list, check_name, check_variables
from vibroimpact.datasets.description import describe, rig_parameters
from vibroimpact.identification.branch_response import SteppedRig, sizes
from vibroimpact.identification.free_parameters import NEAR_ZERO, SENSORS, size_of
from vibroimpact.identification.results import rig_of
from vibroimpact.model.argument_types import share as fraction
from vibroimpact.model.excitation import Repeated, sized
from vibroimpact.model.frequency_text import forcing
from vibroimpact.model.parameters import parameter, set_values
from vibroimpact.model.public import public
from vibroimpact.model.quantities import DIMENSIONLESS
from vibroimpact.model.rig import Rig
from vibroimpact.model.units import pretty, to_si
from vibroimpact.response.hold_rows import HoldRows
from vibroimpact.response.sweep import check_frequencies

Array = NDArray[np.float64]

_MOST = 0.2
"""Of a value, by which it is moved at most: where it is hardly known, one deviation is too far."""
_FACTORS = (0.5, 0.75, 1.0, 1.5, 2.0)
"""Of the amplitude."""
_POINTS = 121
_TIE = 1e-6
"""Share by which two candidates may differ and be as good as each other."""
_WILD = 0.5
"""Change of a logarithm over one deviation at which a jump may have been passed."""
_LITTLE = 0.98
"""Of a standard error, beyond which a hold is hardly worth it."""
_NOISE = 0.02
"""Noise of a future hold, if the tests of the fit were not curves."""


@public
def next_test(
    result: xr.Dataset,
    frequencies: Iterable[float | str] | None = None,
    amplitudes: Iterable[float | str] | None = None,
    *,
    test: str | None = None,
    noise: float | None = None,
    margin: float = 0.02,
) -> xr.Dataset:
    """Find the next measurement that would reduce the uncertainty of a fit most.

    A candidate measurement is one frequency step of a stepped-sine test: the frequency and the
    amplitude are held until the motion is steady, and its excursions are measured.

    Parameters
    ----------
    result
        Dataset of `identify`.
    frequencies
        Candidate frequencies (Hz). Default: 121 frequencies from 0.5 to 5 times the natural
        frequency.
    amplitudes
        Candidate peaks of the base acceleration (m/s², or a string with a unit). Default: from 0.5
        to 2 times the amplitude of the test.
    test
        Name of the test whose rig would be measured again. Default: the first test.
    noise
        Standard deviation of the noise in the next test, as a share of the measured value. Default:
        the noise of the fit.
    margin
        Smallest accepted distance between the candidate frequency and the next jump in the
        direction of the sweep, as a share of the frequency. If it is 0, a candidate may be as close
        to the jump as the uncertainty of the jump allows.

    Returns
    -------
    xarray.Dataset
        The dims are ``candidate_amplitude``, ``direction``, ``frequency`` and ``parameter``.
        ``remaining_error`` is the standard error of each parameter after the measurement, divided
        by the standard error before it. ``information`` is the information about all parameters
        together, in nats. Both are NaN where the motion does not settle, or where a jump is too
        close. The attribute ``findings`` describes the best candidates in words.

    Raises
    ------
    InputError
        If the dataset is not a fit, or if a candidate is invalid.
    """
    check_variables(result, ["covariance"], "result", "the result of identify")
    rigs = json.loads(result.attrs["rigs"])
    name = next(iter(rigs)) if test is None else test
    check_name(name, rigs, "test")
    rig = rig_of(rigs[name])
    oscillator, shaken = rig.oscillator, rig.periodic
    natural = oscillator.angular_frequency / (2.0 * np.pi) or float(shaken.frequency)
    grid = (
        np.linspace(0.5 * natural, 5.0 * natural, _POINTS)
        if frequencies is None
        else check_frequencies(frequencies)
    )
    levels = (
        shaken.amplitude * np.array(_FACTORS)
        if amplitudes is None
        else np.array(
            [
                sized(one, shaken.of, f"amplitudes[{i}]", positive=True)[0]
                for i, one in enumerate(check_list(amplitudes, "amplitudes"))
            ]
        )
    )
    own = float(result["noise"].sel(test=name))
    curves = str(result["test_kind"].sel(test=name).values) == "curves"
    stated_noise = None if noise is None else to_si(noise, DIMENSIONLESS, "noise", above=0.0)
    share = stated_noise if stated_noise is not None else max(own, 1e-4) if curves else _NOISE
    margin = to_si(margin, DIMENSIONLESS, "margin", minimum=0.0)
    margin = fraction(margin, "margin") if margin else 0.0
    keys = [str(key) for key in result["parameter"].values]
    covariance = result["covariance"].values
    shape = (len(levels), 2, len(grid))
    error = np.full((*shape, len(keys)), np.nan)
    gain = np.full(shape, np.nan)
    axes = _axes(covariance)
    before = np.sqrt(np.sum(axes**2, axis=1))
    for a, level in enumerate(levels):
        here = Rig(oscillator, shaken.replace(amplitude=level))
        slopes, known = _slopes(here, keys, name, grid, axes)
        if margin:
            known &= _far_from_jumps(here, grid, margin)
        for d, k in np.argwhere(known):
            rows = slopes[d, k] / share
            seen = np.eye(2) + rows @ rows.T
            drop = axes @ rows.T
            after = before**2 - np.sum(drop * np.linalg.solve(seen, drop.T).T, axis=1)
            error[a, d, k] = np.sqrt(np.maximum(after, 0.0)) / before
            gain[a, d, k] = 0.5 * np.linalg.slogdet(seen)[1]
    dims = ("candidate_amplitude", "direction", "frequency")
    data = xr.Dataset(
        {"information": (dims, gain), "remaining_error": ((*dims, "parameter"), error)},
        {
            "candidate_amplitude": levels,
            "direction": ["forward", "backward"],
            "frequency": grid,
            "parameter": keys,
        },
    )
    data.attrs["findings"] = "\n".join(_described(data, result, shaken))
    return describe(
        data,
        "vibroimpact.next_test",
        {**rig_parameters(rig, "frequency"), "test": name, "noise": share},
    )


def _axes(covariance: Array) -> Array:
    """Return the axes of the covariance: columns whose outer products add up to it."""
    error = np.sqrt(np.diag(covariance))
    size, axes = np.linalg.eigh(covariance / np.outer(error, error))
    scaled_axes: Array = error[:, np.newaxis] * axes * np.sqrt(np.maximum(size, 0.0))
    return scaled_axes


def _slopes(
    rig: Rig, keys: list[str], test: str, grid: Array, axes: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """Compute changes of both log excursions by one deviation along each axis of the covariance.

    Returns
    -------
    slopes, known
        Changes by direction, frequency, excursion and axis; and whether no jump is passed and all
        motions settle.
    """
    own = [
        (row, parameter(bare, rig))
        for row, (bare, _, whose) in enumerate(key.partition("[") for key in keys)
        if bare not in SENSORS and (not whose or whose == f"{test}]")
    ]
    now = np.array([of.read(rig) for _, of in own])
    size = np.array([size_of(of.quantity, rig) for _, of in own])
    most = np.where(np.abs(now) < NEAR_ZERO * size, size, _MOST * np.abs(now))
    here = _swept(rig, grid)
    slopes = np.zeros((2, len(grid), 2, axes.shape[1]))
    known = here[1]
    for column, axis in enumerate(axes.T):
        along = axis[[row for row, _ in own]]
        if not along.any():
            continue
        part = float(min(1.0, np.min(most / np.maximum(np.abs(along), 1e-300))))
        ends = []
        for sign in (1.0, -1.0):
            numbers = {
                of.name: max(float(value), -np.inf if of.least is None else of.least)
                for (_, of), value in zip(own, now + sign * part * along, strict=True)
            }
            ends.append(_swept(set_values(rig, numbers), grid))
        (above, settled), (below, also) = ends
        slopes[..., column] = (above - below) / (2.0 * part)
        bent = np.abs(above + below - 2.0 * here[0]) + np.abs(above - below)
        known = known & settled & also & (bent.max(axis=-1) < _WILD)
    return slopes, known


def _far_from_jumps(rig: Rig, grid: Array, margin: float) -> NDArray[np.bool_]:
    """Return where a sweep can continue by a share of its frequency without a jump."""
    stepped = SteppedRig(rig)
    clear = np.ones((2, len(grid)), dtype=bool)
    for row, sign in enumerate((1.0, -1.0)):
        ahead = [grid * (1.0 + sign * margin * part) for part in (0.0, 0.5, 1.0)]
        path = np.unique(np.concatenate(ahead))[:: int(sign)]
        wild = np.abs(np.diff(sizes(stepped.sweep(path)[0]), axis=0)).max(axis=1) > _WILD
        for step in np.flatnonzero(wild):
            first, second = sorted((path[step], path[step + 1]))
            clear[row] &= (np.maximum(ahead[0], ahead[2]) <= first) | (
                np.minimum(ahead[0], ahead[2]) >= second
            )
    return clear


def _swept(rig: Rig, grid: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Compute log excursions by direction and frequency, and where the motion settled."""
    stepped = SteppedRig(rig)
    rows = np.stack([stepped.sweep(grid)[0], stepped.sweep(grid[::-1])[0][::-1]])
    return sizes(rows), HoldRows(rows).period > 0


def _first_least(values: Array) -> tuple[int, ...]:
    """Return the position of the least value; the first one of those that differ by rounding only.

    Forward and backward sweeps often reach the same motion.
    """
    least = float(np.nanmin(values))
    near = np.argwhere(values <= least + _TIE * abs(least))
    return tuple(int(i) for i in near[0])


def _described(data: xr.Dataset, result: xr.Dataset, shaken: Repeated) -> list[str]:
    """Describe the best hold for each of the most uncertain parameters, and for all."""
    lines = []
    relative = result["standard_error"].values / np.maximum(
        np.abs(result["fitted_value"].values), 1e-300
    )
    worst = int(np.argmax(relative))
    key = str(result["parameter"].values[worst])
    for what, of in (
        (key, data["remaining_error"].isel(parameter=worst)),
        ("", -data["information"]),
    ):
        if not np.isfinite(of.values).any():
            continue
        best = of.isel(dict(zip(of.dims, _first_least(of.values), strict=True)))
        amplitude = pretty(float(best["candidate_amplitude"]), shaken.quantity, 3)
        at = forcing(float(best["frequency"]), 3)
        where = f"a measurement at {at} ({best['direction'].item()}), {amplitude}"
        if what and float(best) > _LITTLE:
            lines.append(
                "next test: no measurement with a stepped sine would add much information; "
                f"{where}, would reduce the standard error of {what} to "
                f"{100.0 * float(best):.1f} % of its current value"
            )
            break
        if what:
            lines.append(
                f"next test: {where}, would reduce the standard error of {what} to "
                f"{100.0 * float(best):.0f} % of its current value"
            )
        else:
            lines.append(
                f"next test: {where}, would be the most informative about all parameters together"
            )
    return lines
