"""Stops that stay pressed, as under preload: contact, though no contact begins."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.facts import motions, sweeps
from vibroimpact.facts.earthquake import sentence
from vibroimpact.facts.tables import as_text
from vibroimpact.response.resonance import features

PRESSED = vi.Bumper("50 kN/m", "100 N s/m", "-10 mm")
RIG = vi.Oscillator(550.0, vi.Isolator("26.8 kN/m", "1.1 kN s/m"), right=PRESSED, left=PRESSED)


def test_a_sweep_says_that_its_bumpers_are_touched():
    """Its page said "force of the right stop 1.8 kN" and "Contact with a bumper: nowhere"."""
    data = vi.sweep(vi.Rig(RIG, "0.05 g"), [1.0, 1.5, 2.0])
    assert not data["impacts"].sel(stop="right").any()
    # At rest each bumper is pressed by 10 mm.
    assert (data["peak_force"].sel(stop="right") > 500.0).all()
    traits = features(data)
    assert {(one.low, one.high) for one in traits.contact} == {(1.0, 2.0)}
    text = as_text(sweeps.text(data, traits, []))
    assert "Contact with a bumper\n  forward: 1 to 2 Hz\n  backward: 1 to 2 Hz" in text


def test_a_motion_says_which_stops_stay_pressed():
    both = vi.steady(vi.Rig(RIG, vi.Harmonic(0.2, 1.0)))
    assert "0 right, 0 left per cycle; both stops stay pressed" in _said(both)
    one = vi.steady(vi.Rig(RIG.replace(left=PRESSED.replace(gap=0.1)), vi.Harmonic(0.2, 1.0)))
    assert "0 right, 0 left per cycle; the right stop stays pressed" in _said(one)
    free = vi.steady(vi.Rig(RIG.without_bumpers(), vi.Harmonic(0.2, 1.0)))
    assert "pressed" not in _said(free)


def _said(data):
    return as_text(motions.text({1.0: {"A": data}}))


@pytest.mark.parametrize("sides", [("right", "left"), ("right",)])
def test_an_earthquake_does_not_say_that_pressed_stops_are_not_hit(sides):
    """The mass hits no stop: -12 mm of the -10 mm gap remain."""
    rig = RIG if len(sides) == 2 else RIG.replace(left=None)
    record = vi.Record(0.1 * np.sin(np.arange(50.0)), 0.02)
    response = vi.seismic_response(vi.Rig(rig, record))
    text = sentence(response, rig, None)
    assert text.startswith("The mass presses the right stop with at most ")
    assert text.endswith(" from the start; no impact follows.")
    assert ("left" in text) == (len(sides) == 2)
    near = rig.replace(right=PRESSED.replace(gap=1e-5), left=None)
    hits = vi.seismic_response(vi.Rig(near, record))
    assert sentence(hits, near, None).startswith("The mass hits the right stop ")
