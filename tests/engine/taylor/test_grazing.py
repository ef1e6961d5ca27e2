"""Passes that end just beyond a stop or just short of it, under each law.

A motion without the stop tells how far the mass comes. A stop by a share of that nearer is touched,
where that motion passes it; a stop by as much farther is not.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from engine.taylor.rigs import ISOLATORS, SHAKEN, STOPS
from samples import sample

DEPTHS = [10.0**-n for n in sample(range(2, 14), (2, 7, 12))]
CYCLES = 2.0
START = vi.State(0.1, 0.3)
ROUNDING = 100 * 2.0**-52
"""Share of the largest displacement."""

PAIRS = sample(
    [(isolator, stop) for isolator in ISOLATORS for stop in STOPS],
    [(isolator, "bumper") for isolator in ISOLATORS] + [("linear", stop) for stop in STOPS],
)


class Side(NamedTuple):
    """The stop that is grazed, and where the mass goes as seen from it."""

    name: str
    sign: float

    def against(self, rig: vi.Oscillator, stop: vi.Bumper, gap: float) -> vi.Oscillator:
        return rig.replace(**{self.name: stop.replace(gap=gap)})

    def reach(self, rig: vi.Oscillator) -> float:
        totals = vi.totals(moved(rig, self))
        return float(totals["displacement_max"] if self.sign > 0 else -totals["displacement_min"])

    def events(self, data: xr.Dataset) -> np.ndarray:
        return np.flatnonzero(np.where(data["event_stop"].values == "right", 1, -1) == self.sign)


def moved(rig: vi.Oscillator, side: Side, cycles: float = CYCLES, samples: int = 1) -> xr.Dataset:
    """On the left, the mirror image of the motion on the right."""
    phase = SHAKEN.phase + (np.pi if side.sign < 0 else 0.0)
    start = vi.State(side.sign * START.displacement, side.sign * START.velocity)
    return vi.simulate(vi.Rig(rig, SHAKEN.replace(phase=phase)), cycles, start, samples)


@pytest.mark.parametrize("side", [Side("right", 1.0), Side("left", -1.0)], ids=lambda s: s.name)
@pytest.mark.parametrize("after", ["flight", "an impact"])
@pytest.mark.parametrize(("isolator", "stop"), PAIRS)
def test_every_pass_is_found_and_none_is_invented(
    isolator: str, stop: str, after: str, side: Side
) -> None:
    free = vi.Oscillator(1.0, ISOLATORS[isolator], None, None)
    if after == "an impact":
        opposite = Side("left" if side.name == "right" else "right", -side.sign)
        free = opposite.against(free, STOPS[stop], 0.2)
    reach = side.reach(free)
    for depth in DEPTHS:
        gap = reach * (1.0 - depth)
        data = moved(side.against(free, STOPS[stop], gap), side)
        events = side.events(data)
        assert len(events), depth
        first = float(data["event_time"][events[0]])
        passed = moved(free, side, first * SHAKEN.frequency, 500)["displacement"].values * side.sign
        assert abs(passed[-1] - gap) < ROUNDING * reach, depth
        assert passed[:-1].max() < gap + ROUNDING * reach, depth
        data = moved(side.against(free, STOPS[stop], reach * (1.0 + depth)), side)
        assert not len(side.events(data)), depth
