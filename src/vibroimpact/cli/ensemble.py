"""``vibroimpact ensemble``: resonance curves of a rig whose parameters are uncertain."""

from __future__ import annotations

from functools import partial
from typing import Annotated, Literal

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.errors import InputError

_COARSER = 4
"""Step of the sweeps, as a multiple of the step of vibroimpact sweep."""


@calls("ensemble", "Ensemble", uncertain="distributions")
def ensemble(
    rig: opt.RigName,
    /,
    *,
    uncertain: opt.Pairs = (),
    draws: opt.Whole | None = None,
    method: Literal["sobol", "latin", "random"] | None = None,
    seed: opt.Whole | None = None,
    sensitivity: opt.Flag = False,
    start: Annotated[opt.Text, Parameter(name="--from")] = None,
    stop: Annotated[opt.Text, Parameter(name="--to")] = None,
    step: opt.Text = None,
    frequencies: opt.Text = None,
    physical: opt.Physical = False,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    threads: opt.Threads = None,
    where: opt.Where = "threads",
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Draw random rigs from the distributions of their parameters, and sweep each of them.

    For each peak, such as the largest displacement over all frequencies, the command prints the
    values that 5 %, 50 % and 95 % of the rigs do not exceed. It writes:

    - NAME-ensemble.nc: the sweeps of all rigs, with the parameters of each rig
    - NAME-ensemble.png: the median of the resonance curves, and the band from 5 % to 95 %
    - NAME-sensitivity-PEAK.nc and NAME-sensitivity-PEAK.png: with --sensitivity, the Sobol indices
      of each peak

    For example:

        vibroimpact ensemble B2-G1-A3 --uncertain gap normal:5% --uncertain damping lognormal:0.2
        vibroimpact ensemble building.toml --draws 1024 --sensitivity --physical

    Parameters
    ----------
    uncertain
        Parameter and its distribution. The option may be repeated. Examples: gap
        normal:7.5mm:0.5mm, damping lognormal:0.2, stiffness uniform:5%. Other distributions are
        triangular:LOW:MODE:HIGH and normal:MEAN:DEVIATION:LOW:HIGH. If you pass only one number,
        as in uniform:5%, the distribution is centred on the value of the parameter in the rig. The
        number is then the spread as a share of this value. For the names of parameters, see
        --parameter of vibroimpact branch. Default: the distributions in the study (table
        [ensemble]).
    sensitivity
        Also compute which parameter contributes most to the variance of the peaks (Sobol indices).
    start
        Lowest frequency, such as 0.3Hz. Default: as for vibroimpact sweep.
    stop
        Highest frequency, such as 5Hz. Default: as for vibroimpact sweep.
    step
        Step between frequencies, such as 0.05Hz. Default: four times the step of vibroimpact
        sweep.
    frequencies
        List of frequencies, such as 0.5Hz,0.7Hz,1.1Hz. Replaces --from, --to and --step.
    physical
        Draw the largest acceleration (g) and displacement (mm) instead of the normalised excursions
        η_a and η_d. An excursion is the maximum minus the minimum. It is normalised by the largest
        excursion of the same rig without stops.
    """
    from vibroimpact.cli.frequency_grid import default_range, list_frequencies
    from vibroimpact.cli.output import progress_bar
    from vibroimpact.cli.results import has_normalised_curves, results
    from vibroimpact.cli.rig import subject
    from vibroimpact.cli.study import EnsembleTable
    from vibroimpact.facts import ensemble as facts
    from vibroimpact.uncertainty.sensitivity import peak_sensitivity

    what = subject(rig, changes, output.name)
    table = what.study.ensemble if what.study else EnsembleTable()
    given = opt.by_name("--uncertain", uncertain or tuple((table.uncertain or {}).items()))
    if not given:
        raise InputError(
            "--uncertain: missing; pass a parameter and its distribution, such as "
            "--uncertain gap normal:5%, or set the key uncertain in the table [ensemble] of the "
            "study"
        )
    default = default_range(what, _COARSER)
    grid = list_frequencies(start, stop, step, frequencies, what.sweep_table, default)
    shaken = vi.Rig(what.oscillator, what.repeated)
    response = partial(vi.sweeps, frequencies=grid, threads=threads, where=where)
    chosen = opt.stated(seed=table.seed if seed is None else seed)
    indices = {}
    with results(what, output) as written:
        with progress_bar("sweeping") as progress:
            data = vi.ensemble(
                shaken,
                given,
                response,
                **opt.stated(
                    draws=table.draws if draws is None else draws, method=method or table.method
                ),
                **chosen,
                progress=progress,
            )
            shown = ("peak_acceleration", "peak_displacement")
            if has_normalised_curves(data, shaken) and not physical:
                shown = ("eta_a", "eta_d")
            nominal = vi.sweep(shaken, grid)
            bands = figures.resonance_bands
            written.write(data, "ensemble", bands, quantities=shown, nominal=nominal)
            if sensitivity:
                count = data.sizes["sample"]
                indices = peak_sensitivity(
                    shaken, given, response, shown, draws=count, **chosen, progress=progress
                )
        for name, found in indices.items():
            ending = f"sensitivity-{name.replace('_', '-')}"
            written.files[f"indices of {name}"] = vi.save(found, written.path(ending, "nc"))
            bars = figures.sensitivity_bars(found, title=what.title)
            written.draw(f"figure of {name}", ending, bars)
    return written.tell(facts.facts(data, given, indices), facts.text(data, given, indices))
