"""``vibroimpact earthquake``: the response of a rig to records of ground motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.cli import options as opt
from vibroimpact.cli.function_options import calls
from vibroimpact.cli.records import (
    AS_STATED,
    Peak,
    RecordOptions,
    Scale,
    record_of_study,
    record_stems,
    records_of_design,
    scale_records,
)

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.results import Results

_FLOORS = 24
"""Largest number of floor spectra in a figure. Of more masses, every second or third is drawn."""


@calls("seismic_response", "Motion")
def earthquake(
    rig: opt.RigName,
    /,
    *records: Annotated[opt.FileName, Parameter(name="RECORD")],
    scale: Scale = None,
    peak: Peak = None,
    tail: opt.Text = None,
    samples: opt.Whole = 4,
    reading: RecordOptions = AS_STATED,
    changes: opt.RigOptions = opt.AS_DESCRIBED,
    output: opt.OutputOptions = opt.DEFAULT_OUTPUT,
) -> int:
    """Shake a rig with earthquake records, and report whether and how hard it hits its stops.

    The motion starts from rest. The command writes these files (--name sets NAME):

    - NAME-earthquake.csv: a table of the results, with a row for each record
    - NAME-RECORD-earthquake.png: a page of figures for each record
    - NAME-RECORD-earthquake.nc: a file for each record, with four NetCDF groups: response (peak
      values and energies), motion (time history), ground (response spectrum of the record) and
      floor (response spectrum of the acceleration of the mass)

    For a rig of several masses (table [assembly] of a study file), the figures of each record show
    displacements, accelerations and contact forces, and the largest values over the order of the
    masses, and the response spectra of the ground and of each mass, which are those of the group
    floor.

    For example:

        vibroimpact earthquake B2-G1-A3 RSN763_LOMAP_GIL067.AT2 --scale 0.2
        vibroimpact earthquake wall.toml quake.AT2 other.V2 --component 1 --peak 0.3g --gap 40mm
        vibroimpact earthquake quake.toml --tail 20s

    Parameters
    ----------
    records
        Files of earthquake records. For the formats, see vibroimpact record. Default: the records
        in the study file.
    tail
        Duration of free vibration after each record, such as 10s. Default: two natural periods of
        the mass, computed with the smallest stiffness of the isolator's force law. For several
        masses, the default is two of the longest natural periods.
    samples
        Number of samples of the motion per time step of a record, in the figures and files. This
        number affects the response spectrum of the mass. It does not affect the reported largest
        displacements, accelerations and forces.
    """
    from vibroimpact.cli.assembly import response_table
    from vibroimpact.cli.results import results
    from vibroimpact.cli.rig import subject
    from vibroimpact.earthquakes.earthquake_response import earthquake_response
    from vibroimpact.facts import earthquake as facts
    from vibroimpact.model.argument_types import whole

    named_records = reading.read(records or records_of_design(rig, with_own_record=False))
    first = next(iter(named_records.values()), None)
    what = subject(rig, changes, output.name, shaken=first, masses=True)
    shaking = scale_records(named_records or record_of_study(what), scale, peak)
    samples = whole(samples, "samples")
    stems = record_stems(shaking)
    show = _show_masses if what.system.by_mass else _show
    text: list[Any] = []
    record_facts: list[dict[str, Any]] = []
    responses = {}
    with results(what, output) as written:
        for name, record in shaking.items():
            shaken = vi.Rig(what.system, record)
            with written.progress("simulating") as progress:
                groups = earthquake_response(shaken, tail=tail, samples=samples, progress=progress)
            ending = f"{stems[name]}-earthquake"
            written.files[f"data of {name}"] = vi.save(groups, written.path(ending, "nc"))
            responses[name] = groups["response"]
            values, lines = show(written, name, shaken, groups, ending, tail)
            record_facts.append(values)
            text += lines
        join = response_table if what.system.by_mass else facts.together
        path = vi.save(join(responses), written.path("earthquake", "csv"))
        written.files = {"table": path, **written.files}
    return written.tell({"records": record_facts}, *text, shaking=False)


def _show(
    written: Results,
    name: str,
    shaken: vi.Rig,
    groups: dict[str, xr.Dataset],
    ending: str,
    tail: str | None,
) -> tuple[dict[str, Any], list[Any]]:
    """Draw the motion of one mass through a record, and return its facts and their text."""
    from rich.text import Text as Line

    from vibroimpact.earthquakes.earthquake_response import response_without_stops
    from vibroimpact.facts import earthquake as facts
    from vibroimpact.model.names import literal

    with written.progress("simulating") as progress:
        free = response_without_stops(shaken, tail=tail, progress=progress)
    spectra = {"ground": groups["ground"], "mass": groups["floor"]}
    title = f"{written.what.title}\n{literal(name)}"
    page = figures.earthquake_page(groups["motion"], spectra, title=title)
    written.draw(f"figure of {name}", ending, page)
    about = (name, shaken.record, groups["response"], shaken.oscillator, free)
    return facts.facts(*about), [Line(), facts.text(*about)]


def _show_masses(
    written: Results,
    name: str,
    shaken: vi.Rig,
    groups: dict[str, xr.Dataset],
    ending: str,
    _tail: str | None,
) -> tuple[dict[str, Any], list[Any]]:
    """Do what `_show` does for several masses."""
    from rich.text import Text as Line

    from vibroimpact.cli.assembly import between_masses, draw_motion
    from vibroimpact.facts import assembly as facts
    from vibroimpact.model.names import literal
    from vibroimpact.model.quantities import ACCELERATION
    from vibroimpact.model.units import pretty

    title, motion = f"{written.what.title}\n{literal(name)}", groups["motion"]
    drawn = figures.mass_histories(motion, closing=between_masses(written.what), title=title)
    written.draw(f"displacements of {name}", f"{ending}-displacements", drawn)
    draw_motion(written, motion, ending, title, None, of=f" of {name}")
    masses = groups["floor"]["mass"].values.tolist()
    shown = masses[:: -(-len(masses) // _FLOORS)]
    floors = {mass: groups["floor"].sel(mass=mass) for mass in shown}
    spectra = {"ground": groups["ground"], **floors}
    curves = figures.response_spectra(spectra, quantity="spectral_acceleration", title=title)
    written.draw(f"spectra of {name}", f"{ending}-spectra", curves)
    peak = shaken.record.peak
    summary = {
        "record": name,
        "peak": peak,
        **facts.motion_facts(motion),
        "floor_spectra": facts.floor_facts(groups["floor"]),
    }
    heading = Line(f"{name}, peak {pretty(peak, ACCELERATION, 4)}", style="bold")
    text = [Line(), heading, facts.motion_text(summary)]
    return summary, [*text, Line(), facts.floor_text(summary["floor_spectra"])]
