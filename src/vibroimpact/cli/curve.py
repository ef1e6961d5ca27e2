"""``vibroimpact curve``: where a bifurcation moves in the plane of two parameters."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group, Parameter

from vibroimpact.cli.options import OutputOptions, RigName, RigOptions
from vibroimpact.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from vibroimpact.cli.frequency_grid import Span
    from vibroimpact.cli.rig import Subject
    from vibroimpact.model import Repeated
    from vibroimpact.model.excitation import Of

_CURVE = Group("Curve", sort_key=1)
_WITH_UNITS = Parameter(group=_CURVE, allow_leading_hyphen=True)

_KINDS = {
    "fold": "fold",
    "symmetry-breaking": "symmetry breaking",
    "period-doubling": "period doubling",
    "neimark-sacker": "Neimark-Sacker",
    "grazing": "grazing",
}


def curve(
    rig: RigName,
    /,
    *,
    bifurcation: Annotated[
        Literal["fold", "symmetry-breaking", "period-doubling", "neimark-sacker", "grazing"],
        Parameter(group=_CURVE, help="Which bifurcation is followed."),
    ] = "fold",
    over: Annotated[
        str,
        Parameter(
            group=_CURVE,
            help="Two parameters, as for vibroimpact branch; the bifurcations are sought along "
            "the first.",
        ),
    ] = "frequency,gap",
    first: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(help="Range of the first; of a frequency as for vibroimpact branch."),
    ] = None,
    second: Annotated[
        str | None, _WITH_UNITS, Parameter(help="Range of the second, such as 1mm:20mm.")
    ] = None,
    frequency: Annotated[
        str | None,
        _WITH_UNITS,
        Parameter(help="Excitation frequency where it is not the first parameter."),
    ] = None,
    changes: RigOptions | None = None,
    output: OutputOptions | None = None,
) -> int:
    """Follow bifurcations in two parameters, through cusps.

    Finds the bifurcations of one kind along the first parameter and follows each over both.
    Prints where each curve ends and its cusps; writes NAME-BIFURCATION-FIRST-SECOND.nc (a group
    for each curve) and the figure of the plane.

    For example:

        vibroimpact curve B2-G1-A3 --bifurcation fold --over frequency,gap --second 1mm:20mm
        vibroimpact curve B2-G1-A3 --over frequency,stiffness-ratio --second 0.5:100
    """
    from vibroimpact.cli.frequency_grid import default_span
    from vibroimpact.cli.output import output_folder, progress_bar, tell
    from vibroimpact.cli.rig import subject

    out = output or OutputOptions()
    what = subject(rig, changes or RigOptions(), out.name)
    names = [name.strip().replace("-", "_") for name in over.split(",")]
    if len(names) != 2:
        raise InputError(f"--over: {over!r}; two, as frequency,gap, are accepted")
    shaken = _excitation(what, names[0], frequency)
    spans = [
        _range("--first", names[0], first, default_span(what), shaken.of),
        _range("--second", names[1], second, default_span(what), shaken.of),
    ]
    _check(what, shaken, (names[0], names[1]), spans)

    with output_folder(out.output) as folder:
        from rich.console import Group as Together
        from rich.text import Text

        from vibroimpact.cli import summary
        from vibroimpact.datasets.files import save
        from vibroimpact.figures import bifurcation_curves, save_figure

        kind = _KINDS[bifurcation]
        with progress_bar("following") as progress:
            found = _curves(what, kind, (names[0], names[1]), spans, shaken, progress)
        if not found:
            raise InputError(
                f"--bifurcation: no {kind} along {names[0]} between {spans[0][0]} and "
                f"{spans[0][1]}; another kind or range is accepted"
            )
        for data in found.values():
            data.attrs["title"] = what.name
        stem = folder / f"{what.slug}-{bifurcation}-{'-'.join(names).replace('_', '-')}"
        axes = bifurcation_curves(found, title=f"{what.title}, {kind}")
        files = {
            "data": save(found, f"{stem}.nc"),
            "figure": save_figure(axes, f"{stem}.{out.figure}"),
        }
    facts = {
        **summary.rig_facts(what),
        "bifurcation": kind,
        "parameters": names,
        "curves": [
            {
                "points": data.sizes["point"],
                "cusps": [
                    [float(p), float(q)]
                    for p, q in zip(data["cusp_first"], data["cusp_second"], strict=True)
                ],
                "ended_low": data.attrs["ended_low"],
                "ended_high": data.attrs["ended_high"],
            }
            for data in found.values()
        ],
    }
    lines = [Text(f"{len(found)} curve{'s' if len(found) > 1 else ''} of {kind}", style="bold")]
    for name, data in found.items():
        lines.append(
            Text(
                f"  {name}: {data.sizes['point']} points; beginning: {data.attrs['ended_low']}; "
                f"end: {data.attrs['ended_high']}"
            )
        )
        lines += [
            Text(f"    cusp at {names[0]} {float(p):.9g}, {names[1]} {float(q):.9g}")
            for p, q in zip(data["cusp_first"], data["cusp_second"], strict=True)
        ]
    tell(Together(summary.rig_text(what), Text(), *lines), facts, folder, files, out.json)
    return 0


def _range(option: str, name: str, text: str | None, default: Span, of: Of) -> tuple[float, float]:
    from vibroimpact.cli.parameters import option_range

    if text is None and name == "frequency":
        return option_range(name, None, None, (option, option), default, "--over", of=of)
    low, colon, high = (text or "").partition(":")
    if not (low and colon and high):
        raise InputError(f"{option}: {text!r}; a range is accepted, such as 1mm:20mm")
    return option_range(name, low, high, (option, option), default, "--over", of=of)


def _excitation(what: Subject, first: str, frequency: str | None) -> Repeated:
    """The forcing of the rig; along the frequency its own does not matter."""
    from vibroimpact.model import to_si
    from vibroimpact.model.quantities import FREQUENCY

    phase = what.study.excitation.phase if what.study else 0.0
    if frequency is None and first != "frequency":
        raise InputError("--frequency: missing; a frequency greater than 0 is accepted, as 2Hz")
    if frequency is not None:
        hertz = to_si(frequency, FREQUENCY, "--frequency", above=0.0)
    else:
        hertz = what.oscillator.angular_frequency / math.tau or 1.0
    return what.at(hertz, phase)


def _check(
    what: Subject,
    shaken: Repeated,
    names: tuple[str, str],
    spans: list[tuple[float, float]],
) -> None:
    """Refuse what cannot be followed before anything is sought."""
    from vibroimpact.model.rig import Rig
    from vibroimpact.model.units import pretty
    from vibroimpact.stability.two_parameters import plane

    try:
        over = plane(Rig(what.oscillator, shaken), names)
    except InputError as error:
        raise InputError(re.sub("^parameters?:", "--over:", str(error))) from None
    low, high = spans[1]
    kind = over.other.quantity
    if not low <= over.value <= high:
        raise InputError(
            f"--second: {pretty(low, kind)} to {pretty(high, kind)} leaves out the rig's "
            f"{names[1]}, {pretty(over.value, kind)}; a range that holds it is accepted"
        )


def _curves(
    what: Subject,
    kind: str,
    names: tuple[str, str],
    spans: list[tuple[float, float]],
    shaken: Repeated,
    progress: Any,
) -> dict[str, xr.Dataset]:
    """Each curve once, by the parameter at which it was found."""
    import numpy as np

    from vibroimpact.model.parameters import parameter
    from vibroimpact.model.rig import Rig
    from vibroimpact.stability.bifurcation_curve import bifurcation_curve
    from vibroimpact.stability.branch import branch
    from vibroimpact.stability.resonance_diagram import resonance_diagram

    if names[0] == "frequency":
        data = resonance_diagram(
            Rig(what.oscillator, what.repeated), spans[0], phase=shaken.phase, progress=progress
        )
    else:
        data = branch(Rig(what.oscillator, shaken), span=spans[0], parameter=names[0])
    found: dict[str, xr.Dataset] = {}

    here = parameter(names[1]).read(Rig(what.oscillator, shaken))
    for i in np.flatnonzero(data["bifurcation_kind"].values == kind):
        value = float(data["bifurcation_value"][i])
        if any(_passes(curve, names, value, here) for curve in found.values()):
            continue
        found[f"{names[0]} {value:.6g}"] = bifurcation_curve(
            Rig(what.oscillator, shaken),
            data.isel(bifurcation=int(i)),
            spans=(spans[0], spans[1]),
            parameters=names,
            progress=progress,
        )
    return found


def _passes(data: xr.Dataset, names: tuple[str, str], p: float, q: float) -> bool:
    """Whether a curve goes through a point: where it crosses q it is at p."""
    import numpy as np

    x, y = data[names[0]].values, data[names[1]].values
    low, high = np.minimum(y[:-1], y[1:]), np.maximum(y[:-1], y[1:])
    for i in np.flatnonzero((low <= q) & (q <= high)):
        share = (q - y[i]) / (y[i + 1] - y[i]) if y[i + 1] != y[i] else 0.5
        crossing = x[i] + share * (x[i + 1] - x[i])
        # A chord misses the curve by a part of its own length.
        if abs(crossing - p) <= 0.2 * abs(x[i + 1] - x[i]) + 1e-4 * abs(p):
            return True
    return False
