"""``vibroimpact record``: what is in the file of a record, and its response spectrum."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group, Parameter

from vibroimpact.cli.options import (
    READING,
    FileName,
    OutputOptions,
    RecordOptions,
    Whole,
    record_name,
)
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    from rich.console import RenderableType

    from vibroimpact.model import Record

_CHANGES = Group("Changes (in this order)", sort_key=2)
_SPECTRUM = Group("Response spectrum", sort_key=3)
_TEXT = Parameter(allow_leading_hyphen=True)


def record(
    file: Annotated[
        FileName, Parameter(name="FILE", help="The record's file, packed by gzip or not.")
    ],
    /,
    *,
    station: Annotated[str | None, Parameter(group=READING, help="Name of the station.")] = None,
    label: Annotated[str | None, Parameter(group=READING, help="Name of the component.")] = None,
    start: Annotated[
        str | None, _TEXT, Parameter(group=_CHANGES, help="Where it is cut off before, as 5s.")
    ] = None,
    end: Annotated[
        str | None, _TEXT, Parameter(group=_CHANGES, help="Where it is cut off behind, as 25s.")
    ] = None,
    baseline: Annotated[
        Literal["mean", "line"] | None,
        Parameter(group=_CHANGES, help="What is taken away: its mean, or the line that fits it."),
    ] = None,
    scale: Annotated[
        str | None, _TEXT, Parameter(group=_CHANGES, help="Number that it is multiplied by.")
    ] = None,
    peak: Annotated[
        str | None, _TEXT, Parameter(group=_CHANGES, help="Its peak instead, such as 0.3g.")
    ] = None,
    damping: Annotated[
        str, _TEXT, Parameter(group=_SPECTRUM, help="Damping ratios, such as 0,0.02,0.05.")
    ] = "0.05",
    shortest: Annotated[
        str, _TEXT, Parameter(group=_SPECTRUM, help="Shortest natural period.")
    ] = "10ms",
    longest: Annotated[
        str, _TEXT, Parameter(group=_SPECTRUM, help="Longest natural period.")
    ] = "10s",
    periods: Annotated[
        Whole, Parameter(group=_SPECTRUM, help="How many periods, evenly apart in logarithm.")
    ] = 200,
    reading: RecordOptions | None = None,
    output: OutputOptions | None = None,
) -> int:
    """Read a record, say what it is, and draw it with its response spectrum.

    PEER AT2, COSMOS, CSMIP, SMC, GeoNet, K-NET, ESM, columns of numbers; SAC and miniSEED where
    obspy is installed. Writes NAME-record.nc (groups record and spectrum) and NAME-record.png.

    For example:

        vibroimpact record RSN763_LOMAP_GIL067.AT2
        vibroimpact record CE89146.V1 --component Up --damping 0.02,0.05,0.1
        vibroimpact record quake.csv --unit g --step 10ms --baseline mean --peak 0.3g
    """
    from vibroimpact.cli.output import output_folder, tell
    from vibroimpact.model import Record, to_si
    from vibroimpact.model.names import check_name, file_stem, literal
    from vibroimpact.model.quantities import DIMENSIONLESS, TIME

    out, how = output or OutputOptions(), reading or RecordOptions()
    called = check_name(out.name, "--name") if out.name else None
    ratios = [to_si(part, DIMENSIONLESS, "--damping") for part in damping.split(",")]
    first = to_si(shortest, TIME, "--shortest", above=0.0)
    last = to_si(longest, TIME, "--longest", above=0.0)
    if not first < last:
        raise InputError(f"--longest: {longest}; a period longer than {shortest} is accepted")
    if periods < 2:
        raise InputError(f"--periods: {periods}; a whole number of at least 2 is accepted")
    found = Record.read(file, how.component, station=station, label=label, **how.said())
    if start is not None or end is not None:
        found = found.cut(start or 0.0, end)
    if baseline is not None:
        found = found.levelled(baseline)
    if scale is not None or peak is not None:
        found = found.scaled(_by(scale), peak=peak)

    with output_folder(out.output) as folder:
        import numpy as np

        from vibroimpact.datasets.files import save
        from vibroimpact.figures import accelerogram, save_figure
        from vibroimpact.response.record_dataset import accelerogram as as_dataset
        from vibroimpact.response.response_spectrum import response_spectrum

        spectrum = response_spectrum(found, np.geomspace(first, last, periods), ratios)
        name = record_name(file, how.component)
        stem = folder / f"{file_stem(called or name.replace(' ', '-'))}-record"
        about = found.about
        where = ", ".join(part for part in (about.station, about.component) if part)
        axes = accelerogram(found, spectrum, title=literal(called or where or name))
        files = {
            "data": save({"record": as_dataset(found), "spectrum": spectrum}, f"{stem}.nc"),
            "figure": save_figure(axes[0], f"{stem}.{out.figure}"),
        }
    facts = _facts(found, spectrum)
    tell(_text(found, facts), facts, folder, files, out.json)
    return 0


def _by(scale: str | None) -> str | float:
    return 1.0 if scale is None else scale


def _facts(found: Record, spectrum: Any) -> dict[str, Any]:
    """The record and the largest of its spectrum, in SI units."""
    import numpy as np

    from vibroimpact._version import __version__

    largest = []
    for i, ratio in enumerate(spectrum["damping_ratio"].values):
        curve = spectrum["pseudo_acceleration"].isel(damping_ratio=i).values
        at = int(np.argmax(curve))
        period = float(spectrum["natural_period"].values[at])
        largest.append(
            {"damping": float(ratio), "pseudo_acceleration": float(curve[at]), "period": period}
        )
    return {
        "vibroimpact_version": __version__,
        **found.about._asdict(),
        "samples": len(found.acceleration),
        "step": found.step,
        "duration": found.duration,
        "peak": found.peak,
        "peak_time": found.peak_time,
        "largest": largest,
    }


def _text(found: Record, facts: dict[str, Any]) -> RenderableType:
    """What was read, a line each."""
    from rich.console import Group as Together
    from rich.text import Text

    from vibroimpact.facts.number_format import plain
    from vibroimpact.facts.tables import plain_table
    from vibroimpact.model import GRAVITY
    from vibroimpact.model.quantities import TIME
    from vibroimpact.model.units import pretty

    about = found.about
    table = plain_table()
    table.add_row("format", f"{about.format}, values in {about.unit}", "")
    for name in ("station", "component"):
        table.add_row(name, getattr(about, name) or "not stated", "")
    step = pretty(found.step, TIME)
    lasts = f"{plain(found.duration, 7)} s"
    table.add_row("samples", f"{facts['samples']} × {step}", lasts)
    peak = f"{plain(found.peak, 6)} m/s² = {plain(found.peak / GRAVITY, 5)} g"
    table.add_row("peak", peak, f"at {plain(found.peak_time, 7)} s")
    for one in facts["largest"]:
        size = f"{plain(one['pseudo_acceleration'], 5)} m/s²"
        table.add_row(
            f"spectrum, ζ = {plain(one['damping'], 4)}",
            f"pseudo-acceleration at most {size}",
            f"at T = {plain(one['period'], 4)} s",
        )
    for i, note in enumerate(about.notes):
        table.add_row("" if i else "note", note, "")
    return Together(Text(about.source, style="bold"), table)
