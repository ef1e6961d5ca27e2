"""A run that is cut at an event goes on as the uncut one, for all laws of stops on either side.

The state that a cut leaves says whether the stop is touched. One rounding decides on which side of
the event the cut lies; the motion and the list of its events must not depend on it.
"""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from samples import sample

CYCLES = 3
SHAKEN = vi.Harmonic(2.0, 0.31, 0.4)
ROUNDING = 1e-10

STOPS = {
    "dashpot": lambda gap: vi.Bumper(60.0, 0.9, gap),
    "elastic": lambda gap: vi.Bumper(60.0, 0.0, gap),
    "slowly relaxing": lambda gap: vi.Bumper(20.0, 6.0, gap),
    "restitution": lambda gap: vi.PowerBumper(60.0, gap, restitution=0.6),
    "Hunt-Crossley": lambda gap: vi.PowerBumper(
        60.0, gap, 2.0, restitution=0.6, relation="hunt-crossley"
    ),
    "dissipation": lambda gap: vi.PowerBumper(60.0, gap, dissipation=0.3),
    "Jankowski": lambda gap: vi.JankowskiBumper(60.0, gap, 0.6, 2.0),
    "rigid": lambda gap: vi.RigidStop(0.6, gap),
    "plastic": lambda gap: vi.RigidStop(0.0, gap),
}
RIGID = ("rigid", "plastic")
GAPS = {"open": 0.1, "closed": 0.0, "preloaded": -0.05}
ISOLATORS = {
    "linear": vi.Isolator(5.0, 0.3),
    "friction": vi.FrictionIsolator(5.0, 0.3, 0.05),
}


RUNS = [*product(STOPS, ["right", "left", "both"], GAPS, ISOLATORS)]
"""Every seventh of them has each law with both isolators and with two of the gaps at least."""


def rig_of(law: str, sides: str, gap: float, isolator: str) -> vi.Oscillator:
    right = STOPS[law](gap) if sides != "left" else None
    left = STOPS[law](gap + 0.03) if sides != "right" else None
    return vi.Oscillator(2.0, ISOLATORS[isolator], right, left)


def simulated(rig: vi.Oscillator, cycles: float, start: vi.State | xr.Dataset) -> xr.Dataset:
    return vi.simulate(vi.Rig(rig, SHAKEN), cycles, start, samples=8)


def events(data: xr.Dataset) -> list[tuple[int, int]]:
    pairs = zip(
        data["event_contact"].values,
        np.where(data["event_stop"].values == "right", 1, -1),
        strict=True,
    )
    return [(int(kind), int(side)) for kind, side in pairs]


@pytest.mark.parametrize(("law", "sides", "name", "isolator"), sample(RUNS, RUNS[::13]))
def test_a_run_cut_at_any_event_goes_on(law: str, sides: str, name: str, isolator: str) -> None:
    gap = GAPS[name]
    if law in RIGID and sides == "both" and gap < 0.0:
        pytest.skip("two rigid stops leave no room between negative gaps")
    rig = rig_of(law, sides, gap, isolator)
    inside = 0.1 if sides == "left" else -0.1  # of rigid stops that are preloaded
    start = vi.State(inside if law in RIGID and gap < 0.0 else 0.0)
    whole = simulated(rig, CYCLES, start)
    times = (whole["event_cycle"] + whole["event_cycle_time"] * SHAKEN.frequency).values
    assert len(times) >= 2
    end = whole["final_state"].values[:2]
    scale = [np.abs(whole[one]).values.max() for one in ("displacement", "velocity")]
    for time in times[:8]:
        for ulp in (-1, 0, 1):
            cut = time * (1.0 + ulp * 2.0**-52)
            if not 1e-9 < cut < CYCLES - 1e-9:
                continue
            first = simulated(rig, cut, start)
            second = simulated(rig, CYCLES - cut, first)
            gone = second["final_state"].values[:2] - end
            assert np.max(np.abs(gone) / scale) < ROUNDING, (time, ulp)
            # How a chatter or a rest ends is a matter of rounding.
            if law not in RIGID:
                assert events(first) + events(second) == events(whole), (time, ulp)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("law", [law for law in STOPS if law not in RIGID])
def test_a_contact_that_begins_at_the_start_is_one_of_the_motion(law: str, side: int) -> None:
    """As that which begins in the middle of a run; first samples may lie on either side of it."""
    stop = STOPS[law](0.0)
    right, left = (stop, None) if side == 1 else (None, stop)
    rig = vi.Oscillator(2.0, vi.Isolator(5.0, 0.3), right, left)
    still = vi.Record(np.zeros(30), 0.1)
    from_face = vi.simulate(vi.Rig(rig, still), start=vi.State(0.0, side * 0.9), samples=20)
    assert from_face["event_time"][0] == 0.0
    assert events(from_face)[0] == (1, side)
    log = vi.contacts(from_face)
    assert log["contact_start"][0] == 0.0
    assert log["contact_start_velocity"][0] == side * 0.9
    # The same from a little before it.
    early = vi.State(-side * 1e-9, side * 0.9)
    later = vi.contacts(vi.simulate(vi.Rig(rig, still), start=early, samples=20))
    assert log.sizes == later.sizes
    for one in ("duration", "penetration", "impulse", "peak_force", "end_velocity"):
        np.testing.assert_allclose(log[f"contact_{one}"], later[f"contact_{one}"], rtol=1e-7)


def test_an_overdamped_buffer_that_is_hit_at_the_start() -> None:
    """Depth, end and first force by the closed form of an overdamped oscillator."""
    mass, stiffness, damping, speed = 39.57, 106.5, 196.46, 0.9
    buffer = vi.Bumper(stiffness, damping, 0.0)
    rig = vi.Oscillator(mass, vi.Isolator(0.0, 0.0), None, buffer)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 0.5)), 1, vi.State(0.0, -speed))
    (row,) = vi.contacts(data).to_dataframe().itertuples()
    half, root = damping / (2 * mass), math.sqrt(damping**2 - 4 * mass * stiffness) / (2 * mass)
    fast, slow = half + root, half - root
    # x = v (e^(−slow t) − e^(−fast t)) / (fast − slow); the force is k x + c x′.
    deepest = math.log(fast / slow) / (fast - slow)
    ratio = (stiffness - damping * fast) / (stiffness - damping * slow)
    ends = math.log(ratio) / (fast - slow)

    def depth(t: float) -> float:
        return speed * (math.exp(-slow * t) - math.exp(-fast * t)) / (fast - slow)

    def rate(t: float) -> float:
        return speed * (fast * math.exp(-fast * t) - slow * math.exp(-slow * t)) / (fast - slow)

    assert row.contact_start == 0.0
    assert row.contact_penetration == pytest.approx(depth(deepest), rel=1e-12)
    assert row.contact_end == pytest.approx(ends, rel=1e-12)
    assert row.contact_end_velocity == pytest.approx(-rate(ends), rel=1e-11)
    assert row.contact_peak_force == pytest.approx(damping * speed, rel=1e-12)
    assert row.contact_penetration == pytest.approx(0.149817809, abs=1e-9)
    assert row.contact_end == pytest.approx(1.0456969286, abs=1e-10)
    assert row.contact_end_velocity == pytest.approx(0.0671224713, abs=2e-9)
    assert row.contact_peak_force == pytest.approx(176.814, abs=1e-9)
