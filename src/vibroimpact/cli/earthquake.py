"""``vibroimpact earthquake``: what records ask of a rig, in words, figures and files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Group, Parameter

from vibroimpact.cli.options import (
    FileName,
    OutputOptions,
    RecordOptions,
    RigName,
    RigOptions,
    Whole,
    one_or_each,
    record_name,
)
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import Oscillator, Record
    from vibroimpact.tasks.threads import Progress

_MOTION = Group("Motion", sort_key=1)
_TEXT = Parameter(allow_leading_hyphen=True)

_SHORTEST, _LONGEST, _PERIODS, _DAMPING = 0.02, 5.0, 200, 0.05
"""Of the spectra that are drawn."""


def earthquake(
    rig: RigName,
    /,
    *records: Annotated[
        FileName,
        Parameter(
            name="RECORD", help="Files of records; none for the record of the study. See record."
        ),
    ],
    scale: Annotated[
        str | None,
        _TEXT,
        Parameter(
            group=_MOTION,
            help="Number that they are multiplied by; one for all, or one for each, as 0.2,0.5.",
        ),
    ] = None,
    peak: Annotated[
        str | None,
        _TEXT,
        Parameter(group=_MOTION, help="Their peak instead, such as 0.3g; one or one for each."),
    ] = None,
    tail: Annotated[
        str | None,
        _TEXT,
        Parameter(
            group=_MOTION,
            help="How long the motion is followed behind them, as 10s; two natural periods.",
        ),
    ] = None,
    samples: Annotated[
        Whole,
        Parameter(
            group=_MOTION,
            help="Samples per step of a record, of what is drawn and written; no peak depends on "
            "it, but the floor spectrum does.",
        ),
    ] = 4,
    reading: RecordOptions | None = None,
    changes: RigOptions | None = None,
    output: OutputOptions | None = None,
) -> int:
    """Shake a rig by records, and say whether it hits its stops, and how hard.

    Writes NAME-earthquake.csv with a row a record, and for each record NAME-RECORD-earthquake.png
    and .nc (groups response, motion, ground and floor, the spectra of the ground and of the mass).

    For example:

        vibroimpact earthquake B2-G1-A3 RSN763_LOMAP_GIL067.AT2 --scale 0.2
        vibroimpact earthquake wall.toml quake.AT2 other.V2 --component 1 --peak 0.3g --gap 40mm
        vibroimpact earthquake quake.toml --tail 20s
    """
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject
    from vibroimpact.model import to_si
    from vibroimpact.model.names import file_stem, literal
    from vibroimpact.model.quantities import TIME

    out = output or OutputOptions()
    found = (reading or RecordOptions()).read(records or listed(rig, beside_record=False))
    first = next(iter(found.values()), None)
    what = subject(rig, changes or RigOptions(), out.name, shaken=first)
    shaking = scaled_records(found or record_of_study(what), scale, peak)
    behind = None if tail is None else to_si(tail, TIME, "--tail", minimum=0.0)
    if samples < 1:
        raise InputError(f"--samples: {samples}; a whole number of at least 1 is accepted")

    with output_folder(out.output) as folder:
        from rich.console import Group as Together
        from rich.text import Text

        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.facts import earthquake
        from vibroimpact.figures import earthquake_page, save_figure

        files: dict[str, Path] = {}
        told: list[Any] = []
        responses: list[xr.Dataset] = []
        facts: list[dict[str, Any]] = []
        for name, record in shaking.items():
            with progress_bar("following") as progress:
                groups = _computed(what.oscillator, record, behind, samples, progress)
                free = _free(what.oscillator, record, behind, progress)
            stem = folder / f"{what.slug}-{file_stem(name)}-earthquake"
            spectra = {"ground": groups["ground"], "mass": groups["floor"]}
            title = f"{what.title}\n{literal(name)}"
            page = earthquake_page(groups["motion"], spectra, title=title)
            files[f"data of {name}"] = save(groups, f"{stem}.nc")
            files[f"figure of {name}"] = save_figure(page[0], f"{stem}.{out.figure}")
            responses.append(groups["response"])
            facts.append(earthquake.facts(name, record, groups["response"], what.oscillator, free))
            told += [
                Text(),
                earthquake.text(name, record, groups["response"], what.oscillator, free),
            ]
        table = earthquake.together(list(shaking), responses)
        files = {"table": save(table, folder / f"{what.slug}-earthquake.csv"), **files}
    about = summary.rig_facts(what)
    about.pop("record")
    tell(
        Together(summary.rig_text(what, shaking=False), *told),
        {**about, "records": facts},
        folder,
        files,
        out.json,
    )
    return 0


def listed(rig: str, *, beside_record: bool = True) -> list[str]:
    """The records of a study's design, beside its file; or none if it is shaken by one itself."""
    from vibroimpact.cli.study import read_study

    path = Path(rig)
    if path.suffix.lower() != ".toml" and not path.is_file():
        path = path.with_name(f"{path.name}.toml") if path.name else path
        if not path.is_file():
            return []
    study = read_study(path)
    if study.excitation.record is not None and not beside_record:
        return []
    return [str(path.parent / name) for name in study.design.records or []]


def record_of_study(what: Subject) -> dict[str, Record]:
    """The record that a study names.

    Raises
    ------
    InputError
        If it names none.
    """
    from vibroimpact.model import Record

    if not isinstance(what.shaking, Record):
        raise InputError(
            "RECORD: missing; the file of a record is accepted, or a study that names one"
        )
    about = what.shaking.about
    return {record_name(about.source, about.component): what.shaking}


def scaled_records(
    records: dict[str, Record], scale: str | None, peak: str | None
) -> dict[str, Record]:
    """Multiply records by a number, or give them a peak: one for all, or one for each."""
    if scale is None and peak is None:
        return records
    sizes = one_or_each("--scale", scale, len(records))
    peaks = one_or_each("--peak", peak, len(records))
    return {
        name: one.scaled(1.0 if size is None else size, peak=most)
        for (name, one), size, most in zip(records.items(), sizes, peaks, strict=True)
    }


def _computed(
    rig: Oscillator, record: Record, tail: float | None, samples: int, progress: Progress
) -> dict[str, xr.Dataset]:
    """The response, the motion, and the spectra of the ground and of the mass.

    Raises
    ------
    InputError
        If the motion was given up.
    """
    import numpy as np

    from vibroimpact.earthquakes.floor_record import floor_record
    from vibroimpact.earthquakes.free_vibration import free_tail
    from vibroimpact.earthquakes.seismic_response import seismic_response
    from vibroimpact.engine.status import Status
    from vibroimpact.model.rig import Rig
    from vibroimpact.response.response_spectrum import response_spectrum
    from vibroimpact.response.simulate import simulate

    behind = free_tail(Rig(rig, record)) if tail is None else tail
    motion = simulate(Rig(rig, record), samples=samples, tail=behind, progress=progress)
    if int(motion["status"]) != Status.DONE:
        raise InputError(f"the motion was given up ({motion.attrs['message']})")
    periods = np.geomspace(_SHORTEST, _LONGEST, _PERIODS)
    return {
        "response": seismic_response(Rig(rig, record), tail=behind, progress=progress),
        "motion": motion,
        "ground": response_spectrum(record, periods, _DAMPING),
        "floor": response_spectrum(floor_record(motion), periods, _DAMPING),
    }


def _free(
    rig: Oscillator, record: Record, tail: float | None, progress: Progress
) -> xr.Dataset | None:
    """The response without stops; None where there are none, or nothing else holds the mass."""
    from vibroimpact.earthquakes.seismic_response import seismic_response
    from vibroimpact.model.rig import Rig

    if not rig.stops:
        return None
    try:
        return seismic_response(Rig(rig.without_bumpers(), record), tail=tail, progress=progress)
    except InputError:
        return None
