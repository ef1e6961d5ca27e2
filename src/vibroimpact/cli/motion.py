"""``vibroimpact motion``: what a rig settles on at one frequency, and what kind of motion it is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Group, Parameter

from vibroimpact.cli.options import OutputOptions, RigName, RigOptions, Whole
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import Repeated

_MOTION = Group("Motion", sort_key=1)
_WITH_UNITS = Parameter(group=_MOTION, allow_leading_hyphen=True)

MOST_COLUMNS = 6
"""Columns that fit on a page."""

SECTION_POINTS = 5000
"""Of a motion that does not settle."""


def motion(
    rig: RigName,
    /,
    *,
    frequency: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(help="Excitation frequency, such as 0.58Hz; or a list, 0.58Hz,0.8Hz,2.6Hz."),
    ] = None,
    branch: Annotated[
        Literal["forward", "backward", "all"],
        Parameter(
            group=_MOTION,
            help=(
                "The motion where a forward sweep arrives, or a backward one, or all that are "
                "found from sweeps, rest and random starts."
            ),
        ),
    ] = "all",
    random: Annotated[
        Whole, Parameter(group=_MOTION, help="How many random starts for --branch all.")
    ] = 12,
    window: Annotated[
        Whole,
        Parameter(group=_MOTION, help="Cycles recorded of a motion that does not settle."),
    ] = 200,
    samples: Annotated[
        Whole, Parameter(group=_MOTION, help="Samples per cycle; no other value depends on it.")
    ] = 256,
    changes: RigOptions | None = None,
    output: OutputOptions | None = None,
) -> int:
    """Find the steady motions at a frequency; say what they are; show them on one page.

    Prints for each motion its kind (periodic, quasi-periodic, chaotic or undecided) with the
    evidence, its extremes and its contacts; writes NAME-FREQUENCY-motion.nc (a group for each
    motion: samples, contacts, spectrum and section) and NAME-FREQUENCY-motion.png (portrait,
    spectrum and time histories).

    For example:

        vibroimpact motion B2-G1-A3 --frequency 2.6Hz
        vibroimpact motion B3-10mm-A3 --frequency 1.06Hz --branch forward
        vibroimpact motion B2-G1-A3 --frequency 0.58Hz,0.8Hz,2.6Hz --output figure8
    """
    from vibroimpact.cli.output import output_folder, tell, warn
    from vibroimpact.cli.rig import subject

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    shaken = excitations(what, frequency)
    _check(random, window, samples)

    with output_folder(out.output) as folder:
        import warnings

        from rich.console import Group as Together

        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.facts import motions as verdict
        from vibroimpact.figures import motion_page, save_figure

        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", RuntimeWarning)
            found = {
                excitation.frequency: _found(what, excitation, branch, random, window, samples)
                for excitation in shaken
            }
        for message in dict.fromkeys(str(warning.message) for warning in caught):
            warn(message)
        drawn = {
            hertz: {name: data for name, data in motions.items() if data.sizes["time"]}
            for hertz, motions in found.items()
        }
        if not all(drawn.values()):
            raise InputError(
                "--frequency: no motion was found; another rig or frequency is accepted"
            )
        for motions in drawn.values():
            for data in motions.values():
                data.attrs["title"] = what.name
        stem = folder / f"{what.slug}-{'-'.join(f'{hertz:.10g}Hz' for hertz in found)}-motion"
        axes = motion_page(_columns(drawn), title=what.title)
        files = {
            "data": save(_groups(drawn), f"{stem}.nc"),
            "figure": save_figure(axes[0, 0], f"{stem}.{out.figure}"),
        }
    facts = {**summary.rig_facts(what), "motions": verdict.facts(found)}
    text = Together(summary.rig_text(what), verdict.text(found))
    tell(text, facts, folder, files, out.json)
    return 0


def excitations(what: Subject, frequency: str | None) -> list[Repeated]:
    """The excitations asked for, from the option or the study.

    Raises
    ------
    InputError
        If there is none, or one cannot be used.
    """
    from vibroimpact.model import to_si
    from vibroimpact.model.quantities import FREQUENCY

    if frequency is not None:
        hertz = [
            to_si(part.strip(), FREQUENCY, "--frequency", above=0.0)
            for part in frequency.split(",")
        ]
    elif what.study is not None and what.study.simulate.frequency is not None:
        hertz = [what.study.simulate.frequency]
    else:
        raise InputError("--frequency: missing; a frequency greater than 0 is accepted, as 0.58Hz")
    if len({f"{value:.6g}" for value in hertz}) < len(hertz):
        raise InputError(
            f"--frequency: {frequency!r} names one twice; frequencies that differ in their first "
            "six digits are accepted"
        )
    if len(hertz) > MOST_COLUMNS:
        raise InputError(f"--frequency: {len(hertz)} given; at most {MOST_COLUMNS} are accepted")
    phase = what.study.excitation.phase if what.study else 0.0
    return [what.at(value, phase) for value in hertz]


def _check(random: int, window: int, samples: int) -> None:
    for option, value, least in (
        ("--random", random, 0),
        ("--window", window, 1),
        ("--samples", samples, 1),
    ):
        if value < least:
            raise InputError(f"{option}: {value}; a whole number of at least {least} is accepted")


def _found(
    what: Subject, excitation: Repeated, branch: str, random: int, window: int, samples: int
) -> dict[str, xr.Dataset]:
    """The motions by name, with their spectra and sections."""
    from vibroimpact.cli.output import progress_bar
    from vibroimpact.model.rig import Rig
    from vibroimpact.response.sweep_starts import arrivals
    from vibroimpact.stability.coexisting import find_motions
    from vibroimpact.stability.steady import steady

    if branch == "all":
        motions = find_motions(
            Rig(what.oscillator, excitation), random=random, window=window, samples=samples
        )
        return _named([_complete(data) for data in motions])
    starts = arrivals(Rig(what.oscillator, excitation))
    if f"{branch} branch" not in starts:
        raise InputError(
            f"--branch: no {branch} sweep reaches {excitation.frequency:g} Hz; "
            "'all' is accepted, or a frequency within 0.3 to 6 times the natural frequency"
        )
    start = starts[f"{branch} branch"]
    with progress_bar("following") as progress:
        data = steady(
            Rig(what.oscillator, excitation), start, samples, window=window, progress=progress
        )
    return {f"{branch} branch": _complete(data)}


def _complete(data: xr.Dataset) -> xr.Dataset:
    """Add spectrum and section to a motion."""
    import xarray as xr

    from vibroimpact.datasets.description import motion_parameters
    from vibroimpact.response.sections import stroboscopic_section
    from vibroimpact.response.spectrum import fourier_spectrum

    if not data.sizes["time"]:
        return data
    period = int(data["period"])
    phase = motion_parameters(data)["phase"]
    section = stroboscopic_section(data, phase, period or SECTION_POINTS)
    if float(data["cycle"][-1]) < 1.0:  # it was given up
        lines = xr.Dataset()
    else:
        lines = fourier_spectrum(data)
        data.attrs["spectrum_method"] = lines.attrs["method"]
    return data.assign({str(name): part[name] for part in (section, lines) for name in part})


def _named(motions: list[xr.Dataset]) -> dict[str, xr.Dataset]:
    """Name motions after the sweep that leads to them, or by number."""
    named = {}
    for number, data in enumerate(motions, 1):
        starts = data.attrs["starts"] + ", " + data.attrs["mirrored_starts"]
        sweeps = [way for way in ("forward", "backward") if f"{way} branch" in starts]
        name = f"{' and '.join(sweeps)} branch" if sweeps else f"motion {number}"
        named[name] = data
    return named


def _columns(found: dict[float, dict[str, xr.Dataset]]) -> dict[str, dict[str, xr.Dataset]]:
    """Columns of the page: motions of one frequency, or several frequencies."""
    if len(found) > 1:
        return {f"{hertz:.6g} Hz": motions for hertz, motions in found.items()}
    (hertz, motions), *_ = found.items()
    return {
        f"{hertz:.6g} Hz, {name}": {name: data}
        for name, data in list(motions.items())[:MOST_COLUMNS]
    }


def _groups(found: dict[float, dict[str, xr.Dataset]]) -> dict[str, xr.Dataset]:
    """Groups of the file."""
    several = len(found) > 1
    return {
        f"{hertz:.10g}Hz {name}" if several else name: data
        for hertz, motions in found.items()
        for name, data in motions.items()
    }
