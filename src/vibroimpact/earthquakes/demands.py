"""Peak responses (demands) of many rigs to many scaled records, as one dataset."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from vibroimpact.arguments import check_list, is_list
from vibroimpact.datasets.description import describe
from vibroimpact.datasets.stops import each_by_stop, has_stops, shared_part_names
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.earthquakes import assembly_demands
from vibroimpact.earthquakes.intensity import Measure, measure
from vibroimpact.earthquakes.peak_demands import (
    MAX_EVENTS,
    PEAKS,
    RESIDUALS,
    ScaledRecord,
    peaks,
)
from vibroimpact.earthquakes.run_plan import (
    Block,
    Runs,
    blocks,
    chunks,
    digest,
    in_words,
    runs,
    suite,
)
from vibroimpact.engine.status import Status
from vibroimpact.errors import warn_of_result
from vibroimpact.model import Record, to_si
from vibroimpact.model.argument_types import (
    MOST_TAIL,
    MaxEvents,
    PositiveInt,
)
from vibroimpact.model.parameter_ranges import Values
from vibroimpact.model.public import public
from vibroimpact.model.quantities import TIME
from vibroimpact.model.quantity_lists import read_rising
from vibroimpact.model.read_rig import RigOrSystem
from vibroimpact.model.rig import Rig
from vibroimpact.model.system import System
from vibroimpact.model.written_units import has_no_units
from vibroimpact.response.assembly_rows import check_alike
from vibroimpact.response.plausibility import doubt_stops
from vibroimpact.response.record_dataset import record_notes
from vibroimpact.stores.zarr_store import Kind, create, finished, folder, read, write_block
from vibroimpact.stores.zarr_store import StorePart as Part
from vibroimpact.tasks.executors import THREADS, workers_for
from vibroimpact.tasks.threads import Progress, Workers

if TYPE_CHECKING:  # it takes long to load: only where a store is made
    import zarr

_Array = NDArray[np.float64]

CREATED_BY = "vibroimpact.demands"
_VALUES = (*PEAKS, *RESIDUALS)
_KIND = Kind("set of demands", CREATED_BY, frozenset({*_VALUES, "status"}))
_OF_ASSEMBLIES = Kind("set of demands", CREATED_BY, frozenset({*assembly_demands.PEAKS, "status"}))
_PENDING = -1


@public
def demands(
    rig: RigOrSystem | Mapping[str, RigOrSystem] | list[RigOrSystem],
    records: Record | Sequence[Record] | Mapping[str, Record],
    scales: ArrayLike | Sequence[str] = (1.0,),
    *,
    intensity: Literal["factor", "PGA"] | tuple[float | str, float] = "factor",
    vary: Values | None = None,
    tail: float | str | None = None,
    max_events: MaxEvents = MAX_EVENTS,
    store: Path | str | None = None,
    block: PositiveInt = 512,
    threads: int | None = None,
    where: Any = THREADS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Compute the peak responses (demands) of rigs to records at several scales.

    A run is the motion of one rig through one record at one scale. Every run starts at rest. Its
    peaks are defined as in `seismic_response`.

    Parameters
    ----------
    rig
        One rig: an `Oscillator`, an `Assembly`, a `Rig`, a published laboratory case or its code,
        or the path of a study file. Several rigs are passed as a list, or as a mapping from names
        to rigs. The records replace the shaking of the rigs.
    records
        One record, or several as a list or as a mapping from names to records. The records of a
        list are named after their files.
    scales
        Levels of shaking to which each record is scaled. They are rising numbers greater than 0, or
        strings with units, in the measure that ``intensity`` selects.
    intensity
        Measure of the scales. ``"factor"`` is the number by which a record is multiplied. ``"PGA"``
        is the peak acceleration of the record (m/s²). A pair of a natural period (s) and a damping
        ratio selects the pseudo-acceleration of the record at this period and damping (m/s²).
    vary
        Parameters that are varied, as a mapping from names to values. All combinations of the
        values are computed. Names are, for example, ``"gap"``, ``"stops.stiffness"``,
        ``"stops.restitution"``, ``"right.gap"``, ``"damping_ratio"`` and
        ``"isolator.yield_force"``. A parameter of stops is set on both sides, if the stop there has
        this parameter.
    tail
        As in `seismic_response`.
    max_events
        As in `seismic_response`.
    store
        Folder in which the demands are stored as a Zarr group. It is written block by block. If the
        folder holds an unfinished computation of the same demands, that computation is resumed.
        Default: the demands are kept in memory.
    block
        Number of rigs and number of records in a block. A block contains all scales. If the
        computation is stopped, at most the unfinished blocks are lost.
    threads
        Number of threads (default: one per processor).
    where
        ``"threads"``, ``"processes"``, or a dask cluster: a ``distributed.Client`` or the address
        of its scheduler (docs/how-to/many-machines.md). Neither ``where`` nor ``threads`` affects
        the result.
    progress
        A `progress_bar`, or a function that is called in the calling thread with the completed and
        the total number of runs.

    Returns
    -------
    xarray.Dataset
        The dims are ``record``, ``scale``, ``rig`` if there are several rigs, and one dim for each
        parameter that is varied. The variables are peaks, forces, impulses, counts and residual
        displacements, as in `seismic_response`. Forces, impulses and counts also have the dim
        ``stop``; they are NaN where a rig lacks the stop. ``status`` is 0 for each run that was
        completed. The values of other runs are NaN, and a warning reports the number of these runs.
        ``factor`` is the number by which a record was multiplied. ``intensity`` is the measure of
        the unscaled record.

        Of assemblies, which must have masses, links and stops of the same names, the variables have
        the dims ``mass``, ``link`` and ``stop``, as in `seismic_response`.

    Raises
    ------
    InputError
        If a value is invalid, or if the folder ``store`` holds another computation.
    """
    shaking = suite(records)
    rigs = runs(rig, vary, {**in_words(shaking), "scales": scales})
    scaled = measure(intensity)
    levels = _levels(scales, scaled)
    known, factors = scaled.factors(list(shaking.values()), levels)
    several = any(one.by_mass for one in rigs.rigs.values())
    if several:
        check_alike(rigs.rigs, "rig", "mass", "link", "stop")
    task = _Task(
        rigs,
        list(shaking.values()),
        factors,
        None if tail is None else to_si(tail, TIME, "tail", minimum=0.0, maximum=MOST_TAIL),
        max_events,
        workers_for(threads, where),
    )
    settings = {
        "assemblies" if several else "oscillators": {
            name: one.model_dump() for name, one in rigs.rigs.items()
        },
        "varied": {one.name: one.values.tolist() for one in rigs.varied},
        "records": {name: digest(one) for name, one in shaking.items()},
        "scales": levels.tolist(),
        "intensity": [scaled.name, scaled.period, scaled.damping],
        "tail": task.tail,
        "max_events": task.max_events,
        "block": block,
    }
    along = {
        "record": list(shaking),
        "scale": levels,
        **({"rig": list(rigs.rigs)} if rigs.several else {}),
        **{one.name: one.values for one in rigs.varied},
        "factor": (("record", "scale"), factors),
        "intensity": ("record", known),
    }
    assumed = (one.assumptions for one in rigs.rigs.values())
    notes = [*itertools.chain(*assumed), *record_notes(shaking)]
    parts = (Part(((one.number,),), one.place) for one in blocks(task.shape, block))
    with folder(store, task.kind, settings, partial(_make, task=task, most=block), parts) as group:
        if not finished(group):
            _complete(group, task, block, progress)
            group.attrs["finished"] = True
        variables = {name: read(group, _KIND.word, name) for name in (*task.values, "status")}
    dims = ("record", "scale", *rigs.dims)
    data = xr.Dataset(
        {name: ((*dims, *task.part_of(name)), values) for name, values in variables.items()},
        {**task.parts, **along},
    )
    if not several:
        notes += _doubted(rigs.rigs, next(iter(shaking.values())), data)
    return _described(data, settings, notes, rigs, scaled)


def _described(
    data: xr.Dataset, settings: dict[str, Any], notes: list[str], rigs: Runs, scaled: Measure
) -> xr.Dataset:
    """Describe the demands, and warn of runs that were given up."""
    data = describe(data, CREATED_BY, settings, notes, rigs.varied)
    for name in ("scale", "intensity"):
        data[name].attrs["long_name"] = scaled.name
        if not has_no_units(data):
            data[name].attrs["units"] = scaled.units
    warn_given_up(data["status"].values, "demands", "runs")
    return data


def _doubted(rigs: Mapping[str, System], record: Record, data: xr.Dataset) -> list[str]:
    """What is doubted of the rigs, each line once."""
    lines: dict[str, None] = {}
    for name, oscillator in rigs.items():
        own = data.sel(rig=name) if "rig" in data.dims else data
        peaks = own["peak_displacement"].values
        lines |= dict.fromkeys(doubt_stops(Rig(oscillator, record), peaks[np.isfinite(peaks)]))
    return list(lines)


class _Task(NamedTuple):
    """A computation of demands, independent of where its results are kept."""

    rigs: Runs
    records: list[Record]
    factors: _Array
    """Factor of each record at each level."""
    tail: float | None
    max_events: int
    threads: Workers

    @property
    def by_mass(self) -> bool:
        """Whether the rigs have assemblies, whose parts have the same names."""
        return next(iter(self.rigs.rigs.values())).by_mass

    @property
    def kind(self) -> Kind:
        """What a store of the results is."""
        return _OF_ASSEMBLIES if self.by_mass else _KIND

    @property
    def values(self) -> tuple[str, ...]:
        """Names of the results."""
        return assembly_demands.PEAKS if self.by_mass else _VALUES

    @property
    def parts(self) -> Mapping[str, NDArray[Any]]:
        """Names of the parts of the rigs, by dim: of oscillators the stops that one has."""
        systems = list(self.rigs.rigs.values())
        return shared_part_names(systems)

    def part_of(self, name: str) -> tuple[str, ...]:
        """Return the dim of the parts of which a result has one each, if it has one."""
        dim = VARIABLES[name].part
        return (dim,) if dim in self.parts else ()

    @property
    def shape(self) -> tuple[int, ...]:
        """Numbers of records and of rigs."""
        return (len(self.records), *self.rigs.shape)

    def block(self, one: Block, progress: Progress | None) -> dict[str, NDArray[Any]]:
        """Compute the demands of a block."""
        count = self.factors.shape[1]
        places = list(itertools.product(*(range(s.start, s.stop) for s in one.rigs)))
        chosen = range(one.records.start, one.records.stop)
        rigs = [self.rigs.system(at) for at in places]
        peak_values = peaks(
            [ScaledRecord(rig, self.records[n], self.factors[n]) for n in chosen for rig in rigs],
            tail=self.tail,
            residuals=True,
            max_events=self.max_events,
            threads=self.threads,
            progress=progress,
        )
        for name in filter(has_stops, peak_values):
            peak_values[name] = each_by_stop(
                rigs * len(chosen), peak_values[name], self.parts["stop"]
            )
        shape = (len(chosen), *(s.stop - s.start for s in one.rigs), count)
        scale = len(shape) - 1
        return {
            name: np.moveaxis(v.reshape(*shape, *v.shape[2:]), scale, 1)
            for name, v in peak_values.items()
        }


def _complete(group: zarr.Group, task: _Task, most: int, progress: Progress | None) -> None:
    """Compute the unfinished blocks."""
    ready = read(group, _KIND.word, "done")
    levels = task.factors.shape[1]
    total = levels * math.prod(task.shape)
    before = 0
    for one in blocks(task.shape, most):
        size = levels * math.prod(s.stop - s.start for s in (one.records, *one.rigs))
        if not ready[one.number]:
            report = _beyond(progress, before, total)
            write_block(group, one.place, task.block(one, report))
            group["done"][one.number] = 1  # type: ignore[index]
        before += size
        if progress:
            progress(before, total)


def _beyond(progress: Progress | None, before: int, total: int) -> Progress | None:
    """Return the progress function of a part that begins when so many runs are done."""
    return progress and (lambda done, _: progress(before + done, total))


def _make(group: zarr.Group, task: _Task, most: int) -> None:
    levels = task.factors.shape[1]
    first, *others = task.shape
    shape = (first, levels, *others)
    size, *further = chunks(task.shape, most)
    chunk = (size, levels, *further)
    dims = ("record", "scale", *task.rigs.dims)
    for name in task.values:
        dim = task.part_of(name)
        each = tuple(len(task.parts[one]) for one in dim)
        sizes = (*shape, *each), (*chunk, *(max(one, 1) for one in each))
        create(group, name, *sizes, "f8", np.nan, (*dims, *dim))
    create(group, "status", shape, chunk, "i1", _PENDING, dims)
    count = sum(1 for _ in blocks(task.shape, most))
    create(group, "done", (count,), (1,), "i1", 0, ("block",))


def _levels(scales: Any, scaled: Measure) -> _Array:
    """Read the levels of shaking, in SI units."""
    scales = check_list(scales, "scales") if is_list(scales) else [scales]
    return read_rising(scales, scaled.quantity, "scales", above=0.0)


def warn_given_up(status: NDArray[Any], who: str, what: str) -> None:
    """Warn of runs that were given up. ``what`` they are, in words."""
    for code in np.unique(status[status != Status.DONE]):
        count = int((status == code).sum())
        warn_of_result(
            f"{who}: {count} of {status.size} {what} could not be computed: "
            f"{Status(int(code)).advice}"
        )
