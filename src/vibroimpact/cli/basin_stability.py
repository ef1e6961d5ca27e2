"""``vibroimpact basin-stability``: the share of random states that lead to each steady motion."""

from __future__ import annotations

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.parameters import Largest, Least, Varied, option_range
from vibroimpact.cli.states import ANY_STATES, StateOptions


@calls("basin_stability", "Shares", samples="states", steps="values")
def basin_stability(
    rig: opt.RigName,
    /,
    *,
    parameter: Varied = "frequency",
    start: Least = None,
    stop: Largest = None,
    steps: opt.Whole = 25,
    samples: opt.Whole,
    seed: opt.Whole,
    states: StateOptions = ANY_STATES,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    threads: opt.Threads = None,
    where: opt.Where = "threads",
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Compute the share of random states that lead to each steady motion, along a parameter.

    This share is the basin stability of the motion. The command numbers the motions. To find a
    motion again at the next value of the parameter, it starts simulations there from the states of
    the motion. If they lead to a nearby motion, that motion gets the same number. If the parameter
    is the frequency, --frequency has no effect.

    The command prints the range of the parameter in which each motion exists, with its shares. It
    writes NAME-PARAMETER-basin-stability.nc and NAME-PARAMETER-basin-stability.png.

    For example:

        vibroimpact basin-stability B2-G1-A3 --from 1.5Hz --to 2.7Hz
        vibroimpact basin-stability B3-10mm-A3 --parameter gap --from 3mm --to 7mm --frequency 0.7Hz

    Parameters
    ----------
    steps
        Number of values of the parameter, including both ends.
    """
    import numpy as np

    from vibroimpact.cli.output import progress_bar
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import basin_stability as facts
    from vibroimpact.model.count_checks import whole

    what = subject(rig, changes, output.name)
    along = parameter.replace("-", "_")
    span = option_range(what, along, start, stop)
    shaken, window = states.rig(what, along), states.window()
    values = np.linspace(*span, whole(steps, "steps", 2))
    with results(what, output) as written:
        with progress_bar("computing shares") as progress:
            data = vi.basin_stability(
                shaken,
                *window,
                parameter=along,
                values=values,
                states=samples,
                seed=seed,
                threads=threads,
                where=where,
                progress=progress,
            )
        ending = f"{along.replace('_', '-')}-basin-stability"
        written.write(data, ending, figures.basin_shares)
    return written.tell(facts.facts(data), facts.text(data))
