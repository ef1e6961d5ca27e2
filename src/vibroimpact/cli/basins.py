"""``vibroimpact basins``: which initial states lead to which motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Group, Parameter

from vibroimpact.cli.options import COMPUTATION, OutputOptions, RigName, RigOptions, Where, Whole
from vibroimpact.cli.states import StateOptions

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import RenderableType

_BASINS = Group("Basins", sort_key=1)


def basins(
    rig: RigName,
    /,
    *,
    states: StateOptions | None = None,
    nodes: Annotated[Whole, Parameter(group=_BASINS, help="States along each axis.")] = 400,
    refine: Annotated[
        Whole,
        Parameter(group=_BASINS, help="How often the grid is made twice as dense beside borders."),
    ] = 0,
    changes: RigOptions | None = None,
    threads: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="How many regions at once; one a processor."),
    ] = None,
    where: Where = "threads",
    output: OutputOptions | None = None,
) -> int:
    """Map which initial states lead to which steady motion at a frequency.

    Motions are found as states lead to them. Prints each with the share of its states, and how the
    basins are mixed; writes NAME-FREQUENCY-basins.nc and NAME-FREQUENCY-basins.png.

    For example:

        vibroimpact basins B3-10mm-A3 --frequency 0.7Hz
        vibroimpact basins B3-10mm-A3 --frequency 1.06Hz --nodes 1000
        vibroimpact basins B2-G1-A3 --frequency 2.6Hz --displacement -20mm:20mm --velocity -1:1
    """
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject
    from vibroimpact.model.rig import Rig

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    begun = states or StateOptions()
    excitation, ranges = begun.forcing(what), begun.window()

    with output_folder(out.output) as folder:
        from rich.console import Group as Together

        from vibroimpact.attraction.basins import basins as run
        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.figures import basin_portrait, save_figure

        with progress_bar("following") as progress:
            data = run(
                Rig(what.oscillator, excitation),
                *ranges,
                nodes=nodes,
                refine=refine,
                threads=threads,
                where=where,
                progress=progress,
            )
        data.attrs["title"] = what.name
        stem = folder / f"{what.slug}-{excitation.frequency:.10g}Hz-basins"
        ax = basin_portrait(data, title=f"{what.title}, {excitation.frequency:.6g} Hz")
        files = {
            "data": save(data, f"{stem}.nc"),
            "figure": save_figure(ax, f"{stem}.{out.figure}"),
        }
    facts = {**summary.rig_facts(what), "frequency": excitation.frequency, **_facts(data)}
    tell(Together(summary.rig_text(what), _text(data)), facts, folder, files, out.json)
    return 0


_MEASURES = (
    "basin_entropy",
    "border_entropy",
    "uncertainty_exponent",
    "uncertainty_exponent_error",
)
_OF_A_MOTION = (
    "motion",
    "period",
    "displacement_excursion",
    "eccentricity",
    "impacts_right",
    "impacts_left",
    "states",
    "share",
    "share_low",
    "share_high",
    "border_distance",
    "mirror_image",
)


def _facts(data: xr.Dataset) -> dict[str, Any]:
    motions = [
        {name: data[name].values[number].item() for name in _OF_A_MOTION}
        for number in range(data.sizes["attractor"])
    ]
    labels = data["basin"].values
    return {
        "motions": motions,
        "states": int(labels.size),
        "given_up": int((labels == -1).sum()),
        "lattice": data.attrs["lattice"],
        **{name: float(data[name]) for name in _MEASURES},
    }


def _text(data: xr.Dataset) -> RenderableType:
    import math

    from rich.console import Group as Together
    from rich.table import Table
    from rich.text import Text

    from vibroimpact.facts.number_format import LENGTHS, fitting, plain

    facts = _facts(data)
    motions = facts["motions"]
    unit = fitting((one["displacement_excursion"] for one in motions), LENGTHS)
    table = Table(box=None, pad_edge=False, padding=(0, 2))
    for heading in (
        "motion",
        "kind",
        "period",
        f"excursion ({unit.symbol})",
        "share",
        "95% interval",
        f"to the border ({unit.symbol})",
    ):
        table.add_column(heading, justify="left" if heading in ("motion", "kind") else "right")
    for number, one in enumerate(motions):
        far = one["border_distance"]
        table.add_row(
            str(number + 1),
            one["motion"],
            str(one["period"]) if one["period"] else "",
            plain(one["displacement_excursion"] / unit.size, 4),
            f"{one['share']:.1%}",
            f"{one['share_low']:.1%} to {one['share_high']:.1%}",
            plain(far / unit.size, 3) if math.isfinite(far) else "",
        )
    lines = [f"{facts['lattice']}; states that were given up: {facts['given_up']}"]
    if math.isfinite(facts["uncertainty_exponent"]):
        lines.append(
            f"uncertainty exponent {facts['uncertainty_exponent']:.3f} ± "
            f"{facts['uncertainty_exponent_error']:.3f} (1 of a smooth border), basin entropy "
            f"{facts['basin_entropy']:.3f}, on borders {facts['border_entropy']:.3f}"
        )
    return Together(Text(), table, Text(), Text("\n".join(lines)))
