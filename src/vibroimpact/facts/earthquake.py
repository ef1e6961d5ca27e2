"""The response of a rig to a record, as plain values and as text."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import xarray as xr
from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.datasets.description import status_facts
from vibroimpact.datasets.stops import over_stops, plain_values
from vibroimpact.earthquakes.free_vibration import settles
from vibroimpact.earthquakes.peak_demands import ENERGIES
from vibroimpact.facts.number_format import written
from vibroimpact.facts.tables import Row, sheet_of, values_text
from vibroimpact.model import GRAVITY, Oscillator, Record
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.quantities import LENGTH
from vibroimpact.model.units import plain, pretty
from vibroimpact.model.written_units import unit, unitless


class _Shaken(NamedTuple):
    """A rig, its record and its response."""

    record: Record
    response: xr.Dataset
    rig: Oscillator


_ROWS = (
    Row(
        "peak of the base",
        lambda of: _acceleration(of.record.peak),
        remark=lambda of: (
            f"at {plain(of.record.peak_time, 6)}{unit(' s')} of "
            f"{plain(of.record.duration, 6)}{unit(' s')}"
        ),
    ),
    Row("displacement", lambda of: _reaches(of.response)),
    Row(
        "acceleration",
        lambda of: _acceleration(float(of.response["peak_acceleration"])),
        remark=lambda of: _ratio(of),
    ),
    Row(
        "contact force",
        "peak_force",
        remark=lambda of: f"impulse {values_text(of.response, 'impulse')}",
        applies=lambda of: _has_contacts(of),
    ),
    Row("contacts", "impact_count", applies=lambda of: _has_contacts(of)),
    Row("energy supplied", ENERGIES[0], like=ENERGIES, remark=lambda of: _lost(of)),
    Row("resting position", "residual_displacement", 6, remark=lambda of: _unsettled(of)),
)


def together(responses: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Return the responses to several records as one dataset."""
    attributes = {**next(iter(responses.values())).attrs}
    del attributes["message"]  # that of the first record only
    bare = [one.drop_attrs(deep=False) for one in responses.values()]
    data = xr.concat(bare, xr.DataArray(list(responses), dims="record", name="record"))
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
    rows = sheet_of(response, _ROWS, _Shaken(record, response, rig))
    return Group(Text(name, style="bold"), rows, Text(sentence(response, rig, free)))


def _reaches(response: xr.Dataset) -> str:
    """Return how far the mass goes to both sides, in one unit."""
    values = [_reach(response, side) for side in SIDES]
    parts = (written("displacement", one, like=values) for one in values)
    return ", ".join(f"{part} {side}" for part, side in zip(parts, SIDES, strict=True))


def _ratio(of: _Shaken) -> str:
    """Return the acceleration as a multiple of that of the base."""
    peak = of.record.peak
    size = float(of.response["peak_acceleration"])
    return f"{plain(size / peak, 4)} times that of the base" if peak else ""


def _has_contacts(of: _Shaken) -> bool:
    return bool(of.response["impact_count"].any() or of.response["impulse"].any())


def _lost(of: _Shaken) -> str:
    """Return the energies that are lost."""
    _, isolator, stops = (values_text(of.response, one, like=ENERGIES) for one in ENERGIES)
    return f"lost: {isolator} in the isolator" + (f", {stops} in the stops" if of.rig.stops else "")


def _unsettled(of: _Shaken) -> str:
    """Return a remark for a mass that does not come to rest, or may not."""
    swing = float(of.response["residual_swing"])
    if not abs(swing) <= 1e-5 * float(of.response["peak_displacement"]):
        return f"still swinging by ±{pretty(swing, LENGTH)}"
    if of.rig.isolator.damping == 0.0 and not settles(of.rig):
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
        f"with at most {written('peak_force', force)}"
        if math.isfinite(force)
        else f"with a total impulse of {written('impulse', float(over_stops(response['impulse'])))}"
    )
    said = f"The mass hits {times}, {hard}"
    if free is None:
        return f"{said}."
    far = max((_reach(free, side), side) for side in hit)
    ratio = float(response["peak_acceleration"]) / float(free["peak_acceleration"])
    return (
        f"{said}. Its acceleration is {plain(ratio, 3)} times the acceleration without stops. "
        f"Without stops, it would move {written('displacement', far[0])} to the {far[1]}."
    )


def _pressed(response: xr.Dataset) -> str:
    """Return a sentence about stops that are pressed from the start, as under preload; or none."""
    forces = plain_values(response["peak_force"])
    pressed = {side: force for side, force in forces.items() if force > 0.0}
    if not pressed:
        return ""
    stop_text = " and ".join(
        f"the {side} stop with at most {written('peak_force', force)}"
        for side, force in pressed.items()
    )
    return f"The mass presses {stop_text} from the start; no impact follows."


def _left(response: xr.Dataset, rig: Oscillator) -> str:
    """Return what remains of the gaps."""
    gaps = {side: stop.gap for side in SIDES if (stop := getattr(rig, side)) is not None}
    return " and ".join(
        f"{written('displacement', gap - _reach(response, side))} of the "
        f"{pretty(gap, LENGTH)} gap on the {side}"
        for side, gap in gaps.items()
    )


def _times(count: int) -> str:
    return {1: "once", 2: "twice"}.get(count, f"{count} times")


def _acceleration(value: float) -> str:
    """Return an acceleration in m/s² and in g, or as a number if the rig has no units."""
    number = plain(value, 5)
    return number if unitless() else f"{number} m/s² = {plain(value / GRAVITY, 4)} g"


def _reach(response: xr.Dataset, side: str) -> float:
    """Return how far the mass goes to one side (m)."""
    if side == "right":
        return float(response["displacement_max"])
    return 0.0 - float(response["displacement_min"])
