"""``vibroimpact curve``: curves of bifurcations in the plane of two parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.parameters import option_range
from vibroimpact.cli.states import rig_at
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.cli.rig import Subject

_KINDS = {
    "fold": "fold",
    "symmetry-breaking": "symmetry breaking",
    "period-doubling": "period doubling",
    "neimark-sacker": "Neimark-Sacker",
    "grazing": "grazing",
}


@calls(
    "bifurcation_curve",
    "Curve",
    bifurcation="kind",
    over="parameters",
    first="spans[0]",
    second="spans[1]",
)
def curve(
    rig: opt.RigName,
    /,
    *,
    bifurcation: Literal[
        "fold", "symmetry-breaking", "period-doubling", "neimark-sacker", "grazing"
    ] = "fold",
    over: str = "frequency,gap",
    first: opt.Text = None,
    second: opt.Text = None,
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

    For example:

        vibroimpact curve B2-G1-A3 --bifurcation fold --over frequency,gap --second 1mm:20mm
        vibroimpact curve B2-G1-A3 --over frequency,stiffness-ratio --second 0.5:100

    Parameters
    ----------
    bifurcation
        Kind of bifurcation that is followed. At a fold, a branch of periodic orbits turns back. At
        a grazing, an orbit just touches a bumper.
    over
        Names of the first and the second parameter, separated by a comma. For all names, see
        --parameter of vibroimpact branch.
    first
        Range of the first parameter, LOW:HIGH, such as 0.5Hz:4Hz. Only the frequency has a default:
        the range in the study file (table [sweep]). If the file states none, the default is from
        0.27 to 4.5 × the natural frequency. For laboratory cases it is from 0.3 to 5 Hz.
    second
        Range of the second parameter, LOW:HIGH, such as 1mm:20mm. It is required, unless this
        parameter is the frequency, which has the same default as in --first. The range must contain
        the rig's own value of the parameter.
    frequency
        Forcing frequency at which the bifurcations along the first parameter are found, such as
        2Hz. It has no effect if the first parameter is the frequency. Default: the frequency in the
        study file (table [simulate]). If there is none, the option is required.
    """
    from vibroimpact.cli.output import progress_bar
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import bifurcation_curves as facts
    from vibroimpact.stability.curves_of_kind import curves_of_kind

    what = subject(rig, changes, output.name)
    names = [name.strip().replace("-", "_") for name in over.split(",")]
    if len(names) != 2:
        raise InputError(
            f"--over: {over!r} is not a pair of parameters; pass two names with a comma between "
            "them, such as frequency,gap"
        )
    kind, pair = _KINDS[bifurcation], (names[0], names[1])
    shaken = rig_at(what, frequency, along=names[0])
    spans = _range(what, "--first", pair[0], first), _range(what, "--second", pair[1], second)
    with results(what, output) as written:
        with progress_bar("following curves") as progress:
            found = curves_of_kind(shaken, kind, parameters=pair, spans=spans, progress=progress)
        ending = f"{bifurcation}-{'-'.join(names).replace('_', '-')}"
        written.write(found, ending, figures.bifurcation_curves, f"{what.title}, {kind}")
    return written.tell(facts.facts(kind, pair, found), facts.text(kind, pair, found))


def _range(what: Subject, option: str, name: str, text: str | None) -> tuple[float, float]:
    """Read LOW:HIGH. The frequency has a default."""
    if text is None and name == "frequency":
        return option_range(what, name, None, None, (option, option), "--over")
    low, colon, high = (text or "").partition(":")
    if not (low and colon and high):
        wrong = "missing" if text is None else f"{text!r} is not a range"
        raise InputError(f"{option}: {wrong}; pass the lowest and the highest {name} as LOW:HIGH")
    return option_range(what, name, low, high, (option, option), "--over")
