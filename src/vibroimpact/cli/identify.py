"""``vibroimpact identify``: parameters of a rig from measurements, with a report."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Group, Parameter

from vibroimpact.cli.options import COMPUTATION, OutputOptions, RigOptions, Whole
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import Harmonic

_FIT = Group("Fit", sort_key=1)
_TEXT = Parameter(group=_FIT, allow_leading_hyphen=True)
_PAIRS = Parameter(group=_FIT, allow_leading_hyphen=True, negative="", show_default=False)
_MODELS = ("hertz", "softening")


def identify(
    *data: Annotated[
        str,
        Parameter(name="DATA", help="Files of tests: CSV, MAT, HDF5, UFF58, TDMS or NetCDF."),
    ],
    rig: Annotated[
        str,
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
    from vibroimpact.measurement.read import read_measurement

    out = output or OutputOptions()
    if not data:
        raise InputError("DATA: missing; the file of a test is accepted")
    named = {key.replace("-", "_"): value for key, value in columns}
    in_units = {key.replace("-", "_") if key.replace("-", "_") else key: v for key, v in units}
    tests = [read_measurement(path, columns=named, units=in_units, group=group) for path in data]
    what = subject(rig, changes or RigOptions(), out.name, _shaken(tests))
    asked: dict[str, Any] = {
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
    names = [name.strip().replace("-", "_") for name in free.split(",")]
    limits = {name.replace("-", "_"): _pair(text, "--bounds") for name, text in bounds}
    if strange := set(limits) - set(names):
        raise InputError(f"--bounds: {sorted(strange)[0]!r} is not free; {free} is accepted")
    wanted = {name: limits.get(name) for name in names}
    others = [name.strip() for name in compare.split(",")] if compare else []
    if strange := set(others) - set(_MODELS):
        raise InputError(f"--compare: {sorted(strange)[0]!r}; hertz and softening are accepted")
    if changes and changes.amplitude is not None:
        asked["amplitude"] = changes.amplitude

    with output_folder(out.output) as folder:
        from vibroimpact.identification.comparison import compare_fits
        from vibroimpact.identification.identify import identify as run
        from vibroimpact.reporting.identification import fit_report
        from vibroimpact.response.files import save

        subject_rig = _rig(what)
        with progress_bar("fitting") as progress:
            found = run(tests, subject_rig, wanted, draws=bootstrap, progress=progress, **asked)
        comparison = None
        if others:
            fits = {"as given": found}
            for other in others:
                fits[other] = _other(other, found, tests, wanted, asked)
            comparison = compare_fits(fits)
        name = f"{what.slug}-fit"
        files = {"data": save(found, folder / f"{name}.nc")}
        files |= fit_report(found, folder.path, name, comparison=comparison, figure=out.figure)
    text, facts = _summary(found, tests, comparison)
    tell(text, facts, folder, files, out.json)
    return 0


def _shaken(tests: list[xr.Dataset]) -> Harmonic | None:
    """What the files themselves say of the base; None where one of them leaves it open."""
    from vibroimpact.model import Harmonic

    if any("amplitude" not in t.attrs and "base_acceleration" not in t for t in tests):
        return None
    return Harmonic(float(tests[0].attrs.get("amplitude", 1.0)), 1.0)


def _rig(what: Subject) -> Any:
    """The rig; with its shaking where that is one sine."""
    from vibroimpact.model import Harmonic, Rig

    if isinstance(what.shaking, Harmonic) and what.shaking.of == "acceleration":
        return Rig(what.oscillator, what.shaking.amplitude)
    return what.oscillator


def _pair(text: str, option: str) -> tuple[str, str]:
    low, mark, high = text.partition(":")
    if not mark:
        raise InputError(f"{option}: {text!r}; two values with a colon between them are accepted")
    return low, high


def _other(
    name: str, found: xr.Dataset, tests: list[xr.Dataset], wanted: dict[str, Any], asked: Any
) -> xr.Dataset:
    """The same data fitted by another model, begun from the first fit."""
    from vibroimpact.identification.comparison import hertzian, softening
    from vibroimpact.identification.identify import fitted
    from vibroimpact.identification.identify import identify as run
    from vibroimpact.model import Rig

    test = str(found["test"].values[0])
    rig = fitted(found, test)
    sought = dict.fromkeys(wanted)
    if name == "hertz":
        made = hertzian(rig.oscillator, _depth(found, rig.oscillator))
        sought = {
            key.replace("bumper_damping", "dissipation").replace(
                "right_damping", "right_dissipation"
            ).replace("left_damping", "left_dissipation"): None
            for key in sought
        }  # fmt: skip
    else:
        made = softening(rig.oscillator)
        sought["cubic"] = None
    keys = {key: value for key, value in asked.items() if key not in ("priors", "starts")}
    return run(tests, Rig(made, rig.amplitude), sought, profiles=False, starts=2, tried=16, **keys)


def _depth(found: xr.Dataset, oscillator: Any) -> float:
    """How far the mass goes into a stop (m), about: half the largest excursion less the gap."""
    import numpy as np

    gap = min(float(stop.gap) for stop in oscillator.stops)
    variable = found["point_variable"].values
    swing = found["measured_value"].values[variable == "displacement_excursion"]
    reach = 0.5 * float(np.nanmax(swing)) if len(swing) else 1.5 * gap
    return max(0.7 * (reach - gap), 1e-4 * max(gap, 1e-3))


def _summary(
    found: xr.Dataset, tests: list[xr.Dataset], comparison: xr.Dataset | None
) -> tuple[Any, dict[str, Any]]:
    from rich.console import Group as Together
    from rich.table import Table
    from rich.text import Text

    from vibroimpact.identification.advice import next_test
    from vibroimpact.reporting.identification import amplitude_of, parameter_rows

    table = Table(box=None, pad_edge=False, padding=(0, 2))
    share = f"{100.0 * float(found.attrs['confidence']):g} % interval"
    for head in ("parameter", "value", "standard error", share):
        table.add_column(head)
    rows = parameter_rows(found)
    for row in rows:
        table.add_row(*row[:4])
    notes = [line for test in tests for line in _notes(test, many=len(tests) > 1)]
    names = [str(test) for test in found["test"].values]
    amplitudes = {name: amplitude_of(found, name) for name in names}
    findings = found.attrs["findings"].splitlines()
    advice = next_test(found).attrs["findings"].splitlines()
    compared = [] if comparison is None else comparison.attrs["findings"].splitlines()
    lines = [*findings, *compared, *advice]
    parts: list[Any] = [Text(f"amplitude of {name}: {told}") for name, told in amplitudes.items()]
    parts += [Text(), table, Text(), *(Text(f"- {line}") for line in lines)]
    if notes:
        parts += [Text(), Text("Reading"), *(Text(f"- {line}") for line in notes)]
    facts = {
        "parameters": {
            str(key): {
                "value": float(found["fitted_value"].sel(parameter=key)),
                "standard_error": float(found["standard_error"].sel(parameter=key)),
                "interval": found["interval"].sel(parameter=key).values.tolist(),
            }
            for key in found["parameter"].values
        },
        "amplitudes": amplitudes,
        "findings": findings,
        "comparison": compared,
        "next": advice,
        "reading": notes,
    }
    return Together(*parts), facts


def _notes(test: xr.Dataset, *, many: bool) -> list[str]:
    """What reading a test told; with the file's name where there are several."""
    source = test.attrs.get("source", "")
    lines = test.attrs.get("notes", "").splitlines()
    return [
        line if not many or line.startswith(f"{source}: ") else f"{source}: {line}"
        for line in lines
    ]
