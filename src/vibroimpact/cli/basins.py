"""``vibroimpact basins``: which initial states lead to which motion."""

from __future__ import annotations

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.states import ANY_STATES, StateOptions


@calls("basins", "Basins")
def basins(
    rig: opt.RigName,
    /,
    *,
    states: StateOptions = ANY_STATES,
    nodes: opt.Whole = 400,
    refine: opt.Whole,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    threads: opt.Threads = None,
    where: opt.Where = "threads",
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Compute the basins of attraction: which initial states lead to which steady motion.

    The initial states form a grid of displacements and velocities at one forcing frequency. You
    need not know the steady motions in advance.

    The command prints each motion with the share of the states that lead to it. It also prints
    entropies, which measure how strongly the basins are intermingled. It writes these files (--name
    sets NAME):

    - NAME-FREQUENCY-basins.nc: the basins and the motions
    - NAME-FREQUENCY-basins.png: the basins in the plane of displacement and velocity

    For example:

        vibroimpact basins B3-10mm-A3 --frequency 0.7Hz
        vibroimpact basins B3-10mm-A3 --frequency 1.06Hz --nodes 1000
        vibroimpact basins B2-G1-A3 --frequency 2.6Hz --displacement -20mm:20mm --velocity -1:1

    Parameters
    ----------
    nodes
        Number of initial states along each axis of the grid.
    """
    from vibroimpact.cli.output import progress_bar
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import basins as facts
    from vibroimpact.model.frequency_text import forcing, forcing_slug

    what = subject(rig, changes, output.name)
    shaken, window = states.rig(what), states.window()
    hertz = shaken.harmonic.frequency
    with results(what, output) as written:
        with progress_bar("computing basins") as progress:
            data = vi.basins(
                shaken,
                *window,
                nodes=nodes,
                refine=refine,
                threads=threads,
                where=where,
                progress=progress,
            )
        title = f"{what.title}, {forcing(hertz)}"
        written.write(data, f"{forcing_slug(hertz)}-basins", figures.basin_portrait, title)
    return written.tell({"frequency": hertz, **facts.facts(data)}, facts.text(data))
