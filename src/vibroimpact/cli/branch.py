"""``vibroimpact branch``: stable and unstable periodic orbits of a rig along a parameter."""

from __future__ import annotations

from typing import Annotated, Any

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.states import fixed_frequency, named_state, rig_at, state
from vibroimpact.cli.vary import FREQUENCY_HELP, HELP, Vary, read_one
from vibroimpact.stability.branch_styles import Quantity

_PHYSICAL: dict[Quantity, Quantity] = {
    "eta_d": "peak_displacement",
    "eta_a": "peak_acceleration",
}
_HOLDS = 120
"""Number of frequencies of the stepped sweep in the figure."""


@calls("resonance_diagram", "Branch", compute="outputs")
def branch(
    rig: opt.RigName,
    /,
    *,
    vary: Annotated[Vary, Parameter(help=f"{HELP} {FREQUENCY_HELP}")] = (),
    frequency: opt.Frequency = None,
    quantity: Quantity | None = None,
    physical: opt.Physical = None,
    longest: opt.Whole,
    random: opt.Whole,
    basins: opt.Whole = 0,
    compute: opt.Compute = (),
    begin: Annotated[opt.Text, Parameter(name="--start")] = None,
    period: opt.Whole | None = None,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Follow the branches of periodic orbits along a parameter, through folds and grazings.

    A branch is a curve of stable and unstable periodic orbits over the parameter. It turns back at
    a fold. At a grazing, the orbit just touches a bumper. The branches start from:

    - the steady motions of sweeps up and down the range of the parameter
    - the steady motions that random initial states lead to
    - the motion without contact
    - each symmetry breaking and each period doubling on the branches

    With --start or --period, the command follows only one branch. This branch starts from the
    periodic orbit near the state --start or, without --start, from the steady motion that is
    reached from rest.

    The command prints the bifurcations. It writes these files (--name sets NAME):

    - NAME-PARAMETER-branches.nc: the orbits and the bifurcations of all branches
    - NAME-PARAMETER-branches.png: the branches. If the parameter is the frequency, the figure also
      shows a simulated sweep.
    - NAME-PARAMETER-branches-OUTPUT.png: the branches over each output of --compute

    Unless the frequency is varied, it stands after NAME, as in NAME-2Hz-gap-branches.nc.

    For a rig of several masses (table [assembly] of a study file), the command follows one branch,
    that of the motion that is reached from the equilibrium, or with --period of its orbit of this
    period. The figure shows the largest displacement of each mass.

    For example:

        vibroimpact branch B2-G1-A3
        vibroimpact branch B3-10mm-A3 --vary frequency=0.9Hz:1.3Hz --quantity eccentricity
        vibroimpact branch B2-G1-A3 --vary gap=1mm:20mm --frequency 2Hz

    Parameters
    ----------
    frequency
        Forcing frequency, such as 2Hz. It is used if another parameter is varied. It is also used
        with --start or --period, as the frequency of the orbit from which the branch starts.
        Default: the frequency in the study file (table [simulate]). If there is none, the option is
        required in both cases.
    quantity
        Quantity on the vertical axis of the figure. An excursion is the maximum minus the minimum.
        eta_d and eta_a are the excursions of displacement and acceleration, each divided by its
        largest value without bumpers. The eccentricity is the mean of the largest and the smallest
        displacement. The transmissibility is the excursion of the force on the base, divided by
        that of the exciting force. Default: peak_displacement for a study file, and eta_d for a
        laboratory case.
    physical
        Draw displacements (mm) and accelerations (g) instead of the normalised excursions η_d and
        η_a. Default: --normalised for a laboratory case.
    random
        Number of random initial states at each of 40 values of the parameter. Motions that start
        from these states help to find isolated branches. An isolated branch has stable orbits, but
        is not connected to the other branches.
    basins
        Number of values of the parameter at which basins of attraction are computed. The basins
        help to find isolated branches to which only few initial states lead.
    begin
        State (displacement and velocity) near a periodic orbit, such as 5mm,100mm/s; of several
        masses, values such as velocity.ball=0.1m/s,displacement.host=2cm. Only the
        branch of this orbit is followed. Default: all branches are followed.
    period
        Period of the orbits of one branch, in forcing cycles. Only this branch is followed.
        Default: 1 with --start. Without --start, the default is that all branches are followed.
    """
    import numpy as np

    from vibroimpact.attraction.basins_along import basins_along
    from vibroimpact.cli.results import draws_physical, results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import branch as facts

    what = subject(rig, changes, output.name, masses=True)
    several = what.system.by_mass
    what.refuse_of_masses(normalised=physical is False, basins=basins or None)
    varied = read_one(what, vary, number=False)
    along, span = varied.name, varied.span
    is_one = begin is not None or period is not None or several
    of_orbit = is_one and not (several and along == "frequency" and frequency is None)
    shaken = rig_at(what, frequency, along="" if of_orbit else along)
    if several and not of_orbit:
        # Without a frequency, the branch starts at the lower end of the range.
        shaken = shaken.with_parts(what.system, what.at(span[0]), keep_open=False)
    near: Any = None
    if begin is not None:
        near = named_state("--start", begin.split(",")) if several else state("--start", begin)
    swept, outputs = None, opt.own_outputs(compute)
    with results(what, output, fixed_frequency(shaken, along)) as written:
        with written.progress("following branches") as progress:
            if is_one:
                data = vi.branch(
                    shaken,
                    near,
                    vary={along: span},
                    period=period,
                    outputs=outputs,
                    progress=progress,
                )
            else:
                data = vi.resonance_diagram(
                    shaken,
                    {along: span},
                    phase=what.phase,
                    longest=longest,
                    random=random,
                    basins=basins_along(shaken, along, span, basins, progress),
                    outputs=outputs,
                    progress=progress,
                )
                if along == "frequency":
                    values = data["frequency"].values
                    grid = np.linspace(values.min(), values.max(), _HOLDS)
                    swept = vi.sweep(what.rig, grid, outputs=outputs)
        if several:
            if along == "frequency":
                grid = np.linspace(*span, _HOLDS)
                swept = vi.sweep(what.rig, grid, outputs=outputs)
            draw: Any = figures.mass_branches
            shown = quantity or "peak_displacement"
        else:
            draw, shown = figures.branch_diagram, quantity or "eta_d"
            # A quantity that is named is drawn in its own units.
            if draws_physical(data, physical if quantity is None else bool(physical)):
                shown = _PHYSICAL.get(shown, shown)
        ending = f"{varied.ending}-branches"
        written.write(data, ending, draw, quantity=shown, sweep=swept)
        for name in outputs or ():
            drawn = draw(data, quantity=name, sweep=swept, title=written.title)
            written.draw(f"figure of {name}", f"{ending}-{name}", drawn)
    return written.tell(facts.facts(data), facts.text(data))
