"""Dashpots for a wanted restitution, against the impact itself in fifty digits."""

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from vibroimpact.errors import InputError
from vibroimpact.model import GRAVITY, Bumper, Oscillator, RigidStop


def returned(mass: float, stiffness: float, damping: float) -> mpf:
    """-v(t1)/v(0) of M x″ + C x′ + K x = 0, x(0) = 0, at the first t1 with K x + C x′ = 0.

    x = e^{-βt} sin(wt)/w v: at the zero of the force x″ = 0, and so tan(w t1) = 2 β w/(β² - w²),
    with hyperbolic functions for an overdamped contact.
    """
    beta = mpf(damping) / (2 * mpf(mass))
    # Exactly critical damping is the limit.
    square = mpf(stiffness) / mpf(mass) - beta**2 or mpf(10) ** -100
    w = mp.sqrt(abs(square))
    if square > 0:
        t = mp.atan2(2 * beta * w, beta**2 - square) / w
        sine, cosine = mp.sin(w * t), mp.cos(w * t)
    else:
        t = mp.atanh(2 * beta * w / (beta**2 + w**2)) / w
        sine, cosine = mp.sinh(w * t), mp.cosh(w * t)
    x = sine / w
    v = cosine - beta * sine / w
    assert abs(stiffness * x + damping * v) < mpf(10) ** -30 * (stiffness * x)
    return -mp.exp(-beta * t) * v


@settings(max_examples=200)
@given(
    st.floats(1e-12, 1.0, exclude_max=True),
    st.floats(-3, 6).map(lambda x: 10.0**x),
    st.floats(-3, 9).map(lambda x: 10.0**x),
)
@example(0.1353352832366127, 1.0, 1.0)  # critical to rounding
@example(0.13533528323661, 550.0, 510e3)
@example(1.0 - 1e-9, 1.0, 1.0)
@example(1e-100, 1.0, 1.0)
def test_a_free_impact_returns_it(restitution, mass, stiffness):
    bumper = Bumper.from_restitution(mass, stiffness, restitution, 0.01)
    assert (bumper.stiffness, bumper.gap) == (stiffness, 0.01)
    with mp.workdps(400):
        e = returned(mass, stiffness, bumper.damping)
        assert abs(e - restitution) <= 1e-14 * restitution * max(1.0, -float(mp.log(e)))


def test_a_full_return_needs_no_dashpot():
    assert Bumper.from_restitution(550.0, 510e3, 1.0, 0.0) == Bumper(510e3, 0.0, 0.0)


@pytest.mark.parametrize(("asked", "got"), [(0.3, 0.397), (0.5, 0.550), (0.7, 0.718), (0.9, 0.902)])
def test_the_usual_formula_is_for_a_contact_that_pulls(asked, got):
    """-ln e/√(π² + ln² e) is the damping ratio for a release at zero deformation."""
    loss = -mp.log(asked)
    usual = float(2 * loss / mp.sqrt(mp.pi**2 + loss**2))
    with mp.workdps(50):
        e = returned(1.0, 1.0, usual)
    assert float(e) == pytest.approx(got, abs=5e-4)
    assert Bumper.from_restitution(1.0, 1.0, asked, 0.0).damping > usual


def test_units_are_read():
    text = Bumper.from_restitution("0.55 t", "510 kN/m", "0.5", "7.5 mm")
    assert text == Bumper.from_restitution(550.0, 510e3, 0.5, 0.0075)


@pytest.mark.parametrize(
    ("field", "bad"), [("mass", 0.0), ("stiffness", -1.0), ("restitution", 0.0), ("gap", "1 s")]
)
def test_what_cannot_be_used_is_named(field, bad):
    values = {"mass": 1.0, "stiffness": 1.0, "restitution": 0.5, "gap": 0.0, field: bad}
    with pytest.raises(InputError, match=f"^{field}: "):
        Bumper.from_restitution(**values)
    with pytest.raises(InputError, match=r"^restitution: 1.1 is greater than 1"):
        Bumper.from_restitution(1.0, 1.0, 1.1, 0.0)


ISOLATOR = {"period": "2.5 s", "damping_ratio": 0.15}
WALL = {"stiffness": "2000 MN/m", "restitution": 0.6, "gap": "300 mm"}


def test_a_table_may_have_it_in_place_of_the_damping():
    direct = Bumper.from_restitution("5000 t", "2000 MN/m", 0.6, "300 mm")
    for table in (WALL, {"kind": "kelvin-voigt", **WALL}):
        for mass in ({"mass": "5000 t"}, {"weight": 5e6 * GRAVITY}):
            rig = Oscillator.model_validate({**mass, "isolator": ISOLATOR, "left": table})
            assert rig.left == direct
    assert Oscillator("5000 t", ISOLATOR, right=WALL).right == direct
    rigid = {"kind": "rigid", "restitution": 0.6, "gap": 1}
    assert Oscillator("5000 t", ISOLATOR, right=rigid).right == RigidStop(0.6, 1.0)


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        (
            {"damping": 3},
            "right.restitution: this bumper also has a damping; remove one of the two",
        ),
        ({"restitution": 1.6}, "right.restitution: 1.6 is greater than 1"),
        ({"stiffness": "2 MN"}, "right.stiffness: '2 MN' is a force"),
        ({"stiffness": None}, "right.stiffness: missing"),
        ({"gap": None}, "right.gap: missing"),
    ],
)
def test_what_of_a_table_cannot_be_used(changes, line):
    table = {name: value for name, value in {**WALL, **changes}.items() if value is not None}
    with pytest.raises(InputError, match=f"^{line}"):
        Oscillator("5000 t", ISOLATOR, right=table)


def test_a_bumper_alone_has_no_mass_for_it():
    with pytest.raises(InputError, match=r"^restitution: unknown key"):
        Bumper.model_validate(WALL)
    with pytest.raises(InputError, match="mass: '3 m' is a length"):
        Oscillator.model_validate({"mass": "3 m", "isolator": ISOLATOR, "right": WALL})
