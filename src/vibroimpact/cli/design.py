"""``vibroimpact design``: which gap and which stops, in words, figures and files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Group, Parameter

from vibroimpact.cli.options import (
    COMPUTATION,
    FileName,
    OutputOptions,
    RecordOptions,
    RigName,
    RigOptions,
    Where,
    Whole,
)
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import Record

_DESIGN = Group("Design", sort_key=1)
_TEXT = Parameter(group=_DESIGN, allow_leading_hyphen=True)
_PAIRS = Parameter(group=_DESIGN, allow_leading_hyphen=True, negative="")
_NODES = 15


def design(
    rig: RigName,
    /,
    *records: Annotated[
        FileName,
        Parameter(
            name="RECORD",
            help="Files of records; none for those of the study, or for sines of its amplitude.",
        ),
    ],
    vary: Annotated[
        tuple[tuple[str, str], ...],
        _PAIRS,
        Parameter(
            show_default=False,
            help=(
                "Parameter and range, NAME LOW:HIGH[:log][:VALUES], 15 values if none are given; "
                "once or twice. Such as gap, bumper-stiffness (keeps the damping), "
                "stiffness-at-restitution, bumper-damping, isolator-period, damping-ratio, "
                "yield-force."
            ),
        ),
    ] = (),
    best: Annotated[
        bool,
        Parameter(
            group=_DESIGN,
            negative="",
            show_default=False,
            help="Search the bumper with the least acceleration for the gap, too.",
        ),
    ] = False,
    limit: Annotated[
        tuple[tuple[str, str], ...],
        _PAIRS,
        Parameter(
            show_default=False,
            help=(
                "What no design may exceed: peak-force, penetration or peak-displacement, with "
                "a value, such as 5MN."
            ),
        ),
    ] = (),
    fractile: Annotated[
        str | None, _TEXT, Parameter(help="Share of the records that count; 1, all of them.")
    ] = None,
    scale: Annotated[
        str | None,
        _TEXT,
        Parameter(help="Number that records are multiplied by; one for all, or one for each."),
    ] = None,
    peak: Annotated[
        str | None,
        _TEXT,
        Parameter(help="The records' peak instead, such as 0.3g; one for all, or one for each."),
    ] = None,
    start: Annotated[
        str | None, _TEXT, Parameter(name="--from", help="Lowest frequency of sines.")
    ] = None,
    to: Annotated[str | None, _TEXT, Parameter(help="Highest frequency of sines.")] = None,
    reading: RecordOptions | None = None,
    changes: RigOptions | None = None,
    threads: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="How many are computed at once; one a processor."),
    ] = None,
    where: Where = "threads",
    output: OutputOptions | None = None,
) -> int:
    """Say which gap is needed to hit nothing, and chart displacement against acceleration.

    Under records, or under sines of any frequency swept up and down. Writes NAME-design.nc and .csv
    with a row a design, NAME-design.png (over one or two parameters) and NAME-pareto.png, the
    designs that no other one beats. Limits hold for these, and for the search.

    For example:

        vibroimpact design building.toml
        vibroimpact design building.toml a.AT2 b.AT2 --vary gap 100mm:500mm
        vibroimpact design building.toml --vary gap 100mm:500mm --vary damping-ratio 0.05:0.3
        vibroimpact design building.toml --best --gap 250mm --limit penetration 50mm
    """
    from vibroimpact.cli.earthquake import listed
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject

    out = output or OutputOptions()
    found = (reading or RecordOptions()).read(records or listed(rig))
    what = subject(rig, changes or RigOptions(), out.name, shaken=next(iter(found.values()), None))
    suite = _records(what, found, scale, peak)
    designed = what.oscillator if suite else what.rig
    table = what.study.design if what.study else None
    share = fractile if fractile is not None else (table and table.fractile)
    asked: dict[str, Any] = {
        "fractile": 1.0 if share is None else _share(share),
        "threads": threads,
        "where": where,
        "frequency_span": _frequencies(what, start, to) if not found else None,
    }
    ranges = _ranges(what, vary or tuple(((table and table.vary) or {}).items()))
    limits: dict[str, Any] = {**((table and table.limits) or {}), **dict(limit)}

    from vibroimpact.design.design_chart import design_chart as chart
    from vibroimpact.design.least_acceleration import least_acceleration
    from vibroimpact.design.required_gap import required_gap

    with output_folder(out.output) as folder:
        from rich.console import Group as Together

        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.facts import design
        from vibroimpact.figures import design_chart, pareto_front, save_figure

        stem = f"{what.slug}-design"
        files: dict[str, Path] = {}
        with progress_bar("computing") as progress:
            gap = required_gap(designed, records=suite, **asked)
            values = ranges or _usual(what, float(gap["required_gap"]))
            data = chart(designed, values, records=suite, limits=limits, **asked, progress=progress)
            least = (
                least_acceleration(
                    designed, records=suite, limits=limits, **asked, progress=progress
                )
                if best
                else None
            )
        files["data"] = save(data, folder / f"{stem}.nc")
        files["table"] = save(data, folder / f"{stem}.csv")
        if data["pareto"].ndim <= 2 and min(data["pareto"].shape) > 1:
            panels = design_chart(data, title=what.title)
            files["chart"] = save_figure(panels, folder / f"{stem}.{out.figure}")
        front = pareto_front(data, title=what.title)
        files["front"] = save_figure(front, folder / f"{what.slug}-pareto.{out.figure}")
    chosen = changes is not None and any((changes.gap, changes.right_gap, changes.left_gap))
    about = summary.rig_facts(what)
    about.pop("record", None)
    tell(
        Together(
            summary.rig_text(what, shaking=not found),
            *design.text(what.oscillator, gap, data, least, list(found), chosen=chosen),
        ),
        {**about, **design.facts(gap, data, least)},
        folder,
        files,
        out.json,
    )
    return 0


def _records(what: Subject, found: dict[str, Record], scale: str | None, peak: str | None) -> Any:
    from vibroimpact.cli.earthquake import record_of_study, scaled_records
    from vibroimpact.model import Record

    records = found or (record_of_study(what) if isinstance(what.shaking, Record) else {})
    if not records:
        for option, value in (("--scale", scale), ("--peak", peak)):
            if value is not None:
                raise InputError(f"{option}: {value!r}, but no record is given; --amplitude is")
        return None
    found.update(records)
    return scaled_records(records, scale, peak)


def _share(value: Any) -> float:
    from vibroimpact.model import to_si
    from vibroimpact.model.quantities import DIMENSIONLESS

    return to_si(value, DIMENSIONLESS, "--fractile", minimum=0.0, maximum=1.0)


def _frequencies(what: Subject, start: str | None, to: str | None) -> tuple[Any, Any] | None:
    """The range of sines that options or the study say; None if neither does."""
    table = what.study.sweep if what.study else None
    low = start if start is not None else (table and table.start)
    high = to if to is not None else (table and table.to)
    if low is None and high is None:
        return None
    if low is None or high is None:
        which = "--from" if low is None else "--to"
        raise InputError(f"{which}: missing; the lowest and the highest frequency are accepted")
    return low, high


def _ranges(what: Subject, pairs: tuple[tuple[str, str], ...]) -> dict[str, list[float]]:
    from vibroimpact.cli.ranges import spread
    from vibroimpact.model.parameters import parameter

    found = {}
    for name, text in pairs:
        varied = parameter(name, "--vary").of(what.oscillator)
        found[varied.name], _ = spread("--vary", varied, text, _NODES)
    return found


def _usual(what: Subject, need: float) -> dict[str, list[float]]:
    """What is varied if nobody says it: gaps up to the required one, and bumpers' stiffness."""
    from vibroimpact.model import Bumper

    stops = what.oscillator.stops
    if not stops:
        raise InputError("--vary: missing; it is needed for a rig without stops")
    gaps = [need * (i + 1) / 12.0 for i in range(14)]
    if not all(isinstance(stop, Bumper) for stop in stops):
        return {"gap": gaps}
    middle = max(stop.stiffness for stop in stops if isinstance(stop, Bumper))
    return {"gap": gaps, "bumper_stiffness": [middle * 10.0 ** (i / 6.0) for i in range(-6, 7)]}
