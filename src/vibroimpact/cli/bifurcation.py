"""``vibroimpact bifurcation``: the steady motions over a parameter, by simulation."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.states import fixed_frequency, rig_at
from vibroimpact.cli.vary import FREQUENCY_HELP, HELP, NUMBER_HELP, Vary, read_one

_STEPS = 401
_SHOWN = {
    "displacement": "section_displacement",
    "velocity": "section_velocity",
    "impact-velocity": "contact_start_velocity",
    "impact-phase": "contact_start_phase",
}
_DIRECTIONS = {"both": ("up", "down"), "up": ("up",), "down": ("down",), "none": ()}


@calls("bifurcation_diagram", "Diagram", direction="directions", compute="outputs")
def bifurcation(
    rig: opt.RigName,
    /,
    *,
    vary: Annotated[
        Vary,
        Parameter(help=f"{HELP} The range has 401 values. {NUMBER_HELP} {FREQUENCY_HELP}"),
    ] = (),
    frequency: opt.Frequency = None,
    direction: Literal["up", "down", "both", "none"] = "both",
    random: opt.Whole,
    quantity: Literal["displacement", "velocity", "impact-velocity", "impact-phase"] = (
        "displacement"
    ),
    phase: opt.Text = None,
    branches: opt.Flag = False,
    compute: opt.Compute = (),
    threads: opt.Threads = None,
    where: opt.Where = "threads",
    max_cycles: Annotated[opt.Whole, Parameter(group=opt.COMPUTATION)],
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Compute a bifurcation diagram: the steady motions at a series of values of a parameter.

    At each value, the motion is simulated until it is steady. Its final state is the initial state
    at the next value. By default, this is done for rising and for falling values (--direction).
    Further motions may start from random states at each value (--random). For each motion, the
    diagram shows the points of a Poincaré section, the period and the largest Lyapunov exponent.

    The command prints the ranges of the parameter in which the type of the motion does not change.
    It writes these files (--name sets NAME):

    - NAME-PARAMETER-diagram.nc: the section points, periods and exponents
    - NAME-PARAMETER-diagram.png: the bifurcation diagram

    Unless the frequency is varied, it stands after NAME, as in NAME-2Hz-gap-diagram.nc.

    For a rig of several masses (table [assembly] of a study file), the figure shows the section of
    each mass.

    For example:

        vibroimpact bifurcation B3-10mm-A3 --vary frequency=0.9Hz:1.3Hz
        vibroimpact bifurcation B3-10mm-A3 --vary gap=3mm:7mm:200 --frequency 1.12Hz
        vibroimpact bifurcation B2-G1-A3 --vary frequency=1Hz:3Hz --quantity impact-velocity

    Parameters
    ----------
    frequency
        Forcing frequency, such as 2Hz. It has no effect if the frequency is varied. Default: the
        frequency in the study file (table [simulate]). If there is none, the option is required.
    direction
        Order of the values: up (rising), down (falling), both, or none. With none, motions start
        only from random states (--random).
    quantity
        Quantity on the vertical axis of the figure. The displacement and the velocity are recorded
        once per forcing cycle. The impact velocity and the impact phase are recorded at the start
        of each contact.
    phase
        Phase of the forcing at which displacement and velocity are recorded, such as 90deg.
        Default: the phase in the study file, or 0.
    branches
        Also follow the branches of stable and unstable periodic orbits, as vibroimpact branch does
        (of several masses, one branch), draw them with their bifurcations, and print these.
    """
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import bifurcation_diagram as facts
    from vibroimpact.facts import branch

    what = subject(rig, changes, output.name, masses=True)
    varied = read_one(what, vary)
    along, span = varied.name, varied.span
    shaken = rig_at(what, frequency, phase, along)
    outputs = opt.own_outputs(compute)
    with results(what, output, fixed_frequency(shaken, along)) as written:
        with written.progress("computing motions") as progress:
            data = vi.bifurcation_diagram(
                shaken,
                {along: span},
                varied.number or _STEPS,
                directions=_DIRECTIONS[direction],
                random=random,
                section="impacts" if quantity.startswith("impact") else "stroboscopic",
                log=varied.logarithmic,
                max_cycles=max_cycles,
                outputs=outputs,
                threads=threads,
                where=where,
                progress=progress,
            )
        orbits = None
        if branches:
            start_phase = shaken.harmonic.phase
            if what.system.by_mass:
                begin = shaken.at(span[0]) if along == "frequency" else shaken
                orbits = vi.branch(begin, vary={along: span})
            else:
                orbits = vi.resonance_diagram(shaken, {along: span}, phase=start_phase)
        written.write(
            data,
            f"{varied.ending}-diagram",
            figures.section_diagram,
            quantity=_SHOWN[quantity],
            branches=orbits,
        )
    summary, text = facts.facts(data), [facts.text(data)]
    if orbits is not None:
        summary["bifurcations"] = branch.facts(orbits)["bifurcations"]
        text.append(branch.bifurcations(orbits))
    return written.tell(summary, *text)
