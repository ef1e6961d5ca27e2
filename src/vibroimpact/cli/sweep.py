"""``vibroimpact sweep``: pseudo-resonance curves of a rig."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from cyclopts import Group, Parameter

from vibroimpact.cli.options import COMPUTATION, OUTPUT, OutputOptions, RigName, RigOptions, Whole

_FREQUENCIES = Group("Frequencies", sort_key=1)
_FREQUENCY = Parameter(group=_FREQUENCIES, allow_leading_hyphen=True)


def sweep(
    rig: RigName,
    /,
    *,
    start: Annotated[
        str | None,
        _FREQUENCY,
        Parameter(
            name="--from", help="First frequency; 0.45 times the natural one (of a case 0.5Hz)."
        ),
    ] = None,
    stop: Annotated[
        str | None,
        _FREQUENCY,
        Parameter(name="--to", help="Last frequency; 4.5 times the natural one (of a case 5Hz)."),
    ] = None,
    step: Annotated[
        str | None,
        _FREQUENCY,
        Parameter(
            help=(
                "Distance of two frequencies; about a hundredth of the natural one (of a case "
                "0.01Hz; the published tests: 0.1Hz)."
            )
        ),
    ] = None,
    frequencies: Annotated[
        str | None, _FREQUENCY, Parameter(help="A list instead, such as 0.5Hz,0.7Hz,1.1Hz.")
    ] = None,
    direction: Annotated[
        Literal["forward", "backward", "both"] | None,
        Parameter(group=_FREQUENCIES, help="Rising, falling, or (the default) both."),
    ] = None,
    physical: Annotated[
        bool,
        Parameter(
            group=OUTPUT,
            negative="",
            show_default=False,
            help=(
                "Draw the largest acceleration (g), displacement (mm) and contact force instead "
                "of η_a and η_d; always where free flight has no bound."
            ),
        ),
    ] = False,
    changes: RigOptions | None = None,
    threads: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="How many sweeps run at once; one a processor."),
    ] = None,
    tolerance: Annotated[
        float | None,
        Parameter(
            group=COMPUTATION,
            help="A motion is steady when it is as close as this to a periodic one; 1e-12.",
        ),
    ] = None,
    max_cycles: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="Forcing cycles to wait for a steady motion; 2000."),
    ] = None,
    output: OutputOptions | None = None,
) -> int:
    """Sweep the frequency up and down, and draw the resonance curves.

    Each frequency is held until the motion is steady, then the next one begins from the state
    and phase that were reached, as in a stepped-sine test. Prints resonances, jumps and
    hysteresis; writes NAME-sweep.nc (all data), NAME-sweep.png (the curves) and
    NAME-sweep.txt (the summary).

    For example:

        vibroimpact sweep B2-G1-A3 --parameters identified
        vibroimpact sweep B3-10mm-A3 --from 0.3Hz --to 4Hz --step 0.01Hz
        vibroimpact sweep B2-G1-A3 --left-gap 9mm --no-right --output one-sided
        vibroimpact sweep building.toml --physical --direction forward --json
    """
    from vibroimpact.cli import frequency_grid, summary
    from vibroimpact.cli.output import as_plain_text, output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import sweeps

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    table = what.study.sweep if what.study else None
    held = frequency_grid.frequencies(
        start, stop, step, frequencies, table, frequency_grid.default_range(what)
    )
    way = direction or (table and table.direction) or "both"
    options: dict[str, Any] = {
        "tolerance": tolerance if tolerance is not None else table and table.tolerance,
        "max_cycles": max_cycles if max_cycles is not None else table and table.max_cycles,
        "phase": what.study and what.study.excitation.phase,
        "threads": threads,
    }

    with output_folder(out.output) as folder:
        from rich.console import Group as Together

        from vibroimpact.datasets.files import save, write_whole
        from vibroimpact.engine.status import MORE_CYCLES
        from vibroimpact.response import resonance
        from vibroimpact.response.sweep import DIRECTIONS, advice
        from vibroimpact.response.sweep import sweep as run

        with progress_bar("sweeping") as progress:
            data = run(
                what.rig,
                held,
                DIRECTIONS if way == "both" else (way,),
                progress=progress,
                **{name: value for name, value in options.items() if value is not None},
            )
        data.attrs["title"] = what.name
        found = resonance.features(data)
        hints = [line.replace(MORE_CYCLES, "--max-cycles") for line in advice(data)]
        text = Together(summary.rig_text(what), sweeps.text(data, found, hints))

        # Imported late: whoever waits for numbers need not wait for matplotlib.
        from vibroimpact.figures import resonance_curves, save_figure

        axes = resonance_curves(data, found=found, title=what.title, physical=physical or None)
        stem = folder / f"{what.slug}-sweep"
        files = {
            "data": save(data, f"{stem}.nc"),
            "figure": save_figure(axes[0], f"{stem}.{out.figure}"),
            "summary": write_whole(f"{stem}.txt", as_plain_text(text)),
        }
    facts = {**summary.rig_facts(what), **sweeps.facts(data, found, hints)}
    tell(text, facts, folder, files, out.json)
    return 0
