"""``vibroimpact identify``: identify parameters of a rig from measurements, and write a report."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr


@calls("identify", "Fit", tie="ties", prior="priors", bootstrap="draws")
def identify(
    *data: Annotated[opt.FileName, Parameter(name="DATA")],
    rig: opt.FileName,
    free: str,
    each: opt.Text = None,
    bounds: opt.Pairs = (),
    tie: opt.Pairs = (),
    prior: opt.Pairs = (),
    columns: opt.Pairs = (),
    units: opt.Pairs = (),
    group: str | None = None,
    decimal: Literal[".", ","] | None = None,
    noise: float | None = None,
    compare: opt.Text = None,
    bootstrap: opt.Whole,
    window: opt.Whole | None = None,
    steady: opt.Flag = False,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    seed: Annotated[opt.Whole, Parameter(group=opt.COMPUTATION)],
    starts: Annotated[opt.Whole, Parameter(group=opt.COMPUTATION)],
    threads: opt.Threads = None,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Identify parameters of a rig from measured resonance curves or time histories.

    The command fits the parameters to the data of one or several tests. It prints:

    - the fitted values with their confidence intervals
    - the parameters that the data do not determine
    - signs that the model is inadequate
    - the next test that would be most informative

    It writes these files (--name sets NAME):

    - NAME-fit.html and NAME-fit.md: the report, with figures
    - NAME-fit.nc: all numbers
    - NAME-fit.toml: the fitted rig as a study file, which other commands accept as the rig

    For example:

        vibroimpact identify test.csv --rig B2-G1-A3 --free isolator.stiffness,gap
        vibroimpact identify up.csv down.csv --rig study.toml --free gap --compare hertz
        vibroimpact identify shaken.mat --rig study.toml --free right.gap,left.gap

    Parameters
    ----------
    data
        Files with the measured data, one file per test, as CSV, MAT, HDF5, UFF58, TDMS or NetCDF.
    rig
        The tested rig: the code of a laboratory case (a rig of the published tests), such as
        B2-G1-A3, or the path of a study file. Its values are the starting values of the free
        parameters.
    free
        Names of the parameters that are fitted (free parameters), separated by commas, such as
        isolator.stiffness,isolator.damping,stops.stiffness,gap. An unknown name lists all.
    each
        Free parameters that are fitted separately for each test, separated by commas, such as gap.
        All other free parameters have the same value in all tests. Default: none.
    bounds
        Bounds of a free parameter, NAME LOW:HIGH, such as gap 5mm:10mm. The option may be repeated.
        Default: none.
    tie
        Two parameters, separated by a space, such as left.gap right.gap. The first parameter is
        kept equal to the second parameter. The option may be repeated. Default: none.
    prior
        Prior knowledge of a free parameter: mean and standard deviation of a normal distribution,
        NAME MEAN:DEVIATION, such as gap 7.5mm:0.2mm. The option may be repeated. Default: none.
    columns
        Name of a variable, and name of the column that contains the variable, such as
        displacement-excursion 'channel 3'. The option may be repeated. An excursion is the maximum
        minus the minimum. Variables of resonance curves: frequency, displacement-excursion,
        acceleration-excursion, displacement-max, displacement-min, acceleration-max,
        acceleration-min. Variables of time histories: time, displacement, velocity, acceleration,
        base-acceleration, base-displacement, mass-displacement, contact-force. Default: the
        variables are detected from the names of the columns.
    units
        Variable or column, and its unit, such as displacement-excursion mm. The option may be
        repeated. Required if the file states no unit. Default: the units in the file.
    group
        Name of the test that is read, if a file contains several tests. Default: the only test in
        the file.
    decimal
        Decimal mark of the numbers in the file, if the file is a text table. Default: detected from
        the table.
    steady
        Treat the time histories as records of steady motions. Each history is then compared with
        the steady motion that the rig reaches from the measured state at the start of the history.
        No initial states are fitted.
    compare
        Other models that are fitted for comparison: hertz (Hertzian contacts), softening (a
        softening isolator) or hertz,softening (both models). Default: none.
    """
    from vibroimpact.cli.output import tell
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.identification.model_selection import OWN_MODEL, fit_models
    from vibroimpact.measurements.read import CALL
    from vibroimpact.reports.fit_summary import fit_summary

    if not data:
        raise InputError("DATA: missing; pass the file of a test, such as test.csv")
    reading: dict[str, Any] = {
        "columns": opt.by_name("--columns", columns),
        "units": opt.by_name("--units", units),
        "group": group,
        "decimal": decimal,
        "amplitude": _base_acceleration(changes.amplitude),
    }
    tests = [vi.read_measurement(path, **reading) for path in data]
    if changes.amplitude is not None:  # replaces the amplitude in the files
        of_option = {"amplitude": changes.amplitude, "amplitude_source": CALL}
        tests = [test.assign_attrs(of_option) for test in tests]
    stated = None if changes.amplitude else _shaking_of_tests(tests)
    what = subject(rig, changes, output.name, otherwise=stated)
    names = [name.strip().replace("-", "_") for name in free.split(",")]
    limits = {
        name: _pair(text, "--bounds") for name, text in opt.by_name("--bounds", bounds).items()
    }
    if strange := set(limits) - set(names):
        raise InputError(
            f"--bounds: {sorted(strange)[0]!r} is not one of the free parameters, {free}; add it "
            "to --free, or remove its bounds"
        )
    with results(what, output) as written:
        fits = fit_models(
            what.oscillator if what.shaking is stated else what.rig,
            tests,
            {name: limits.get(name) for name in names},
            [name.strip() for name in compare.split(",")] if compare else [],
            each=[name.strip() for name in each.split(",")] if each else [],
            ties=opt.by_name("--tie", tie),
            priors={name: _pair(text, "--prior") for name, text in prior},
            noise=noise,
            window=window,
            steady=steady,
            seed=seed,
            starts=starts,
            threads=threads,
            draws=bootstrap,
            bar=written.progress,
        )
        reported = {"": fits.own_fit}
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


def _shaking_of_tests(tests: list[xr.Dataset]) -> vi.Harmonic | None:
    """Return the shaking of the base that the files state, or None if a file does not state it."""
    if any("amplitude" not in t.attrs and "base_acceleration" not in t for t in tests):
        return None
    return vi.Harmonic(float(tests[0].attrs.get("amplitude", 1.0)), 1.0)


def _base_acceleration(amplitude: str | None) -> str | None:
    """Return the amplitude of the option if it is an acceleration, as `read_measurement` takes it.

    An amplitude of a displacement or of a force is written into the tests after they are read.
    """
    from vibroimpact.model.quantities import ACCELERATION
    from vibroimpact.model.units import to_si

    try:
        to_si(amplitude, ACCELERATION, "--amplitude")
    except InputError:
        return None
    return amplitude


def _pair(text: str, option: str) -> tuple[str, str]:
    """Read two values that are separated by a colon.

    Raises
    ------
    InputError
        If there is no colon.
    """
    low, mark, high = text.partition(":")
    if not mark:
        what, example = "the lowest and the highest value", "5mm:8mm"
        if option == "--prior":
            what, example = "a mean and a standard deviation", "7mm:1mm"
        raise InputError(
            f"{option}: {text!r}; pass {what} with a colon between them, such as {example}"
        )
    return low, high
