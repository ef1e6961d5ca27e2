"""``vibroimpact basin-stability``: the share of random states that lead to each steady motion."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.states import ANY_STATES, StateOptions, fixed_frequency
from vibroimpact.cli.vary import FREQUENCY_HELP, HELP, NUMBER_HELP, Vary, read_one

_STEPS = 25


@calls("basin_stability", "Parameter and samples", samples="states")
def basin_stability(
    rig: opt.RigName,
    /,
    *,
    vary: Annotated[
        Vary,
        Parameter(help=f"{HELP} The range has 25 values. {NUMBER_HELP} {FREQUENCY_HELP}"),
    ] = (),
    samples: opt.Whole,
    seed: opt.Whole,
    states: StateOptions = ANY_STATES,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    threads: opt.Threads = None,
    where: opt.Where = "threads",
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Compute which share of random initial states leads to each steady motion.

    This share is called the basin stability of the motion. It is computed at several values of one
    parameter. The motions are numbered, and each motion keeps its number along the parameter. To
    find a motion again at the next value, the command takes states of the motion at the current
    value, and simulates the rig from them at the next value. If these simulations lead to a nearby
    motion, the nearby motion gets the same number.

    The forcing frequency (--frequency) has no effect if the parameter is the frequency.

    The command prints the range of the parameter in which each motion exists, with its smallest and
    largest share. It writes these files (--name sets NAME):

    - NAME-PARAMETER-basin-stability.nc: the shares and the motions
    - NAME-PARAMETER-basin-stability.png: the shares over the parameter

    Unless the frequency is varied, it stands after NAME, as in NAME-2Hz-gap-basin-stability.nc.

    For example:

        vibroimpact basin-stability B2-G1-A3 --vary frequency=1.5Hz:2.7Hz
        vibroimpact basin-stability B3-10mm-A3 --vary gap=3mm:7mm:11 --frequency 0.7Hz
    """
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import basin_stability as facts

    what = subject(rig, changes, output.name)
    varied = read_one(what, vary)
    along = varied.name
    shaken, window = states.rig(what, along), states.window()
    with results(what, output, fixed_frequency(shaken, along)) as written:
        with written.progress("computing shares") as progress:
            data = vi.basin_stability(
                shaken,
                *window,
                vary={along: varied.values(_STEPS)},
                states=samples,
                seed=seed,
                threads=threads,
                where=where,
                progress=progress,
            )
        ending = f"{varied.ending}-basin-stability"
        written.write(data, ending, figures.basin_shares)
    return written.tell(facts.facts(data), facts.text(data))
