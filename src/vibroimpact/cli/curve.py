"""``vibroimpact curve``: curves of bifurcations in the plane of two parameters."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.states import fixed_frequency, rig_at
from vibroimpact.cli.vary import HELP, Vary, check_continuous, read_vary
from vibroimpact.errors import InputError

_KINDS = {
    "fold": "fold",
    "symmetry-breaking": "symmetry breaking",
    "period-doubling": "period doubling",
    "neimark-sacker": "Neimark-Sacker",
    "grazing": "grazing",
}


@calls("bifurcation_curve", "Curve", bifurcation="kind")
def curve(
    rig: opt.RigName,
    /,
    *,
    bifurcation: Literal[
        "fold", "symmetry-breaking", "period-doubling", "neimark-sacker", "grazing"
    ] = "fold",
    vary: Annotated[
        Vary,
        Parameter(
            help=f"{HELP} Pass the option twice: first the parameter along which the bifurcations "
            "are found, and then the other. The second range must contain the rig's own value. "
            "--vary frequency, without a range, means the range in the study file (table [sweep]). "
            "If the file states none, it is from 0.27 to 4.5 × the natural frequency, and for "
            "laboratory cases from 0.3 to 5 Hz."
        ),
    ] = (),
    frequency: opt.Frequency = None,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Follow bifurcations as curves in the plane of two parameters, through cusps.

    The command first finds the bifurcations of one kind along the first parameter. It then follows
    each bifurcation as a curve over both parameters. It prints the ends of each curve, and its
    cusps, which are points where the curve turns back on itself. It writes these files (--name sets
    NAME):

    - NAME-BIFURCATION-FIRST-SECOND.nc: the curves, with one NetCDF group per curve
    - NAME-BIFURCATION-FIRST-SECOND.png: the curves in the plane of the two parameters

    Unless the frequency is varied, it stands after NAME, as in NAME-2Hz-fold-gap-damping-ratio.nc.

    For a rig of several masses (table [assembly] of a study file), the bifurcations are those of
    the branch of the motion that is reached from the equilibrium. Grazings are not followed.

    For example:

        vibroimpact curve B2-G1-A3 --bifurcation fold --vary frequency --vary gap=1mm:20mm
        vibroimpact curve B2-G1-A3 --vary frequency=1Hz:4Hz --vary stiffness_ratio=0.5:100

    Parameters
    ----------
    bifurcation
        Kind of bifurcation that is followed. At a fold, a branch of periodic orbits turns back. At
        a grazing, an orbit just touches a bumper.
    frequency
        Forcing frequency at which the bifurcations along the first parameter are found, such as
        2Hz. It has no effect if the first parameter is the frequency. Default: the frequency in the
        study file (table [simulate]). If there is none, the option is required.
    """
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import bifurcation_curves as facts
    from vibroimpact.stability.curves_of_kind import curves_of_kind

    what = subject(rig, changes, output.name, masses=True)
    parameters = read_vary(what, vary)
    if len(parameters) != 2:
        raise InputError(
            f"--vary: given {len(parameters)} times; pass two parameters, such as --vary frequency "
            "--vary gap=1mm:20mm"
        )
    for one in parameters:
        check_continuous(one)
    first, second = parameters
    kind, pair = _KINDS[bifurcation], (first.name, second.name)
    spans = {one.name: one.span for one in parameters}
    shaken = rig_at(what, frequency, along=first.name)
    with results(what, output, fixed_frequency(shaken, *pair)) as written:
        with written.progress("following curves") as progress:
            curves = curves_of_kind(shaken, kind, vary=spans, progress=progress)
        ending = f"{bifurcation}-{first.ending}-{second.ending}"
        written.write(curves, ending, figures.bifurcation_curves, f"{written.title}, {kind}")
    return written.tell(facts.facts(kind, pair, curves), facts.text(kind, pair, curves))
