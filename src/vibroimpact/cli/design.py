"""``vibroimpact design``: the required gap, and charts of designs of gaps and stops."""

from __future__ import annotations

from typing import Annotated, Any

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.records import (
    AS_STATED,
    Peak,
    RecordOptions,
    Scale,
    records_of_design,
    records_or_sines,
)
from vibroimpact.cli.vary import Vary, read_vary, split_sines

_VALUES = 15
"""Default number of values of a parameter."""


@calls("design_chart", "Design", limit="limits")
def design(
    rig: opt.RigName,
    /,
    *records: Annotated[opt.FileName, Parameter(name="RECORD")],
    vary: Vary = (),
    best: opt.Flag = False,
    limit: opt.Pairs = (),
    fractile: opt.Text = None,
    scale: Scale = None,
    peak: Peak = None,
    reading: RecordOptions = AS_STATED,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    threads: opt.Threads = None,
    where: opt.Where = "threads",
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Compute the smallest gap at which a rig hits no stop, and compare designs of gaps and stops.

    A design is a combination of values of one or two parameters (--vary). The rig is shaken by
    earthquake records, or by a sine whose frequency is swept up and down. For each design, the
    command computes the largest displacement, acceleration and contact force. It writes these files
    (--name sets NAME):

    - NAME-design.nc and NAME-design.csv: the results of all designs. In the CSV file, each row is a
      design.
    - NAME-design.png: the results over the one or two parameters that are varied
    - NAME-pareto.png: the Pareto front of displacement and acceleration. It contains each design
      for which no other design is better in both quantities.

    A design that exceeds a limit (--limit) is excluded from the Pareto front and from the search
    for the best bumper (--best).

    For a rig of several masses (table [assembly] of a study file), the required gap of each stop is
    printed, and designs are compared by the largest values of all masses. The path gap varies all
    gaps, stops.NAME.gap that of one stop.

    For example:

        vibroimpact design building.toml
        vibroimpact design building.toml a.AT2 b.AT2 --vary gap=100mm:500mm
        vibroimpact design building.toml --vary gap=100mm:500mm --vary damping_ratio=0.05:0.3
        vibroimpact design building.toml --best --gap 250mm --limit penetration 50mm

    Parameters
    ----------
    records
        Files of earthquake records. For the formats, see vibroimpact record. Default: the records
        in the study file. If it has none, the rig is shaken by sines. Their amplitude is the value
        of --amplitude or, by default, the value in the laboratory case or study file.
    vary
        Parameter that is varied and its range, PATH=LOW:HIGH, such as gap=100mm:500mm. The option
        may be repeated. The range has 15 evenly spaced values. To change the number or
        the spacing, write LOW:HIGH:NUMBER, LOW:HIGH:log or LOW:HIGH:log:NUMBER (log: logarithmic
        spacing). Examples of paths: gap, stops.stiffness (at constant damping),
        stiffness_at_restitution (stiffness of the bumpers at constant coefficient of restitution),
        stops.damping, isolator_period, damping_ratio, isolator.yield_force. Default:
        the parameters in the study file (table [design]). If the file states none, the gap is
        varied. Its largest value is then slightly larger than the smallest gap at which the rig
        hits no stop. If all stops are linear bumpers, their stiffness is varied, too.
        frequency=LOW:HIGH is the range of the sines, of which the largest response counts. Default:
        from and to of the study file (table [sweep]), or a range around the primary resonance of
        each design.
    best
        Also search for the bumper that gives the smallest acceleration of the mass. The search does
        not change the gap of the rig.
    limit
        Quantity and the value that it must not exceed, such as peak-force 5MN. The quantities are
        peak-force, penetration (into a stop) and peak-displacement; of several masses also
        peak-drift (records), and each of them of one part, such as peak-drift.storey_1. The option
        may be repeated.
        These limits are added to the limits in the study file (table [design]). Default: only the
        limits in the study file.
    fractile
        Fractile of the response over the records: the share of the records, from 0 to 1, whose
        response is below the reported value. With 1, the largest response is reported. Default: the
        value in the study file (table [design]), or 1.
    """
    from vibroimpact.cli.frequency_grid import default_range, sine_span
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.cli.study import DesignTable
    from vibroimpact.design.limits import underscored
    from vibroimpact.design.usual_ranges import usual_ranges
    from vibroimpact.facts import design as facts
    from vibroimpact.facts import rig as rig_facts

    named_records = reading.read(records or records_of_design(rig))
    first = next(iter(named_records.values()), None)
    what = subject(rig, changes, output.name, shaken=first, masses=True)
    several = what.system.by_mass
    what.refuse_of_masses(best=best)
    suite = records_or_sines(what, named_records, scale, peak)
    table = what.study.design if what.study else DesignTable()
    chosen_ranges, sines = split_sines(read_vary(what, vary))
    of_study, sines_of_study = split_sines(read_vary(what, table.vary or {}))
    ranges = {one.name: one.values(_VALUES) for one in chosen_ranges or of_study}
    limits: dict[str, Any] = {underscored(name): v for name, v in (table.limits or {}).items()}
    limits |= opt.by_name("--limit", limit)
    designed: Any = what.system if suite else what.rig
    span: Any = sines or sines_of_study or sine_span(what)
    if several and span is None:
        span = default_range(what)[:2]
    frequency = {} if span is None or (suite and not sines) else {"frequency": span}
    options: dict[str, Any] = {
        **opt.stated(fractile=table.fractile if fractile is None else fractile),
        "records": suite,
        "threads": threads,
        "where": where,
    }
    least = None
    with results(what, output) as written:
        with written.progress("computing designs") as progress:
            gap = vi.required_gap(designed, frequency, **options)
            widest = gap["required_gap"].max() if several else gap["common_gap"]
            values = ranges or usual_ranges(what.system, float(widest))
            options |= {"limits": limits, "progress": progress}
            data = vi.design_chart(designed, {**values, **frequency}, **options)
            if best:
                least = vi.least_acceleration(designed, frequency or None, **options)
        written.files["data"] = vi.save(data, written.path("design", "nc"))
        written.files["table"] = vi.save(data, written.path("design", "csv"))
        if data["pareto"].ndim <= 2 and min(data["pareto"].shape) > 1:
            written.draw("chart", "design", figures.design_chart(data, title=what.title))
        written.draw("front", "pareto", figures.pareto_front(data, title=what.title))
    chosen = changes.gap is not None or any("gap" in one for one in changes.values)
    text = facts.text(what.system, gap, data, least, list(suite or ()), chosen=chosen)
    about = rig_facts.text(what.rig, shaking=not suite)
    return written.tell(facts.facts(gap, data, least), *text, about=about, shaking=False)
