"""Formulas as text: what they are read as, and what is refused, in one line with its column."""

from __future__ import annotations

import math

import pytest

from vibroimpact.errors import InputError, InputWarning
from vibroimpact.law_numbers import SYMBOLS
from vibroimpact.model import (
    Bumper,
    Isolator,
    Law,
    Oscillator,
    PolynomialIsolator,
    PowerBumper,
    validate,
)
from vibroimpact.model.formula import FUNCTIONS


@pytest.mark.parametrize(
    ("formula", "numbers", "u", "v", "force"),
    [
        ("k*u/(1 + abs(u)/a)", {"k": "26 kN/m", "a": "5 cm"}, -0.05, 0.0, -650.0),
        ("k*u + k3*u**3 + c*v", {"k": 3, "k3": 2, "c": 5}, 0.5, 0.1, 2.25),
        ("f*sinh(u/a)", {"f": "2 N", "a": "10 mm"}, 0.01, 0.0, 2.0 * math.sinh(1.0)),
        ("f*tanh(v/b)", {"f": "2 N", "b": "10 mm/s"}, 0.0, -0.01, -2.0 * math.tanh(1.0)),
        ("k*u*sqrt(1 + (u/a)**2)", {"k": 3, "a": 4}, 3.0, 0.0, 9.0 * 1.25),
        ("k*u*(1 + (u/a)**2)**-1.5", {"k": 2, "a": 1}, 1.0, 0.0, 2.0 * 2.0**-1.5),
        ("k*u*exp(-(u/a)**2) - -c*v*cos(u/a)", {"k": 2, "a": 1, "c": 3}, 1.0, 1.0,
         2.0 * math.exp(-1.0) + 3.0 * math.cos(1.0)),
        ("c*v*abs(v) + k*sin(u/a)", {"k": 2, "a": 1, "c": 3}, 1.0, -2.0,
         2.0 * math.sin(1.0) - 12.0),
    ],
)  # fmt: skip
def test_a_formula_has_the_value_that_it_says(formula, numbers, u, v, force) -> None:
    law = Law(formula, **numbers)
    assert law.read.value(u, v) == pytest.approx(force, rel=1e-15)
    for which in (0, 1):
        ends = []
        for way in (1e-6, -1e-6):
            moved = [u, v]
            moved[which] += way
            ends.append(law.read.value(*moved))
        slope = law.read.slope(u, v, which)
        assert slope == pytest.approx((ends[0] - ends[1]) / 2e-6, rel=1e-7, abs=1e-7 * abs(force))


@pytest.mark.parametrize(
    ("formula", "numbers", "message"),
    [
        ("k*x", {"k": 1}, "formula: column 3: 'x' has no value; use u, v or k, or pass x"),
        ("k*u", {"k": "26 kg"}, "formula: column 1: k: '26 kg' is a mass; use a stiffness"),
        ("k*u + k3*u**3", {"k": "1 N/m", "k3": "1 N/m^2"},
         "formula: column 7: k3: '1 N/m^2' is a pressure; use a stiffness in N/m³"),
        ("f*sinh(u)", {"f": 1}, "formula: column 8: the argument of sinh, 'u', is a length; use a "
         "number without a unit"),
        ("k*u**a", {"k": 1, "a": "1 m"}, "formula: column 6: a: '1 m' is a length; "
         "use a dimensionless number"),
        ("k*u", {"k": 1, "q": 2}, "q: the formula 'k*u' does not contain this number; remove q"),
        ("k*d", {"k": 1},
         "formula: column 3: 'd' is used for a stop, but this law has no gap; write 'u'"),
        ("2", {}, "formula: column 1: '2' depends on neither u nor v"),
        ("k*u**0", {"k": 1}, "formula: column 1: 'k*u**0' depends on neither u nor v"),
        ("k*u +", {"k": 1}, "formula: column "),
        ("", {}, "formula: column 1: it cannot be read"),
        ("k^u", {"k": 1}, "formula: column 1: 'k^u': ^ is not a power here; write **"),
        ("k*u**u", {"k": 1}, "formula: column 6: the exponent 'u' varies; use a number"),
        ("k*u**40", {"k": 1}, "formula: column 6: the exponent is 40; use one from -31 to 31"),
        ("k/u", {"k": 1}, "formula: column 3: the divisor 'u' is 0 at rest; use a divisor that is"),
        ("k*u**-1", {"k": 1}, "formula: column 3: the base 'u' is 0 at rest; use a base that is"),
        ("k*u*abs(u)**0.5", {"k": 1}, "formula: column 5: the base 'abs(u)' is 0 at rest"),
        ("k*u/(1 - u/a)", {"k": 1, "a": "30 mm"},
         "formula: column 6: the divisor '1 - u/a' is 0 at u = 0.03 m; use a divisor that is"),
        ("k*u/(1 - v/b)", {"k": 1, "b": 2},
         "formula: column 6: the divisor '1 - v/b' is 0 at v = 2 m/s"),
        ("k*u*u", {"k": 1}, "formula: column 1: 'k*u*u' does not change its sign with u and v"),
        ("k*u + f*exp(u/a)", {"k": 1, "f": 1, "a": 1},
         "formula: column 7: 'f*exp(u/a)' does not change its sign with u and v"),
        ("k*u + f*sign(v)", {"k": 1, "f": 1}, "formula: column 9: sign is not accepted: a force"),
        ("k*max(u, 0)", {"k": 1},
         "formula: column 3: max is not accepted: it has no Taylor series"),
        ("k*abs(u - a)", {"k": 1, "a": 1}, "formula: column 3: the absolute value of 'u - a'"),
        ("-k*u + q*u**3", {"k": "2 N/m", "q": 1},
         "formula: its stiffness at rest is -2 N/m; change its numbers"),
        ("__import__('os').system('true')", {}, "formula: column 1: "),
        ("(lambda: u)()", {}, "formula: column 1: '(lambda: u)()' cannot be read"),
        ("u.real", {}, "formula: column 1: u.real is not a formula; use + - * / ** ( ) and "
         "functions"),
        ("[u][0]", {}, "formula: column 1: [u][0] is not a formula"),
        ("k*u if v else u", {"k": 1}, "formula: column 1: k*u if v else u is not a formula"),
        ("k*'u'", {"k": 1}, "formula: column 3: 'u' is not a number"),
        ("k*True*u", {"k": 1}, "formula: column 3: True is not a number"),
        ("1e400*u", {}, "formula: column 1: 1e400 is not a finite number"),
        ("k*u/0", {"k": 1}, "formula: column 5: the divisor '0' is 0 at rest"),
        (7, {}, "formula: 7 is not a string; use a string such as 'k*u'"),
        ("u" + "+u" * 200, {}, "formula: it has 401 characters; use at most 300"),
        ("(" * 140 + "u" + ")" * 140, {}, "formula"),
        ("k*u", {"k": "nothing"}, "k: 'nothing' does not start with a number; pass a number"),
        ("k*u", {"k": "3 K"}, "k: '3 K' has a unit that is not accepted"),
        ("k*u", {"k": math.nan}, "k: nan is not finite"),
        ("k*u", {"exp": 1}, "'exp' cannot be the name of a number in a formula"),
        ("k*u + numbers*u**3", {"k": 1, "numbers": 2}, "'numbers' cannot be the name of a number"),
        ("k*u", {"numbers": {"k": 1}}, "'numbers' cannot be the name of a number in a formula"),
        ("k*u + kind*u**3", {"k": 1, "kind": 2},
         "formula: column 7: 'kind' cannot be the name of a number; use another name"),
        ("k*max(u, 0) + u*k", {"k": 1}, "or max(..., 0) around the whole force of a stop"),
    ],
)  # fmt: skip
def test_what_cannot_be_used_is_one_line_with_its_place(formula, numbers, message) -> None:
    with pytest.raises(InputError) as error:
        Law(formula, **numbers)
    assert message in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("name", ["cls", "self", "obj", "where", "data"])
def test_words_of_python_are_names_of_numbers(name: str) -> None:
    assert Law(f"{name}*u", **{name: 2}).initial_stiffness == 2.0


def test_an_argument_is_passed_once() -> None:
    for make in (
        lambda: Law("k*u + formula*u**3", k=1, formula=2),  # type: ignore[misc]
        lambda: Bumper(1.0, 0.0, 0.1, gap=0.2),  # type: ignore[misc]
    ):
        with pytest.raises(InputError, match="passed twice, by position and by name"):
            make()


def test_a_table_names_the_number_that_has_another_meaning() -> None:
    table = {"kind": "formula", "formula": "k*u + numbers*u**3", "k": 1, "numbers": 2}
    with pytest.raises(InputError, match=r"^isolator: 'numbers' cannot be the name of a number"):
        validate(Oscillator, {"mass": 1, "isolator": table})


def test_a_power_of_0_is_1() -> None:
    assert Law("k*u*abs(v)**0", k=2).read.value(0.0, 0.0) == 0.0
    assert Law("q*d**0 + k*d", gap=1.0, k=2, q=3).read.value(0.5, 0.0) == 4.0
    with pytest.raises(InputError, match=r"'k\*d\*\*n' depends on neither d nor v"):
        Law("k*d**n", gap=1.0, k=2, n=0)


def test_a_formula_that_becomes_a_stop_with_memory_says_so() -> None:
    """Where it is made and printed; not where it has no dashpot or is written otherwise."""
    table = {"kind": "formula", "formula": "k*d + c*v", "k": 50, "c": 25, "gap": 0.1}
    message = r"'k\*d \+ c\*v': it is the law of a Bumper, .* relaxes in 0.5 s; .* max\(k\*d"
    with pytest.warns(InputWarning, match=message) as notices:
        law = Law("k*d + c*v", gap=0.1, k=50, c=25)
    assert [one.filename for one in notices] == [__file__]
    with pytest.warns(InputWarning, match=message):
        validate(Oscillator, {"mass": 1, "isolator": {"stiffness": 1, "damping": 0}, "left": table})
    rig = Oscillator(1.0, Isolator(1.0, 0.1), law, law)  # says nothing a second time
    assert "memory=0.5 s" in str(law)
    assert str(rig).count("memory=0.5") == 2  # it has no units
    assert rig.right == Bumper(50.0, 25.0, 0.1)
    assert "memory" not in str(Law("k*d", gap=0.1, k=50))
    assert "memory" not in str(Oscillator(1.0, Isolator(1.0, 0.1), Bumper(50.0, 0.0, 0.1)))


@pytest.mark.parametrize("formula", ["max(k*d + c*v, 0)", "max(0, c*v + k*d)", "max(k*d+c*v, 0.0)"])
def test_a_clipped_force_has_no_memory(formula: str) -> None:
    law = Law(formula, gap="0.1 m", k="50 N/m", c="25 N s/m")
    rig = Oscillator(1.0, Isolator(1.0, 0.1), law, law)
    assert rig.right is law
    assert not rig.linear
    assert "memory" not in str(rig)
    assert eval(repr(law), {"Law": Law}) == law
    assert law.static_force(0.2) == pytest.approx(10.0, rel=1e-15)
    assert dict(law.rows())["c"] == "25 N s/m"


def test_a_clipped_force_that_has_no_memory_anyway_is_the_built_in_stop() -> None:
    for law, same in (
        (Law("max(k*d, 0)", gap=1.0, k=2), Bumper(2.0, 0.0, 1.0)),
        (Law("max(k*d**1.5*(1 + chi*v), 0)", gap=1.0, k=2, chi=0.5),
         PowerBumper(2.0, 1.0, dissipation=0.5)),
    ):  # fmt: skip
        assert Oscillator(1.0, Isolator(1.0, 0.1), law).right == same


def test_a_formula_in_a_study_file_has_its_path() -> None:
    isolator = {"kind": "formula", "formula": "k*u + q", "k": "26 kN/m", "q": "2 m"}
    with pytest.raises(
        InputError, match=r"^rig\.isolator\.formula: column 7: q: '2 m' is a length;"
    ):
        validate(Oscillator, {"mass": 550, "isolator": isolator}, where="rig")


LAWS = (
    Law("k*tanh(u/a) + c*v", k="3 kN", a="5 mm", c="1 kN s/m"),
    Law("k*d + k3*d**3 + c*v", gap="7.5 mm", k="510 kN/m", k3="1 GN/m^3", c="900 N s/m"),
)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.formula)
def test_a_law_is_a_value(law: Law) -> None:
    assert eval(repr(law), {"Law": Law}) == law
    assert hash(eval(repr(law), {"Law": Law})) == hash(law)
    assert Law.model_validate(law.model_dump()) == law
    stiffer = law.replace(k="600 kN/m" if law.is_stop else "6 kN")
    assert dict(stiffer.numbers)["k"] in (6e5, 6e3)
    assert stiffer.formula == law.formula


def test_places_of_laws_are_told_by_the_gap() -> None:
    isolator, stop = LAWS
    assert Oscillator(1.0, isolator, stop).right is stop
    with pytest.raises(InputError, match=r"^isolator\.gap: an isolator has no gap"):
        Oscillator(1.0, stop)
    with pytest.raises(InputError, match=r"^right\.gap: missing"):
        Oscillator(1.0, isolator, isolator)
    with pytest.raises(InputError, match=r"column 1: 'd\*\*1.5' has no Taylor series where"):
        Law("d**1.5*k + q*d", gap=1.0, k=1, q=1)


@pytest.mark.parametrize(
    ("law", "same"),
    [
        (Law("k*u + c*v", k="26 kN/m", c="1 kN s/m"), Isolator(26e3, 1e3)),
        (Law("k*u + c*v*abs(v)", k=26e3, c=1e3), Isolator(26e3, 1e3, 2.0)),
        (Law("k3*u**3 + k*u", k=2.6, k3=7.1), PolynomialIsolator(2.6, 0.0, 7.1)),
        (Law("u*k + q*u**5 - -c*v", k=2.6, q=7.1, c=1), PolynomialIsolator(2.6, 1.0, 0.0, 7.1)),
    ],
)
def test_a_formula_of_a_built_in_isolator_is_that_isolator(law: Law, same: Isolator) -> None:
    assert Oscillator(1.0, law).isolator == same
    assert law.static_force(0.3) == pytest.approx(same.static_force(0.3), rel=1e-15)


@pytest.mark.parametrize(
    ("law", "same"),
    [
        (Law("k*d", gap=1.0, k=26e3), Bumper(26e3, 0.0, 1.0)),
        (Law("k*d**1.5", gap=1.0, k=26e3), PowerBumper(26e3, 1.0)),
        (Law("k*d**n*(1 + chi*v)", gap=1.0, k=3, n=2.2, chi=0.7),
         PowerBumper(3.0, 1.0, 2.2, dissipation=0.7)),
    ],
)  # fmt: skip
def test_a_formula_of_a_built_in_stop_is_that_stop(law: Law, same: Bumper) -> None:
    assert Oscillator(1.0, Isolator(1.0, 0.1), law, law).stops == {"right": same, "left": same}


def test_softening_and_bounded_laws_know_their_limits() -> None:
    softening = Law("k*u/(1 + abs(u)/a)", k=2.0, a=3.0)
    assert softening.reach == math.inf
    assert softening.strongest == pytest.approx(6.0, rel=1e-6)
    sine = Law("f*sin(u/a)", f=2.0, a=0.5)
    assert sine.reach == pytest.approx(0.25 * math.pi, rel=1e-12)
    assert sine.strongest == pytest.approx(2.0, rel=1e-12)
    assert sine.restoring_reach == pytest.approx(0.5 * math.pi, rel=1e-12)
    with pytest.raises(InputError, match="the isolator bears less than"):
        Oscillator(1.0, softening, force=7.0)


def test_the_model_and_the_engine_have_the_same_limits() -> None:
    assert set(FUNCTIONS) - {"abs"} <= set(SYMBOLS)
    nine = {f"f{i}": i + 0.5 for i in range(5)} | {f"b{i}": i + 0.25 for i in range(4)}
    with pytest.raises(InputError, match="formula: it has 9 numbers; shorten it to at most 8, not"):
        Law("+".join(f"f{i}*sinh(b{i % 4}*u)" for i in range(5)), **nine)
    with pytest.raises(InputError, match="operations; shorten it to at most 50, not"):
        Law("+".join(["k*sin(b*u)*(b*u)**2"] * 6), k=1, b=1)
