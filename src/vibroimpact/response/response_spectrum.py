"""Response spectra of records: the largest responses of linear oscillators."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from vibroimpact.arguments import check_list, is_list
from vibroimpact.datasets.description import describe
from vibroimpact.engine import spectra
from vibroimpact.errors import InputError, shown
from vibroimpact.model import Record
from vibroimpact.model.public import public
from vibroimpact.response.record_dataset import record_parameters
from vibroimpact.tasks.threads import Progress, Tally, available, each

DIRECTIONS = 180
"""Directions of a pair of components: every degree of half a turn."""

_LEAST, _MOST = 1e-9, 1e9
"""Accepted natural periods (s): far beyond any use, and within the range of numbers."""

_Array = NDArray[np.float64]


@public
def response_spectrum(
    record: Record | Sequence[Record],
    periods: ArrayLike,
    damping: ArrayLike = 0.05,
    *,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute the response spectra of a record, or of two perpendicular components.

    Each oscillator ü + 2ζω u̇ + ω² u = −A_t starts from rest. The spectra are the largest absolute
    values of its relative displacement u, of its relative velocity u̇ and of its absolute
    acceleration ü + A_t. The record is linear between its samples and 0 after the last one. For
    such a record the spectra are exact: they include peaks between the samples, and peaks in the
    free vibration after the record (docs/theory.md, section 17).

    Parameters
    ----------
    record
        A `Record`, or a pair of records: two perpendicular components with the same step and
        length.
    periods
        One or several natural periods (s), at least 0. At the period 0 the mass moves with the
        base.
    damping
        One or several damping ratios ζ, at least 0 and less than 1.
    progress
        A `progress_bar`, or a function that is called with the completed and the total number of
        oscillators.

    Returns
    -------
    xarray.Dataset
        The dims are ``damping_ratio`` and ``natural_period`` (s). If one of them is a single
        number, it is not a dim. The variables are ``spectral_displacement`` (m),
        ``spectral_velocity`` (m/s), ``spectral_acceleration`` (m/s²), ``pseudo_velocity`` ω max|u|
        (m/s) and ``pseudo_acceleration`` ω² max|u| (m/s²).

        For two components there is an additional first dim ``orientation``. ``"first"`` and
        ``"second"`` are the two components. For ``"RotD50"`` and ``"RotD100"`` the maxima are
        computed in 180 directions, in steps of one degree: ``"RotD50"`` is their median, and
        ``"RotD100"`` the largest of them.

    Raises
    ------
    InputError
        If ``record`` is not a record, if the components differ in step or length, or if a period or
        a damping ratio is invalid.
    """
    components = _components(record)
    period = _numbers(periods, "periods", _LEAST, _MOST, "periods of 0 s, or from 1e-9 to 1e9 s")
    ratio = _numbers(damping, "damping", 0.0, 1.0, "damping ratios from 0 to less than 1")
    moving = period.ravel() > 0.0
    omega = math.tau / np.tile(period.ravel()[moving], ratio.size)
    zeta = np.repeat(ratio.ravel(), int(moving.sum()))
    values = np.zeros((len(_turned(components)), 3, ratio.size, period.size))
    maxima = _maxima(components, omega, zeta, progress)
    values[..., moving] = maxima.reshape(*maxima.shape[:2], ratio.size, -1)
    peaks = np.array([one.peak for one in _turned(components)])
    values[:, spectra.ACCELERATION][..., ~moving] = peaks[:, np.newaxis, np.newaxis]
    if len(components) == 2:
        values = np.stack(
            [values[0], values[DIRECTIONS // 2], np.median(values, axis=0), values.max(axis=0)]
        )
    shape = (len(values), 3, *ratio.shape, *period.shape)
    return _dataset(components, period, ratio, values.reshape(shape))


def _turned(components: Sequence[Record]) -> list[Record]:
    """Return the record in each direction: its own, or 180 directions of two components."""
    if len(components) == 1:
        return list(components)
    first, second = (one.acceleration for one in components)
    angles = np.arange(DIRECTIONS) * (math.pi / DIRECTIONS)
    step = components[0].step
    return [Record(math.cos(at) * first + math.sin(at) * second, step) for at in angles]


def _maxima(
    components: Sequence[Record], omega: _Array, zeta: _Array, progress: Progress | None
) -> _Array:
    """Compute the largest |u|, |u̇|/ω and |ü + A_t|/ω² (m): direction, quantity, oscillator."""
    records = _turned(components)
    out = np.empty((len(records), omega.size, spectra.FOUND))
    # Periods are dealt out in turn: short ones take longer.
    parts = max(1, available() // len(records))
    tasks = [(n, slice(part, None, parts)) for n in range(len(records)) for part in range(parts)]
    spectra.respond.prepare()

    def task(part: tuple[int, slice], tally: Tally) -> _Array:
        n, some = part
        mine = np.empty((omega[some].size, spectra.FOUND))
        one = records[n]
        spectra.respond(
            np.array(one.acceleration),  # which is not to be written to: another type
            one.step,
            np.ascontiguousarray(omega[some]),
            np.ascontiguousarray(zeta[some]),
            tally,
            mine,
        )
        return mine

    done = each(task, tasks, steps=len(records) * omega.size, progress=progress)
    for (n, some), mine in zip(tasks, done, strict=True):
        out[n, some] = mine
    return np.moveaxis(out, 2, 1)


def _dataset(
    components: Sequence[Record], period: _Array, ratio: _Array, values: _Array
) -> xr.Dataset:
    """Return a dataset with names and units; `values` in m, except the acceleration at period 0."""
    dims = ["orientation"] if len(components) == 2 else []
    dims += ["damping_ratio"] * ratio.ndim + ["natural_period"] * period.ndim
    if len(components) == 1:
        values = values[0]
        u, v, q = (values[what] for what in range(spectra.FOUND))
    else:
        u, v, q = (values[:, what] for what in range(spectra.FOUND))
    still = period == 0.0
    omega = np.where(still, 0.0, math.tau / np.where(still, 1.0, period))
    data = xr.Dataset(
        {
            "spectral_displacement": (dims, u),
            "spectral_velocity": (dims, omega * v),
            "spectral_acceleration": (dims, np.where(still, q, omega**2 * q)),
            "pseudo_velocity": (dims, omega * u),
            "pseudo_acceleration": (dims, np.where(still, q, omega**2 * u)),
        },
        {
            "natural_period": (["natural_period"] * period.ndim, period),
            "damping_ratio": (["damping_ratio"] * ratio.ndim, ratio),
        },
    )
    if len(components) == 2:
        data.coords["orientation"] = ["first", "second", "RotD50", "RotD100"]
    parameters = {"record": [record_parameters(one) for one in components]}
    notes = dict.fromkeys(note for one in components for note in one.about.notes)
    return describe(data, "vibroimpact.response_spectrum", parameters, notes)


def _components(record: Any) -> tuple[Record, ...]:
    """Read one record, or two matching components."""
    if isinstance(record, Mapping):
        raise InputError(
            "record: a mapping of records; call response_spectrum for each of them, such as "
            "{name: response_spectrum(one, periods) for name, one in records.items()}"
        )
    records = tuple(record) if isinstance(record, list | tuple) else (record,)
    if not 1 <= len(records) <= 2 or not all(isinstance(one, Record) for one in records):
        raise InputError(
            f"record: {shown(record)} is not a Record; pass one Record, or two of them for "
            "perpendicular components"
        )
    first, last = records[0], records[-1]
    if first.step != last.step:
        raise InputError(
            f"record: the two components have time steps of {first.step:g} s and {last.step:g} s; "
            "pass components with equal time steps"
        )
    counts = len(first.acceleration), len(last.acceleration)
    if counts[0] != counts[1]:
        raise InputError(
            f"record: the two components have {counts[0]} and {counts[1]} samples; shorten the "
            "longer one with Record.cut"
        )
    return records


def _numbers(values: ArrayLike, field: str, least: float, below: float, accepted: str) -> _Array:
    """Read one number or a list of numbers that are 0 or at least `least`."""
    listed = check_list(values, field) if is_list(values) else values
    try:
        numbers = np.asarray(listed, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{field}: {shown(values)}; pass {accepted}") from None
    if numbers.ndim > 1 or numbers.size == 0:
        raise InputError(
            f"{field}: {shown(values)}; pass one value, or a list of at least one value (no lists "
            "in this list)"
        )
    for one in numbers.ravel():
        if not (one == 0.0 or least <= one < below):
            raise InputError(f"{field}: {one:g}; pass {accepted}")
    return numbers
