"""Branches through the grazing of a rigid stop, where an impact comes or goes."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine.status import Status
from vibroimpact.stability.fixed_points import Section, evaluated, margin_of
from vibroimpact.stability.parameter_family import family

FREE = vi.Isolator("26.8 kN/m", "1.1 kN s/m")
WALL = vi.RigidStop(0.6, "25 mm")
SIDES = {"one wall": None, "two walls": WALL}


def reaches(gap: float, low: float, high: float) -> list[float]:
    """Frequencies at which the free flight of 0.05 g on this isolator has the amplitude `gap`."""
    k, c, a = 26800.0 / 550.0, 1100.0 / 550.0, 0.05 * 9.80665
    # (k - w²)² + c² w² = (a / gap)²
    half, root = k - 0.5 * c * c, math.sqrt((a / gap) ** 2 - c * c * (k - 0.25 * c * c))
    return [math.sqrt(half - root) / (2.0 * math.pi), math.sqrt(half + root) / (2.0 * math.pi)]


@pytest.mark.parametrize("left", SIDES.values(), ids=SIDES)
@pytest.mark.parametrize("frequency", ["0.7 Hz", "3 Hz"])
def test_from_free_flight_to_impacts_and_back(left, frequency):
    """The branch goes through the whole range, and grazes where free flight reaches the wall."""
    rig = vi.Oscillator("550 kg", FREE, WALL, left)
    data = vi.branch(vi.Rig(rig, vi.Harmonic("0.05 g", frequency)), vary={"frequency": (0.6, 3.0)})
    assert [data.attrs[f"ended_{end}"] for end in ("low", "high")] == [
        "the range ends at 0.6 Hz",
        "the range ends at 3 Hz",
    ]
    grazing = data.isel(bifurcation=data["bifurcation_kind"].values == "grazing")
    np.testing.assert_allclose(
        np.sort(grazing["bifurcation_value"]), reaches(0.025, 0.6, 3.0), rtol=1e-10
    )
    contacts = "0R | 1R" if left is None else "0R 0L | 1R 1L"
    assert set(grazing["bifurcation_contacts"].values) == {contacts}
    assert float(data["displacement_max"].max()) == pytest.approx(0.025, rel=1e-12)
    # Just behind it the multiplier of the impact is large: the map has the slope of a square root.
    assert float(np.abs(data["multiplier_real"]).max()) > 30.0


def test_impacts_come_and_go_between_a_wall_and_a_preloaded_bumper():
    bumper = vi.Bumper("510 kN/m", "0.9 kN s/m", "-1 mm")
    rig = vi.Oscillator("550 kg", FREE, vi.RigidStop(0.6, "5 mm"), bumper)
    data = vi.branch(vi.Rig(rig, vi.Harmonic("0.05 g", "4 Hz")), vary={"frequency": (0.95, 4.0)})
    assert data.attrs["ended_low"] == "the range ends at 0.95 Hz"
    grazing = data.isel(bifurcation=data["bifurcation_kind"].values == "grazing")
    assert {"1R 2L | 2R 2L", "1R 1L | 2R 1L", "1R 1L | 1R 2L"} <= set(
        grazing["bifurcation_contacts"].values
    )
    # It does not go the same way back.
    values = np.round(grazing["bifurcation_value"].values, 9)
    assert len(set(values)) == len(values)


def test_over_the_restitution_to_its_end():
    rig = vi.Oscillator("550 kg", FREE, WALL)
    data = vi.branch(vi.Rig(rig, vi.Harmonic("0.05 g", "1.1 Hz")), vary={"restitution": (0.0, 1.0)})
    assert float(data["stops.restitution"].min()) == 0.0
    assert float(data["stops.restitution"].max()) == 1.0
    assert data.attrs["ended_high"] == "the range ends at 1"
    assert (data["impacts"].sel(stop="right") == 1.0).all()


@pytest.mark.parametrize("side", ["right", "left"])
@pytest.mark.parametrize("clear", [1e-3, -1e-3, -1e-6])
def test_the_margin_goes_on_through_the_grazing(side, clear):
    """Free flight that misses the wall, or would pass it by so much if it were not there."""
    k, c, w = 1.0, 0.1, 1.3
    response = complex(k - w * w, c * w)
    sign = 1.0 if side == "right" else -1.0
    # From the far turning point, u = -s, towards the wall.
    phase = math.pi / 2 + float(np.angle(response)) + (0.0 if sign > 0.0 else math.pi)
    rig = vi.Oscillator(1.0, vi.Isolator(k, c), **{side: vi.RigidStop(0.5, 1.0)})
    swing = 1.0 - clear
    fam = family(vi.Rig(rig, vi.Harmonic(swing * abs(response), w / math.tau, phase)), "frequency")
    section = Section(fam, 1, False, np.ones(5))
    point = np.array([-sign * swing, 0.0, 0.0, 0.0, 0.0, w / math.tau])
    status, here, _ = evaluated(section, point, 0.0)
    assert status is Status.DONE
    assert sum(here.contacts) == (clear < 0.0)
    assert margin_of(here) == pytest.approx(clear, rel=2.0 * abs(clear) + 1e-9)


@pytest.mark.parametrize(
    ("gap", "left", "whose"),
    [("25 mm", False, "of period 1"), ("15 mm", True, "that are their own mirror image")],
)
def test_a_branch_that_is_born_in_the_grazing_of_free_flight_ends_there(gap, left, whose):
    """Beyond, the same orbits come again: a cycle later, or as mirror images."""
    wall = vi.RigidStop(0.6, gap)
    rig = vi.Oscillator("550 kg", FREE, wall, wall if left else None)
    data = vi.resonance_diagram(vi.Rig(rig, "0.05 g"), {"frequency": (0.6, 3.0)})
    grazes = reaches(float(wall.gap), 0.6, 1.2)[0]
    branches = np.unique(data["branch"])
    ended = [data.attrs[f"branch_{i}_ended_{end}"] for i in branches for end in ("low", "high")]
    assert f"it meets the orbits {whose} at {grazes:.9g} Hz, where they graze" in ended
    for i in branches:
        bifurcations = listed(data.isel(bifurcation=data["bifurcation_branch"].values == i))
        # The mirror image of an event is one on the other side.
        assert len(bifurcations) == len(set(bifurcations))


@pytest.mark.parametrize(
    ("phase", "frequency", "start"),
    [
        (0.0, 0.9139433587799541, (0.014333237680191907, -0.11140788111274)),
        (2.5, 0.9138671457909995, (-0.02260081379850748, 0.04592418169995152)),
    ],
    ids=["0.0", "2.5"],
)
def test_a_branch_is_the_same_wherever_it_is_begun(phase, frequency, start):
    """Of period 4: from a doubling through one impact more to the grazing of free flight."""
    rig = vi.Oscillator("550 kg", FREE, WALL)
    begun = vi.Rig(rig, vi.Harmonic("0.05 g", frequency, phase))
    data = vi.branch(begun, vi.State(*start), vary={"frequency": (0.6, 3.0)}, period=4)
    three = data["impacts"].sel(stop="right").values * data["period"].values == 3.0
    four = data.isel(point=three & (data["period"].values == 4))
    for i in np.linspace(0, four.sizes["point"] - 2, 5).astype(int):
        here = four.isel(point=i)
        shaken = vi.Harmonic("0.05 g", float(here["frequency"]), phase)
        again = vi.branch(
            vi.Rig(rig, shaken), here["section"], vary={"frequency": (0.6, 3.0)}, period=4
        )
        assert [one[:2] for one in listed(again)] == [
            (0.9115988, "grazing"),
            (0.9142847, "period doubling"),
            (0.9145636, "grazing"),
        ]


def listed(data) -> list[tuple[float, str, str]]:
    """Where each bifurcation is, its kind, and what touches."""
    names = ("value", "kind", "contacts")
    rows = zip(*(data[f"bifurcation_{name}"].values for name in names), strict=True)
    return sorted(
        (round(float(value), 7), str(kind), str(contacts)) for value, kind, contacts in rows
    )


@pytest.fixture(scope="module")
def chattering():
    """Branches from an orbit of sixteen impacts, and from one of five."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.RigidStop(0.6, 0.2))
    branches = []
    for frequency in (0.07559, 0.08):
        forcing = vi.Harmonic(1.0, frequency)
        start = vi.steady(vi.Rig(rig, forcing))
        branches.append(vi.branch(vi.Rig(rig, forcing), start, vary={"frequency": (0.0754, 0.081)}))
    return branches


@pytest.mark.full
def test_a_chatter_loses_its_impacts_one_by_one(chattering):
    """Each impact is lost in a fold and a grazing; both lie close together in a long chatter."""
    for data in chattering:
        assert data.attrs["ended_low"] == "the range ends at ω = 0.473752172"
        assert data.attrs["ended_high"] == "the range ends at ω = 0.50893801"
        bifurcations = {
            (kind, contacts): (value, turns)
            for kind, contacts, value, turns in zip(
                data["bifurcation_kind"].values,
                data["bifurcation_contacts"].values,
                data["bifurcation_value"].values,
                data["bifurcation_turns"].values,
                strict=True,
            )
        }
        for impacts in range(6, 23):
            fold, folds = bifurcations["fold", f"{impacts}R"]
            grazing, turns = bifurcations["grazing", f"{impacts - 1}R | {impacts}R"]
            assert grazing < fold
            assert folds
            assert turns
        assert len(bifurcations) == data.sizes["bifurcation"]  # nothing is listed twice


@pytest.mark.full
def test_a_chattering_branch_is_the_same_from_both_ends(chattering):
    values = [
        data["bifurcation_value"].values[data["bifurcation_value"].values > 0.07557485]
        for data in chattering
    ]
    np.testing.assert_allclose(np.sort(values[0]), np.sort(values[1]), rtol=1e-9)
    assert len(values[0]) == 2 * 17
