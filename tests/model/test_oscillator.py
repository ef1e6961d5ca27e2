"""Mass, isolator and bumpers."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Isolator, Oscillator, RigidStop

ISOLATOR = Isolator(26800.0, 1100.0)
RIGHT = Bumper(510e3, 900.0, 0.0075)
LEFT = Bumper(100e3, 0.0, 0.0)


def test_positions_keywords_and_text_agree():
    assert Isolator("26.8 kN/m", "1.1 kN s/m") == ISOLATOR
    assert Isolator(damping=1100, stiffness=26800) == ISOLATOR
    assert Bumper("510 kN/m", "0.9 kN s/m", "7.5 mm") == RIGHT
    assert Bumper(gap="7.5 mm", damping="900", stiffness=510000) == RIGHT
    assert Oscillator("0.55 t", ISOLATOR, left=LEFT, right=RIGHT) == Oscillator(
        550.0, ISOLATOR, RIGHT, LEFT
    )


@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, math.inf, "", "nan", True, None, "1 K"])
def test_a_mass_or_a_stiffness_is_positive_and_finite(bad):
    for make in (
        lambda: Oscillator(bad, ISOLATOR),
        lambda: Bumper(bad, 0.0, 0.0),
    ):
        with pytest.raises(InputError, match=r"^(mass|stiffness): .*; use .* greater than 0"):
            make()


@pytest.mark.parametrize("bad", [-1.0, math.nan, math.inf, "", True, None, "1 K"])
def test_the_stiffness_of_an_isolator_may_be_0(bad):
    assert Isolator(0.0, 0.0).stiffness == 0.0
    with pytest.raises(InputError, match=r"^stiffness: .*; use .* of at least 0"):
        Isolator(bad, 0.0)


def test_without_a_spring_something_must_hold_the_mass():
    free = Isolator(0.0, 1.0)
    Oscillator(1.0, free, right=RIGHT, force=2.0)
    Oscillator(1.0, free, left=RIGHT, force=-2.0)
    Oscillator(1.0, free, right=RIGHT, left=RIGHT)
    for stops, force in (({}, 0.0), ({"left": RIGHT}, 2.0), ({"right": RIGHT}, -2.0)):
        with pytest.raises(InputError, match=r"isolator.stiffness: 0, and nothing holds the mass"):
            Oscillator(1.0, free, **stops, force=force)


@pytest.mark.parametrize("what", ["natural_frequency", "damping_ratio"])
def test_what_needs_a_spring_says_so(what):
    rig = Oscillator(1.0, Isolator(0.0, 1.0), RIGHT, RIGHT)
    assert rig.angular_frequency == 0.0
    with pytest.raises(InputError, match=f"^isolator.stiffness: 0, .* no {what.replace('_', ' ')}"):
        getattr(rig, what)


@pytest.mark.parametrize("bad", [-1e-300, math.nan, -math.inf, "-1", True, None, "1 K"])
def test_a_damping_is_not_negative(bad):
    for make in (lambda: Isolator(1.0, bad), lambda: Bumper(1.0, bad, 0.0)):
        with pytest.raises(InputError, match=r"^damping: .*; use .* of at least 0"):
            make()


@pytest.mark.parametrize("bad", [math.nan, -math.inf, "", True, None, "1 K"])
def test_a_gap_is_finite(bad):
    for make in (lambda: Bumper(1.0, 0.0, bad), lambda: RigidStop(1.0, bad)):
        with pytest.raises(InputError, match=r"^gap: .*; use a length"):
            make()


@pytest.mark.parametrize("bad", [-0.1, 1.1, math.nan, True, None, "1 m"])
def test_a_restitution_lies_between_0_and_1(bad):
    with pytest.raises(InputError, match=r"^restitution: .*; use .* from 0 to 1"):
        RigidStop(bad, 0.0)


@pytest.mark.parametrize(("right", "left"), [(0.0, 0.0), (-0.001, 0.001), (0.002, -0.003)])
def test_two_rigid_stops_need_space_between_them(right, left):
    with pytest.raises(
        InputError, match=r"right.gap: .* leave no room .*; use gaps .* greater than 0"
    ):
        Oscillator(1.0, ISOLATOR, RigidStop(0.5, right), RigidStop(0.5, left))
    # A bumper gives way.
    Oscillator(1.0, ISOLATOR, RigidStop(0.5, right), Bumper(1.0, 0.0, left))


def test_a_symmetric_rig_has_equal_stops_of_one_kind():
    wall = RigidStop(0.5, 0.01)
    assert Oscillator(550.0, ISOLATOR, wall, wall).symmetric
    assert not Oscillator(550.0, ISOLATOR, wall, RIGHT).symmetric
    assert Oscillator(550.0, ISOLATOR, wall, RIGHT).mirrored().left == wall


def test_an_unknown_argument_is_refused():
    with pytest.raises(InputError, match=r"^colour: unknown key; use stiffness, damping or gap"):
        Bumper(1.0, 1.0, 0.0, colour="red")
    with pytest.raises(InputError, match=r"^dampng: .*; did you mean damping\? Use stiffness, "):
        Isolator(1.0, dampng=0.0)
    with pytest.raises(TypeError, match="damping"):
        Isolator(1.0)


@pytest.mark.parametrize(
    "rig",
    [
        {"mass": 1e200},
        {"mass": 1e-300},
        {"force": -1e150},
        {"isolator": {"stiffness": 1.0, "damping": 1e200}},
        {"right": {"stiffness": 1e200, "damping": 0.0, "gap": 1.0}},
    ],
)
def test_a_size_that_cannot_be_computed_with_is_refused(rig):
    with pytest.raises(
        InputError, match=r"is too (large; pass at most 1e\+100|small; pass at least 1e-100) "
    ):
        Oscillator(**{"mass": 1.0, "isolator": {"stiffness": 1.0, "damping": 0.0}, **rig})


def test_a_rig_whose_sizes_do_not_go_together_is_refused():
    with pytest.raises(
        InputError, match=r"natural angular frequency is about 1e\+90 rad/s, but only values from"
    ):
        Oscillator(1e-90, Isolator(1e90, 0.0))
    with pytest.raises(
        InputError, match=r"natural angular frequency is about 1e-150 rad/s, but only values from"
    ):
        Oscillator(1.0, Isolator(1e-300, 0.0))
    with pytest.raises(InputError, match=r"damping ratio is about 1e\+90, but only values from 0"):
        Oscillator(1e-90, Isolator(1e-90, 1.0))


def test_frequency_and_damping_ratio():
    oscillator = Oscillator(4.0, Isolator(100.0, 2.0))
    assert oscillator.angular_frequency == 5.0
    assert oscillator.natural_frequency == 5.0 / math.tau
    assert oscillator.damping_ratio == 0.05


def test_mirrored_exchanges_the_sides():
    oscillator = Oscillator(550.0, ISOLATOR, RIGHT, LEFT)
    mirrored = oscillator.mirrored()
    assert mirrored == Oscillator(550.0, ISOLATOR, LEFT, RIGHT)
    assert mirrored.mirrored() == oscillator
    assert Oscillator(550.0, ISOLATOR, RIGHT).mirrored().right is None


def test_str_has_units():
    assert (
        str(RIGHT)
        == "Bumper(stiffness=510 kN/m, damping=0.9 kN s/m, gap=7.5 mm, memory=1.76471 ms)"
    )
    assert str(Oscillator(550.0, ISOLATOR, RIGHT)) == (
        "Oscillator(mass=550 kg, isolator=Isolator(stiffness=26.8 kN/m, damping=1.1 kN s/m), "
        "right=Bumper(stiffness=510 kN/m, damping=0.9 kN s/m, gap=7.5 mm, memory=1.76471 ms), "
        "left=None)"
    )


positive = st.floats(min_value=1e-100, max_value=1e100)
not_negative = st.floats(min_value=0.0, max_value=1e100)


@given(positive, not_negative, not_negative)
def test_repr_gives_back_every_digit(stiffness, damping, gap):
    bumper = Bumper(stiffness, damping, gap)
    assert eval(repr(bumper)) == bumper
    assert (bumper.stiffness, bumper.damping, bumper.gap) == (stiffness, damping, gap)
