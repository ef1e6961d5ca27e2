"""``vibroimpact design``: the required gap, and charts of gaps and stops."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.options import (
    AS_DESCRIBED,
    DEFAULT_OUTPUT,
    FileName,
    Flag,
    OutputOptions,
    Pairs,
    RigName,
    RigOptions,
    Text,
    Threads,
    Where,
    by_name,
    stated,
)
from vibroimpact.cli.records import (
    AS_STATED,
    Peak,
    RecordOptions,
    Scale,
    record_of_study,
    records_of_design,
    scale_records,
)
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject

_NODES = 15


@calls("design_chart", "Design", limit="limits", start="frequency_span[0]", to="frequency_span[1]")
def design(
    rig: RigName,
    /,
    *records: Annotated[FileName, Parameter(name="RECORD")],
    vary: Pairs = (),
    best: Flag = False,
    limit: Pairs = (),
    fractile: Text = None,
    scale: Scale = None,
    peak: Peak = None,
    start: Annotated[Text, Parameter(name="--from")] = None,
    to: Text = None,
    reading: RecordOptions = AS_STATED,
    changes: RigOptions = AS_DESCRIBED,
    threads: Threads = None,
    where: Where = "threads",
    output: OutputOptions = DEFAULT_OUTPUT,
) -> int:
    """Compute the gap at which a rig hits nothing, and chart displacement against acceleration.

    The rig is shaken by records, or by sines of all frequencies, swept up and down. Writes
    NAME-design.nc and .csv with a row for each design, NAME-design.png (over one or two
    parameters) and NAME-pareto.png: the designs for which no other design is better. Limits apply
    to these designs, and to the search.

    For example:

        vibroimpact design building.toml
        vibroimpact design building.toml a.AT2 b.AT2 --vary gap 100mm:500mm
        vibroimpact design building.toml --vary gap 100mm:500mm --vary damping-ratio 0.05:0.3
        vibroimpact design building.toml --best --gap 250mm --limit penetration 50mm

    Parameters
    ----------
    records
        Files of records. Default: those of the study, or sines of its amplitude.
    vary
        Parameter and its range, NAME LOW:HIGH[:log][:VALUES] (15 values unless stated); once or
        twice. Examples: gap, bumper-stiffness (at constant damping), stiffness-at-restitution,
        bumper-damping, isolator-period, damping-ratio, yield-force. Default: those of the study
        ([design]), or gaps up to the required gap, and the stiffness of linear bumpers.
    best
        Also search the bumper with the least acceleration for the gap.
    limit
        Quantity and the value that no design may exceed: peak-force, penetration or
        peak-displacement, such as peak-force 5MN; may be repeated. Added to the limits of the study
        ([design]).
    fractile
        Fractile over the records (0 to 1). Default: that of the study ([design]), or 1, the
        largest of all records.
    start
        Lowest frequency of the sines. Default: that of the study ([sweep]), or below the primary
        resonance of each design.
    to
        Highest frequency of the sines. Default: that of the study ([sweep]), or above the primary
        resonance of each design.
    """
    from vibroimpact.cli.output import progress_bar
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.cli.study import DesignTable
    from vibroimpact.design.usual_ranges import usual_ranges
    from vibroimpact.facts import design as facts
    from vibroimpact.facts import rig as rig_facts

    found = reading.read(records or records_of_design(rig))
    what = subject(rig, changes, output.name, shaken=next(iter(found.values()), None))
    suite = _records(what, found, scale, peak)
    table = what.study.design if what.study else DesignTable()
    ranges = _ranges(what, vary or tuple((table.vary or {}).items()))
    limits = {**(table.limits or {}), **by_name("--limit", limit)}
    designed = what.oscillator if suite else what.rig
    options: dict[str, Any] = {
        **stated(fractile=table.fractile if fractile is None else fractile),
        "records": suite,
        "frequency_span": None if suite else _frequencies(what, start, to),
        "threads": threads,
        "where": where,
    }
    least = None
    with results(what, output) as written:
        with progress_bar("computing") as progress:
            gap = vi.required_gap(designed, **options)
            values = ranges or usual_ranges(what.oscillator, float(gap["required_gap"]))
            options |= {"limits": limits, "progress": progress}
            data = vi.design_chart(designed, values, **options)
            if best:
                least = vi.least_acceleration(designed, **options)
        written.files["data"] = vi.save(data, written.path("design", "nc"))
        written.files["table"] = vi.save(data, written.path("design", "csv"))
        if data["pareto"].ndim <= 2 and min(data["pareto"].shape) > 1:
            written.draw("chart", "design", figures.design_chart(data, title=what.title))
        written.draw("front", "pareto", figures.pareto_front(data, title=what.title))
    chosen = any((changes.gap, changes.right_gap, changes.left_gap))
    text = facts.text(what.oscillator, gap, data, least, list(suite or ()), chosen=chosen)
    about = rig_facts.text(what.rig, shaking=not suite)
    return written.tell(facts.facts(gap, data, least), *text, about=about, shaking=False)


def _records(
    what: Subject, found: dict[str, vi.Record], scale: str | None, peak: str | None
) -> dict[str, vi.Record] | None:
    """Return the scaled records of the options or of the study; None for sines."""
    records = found or (record_of_study(what) if isinstance(what.shaking, vi.Record) else {})
    for option, value in (("--scale", scale), ("--peak", peak)):
        if value is not None and not records:
            raise InputError(f"{option}: {value!r}, but no record is given; --amplitude is")
    return scale_records(records, scale, peak) or None


def _frequencies(what: Subject, start: str | None, to: str | None) -> tuple[Any, Any] | None:
    """Return the range of the sines, of the options or the study; None if neither states it."""
    table = what.sweep_table
    low, high = table.start if start is None else start, table.to if to is None else to
    if low is None and high is None:
        return None
    if low is None or high is None:
        which = "--from" if low is None else "--to"
        raise InputError(f"{which}: missing; the lowest and the highest frequency are accepted")
    return low, high


def _ranges(what: Subject, pairs: tuple[tuple[str, str], ...]) -> dict[str, list[float]]:
    """Read the parameters that are varied, and their values."""
    from vibroimpact.cli.ranges import spread
    from vibroimpact.model.parameters import parameter

    found = {}
    for name, text in by_name("--vary", pairs).items():
        varied = parameter(name, "--vary").of(what.oscillator)
        found[varied.name], _ = spread("--vary", varied, text, _NODES)
    return found
