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
    from vibroimpact.model.excitation import Of

_MAP = Group("Map", sort_key=1)
_AXIS = Parameter(group=_MAP, allow_leading_hyphen=True)
_Axis = tuple[str, list[float], str]
"""Name, values in SI units, and "log" or "linear"."""
_PUBLISHED = "B3-10mm-A3"
_SYMBOLS = {"acceleration": "A =", "displacement": "X =", "force": "F ="}
_NODES = 21


def scenario_map(
    rig: Annotated[RigName | None, Parameter(show_default=False)] = None,
    /,
    *,
    x: Annotated[
        tuple[str, str],
        _AXIS,
        Parameter(
            negative="",
            show_default=False,
            help=(
                "Parameter and range, NAME LOW:HIGH[:log][:NODES], 21 nodes if none are given. "
                "Physical: gap, amplitude, bumper-stiffness, proportional-stiffness (at a fixed "
                "C/K), isolator-period; dimensionless: stiffness-ratio, "
                "gap-ratio, relaxation-time, damping-ratio, restitution. "
                "stiffness-ratio 0.5:100:log."
            ),
        ),
    ] = ("stiffness-ratio", "0.5:100:log"),
    y: Annotated[
        tuple[str, str],
        _AXIS,
        Parameter(
            negative="",
            show_default=False,
            help="The same upwards. gap-ratio 0:1.",
        ),
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
    where: Annotated[
        str | None,
        Parameter(
            group=COMPUTATION,
            help="threads, processes, or the address of a dask scheduler, such as "
            "tcp://10.0.0.1:8786; processes where the first grid has at least 500 nodes.",
        ),
    ] = None,
    output: OutputOptions | None = None,
) -> int:
    """Map the scenarios of a rig over two of its parameters.

    The rig gives all other parameters; without one, they are those of the published rig B3-A3.
    The map is written to NAME-X-Y-map.zarr as it is computed, block by block: stopped at any
    moment, the same command completes it. Prints the share of each scenario; draws
    NAME-X-Y-map.png.

    For example:

        vibroimpact map --x stiffness-ratio 0.5:100:log --y gap-ratio 0:1
        vibroimpact map B2-G1-A3 --x gap 2mm:20mm:10 --y proportional-stiffness 50kN/m:2MN/m:log
        vibroimpact map --x stiffness-ratio 1:100:log:41 --y damping-ratio 0.05:0.3 --refine 1
    """
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject
    from vibroimpact.model.rig import Rig

    out = output or OutputOptions()
    what = subject(rig or _PUBLISHED, changes or RigOptions(), out.name)
    if rig is None and out.name is None:
        what = what._replace(
            name=what.name.replace(_PUBLISHED, "published rig"),
            slug=what.slug.replace(_PUBLISHED, "published"),
        )
    of = what.repeated.of
    axes = _axis("--x", *x, of), _axis("--y", *y, of)
    _check(what, axes, refine)
    used = (thresholds or ThresholdOptions()).thresholds()

    with output_folder(out.output) as folder:
        from rich.console import Group as Together
        from rich.table import Table
        from rich.text import Text

        from vibroimpact.cli import summary
        from vibroimpact.figures import save_figure
        from vibroimpact.figures import scenario_map as draw
        from vibroimpact.scenarios.borders import jump_border
        from vibroimpact.scenarios.map import scenario_map as run
        from vibroimpact.scenarios.scenario import Scenario

        names = "-".join(name.replace("_", "-") for name, *_ in axes)
        stem = folder / f"{what.slug}-{names}-map"
        store = stem.with_name(f"{stem.name}.zarr")
        with progress_bar("mapping") as progress:
            try:
                data = run(
                    Rig(what.oscillator, what.repeated),
                    *axes,
                    step=step,
                    refine=refine,
                    thresholds=used,
                    store=store,
                    threads=threads,
                    where=where,
                    progress=progress,
                )
            except InputError as error:
                raise InputError(_as_option(str(error))) from None
        edge = None
        if border:
            with progress_bar("following the border") as progress:
                edge = jump_border(data, threads=threads, where=where, progress=progress)
        held = _held(what, axes)
        ax = draw(data, border=edge, title=f"{what.title}: {held}")
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
    }
    table = Table(box=None, pad_edge=False, padding=(0, 2), show_header=False)
    for kind in Scenario:
        if kind.label in shares:
            table.add_row(kind.label, f"{shares[kind.label]:.1%}", kind.meaning)
    denser = {0: "", 1: ", made denser once"}.get(refine, f", made denser {refine} times")
    text = Together(
        Text(what.name, style="bold"),
        Text(f"held: {held}"),
        Text(),
        Text(
            f"{len(axes[0][1])} × {len(axes[1][1])} nodes{denser}: {computed} of "
            f"{data['scenario'].size} computed; share of the nodes"
        ),
        table,
    )
    tell(text, facts, folder, files, out.json)
    return 0


def _held(what: Subject, axes: tuple[_Axis, ...]) -> str:
    """What the map does not vary, in words."""
    from vibroimpact.model import Bumper, RigidStop, to_dimensionless
    from vibroimpact.model.parameters import PARAMETERS
    from vibroimpact.model.quantities import LENGTH, STIFFNESS
    from vibroimpact.model.units import pretty
    from vibroimpact.scenarios.axes import ONE_QUANTITY

    varied = {name for name, *_ in axes}
    stops, shaken = what.oscillator.stops, what.repeated
    bumpers = [stop for stop in stops if isinstance(stop, Bumper)]
    walls = [stop for stop in stops if isinstance(stop, RigidStop)]
    for pair in ONE_QUANTITY:
        varied |= pair if varied & pair else set()
    if any(name == "bumper_stiffness" for name, *_ in axes):
        varied.add("relaxation_time")  # the damping is held
    rest = {
        "restitution": ("e =", [f"{stop.restitution:.3g}" for stop in walls]),
        "relaxation_time": (
            "τ =",
            [f"{what.oscillator.angular_frequency * b.damping / b.stiffness:.3g}" for b in bumpers],
        ),
        "damping_ratio": ("ξ =", [f"{what.oscillator.damping_ratio:.3g}"]),
    }
    if any(PARAMETERS[name].physical for name, *_ in axes):
        quantities = {
            "gap": ("gap", [pretty(stop.gap, LENGTH) for stop in stops]),
            "proportional_stiffness": (
                "bumpers",
                [pretty(b.stiffness, STIFFNESS) for b in bumpers],
            ),
            "amplitude": (_SYMBOLS[shaken.of], [pretty(shaken.amplitude, shaken.quantity)]),
            **rest,
        }
    else:
        group = to_dimensionless(what.rig)
        halves = [b for b in (group.right, group.left) if b is not None]
        quantities = {
            "stiffness_ratio": ("λ =", [_ratio(b.stiffness_ratio) for b in halves]),
            "gap_ratio": ("δ0 =", [f"{b.gap:.4g}" for b in halves]),
            **rest,
        }
    return ", ".join(
        f"{symbol} {' and '.join(dict.fromkeys(values))}"
        for name, (symbol, values) in quantities.items()
        if values and name not in varied
    )


def _ratio(value: float) -> str:
    """λ; that of a rigid stop is infinite."""
    return f"{value:.4g}" if math.isfinite(value) else "∞"


def _axis(option: str, name: str, text: str, of: Of) -> _Axis:
    """Read ``LOW:HIGH[:log][:NODES]``."""
    from vibroimpact.cli.ranges import spread
    from vibroimpact.model.parameters import parameter
    from vibroimpact.scenarios.axes import NAMES

    key = name.strip().replace("-", "_")
    if key not in NAMES:
        known = ", ".join(name.replace("_", "-") for name in NAMES)
        raise InputError(f"{option}: {name!r}; one of {known} is accepted")
    varied = parameter(key, option, of)
    return key, *spread(option, varied, text, _NODES)


def _check(what: Subject, axes: tuple[_Axis, ...], refine: int) -> None:
    """Refuse what cannot be mapped before anything is written."""
    from vibroimpact.cli.ranges import MOST
    from vibroimpact.scenarios.axes import Base, axis, check_pair, one_sine

    try:
        base = Base(one_sine(what.rig, "excitation"))
        x, y = (
            axis(given, option, base.base.sine.of)
            for given, option in zip(axes, ("--x", "--y"), strict=True)
        )
        check_pair(x, y)
        base.rig({one.name: float(one.values[-1]) for one in (x, y)})
    except InputError as error:
        raise InputError(_as_option(str(error))) from None
    if not 0 <= refine <= 8:
        raise InputError(f"--refine: {refine}; a whole number from 0 to 8 is accepted")
    nodes = (len(x.values) << refine) * (len(y.values) << refine)
    if nodes > MOST:
        raise InputError(f"--refine: {refine} makes {nodes} nodes; at most {MOST} are accepted")


def _as_option(message: str) -> str:
    options = {"y": "--y", "step": "--step", "store": "--output", "rig": "CASE"}
    for field, option in options.items():
        if message.startswith(f"{field}:"):
            return message.replace(field, option, 1)
    return message


def _shares(data: xr.Dataset) -> dict[str, float]:
    """Share of the nodes by scenario, those that occur."""
    from vibroimpact.scenarios.scenario import Scenario

    kinds = data["scenario"].values
    return {s.label: float((kinds == s).mean()) for s in Scenario if (kinds == s).any()}
