"""``vibroimpact basin-stability``: shares of random states by their motion, along a parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Group, Parameter

from vibroimpact.cli.options import COMPUTATION, OutputOptions, RigName, RigOptions, Where, Whole
from vibroimpact.cli.parameters import Largest, Least, Varied, option_range
from vibroimpact.cli.states import StateOptions
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import RenderableType

_SHARES = Group("Shares", sort_key=1)


def basin_stability(
    rig: RigName,
    /,
    *,
    parameter: Annotated[Varied, Parameter(group=_SHARES)] = "frequency",
    start: Annotated[Least, Parameter(group=_SHARES)] = None,
    stop: Annotated[Largest, Parameter(group=_SHARES)] = None,
    steps: Annotated[
        Whole, Parameter(group=_SHARES, help="How many values, both ends included.")
    ] = 25,
    samples: Annotated[
        Whole, Parameter(group=_SHARES, help="Random states, the same ones at each value.")
    ] = 1000,
    seed: Annotated[
        Whole, Parameter(group=_SHARES, help="The same one draws the same states.")
    ] = 0,
    states: StateOptions | None = None,
    changes: RigOptions | None = None,
    threads: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="How many regions of states at once; one a processor."),
    ] = None,
    where: Where = "threads",
    output: OutputOptions | None = None,
) -> int:
    """Say how likely random states lead to each steady motion, along a parameter.

    A motion keeps its number as long as its states lead to one near it at the next value. Prints
    where each is, with its shares; writes NAME-PARAMETER-basin-stability.nc and
    NAME-PARAMETER-basin-stability.png.

    For example:

        vibroimpact basin-stability B2-G1-A3 --from 1.5Hz --to 2.7Hz
        vibroimpact basin-stability B3-10mm-A3 --parameter gap --from 3mm --to 7mm --frequency 0.7Hz
    """
    from vibroimpact.cli.frequency_grid import default_span
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject
    from vibroimpact.model.rig import Rig

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    along = parameter.replace("-", "_")
    span = option_range(
        along,
        start,
        stop,
        ("--from", "--to"),
        default_span(what),
        rig=what.oscillator,
        of=what.repeated.of,
    )
    begun = states or StateOptions()
    shaken, ranges = begun.forcing(what, along), begun.window()
    for option, value, least in (("--steps", steps, 2), ("--samples", samples, 1)):
        if value < least:
            raise InputError(f"{option}: {value}; a whole number of at least {least} is accepted")

    with output_folder(out.output) as folder:
        import numpy as np
        from rich.console import Group as Together

        from vibroimpact.attraction.basin_stability import basin_stability as run
        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.figures import basin_shares, save_figure

        with progress_bar("following") as progress:
            data = run(
                Rig(what.oscillator, shaken),
                *ranges,
                parameter=along,
                values=np.linspace(*span, steps),
                states=samples,
                seed=seed,
                threads=threads,
                where=where,
                progress=progress,
            )
        data.attrs["title"] = what.name
        stem = folder / f"{what.slug}-{along.replace('_', '-')}-basin-stability"
        ax = basin_shares(data, title=what.title)
        files = {
            "data": save(data, f"{stem}.nc"),
            "figure": save_figure(ax, f"{stem}.{out.figure}"),
        }
    facts = {**summary.rig_facts(what), **_facts(data, along)}
    tell(Together(summary.rig_text(what), _text(data, along)), facts, folder, files, out.json)
    return 0


def _facts(data: xr.Dataset, along: str) -> dict[str, Any]:
    """Where each motion is, what it is there, and its shares, in SI units."""
    motions = []
    for number in range(data.sizes["attractor"]):
        one = data.isel(attractor=number)
        there = one["motion"].values != ""
        here = one.isel({along: there})
        kinds = zip(here["motion"].values, here["period"].values, strict=True)
        motions.append(
            {
                "from": float(here[along][0]),
                "to": float(here[along][-1]),
                "values": here[along].values.tolist(),
                "kinds": [
                    {"motion": str(kind), "period": int(period)}
                    for kind, period in dict.fromkeys(kinds)
                ],
                **{
                    name: here[name].values.tolist()
                    for name in ("share", "share_low", "share_high")
                },
            }
        )
    return {
        "parameter": along,
        "values": data[along].values.tolist(),
        "motions": motions,
        "given_up": int(data["given_up"].sum()),
    }


_MOST = 12
"""Motions that are printed."""


def _text(data: xr.Dataset, along: str) -> RenderableType:
    from rich.console import Group as Together
    from rich.table import Table
    from rich.text import Text

    from vibroimpact.facts.number_format import plain, shown_in

    facts = _facts(data, along)
    unit = shown_in(data[along].attrs["units"], data[along].values)
    table = Table(box=None, pad_edge=False, padding=(0, 2))
    table.add_column("motion")
    table.add_column("kind and period")
    words = along.replace("_", " ") + (f" ({unit.symbol})" if unit.symbol else "")
    for heading in (words, "least share", "largest share", "95% interval of it"):
        table.add_column(heading, justify="right")
    motions = list(enumerate(facts["motions"], 1))
    chosen = sorted(motions, key=lambda one: -max(one[1]["share"]))[:_MOST]
    for number, one in sorted(chosen):
        kinds = [f"{kind['motion']} {kind['period'] or ''}".strip() for kind in one["kinds"]]
        ends = [plain(one[end] / unit.size, 4) for end in ("from", "to")]
        most = max(range(len(one["share"])), key=one["share"].__getitem__)
        table.add_row(
            str(number),
            ", ".join(kinds[:3]) + (" ..." if len(kinds) > 3 else ""),
            ends[0] if ends[0] == ends[1] else " to ".join(ends),
            f"{min(one['share']):.1%}",
            f"{one['share'][most]:.1%}",
            f"{one['share_low'][most]:.1%} to {one['share_high'][most]:.1%}",
        )
    lines = [f"states that were given up: {facts['given_up']}"]
    if len(motions) > _MOST:
        lines.insert(0, f"and {len(motions) - _MOST} motions of smaller shares")
    return Together(Text(), table, Text(), Text("\n".join(lines)))
