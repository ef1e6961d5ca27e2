"""The laws of isolators: tables, units, static forces, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import vibroimpact as vi
from vibroimpact.model.validation import validate

YIELDING = {
    "elastic_stiffness": "500 kN/m",
    "post_yield_stiffness": "30 kN/m",
    "yield_force": "1 kN",
    "damping": "1.1 kN s/m",
}
TABLES = {
    "linear": {"stiffness": "26.8 kN/m", "damping": "1.1 kN s/m"},
    "friction": {"stiffness": "26.8 kN/m", "damping": 0, "friction": "120 N"},
    "bilinear": YIELDING,
    "polynomial": {"stiffness": 3e4, "damping": 5, "cubic": "-4 MN/m^3", "quintic": "2 GN/m^5"},
    "bouc-wen": {**YIELDING, "exponent": 3, "beta": 0.6, "gamma": "0.3"},
    "exponential": {
        "reversal_stiffness": "500 kN/m",
        "final_stiffness": "30 kN/m",
        "decay": "200 1/m",
        "damping": 5,
        "hardening": "0.02 1/mm",
        "hardening_force": "50 N",
    },
}
LAWS = [
    vi.Isolator(3e4, 5),
    vi.FrictionIsolator(3e4, 5, 120),
    vi.BilinearIsolator(5e5, 3e4, 1e3, 5),
    vi.PolynomialIsolator(3e4, 5, 4e6, 2e9),
    vi.BoucWenIsolator(5e5, 3e4, 1e3, 5),
    vi.BoucWenIsolator(5e5, 3e4, 1e3, 5, 2, 0.9, 0.4),
    vi.BoucWenIsolator(5e5, 3e4, 1e3, 5, 5, 0.3, 0.7),
    vi.ExponentialIsolator(5e5, 3e4, 200, 5, 20, 50),
]


def of(kind: str, **changes: object) -> vi.Oscillator:
    table = {"kind": kind, **TABLES[kind], **changes}
    return validate(vi.Oscillator, {"mass": 550, "isolator": table}, "rig")


@pytest.mark.parametrize("kind", TABLES)
@pytest.mark.parametrize("exponent", [None, 0.5])
def test_object_to_table_and_back(kind, exponent):
    rig = of(kind, **({} if exponent is None else {"damping_exponent": exponent, "damping": 7}))
    written = rig.model_dump()
    assert written["isolator"].get("kind", "linear") == kind
    assert ("damping_exponent" in written["isolator"]) == (exponent is not None)
    assert validate(vi.Oscillator, written) == rig
    assert eval(repr(rig.isolator), vars(vi) | {n: getattr(vi, n) for n in vi.__all__}) == (
        rig.isolator
    )
    assert "\n" not in str(rig)
    assert rig.linear == (kind == "linear" and exponent is None)


def test_units_follow_the_exponent():
    fluid = vi.Isolator(1.0, "3 kN (s/m)^0.5", 0.5)
    assert fluid.damping == 3000.0
    assert "damping=3 kN (s/m)^0.5, damping_exponent=0.5" in str(fluid)
    assert vi.Isolator(1.0, "2 N s^2/m^2", 2).damping == 2.0
    assert vi.FrictionIsolator(1.0, "2 N (s/m)^0.333333", 3, 1 / 3).damping == 2.0
    with pytest.raises(
        vi.InputError, match=r"^damping: '3 kN s/m' is a damping; use a damping in N"
    ):
        vi.Isolator(1.0, "3 kN s/m", 0.5)
    with pytest.raises(vi.InputError, match=r"^rig\.isolator\.damping_exponent: 0 is not greater"):
        of("linear", damping_exponent=0)
    assert fluid.viscous_force(-4.0) == -6000.0


def test_a_friction_pendulum():
    pendulum = vi.FrictionIsolator.from_pendulum("1 t", "2.5 m", 0.05, 3)
    weight = 1000 * 9.80665
    assert pendulum == vi.FrictionIsolator(weight / 2.5, 3, 0.05 * weight)
    with pytest.raises(vi.InputError, match=r"^radius: "):
        vi.FrictionIsolator.from_pendulum(1, 0, 0.05)


@pytest.mark.parametrize(
    ("kind", "changes", "message"),
    [
        ("friction", {"friction": -1}, "friction: -1 is less than 0; use a force of at least 0"),
        (
            "bilinear",
            {"yield_force": "-1 kN"},
            "yield_force: '-1 kN' is not greater than 0; use a for",
        ),
        ("bouc-wen", {"yield_force": 0}, "yield_force: 0 is not greater than 0; use a force"),
        (
            "bilinear",
            {"post_yield_stiffness": "1 MN/m"},
            "post_yield_stiffness: 1000 kN/m is greater than elastic_stiffness, 500 kN/m; re",
        ),
        ("bouc-wen", {"post_yield_stiffness": 1e6}, "post_yield_stiffness: 1000 kN/m is greater"),
        ("bouc-wen", {"exponent": 1.5}, "exponent: 1.5; use a whole number from 1 to 100"),
        ("bouc-wen", {"exponent": 0}, "exponent: 0; use a whole number from 1"),
        ("bouc-wen", {"exponent": "two"}, "exponent: 'two'; use a whole number"),
        ("bouc-wen", {"exponent": "1.5"}, "exponent: '1.5'; use a whole number"),
        ("bouc-wen", {"exponent": "2 m"}, "exponent: '2 m'; use a whole number"),
        ("bouc-wen", {"exponent": "nan"}, "exponent: 'nan'; use a whole number"),
        ("bouc-wen", {"exponent": True}, "exponent: True; use a whole number"),
        ("bouc-wen", {"beta": -0.1}, "beta: -0.1 is less than 0"),
        ("bouc-wen", {"gamma": -0.6}, "gamma: -0.6 plus beta, 0.6, is not greater than 0"),
        ("exponential", {"decay": 0}, "decay: 0 is not greater than 0; use an inverse length"),
        (
            "exponential",
            {"final_stiffness": 1e6},
            "final_stiffness: 1000 kN/m is greater than reversal_stiffness, 500 kN/m",
        ),
        (
            "polynomial",
            {"cubic": "3 N/m"},
            "cubic: '3 N/m' is a stiffness; use a stiffness in N/m³",
        ),
        (
            "friction",
            {"yield_force": 3},
            "yield_force: unknown key; use stiffness, damping, friction",
        ),
    ],
)
def test_bad_input_is_told_in_one_line(kind, changes, message):
    with pytest.raises(vi.InputError) as caught:
        of(kind, **changes)
    text = str(caught.value)
    assert text.startswith("rig.isolator")
    assert message in text
    assert "\n" not in text


def test_exponents_that_are_whole():
    assert of("bouc-wen", exponent=2.0).isolator.exponent == 2
    assert of("bouc-wen", exponent=np.int64(2)).isolator.exponent == 2
    assert of("bouc-wen", exponent="2").isolator.exponent == 2
    assert of("bouc-wen", exponent=" 2.0").isolator.exponent == 2


@pytest.mark.parametrize("law", LAWS, ids=repr)
@given(u=st.floats(0, 0.2))
@settings(max_examples=20)
def test_static_forces_are_odd_and_grow(law, u):
    force = law.static_force(u)
    assert law.static_force(-u) == -force
    assert law.static_force(1.01 * u + 1e-6) > force
    assert law.reach == law.strongest == law.restoring_reach == math.inf


@pytest.mark.parametrize("law", LAWS, ids=repr)
def test_initial_stiffness_is_the_tangent_at_rest(law):
    step = 1e-9
    slope = (law.static_force(2 * step) - law.static_force(step)) / step
    assert slope == pytest.approx(law.initial_stiffness, rel=1e-5)
    rig = vi.Oscillator(550, law)
    assert rig.angular_frequency == pytest.approx(math.sqrt(law.initial_stiffness / 550))
    assert rig.damping_ratio == pytest.approx(5 / 2 / math.sqrt(law.initial_stiffness * 550))


@pytest.mark.parametrize("n", [1, 2, 3, 7, 40])
@pytest.mark.parametrize(("beta", "gamma"), [(0.5, 0.5), (0.9, 0.4), (0.2, 0.1)])
def test_bouc_wen_is_what_its_equation_says(n, beta, gamma):
    law = vi.BoucWenIsolator(4.0, 1.0, 2.0, 0.0, n, beta, gamma)

    def slope(_, z):
        return 1 - np.abs(z / law.yield_displacement) ** n * (beta + gamma)

    at = np.linspace(0, 6 * law.hysteretic_limit, 40)
    z = solve_ivp(slope, (0, at[-1]), [0.0], "DOP853", at, rtol=1e-12, atol=1e-14).y[0]
    forces = [law.static_force(u) for u in at]
    assert forces == pytest.approx(at + 3 * z, rel=1e-10, abs=1e-12)
    assert law.hysteretic_limit == pytest.approx(0.5 * (beta + gamma) ** (-1 / n))


def test_a_sharp_bouc_wen_is_bilinear():
    sharp = vi.BoucWenIsolator(4.0, 1.0, 2.0, 0.0, 100)
    bilinear = vi.BilinearIsolator(4.0, 1.0, 2.0, 0.0)
    for u in (0.1, 0.4, 0.6, 3.0):
        assert sharp.static_force(u) == pytest.approx(bilinear.static_force(u), rel=1e-3)
    assert bilinear.static_force(0.5) == bilinear.yield_force == 2.0


def test_without_hardening_the_exponential_law_is_a_bouc_wen():
    law = vi.ExponentialIsolator(5.0, 1.0, 8.0, 0.0)
    twin = vi.BoucWenIsolator(3.0, 1.0, 3.0 / 8.0, 0.0, 1, 1.0, 0.0)
    for u in (1e-9, 0.05, 0.3, -2.0):
        assert law.static_force(u) == pytest.approx(twin.static_force(u), rel=1e-14)


def test_where_softening_ends():
    duffing = vi.PolynomialIsolator(3.0, 0.0, -1.0)
    assert duffing.reach == 1.0
    assert duffing.strongest == 2.0
    assert duffing.restoring_reach == pytest.approx(math.sqrt(3.0))
    # It softens and hardens again before it would turn.
    assert vi.PolynomialIsolator(3.0, 0.0, -1.0, 1.0).reach == math.inf
    assert vi.PolynomialIsolator(3.0, 0.0, 0.0, -0.6).reach == 1.0
    assert vi.PolynomialIsolator(0.0, 0.0, 1.0, -0.6).reach == 1.0
    assert vi.PolynomialIsolator(4.0, 0.0, -5 / 3, 1 / 5).reach == pytest.approx(1.0)
    rubber = vi.ExponentialIsolator(500.0, 300.0, 20.0, 0.0, -10.0, 3.0)
    u, step = rubber.reach, 1e-6
    assert rubber.strongest == rubber.static_force(u)
    assert rubber.static_force(u) > max(rubber.static_force(u + s) for s in (-step, step))
    assert rubber.elastic_force(rubber.restoring_reach) == pytest.approx(0.0, abs=1e-9)


def test_hardening_keeps_its_digits_where_it_is_small():
    law = vi.ExponentialIsolator(1.0, 0.0, 1.0, 0.0, 1.0, 3.0)
    for x in (1e-6, 0.1, 0.999):
        taylor = sum(x**k / math.factorial(k) for k in range(3, 30, 2))
        assert law.elastic_force(x) == pytest.approx(6.0 * taylor, rel=1e-15)


def test_no_damping_ratio_with_an_exponent():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1, 2.0))
    assert rig.natural_frequency == pytest.approx(1 / math.tau)
    with pytest.raises(
        vi.InputError,
        match="the damping ratio would depend on the velocity, so it is undefined",
    ):
        _ = rig.damping_ratio


def test_dimensionless_parameters_are_those_of_linear_laws():
    bumper, hertz = vi.Bumper(5.0, 0.1, 0.1), vi.PowerBumper(5.0, 0.1)
    with pytest.raises(
        vi.InputError, match=r"^isolator: its law, friction, .* so it has no dimensionless"
    ):
        vi.to_dimensionless(vi.Rig(vi.Oscillator(1, vi.FrictionIsolator(1, 0.1, 0.1), bumper), 1.0))
    with pytest.raises(
        vi.InputError, match=r"^isolator: its law, a dashpot with an exponent, is not"
    ):
        vi.to_dimensionless(vi.Rig(vi.Oscillator(1, vi.Isolator(1, 0.1, 2)), 1.0))
    with pytest.raises(
        vi.InputError, match=r"^left: its law, power, is not linear, so it has no dimensionless"
    ):
        vi.to_dimensionless(vi.Rig(vi.Oscillator(1, vi.Isolator(1, 0.1), bumper, hertz), 1.0))


def test_what_nothing_holds_is_refused():
    bumper = vi.Bumper(5.0, 0.1, 0.1)
    slider = vi.FrictionIsolator(0, 0, 2)
    assert vi.Oscillator(1, slider).angular_frequency == 0.0
    for law in (slider, vi.BilinearIsolator(1, 0, 2, 0), vi.PolynomialIsolator(3, 0, -1)):
        vi.Oscillator(1, law, force=1.99)
        vi.Oscillator(1, law, right=bumper, force=2.0)
        with pytest.raises(vi.InputError, match="force: the isolator bears less than 2 N, and no"):
            vi.Oscillator(1, law, left=bumper, force=2.0)
