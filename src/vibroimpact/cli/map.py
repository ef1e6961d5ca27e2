"""``vibroimpact map``: scenarios over two parameters."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

from cyclopts import Group, Parameter

from vibroimpact.cli.options import (
    COMPUTATION,
    OutputOptions,
    RigName,
    RigOptions,
    ThresholdOptions,
    Whole,
)
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.rig import Subject

_MAP = Group("Map", sort_key=1)
_AXIS = Parameter(group=_MAP, allow_leading_hyphen=True)
_NODES = 21
_MOST = 4_000_000


def scenario_map(
    rig: RigName = "B3-10mm-A3",
    /,
    *,
    x: Annotated[
        tuple[str, str],
        _AXIS,
        Parameter(
            help=(
                "Parameter and range, LOW:HIGH[:log][:NODES]. Physical: gap, amplitude, "
                "bumper-stiffness; dimensionless: stiffness-ratio, gap-ratio, relaxation-time, "
                "damping-ratio."
            )
        ),
    ] = ("stiffness-ratio", "0.5:100:log"),
    y: Annotated[
        tuple[str, str], _AXIS, Parameter(help="The same upwards; of the same sort as x.")
    ] = ("gap-ratio", "0:1"),
    refine: Annotated[
        Whole,
        Parameter(group=_MAP, help="How often the nodes beside a border are made twice as dense."),
    ] = 2,
    step: Annotated[
        float,
        Parameter(group=_MAP, help="Step of the sweeps, as a share of the natural frequency."),
    ] = 0.01,
    border: Annotated[
        bool,
        Parameter(group=_MAP, help="Whether the exact border where jumps begin is drawn, too."),
    ] = True,
    changes: RigOptions | None = None,
    thresholds: ThresholdOptions | None = None,
    threads: Annotated[
        Whole | None,
        Parameter(group=COMPUTATION, help="How many rigs are computed at once; one a processor."),
    ] = None,
    output: OutputOptions | None = None,
) -> int:
    """Map the scenarios of a rig over two of its parameters.

    The rig gives all other parameters. The map is written to NAME-X-Y-map.zarr as it is
    computed, block by block: stopped at any moment, the same command completes it. Prints the
    share of each scenario; draws NAME-X-Y-map.png.

    For example:

        vibroimpact map --x stiffness-ratio 0.5:100:log --y gap-ratio 0:1
        vibroimpact map B2-G1-A3 --x gap 2mm:20mm:10 --y bumper-stiffness 50kN/m:2MN/m:log
        vibroimpact map --x stiffness-ratio 1:100:log:41 --y damping-ratio 0.05:0.3 --refine 1
    """
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    axes = _axis("--x", *x), _axis("--y", *y)
    _check(what, axes, refine)
    used = (thresholds or ThresholdOptions()).thresholds()

    with output_folder(out.output) as folder:
        from rich.console import Group as Together
        from rich.table import Table
        from rich.text import Text

        from vibroimpact.cli import summary
        from vibroimpact.figures import save_figure
        from vibroimpact.figures import scenario_map as draw
        from vibroimpact.scenario.borders import jump_border
        from vibroimpact.scenario.map import scenario_map as run

        names = "-".join(name.replace("_", "-") for name, _ in axes)
        stem = folder / f"{what.slug}-{names}-map"
        store = stem.with_name(f"{stem.name}.zarr")
        with progress_bar("mapping") as progress:
            try:
                data = run(
                    *axes,
                    base=(what.oscillator, what.amplitude),
                    step=step,
                    refine=refine,
                    thresholds=used,
                    store=store,
                    threads=threads,
                    progress=progress,
                )
            except InputError as error:
                raise InputError(_as_option(str(error))) from None
        edge = jump_border(data) if border else None
        ax = draw(data, border=edge, title=what.name)
        files = {"data": store, "figure": save_figure(ax, f"{stem}.{out.figure}")}
    shares = _shares(data)
    computed = int((data["level"].values >= 0).sum())
    facts = {
        **summary.rig_facts(what),
        "x": axes[0][0],
        "y": axes[1][0],
        "nodes": int(data["scenario"].size),
        "computed": computed,
        "shares": shares,
        "border": []
        if edge is None
        else [
            {axes[0][0]: float(p), axes[1][0]: float(q)}
            for p, q in zip(edge[axes[0][0]].values, edge[axes[1][0]].values, strict=True)
        ],
        "files": files,
    }
    table = Table(box=None, pad_edge=False, padding=(0, 2), show_header=False)
    from vibroimpact.scenario.kinds import Scenario

    for kind in Scenario:
        if kind.label in shares:
            table.add_row(kind.label, f"{shares[kind.label]:.1%}", kind.meaning)
    text = Together(
        summary.rig_text(what),
        Text(),
        Text(
            f"{data['scenario'].shape[1]} × {data['scenario'].shape[0]} nodes, {computed} of them "
            "computed; share of the nodes"
        ),
        table,
        Text(),
        summary.files_text(files),
    )
    tell(text, facts, out.json)
    return 0


def _axis(option: str, name: str, text: str) -> tuple[str, list[float]]:
    """Read ``LOW:HIGH[:log][:NODES]``."""
    from vibroimpact.model import to_si
    from vibroimpact.scenario.axes import PARAMETERS

    key = name.strip().replace("-", "_")
    if key not in PARAMETERS:
        known = ", ".join(p.replace("_", "-") for p in PARAMETERS)
        raise InputError(f"{option}: {name!r}; one of {known} is accepted")
    parameter = PARAMETERS[key]
    parts = [part.strip() for part in text.split(":")]
    logarithmic = "log" in parts[2:3]
    rest = parts[3:] if logarithmic else parts[2:]
    if len(parts) < 2 or len(rest) > 1 or not all(parts):
        raise InputError(
            f"{option}: {text!r}; a range LOW:HIGH[:log][:NODES] is accepted, such as 0.5:100:log"
        )
    above = None if parameter.zero and not logarithmic else 0.0
    least = 0.0 if above is None else None
    low, high = (
        to_si(part, parameter.quantity, option, above=above, minimum=least) for part in parts[:2]
    )
    if not low < high:
        raise InputError(f"{option}: {low:g} is not below {high:g}; a rising range is accepted")
    nodes = _NODES
    if rest:
        if not rest[0].isdigit() or int(rest[0]) < 2:
            raise InputError(
                f"{option}: {rest[0]!r} nodes; a whole number of at least 2 is accepted"
            )
        nodes = int(rest[0])
    if nodes > _MOST:
        raise InputError(f"{option}: {nodes} nodes; at most {_MOST} are accepted")
    shares = [i / (nodes - 1) for i in range(nodes)]
    if logarithmic:
        ratio = math.log(high / low)
        values = [low * math.exp(share * ratio) for share in shares]
    else:
        values = [low + share * (high - low) for share in shares]
    return key, [low, *values[1:-1], high]


def _check(what: Subject, axes: tuple[tuple[str, list[float]], ...], refine: int) -> None:
    """Refuse what cannot be mapped before anything is written."""
    from vibroimpact.scenario.axes import Base, axis, check_pair

    try:
        x, y = (axis(given, option) for given, option in zip(axes, ("--x", "--y"), strict=True))
        check_pair(x, y)
        Base(what.oscillator, what.amplitude).rig(
            {one.name: float(one.values[-1]) for one in (x, y)}
        )
    except InputError as error:
        raise InputError(_as_option(str(error))) from None
    if not 0 <= refine <= 8:
        raise InputError(f"--refine: {refine}; a whole number from 0 to 8 is accepted")
    nodes = (len(x.values) << refine) * (len(y.values) << refine)
    if nodes > _MOST:
        raise InputError(f"--refine: {refine} makes {nodes} nodes; at most {_MOST} are accepted")


def _as_option(message: str) -> str:
    for field in ("y", "store", "step"):
        if message.startswith(f"{field}:"):
            return f"--{message}" if field != "store" else message.replace("store", "--output", 1)
    return message


def _shares(data: xr.Dataset) -> dict[str, float]:
    """Share of the nodes by scenario, those that occur."""
    from vibroimpact.scenario.kinds import Scenario

    kinds = data["scenario"].values
    return {s.label: float((kinds == s).mean()) for s in Scenario if (kinds == s).any()}
