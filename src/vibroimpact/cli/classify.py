"""``vibroimpact classify``: the scenario of a rig, with the evidence for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from cyclopts import Group, Parameter

from vibroimpact.cli.options import (
    COMPUTATION,
    OutputOptions,
    RigName,
    RigOptions,
    ThresholdOptions,
    Whole,
)
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject

_FREQUENCIES = Group("Frequencies", sort_key=1)
_FREQUENCY = Parameter(group=_FREQUENCIES, allow_leading_hyphen=True)


def classify(
    rig: RigName,
    /,
    *,
    start: Annotated[
        str | None,
        _FREQUENCY,
        Parameter(name="--from", help="First frequency; 0.4 times the natural one."),
    ] = None,
    stop: Annotated[
        str | None,
        _FREQUENCY,
        Parameter(name="--to", help="Last frequency; beyond where the primary resonance can lie."),
    ] = None,
    step: Annotated[
        str | None,
        _FREQUENCY,
        Parameter(help="Distance of two frequencies; a hundredth of the natural one."),
    ] = None,
    changes: RigOptions | None = None,
    thresholds: ThresholdOptions | None = None,
    threads: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="How many sweeps run at once; one a processor."),
    ] = None,
    output: OutputOptions | None = None,
) -> int:
    """Name the scenario of a rig, S0 to S6, with the evidence for it.

    Sweeps the rig forward and backward, tells what the resonance curves show, and names the
    scenario: S0 free flight, S1 grazing, S2 primary resonance with right hysteresis, S3 as S2
    with a secondary resonance, S4 secondary resonances with left hysteresis or not regular, S5
    bumpers attached and smooth, S6 bent to the right without jumps; or unclassified. Writes
    NAME-scenario.nc (the curves) and NAME-scenario.png.

    For example:

        vibroimpact classify B2-G1-A3
        vibroimpact classify B3-10mm-A3 --from 0.3Hz --to 5Hz
        vibroimpact classify B3-G1-A3 --extent 0.01
    """
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    held = _frequencies(what, start, stop, step)
    used = (thresholds or ThresholdOptions()).thresholds()

    with output_folder(out.output) as folder:
        from rich.console import Group as Together
        from rich.text import Text

        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.facts import scenario as told
        from vibroimpact.figures import resonance_curves, save_figure
        from vibroimpact.scenarios.classify import classify as run

        with progress_bar("sweeping") as progress:
            found = run(
                what.rig,
                held,
                thresholds=used,
                threads=threads,
                progress=progress,
            )
        data = found.sweep
        data.attrs["title"] = what.name
        axes = resonance_curves(
            data, title=f"{what.title}: {found.scenario}, {told.meaning(found.scenario)}"
        )
        stem = folder / f"{what.slug}-scenario"
        files = {
            "data": save(data, f"{stem}.nc"),
            "figure": save_figure(axes[0], f"{stem}.{out.figure}"),
        }
    facts = {**summary.rig_facts(what), **told.facts(found)}
    text = Together(summary.rig_text(what), Text(), told.text(found))
    tell(text, facts, folder, files, out.json)
    return 0


def _frequencies(
    what: Subject,
    start: str | None,
    stop: str | None,
    step: str | None,
) -> tuple[float, ...] | None:
    """The frequencies that were asked for; None for the default."""
    from vibroimpact.scenarios.axes import one_sine

    rig = one_sine(what.rig, "excitation")
    oscillator = rig.oscillator
    if start is None and stop is None and step is None:
        return None
    import numpy as np

    from vibroimpact.cli.frequency_grid import frequency_grid
    from vibroimpact.model import to_si
    from vibroimpact.model.quantities import FREQUENCY
    from vibroimpact.response.analytic_free_response import beside_resonance
    from vibroimpact.scenarios.classify import LEAST
    from vibroimpact.scenarios.sweep_frequencies import LOW, STEP, highest

    natural = oscillator.natural_frequency
    defaults = (LOW * natural, highest(rig) * natural, STEP * natural)
    numbers = [
        default if text is None else to_si(text, FREQUENCY, option, above=0.0)
        for option, text, default in zip(
            ("--from", "--to", "--step"), (start, stop, step), defaults, strict=True
        )
    ]
    if not numbers[0] < numbers[1]:
        raise InputError(
            f"--from: {numbers[0]:g} Hz is not below --to, {numbers[1]:g} Hz; a rising range is "
            "accepted"
        )
    held = frequency_grid(*numbers)
    if step is None:
        held = tuple(beside_resonance(oscillator, np.array(held)).tolist())
    if len(held) < LEAST:
        raise InputError(
            f"--step: {numbers[2]:g} Hz makes {len(held)} frequencies; at least {LEAST} are "
            "accepted"
        )
    return held
