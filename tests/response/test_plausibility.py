"""Gaps that a motion shows to be absurd, damping ratios that were meant in percent, stiff stops."""

import math

import numpy as np
import pytest

import vibroimpact as vi
import vibroimpact.model
from vibroimpact.response.plausibility import STIFF, note_stiff_stops

RIG = vi.Oscillator("5000 t", vi.Isolator.from_period("5000 t", "2.5 s", 0.15))
SLIDING = vi.Oscillator("5000 t", vi.FrictionIsolator("30 MN/m", "4 MN s/m", "100 kN"))
WALL = vi.Bumper("500 MN/m", "5 MN s/m", 250.0)
RECORD = vi.Record(0.3 * np.sin(2.5 * np.arange(0.0, 8.0, 0.02)), 0.02)
FREE, FOUND = "displacement of free flight, 523.4 mm", r"displacement that was computed, \d.* mm"


@pytest.mark.parametrize(
    ("of", "rig", "whose"),
    [
        (lambda rig: vi.sweep(vi.Rig(rig, "0.1 g"), [0.3, 0.4]), RIG, FREE),
        (lambda rig: vi.sweep(vi.Rig(rig, "0.1 g"), [0.3, 0.4]), SLIDING, FOUND),
        (lambda rig: vi.steady(vi.Rig(rig, vi.Harmonic("0.1 g", 0.4))), RIG, FREE),
        (lambda rig: vi.steady(vi.Rig(rig, vi.Harmonic("0.1 g", 0.4))), SLIDING, FOUND),
        (lambda rig: vi.simulate(vi.Rig(rig, "0.1 g"), 9, frequency=0.4), RIG, FREE),
        (lambda rig: vi.seismic_response(vi.Rig(rig, RECORD)), RIG, FOUND),
        (lambda rig: vi.demands(rig, RECORD), RIG, FOUND),
    ],
    ids=[
        "sweep",
        "sweep sliding",
        "steady",
        "steady sliding",
        "simulate",
        "seismic_response",
        "demands",
    ],
)
def test_a_gap_of_metres_that_were_millimetres_is_doubted(of, rig, whose):
    message = rf"^gap: 250 m is \d+.* times the largest {whose}; is 250 mm meant\?$"
    with pytest.warns(vi.InputWarning, match=message) as warned:
        data = of(rig.replace(right=WALL))
    assert f"gap: {data.attrs['notes']}" == str(warned[0].message)
    assert warned[0].filename == __file__
    # Neither a gap of the motion's size nor one far beyond it whatever its unit.
    for gap in (0.25, 5.0, 1e5):
        assert "notes" not in of(rig.replace(right=WALL.replace(gap=gap))).attrs


def test_a_stop_of_millinewtons_is_doubted():
    rig = RIG.replace(right=vi.Bumper("3 mN/m", 0.0, "5 mm"))
    spring = rig.isolator.stiffness
    message = rf"^stiffness of a stop: 3 mN/m is {0.003 / spring:.3g} times .*; is 3 MN/m meant\?$"
    with pytest.warns(vi.InputWarning, match=message) as warned:
        data = vi.sweep(vi.Rig(rig, "0.05 g"), [1.0])
    assert "3 MN/m" in data.attrs["notes"]
    assert warned[0].filename == __file__
    for stiffness in ("3 kN/m", "3 MN/m"):
        soft = RIG.replace(right=vi.Bumper(stiffness, 0.0, "5 mm"))
        assert "notes" not in vi.sweep(vi.Rig(soft, "0.05 g"), [1.0]).attrs


def test_a_damping_ratio_of_percent_is_doubted():
    message = r"damping_ratio: 15 is 15 times the critical damping; did you mean 15 %\?"
    with pytest.warns(vi.InputWarning, match=f"^{message}$"):
        made = vi.Isolator.from_period("5000 t", "2.5 s", 15)
    assert vi.Oscillator("5000 t", made).damping_ratio == pytest.approx(15.0)
    with pytest.warns(vi.InputWarning, match=r"^vary\['damping_ratio'\]: 10 is 10 times"):
        vi.design_chart(
            RIG.replace(right=WALL.replace(gap=0.05)),
            {"damping_ratio": [0.1, 10.0]},
            records=RECORD,
        )
    vi.Isolator.from_period("5000 t", "2.5 s", 1.5)
    vi.Isolator.from_period("5000 t", "2.5 s", "15 %")


PRESSED = vi.Oscillator(
    10562.25,
    vi.Isolator(194441191.0, 772.108, damping_exponent=1.5),
    right=vi.PowerBumper(
        144839414.0, -0.000546019, 1.5, relation="hunt-crossley", restitution=0.532464
    ),
    left=vi.JankowskiBumper(2.6469e16, -0.00779594, 0.272852, 25447.5),
)
"""Two stops pressed at rest, one 1e8 times as stiff as the isolator."""
QUICKER = PRESSED.replace(left=PRESSED.left.replace(stiffness=6e15))
SHAKEN = vi.Harmonic(18.4087, 3.33011)


@pytest.mark.parametrize(
    "of",
    [
        lambda rig: vi.simulate(rig, 1, samples=0),
        pytest.param(
            lambda rig: vi.sweep(rig, [3.33011], max_cycles=1, window=1), marks=pytest.mark.full
        ),
        pytest.param(
            lambda rig: vi.steady(rig, samples=8, max_cycles=1, exponent_cycles=1, window=1),
            marks=pytest.mark.full,
        ),
    ],
    ids=["simulate", "sweep", "steady"],
)
def test_a_pressed_stop_that_makes_a_computation_slow_is_named(of):
    notes = of(vi.Rig(QUICKER, SHAKEN)).attrs["notes"]
    assert [notes] == note_stiff_stops(vi.Rig(QUICKER, SHAKEN), SHAKEN.frequency)


@pytest.mark.parametrize("rig", [PRESSED, QUICKER])
def test_the_frequency_of_a_pressed_stop_is_that_of_its_law(rig):
    (note,) = note_stiff_stops(vi.Rig(rig, SHAKEN), SHAKEN.frequency)
    assert note.startswith(STIFF)
    # The tangent stiffness of a Hertz law with the deformation at rest, 0.16 um and 0.42 um.
    deep = -vi.model.equilibrium(rig).displacement - rig.left.gap
    own = math.sqrt(1.5 * rig.left.stiffness * math.sqrt(deep) / rig.mass) / (2.0 * math.pi)
    assert f"the left stop is pressed at rest and vibrates at {own / 1e3:.3g} kHz" in note
    assert f"{own / 3.33011:.3g} times the forcing frequency of 3.33011 Hz" in note


def test_a_stop_that_is_not_much_faster_than_the_forcing_is_not_named():
    def notes(oscillator):
        return note_stiff_stops(vi.Rig(oscillator, SHAKEN), SHAKEN.frequency)

    assert notes(PRESSED)
    assert not notes(PRESSED.replace(left=PRESSED.left.replace(stiffness=1e10)))
    assert not notes(PRESSED.replace(left=PRESSED.left.replace(gap=1e-4)))  # touched, not pressed
    # Linear laws are followed in closed form, however stiff a stop is.
    wall = vi.Bumper(2.6e15, 1e9, -0.0078)
    assert not notes(vi.Oscillator(10562.25, vi.Isolator(2e8, 772.0), right=wall, left=wall))
