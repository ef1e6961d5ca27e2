"""Tables that say which law they describe."""

import pytest

from vibroimpact.errors import InputError
from vibroimpact.model import (
    Bumper,
    Dimensionless,
    DimensionlessRigidStop,
    Isolator,
    Oscillator,
    RigidStop,
    validate,
)
from vibroimpact.model.stops import STOPS

ISOLATOR = {"stiffness": "26.8 kN/m", "damping": "1.1 kN s/m"}
BUMPER = {"stiffness": 510e3, "damping": 900, "gap": "7.5 mm"}
WALL = {"kind": "rigid", "restitution": 0.8, "gap": "9 mm"}
*FIRST, LAST = map(repr, STOPS.classes)
KINDS = f"{', '.join(FIRST)} or {LAST}"


def rig(**sides):
    return validate(Oscillator, {"mass": 550, "isolator": ISOLATOR, **sides}, where="rig")


def test_a_kind_chooses_the_law():
    oscillator = rig(right=WALL, left=BUMPER)
    assert oscillator.right == RigidStop(0.8, 0.009)
    assert oscillator.left == Bumper(510e3, 900.0, 0.0075)
    assert Oscillator(550, ISOLATOR, WALL).right == oscillator.right


def test_the_usual_kind_may_be_named():
    assert rig(right={"kind": "kelvin-voigt", **BUMPER}) == rig(right=BUMPER)
    named = Oscillator(550, {"kind": "linear", **ISOLATOR})
    assert named.isolator == Isolator(26.8e3, 1.1e3)


def test_only_an_unusual_kind_is_written():
    written = rig(right=WALL, left=BUMPER).model_dump()
    assert written["right"] == {"kind": "rigid", "restitution": 0.8, "gap": 0.009}
    assert set(written["left"]) == {"stiffness", "damping", "gap"}
    assert set(written["isolator"]) == {"stiffness", "damping"}


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (
            {"right": {"kind": "hertz", "stiffness": 1}},
            f"rig.right.kind: 'hertz' is unknown; use {KINDS}",
        ),
        (
            {"left": {"kind": 3}},
            f"rig.left.kind: 3 is unknown; use {KINDS}",
        ),
        (
            {"isolator": {"kind": "rubber"}},
            "rig.isolator.kind: 'rubber' is unknown; use 'linear', 'friction', 'bilinear', "
            "'polynomial', 'bouc-wen', 'exponential' or 'formula'",
        ),
        (
            {"right": {**WALL, "restitution": 2}},
            "rig.right.restitution: 2 is greater than 1; use a dimensionless number from 0 to 1, "
            "such as 0.15",
        ),
        (
            {"right": {**WALL, "gapp": 2}},
            "rig.right.gapp: unknown key; did you mean gap? Use restitution or gap",
        ),
        (
            {"isolator": {**ISOLATOR, "cubic": 2}},
            "rig.isolator.cubic: unknown key; use stiffness, damping, damping_exponent, period or "
            "damping_ratio; PolynomialIsolator (kind 'polynomial') has this key",
        ),
        (
            {"right": {**WALL, "exponent": 2}},
            "rig.right.exponent: unknown key; use restitution or gap; PowerBumper "
            "(kind 'power') has this key",
        ),
        (
            {"right": {"kind": "rigid", "gap": 2}},
            "rig.right.restitution: missing; add a dimensionless number from 0 to 1, such as 0.15",
        ),
        (
            {"right": {"restitution": 0.8, **BUMPER}},
            "rig.right.restitution: this bumper also has a damping; remove one of the two",
        ),
        (
            {"right": {**BUMPER, "gap": "3 kg"}},
            "rig.right.gap: '3 kg' is a mass; use a length, such as \"15 mm\" or 0.015 (m)",
        ),
    ],
)
def test_mistakes_are_named_by_their_path(table, message):
    with pytest.raises(InputError) as caught:
        rig(**table)
    assert str(caught.value) == message


def test_the_law_with_a_misplaced_argument_is_named():
    with pytest.raises(InputError, match=r"^cubic: .*; PolynomialIsolator \(kind 'polynomial'\)"):
        Isolator(26e3, 1e3, cubic=1.0)


def test_a_table_of_another_kind_is_refused():
    with pytest.raises(
        InputError,
        match=r"kind: 'kelvin-voigt' is not the kind of a RigidStop; use 'rigid'",
    ):
        RigidStop.model_validate({**WALL, "kind": "kelvin-voigt"})


def test_dimensionless_tables_have_the_same_kinds():
    group = validate(
        Dimensionless,
        {"damping_ratio": 0.1, "right": {"kind": "rigid", "restitution": 1, "gap": 0}},
    )
    assert group.right == DimensionlessRigidStop(1.0, 0.0)
