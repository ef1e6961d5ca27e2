"""What a rig is sized for: sines over a range of frequencies, or a suite of records."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import excitation_parameters
from vibroimpact.design.worst_sine import Sines
from vibroimpact.earthquakes.peak_demands import ScaledRecord, peaks
from vibroimpact.earthquakes.run_plan import digest, in_words, suite
from vibroimpact.earthquakes.suites import UNSTABLE, quantiles
from vibroimpact.engine.status import Status
from vibroimpact.errors import InputError
from vibroimpact.model import Record
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.parameter_ranges import field_of
from vibroimpact.model.quantities import FREQUENCY
from vibroimpact.model.quantity_lists import read_span
from vibroimpact.model.read_rig import as_rig_of_any_masses
from vibroimpact.model.rig import with_stated_units
from vibroimpact.model.system import System
from vibroimpact.response.engine_system import engine_system
from vibroimpact.response.record_dataset import record_notes
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.tasks.threads import Progress, Workers

_Array = NDArray[np.float64]

AnyRecords: TypeAlias = Record | Sequence[Record] | Mapping[str, Record]
"""One record or several."""

PEAKS = (
    "peak_displacement",
    "displacement_max",
    "displacement_min",
    "peak_acceleration",
    "peak_force",
    "penetration",
)
"""Results of each rig, in m, m/s² and N; those of stops have both sides as a further axis."""


class Asked(Protocol):
    """What a rig is sized for."""

    def peaks(
        self, rigs: Sequence[System], workers: Workers, progress: Progress | None
    ) -> dict[str, NDArray[Any]]:
        """`PEAKS` of each rig, ``hitting``, ``status`` and what else is known of it."""

    def parameters(self) -> dict[str, Any]:
        """What it is, for a dataset's attributes."""


class BySines(NamedTuple):
    """The worst of sines, swept both ways."""

    sines: Sines

    def peaks(
        self, rigs: Sequence[System], workers: Workers, progress: Progress | None
    ) -> dict[str, NDArray[Any]]:
        """Of each rig the largest over all frequencies."""
        worst = self.sines.worst(rigs, workers, progress)
        right, left = (np.array([getattr(one, side) for one in worst]) for side in SIDES)
        return {
            "peak_displacement": np.maximum(right, left),
            "displacement_max": right,
            "displacement_min": 0.0 - left,
            "peak_acceleration": np.array([one.acceleration for one in worst]),
            "peak_force": np.array([one.force for one in worst]),
            **_penetration(rigs, right, left),
            "hitting": np.array([float(one.hits) for one in worst]),
            "displacement_frequency": np.array([one.displacement_frequency for one in worst]),
            "acceleration_frequency": np.array([one.acceleration_frequency for one in worst]),
            "unsettled_count": np.array([one.unsettled for one in worst], dtype=np.int64),
            "status": np.array([one.status for one in worst], dtype=np.int64),
        }

    def notes(self) -> list[str]:
        """None of sines."""
        return []

    def parameters(self) -> dict[str, Any]:
        """The sine, and the range."""
        return {
            **excitation_parameters(self.sines.shaken, "frequency"),
            "frequencies": [self.sines.low, self.sines.high],
            "step": self.sines.step,
        }


class ByRecords(NamedTuple):
    """A fractile over records, each from rest."""

    records: dict[str, Record]
    fractile: float
    """Share of the records below; 1 for the largest of all."""
    tail: float | None

    def notes(self) -> list[str]:
        """What was noted of the records."""
        return record_notes(self.records)

    def runs(
        self, rigs: Sequence[System], workers: Workers, progress: Progress | None
    ) -> dict[str, NDArray[Any]]:
        """Of each record and rig, as arrays (record, rig)."""
        records = list(self.records.values())
        peak_values = peaks(
            [ScaledRecord(rig, record, np.ones(1)) for record in records for rig in rigs],
            tail=self.tail,
            threads=workers,
            progress=progress,
        )
        values: dict[str, NDArray[Any]] = {
            name: v.reshape(len(records), len(rigs), *v.shape[2:])
            for name, v in peak_values.items()
        }
        beyond = np.isin(values["status"], UNSTABLE)
        for name in set(values) - {"status"}:
            values[name][beyond] = -np.inf if name == "displacement_min" else np.inf
        return values

    def peaks(
        self, rigs: Sequence[System], workers: Workers, progress: Progress | None
    ) -> dict[str, NDArray[Any]]:
        """Of each rig the fractile over the records."""
        runs = self.runs(rigs, workers, progress)
        right, left = runs["displacement_max"], 0.0 - runs["displacement_min"]
        force = runs["peak_force"]
        every = {
            "peak_displacement": np.maximum(right, left),
            "displacement_max": right,
            "displacement_min": left,
            "peak_acceleration": runs["peak_acceleration"],
            "peak_force": force,
            **_penetration(rigs, right, left),
            **({"peak_drift": runs["peak_drift"]} if "peak_drift" in runs else {}),
        }
        status = runs["status"]
        bad = (status != Status.DONE) & ~np.isin(status, UNSTABLE)
        given_up = bad.any(axis=0)
        fractiles: dict[str, NDArray[Any]] = {}
        for name, values in every.items():
            (known,) = quantiles(np.nan_to_num(values, nan=0.0), [self.fractile], 0)
            fractiles[name] = np.where(given_up[(..., *[None] * (known.ndim - 1))], np.nan, known)
        fractiles["displacement_min"] = 0.0 - fractiles["displacement_min"]
        fractiles["hitting"] = np.where(given_up, np.nan, (force > 0.0).any(axis=-1).mean(axis=0))
        worst = np.where(given_up, np.where(bad, status, 0).max(axis=0), status.max(axis=0))
        fractiles["status"] = worst.astype(np.int64)
        return fractiles

    def parameters(self) -> dict[str, Any]:
        """The records, and the fractile."""
        return {
            "records": {name: digest(one) for name, one in self.records.items()},
            "fractile": self.fractile,
            "tail": self.tail,
        }


def fractile_of(data: xr.Dataset) -> float | None:
    """The fractile of a dataset of sizes; None where all records count, or there is one, or sines.

    Of one record, or of all of them, the fractile is the value itself and needs no word.
    """
    about = json.loads(data.attrs.get("parameters", "{}"))
    share = float(about.get("fractile", 1.0))
    return share if share < 1.0 and len(about["records"]) > 1 else None


def _penetration(rigs: Sequence[System], right: _Array, left: _Array) -> dict[str, _Array]:
    """How far the mass goes beyond a gap (m), 0 where it does not; nothing of an assembly."""
    if any(rig.by_mass for rig in rigs):
        return {}
    gaps = np.array(
        [
            [rig.stop_laws[side].gap if side in rig.stops else np.inf for side in SIDES]
            for rig in rigs
        ]
    ).reshape(-1, 2)
    with np.errstate(invalid="ignore"):
        depth: _Array = np.maximum(np.maximum(right - gaps[:, 0], left - gaps[:, 1]), 0.0)
    return {"penetration": depth}


def design_system(
    rig: Any,
    records: Any,
    frequencies: object,
    *,
    fractile: float,
    step: float,
    tail: Any,
) -> tuple[System, BySines | ByRecords]:
    """Read the system of a design, and what it is designed for.

    ``frequencies`` is the range of the sines as the caller passed it, or None.

    Raises
    ------
    InputError
        If it cannot be used.
    """
    checked_rig = as_rig_of_any_masses(rig, oscillator_alone=records is not None)
    engine_system(checked_rig.system).check_size()
    if records is None and isinstance(checked_rig.shaking, Record):
        records = checked_rig.shaking
    if records is not None:
        if frequencies is not None:
            raise InputError(
                "vary: 'frequency' depends on the shaking, which is a record; remove it"
            )
        by_records = ByRecords(suite(records), fractile, tail)
        return with_stated_units(checked_rig.system, in_words(by_records.records)), by_records
    shaken = checked_rig if checked_rig.system.by_mass else one_sine(checked_rig)
    low, high = read_frequencies(frequencies)
    return checked_rig.system, BySines(Sines(shaken.sine, low, high, step))


def split_frequency(vary: object) -> tuple[Any, object]:
    """Return what is varied without the frequency, and the range of the frequency or None.

    What is not a mapping has no frequency; it is refused where it is read.
    """
    if not isinstance(vary, Mapping) or "frequency" not in vary:
        return vary, None
    return {name: one for name, one in vary.items() if name != "frequency"}, vary["frequency"]


def read_frequencies(frequencies: object) -> tuple[float, float] | tuple[None, None]:
    """Read the lowest and the highest frequency (Hz); None for 0 and infinity."""
    if frequencies is None:
        return None, None
    return read_span(frequencies, FREQUENCY, field_of("frequency"), "frequency", above=0.0)
