"""Isolators by what a designer knows: periods, damping ratios and strengths, and weights."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

import vibroimpact as vi
from vibroimpact.model import GRAVITY
from vibroimpact.model.parameters import parameter
from vibroimpact.stability.two_parameters import plane

MASS = 5e6
SOME = st.floats(1e-3, 1e3)


@given(SOME, SOME, st.floats(0.0, 1.9))
def test_a_mass_on_it_has_the_period_and_the_damping_ratio(mass, period, ratio):
    rig = vi.Oscillator(mass, vi.Isolator.from_period(mass, period, ratio))
    assert 1.0 / rig.natural_frequency == pytest.approx(period, rel=1e-14)
    assert rig.damping_ratio == pytest.approx(ratio, rel=1e-14)


def test_a_building():
    isolator = vi.Isolator.from_period("5000 t", "2.5 s", "15 %")
    assert isolator.stiffness == pytest.approx(4 * math.pi**2 * 5e6 / 2.5**2, rel=1e-14)
    assert isolator.damping == pytest.approx(0.3 * 5e6 * math.tau / 2.5, rel=1e-14)


def test_other_laws_with_a_spring_take_what_else_they_have():
    bent = vi.PolynomialIsolator.from_period(MASS, 2.5, 0.1, cubic="1 MN/m^3")
    assert bent == vi.PolynomialIsolator(bent.stiffness, bent.damping, 1e6)
    assert bent.stiffness == vi.Isolator.from_period(MASS, 2.5, 0.1).stiffness
    sliding = vi.FrictionIsolator.from_period(MASS, "3 s", coefficient=0.05)
    assert sliding.friction == pytest.approx(0.05 * MASS * GRAVITY, rel=1e-14)
    assert sliding == vi.FrictionIsolator.from_period(MASS, "3 s", 0, friction=sliding.friction)


def test_a_friction_pendulum_has_the_period_of_its_radius():
    radius = 2.0
    pendulum = vi.FrictionIsolator.from_pendulum(MASS, radius, 0.05)
    period = math.tau * math.sqrt(radius / GRAVITY)
    same = vi.FrictionIsolator.from_period(MASS, period, coefficient=0.05)
    assert pendulum.stiffness == pytest.approx(same.stiffness, rel=1e-14)
    assert pendulum.friction == same.friction


@pytest.mark.parametrize("law", [vi.BilinearIsolator, vi.BoucWenIsolator])
@given(share=st.floats(1e-3, 1.0), yields=st.floats(1e-4, 0.1), period=st.floats(0.1, 10.0))
def test_a_lead_rubber_bearing(law, share, yields, period):
    """Q_d is the force of the loop at u = 0, where the post-yield line cuts the axis."""
    bearing = law.from_strength(MASS, share, yields, period, 0.02)
    assert bearing.yield_displacement == pytest.approx(yields, rel=1e-14)
    k = bearing.post_yield_stiffness
    assert math.tau * math.sqrt(MASS / k) == pytest.approx(period, rel=1e-14)
    at_zero = bearing.hysteretic_stiffness * yields
    assert at_zero == pytest.approx(share * MASS * GRAVITY, rel=1e-9)
    assert bearing.damping == pytest.approx(0.04 * math.sqrt(k * MASS), rel=1e-14)


def test_a_strength_may_be_a_force():
    force = 0.05 * MASS * GRAVITY
    by_share = vi.BilinearIsolator.from_strength(MASS, 0.05, "10 mm", "2.5 s")
    by_force = vi.BilinearIsolator.from_strength(MASS, f"{force!r} N", "10 mm", "2.5 s")
    assert by_share == by_force
    sharp = vi.BoucWenIsolator.from_strength(MASS, 0.05, "10 mm", "2.5 s", exponent=4, beta=0.6)
    assert (sharp.exponent, sharp.beta) == (4, 0.6)


@pytest.mark.parametrize(
    ("table", "made"),
    [
        ({"period": "2.5 s", "damping_ratio": 0.15}, vi.Isolator.from_period(MASS, 2.5, 0.15)),
        (
            {"kind": "polynomial", "period": 2.5, "damping_ratio": 0, "quintic": 3},
            vi.PolynomialIsolator.from_period(MASS, 2.5, 0, quintic=3),
        ),
        (
            {
                "kind": "bouc-wen",
                "strength": 0.05,
                "yield_displacement": "1 cm",
                "post_yield_period": 2.5,
                "exponent": 2,
            },
            vi.BoucWenIsolator.from_strength(MASS, 0.05, 0.01, 2.5, exponent=2),
        ),
        (
            {"kind": "friction", "radius": "2 m", "coefficient": 0.05},
            vi.FrictionIsolator.from_pendulum(MASS, 2, 0.05),
        ),
        (
            {"kind": "friction", "period": "3 s", "coefficient": 0.05},
            vi.FrictionIsolator.from_period(MASS, 3, coefficient=0.05),
        ),
    ],
)
def test_a_table_takes_the_mass_of_its_oscillator(table, made):
    rig = vi.Oscillator("5000 t", table)
    assert rig.isolator == made
    again = vi.Oscillator.model_validate(rig.model_dump())
    assert again == rig


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (
            {"period": "2.5 s"},
            "damping_ratio: missing, but period requires it; add a dimensionless number",
        ),
        (
            {"damping_ratio": 0.1},
            "period: missing, but damping_ratio requires it; add a time greater than 0",
        ),
        (
            {"period": 2, "damping_ratio": 0.1, "stiffness": 3},
            "stiffness: given together with period; remove one of the two",
        ),
        (
            {"period": 2, "damping_ratio": 0.1, "damping": 3},
            "damping: given together with period; remove one of the two",
        ),
        (
            {"period": 2, "damping_ratio": 0.1, "damping_exponent": 2},
            "damping_exponent: given together with period",
        ),
        ({"period": "2 Hz", "damping_ratio": 0.1}, "period: '2 Hz' is a frequency; use a time gr"),
        ({"period": 0, "damping_ratio": 0.1}, "period: 0 is not greater than 0; use a time"),
        ({"period": 2, "damping_ratio": -0.1}, "damping_ratio: -0.1 is less than 0"),
        (
            {"period": 2, "damping_ratio": 0.1, "dampin": 3},
            "dampin: unknown key; did you mean damping? Use stiffness, ",
        ),
        (
            {"kind": "bilinear", "period": 2},
            "period: unknown key; use elastic_stiffness, post_yield_",
        ),
        ({"kind": "friction", "radius": 2}, "coefficient: missing, but radius requires it"),
        (
            {"kind": "bilinear", "strength": 5e5, "yield_displacement": 1, "post_yield_period": 1},
            "strength: 500000.0 times the weight; use a share of the weight up to 1, such as 0.05",
        ),
        (
            {
                "kind": "bilinear",
                "strength": 0.05,
                "yield_displacement": 1,
                "post_yield_period": 1,
                "yield_force": 1,
            },
            "yield_force: given together with strength",
        ),
    ],
)
def test_what_does_not_go_together_is_told_in_one_line(table, message):
    with pytest.raises(vi.InputError) as caught:
        vi.Oscillator.model_validate({"mass": MASS, "isolator": table}, where="oscillator")
    text = str(caught.value)
    assert text.startswith(f"oscillator.isolator.{message}")
    assert "\n" not in text


def test_without_a_mass_the_mass_is_asked_for():
    table = {"period": 2, "damping_ratio": 0.1}
    with pytest.raises(vi.InputError, match=r"^mass: '5000 g' has a g, which is gravity here"):
        vi.Oscillator("5000 g", table)
    with pytest.raises(vi.InputError, match=r"^mass: missing"):
        vi.Oscillator.model_validate({"isolator": table})


def test_a_weight_is_a_mass_under_gravity():
    table = {"weight": "49.03325 MN", "isolator": {"period": 2, "damping_ratio": 0.1}}
    rig = vi.Oscillator.model_validate(table)
    assert rig.mass == pytest.approx(5e6, rel=1e-15)
    assert 1.0 / rig.natural_frequency == pytest.approx(2.0, rel=1e-14)
    with pytest.raises(
        vi.InputError, match=r"^weight: given together with mass; remove one of the two"
    ):
        vi.Oscillator.model_validate({**table, "mass": 5})
    with pytest.raises(
        vi.InputError, match=r"^weight: '5 t' is a mass; use a force greater than 0"
    ):
        vi.Oscillator.model_validate({**table, "weight": "5 t"})


def test_the_period_as_a_parameter_keeps_the_damping_ratio():
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.0)
    period = parameter("isolator-period", case.oscillator)
    rig = period.vary(vi.Rig(case.oscillator, shaken), 2.5).oscillator
    assert period.read(vi.Rig(rig, shaken)) == pytest.approx(2.5, rel=1e-14)
    assert rig.damping_ratio == pytest.approx(case.oscillator.damping_ratio, rel=1e-14)
    assert rig.right == case.oscillator.right
    yielding = rig.replace(isolator=vi.BilinearIsolator(2e5, 1e5, 100, 0))
    with pytest.raises(vi.InputError, match=r"sets the stiffness of the isolator, but .* has none"):
        period.read(vi.Rig(yielding, shaken))


def test_a_branch_follows_the_period_and_a_curve_does_not():
    case = vi.laboratory.case("B2-G1-A3")
    shaken = vi.Harmonic(case.amplitude, 2.0)
    data = vi.branch(case, frequency="2 Hz", vary={"isolator_period": (0.6, 1.2)})
    mass, isolator = case.oscillator.mass, case.oscillator.isolator
    ratio = isolator.damping / (2.0 * (isolator.stiffness * mass) ** 0.5)
    for k in (0, data.sizes["point"] // 2, -1):
        period = float(data["isolator_period"][k])
        here = case.oscillator.replace(isolator=vi.Isolator.from_period(mass, period, ratio))
        state = data["section"].isel(point=k)
        after = vi.simulate(vi.Rig(here, shaken), 1, state, samples=0)["final_state"]
        assert after[:2].values == pytest.approx(state[:2].values, abs=1e-9)
    data = vi.branch(case, frequency="2 Hz", vary={"stiffness_at_restitution": (3e5, 1e6)})
    begun = case.oscillator.right
    for k in (0, data.sizes["point"] // 2, -1):
        stiffness = float(data["stiffness_at_restitution"][k])
        damping = begun.damping * (stiffness / begun.stiffness) ** 0.5
        bumper = begun.replace(stiffness=stiffness, damping=damping)
        here = case.oscillator.replace(right=bumper, left=bumper)
        state = data["section"].isel(point=k)
        after = vi.simulate(vi.Rig(here, shaken), 1, state, samples=0)["final_state"]
        assert after[:2].values == pytest.approx(state[:2].values, abs=1e-9)
    with pytest.raises(
        vi.InputError, match=r"along 'isolator_period', because .* do not depend linearly on it"
    ):
        plane(vi.Rig(case.oscillator, shaken), ("frequency", "isolator_period"))
