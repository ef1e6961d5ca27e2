"""The laws of stops: tables, units, dissipation, and what is refused."""

from __future__ import annotations

import math

import pytest
from mpmath import mp
from scipy.integrate import solve_ivp

import vibroimpact as vi
from vibroimpact.model.stops.dissipation import RELATIONS
from vibroimpact.model.validation import validate

ISOLATOR = {"stiffness": "26.8 kN/m", "damping": "1.1 kN s/m"}
TABLES = {
    "kelvin-voigt": {"stiffness": 510e3, "damping": 900, "gap": "7.5 mm"},
    "rigid": {"restitution": 0.8, "gap": "9 mm"},
    "power": {"stiffness": "2 GN/m^1.5", "gap": "7 mm", "dissipation": "0.4 s/m"},
    "jankowski": {"stiffness": "2 GN/m^1.5", "gap": 0, "restitution": 0.6, "mass": "550 kg"},
}


def of(kind: str, **changes: object) -> vi.Oscillator:
    table = {"kind": kind, **TABLES[kind], **changes}
    return validate(vi.Oscillator, {"mass": 550, "isolator": ISOLATOR, "left": table}, "rig")


@pytest.mark.parametrize("kind", TABLES)
def test_object_to_table_and_back(kind):
    rig = of(kind)
    written = rig.model_dump()
    assert written["left"].get("kind", "kelvin-voigt") == kind
    assert validate(vi.Oscillator, written) == rig
    assert eval(repr(rig.left), {n: getattr(vi, n) for n in vi.__all__}) == rig.left
    assert rig.linear == (kind in ("kelvin-voigt", "rigid"))


def test_a_power_bumper_of_every_way():
    for changes in (
        {"dissipation": None},
        {"dissipation": None, "restitution": 0.5, "relation": "flores"},
        {"exponent": 2.2, "stiffness": "3 kN/m^2.2"},
        {"exponent": 1, "stiffness": "3 kN/m"},
    ):
        rig = of("power", **changes)
        assert validate(vi.Oscillator, rig.model_dump()) == rig
    assert "stiffness=3 kN/m^2.2" in str(of("power", exponent=2.2, stiffness=3e3).left)
    assert "relation" not in of("power").model_dump()["left"]


@pytest.mark.parametrize(
    ("kind", "changes", "message"),
    [
        (
            "power",
            {"restitution": 0.5},
            "dissipation: 0.4 s/m is given together with a restitution",
        ),
        (
            "power",
            {"dissipation": None, "restitution": 0.5, "relation": "hertz"},
            "relation: 'hertz' is unknown; use 'exact', 'hunt-crossley', 'lankarani-nikravesh', "
            "'flores' or 'gonthier'",
        ),
        ("power", {"relation": "flores"}, "relation: 'flores' is given without a restitution"),
        ("power", {"dissipation": None, "restitution": 1.1}, "restitution: 1.1 is greater than 1"),
        ("power", {"dissipation": None, "restitution": -0.1}, "restitution: -0.1 is less than 0"),
        (
            "power",
            {"dissipation": None, "restitution": 0},
            "restitution: 0 gives an infinite dissipation with the relation 'exact'; use a resti",
        ),
        ("power", {"dissipation": -1}, "dissipation: -1 is less than 0; use a dissipation factor"),
        (
            "power",
            {"exponent": 0.5},
            "exponent: 0.5 is less than 1; use a dimensionless number of at least 1, such as 1.5",
        ),
        (
            "power",
            {"stiffness": "3 kN/m"},
            "stiffness: '3 kN/m' is a stiffness; use a stiffness in N/",
        ),
        (
            "power",
            {"stiffness": 0},
            "stiffness: 0 is not greater than 0; use a stiffness in N/m^1.5",
        ),
        (
            "jankowski",
            {"restitution": 0},
            "restitution: 0 is not greater than 0; use a dimensionless",
        ),
        ("jankowski", {"restitution": 1.2}, "restitution: 1.2 is greater than 1"),
        ("jankowski", {"mass": 0}, "mass: 0 is not greater than 0"),
    ],
)
def test_bad_input_is_told_in_one_line(kind, changes, message):
    with pytest.raises(vi.InputError) as caught:
        of(kind, **changes)
    text = str(caught.value)
    assert text.startswith("rig.left")
    assert message in text
    assert "\n" not in text


def test_no_restitution_at_all_where_it_stays_finite():
    for relation, d in (("hunt-crossley", 1.5), ("lankarani-nikravesh", 0.75)):
        assert vi.PowerBumper(1, 1, restitution=0, relation=relation).dissipation_number == d


@pytest.mark.parametrize("e", [1e-12, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1 - 1e-6, 1 - 1e-13])
def test_the_exact_relation_to_all_digits(e):
    d = vi.PowerBumper(1, 1, restitution=e).dissipation_number
    with mp.workdps(60):
        x = mp.mpf(e)

        def left(d):
            return mp.log((1 + d) / (1 - x * d)) - d * (1 + x)

        top = 1 / x
        low = mp.mpf(3) / 4 * (1 - x)
        high = top * (1 - mp.mpf(10) ** -55)
        for _ in range(400):
            middle = (low + high) / 2
            low, high = (middle, high) if left(middle) < 0 else (low, middle)
        assert d == pytest.approx(float(low), rel=4e-16)


def returned(force, mass=1.0):
    """Restitution of an impact of speed 1 on a stop that nothing else presses, from its law."""

    def rates(_, y):
        return y[1], -max(force(max(y[0], 0.0), y[1]), 0.0) / mass

    def parted(t, y):
        return y[0] if t > 1e-6 else 1.0

    parted.terminal, parted.direction = True, -1
    done = solve_ivp(rates, (0, 100), [0.0, 1.0], "DOP853", events=parted, rtol=1e-11, atol=1e-14)
    return -float(done.y[1, -1])


PUBLISHED = {
    "hunt-crossley": (0.581, 0.663, 0.768, 0.909),
    "lankarani-nikravesh": (0.684, 0.725, 0.796, 0.913),
    "flores": (0.256, 0.470, 0.683, 0.894),
    "gonthier": (0.304, 0.488, 0.670, 0.876),
    "exact": (0.3, 0.5, 0.7, 0.9),
}


@pytest.mark.parametrize("relation", RELATIONS)
@pytest.mark.parametrize("n", [1.0, 1.5])
def test_what_each_relation_returns(relation, n):
    for asked, published in zip((0.3, 0.5, 0.7, 0.9), PUBLISHED[relation], strict=True):
        bumper = vi.PowerBumper(50.0, 0, n, restitution=asked, relation=relation)
        chi = bumper.dissipation_number
        restitution = returned(lambda d, v, c=chi: 50.0 * d**n * (1.0 + c * v))
        assert restitution == pytest.approx(published, abs=6e-4)


def test_what_jankowski_returns():
    k = 50.0
    for asked, expected in zip((0.3, 0.5, 0.7, 0.9), (0.292, 0.495, 0.698, 0.900), strict=True):
        bumper = vi.JankowskiBumper(50.0, 0, asked, 2.0)

        def force(d, v, xi=bumper.damping_ratio):
            damping = 2.0 * xi * math.sqrt(2.0 * k * math.sqrt(d))
            return k * d**1.5 + damping * max(v, 0.0)

        assert returned(force, 2.0) == pytest.approx(expected, abs=6e-4)
    assert vi.JankowskiBumper(50.0, 0, 1, 2.0).damping_ratio == 0.0


def test_static_forces():
    assert vi.Bumper(3.0, 1.0, 0.1).static_force(2.0) == 6.0
    assert vi.PowerBumper(3.0, 0.1, 2.0, dissipation=5).static_force(2.0) == 12.0
    assert vi.JankowskiBumper(3.0, 0.1, 0.5, 1).static_force(4.0) == 24.0
    for stop in (vi.Bumper(3, 1, 0), vi.PowerBumper(3, 0), vi.JankowskiBumper(3, 0, 0.5, 1)):
        assert stop.static_force(-1.0) == 0.0


def test_what_takes_energy():
    assert vi.PowerBumper(1, 1).dissipation_number == 0.0
    assert vi.PowerBumper(1, 1, dissipation=0.3).dissipation_number is None
    assert vi.PowerBumper(1, 1, restitution=1).dissipation_number == 0.0
