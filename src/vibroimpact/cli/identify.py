"""``vibroimpact identify``: parameters of a rig from measurements, with a report."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group, Parameter

from vibroimpact.cli.options import COMPUTATION, FileName, OutputOptions, RigOptions, Whole
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import Harmonic

_FIT = Group("Fit", sort_key=1)
_TEXT = Parameter(group=_FIT, allow_leading_hyphen=True)
_GIVEN = "as given"
"""Name of the rig's own laws beside other models."""
_PAIRS = Parameter(group=_FIT, allow_leading_hyphen=True, negative="", show_default=False)


def identify(
    *data: Annotated[
        FileName,
        Parameter(name="DATA", help="Files of tests: CSV, MAT, HDF5, UFF58, TDMS or NetCDF."),
    ],
    rig: Annotated[
        FileName,
        Parameter(
            group=_FIT,
            help="Case code or study file of the rig, with a guess of what is sought.",
        ),
    ],
    free: Annotated[
        str,
        Parameter(
            group=_FIT,
            help="What is sought, such as stiffness,damping,bumper-stiffness,gap.",
        ),
    ],
    each: Annotated[
        str | None, _TEXT, Parameter(help="Of these, what each test has its own of.")
    ] = None,
    bounds: Annotated[
        tuple[tuple[str, str], ...], _PAIRS, Parameter(help="Bounds, NAME LOW:HIGH.")
    ] = (),
    tie: Annotated[
        tuple[tuple[str, str], ...],
        _PAIRS,
        Parameter(help="What follows what, left-gap right-gap."),
    ] = (),
    prior: Annotated[
        tuple[tuple[str, str], ...],
        _PAIRS,
        Parameter(help="What is known beforehand, NAME MEAN:DEVIATION."),
    ] = (),
    columns: Annotated[
        tuple[tuple[str, str], ...],
        _PAIRS,
        Parameter(help="Column by variable, displacement-excursion 'channel 3'."),
    ] = (),
    units: Annotated[
        tuple[tuple[str, str], ...],
        _PAIRS,
        Parameter(help="Unit by variable or column, displacement-excursion mm."),
    ] = (),
    group: Annotated[
        str | None, Parameter(group=_FIT, help="Which of several tests of a file.")
    ] = None,
    decimal: Annotated[
        Literal[".", ","] | None,
        Parameter(group=_FIT, help="Decimal mark of a table, where it does not tell by itself."),
    ] = None,
    noise: Annotated[
        float | None, Parameter(group=_FIT, help="Noise as a share of a value, 0.02.")
    ] = None,
    compare: Annotated[
        str | None,
        _TEXT,
        Parameter(help="Other models that are fitted, too: hertz, softening or both with a comma."),
    ] = None,
    bootstrap: Annotated[Whole, Parameter(group=_FIT, help="Bootstrap samples.")] = 0,
    window: Annotated[
        Whole | None, Parameter(group=_FIT, help="Cycles of a history followed at a stretch; 5.")
    ] = None,
    steady: Annotated[
        bool,
        Parameter(group=_FIT, negative="", help="Histories are those of steady motions."),
    ] = False,
    changes: RigOptions | None = None,
    seed: Annotated[Whole, Parameter(group=COMPUTATION, help="Of starts and bootstrap.")] = 0,
    starts: Annotated[Whole, Parameter(group=COMPUTATION, help="Local fits.")] = 6,
    threads: Annotated[
        Whole | None, Parameter(group=COMPUTATION, help="How many fits run at once.")
    ] = None,
    output: OutputOptions | None = None,
) -> int:
    """Find parameters of a rig from stepped-sine curves or time histories, and how well.

    Prints the values with their intervals, what the data do not determine, what the model lacks,
    and what to test next. Writes NAME.html and NAME.md with figures, NAME.nc with all numbers, and
    NAME.toml, the fitted rig, which every other command takes.

    For example:

        vibroimpact identify test.csv --rig B2-G1-A3 --free stiffness,damping,gap
        vibroimpact identify up.csv down.csv --rig study.toml --free gap --compare hertz
        vibroimpact identify shaken.mat --rig study.toml --free right-gap,left-gap
    """
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject
    from vibroimpact.identification.comparison import MODELS, remodelled
    from vibroimpact.measurements.read import CALL, read_measurement

    out = output or OutputOptions()
    if not data:
        raise InputError("DATA: missing; the file of a test is accepted")
    named = {key.replace("-", "_"): value for key, value in columns}
    in_units = {key.replace("-", "_") if key.replace("-", "_") else key: v for key, v in units}
    tests = [
        read_measurement(path, columns=named, units=in_units, group=group, decimal=decimal)
        for path in data
    ]
    if changes and changes.amplitude is not None:
        stated = {"amplitude": changes.amplitude, "amplitude_source": CALL}
        tests = [test.assign_attrs(stated) for test in tests]
    measured = None if changes and changes.amplitude is not None else _shaken(tests)
    what = subject(rig, changes or RigOptions(), out.name, otherwise=measured)
    names = [name.strip().replace("-", "_") for name in free.split(",")]
    limits = {name.replace("-", "_"): _pair(text, "--bounds") for name, text in bounds}
    if strange := set(limits) - set(names):
        raise InputError(f"--bounds: {sorted(strange)[0]!r} is not free; {free} is accepted")
    wanted = {name: limits.get(name) for name in names}
    asked: dict[str, Any] = {
        "free": wanted,
        "each": [name.strip() for name in each.split(",")] if each else [],
        "ties": dict(tie),
        "priors": {name: _pair(text, "--prior") for name, text in prior},
        "noise": noise,
        "window": window,
        "steady": steady,
        "seed": seed,
        "starts": starts,
        "threads": threads,
    }
    others = [name.strip() for name in compare.split(",")] if compare else []
    if strange := set(others) - set(MODELS):
        raise InputError(f"--compare: {sorted(strange)[0]!r}; hertz and softening are accepted")
    for other in others:
        remodelled(other, what.oscillator, depth=1e-3)  # refused before anything is computed

    with output_folder(out.output) as folder:
        from vibroimpact.datasets.files import save
        from vibroimpact.identification.comparison import compare_fits
        from vibroimpact.identification.identify import identify as run
        from vibroimpact.reports.identification import fit_report

        with progress_bar("fitting") as progress:
            found = run(_rig(what, measured), tests, draws=bootstrap, progress=progress, **asked)
        fits, comparison, best = {_GIVEN: found}, None, _GIVEN
        if others:
            for other in others:
                fits[other] = _other(other, found, tests, asked)
            comparison = compare_fits(fits)
            best = str(comparison["model"].values[0])
        written = {f"{what.slug}-fit": found}
        if best != _GIVEN:
            with progress_bar(f"fitting {best}") as progress:
                again = {**asked, "draws": bootstrap, "progress": progress}
                fits[best] = written[f"{what.slug}-fit-{best}"] = _finished(
                    best, fits[best], tests, again
                )
        files: dict[str, Any] = {}
        for name, fit in written.items():
            made = {"data": save(fit, folder / f"{name}.nc")}
            made |= fit_report(fit, folder.path, name, comparison=comparison, figure=out.figure)
            files |= {key if fit is found else f"{best}: {key}": path for key, path in made.items()}
    text, facts = _summary(found, tests, comparison, None if best == _GIVEN else (best, fits[best]))
    tell(text, facts, folder, files, out.json)
    return 0


def _shaken(tests: list[xr.Dataset]) -> Harmonic | None:
    """What the files themselves say of the base; None where one of them leaves it open."""
    from vibroimpact.model import Harmonic

    if any("amplitude" not in t.attrs and "base_acceleration" not in t for t in tests):
        return None
    return Harmonic(float(tests[0].attrs.get("amplitude", 1.0)), 1.0)


def _rig(what: Subject, measured: Harmonic | None) -> Any:
    """The rig; its oscillator alone if only the files say what shakes it."""
    return what.oscillator if what.shaking is measured else what.rig


def _pair(text: str, option: str) -> tuple[str, str]:
    low, mark, high = text.partition(":")
    if not mark:
        raise InputError(f"{option}: {text!r}; two values with a colon between them are accepted")
    return low, high


def _other(model: str, found: xr.Dataset, tests: Any, asked: dict[str, Any]) -> xr.Dataset:
    """The same data fitted by another model, begun from the first fit."""
    from vibroimpact.identification.comparison import asked_of, remodelled
    from vibroimpact.identification.identify import fitted_rig, identify
    from vibroimpact.model import Rig

    rigs = {}
    for test in found["test"].values.tolist():
        rig = fitted_rig(found, test)
        depth = _depth(found, rig.oscillator) if model == "hertz" else 0.0
        rigs[test] = Rig(remodelled(model, rig.oscillator, depth), rig.amplitude)
    search = {"profiles": False, "starts": 2, "tried": 16}
    return identify(rigs, tests, **{**asked_of(model, asked), **search})


def _finished(model: str, fit: xr.Dataset, tests: Any, asked: dict[str, Any]) -> xr.Dataset:
    """A fit of another model again, from where it ended, with its intervals."""
    from vibroimpact.identification.comparison import asked_of
    from vibroimpact.identification.identify import fitted_rig, identify

    rigs = {test: fitted_rig(fit, test) for test in fit["test"].values.tolist()}
    return identify(rigs, tests, **{**asked_of(model, asked), "starts": 1, "tried": 0})


def _depth(found: xr.Dataset, oscillator: Any) -> float:
    """How far the mass goes into a stop (m), about: half the largest excursion less the gap."""
    import numpy as np

    gap = min(float(stop.gap) for stop in oscillator.stops)
    variable = found["point_variable"].values
    swing = found["measured_value"].values[variable == "displacement_excursion"]
    reach = 0.5 * float(np.nanmax(swing)) if len(swing) else 1.5 * gap
    return max(0.7 * (reach - gap), 1e-4 * max(gap, 1e-3))


def _summary(
    found: xr.Dataset,
    tests: list[xr.Dataset],
    comparison: xr.Dataset | None,
    best: tuple[str, xr.Dataset] | None,
) -> tuple[Any, dict[str, Any]]:
    """What is printed; `best` is another model that fits better, if one was found."""
    from rich.console import Group as Together
    from rich.text import Text

    from vibroimpact.identification.next_test import next_test
    from vibroimpact.reports.identification import amplitude_of

    notes = [line for test in tests for line in _notes(test, many=len(tests) > 1)]
    names = [str(test) for test in found["test"].values]
    amplitudes = {name: amplitude_of(found, name) for name in names}
    findings = found.attrs["findings"].splitlines()
    advice = next_test(found).attrs["findings"].splitlines()
    compared = [] if comparison is None else comparison.attrs["findings"].splitlines()
    lines = [*findings, *compared, *advice]
    parts: list[Any] = [Text(f"amplitude of {name}: {told}") for name, told in amplitudes.items()]
    parts += [Text(), _table(found), Text(), *(Text(f"- {line}") for line in lines)]
    if best:
        name, fit = best
        parts += [Text(), Text(f"The model that fits best, {name}:"), _table(fit), Text()]
        parts += [Text(f"- {line}") for line in fit.attrs["findings"].splitlines()]
    if notes:
        parts += [Text(), Text("Reading"), *(Text(f"- {line}") for line in notes)]
    facts = {
        "parameters": _values(found),
        "amplitudes": amplitudes,
        "findings": findings,
        "comparison": compared,
        "next": advice,
        "reading": notes,
    }
    if best:
        name, fit = best
        facts["best_model"] = {
            "model": name,
            "parameters": _values(fit),
            "findings": fit.attrs["findings"].splitlines(),
        }
    return Together(*parts), facts


def _table(found: xr.Dataset) -> Any:
    """The parameters of a fit, a row each."""
    from rich.table import Table

    from vibroimpact.reports.identification import parameter_rows

    table = Table(box=None, pad_edge=False, padding=(0, 2))
    share = f"{100.0 * float(found.attrs['confidence']):g} % interval"
    for head in ("parameter", "value", "standard error", share):
        table.add_column(head)
    for row in parameter_rows(found):
        table.add_row(*row[:4])
    return table


def _values(found: xr.Dataset) -> dict[str, Any]:
    return {
        str(key): {
            "value": float(found["fitted_value"].sel(parameter=key)),
            "standard_error": float(found["standard_error"].sel(parameter=key)),
            "interval": found["interval"].sel(parameter=key).values.tolist(),
        }
        for key in found["parameter"].values
    }


def _notes(test: xr.Dataset, *, many: bool) -> list[str]:
    """What reading a test told; with the file's name where there are several."""
    source = test.attrs.get("source", "")
    lines = test.attrs.get("notes", "").splitlines()
    return [
        line if not many or line.startswith(f"{source}: ") else f"{source}: {line}"
        for line in lines
    ]
