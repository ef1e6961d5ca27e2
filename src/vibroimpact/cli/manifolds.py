"""``vibroimpact manifolds``: the stable and unstable manifolds of saddle orbits."""

from __future__ import annotations

import re
from typing import Annotated

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.states import ANY_STATES, StateOptions, state


@calls("manifolds", "Curves", saddle="saddles")
def manifolds(
    rig: opt.RigName,
    /,
    *,
    states: StateOptions = ANY_STATES,
    saddle: Annotated[tuple[str, ...], Parameter(allow_leading_hyphen=True, negative="")] = (),
    period: opt.Whole,
    spacing: float,
    longest: float,
    curve_cycles: opt.Whole,
    nodes: opt.Whole = 300,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    threads: opt.Threads = None,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Compute the stable and unstable manifolds of saddle orbits (unstable periodic orbits).

    A saddle orbit is an unstable periodic orbit from which disturbances grow in one direction and
    decay in another. Its manifolds are curves in the plane of displacement and velocity. A motion
    that starts on the stable manifold leads to the saddle orbit. The borders between basins of
    attraction are such stable manifolds. A motion that starts next to the saddle orbit moves away
    along the unstable manifold.

    The command prints the saddle orbits, and the points at which manifolds cross. It writes these
    files (--name sets NAME):

    - NAME-FREQUENCY-manifolds.nc: the manifolds and the saddle orbits
    - NAME-FREQUENCY-manifolds.png: the manifolds over the basins of attraction

    For example:

        vibroimpact manifolds B3-10mm-A3 --frequency 0.7Hz
        vibroimpact manifolds B2-G1-A3 --frequency 2.6Hz --longest 5
        vibroimpact manifolds B3-10mm-A3 --frequency 0.7Hz --saddle 5.3mm,2mm/s

    Parameters
    ----------
    saddle
        Displacement and velocity near a saddle orbit, such as 5mm,2mm/s. The option may be
        repeated. Default: at most four saddle orbits, which are found along the borders between
        basins.
    period
        Period of the saddle orbits that you choose with --saddle, in forcing cycles.
    spacing
        Largest distance between neighbouring points of a curve. The distance is dimensionless: the
        displacement and the velocity are divided by the widths of the ranges --displacement and
        --velocity.
    longest
        Largest length of a curve. The length is dimensionless, as in --spacing.
    curve_cycles
        Largest number of forcing cycles that are simulated for all curves together. Each curve has
        the same share, and ends where its share is used.
    nodes
        Number of initial states along each axis of the grid on which the basins in the figure are
        computed. Default: 300.
    """
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.datasets.description import motion_parameters
    from vibroimpact.facts import manifolds as facts

    what = subject(rig, changes, output.name)
    shaken, window = states.rig(what), states.window()
    near = [state("--saddle", text, shaken.harmonic.phase) for text in saddle]
    with results(what, output, shaken.harmonic.frequency) as written:
        with written.progress("computing manifolds") as progress:
            data = vi.manifolds(
                shaken,
                near or None,
                *window,
                period=period,
                spacing=spacing,
                longest=longest,
                curve_cycles=curve_cycles,
                threads=threads,
                progress=progress,
            )
            sides = [motion_parameters(data)[name] for name in ("displacement", "velocity")]
            below = vi.basins(shaken, *sides, nodes=nodes, threads=threads, progress=progress)
        written.write(data, "manifolds", figures.basin_portrait, drawn=below, manifolds=data)
    if "notes" in data.attrs:  # the file names arguments, and the summary options
        data.attrs["notes"] = re.sub(
            r"(?<=; raise )\w+", lambda name: f"--{name[0].replace('_', '-')}", data.attrs["notes"]
        )
    return written.tell(facts.facts(data), facts.text(data))
