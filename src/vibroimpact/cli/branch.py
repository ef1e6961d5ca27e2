"""``vibroimpact branch``: all periodic orbits of a rig along a parameter, stable or not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from cyclopts import Group, Parameter

from vibroimpact.cli.options import OutputOptions, RigName, RigOptions, Whole
from vibroimpact.cli.parameters import Varied, option_range
from vibroimpact.cli.states import state
from vibroimpact.errors import InputError
from vibroimpact.stability.branch_styles import Quantity

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import Repeated, State

_BRANCH = Group("Branch", sort_key=1)
_NODES = 40
"""States along each axis of the basins that are looked at."""

_PHYSICAL: dict[str, Any] = {"eta_d": "peak_displacement", "eta_a": "peak_acceleration"}

_WITH_UNITS = Parameter(group=_BRANCH, allow_leading_hyphen=True)


def branch(
    rig: RigName,
    /,
    *,
    parameter: Annotated[Varied, Parameter(group=_BRANCH)] = "frequency",
    start: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(
            name="--from",
            help=(
                "Least value; of a frequency that of the study's sweep, or 0.27 times the natural "
                "one (of a case 0.3Hz)."
            ),
        ),
    ] = None,
    stop: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(
            name="--to",
            help=(
                "Largest value; of a frequency that of the study's sweep, or 4.5 times the natural "
                "one (of a case 5Hz)."
            ),
        ),
    ] = None,
    frequency: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(help="Excitation frequency where another parameter is varied, such as 2Hz."),
    ] = None,
    quantity: Annotated[
        Quantity,
        Parameter(group=_BRANCH, help="What the figure shows."),
    ] = "eta_d",
    physical: Annotated[
        bool,
        Parameter(
            group=_BRANCH,
            negative="",
            show_default=False,
            help="Draw the largest displacement (mm) for eta_d, acceleration (g) for eta_a.",
        ),
    ] = False,
    longest: Annotated[
        Whole, Parameter(group=_BRANCH, help="Longest period, in cycles, that is followed.")
    ] = 4,
    random: Annotated[
        Whole,
        Parameter(
            group=_BRANCH, help="Random starts at each of 40 values, which find isolated branches."
        ),
    ] = 8,
    basins: Annotated[
        Whole,
        Parameter(
            group=_BRANCH,
            help="Values whose basins are looked at for isolated branches, too, however small.",
        ),
    ] = 0,
    begin: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(
            name="--start",
            help=(
                "Displacement and velocity near the first orbit, such as 5mm,100mm/s, where a "
                "motion other than that from rest is to be followed."
            ),
        ),
    ] = None,
    period: Annotated[
        Whole | None,
        Parameter(
            group=_BRANCH,
            help="Its period in cycles; that of the motion from rest, or 1 with --start.",
        ),
    ] = None,
    changes: RigOptions | None = None,
    output: OutputOptions | None = None,
) -> int:
    """Follow the branches of periodic orbits along a parameter, through folds and grazings.

    All branches are followed that motions carried up and down, random starts, free flight,
    symmetry breakings and period doublings lead to; with --start or --period the one that begins
    near the start or where the motion from rest settles. Prints the bifurcations; writes
    NAME-PARAMETER-branches.nc and NAME-PARAMETER-branches.png, along the frequency with a
    stepped sweep in the figure.

    For example:

        vibroimpact branch B2-G1-A3
        vibroimpact branch B3-10mm-A3 --from 0.9Hz --to 1.3Hz --quantity eccentricity
        vibroimpact branch B2-G1-A3 --parameter gap --from 1mm --to 20mm --frequency 2Hz
    """
    from vibroimpact.cli.frequency_grid import default_span
    from vibroimpact.cli.output import output_folder, progress_bar, tell, warn
    from vibroimpact.cli.rig import subject
    from vibroimpact.model.rig import Rig

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    along = parameter.replace("-", "_")
    ends = ("--from", "--to")
    span = option_range(
        along,
        start,
        stop,
        ends,
        default_span(what),
        rig=what.oscillator,
        of=what.repeated.of,
    )

    first = _first(begin, period)
    hertz = _hertz(along, frequency, first)
    if first is not None and hertz is not None:
        _check(what, along, span, hertz)
    for option, number, least in (
        ("--longest", longest, 1),
        ("--random", random, 0),
        ("--basins", basins, 0),
    ):
        if number < least:
            raise InputError(f"{option}: {number}; a whole number of at least {least} is accepted")

    with output_folder(out.output) as folder:
        import warnings

        from rich.console import Group as Together

        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.facts.branch import facts, text
        from vibroimpact.figures import branch_diagram, save_figure

        with warnings.catch_warnings(record=True) as caught, progress_bar("following") as progress:
            warnings.simplefilter("always", RuntimeWarning)
            swept = None
            if first is None:
                data = _all_branches(what, along, span, hertz, longest, random, basins, progress)
                if along == "frequency":
                    swept = _sweep(what, data)
            else:
                data = _one_branch(what, along, span, hertz, first, progress)
        for message in dict.fromkeys(str(warning.message) for warning in caught):
            warn(message)
        data.attrs["title"] = what.name
        from vibroimpact.model.unbounded import has_no_bound

        # Without stiffness or damping there is no free resonance to divide by.
        undefined = not bool(data[quantity].notnull().any()) or (
            what.repeated is not None and has_no_bound(Rig(what.oscillator, what.repeated))
        )
        drawn = _PHYSICAL.get(quantity, quantity) if physical or undefined else quantity
        axes = branch_diagram(data, quantity=drawn, sweep=swept, title=what.title)
        stem = folder / f"{what.slug}-{along.replace('_', '-')}-branches"
        files = {
            "data": save(data, f"{stem}.nc"),
            "figure": save_figure(axes, f"{stem}.{out.figure}"),
        }
    found = {**summary.rig_facts(what), **facts(data)}
    tell(Together(summary.rig_text(what), text(data)), found, folder, files, out.json)
    return 0


def _all_branches(
    what: Subject,
    parameter: str,
    span: tuple[float, float],
    hertz: float | None,
    longest: int,
    random: int,
    looked: int,
    progress: Any,
) -> xr.Dataset:
    """All branches along a parameter."""
    from vibroimpact.model.rig import Rig
    from vibroimpact.stability.resonance_diagram import resonance_diagram

    phase = what.study.excitation.phase if what.study else 0.0
    return resonance_diagram(
        Rig(what.oscillator, what.repeated),
        span,
        parameter=parameter,
        frequency=None if parameter == "frequency" else hertz,
        phase=phase,
        longest=longest,
        random=random,
        basins=_basins(what, parameter, span, what.at(hertz or span[1], phase), looked, progress),
        progress=progress,
    )


def _basins(
    what: Subject,
    parameter: str,
    span: tuple[float, float],
    shaken: Repeated,
    count: int,
    progress: Any,
) -> list[xr.Dataset]:
    """Basins at so many values, each in the middle of its part of the range."""
    from vibroimpact.attraction.basins import basins
    from vibroimpact.model.parameters import parameter as registered
    from vibroimpact.model.rig import Rig

    varied = registered(parameter, of=shaken.of).of(what.oscillator)
    step = (span[1] - span[0]) / max(count, 1)
    return [
        basins(
            varied.vary(Rig(what.oscillator, shaken), span[0] + (i + 0.5) * step),
            nodes=_NODES,
            progress=progress,
        )
        for i in range(count)
    ]


def _sweep(what: Subject, data: xr.Dataset) -> xr.Dataset:
    """A stepped sweep to lay over branches along the frequency."""
    import numpy as np

    from vibroimpact.model.rig import Rig
    from vibroimpact.response.sweep import sweep

    frequency = data["frequency"].values
    grid = np.linspace(frequency.min(), frequency.max(), 120)
    return sweep(Rig(what.oscillator, what.repeated), grid)


class First(NamedTuple):
    """The orbit from which one branch is followed; of the motion from rest unless it says more."""

    start: State | None = None
    period: int | None = None


def _first(start: str | None, period: int | None) -> First | None:
    """The first orbit from its options; None if neither is given.

    Raises
    ------
    InputError
        If one cannot be used.
    """
    if period is not None and period < 1:
        raise InputError(f"--period: {period}; a whole number of at least 1 is accepted")
    if start is None:
        return None if period is None else First(period=period)
    return First(state("--start", start), period)


def _hertz(parameter: str, frequency: str | None, first: First | None) -> float | None:
    """The excitation frequency (Hz); None where it is varied and nothing asks for one.

    Raises
    ------
    InputError
        If it is missing, or cannot be used.
    """
    from vibroimpact.model import to_si
    from vibroimpact.model.quantities import FREQUENCY

    if frequency is not None:
        return to_si(frequency, FREQUENCY, "--frequency", above=0.0)
    if parameter == "frequency" and first is None:
        return None
    raise InputError("--frequency: missing; a frequency greater than 0 is accepted, as 2Hz")


def _check(what: Subject, parameter: str, span: tuple[float, float], hertz: float) -> None:
    """Refuse what leaves the first orbit out.

    Raises
    ------
    InputError
        If the range leaves out the rig's own value.
    """
    from vibroimpact.model.parameters import parameter as varied
    from vibroimpact.model.rig import Rig
    from vibroimpact.model.units import pretty

    known = varied(parameter, of=what.repeated.of).of(what.oscillator)
    here = known.read(Rig(what.oscillator, what.at(hertz)))
    if not span[0] <= here <= span[1]:
        low, high, own = (pretty(value, known.quantity) for value in (*span, here))
        raise InputError(
            f"--from: {low} to {high} leaves out the rig's {parameter}, {own}; a range that holds "
            "it is accepted"
        )


def _one_branch(
    what: Subject,
    parameter: str,
    span: tuple[float, float],
    hertz: float | None,
    first: First,
    progress: Any,
) -> xr.Dataset:
    """The branch along a parameter from one orbit."""
    from vibroimpact.model.rig import Rig
    from vibroimpact.stability.branch import branch as follow

    assert hertz is not None
    phase = what.study.excitation.phase if what.study else 0.0
    return follow(
        Rig(what.oscillator, what.at(hertz, phase)),
        first.start,
        parameter=parameter,
        span=span,
        period=first.period,
        progress=progress,
    )
