"""``vibroimpact bifurcation``: where motions settle over a parameter, by brute force."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Group, Parameter

from vibroimpact.cli.options import COMPUTATION, OutputOptions, RigName, RigOptions, Where, Whole
from vibroimpact.cli.parameters import Largest, Least, Varied, option_range
from vibroimpact.cli.states import forcing
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import Repeated

_DIAGRAM = Group("Diagram", sort_key=1)
_WITH_UNITS = Parameter(group=_DIAGRAM, allow_leading_hyphen=True)
_SHOWN = {
    "displacement": "section_displacement",
    "velocity": "section_velocity",
    "impact-velocity": "contact_start_velocity",
    "impact-phase": "contact_start_phase",
}


def bifurcation(
    rig: RigName,
    /,
    *,
    parameter: Annotated[Varied, Parameter(group=_DIAGRAM)] = "frequency",
    start: Annotated[Least, Parameter(group=_DIAGRAM)] = None,
    stop: Annotated[Largest, Parameter(group=_DIAGRAM)] = None,
    steps: Annotated[
        Whole, Parameter(group=_DIAGRAM, help="How many values, both ends included.")
    ] = 401,
    log: Annotated[
        bool,
        Parameter(
            group=_DIAGRAM,
            negative="",
            show_default=False,
            help="Space the values evenly on a logarithmic axis.",
        ),
    ] = False,
    frequency: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(
            help=(
                "Excitation frequency where another parameter is varied, such as 2Hz; that of the "
                "study's motion."
            )
        ),
    ] = None,
    direction: Annotated[
        Literal["up", "down", "both", "none"],
        Parameter(group=_DIAGRAM, help="Which way the motion is carried on from value to value."),
    ] = "both",
    random: Annotated[
        Whole,
        Parameter(group=_DIAGRAM, help="Random starts, besides, from which every value begins."),
    ] = 0,
    quantity: Annotated[
        Literal["displacement", "velocity", "impact-velocity", "impact-phase"],
        Parameter(
            group=_DIAGRAM,
            help=(
                "What the figure shows of the section: once a forcing cycle, or as each contact "
                "begins."
            ),
        ),
    ] = "displacement",
    phase: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(help="Phase of the forcing at the section, such as 90deg; that of the study."),
    ] = None,
    branches: Annotated[
        bool,
        Parameter(
            group=_DIAGRAM,
            negative="",
            show_default=False,
            help="Follow the branches of orbits, too, and mark their bifurcations.",
        ),
    ] = False,
    threads: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="How many starts run at once; one a processor."),
    ] = None,
    where: Where = "threads",
    max_cycles: Annotated[
        Whole, Parameter(group=COMPUTATION, help="Forcing cycles to wait for a steady motion.")
    ] = 2000,
    changes: RigOptions | None = None,
    output: OutputOptions | None = None,
) -> int:
    """Hold one value of a parameter after the other, and show what each motion settles on.

    Up and down, and from random starts: points of the section, the period and the largest
    Lyapunov exponent. Prints the ranges in which motions are of one kind; writes
    NAME-PARAMETER-diagram.nc and NAME-PARAMETER-diagram.png.

    For example:

        vibroimpact bifurcation B3-10mm-A3 --from 0.9Hz --to 1.3Hz
        vibroimpact bifurcation B3-10mm-A3 --parameter gap --from 3mm --to 7mm --frequency 1.12Hz
        vibroimpact bifurcation B2-G1-A3 --from 1Hz --to 3Hz --quantity impact-velocity
    """
    from vibroimpact.cli.frequency_grid import default_span
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject
    from vibroimpact.model.rig import Rig

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    along = parameter.replace("-", "_")
    span = option_range(
        along,
        start,
        stop,
        ("--from", "--to"),
        default_span(what),
        rig=what.oscillator,
        of=what.repeated.of,
    )
    shaken = forcing(what, along, frequency, phase)
    for option, value, least in (
        ("--steps", steps, 2),
        ("--random", random, 0),
        ("--threads", 1 if threads is None else threads, 1),
        ("--max-cycles", max_cycles, 1),
    ):
        if value < least:
            raise InputError(f"{option}: {value}; a whole number of at least {least} is accepted")
    if direction == "none" and not random:
        raise InputError("--direction: none is accepted beside --random")

    with output_folder(out.output) as folder:
        from rich.console import Group as Together

        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.facts.bifurcation_diagram import facts, text
        from vibroimpact.figures import save_figure, section_diagram
        from vibroimpact.stability.bifurcation_diagram import DIRECTIONS, bifurcation_diagram

        ways = {"both": DIRECTIONS, "none": ()}
        with progress_bar("holding") as progress:
            data = bifurcation_diagram(
                Rig(what.oscillator, shaken),
                along,
                span,
                steps,
                directions=ways.get(direction, (direction,)),
                random=random,
                section="impacts" if quantity.startswith("impact") else "stroboscopic",
                log=log,
                max_cycles=max_cycles,
                threads=threads,
                where=where,
                progress=progress,
            )
        data.attrs["title"] = what.name
        followed = _branches(what, shaken, along, span) if branches else None
        axes = section_diagram(data, quantity=_SHOWN[quantity], branches=followed, title=what.title)
        stem = folder / f"{what.slug}-{along.replace('_', '-')}-diagram"
        files = {
            "data": save(data, f"{stem}.nc"),
            "figure": save_figure(axes, f"{stem}.{out.figure}"),
        }
    found = {**summary.rig_facts(what), **facts(data)}
    tell(Together(summary.rig_text(what), text(data)), found, folder, files, out.json)
    return 0


def _branches(what: Subject, shaken: Repeated, along: str, span: tuple[float, float]) -> xr.Dataset:
    """The branches whose bifurcations are marked."""
    from vibroimpact.model.rig import Rig
    from vibroimpact.stability.resonance_diagram import resonance_diagram

    return resonance_diagram(
        Rig(what.oscillator, shaken), span, parameter=along, phase=shaken.phase
    )
