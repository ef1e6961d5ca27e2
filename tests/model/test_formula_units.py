"""The numbers of a formula: their units follow from it, and they are parameters of a rig."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact import figures
from vibroimpact.model.parameters import parameter

ISOLATOR = vi.Law("k*u + q*u**7 + c*v", k="26 kN/m", q=1e9, c="1.1 kN s/m")
STOP = vi.Law("ks*d + k5*d**5 + cs*v", gap="7.5 mm", ks="400 kN/m", k5=1e12, cs="900 N s/m")
RIG = vi.Rig(vi.Oscillator("550 kg", ISOLATOR, STOP, STOP), "0.05 g")


@pytest.mark.parametrize(
    ("law", "units"),
    [
        (ISOLATOR, {"k": "N m-1", "q": "N m-7", "c": "N s m-1"}),
        (STOP, {"ks": "N m-1", "k5": "N m-5", "cs": "N s m-1"}),
        (vi.Law("k*u/(1 + abs(u)/a) + c*v", k=3.0, a=2.0, c=1.0), {"k": "N m-1", "a": "m"}),
        (vi.Law("f*tanh(u/a) + c*v", f=3.0, a=2.0, c=1.0), {"f": "N", "a": "m"}),
        # A literal factor has no unit; an exponent that is a number has none either.
        (vi.Law("2*k*u + c*v*(1 + 3*(u/a)**2)", k=3.0, a=2.0, c=1.0), {"k": "N m-1", "a": "m"}),
        # Only the product of two numbers is determined, so neither of them is.
        (vi.Law("p*q*u**3 + k*u + c*v**3", p=3.0, q=2.0, k=1.0, c=1.0), {"k": "N m-1"}),
    ],
)
def test_units_follow_from_the_formula(law: vi.Law, units: dict[str, str]) -> None:
    symbols = {name: one.symbol for name, one in law.quantities.items()}
    known = {name: parameter_units(law, name) for name in units}
    assert known == units
    assert set(units) <= set(symbols)
    if "p" in dict(law.numbers):
        assert not {"p", "q"} & set(symbols)


def parameter_units(law: vi.Law, name: str) -> str:
    whose = "stops" if law.is_stop else "isolator"
    stop = law if law.is_stop else None
    isolator = vi.Isolator(1.0, 0.0) if law.is_stop else law
    rig = vi.Oscillator(1.0, isolator, stop, stop)
    return parameter(f"{whose}.{name}", rig).units


def test_numbers_print_with_their_units() -> None:
    assert "k=26 kN/m" in str(ISOLATOR)
    assert "c=1.1 kN s/m" in str(ISOLATOR)


@pytest.mark.parametrize(
    ("name", "span"),
    [
        *sample([("isolator.k", ("20 kN/m", "30 kN/m")), ("isolator.q", (1e8, 1e10))], []),
        *sample([("stops.right.k5", (1e11, 1e13))], []),
        ("stops.ks", ("300 kN/m", "600 kN/m")),
    ],
)
def test_points_of_a_branch_are_motions_of_rigs_with_that_number(
    name: str, span: tuple[float, float]
) -> None:
    branch = vi.branch(RIG, vary={name: span}, frequency="1.2 Hz")
    whose, _, number = name.rpartition(".")
    fields = ("right", "left") if whose == "stops" else (whose.removeprefix("stops."),)
    for point in (0, branch.sizes["point"] // 2, -1):
        at = branch.isel(point=point)
        old = RIG.oscillator
        new = {field: getattr(old, field).replace(**{number: float(at[name])}) for field in fields}
        other = RIG.with_parts(old.replace(**new))
        again = vi.orbit(other, start=at["section"], frequency="1.2 Hz")
        for one in ("displacement_max", "displacement_min"):
            np.testing.assert_allclose(again[one], at[one], rtol=1e-9)
    assert branch[name].attrs["units"] == parameter(name, RIG).units
    assert branch[name].attrs["long_name"].startswith(f"number {number} in the formula of ")


@pytest.mark.parametrize(
    ("name", "span", "message"),
    [
        (
            "isolator.k9",
            (1.0, 2.0),
            r"is unknown; did you mean isolator\.k\w*\? .*isolator\.k, isolator\.q, isolator\.c",
        ),
        (
            "left.foo",
            (1.0, 2.0),
            r"is unknown; .*stops\.left\.ks, stops\.left\.k5, stops\.left\.cs",
        ),
        ("isolator.q", ("1 kN/m", "2 kN/m"), "is a stiffness"),
    ],
)
def test_refused(name: str, span: tuple[float, float], message: str) -> None:
    with pytest.raises(vi.InputError, match=message):
        vi.branch(RIG, vary={name: span}, frequency="1.2 Hz")


def test_a_formula_of_a_built_in_law_has_the_parameters_of_that_law() -> None:
    cubic = vi.Law("k*u + k3*u**3", k=1.0, k3=2.0)
    rig = vi.Rig(vi.Oscillator(1.0, cubic), 1.0)
    with pytest.raises(
        vi.InputError, match=r"'isolator.k3' is unknown; .*isolator.stiffness, .*isolator.cubic"
    ):
        vi.branch(rig, vary={"isolator.k3": (1.0, 2.0)}, frequency=0.1)


def named_like_built_in() -> vi.Rig:
    """A rig whose formulas have numbers with the names of numbers of built-in laws."""
    stop = vi.Law(
        "2*stiffness*d + damping*v + stiffness*d*(d/e)**4", 0.01, stiffness=1e5, damping=9.0, e=0.1
    )
    isolator = vi.Law(
        "2*stiffness*u/(1 + abs(u)/friction) + damping*v", stiffness=3e4, damping=9.0, friction=0.1
    )
    return RIG.with_parts(RIG.oscillator.replace(isolator=isolator, right=stop, left=stop))


@pytest.mark.parametrize(
    ("name", "units"),
    [("isolator.friction", "m"), ("isolator.stiffness", "N m-1"), ("stops.damping", "N s m-1")],
)
def test_a_number_with_the_name_of_one_of_a_built_in_law_is_varied(name: str, units: str) -> None:
    rig = named_like_built_in()
    param = parameter(name, rig)
    assert param.units == units
    owner, _, number = name.rpartition(".")
    field = "right" if owner == "stops" else owner
    law = getattr(param.vary(rig, 7.0).oscillator, field)
    assert law == getattr(rig.oscillator, field).replace(**{number: 7.0})


@pytest.mark.parametrize(
    "name",
    [
        "isolator_period",
        "damping_ratio",
        "proportional_stiffness",
        "stiffness_at_restitution",
        "stiffness_ratio",
        "relaxation_time",
    ],
)
def test_a_number_of_a_formula_has_no_meaning_by_its_name(name: str) -> None:
    rig = named_like_built_in()
    param = parameter(name, rig)
    with pytest.raises(vi.InputError, match=r"has none|has no |no stop with"):
        param.read(rig)
    with pytest.raises(vi.InputError, match=r"has none|has no |no stop with"):
        param.vary(rig, 0.5)


def test_unequal_stops_have_no_common_number() -> None:
    unequal = RIG.with_parts(RIG.oscillator.replace(left=STOP.replace(ks=1e5)))
    with pytest.raises(vi.InputError, match=r"'right\.ks' or 'left\.ks'"):
        vi.branch(unequal, vary={"stops.ks": (1e5, 2e5)}, frequency="1.2 Hz")


def test_stops_whose_numbers_have_other_units_have_no_common_number() -> None:
    right = vi.Law("q*d + p*d**3", gap=0.01, q=1e5, p=1e5)
    left = vi.Law("p*d + q*d**3", gap=0.01, q=1e5, p=1e5)
    rig = RIG.with_parts(RIG.oscillator.replace(right=right, left=left))
    with pytest.raises(vi.InputError, match=r"units of q, N/m and N/m.*'right.q' or 'left.q'"):
        vi.branch(rig, vary={"stops.q": (1e5, 2e5)}, frequency="1.2 Hz")


@pytest.mark.parametrize(
    ("formula", "numbers", "message"),
    [
        # The 1 has no unit, so that the unit of `a` is determined.
        ("k*u/(1 + abs(u)/a)", {"k": "26 kN", "a": 0.05}, "column 1: k: '26 kN' is a force"),
        ("k*u/(1 + abs(u)/a)", {"k": "26 kN/m", "a": "5 kg"}, "column 1[57]: a: '5 kg' is a mass"),
        ("k*u*sqrt(1 + (u/a)**2)", {"k": 1.0, "a": "5 s"}, "column 1[57]: a: '5 s' is a time"),
        ("k*u + k3*u**3", {"k": "1 N/m", "k3": "5 MN/m^2"}, "column 7: k3: .* use .* N/m³"),
    ],
)
def test_a_number_in_another_unit_is_refused_at_its_place(formula, numbers, message) -> None:
    with pytest.raises(vi.InputError, match=message):
        vi.Law(formula, **numbers)


SOFTENING = vi.Law("k*u/(1 + abs(u)/a) + c*v", k="26 kN/m", a="5 cm", c="1.1 kN s/m")
SOFT = RIG.with_parts(RIG.oscillator.replace(isolator=SOFTENING))


@pytest.mark.full
def test_a_branch_ends_at_the_bound_beyond_which_there_is_no_such_law() -> None:
    least = sample(1e-4, 0.03)
    branch = vi.branch(SOFT, vary={"isolator.a": (least, 0.1)}, frequency="1.2 Hz")
    assert float(branch["isolator.a"].min()) == least
    with pytest.raises(vi.InputError, match=r"isolator\.a at 0: isolator\.formula: column 17"):
        vi.branch(SOFT, vary={"isolator.a": (0.0, 0.1)}, frequency="1.2 Hz")


@pytest.mark.full
def test_designs_and_basins_vary_numbers_of_formulas() -> None:
    stability = vi.basin_stability(
        SOFT,
        ("-20 mm", "20 mm"),
        ("-0.1 m/s", "0.1 m/s"),
        vary={"isolator.a": ["4 cm", "6 cm"]},
        states=16,
        frequency="1.2 Hz",
    )
    assert stability["isolator.a"].attrs["units"] == "m"
    chart = vi.design_chart(SOFT, {"isolator.a": ["4 cm", "6 cm"], "frequency": (1.0, 1.4)})
    assert chart["isolator.a"].attrs["units"] == "m"
    figures.pareto_front(chart)


def test_a_number_called_as_that_of_a_bumper_is_varied_alone() -> None:
    stop = vi.Law("stiffness*d*(1 + d/a)", gap=0.01, stiffness=1e5, a=0.1)
    rig = RIG.with_parts(RIG.oscillator.replace(right=stop, left=stop))
    moved = parameter("stops.stiffness", rig).vary(rig, 2e5).oscillator
    assert moved.right == moved.left == stop.replace(stiffness=2e5)


def test_a_misspelt_parameter_gets_a_suggestion() -> None:
    with pytest.raises(vi.InputError, match=r"did you mean stops.stiffness\?"):
        vi.branch("B2-G1-A3", vary={"stops.stifness": (1.0, 2.0)}, frequency=1.0)
