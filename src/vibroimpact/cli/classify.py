"""``vibroimpact classify``: the scenario of a rig, with the evidence for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject


@calls("classify_scenario", "Frequencies", step="frequencies")
def classify(
    rig: opt.RigName,
    /,
    *,
    start: Annotated[opt.Text, Parameter(name="--from")] = None,
    stop: Annotated[opt.Text, Parameter(name="--to")] = None,
    step: opt.Text = None,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    thresholds: opt.ThresholdOptions = opt.DEFAULT_THRESHOLDS,
    threads: opt.Threads = None,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Classify the resonance curves of a rig into one of seven classes (scenarios S0 to S6).

    The command sweeps the frequency forward (rising) and backward (falling). It prints the scenario
    and the evidence, that is, the features of the two resonance curves that determine the scenario.

    The primary resonance is the main resonance, and secondary resonances lie at lower frequencies.
    In a right hysteresis, the forward sweep gives the larger motions. In a left hysteresis, the
    backward sweep gives the larger motions. A resonance is regular if its motion repeats after one
    forcing cycle and, for a symmetric rig, is its own mirror image. Chaotic and subharmonic
    resonances are not regular.

    The scenarios are:

    - S0: the mass touches no bumper
    - S1: the mass grazes a bumper, that is, it reaches the bumper and hardly deforms it
    - S2: the primary resonance has a right hysteresis
    - S3: as S2, and there is a secondary resonance
    - S4: secondary resonances have a left hysteresis or are not regular
    - S5: the curves are smooth, and the bumpers touch the mass at rest
    - S6: the primary resonance is bent to the right, without jumps

    All other curves are unclassified.

    The command writes these files (--name sets NAME):

    - NAME-scenario.nc: the data of the resonance curves
    - NAME-scenario.png: the resonance curves

    For example:

        vibroimpact classify B2-G1-A3
        vibroimpact classify B3-10mm-A3 --from 0.3Hz --to 5Hz
        vibroimpact classify B3-G1-A3 --extent 0.01

    Parameters
    ----------
    start
        Lowest frequency, such as 0.3Hz. Default: 0.4 × the natural frequency.
    stop
        Highest frequency, such as 5Hz. Default: an upper bound of the frequency of the primary
        resonance.
    step
        Step between frequencies, such as 0.01Hz. Default: 0.01 × the natural frequency.
    """
    from rich.text import Text as Line

    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import scenario as facts
    from vibroimpact.scenarios.classify import classify as classify_rig

    what = subject(rig, changes, output.name)
    grid = _frequencies(what, start, stop, step)
    used = thresholds.thresholds()
    with results(what, output) as written:
        with written.progress("sweeping") as progress:
            classification = classify_rig(
                what.rig, grid, thresholds=used, threads=threads, progress=progress
            )
        title = f"{what.title}: {classification.scenario}, {facts.meaning(classification.scenario)}"
        written.write(classification.sweep, "scenario", figures.resonance_curves, title)
    return written.tell(facts.facts(classification), Line(), facts.text(classification))


def _frequencies(
    what: Subject, start: str | None, stop: str | None, step: str | None
) -> tuple[float, ...] | None:
    """Return the frequencies of the options, or None if there are no such options."""
    from vibroimpact.scenarios.axes import one_sine

    rig = one_sine(what.rig, "excitation")
    if start is None and stop is None and step is None:
        return None
    import numpy as np

    from vibroimpact.cli.frequency_grid import list_frequencies
    from vibroimpact.response.analytic_free_response import beside_resonance
    from vibroimpact.scenarios.sweep_frequencies import LOW, STEP, highest

    natural = rig.oscillator.natural_frequency
    default = (LOW * natural, highest(rig) * natural, STEP * natural)
    grid = np.array(list_frequencies(start, stop, step, None, None, default), dtype=float)
    if step is None:
        grid = beside_resonance(rig.oscillator, grid)
    return tuple(grid.tolist())
