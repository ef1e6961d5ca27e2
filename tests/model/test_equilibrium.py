"""Where the mass stays while nothing shakes it."""

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vibroimpact.errors import InputError
from vibroimpact.model import (
    BilinearIsolator,
    BoucWenIsolator,
    Bumper,
    ExponentialIsolator,
    FrictionIsolator,
    Isolator,
    JankowskiBumper,
    Oscillator,
    PolynomialIsolator,
    PowerBumper,
    RigidStop,
    State,
    equilibrium,
)

STIFFNESS = 2.0


def at_rest(right=None, left=None):
    state = equilibrium(Oscillator(1.0, Isolator(STIFFNESS, 0.3), right, left))
    assert state == State(state.displacement)
    return state.displacement


@pytest.mark.parametrize("gap", [0.0, 1e-300, 0.4])
@pytest.mark.parametrize("stop", [lambda gap: Bumper(5.0, 1.0, gap), lambda gap: RigidStop(1, gap)])
def test_without_preload_it_is_exactly_zero(gap, stop):
    for displacement in (at_rest(), at_rest(stop(gap)), at_rest(None, stop(gap))):
        assert repr(displacement) == "0.0"
    assert repr(at_rest(stop(gap), Bumper(3.0, 0.0, gap))) == "0.0"


def test_one_preloaded_bumper():
    assert at_rest(Bumper(6.0, 1.0, -0.4)) == pytest.approx(-0.3, rel=1e-15)
    assert at_rest(None, Bumper(6.0, 1.0, -0.4)) == pytest.approx(0.3, rel=1e-15)


def test_equal_preloads_cancel():
    both = Bumper(6.0, 1.0, -0.4)
    assert at_rest(both, both) == 0.0


def test_a_preloaded_bumper_presses_the_mass_into_the_other_one():
    # -2 u - 6 (u + 0.4) + 5 (-u - 0.2) = 0
    assert at_rest(Bumper(6.0, 1.0, -0.4), Bumper(5.0, 0.0, 0.2)) == pytest.approx(-3.4 / 13)


def test_rigid_stops_bound_it():
    assert at_rest(RigidStop(0.5, -0.1)) == -0.1
    assert at_rest(None, RigidStop(0.5, -0.1)) == 0.1
    assert at_rest(RigidStop(0.5, -0.1), RigidStop(0.5, 0.2)) == -0.1
    assert at_rest(Bumper(6.0, 1.0, -0.4), RigidStop(0.5, 0.25)) == -0.25
    assert at_rest(Bumper(6.0, 1.0, -0.4), RigidStop(0.5, 0.35)) == pytest.approx(-0.3)
    # The bumper is too soft to hold the mass away from a wall that is pushed into it.
    assert at_rest(RigidStop(0.5, -0.3), Bumper(0.1, 0.0, 0.2)) == -0.3


stiffnesses = st.floats(-6, 6).map(lambda x: 10.0**x)
gaps = st.floats(-2.0, 2.0, allow_subnormal=False)
stops = st.none() | st.builds(Bumper, stiffnesses, st.just(0.0), gaps)


@given(stiffnesses, stops, stops)
def test_forces_balance(stiffness, right, left):
    u = equilibrium(Oscillator(1.0, Isolator(stiffness, 0.0), right, left)).displacement
    forces = [stiffness * u]
    if right:
        forces.append(right.stiffness * max(u - right.gap, 0.0))
    if left:
        forces.append(-left.stiffness * max(-u - left.gap, 0.0))
    # A depth is a difference of numbers as large as the gap.
    allowed = sum(map(abs, forces)) + sum(s.stiffness * abs(s.gap) for s in (right, left) if s)
    assert abs(sum(forces)) <= 4e-16 * allowed


def resting(isolator, right=None, left=None, force=0.0):
    return equilibrium(Oscillator(1.0, isolator, right, left, force)).displacement


LAWS = [
    FrictionIsolator(30.0, 0.1, 0.5),
    BilinearIsolator(50.0, 3.0, 1.0, 0.1),
    PolynomialIsolator(30.0, 0.1, 40.0, 20.0),
    BoucWenIsolator(50.0, 3.0, 1.0, 0.1, 3),
    ExponentialIsolator(50.0, 3.0, 20.0, 0.1, 5.0, 2.0),
    Isolator(30.0, 0.1, 2.0),
]
STOPS = [
    None,
    PowerBumper(500.0, 0.01, dissipation=0.3),
    PowerBumper(500.0, -0.02, 2.0),
    JankowskiBumper(500.0, 0.05, 0.5, 1.0),
    Bumper(500.0, 1.0, -0.03),
    RigidStop(0.5, 0.02),
]


@pytest.mark.parametrize("isolator", LAWS, ids=lambda law: law.kind)
@pytest.mark.parametrize("force", [0.0, 0.3, -2.0, 6.0])
def test_any_laws_balance(isolator, force):
    for right, left in product(STOPS, STOPS):
        balances(isolator, right, left, force)


def balances(isolator, right, left, force):
    u = resting(isolator, right, left, force)
    assert resting(isolator, left, right, -force) == -u
    rest = force - isolator.static_force(u)
    for side, stop in ((1, right), (-1, left)):
        if isinstance(stop, RigidStop):
            assert side * u <= stop.gap
        elif stop is not None:
            rest -= side * stop.static_force(side * u - stop.gap)
    if u == 0.0 and isinstance(isolator, FrictionIsolator):
        assert abs(rest) <= isolator.friction
    elif isinstance(right, RigidStop) and u == right.gap:
        assert rest >= 0.0
    elif isinstance(left, RigidStop) and u == -left.gap:
        assert rest <= 0.0
    else:
        assert rest == pytest.approx(0.0, abs=1e-12)


def test_a_damping_exponent_moves_no_rest():
    stop = Bumper(6.0, 1.0, -0.4)
    assert repr(resting(Isolator(2.0, 0.3, 0.5), stop)) == repr(resting(Isolator(2.0, 0.3), stop))


def test_friction_holds_what_it_can():
    sticky = FrictionIsolator(2.0, 0.0, 1.0)
    assert resting(sticky, force=1.0) == 0.0
    assert resting(sticky, force=-1.5) == pytest.approx(-0.25)
    assert resting(sticky, Bumper(10.0, 0.0, -0.1)) == 0.0
    assert resting(FrictionIsolator(0.0, 0.0, 1.0), force=-0.9) == 0.0


def test_a_softening_isolator_that_a_preload_pushes_over():
    with pytest.raises(
        InputError, match=r"^isolator: it softens, and its largest force, 2 N at 1 m"
    ):
        resting(PolynomialIsolator(3.0, 0.0, -1.0), Bumper(100.0, 0.0, -9.0))
    held = resting(PolynomialIsolator(3.0, 0.0, -1.0), Bumper(100.0, 0.0, -9.0), RigidStop(0, 0.5))
    assert held == -0.5
