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
    uncertain: opt.Paths = (),
    draws: opt.Whole | None = None,
    method: Literal["sobol", "latin", "random"] | None = None,
    seed: opt.Whole | None = None,
    sensitivity: opt.Flag = False,
    start: Annotated[opt.Text, Parameter(name="--from")] = None,
    stop: Annotated[opt.Text, Parameter(name="--to")] = None,
    step: opt.Text = None,
    frequencies: opt.Text = None,
    physical: opt.Physical = None,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    threads: opt.Threads = None,
    where: opt.Where = "threads",
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Draw random rigs from distributions of their parameters, and sweep the frequency of each rig.

    A peak is the largest value of a quantity, such as the displacement, over all frequencies. For
    each peak, the command prints the values that 5 %, 50 % and 95 % of the rigs do not exceed. It
    writes these files (--name sets NAME):

    - NAME-ensemble.nc: the sweeps of all rigs, with the parameters of each rig
    - NAME-ensemble.png: the median of the resonance curves, and the band between their 5 % and
      95 % quantiles
    - NAME-sensitivity-PEAK.nc and NAME-sensitivity-PEAK.png, with --sensitivity: the Sobol indices
      of each peak. Each parameter has two indices, which are shares of the variance of the peak.
      The first index is the share that the parameter causes on its own. The second index also
      includes its interactions with other parameters.

    For a rig of several masses (table [assembly] of a study file), the figure has a panel for each
    mass, and shows displacements. NAME-ensemble-accelerations.png and NAME-ensemble-forces.png show
    accelerations, and the force of each stop. The indices are those of the largest peak of all
    masses or stops.

    For example:

        vibroimpact ensemble B2-G1-A3 --uncertain gap=normal:5% --uncertain mass=normal:2%
        vibroimpact ensemble building.toml --draws 1024 --sensitivity --physical

    Parameters
    ----------
    uncertain
        Parameter and its distribution, such as gap=normal:7.5mm:0.5mm. The option may be repeated.
        vibroimpact show lists the paths of a rig. The distributions are
        normal:MEAN:DEVIATION, normal:MEAN:DEVIATION:LOW:HIGH (truncated to the range from LOW to
        HIGH), uniform:LOW:HIGH, triangular:LOW:MODE:HIGH and lognormal:MEDIAN:SIGMA. SIGMA is the
        standard deviation of the natural logarithm of the parameter. Three short forms use the
        value of the parameter in the rig: normal:5% (the mean is this value, and the standard
        deviation is 5 % of it), uniform:5% (from 5 % below to 5 % above this value) and
        lognormal:0.2 (the median is this value, and SIGMA is 0.2). Default: the distributions in
        the study file (table [ensemble]).
    draws
        Number of random rigs. For the method sobol it must be a power of 2. Default: the number in
        the study file (table [ensemble]), or 128.
    method
        Sampling method: sobol (scrambled Sobol sequence), latin (Latin hypercube) or random.
        Default: the method in the study file (table [ensemble]), or sobol.
    seed
        Seed of the random rigs. The same seed gives the same rigs. Default: the seed in the study
        file (table [ensemble]), or 0.
    sensitivity
        Also compute which parameter contributes most to the variance of each peak (Sobol indices).
    start
        Lowest frequency, such as 0.3Hz. Default: the value in the study file (table [sweep]). If
        the file states none, the default is 0.45 × the natural frequency. For laboratory cases it
        is 0.5 Hz.
    stop
        Highest frequency, such as 5Hz. Default: the value in the study file (table [sweep]). If the
        file states none, the default is 4.5 × the natural frequency. For laboratory cases it is
        5 Hz.
    step
        Step between frequencies, such as 0.05Hz. Default: the value in the study file (table
        [sweep]). If the file states none, the default is about 0.04 × the natural frequency. For
        laboratory cases it is 0.04 Hz.
    frequencies
        List of frequencies, such as 0.5Hz,0.7Hz,1.1Hz. Replaces --from, --to and --step. Default:
        the list in the study file (table [sweep]), if it has one.
    physical
        Draw accelerations (g) and displacements (mm) instead of the normalised excursions η_a and
        η_d. Default: --normalised for a laboratory case.
    """
    import numpy as np

    from vibroimpact.cli.assembly import draw_bands
    from vibroimpact.cli.frequency_grid import default_range, list_frequencies
    from vibroimpact.cli.results import draws_physical, results
    from vibroimpact.cli.rig import subject
    from vibroimpact.cli.study import EnsembleTable
    from vibroimpact.facts import ensemble as facts
    from vibroimpact.figures.ensembles import PANELS
    from vibroimpact.uncertainty.sensitivity import peak_sensitivity

    what = subject(rig, changes, output.name, masses=True)
    several = what.system.by_mass
    what.refuse_of_masses(normalised=physical is False)
    table = what.study.ensemble if what.study else EnsembleTable()
    distributions = opt.by_path("--uncertain", uncertain) or table.uncertain or {}
    if not distributions:
        raise InputError(
            "--uncertain: missing; pass a parameter and its distribution, such as "
            "--uncertain gap=normal:5%, or set the key uncertain in the table [ensemble] of the "
            "study"
        )
    default = default_range(what, _COARSER)
    grid = list_frequencies(start, stop, step, frequencies, what.sweep_table, default)
    shaken = what.rig.with_parts(what.system, what.repeated)
    response = partial(vi.sweeps, frequencies=grid, threads=threads, where=where)
    chosen = opt.stated(seed=table.seed if seed is None else seed)
    indices = {}
    with results(what, output) as written, written.progress("sweeping") as progress:
        data = vi.ensemble(
            shaken,
            distributions,
            response,
            **opt.stated(
                draws=table.draws if draws is None else draws, method=method or table.method
            ),
            **chosen,
            progress=progress,
        )
        shown: tuple[str, ...] = PANELS[not (several or draws_physical(data, physical))]
        nominal = vi.sweep(shaken, grid)
        bands = figures.resonance_bands
        drawn = ("peak_displacement",) if several else shown
        written.write(data, "ensemble", bands, quantities=drawn, nominal=nominal)
        if several:
            draw_bands(written, data, nominal)
            if data.sizes["stop"] and bool(np.isfinite(data["peak_force"]).all()):
                shown = (*shown, "peak_force")
        if sensitivity:
            count = data.sizes["sample"]
            indices = peak_sensitivity(
                shaken, distributions, response, shown, draws=count, **chosen, progress=progress
            )
        for name, dataset in indices.items():
            ending = f"sensitivity-{name.replace('_', '-')}"
            written.files[f"indices of {name}"] = vi.save(dataset, written.path(ending, "nc"))
            bars = figures.sensitivity_bars(dataset, title=what.title)
            written.draw(f"figure of {name}", ending, bars)
    return written.tell(
        facts.facts(data, distributions, indices), facts.text(data, distributions, indices)
    )
