"""The response of a rig to a record, as plain values and as text."""

from __future__ import annotations

import math
from typing import Any

import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.datasets.stops import SIDES, of_stop, over_stops, plain_values
from vibroimpact.earthquakes.free_vibration import settles
from vibroimpact.facts.number_format import (
    ENERGIES,
    FORCES,
    IMPULSES,
    LENGTHS,
    Scale,
    fitting,
    plain,
)
from vibroimpact.facts.status import status_facts
from vibroimpact.facts.tables import plain_table
from vibroimpact.model import GRAVITY, Oscillator, Record
from vibroimpact.model.quantities import FORCE, LENGTH
from vibroimpact.model.units import pretty
from vibroimpact.model.written_units import unit, unitless


def together(names: list[str], responses: list[xr.Dataset]) -> xr.Dataset:
    """Return the responses to several records as one dataset."""
    attributes = {**responses[0].attrs}
    del attributes["message"]  # that of the first record only
    bare = [one.drop_attrs(deep=False) for one in responses]
    data = xr.concat(bare, xr.DataArray(names, dims="record", name="record"))
    return data.assign_attrs(attributes)


def facts(
    name: str, record: Record, response: xr.Dataset, rig: Oscillator, free: xr.Dataset | None
) -> dict[str, Any]:
    """Return every number of a response, in SI units."""
    return {
        "name": name,
        "record": dict(record.rows()),
        **{str(key): plain_values(value) for key, value in response.data_vars.items()},
        **status_facts(response),
        "without_stops": None
        if free is None
        else {
            key: free[key].item()
            for key in ("displacement_max", "displacement_min", "peak_acceleration")
        },
        "verdict": sentence(response, rig, free),
    }


def text(
    name: str, record: Record, response: xr.Dataset, rig: Oscillator, free: xr.Dataset | None
) -> RenderableType:
    """Return a response as a table and a sentence."""
    table = plain_table()
    shaken = _acceleration(record.peak)
    when = f"at {plain(record.peak_time, 6)}{unit(' s')} of {plain(record.duration, 6)}{unit(' s')}"
    table.add_row("peak of the base", shaken, when)
    table.add_row("displacement", _both([_reach(response, side) for side in SIDES], LENGTHS), "")
    size = float(response["peak_acceleration"])
    ratio = f"{plain(size / record.peak, 4)} times that of the base" if record.peak else ""
    table.add_row("acceleration", _acceleration(size), ratio)
    if response["impact_count"].any() or response["impulse"].any():
        force = _both(_of_stops(response, "peak_force"), FORCES)
        impulse = _both(_of_stops(response, "impulse"), IMPULSES)
        table.add_row("contact force", force, f"impulse {impulse}")
        counts = [int(one) for one in _of_stops(response, "impact_count")]
        table.add_row("contacts", f"{counts[0]} right, {counts[1]} left", "")
    names = ("total_supplied", "total_isolator", "total_bumpers")
    supplied, isolator, stops = (float(response[key]) for key in names)
    scale = fitting((supplied, isolator, stops), ENERGIES)
    parts = [
        f"{plain(value / scale.size, 4)} {scale.symbol}".rstrip()
        for value in (supplied, isolator, stops)
    ]
    lost = f"lost: {parts[1]} in the isolator" + (f", {parts[2]} in the stops" if rig.stops else "")
    table.add_row("energy supplied", parts[0], lost)
    rest, swing = float(response["residual_displacement"]), float(response["residual_swing"])
    still = abs(swing) <= 1e-5 * float(response["peak_displacement"])
    table.add_row(
        "resting position",
        pretty(rest, LENGTH),
        _unsettled(rig, swing, still),
    )
    return Group(Text(name, style="bold"), table, Text(sentence(response, rig, free)))


def _unsettled(rig: Oscillator, swing: float, is_still: bool) -> str:
    """Return a remark for a mass that does not come to rest, or may not."""
    if not is_still:
        return f"still swinging by ±{pretty(swing, LENGTH)}"
    if rig.isolator.damping == 0.0 and not settles(rig):
        return (
            "not settled: the isolator has no damping, so the mass may swing about this position "
            "indefinitely"
        )
    return ""


def sentence(response: xr.Dataset, rig: Oscillator, free: xr.Dataset | None) -> str:
    """Return a sentence that states whether the mass hits its stops, and how hard."""
    if not rig.stops:
        return "The rig has no stops."
    hit = {side: int(n) for side, n in plain_values(response["impact_count"]).items() if n}
    if not hit:
        return _pressed(response) or f"The mass hits no stop: {_left(response, rig)} remain."
    times = " and ".join(f"the {side} stop {_times(n)}" for side, n in hit.items())
    force = float(over_stops(response["peak_force"]))
    hard = (
        f"with at most {pretty(float(f'{force:.4g}'), FORCE)}"
        if math.isfinite(force)
        else f"with a total impulse of {_value(float(over_stops(response['impulse'])), IMPULSES)}"
    )
    said = f"The mass hits {times}, {hard}"
    if free is None:
        return f"{said}."
    far = max((_reach(free, side), side) for side in hit)
    ratio = float(response["peak_acceleration"]) / float(free["peak_acceleration"])
    return (
        f"{said}. Its acceleration is {plain(ratio, 3)} times the acceleration without stops. "
        f"Without stops, it would move {_value(far[0], LENGTHS)} to the {far[1]}."
    )


def _pressed(response: xr.Dataset) -> str:
    """Return a sentence about stops that are pressed from the start, as under preload; or none."""
    forces = plain_values(response["peak_force"])
    pressed = {side: force for side, force in forces.items() if force > 0.0}
    if not pressed:
        return ""
    told = " and ".join(
        f"the {side} stop with at most {pretty(float(f'{force:.4g}'), FORCE)}"
        for side, force in pressed.items()
    )
    return f"The mass presses {told} from the start; no impact follows."


def _left(response: xr.Dataset, rig: Oscillator) -> str:
    """Return what remains of the gaps."""
    parts = []
    for side in SIDES:
        stop = getattr(rig, side)
        if stop is not None:
            free = stop.gap - _reach(response, side)
            parts.append(
                f"{_value(free, LENGTHS)} of the {pretty(stop.gap, LENGTH)} gap on the {side}"
            )
    return " and ".join(parts)


def _times(count: int) -> str:
    return {1: "once", 2: "twice"}.get(count, f"{count} times")


def _acceleration(value: float) -> str:
    """Return an acceleration in m/s² and in g, or as a number if the rig has no units."""
    number = plain(value, 5)
    return number if unitless() else f"{number} m/s² = {plain(value / GRAVITY, 4)} g"


def _value(value: float, scales: tuple[Scale, ...]) -> str:
    scale = fitting((value,), scales)
    return f"{plain(value / scale.size, 4)} {scale.symbol}".rstrip()


def _reach(response: xr.Dataset, side: str) -> float:
    """Return how far the mass goes to one side (m)."""
    if side == "right":
        return float(response["displacement_max"])
    return 0.0 - float(response["displacement_min"])


def _of_stops(response: xr.Dataset, name: str) -> list[float]:
    """Return the values of both sides, 0 without a stop."""
    return [float(of_stop(response, name, side)) for side in SIDES]


def _both(values: list[float], scales: tuple[Scale, ...]) -> str:
    """Return the values of both sides in one unit."""
    scale = fitting(values, scales)
    parts = [
        f"{plain(value / scale.size, 4)} {scale.symbol}".rstrip()
        if math.isfinite(value)
        else "infinite"
        for value in values
    ]
    return ", ".join(f"{part} {side}" for part, side in zip(parts, SIDES, strict=True))
