"""The motion of the base."""

import math

import numpy as np
import pytest

from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Harmonic, Isolator, Oscillator, Periodic


def test_an_angular_frequency_is_converted():
    assert Harmonic(1.0, "5 rad/s").frequency == pytest.approx(5.0 / math.tau, rel=1e-15)


@pytest.mark.parametrize("bad", [0, 0.0, -2.5, "-2.5 Hz", math.nan, math.inf, "2.5 mm", False, ""])
def test_a_frequency_is_positive(bad):
    with pytest.raises(InputError, match=r"^frequency: .*; use a frequency greater than 0"):
        Harmonic(1.0, bad)


@pytest.mark.parametrize("bad", [-1.0, "-0.05 g", math.nan, "0.05 kg", None])
def test_an_amplitude_is_not_negative(bad):
    with pytest.raises(InputError, match=r"^amplitude: .*; use an acceleration of at least 0"):
        Harmonic(bad, 1.0)


@pytest.mark.parametrize("bad", [math.inf, "1 mm", True])
def test_a_phase_is_a_finite_angle(bad):
    with pytest.raises(InputError, match=r"^phase: .*; use an angle"):
        Harmonic(1.0, 1.0, bad)


def test_str():
    assert str(Harmonic("0.05 g", 2.5)) == (
        "Harmonic(amplitude=0.05 g, frequency=2.5 Hz, phase=0 rad)"
    )


@pytest.mark.parametrize(
    ("amplitude", "of", "value"),
    [
        (2.0, "acceleration", 2.0),
        ("0.1 g", "acceleration", 0.980665),
        ("5 mm", "displacement", 0.005),
        ("120 N", "force", 120.0),
        ("0.12 kN", "force", 120.0),
        ("0.4 kg m", "unbalance", 0.4),
        ("400 kg·mm", "unbalance", 0.4),
        ("400000 g mm", "unbalance", 0.4),
    ],
)
def test_the_dimension_of_the_amplitude_decides(amplitude, of, value):
    one, several = Harmonic(amplitude, 2.0), Periodic(2.0, [amplitude, amplitude])
    assert (one.of, several.of) == (of, of)
    assert one.amplitude == pytest.approx(value, rel=1e-15)
    assert several.amplitudes == (one.amplitude,) * 2
    assert one.moves_base == (of in ("acceleration", "displacement"))
    omega = one.angular_frequency
    expected = {
        "acceleration": value,
        "displacement": value * omega**2,
        "force": value / 3.0,
        "unbalance": value * omega**2 / 3.0,
    }[of]
    assert float(one.acceleration(3.0, omega)) == pytest.approx(expected, rel=1e-15)
    first, second = several.acceleration(3.0, omega)
    assert first == pytest.approx(expected, rel=1e-15)
    grows = of in ("displacement", "unbalance")
    assert second / first == pytest.approx(4.0 if grows else 1.0, rel=1e-15)


def test_a_wave_from_its_harmonics():
    several = Periodic(2.0, (1.0, 0.0, 0.5), (0.1, 0.0, 2.0))
    angle = np.linspace(0.0, 7.0, 23)
    expected = np.sin(angle + 0.1) + 0.5 * np.sin(3 * angle + 2.0)
    np.testing.assert_allclose(several.at(angle), expected, atol=1e-15)
    moved = Periodic(2.0, (1.0, 0.0, 0.5), (0.1, 0.0, 2.0), of="displacement")
    second = np.sin(angle + 0.1) + 4.5 * np.sin(3 * angle + 2.0)  # minus d²/dθ²
    np.testing.assert_allclose(moved.at(angle), -(moved.angular_frequency**2) * second, rtol=1e-12)


def test_the_force_of_an_unbalance_is_that_of_what_rotates():
    """m e ω² of each harmonic, at its own angular frequency; of the sign of a force."""
    one = Harmonic("0.4 kg m", "5 Hz", "90 deg")
    assert float(one.at(one.phase)) == pytest.approx(0.4 * (10.0 * math.pi) ** 2, rel=1e-15)
    several = Periodic("5 Hz", ("0.4 kg m", "0.05 kg m"), (0.0, 1.0))
    angle = np.linspace(0.0, 7.0, 23)
    expected = 0.4 * np.sin(angle) + 4.0 * 0.05 * np.sin(2.0 * angle + 1.0)
    np.testing.assert_allclose(several.at(angle), (10.0 * math.pi) ** 2 * expected, rtol=1e-12)
    assert (str(one).split(",")[0], several.of) == ("Harmonic(amplitude=0.4 kg m", "unbalance")


def test_half_waves():
    assert Harmonic(1.0, 1.0).half_wave
    assert Periodic(1.0, (1.0, 0.0, 2.0, 0.0)).half_wave
    assert not Periodic(1.0, (1.0, 0.1)).half_wave


def test_a_new_amplitude_scales_all_harmonics():
    scaled = Periodic(1.0, ("2 mm", "1 mm")).replace(amplitude="6 mm")
    assert scaled.amplitudes == pytest.approx((0.006, 0.003))
    assert scaled.of == "displacement"


@pytest.mark.parametrize(
    "one",
    [
        Harmonic("5 mm", 2.0, 0.3),
        Harmonic("120 N", 2.0),
        Harmonic("90 g mm", 50.0),
        Periodic(2.0, ("5 mm", "1 mm"), (0.0, 1.0), 0.2),
        Periodic(2.0, (1.0, 0.5)),
        Oscillator(2.0, Isolator(0.0, 0.0), Bumper(5.0, 0.1, 0.1), Bumper(5.0, 0.1, 0.1), "1 kN"),
    ],
)
def test_there_and_back(one):
    names = {k: v for k, v in globals().items() if k in ("Harmonic", "Periodic", "Oscillator")}
    assert eval(repr(one), {**names, "Isolator": Isolator, "Bumper": Bumper}) == one
    assert type(one).model_validate_json(one.model_dump_json()) == one
    assert type(one).model_validate(one.model_dump()) == one


@pytest.mark.parametrize(
    ("make", "line"),
    [
        (lambda: Periodic(1.0, (1.0, 2.0), (0.0,)), "phases: 1 given for 2 amplitudes; "),
        (lambda: Periodic(1.0, (1.0,), (0.0, 1.0)), "phases: 2 given for 1 amplitude; "),
        (lambda: Periodic(1.0, ()), "amplitudes: 0 harmonics; pass 1 to 32"),
        (lambda: Periodic(1.0, [1.0] * 33), "amplitudes: 33 harmonics; pass 1 to 32"),
        (lambda: Periodic(1.0, (0.0, 0.0)), r"amplitudes: \[0.0, 0.0\] are all 0"),
        (lambda: Periodic(1.0, ("5 mm", "1 N")), r"amplitudes\[1\]: "),
        (lambda: Periodic(1.0, (1.0, math.nan)), r"amplitudes\[1\]: "),
        (lambda: Periodic(1.0, (1.0, -1.0)), r"amplitudes\[1\]: "),
        (lambda: Periodic(1.0, 1.0), "amplitudes: 1.0 is not a list"),
        (lambda: Periodic(1.0, "1 mm"), "amplitudes: '1 mm' is not a list"),
        (lambda: Periodic(0.0, (1.0,)), "frequency: "),
        (lambda: Periodic(1.0, (1.0,), (math.inf,)), r"phases\[?\.?0?\]?: "),
        (lambda: Harmonic("5 mm", 1.0, of="force"), "amplitude: "),
        (lambda: Harmonic(1.0, 1.0, of="velocity"), "of: 'velocity'"),
        (lambda: Harmonic("5 m/s", 1.0), "amplitude: "),
        (
            lambda: Harmonic("5 kg", 1.0),
            'amplitude: .*, or a force such as "120 N", or an unbalance such as "0.4 kg m"',
        ),
        (lambda: Oscillator(1.0, Isolator(0.0, 0.1)), "isolator.stiffness: 0, and nothing holds"),
        (
            lambda: Oscillator(1.0, Isolator(0.0, 0.1), Bumper(1.0, 0.0, 0.1), force=-1.0),
            "isolator.stiffness: 0, and nothing holds the mass against a force of -1 N",
        ),
        (lambda: Oscillator(1.0, Isolator(1.0, 0.1), force=math.nan), "force: "),
        (lambda: Oscillator(1.0, Isolator(1.0, 0.1), force="5 m"), "force: "),
    ],
)
def test_refused_in_one_line(make, line):
    with pytest.raises(InputError, match=f"^{line}") as refused:
        make()
    assert "\n" not in str(refused.value)
