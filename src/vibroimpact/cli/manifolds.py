"""``vibroimpact manifolds``: the curves that bound basins, and those that leave their saddles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Group, Parameter

from vibroimpact.cli.options import COMPUTATION, OutputOptions, RigName, RigOptions, Whole
from vibroimpact.cli.states import StateOptions, state

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import RenderableType

_CURVES = Group("Curves", sort_key=1)


def manifolds(
    rig: RigName,
    /,
    *,
    states: StateOptions | None = None,
    saddle: Annotated[
        tuple[str, ...],
        Parameter(
            group=_CURVES,
            allow_leading_hyphen=True,
            negative="",
            show_default=False,
            help=(
                "Displacement and velocity near a saddle orbit, once or more, such as 5mm,2mm/s; "
                "those to which the borders between basins lead."
            ),
        ),
    ] = (),
    period: Annotated[
        Whole, Parameter(group=_CURVES, help="Period of given saddles, in cycles.")
    ] = 1,
    spacing: Annotated[
        float,
        Parameter(
            group=_CURVES,
            help="Largest distance of neighbours on a curve; each side of the window counts 1.",
        ),
    ] = 0.01,
    longest: Annotated[
        float, Parameter(group=_CURVES, help="Length at which a curve is cut, in the same measure.")
    ] = 30.0,
    nodes: Annotated[
        Whole, Parameter(group=_CURVES, help="States along each axis of the basins in the figure.")
    ] = 300,
    changes: RigOptions | None = None,
    threads: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="How many regions of states at once; one a processor."),
    ] = None,
    output: OutputOptions | None = None,
) -> int:
    """Follow the stable and unstable curves of saddles, and draw them over the basins.

    What begins on a stable curve comes to the saddle: borders of basins are such curves. Unstable
    curves leave it. Prints the saddles, and where the curves cross; writes
    NAME-FREQUENCY-manifolds.nc and NAME-FREQUENCY-manifolds.png.

    For example:

        vibroimpact manifolds B3-10mm-A3 --frequency 0.7Hz
        vibroimpact manifolds B2-G1-A3 --frequency 2.6Hz --longest 5
        vibroimpact manifolds B3-10mm-A3 --frequency 0.7Hz --saddle 5.3mm,2mm/s
    """
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject
    from vibroimpact.model.rig import Rig

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    begun = states or StateOptions()
    excitation, ranges = begun.forcing(what), begun.window()
    near = [
        state("--saddle", text).model_copy(update={"phase": excitation.phase}) for text in saddle
    ]

    with output_folder(out.output) as folder:
        from rich.console import Group as Together

        from vibroimpact.attraction.basins import basins
        from vibroimpact.attraction.manifolds import manifolds as run
        from vibroimpact.cli import summary
        from vibroimpact.datasets.description import motion_parameters
        from vibroimpact.datasets.files import save
        from vibroimpact.figures import basin_portrait, save_figure

        asked = Rig(what.oscillator, excitation)
        with progress_bar("following") as progress:
            data = run(
                asked,
                near or None,
                *ranges,
                period=period,
                spacing=spacing,
                longest=longest,
                threads=threads,
                progress=progress,
            )
            window = [motion_parameters(data)[name] for name in ("displacement", "velocity")]
            below = basins(asked, *window, nodes=nodes, threads=threads, progress=progress)
        data.attrs["title"] = what.name
        stem = folder / f"{what.slug}-{excitation.frequency:.10g}Hz-manifolds"
        title = f"{what.title}, {excitation.frequency:.6g} Hz"
        ax = basin_portrait(below, manifolds=data, title=title)
        files = {
            "data": save(data, f"{stem}.nc"),
            "figure": save_figure(ax, f"{stem}.{out.figure}"),
        }
    facts = {**summary.rig_facts(what), "frequency": excitation.frequency, **_facts(data)}
    tell(Together(summary.rig_text(what), _text(data)), facts, folder, files, out.json)
    return 0


def _facts(data: xr.Dataset) -> dict[str, Any]:
    return {
        "saddles": [
            {
                name: data[f"saddle_{name}"].values[number].item()
                for name in ("displacement", "velocity", "period")
            }
            | {
                f"multiplier_{name}": data[f"multiplier_{name}"].values[number].item()
                for name in ("growing", "dying")
            }
            for number in range(data.sizes["saddle"])
        ],
        "curves": [
            {
                name: data[f"curve_{name}"].values[number].item()
                for name in ("kind", "saddle", "length", "ended")
            }
            for number in range(data.sizes["curve"])
        ],
        "crossings": data.sizes["crossing"],
    }


def _text(data: xr.Dataset) -> RenderableType:
    from collections import Counter

    from rich.console import Group as Together
    from rich.table import Table
    from rich.text import Text

    from vibroimpact.facts.number_format import LENGTHS, SPEEDS, fitting, plain

    facts = _facts(data)
    saddles, curves = facts["saddles"], facts["curves"]
    if not saddles:
        return Text("\nno saddle was found: no border between basins leads to one")
    far = fitting((one["displacement"] for one in saddles), LENGTHS)
    fast = fitting((one["velocity"] for one in saddles), SPEEDS)
    table = Table(box=None, pad_edge=False, padding=(0, 2))
    table.add_column("saddle")
    for heading in (
        f"displacement ({far.symbol})",
        f"velocity ({fast.symbol})",
        "period",
        "multipliers",
    ):
        table.add_column(heading, justify="right")
    for number, one in enumerate(saddles):
        table.add_row(
            str(number + 1),
            plain(one["displacement"] / far.size, 4),
            plain(one["velocity"] / fast.size, 4),
            str(one["period"]),
            f"{one['multiplier_growing']:.4g}, {one['multiplier_dying']:.4g}",
        )
    lines = []
    for kind in ("stable", "unstable"):
        mine = [one for one in curves if one["kind"] == kind]
        ends = Counter(one["ended"] for one in mine)
        length = sum(one["length"] for one in mine)
        lines.append(f"{kind} curves, {length:.3g} windows long in all:")
        lines += [f"  {count} of {len(mine)}: {why}" for why, count in ends.most_common()]
    crossed = facts["crossings"]
    lines.append(
        f"they cross {crossed} times: motions wander as if chaotic before they settle"
        if crossed
        else "they do not cross"
    )
    return Together(Text(), table, Text(), Text("\n".join(lines)))
