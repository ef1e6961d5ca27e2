"""``vibroimpact identify``: parameters of a rig from measurements, with a report."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.options import (
    AS_DESCRIBED,
    COMPUTATION,
    DEFAULT_OUTPUT,
    FileName,
    Flag,
    OutputOptions,
    Pairs,
    RigOptions,
    Text,
    Threads,
    Whole,
    by_name,
)
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.rig import Subject


@calls("identify", "Fit", tie="ties", prior="priors", bootstrap="draws")
def identify(
    *data: Annotated[FileName, Parameter(name="DATA")],
    rig: FileName,
    free: str,
    each: Text = None,
    bounds: Pairs = (),
    tie: Pairs = (),
    prior: Pairs = (),
    columns: Pairs = (),
    units: Pairs = (),
    group: str | None = None,
    decimal: Literal[".", ","] | None = None,
    noise: float | None = None,
    compare: Text = None,
    bootstrap: Whole,
    window: Whole | None = None,
    steady: Flag = False,
    changes: RigOptions = AS_DESCRIBED,
    seed: Annotated[Whole, Parameter(group=COMPUTATION)],
    starts: Annotated[Whole, Parameter(group=COMPUTATION)],
    threads: Threads = None,
    output: OutputOptions = DEFAULT_OUTPUT,
) -> int:
    """Identify parameters of a rig from stepped-sine curves or time histories.

    Prints the values with their intervals, what the data do not determine, what the model lacks,
    and what to test next. Writes NAME.html and NAME.md with figures, NAME.nc with all numbers, and
    NAME.toml, the fitted rig, which every other command accepts.

    For example:

        vibroimpact identify test.csv --rig B2-G1-A3 --free stiffness,damping,gap
        vibroimpact identify up.csv down.csv --rig study.toml --free gap --compare hertz
        vibroimpact identify shaken.mat --rig study.toml --free right-gap,left-gap

    Parameters
    ----------
    data
        Files of tests: CSV, MAT, HDF5, UFF58, TDMS or NetCDF.
    rig
        Case code or study file of the rig, with a guess of the free parameters.
    free
        Parameters that are fitted, such as stiffness,damping,bumper-stiffness,gap.
    bounds
        Bounds of a free parameter, NAME LOW:HIGH; may be repeated.
    tie
        Tie one parameter to another, such as left-gap right-gap; may be repeated.
    prior
        Prior knowledge of a free parameter, NAME MEAN:DEVIATION; may be repeated.
    columns
        Column that holds a variable, such as displacement-excursion 'channel 3'; may be repeated.
    units
        Unit of a variable or column, such as displacement-excursion mm; may be repeated.
    group
        Name of the test, if a file holds several. Default: the only test.
    decimal
        Decimal mark of a table. Default: the one that the table shows.
    compare
        Other models that are also fitted: hertz, softening or hertz,softening. Default: none.
    """
    from vibroimpact.cli.output import progress_bar, tell
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.identification.model_selection import OWN_MODEL, fit_models
    from vibroimpact.reports.fit_summary import fit_summary

    if not data:
        raise InputError("DATA: missing; the file of a test is accepted")
    reading: dict[str, Any] = {
        "columns": by_name("--columns", columns),
        "units": by_name("--units", units),
        "group": group,
        "amplitude": changes.amplitude,
        "decimal": decimal,
    }
    tests = [vi.read_measurement(path, **reading) for path in data]
    what = subject(rig, changes, output.name, _shaken(tests))
    names = [name.strip().replace("-", "_") for name in free.split(",")]
    limits = {name: _pair(text, "--bounds") for name, text in by_name("--bounds", bounds).items()}
    if strange := set(limits) - set(names):
        raise InputError(f"--bounds: {sorted(strange)[0]!r} is not free; {free} is accepted")
    with results(what, output) as written:
        fits = fit_models(
            _rig(what),
            tests,
            {name: limits.get(name) for name in names},
            [name.strip() for name in compare.split(",")] if compare else [],
            each=[name.strip() for name in each.split(",")] if each else [],
            ties=by_name("--tie", tie),
            priors={name: _pair(text, "--prior") for name, text in prior},
            noise=noise,
            window=window,
            steady=steady,
            seed=seed,
            starts=starts,
            threads=threads,
            draws=bootstrap,
            bar=progress_bar,
        )
        reported = {"": fits.own}
        if fits.best_name != OWN_MODEL:
            reported[fits.best_name] = fits.best
        for model, fit in reported.items():
            name = f"{what.slug}-fit-{model}".removesuffix("-")
            files = {"data": vi.save(fit, written.folder / f"{name}.nc")}
            files |= vi.fit_report(
                fit, written.folder.path, name, comparison=fits.comparison, figure=output.figure
            )
            written.files |= {f"{model}: {key}".removeprefix(": "): files[key] for key in files}
    text, facts = fit_summary(fits, tests)
    tell(text, facts, written.folder, written.files, output.json)
    return 0


def _shaken(tests: list[xr.Dataset]) -> vi.Harmonic | None:
    """Return the shaking of the base that the files state; None if one does not state it."""
    if any("amplitude" not in t.attrs and "base_acceleration" not in t for t in tests):
        return None
    return vi.Harmonic(float(tests[0].attrs.get("amplitude", 1.0)), 1.0)


def _rig(what: Subject) -> vi.Rig | vi.Oscillator:
    """Return the rig; without its shaking unless that is one sine of the base acceleration."""
    shaking = what.shaking
    if isinstance(shaking, vi.Harmonic) and shaking.of == "acceleration":
        return vi.Rig(what.oscillator, shaking.amplitude)
    return what.oscillator


def _pair(text: str, option: str) -> tuple[str, str]:
    low, mark, high = text.partition(":")
    if not mark:
        raise InputError(f"{option}: {text!r}; two values with a colon between them are accepted")
    return low, high
