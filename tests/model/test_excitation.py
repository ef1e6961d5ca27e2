"""The motion of the base."""

import math

import pytest

from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic


def test_text_with_units():
    harmonic = Harmonic("0.05 g", "2.5Hz", "90 deg")
    assert harmonic == Harmonic(0.4903325, 2.5, math.pi / 2)
    assert Harmonic(frequency=2.5, amplitude=0.4903325).phase == 0.0


def test_an_angular_frequency_is_converted():
    assert Harmonic(1.0, "5 rad/s").frequency == pytest.approx(5.0 / math.tau, rel=1e-15)


def test_derived_values():
    harmonic = Harmonic(1.0, 2.5)
    assert harmonic.angular_frequency == math.tau * 2.5
    assert harmonic.period == 0.4


@pytest.mark.parametrize("bad", [0, 0.0, -2.5, "-2.5 Hz", math.nan, math.inf, "2.5 mm", False, ""])
def test_a_frequency_is_positive(bad):
    with pytest.raises(InputError, match=r"^frequency: .*; a frequency greater than 0 is accepted"):
        Harmonic(1.0, bad)


@pytest.mark.parametrize("bad", [-1.0, "-0.05 g", math.nan, "0.05 kg", None])
def test_an_amplitude_is_not_negative(bad):
    with pytest.raises(InputError, match=r"^amplitude: .*; an acceleration of at least 0"):
        Harmonic(bad, 1.0)


@pytest.mark.parametrize("bad", [math.inf, "1 mm", True])
def test_a_phase_is_a_finite_angle(bad):
    with pytest.raises(InputError, match=r"^phase: .*; an angle is accepted"):
        Harmonic(1.0, 1.0, bad)


def test_zero_amplitude_is_ordinary():
    assert Harmonic(0, 1).amplitude == 0.0


def test_str():
    assert str(Harmonic("0.05 g", 2.5)) == (
        "Harmonic(amplitude=0.490333 m/s², frequency=2.5 Hz, phase=0 rad)"
    )
