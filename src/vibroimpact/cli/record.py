"""``vibroimpact record``: the content of a record's file, and its response spectrum."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Group, Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.records import AS_STATED, READING, RecordOptions, record_name, record_stems
from vibroimpact.errors import InputError

_CHANGES = Parameter(group=Group("Changes to the record (applied in this order)", sort_key=2))


@calls("response_spectrum", "Response spectrum", sort_key=3)
def record(
    file: Annotated[opt.FileName, Parameter(name="FILE")],
    /,
    *,
    station: Annotated[str | None, Parameter(group=READING)] = None,
    label: Annotated[str | None, Parameter(group=READING)] = None,
    start: Annotated[opt.Text, _CHANGES] = None,
    end: Annotated[opt.Text, _CHANGES] = None,
    baseline: Annotated[Literal["mean", "line"] | None, _CHANGES] = None,
    scale: Annotated[opt.Text, _CHANGES] = None,
    peak: Annotated[opt.Text, _CHANGES] = None,
    damping: Annotated[str, Parameter(allow_leading_hyphen=True)] = "0.05",
    shortest: Annotated[str, Parameter(allow_leading_hyphen=True)] = "10ms",
    longest: Annotated[str, Parameter(allow_leading_hyphen=True)] = "10s",
    periods: opt.Whole = 200,
    reading: RecordOptions = AS_STATED,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Read an earthquake record, print its properties, and draw it with its response spectrum.

    A record is a measured ground acceleration. The accepted formats are PEER AT2, COSMOS, CSMIP,
    SMC, GeoNet, K-NET, ESM, CWB, CSMNC, NSMN, RENADIC, UNAM, and columns of numbers. SAC and
    miniSEED are accepted if obspy is installed. The command writes these files (--name sets NAME):

    - NAME-record.nc: the record and its response spectrum (NetCDF groups record and spectrum)
    - NAME-record.png: a figure of the record and its response spectrum

    For example:

        vibroimpact record RSN763_LOMAP_GIL067.AT2
        vibroimpact record CE89146.V1 --component Up --damping 0.02,0.05,0.1
        vibroimpact record quake.csv --unit g --step 10ms --baseline mean --peak 0.3g

    Parameters
    ----------
    file
        File of the record. It may be compressed with gzip.
    station
        Name of the station in the results. Default: the name in the file.
    label
        Name of the component (direction) in the results. To choose a component, use --component.
        Default: the name in the file.
    start
        Start time, such as 5s. Earlier samples are dropped. Default: the start of the file.
    end
        End time, such as 25s. Later samples are dropped. Default: the end of the file.
    baseline
        Baseline that is subtracted: mean (the mean of the record) or line (the straight line that
        fits the record best). Default: none.
    scale
        Factor by which the record is multiplied (default: 1).
    peak
        Peak acceleration to which the record is scaled, such as 0.3g. Default: the record is not
        scaled to a peak.
    damping
        Damping ratios for which the spectrum is computed, separated by commas, such as 0,0.02,0.05.
    shortest
        Shortest natural period of the spectrum, such as 20ms.
    longest
        Longest natural period of the spectrum, such as 5s.
    periods
        Number of natural periods of the spectrum. They are evenly spaced on a logarithmic axis.
    """
    import numpy as np

    from vibroimpact.cli.output import output_folder, tell
    from vibroimpact.cli.results import width_of_figures
    from vibroimpact.facts import record as facts
    from vibroimpact.model.argument_types import whole
    from vibroimpact.model.names import check_name, file_stem, literal
    from vibroimpact.model.quantities import DIMENSIONLESS, TIME
    from vibroimpact.model.units import to_si
    from vibroimpact.response.record_dataset import accelerogram

    name = record_name(file, reading.component)
    called = check_name(output.name, "--name") if output.name else None
    ratios = [to_si(part, DIMENSIONLESS, "--damping") for part in damping.split(",")]
    first = to_si(shortest, TIME, "--shortest", above=0.0)
    last = to_si(longest, TIME, "--longest", above=0.0)
    if not first < last:
        raise InputError(
            f"--longest: {longest} is not longer than --shortest, {shortest}; raise --longest or "
            "lower --shortest"
        )
    natural_periods = np.geomspace(first, last, whole(periods, "periods", 2))
    ground_motion = vi.Record.read(
        file, reading.component, station=station, label=label, **reading.arguments()
    )
    if start is not None or end is not None:
        ground_motion = ground_motion.cut(start or 0.0, end)
    if baseline is not None:
        ground_motion = ground_motion.levelled(baseline)
    if scale is not None or peak is not None:
        ground_motion = ground_motion.scaled(1.0 if scale is None else scale, peak=peak)
    with width_of_figures(output), output_folder(output.output) as folder:
        spectrum = vi.response_spectrum(ground_motion, natural_periods, ratios)
        (plain,) = record_stems([name.replace(" ", "-")]).values()
        stem = folder / f"{file_stem(called) if called else plain}-record"
        about = ground_motion.about
        where = ", ".join(part for part in (about.station, about.component) if part)
        axes = figures.accelerogram(ground_motion, spectrum, title=literal(where or name))
        files = {
            "data": vi.save(
                {"record": accelerogram(ground_motion), "spectrum": spectrum}, f"{stem}.nc"
            ),
            "figure": figures.save_figure(axes, f"{stem}.{output.figure}"),
        }
    text = facts.text(ground_motion, spectrum)
    tell(text, facts.facts(ground_motion, spectrum), folder, files, output.json)
    return 0
