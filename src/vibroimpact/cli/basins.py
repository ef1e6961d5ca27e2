"""``vibroimpact basins``: which initial states lead to which motion."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.states import ANY_STATES, StateOptions, Texts, named_state, plane


@calls("basins", "Basins")
def basins(
    rig: opt.RigName,
    /,
    *,
    states: StateOptions = ANY_STATES,
    on: Annotated[Texts, Parameter(name="--plane")] = (),
    begin: Annotated[Texts, Parameter(name="--start")] = (),
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

    For a rig of several masses (table [assembly] of a study file), pass two coordinates of the
    state as --plane. All others have the values of --start, or those of the equilibrium.

    For example:

        vibroimpact basins B3-10mm-A3 --frequency 0.7Hz
        vibroimpact basins B3-10mm-A3 --frequency 1.06Hz --nodes 1000
        vibroimpact basins B2-G1-A3 --frequency 2.6Hz --displacement -20mm:20mm --velocity -1:1
        vibroimpact basins frame.toml --plane displacement.roof=-8cm:8cm --plane velocity.roof=-1:1

    Parameters
    ----------
    on
        Of several masses, one of the two coordinates that vary, COORDINATE=LOW:HIGH, such as
        displacement.roof=-8cm:8cm or velocity.roof=-1m/s:1m/s. Pass the option twice.
    begin
        Of several masses, the value of another coordinate, such as velocity.base=0.1m/s or
        deformation.moat=1mm. The option may be repeated.
    nodes
        Number of initial states along each axis of the grid.
    """
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import basins as facts

    what = subject(rig, changes, output.name, masses=True)
    what.refuse_of_masses(displacement=states.displacement, velocity=states.velocity)
    shaken, window = states.rig(what), states.window()
    chosen, start = plane(what, on), named_state("--start", begin)
    with results(what, output, shaken.harmonic.frequency) as written:
        with written.progress("computing basins") as progress:
            data = vi.basins(
                shaken,
                *window,
                plane=chosen,
                start=start,
                nodes=nodes,
                refine=refine,
                threads=threads,
                where=where,
                progress=progress,
            )
        written.write(data, "basins", figures.basin_portrait)
    return written.tell(facts.facts(data), facts.text(data))
