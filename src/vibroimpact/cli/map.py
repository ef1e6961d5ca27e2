"""``vibroimpact map``: a map of scenarios over two parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.vary import Vary, VaryOption, read_vary_text
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from vibroimpact.model.excitation import Of

_NODES = 21
"""Default number of values on an axis."""
_AXES = ("stiffness_ratio=0.5:100:log", "gap_ratio=0:1")
_PUBLISHED = "B3-10mm-A3"


@calls("scenario_map", "Map", rig="rig", output="store")
def scenario_map(
    rig: opt.RigName | None = None,
    /,
    *,
    vary: Vary = (),
    refine: opt.Whole = 2,
    step: float = 0.01,
    border: bool = True,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    thresholds: opt.ThresholdOptions = opt.DEFAULT_THRESHOLDS,
    threads: opt.Threads = None,
    where: Annotated[str | None, Parameter(group=opt.COMPUTATION)] = None,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Compute a map of scenarios (classes of resonance curves) over two parameters of a rig.

    All other parameters are constant. At each point of the map, the frequency is swept forward
    (rising) and backward (falling). The scenarios are:

    - S0: the mass touches no bumper
    - S1: the mass grazes a bumper, that is, it reaches the bumper and hardly deforms it
    - S2: the primary resonance has a right hysteresis
    - S3: as S2, and there is a secondary resonance
    - S4: secondary resonances have a left hysteresis or are not regular
    - S5: the curves are smooth, and the bumpers touch the mass at rest
    - S6: the primary resonance is bent to the right, without jumps

    All other curves are unclassified. The primary resonance is the main resonance, and secondary
    resonances lie at lower frequencies. In a right hysteresis, the forward sweep gives the larger
    motions. In a left hysteresis, the backward sweep gives the larger motions. A resonance is
    regular if its motion repeats after one forcing cycle and, for a symmetric rig, is its own
    mirror image.

    The command prints the share of the map that each scenario occupies. If the command is stopped,
    run the same command again to complete the map. It writes these files (--name sets NAME):

    - NAME-X-Y-map.zarr: the map
    - NAME-X-Y-map.png: the figure of the map

    For example:

        vibroimpact map --vary stiffness_ratio=0.5:100:log --vary gap_ratio=0:1
        vibroimpact map B2-G1-A3 --vary gap=2mm:20mm:10 --vary amplitude=0.01g:0.1g:log
        vibroimpact map --vary stiffness_ratio=1:100:log:41 --vary damping_ratio=0.05:0.3

    Parameters
    ----------
    rig
        The rig: a mass on an isolator between two bumpers (deformable stops), shaken by one sine.
        Pass the code of a laboratory case, which is a rig of the published tests, or the path of a
        study file (TOML), which describes your own rig. For the parts of a code, see vibroimpact
        sweep. Default: B3-10mm-A3.
    vary
        Parameters of the horizontal and of the vertical axis, each with its range, PATH=LOW:HIGH,
        such as gap=2mm:20mm. Pass the option twice. The range has 21 evenly spaced values. To
        change the number or the spacing, write LOW:HIGH:NUMBER, LOW:HIGH:log or
        LOW:HIGH:log:NUMBER (log: logarithmic spacing). Physical parameters: gap, amplitude,
        stops.stiffness (at constant damping), proportional_stiffness (bumper stiffness at a
        constant ratio of damping to stiffness), isolator_period. Dimensionless parameters:
        stiffness_ratio (bumper stiffness divided by isolator stiffness), gap_ratio (gap divided by
        the largest displacement without bumpers), relaxation_time (natural angular frequency of
        the rig × bumper damping / bumper stiffness), damping_ratio (of the isolator),
        stops.restitution (coefficient of restitution). Default: stiffness_ratio=0.5:100:log and
        gap_ratio=0:1.
    border
        Also draw the exact border between rigs whose resonance curves jump and rigs whose curves do
        not. This is the default.
    where
        Where the computation runs: threads or processes (on this machine), or the address of the
        scheduler of a dask cluster, such as tcp://10.0.0.1:8786. The choice does not affect the
        result. Default: processes if the first grid has at least 500 points, and threads otherwise.
    """
    from rich.text import Text

    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.facts import scenario_map as facts
    from vibroimpact.scenarios.borders import jump_border

    what = subject(rig or _PUBLISHED, changes, output.name)
    if rig is None:
        what = what._replace(
            name=what.name.replace(_PUBLISHED, "published rig"),
            slug=what.slug.replace(_PUBLISHED, "published"),
        )
    of = what.repeated.of
    axes = [_axis(path, text, of) for path, text in opt.by_path("--vary", vary or _AXES).items()]
    if len(axes) != 2:
        raise InputError(
            "--vary: a map has two axes; pass the option twice, such as --vary gap=2mm:20mm "
            "--vary amplitude=0.01g:0.1g"
        )
    used = thresholds.thresholds()
    names = [one.name for one in axes]
    if names[0] == names[1]:
        raise InputError(f"--vary: {names[0]!r} is given twice; pass two different parameters")
    ending = "-".join([*(one.ending for one in axes), "map"])
    with results(what, output) as written:
        written.files["data"] = store = written.path(ending, "zarr")
        with written.progress("computing the map") as progress:
            data = vi.scenario_map(
                what.rig,
                {one.name: one.values(_NODES) for one in axes},
                spacing={one.name: "log" if one.logarithmic else "linear" for one in axes},
                step=step,
                refine=refine,
                thresholds=used,
                store=store,
                threads=threads,
                where=where,
                progress=progress,
            )
        edge = None
        if border:
            with written.progress("following the border") as progress:
                edge = jump_border(data, threads=threads, where=where, progress=progress)
        constants = facts.constants(what.rig, *names)
        title = f"{what.title}: {constants}"
        written.draw("figure", ending, figures.scenario_map(data, border=edge, title=title))
    about = [Text(what.name, style="bold"), Text(f"constant: {constants}"), Text()]
    return written.tell(
        facts.facts(data, edge), *about[1:], facts.text(data, refine), about=about[0]
    )


def _axis(path: str, text: str, of: Of) -> VaryOption:
    """Read an axis."""
    from vibroimpact.model.parameters import canonical, usual
    from vibroimpact.scenarios.axes import NAMES

    name = canonical(path, NAMES)
    if name not in NAMES:
        raise InputError(
            f"--vary: {path!r} is not an axis of a map; pass one of {', '.join(NAMES)}"
        )
    return read_vary_text(path, usual(name, of), text)
