"""Features of a sweep: resonances, jumps, hysteresis, contact and the largest values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.datasets.description import noted, stop_word
from vibroimpact.facts import largest
from vibroimpact.facts.tables import Column, table_of
from vibroimpact.model.frequency_text import forcing, forcing_heading, forcings
from vibroimpact.model.units import plain
from vibroimpact.response.mass_jumps import MassJump
from vibroimpact.response.peaks import Peak
from vibroimpact.response.plausibility import STIFF, UNBOUNDED
from vibroimpact.response.resonance import Features, Jump

_CURVES = {"eta_a": "η_a", "eta_d": "η_d"}
_PEAKS = (
    Column("curve", "symbol", left=True),
    Column("sweep", "direction", left=True),
    Column("kind", "kind", left=True),
    Column("frequency", "frequency", 6),
    Column("value", "value"),
    Column("prominence", "prominence", 3),
)


def facts(data: xr.Dataset, features: Features, advice: list[str]) -> dict[str, Any]:
    """Return what a sweep shows as nested plain values, frequencies in Hz."""
    return {
        **steps(data),
        "peaks": [peak._asdict() for peak in features.peaks],
        **{
            name: [
                {**jump._asdict(), "frequency": jump.frequency, "upward": jump.upward}
                for jump in some
            ]
            for name, some in (("jumps", features.jumps), ("steep", features.steep))
        },
        "hysteresis": [item._asdict() for item in features.hysteresis],
        "unsettled": [item._asdict() for item in features.unsettled],
        "contact": [item._asdict() for item in features.contact],
        "largest": largest.facts(data),
        "advice": advice,
    }


def text(data: xr.Dataset, features: Features, advice: list[str]) -> RenderableType:
    """Return what a sweep shows as tables."""
    contact, unsettled = (
        [(one.direction, one.low, one.high) for one in some]
        for some in (features.contact, features.unsettled)
    )
    parts: list[RenderableType] = [
        steps_text(data),
        Text(),
        largest.text(data),
        Text(),
        _peaks(features),
        Text(),
        _jumps(features),
        *steep_steps(features.steep),
        Text(),
        _hysteresis(data, features),
        ranges(f"Contact with a {stop_word(data)}", contact),
        ranges("Motion not settled", unsettled),
    ]
    notes = noted(data)
    parts += [Text(f"Note: {line}") for line in notes if line.startswith((UNBOUNDED, STIFF))]
    parts += [Text(f"Advice: {line}", style="yellow") for line in advice]
    return Group(*parts)


def _peaks(features: Features) -> RenderableType:
    rows = [
        {**peak._asdict(), "symbol": symbol, "kind": _kind(peak)}
        for curve, symbol in _CURVES.items()
        for peak in features.peaks
        if peak.curve == curve
    ]
    return table_of(rows, _PEAKS, "Resonances")


def _kind(peak: Peak) -> str:
    kind = "primary" if peak.primary else "secondary"
    return f"{kind}, at the end of the range" if peak.at_end else kind


def _jumps(features: Features) -> RenderableType:
    if not features.jumps:
        return Text("Jumps: none")
    columns = jump_columns(
        Column("η_a", lambda one: " → ".join(plain(end, 4) for end in one["eta_a"]), left=True),
        Column("η_d", lambda one: " → ".join(plain(end, 4) for end in one["eta_d"]), left=True),
    )
    rows = [{**jump._asdict(), "upward": jump.upward} for jump in features.jumps]
    return table_of(rows, columns, "Jumps")


def steep_steps(jumps: Sequence[Jump | MassJump]) -> list[RenderableType]:
    """Return lines on the steps that may be smooth, by direction; none if there are no such."""
    if not jumps:
        return []
    places = [
        (one.direction, min(one.before, one.after), max(one.before, one.after)) for one in jumps
    ]
    return [Text(), ranges("Steep, but not proved to be a jump; refine --step", places)]


def jump_columns(*ends: Column) -> tuple[Column, ...]:
    """Return the columns of a table of jumps, with those of the values before and after each."""
    turn, heading = forcing_heading("between")
    heading = heading if turn == 1.0 else f"between {heading}"
    return (
        Column("sweep", "direction", left=True),
        Column("jump", lambda one: "upward" if one["upward"] else "downward", left=True),
        Column(
            heading,
            lambda one: f"{plain(turn * one['before'])} and {plain(turn * one['after'])}",
            left=True,
        ),
        *ends,
        Column("", lambda one: "" if one["settled"] else "not settled", left=True),
    )


def _hysteresis(data: xr.Dataset, features: Features) -> RenderableType:
    if data.sizes["direction"] < 2:
        return Text("Hysteresis: not computed, because it needs both sweep directions")
    if not features.hysteresis:
        return Text("Hysteresis: none")
    lines = []
    for item in features.hysteresis:
        notes = [f"{item.side} ({item.order})"]
        if item.below is None or item.above is None:
            notes.append("continues beyond the swept range")
        if not item.settled:
            notes.append("not settled")
        lines.append(f"  {forcings(item.low, item.high)}: {', '.join(notes)}")
    return Text("\n".join(["Hysteresis", *lines]))


def steps(data: xr.Dataset) -> dict[str, Any]:
    """Return the frequencies of a sweep (Hz) and its directions."""
    frequency = data["frequency"].values.tolist()
    return {
        "frequencies": {"from": frequency[0], "to": frequency[-1], "count": len(frequency)},
        "directions": data["direction"].values.tolist(),
    }


def steps_text(data: xr.Dataset) -> RenderableType:
    """Return the same as a line."""
    about = steps(data)
    low, high, count = about["frequencies"].values()
    frequency_text = f"{count} frequencies from {forcings(low, high)}"
    frequency_text = frequency_text if count > 1 else f"1 frequency, {forcing(low)}"
    return Text(f"{frequency_text}, {' and '.join(about['directions'])}")


def ranges(title: str, intervals: Sequence[tuple[str, float, float]]) -> RenderableType:
    """Return ranges of frequencies (Hz), each with the name of its group, as lines of a group."""
    if not intervals:
        return Text(f"{title}: at no frequency")
    groups: dict[str, list[tuple[float, float]]] = {}
    for name, low, high in intervals:
        groups.setdefault(name, []).append((low, high))
    return Text("\n".join([title, *(f"  {name}: {_spans(one)}" for name, one in groups.items())]))


def _spans(ranges: list[tuple[float, float]]) -> str:
    """Write ranges of frequencies, with the unit or the symbol once."""
    spans = [forcings(low, high) for low, high in ranges]
    last = len(spans) - 1
    return ", ".join(
        span.removeprefix("ω = " if i else "").removesuffix("" if i == last else " Hz")
        for i, span in enumerate(spans)
    )
