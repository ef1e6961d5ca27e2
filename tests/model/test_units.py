"""Text with units to SI numbers and back."""

import math
import subprocess
import sys
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic
from vibroimpact.model.quantities import (
    ACCELERATION,
    ANGLE,
    DAMPING,
    DIMENSIONLESS,
    ENERGY,
    FORCE,
    FREQUENCY,
    GRAVITY,
    IMPULSE,
    LENGTH,
    MASS,
    STIFFNESS,
    TIME,
    VELOCITY,
)
from vibroimpact.model.units import _measured, pretty, to_si

QUANTITIES = [
    LENGTH,
    MASS,
    STIFFNESS,
    DAMPING,
    ACCELERATION,
    FREQUENCY,
    TIME,
    VELOCITY,
    ANGLE,
    DIMENSIONLESS,
    FORCE,
    IMPULSE,
    ENERGY,
]


@pytest.mark.parametrize(
    ("text", "quantity", "expected"),
    [
        ("15 mm", LENGTH, 0.015),
        ("15mm", LENGTH, 0.015),
        ("1.5e1 mm", LENGTH, 0.015),
        ("15\u00a0mm", LENGTH, 0.015),
        ("−15 mm", LENGTH, -0.015),
        ("15 µm", LENGTH, 15e-6),
        ("1 inch", LENGTH, 0.0254),
        ("15", LENGTH, 15.0),
        ("  15  ", LENGTH, 15.0),
        (".5 m", LENGTH, 0.5),
        ("510 kN/m", STIFFNESS, 510000.0),
        ("26.8 kN/m", STIFFNESS, 26800.0),
        ("28.732 kN/m", STIFFNESS, 28732.0),
        ("1 N/mm", STIFFNESS, 1000.0),
        ("1 kgf/mm", STIFFNESS, 9806.65),
        ("1 kip/in", STIFFNESS, 4448.2216152605 / 0.0254),
        ("2 tf/mm", STIFFNESS, 2 * 9806650.0),
        ("1 short_ton", MASS, 907.18474),
        ("1 long_ton", MASS, 1016.0469088),
        ("3 tonne", MASS, 3000.0),
        ("2 lb", MASS, 0.90718474),
        ("3 ft", LENGTH, 0.9144),
        ("10 mph", VELOCITY, 4.4704),
        ("1.1 kN s/m", DAMPING, 1100.0),
        ("1.1 kN*s/m", DAMPING, 1100.0),
        ("1.1 kN·s/m", DAMPING, 1100.0),
        ("1.1kN s / m", DAMPING, 1100.0),
        ("1.1 kN/(m/s)", DAMPING, 1100.0),
        ("0.05 g", ACCELERATION, 0.4903325),
        ("0.05g", ACCELERATION, 0.4903325),
        ("0.05G", ACCELERATION, 0.4903325),
        ("50 mg", ACCELERATION, 0.4903325),
        ("3 m/s^2", ACCELERATION, 3.0),
        ("3 m/s**2", ACCELERATION, 3.0),
        ("3 m/s²", ACCELERATION, 3.0),
        ("3 m/s2", ACCELERATION, 3.0),
        ("3 m s-2", ACCELERATION, 3.0),
        ("3 m s^-2", ACCELERATION, 3.0),
        ("3 m·s⁻²", ACCELERATION, 3.0),
        ("300 Gal", ACCELERATION, 3.0),
        ("300 gal", ACCELERATION, 3.0),
        ("300GAL", ACCELERATION, 3.0),
        ("300 mGal", ACCELERATION, 0.003),
        ("3 N/kg", ACCELERATION, 3.0),
        ("550 kg", MASS, 550.0),
        ("0.3 t", MASS, 300.0),
        ("5 gram", MASS, 0.005),
        ("2.5Hz", FREQUENCY, 2.5),
        ("1 kHz", FREQUENCY, 1000.0),
        ("5 1/s", FREQUENCY, 5.0),
        ("20 ms", TIME, 0.02),
        ("1 min", TIME, 60.0),
        ("150 mm/s", VELOCITY, 0.15),
        ("2 rad", ANGLE, 2.0),
        ("180 deg", ANGLE, math.pi),
        ("180°", ANGLE, math.pi),
        ("0.15", DIMENSIONLESS, 0.15),
        ("15 %", DIMENSIONLESS, 0.15),
        ("3 mm/m", DIMENSIONLESS, 0.003),
    ],
)
def test_text_with_units_is_rounded_once(text, quantity, expected):
    assert to_si(text, quantity, "x") == expected


@pytest.mark.parametrize(
    ("text", "hertz"),
    [
        ("2.5 rad/s", 2.5 / math.tau),
        ("60 rpm", 1.0),
        ("360 deg/s", 1.0),
        ("3 turn/s", 3.0),
        ("2.5 krad/s", 2500.0 / math.tau),
    ],
)
def test_an_angular_frequency_is_counted_in_cycles(text, hertz):
    # A plain dimensional conversion would call 2.5 rad/s 2.5 Hz.
    assert to_si(text, FREQUENCY, "frequency") == pytest.approx(hertz, rel=1e-15)


def test_gravity_is_the_standard_one():
    assert GRAVITY == 9.80665
    assert to_si("1 g", ACCELERATION, "amplitude") == GRAVITY
    assert to_si("1 standard_gravity", ACCELERATION, "amplitude") == GRAVITY


@pytest.mark.parametrize(
    "value", [3, 3.0, np.float64(3.0), np.float32(3.0), np.int64(3), np.array(3.0), Decimal(3)]
)
def test_any_real_number_is_taken_in_si(value):
    result = to_si(value, LENGTH, "gap")
    assert result == 3.0
    assert type(result) is float


def test_a_fraction_is_a_number():
    assert to_si(Fraction(1, 4), LENGTH, "gap") == 0.25


def test_a_pint_quantity_is_converted():
    pint = pytest.importorskip("pint")
    registry = pint.UnitRegistry()
    assert to_si(15 * registry.mm, LENGTH, "gap") == pytest.approx(0.015, rel=1e-15)
    turn = to_si(60.0 * registry.rpm, FREQUENCY, "frequency")
    assert turn == pytest.approx(1.0, rel=1e-15)
    with pytest.raises(InputError, match="is a mass"):
        to_si(15 * registry.kg, LENGTH, "gap")
    with pytest.raises(InputError, match="is not a number"):
        to_si(np.array([1.0, 2.0]) * registry.mm, LENGTH, "gap")


def test_no_negative_zero_comes_out():
    assert math.copysign(1.0, to_si(-0.0, LENGTH, "gap")) == 1.0
    assert math.copysign(1.0, to_si("-0 mm", LENGTH, "gap")) == 1.0


def test_the_message_names_field_value_and_what_is_accepted():
    with pytest.raises(InputError) as caught:
        to_si("15 kg", LENGTH, "gap")
    assert str(caught.value) == (
        "gap: '15 kg' is a mass; use a length, such as \"15 mm\" or 0.015 (m)"
    )


@pytest.mark.parametrize(
    ("value", "quantity", "words"),
    [
        (True, LENGTH, "True is not a number"),
        (np.True_, LENGTH, "is not a number"),
        (None, LENGTH, "None is not a number"),
        ([1.0], LENGTH, "is not a number"),
        (np.arange(99.0).reshape(3, 33), LENGTH, "is not a number"),
        (1 + 2j, LENGTH, "is not a number"),
        (math.nan, LENGTH, "nan is not finite"),
        (math.inf, LENGTH, "inf is not finite"),
        (10**400, LENGTH, "is not finite"),
        (Decimal("sNaN"), LENGTH, "is not finite"),
        ("nan", LENGTH, "'nan' is not finite"),
        ("-inf mm", LENGTH, "is not finite"),
        ("Infinity", LENGTH, "is not finite"),
        ("∞", LENGTH, "is not finite"),
        ("1e400", LENGTH, "is not finite"),
        ("1e400 mm", LENGTH, "is not finite"),
        ("1e99999999999 mm", LENGTH, "is not finite"),
        ("", LENGTH, "'' is empty"),
        (" \n ", LENGTH, "is empty"),
        ("mm", LENGTH, "does not start with a number"),
        ("15,5 mm", LENGTH, "has a comma; write a decimal point"),
        ("15 furlogs", LENGTH, "unknown unit"),
        ("15 mm +", LENGTH, "cannot be read"),
        ("15 mm; print(1)", LENGTH, "cannot be read"),
        ("9 m^9^9^9^9", LENGTH, "cannot be read"),
        ("9 m^99999999", LENGTH, "cannot be read"),
        ("1 2 mm", LENGTH, "cannot be read"),
        ("15 kg", LENGTH, "is a mass"),
        ("15 N", LENGTH, "is a force"),
        ("15 mm²", LENGTH, "is an area"),
        ("15 degC", LENGTH, "is a temperature"),
        ("15 dB", LENGTH, "is not a length"),
        ("15 mm rad", LENGTH, "is not a length"),
        ("15 mm", STIFFNESS, "is a length"),
        ("15 kN/m", DAMPING, "is a stiffness"),
        ("15 kN s/m", STIFFNESS, "is a damping"),
        ("0.05 kg", ACCELERATION, "is a mass"),
        ("9.81 m/s", ACCELERATION, "is a velocity"),
        ("5000 g", MASS, "has a g, which is gravity here; write gram, kg or t"),
        ("5 mg", MASS, "write gram, kg or t"),
        ("5000 ton", MASS, "has the ambiguous unit 'ton'; write t (1000 kg), short_ton (907"),
        ("5 tons", MASS, "ambiguous unit 'tons'; write t (1000 kg)"),
        ("5 kton", MASS, "ambiguous unit 'kton'; write t (1000 kg)"),
        (
            "5 ton_force/m",
            STIFFNESS,
            "ambiguous unit 'ton_force'; write tf (9.807 kN), short_ton_f",
        ),
        ("5 cwt", MASS, "write short_hundredweight (45.36 kg) or long_"),
        ("550 gr", MASS, "write gram, or grain (64.8 mg)"),
        ("5000 mt", MASS, "ambiguous unit 'mt'; write t (1000 kg)"),
        ("15 Mm", LENGTH, "ambiguous unit 'Mm'; write mm, or km"),
        ("0.15 zeta", DIMENSIONLESS, "has a unit that is not accepted, 'zeta'"),
        ("2 a", TIME, "a unit that is not accepted, 'a'"),
        ("0.1 c", VELOCITY, "a unit that is not accepted, 'c'"),
        ("3 statF", LENGTH, "a unit that is not accepted, 'statF'"),
        ("5 u", MASS, "a unit that is not accepted, 'u'"),
        ("1 Ly", STIFFNESS, "a unit that is not accepted, 'Ly'"),
        ("49033.25 kN", MASS, "is a force, the weight of 5000 t"),
        ("-5 N", MASS, "is a force"),
        ("0.4 s", FREQUENCY, "is a time"),
        ("5 Bq", FREQUENCY, "is not a frequency"),
        ("15 %", ANGLE, "is a dimensionless number"),
        ("15 deg", DIMENSIONLESS, "is an angle"),
        ("2 rad/s", LENGTH, "is an angular frequency"),
    ],
)
def test_what_cannot_be_read_is_refused_in_one_line(value, quantity, words):
    with pytest.raises(InputError) as caught:
        to_si(value, quantity, "field")
    message = str(caught.value)
    assert message.startswith("field: ")
    assert words in message
    assert f"; use {quantity.phrase}, such as" in message
    assert "\n" not in message
    assert len(message) < 250


@pytest.mark.parametrize(
    ("value", "bounds", "words"),
    [
        (0.0, {"above": 0.0}, "0.0 is not greater than 0; use a length greater than 0"),
        ("-1 mm", {"minimum": 0.0}, "is less than 0; use a length of at least 0"),
        (1.0, {"maximum": 0.0}, "is greater than 0; use a length of at most 0"),
    ],
)
def test_bounds(value, bounds, words):
    with pytest.raises(InputError, match=words):
        to_si(value, LENGTH, "gap", **bounds)


@pytest.mark.parametrize(
    ("value", "quantity", "text"),
    [
        (510000.0, STIFFNESS, "510 kN/m"),
        (2300e3, STIFFNESS, "2300 kN/m"),
        (1.0, STIFFNESS, "1 N/m"),
        (900.0, DAMPING, "0.9 kN s/m"),
        (0.0075, LENGTH, "7.5 mm"),
        (0.0, LENGTH, "0 m"),
        (-0.002, LENGTH, "-2 mm"),
        (550.0, MASS, "550 kg"),
        (0.4903325, ACCELERATION, "0.05 g"),
        (1.3141, ACCELERATION, "0.134001 g"),
        (0.0, ACCELERATION, "0 m/s²"),
        (79.2e6, FORCE, "79.2 MN"),
        (999.9999999e3, FORCE, "1 MN"),
        (-2.4e9, FORCE, "-2.4 GN"),
        (5e12, MASS, "5e+09 t"),
        (0.312, LENGTH, "312 mm"),
        (5e6, DAMPING, "5 MN s/m"),
        (0.05, MASS, "0.05 kg"),
        (2.5, FREQUENCY, "2.5 Hz"),
        (0.15, DIMENSIONLESS, "0.15"),
    ],
)
def test_pretty(value, quantity, text):
    assert pretty(value, quantity) == text


@given(
    st.sampled_from(QUANTITIES),
    st.floats(min_value=1e-12, max_value=1e12),
    st.sampled_from([-1.0, 1.0]),
)
def test_pretty_text_reads_back(quantity, size, sign):
    value = sign * size
    assert to_si(pretty(value, quantity), quantity, "x") == pytest.approx(value, rel=1e-5)


@given(
    st.sampled_from(QUANTITIES),
    st.floats(min_value=1e-9, max_value=1e9),
    st.integers(min_value=3, max_value=12),
)
def test_what_is_printed_reads_back_to_its_digits(quantity, size, digits):
    text = pretty(size, quantity, digits)
    assert abs(to_si(text, quantity, "x") - size) <= 0.5000001 * size * 10.0 ** (1 - digits)
    # Between the units that there are, no power of ten is needed.
    first, last = quantity.scales[-1].size, quantity.scales[0].size
    if 1e-3 * first <= size <= 1e6 * last:
        assert "e" not in text.split()[0]


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(QUANTITIES))
def test_a_float_passes_unchanged(value, quantity):
    assert to_si(value, quantity, "x") == value
    assert to_si(repr(value), quantity, "x") == value


def check_read_or_refused(text, quantity):
    try:
        outcome = to_si(text, quantity, "x")
    except InputError as error:
        outcome = str(error)
    assert "\n" not in outcome if isinstance(outcome, str) else math.isfinite(outcome)


@given(st.text(max_size=30), st.sampled_from(QUANTITIES))
def test_any_text_is_read_or_refused(text, quantity):
    check_read_or_refused(text, quantity)


@given(
    st.from_regex(r"[0-9][0-9.e]{0,3} ?[mskgNHz/*^ ()0-9-]{0,12}", fullmatch=True),
    st.sampled_from(QUANTITIES),
)
def test_any_text_like_units_is_read_or_refused(text, quantity):
    check_read_or_refused(text, quantity)


def test_pint_is_imported_for_unusual_units_only():
    program = (
        "import sys, vibroimpact.model as m\n"
        "m.Bumper(510e3, '900', 0.0075), m.laboratory.campaign(), m.laboratory.table_1()\n"
        "assert 'pint' not in sys.modules\n"
        "m.Bumper('510 kN/m', 900, 0)\n"
        "assert 'pint' not in sys.modules\n"
        "m.Bumper('1 kip/inch', 900, 0)\n"
        "assert 'pint' in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


@pytest.mark.parametrize("quantity", QUANTITIES, ids=lambda q: q.name)
def test_units_in_which_a_quantity_is_written_mean_what_pint_says(quantity):
    for scale in quantity.scales:
        if scale.symbol:
            for number in ("1", "26.8", "-0.1", "3e-7"):
                measured = _measured(Decimal(number), scale.symbol, quantity)
                assert to_si(f"{number} {scale.symbol}", quantity, "x") == float(measured)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 m%", "has % and a unit"),
        ("1 m %", "has % and a unit"),
        ("1 % m", "has % and a unit"),
        ("1 m*%", "has % and a unit"),
        ("1 m percent", "has percent and a unit"),
        ("1 ppm m", "has ppm and a unit"),
        ("1e-9999999999999999999m", "is smaller than the smallest floating-point number"),
        ("1e-9999999999999999999", "is smaller than the smallest floating-point number"),
        ("1e9999999999999999999m", "is not finite"),
        ("1e-999999999 m", "is smaller than the smallest floating-point number"),
        ("-1e-400", "is smaller than the smallest floating-point number"),
        ("1 " + "m*" * 50_000 + "m", "has 100003 characters, more than the accepted 200"),
    ],
)
def test_texts_that_say_nothing_sure_are_refused_at_once(text, message):
    with pytest.raises(InputError) as refused:
        to_si(text, LENGTH, "gap")
    assert message in str(refused.value)
    assert len(str(refused.value)) < 300
    assert to_si("0e-999999999 m", LENGTH, "gap") == 0.0
    assert to_si("0e-9999999999999999999m", LENGTH, "gap") == 0.0


@pytest.mark.parametrize("value", [1e-320, 1e-101, "1e-200 Hz", 1e101, 1e308, "1e305 kHz"])
def test_frequencies_whose_period_is_no_number_are_refused(value):
    with pytest.raises(InputError, match=r"^frequency: .* is not between 1e-100 and 1e"):
        Harmonic(1.0, value)
    with pytest.raises(InputError, match="is not between"):
        to_si(value, FREQUENCY, "frequencies[0]", above=0.0)
