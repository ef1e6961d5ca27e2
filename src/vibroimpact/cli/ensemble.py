"""``vibroimpact ensemble``: resonance curves of a rig whose parameters are uncertain."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group, Parameter

from vibroimpact.cli.options import (
    COMPUTATION,
    OUTPUT,
    OutputOptions,
    RigName,
    RigOptions,
    Where,
    Whole,
)
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.rig import Subject
    from vibroimpact.model.rig import Rig

_ENSEMBLE = Group("Ensemble", sort_key=1)
_TEXT = Parameter(group=_ENSEMBLE, allow_leading_hyphen=True)
_COARSER = 4
"""Times the step of a sweep."""


def ensemble(
    rig: RigName,
    /,
    *,
    uncertain: Annotated[
        tuple[tuple[str, str], ...],
        Parameter(
            group=_ENSEMBLE,
            allow_leading_hyphen=True,
            negative="",
            show_default=False,
            help=(
                "Parameter and distribution, once or more: gap normal:7.5mm:0.5mm, damping "
                "lognormal:0.2, stiffness uniform:5%; also triangular:LOW:MODE:HIGH and "
                "normal:MEAN:DEVIATION:LOW:HIGH. Shares are of the rig's own value. Parameters as "
                "for vibroimpact branch; those of the study if none are given."
            ),
        ),
    ] = (),
    draws: Annotated[
        Whole | None,
        Parameter(group=_ENSEMBLE, help="How many rigs are drawn, a power of 2 for sobol; 128."),
    ] = None,
    method: Annotated[
        Literal["sobol", "latin", "random"] | None,
        Parameter(
            group=_ENSEMBLE, help="How: Sobol's points, a Latin hypercube or at random; sobol."
        ),
    ] = None,
    seed: Annotated[
        Whole | None, Parameter(group=_ENSEMBLE, help="The same one draws the same rigs; 0.")
    ] = None,
    sensitivity: Annotated[
        bool,
        Parameter(
            group=_ENSEMBLE,
            negative="",
            show_default=False,
            help="Say, too, which parameter makes the variance of the peaks (Sobol's indices).",
        ),
    ] = False,
    start: Annotated[
        str | None, _TEXT, Parameter(name="--from", help="First frequency; as for sweep.")
    ] = None,
    stop: Annotated[str | None, _TEXT, Parameter(name="--to", help="Last frequency.")] = None,
    step: Annotated[
        str | None, _TEXT, Parameter(help="Distance of two frequencies; four times that of sweep.")
    ] = None,
    frequencies: Annotated[
        str | None, _TEXT, Parameter(help="A list instead, such as 0.5Hz,0.7Hz,1.1Hz.")
    ] = None,
    physical: Annotated[
        bool,
        Parameter(
            group=OUTPUT,
            negative="",
            show_default=False,
            help="Draw the largest acceleration (g) and displacement (mm), not η_a and η_d.",
        ),
    ] = False,
    changes: RigOptions | None = None,
    threads: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="How many sweeps run at once; one a processor."),
    ] = None,
    where: Where = "threads",
    output: OutputOptions | None = None,
) -> int:
    """Draw rigs from the distributions of their parameters, and sweep each of them.

    Prints fractiles of the peaks; writes NAME-ensemble.nc (all sweeps, with the parameters of each
    rig), NAME-ensemble.png (resonance curves with bands), and with --sensitivity
    NAME-sensitivity.nc and .png.

    For example:

        vibroimpact ensemble B2-G1-A3 --uncertain gap normal:5% --uncertain damping lognormal:0.2
        vibroimpact ensemble building.toml --draws 1024 --sensitivity --physical
    """
    from vibroimpact.cli import frequency_grid
    from vibroimpact.cli.output import output_folder, progress_bar, tell, warn
    from vibroimpact.cli.rig import subject
    from vibroimpact.model.rig import Rig

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    given = _distributions(what, uncertain)
    table = what.study.ensemble if what.study else None
    swept = what.study.sweep if what.study else None
    default = frequency_grid.default_range(what, _COARSER)
    held = frequency_grid.frequencies(start, stop, step, frequencies, swept, default)
    options: dict[str, Any] = {
        "draws": (table and table.draws) or 128 if draws is None else draws,
        "seed": (table and table.seed) or 0 if seed is None else seed,
    }
    way = method or (table and table.method) or "sobol"

    with output_folder(out.output) as folder:
        import warnings

        from rich.console import Group as Together

        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.facts import ensemble
        from vibroimpact.figures import resonance_bands, save_figure, sensitivity_bars
        from vibroimpact.response.sweep import sweep, sweeps
        from vibroimpact.uncertainty.ensemble import ensemble as draw

        drawn_rig = Rig(what.oscillator, what.repeated)
        response = partial(sweeps, frequencies=held, threads=threads, where=where)
        with warnings.catch_warnings(record=True) as caught, progress_bar("sweeping") as progress:
            warnings.simplefilter("always", RuntimeWarning)
            data = draw(drawn_rig, given, response, method=way, progress=progress, **options)
            data.attrs["title"] = what.name
            from vibroimpact.model.unbounded import has_no_bound

            # Without stiffness or damping there is no free resonance to divide by.
            undefined = not bool(data["eta_d"].notnull().any()) or has_no_bound(drawn_rig)
            physical = physical or undefined
            shown = ("peak_acceleration", "peak_displacement") if physical else ("eta_a", "eta_d")
            axes = resonance_bands(
                data, quantities=shown, nominal=sweep(drawn_rig, held), title=what.title
            )
            stem = folder / f"{what.slug}-ensemble"
            files = {
                "data": save(data, f"{stem}.nc"),
                "figure": save_figure(axes, f"{stem}.{out.figure}"),
            }
            indices = (
                _indices(drawn_rig, given, response, shown, options, progress)
                if sensitivity
                else {}
            )
        for message in dict.fromkeys(str(warning.message) for warning in caught):
            warn(message)
        for name, found in indices.items():
            stem = folder / f"{what.slug}-sensitivity-{name.replace('_', '-')}"
            files[f"indices of {name}"] = save(found, f"{stem}.nc")
            files[f"figure of {name}"] = save_figure(
                sensitivity_bars(found, title=what.title), f"{stem}.{out.figure}"
            )
    facts = {**summary.rig_facts(what), **ensemble.facts(data, given, indices)}
    text = Together(summary.rig_text(what), ensemble.text(data, given, indices))
    tell(text, facts, folder, files, out.json)
    return 0


def _distributions(what: Subject, options: tuple[tuple[str, str], ...]) -> dict[str, str]:
    """Distributions by parameter, of the options or the study.

    Raises
    ------
    InputError
        If there is none, or one cannot be used.
    """
    studied = what.study.ensemble.uncertain if what.study else None
    names = [name.replace("-", "_") for name, _ in options]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"--uncertain: {name!r} is given twice; once is accepted")
    given = dict(zip(names, (text for _, text in options), strict=True)) or {
        name.replace("-", "_"): text for name, text in (studied or {}).items()
    }
    if not given:
        raise InputError(
            "--uncertain: missing; a parameter and its distribution are accepted, such as gap "
            "normal:5%, here or in the study as ensemble.uncertain"
        )
    from vibroimpact.model.rig import Rig
    from vibroimpact.uncertainty.random_rigs import uncertain

    try:
        uncertain(Rig(what.oscillator, what.repeated), given)
    except InputError as error:
        raise InputError(f"--uncertain: {error}") from None
    return given


def _indices(
    rig: Rig,
    given: dict[str, str],
    response: Any,
    quantities: tuple[str, ...],
    options: dict[str, Any],
    progress: Any,
) -> dict[str, xr.Dataset]:
    """Indices of the peaks of the curves, by quantity."""
    from vibroimpact.uncertainty.sensitivity import sensitivity

    def peaks(rigs: list[Any]) -> xr.Dataset:
        data: xr.Dataset = response(rigs)[list(quantities)]
        return data.max(("direction", "frequency"), keep_attrs=True)

    return {
        name: sensitivity(rig, given, peaks, name, resamples=100, progress=progress, **options)
        for name in quantities
    }
