"""Immutable, validated, printable: what every model object shares."""

import copy
import pickle
import pydoc
from typing import Annotated

import pytest

from vibroimpact.errors import InputError
from vibroimpact.model import (
    Bumper,
    Dimensionless,
    DimensionlessBumper,
    DimensionlessRigidStop,
    Harmonic,
    Isolator,
    Model,
    Oscillator,
    RigidStop,
    State,
    validate,
)
from vibroimpact.model.quantities import LENGTH
from vibroimpact.model.validation import Accepts

ISOLATOR = Isolator(26800.0, 1100.0)
BUMPER = Bumper(510e3, 900.0, 0.0075)
OSCILLATOR = Oscillator(550.0, ISOLATOR, BUMPER, None)
HARMONIC = Harmonic(0.4903325, 2.5, 0.1)
STATE = State(0.001, -0.2, {"right": 0.0, "left": 0.001}, 0.3, 0)
WALL = RigidStop(0.8, -0.002)
ONE_WALL = Oscillator(550.0, ISOLATOR, BUMPER, WALL)
SCALED = Dimensionless(
    0.15, DimensionlessBumper(20.0, 0.5, 0.01), DimensionlessRigidStop(0.8, -0.1)
)
OBJECTS = [ISOLATOR, BUMPER, OSCILLATOR, HARMONIC, STATE, WALL, ONE_WALL, SCALED]


def table(**changes):
    """Return what a study file's [oscillator] would hold."""
    return {
        "mass": "550 kg",
        "isolator": {"stiffness": "26.8 kN/m", "damping": "1.1 kN s/m"},
        "right": {"stiffness": 510e3, "damping": 900, "gap": "7.5 mm"},
    } | changes


@pytest.mark.parametrize("thing", OBJECTS, ids=lambda o: type(o).__name__)
class TestEveryObject:
    def test_repr_is_the_exact_constructor_call(self, thing):
        assert eval(repr(thing)) == thing

    def test_str_is_one_readable_line(self, thing):
        text = str(thing)
        assert text.startswith(f"{type(thing).__name__}(")
        assert "\n" not in text

    def test_compares_and_hashes_by_value(self, thing):
        twin = type(thing)(**dict(thing))
        assert twin == thing
        assert twin is not thing
        assert hash(twin) == hash(thing)
        assert len({twin, thing}) == 1

    def test_cannot_be_changed(self, thing):
        name = next(iter(type(thing).model_fields))
        before = getattr(thing, name)
        with pytest.raises(InputError, match=f"{name}: .* is immutable; use .replace"):
            setattr(thing, name, before)
        with pytest.raises(InputError, match="immutable"):
            thing.something_new = 1
        with pytest.raises(InputError, match="immutable"):
            delattr(thing, name)
        assert getattr(thing, name) is before

    def test_pickles_and_copies(self, thing):
        assert pickle.loads(pickle.dumps(thing)) == thing
        assert copy.copy(thing) == thing
        assert copy.deepcopy(thing) == thing

    def test_table_round_trip(self, thing):
        assert validate(type(thing), thing.model_dump()) == thing
        assert type(thing).model_validate_json(thing.model_dump_json()) == thing
        assert validate(type(thing), thing) == thing

    def test_replace_with_nothing(self, thing):
        assert thing.replace() == thing


def test_objects_of_different_kind_differ():
    assert Isolator(1.0, 2.0) != Harmonic(1.0, 2.0)
    assert Bumper(1.0, 2.0, 3.0) != Bumper(1.0, 2.0, 4.0)


def test_replace_validates():
    assert BUMPER.replace(gap="4 mm") == Bumper(510e3, 900.0, 0.004)
    assert BUMPER.gap == 0.0075
    for change in (BUMPER.replace, lambda **c: BUMPER.model_copy(update=c)):
        with pytest.raises(
            InputError, match=r"^damping: -1 is less than 0; use a damping of at le"
        ):
            change(damping=-1)
        with pytest.raises(
            InputError, match=r"^gapp: unknown key; did you mean gap\? Use stiffness, "
        ):
            change(gapp=1)


def test_nested_tables_become_objects():
    oscillator = validate(Oscillator, table())
    assert oscillator == OSCILLATOR
    assert isinstance(oscillator.isolator, Isolator)
    assert isinstance(oscillator.right, Bumper)
    assert Oscillator("550 kg", table()["isolator"], table()["right"]) == oscillator


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (
            table(right={"stiffness": 1, "damping": 1, "gap": "15 kg"}),
            "rig.right.gap: '15 kg' is a mass; use a length, such as \"15 mm\" or 0.015 (m)",
        ),
        (
            table(isolator={"stiffness": -1, "damping": 1}),
            "rig.isolator.stiffness: -1 is less than 0; use a stiffness of at least 0, "
            'such as "510 kN/m" or 510000 (N/m)',
        ),
        (
            table(mass=float("nan")),
            'rig.mass: nan is not finite; use a mass greater than 0, such as "550 kg" or 550 (kg)',
        ),
        (
            table(isolator={"stiffness": 1}),
            "rig.isolator.damping: missing; add a damping of at least 0, such as "
            '"1.1 kN s/m" or 1100 (N s/m)',
        ),
        (
            table(color="red"),
            "rig.color: unknown key; use mass, isolator, right, left, force, units or weight",
        ),
        (
            table(isolator={"stifness": 1, "damping": 1}),
            "rig.isolator.stifness: unknown key; did you mean stiffness? Use stiffness, damping, "
            "damping_exponent, period or damping_ratio",
        ),
        (
            table(right="510 kN/m"),
            "rig.right: '510 kN/m' is not a table; pass a table of stiffness, damping and gap",
        ),
        (
            table(isolator=4),
            "rig.isolator: 4 is not a table; pass a table of stiffness, damping and "
            "damping_exponent",
        ),
        (
            {"isolator": {"stiffness": 1, "damping": 1}},
            'rig.mass: missing; add a mass greater than 0, such as "550 kg" or 550 (kg)',
        ),
    ],
)
def test_a_mistake_in_a_table_is_named_by_its_path(data, message):
    with pytest.raises(InputError) as caught:
        validate(Oscillator, data, where="rig")
    assert str(caught.value) == message
    # Without a place, the path starts in the table itself.
    with pytest.raises(InputError) as caught:
        Oscillator.model_validate(data)
    assert str(caught.value) == message.removeprefix("rig.")


def test_all_unknown_keys_are_named_at_once():
    data = table(color="red", isolator={"stifness": 1, "damping": 1}, force="1 kg")
    with pytest.raises(InputError) as caught:
        validate(Oscillator, data, where="rig")
    text = str(caught.value)
    assert "rig.color: unknown key; " in text
    assert "rig.isolator.stifness: unknown key; did you mean stiffness? Use stiffness, " in text
    assert text.endswith("(1 more to correct)")
    assert "\n" not in text


def test_what_is_no_table_at_all():
    with pytest.raises(InputError, match=r"^3 is not a table"):
        validate(Oscillator, 3)
    with pytest.raises(InputError, match=r"^rig: \[\] is not a table"):
        validate(Oscillator, [], where="rig")
    with pytest.raises(InputError):
        Oscillator.model_validate_json("{")


def test_a_mistake_below_a_constructor_has_its_path():
    with pytest.raises(InputError, match=r"^right\.damping: -1 is less than 0"):
        Oscillator(1.0, ISOLATOR, {"stiffness": 1, "damping": -1, "gap": 0})


@pytest.mark.parametrize("model", [Bumper, Oscillator, State])
def test_help_shows_the_model_and_not_pydantic(model):
    text = pydoc.plain(pydoc.render_doc(model))
    assert "Parameters" in text
    assert "replace(" in text
    assert "model_dump" not in text
    # Python 3.13 breaks long signatures into lines; 1,002 words on 3.14.
    assert len(text.split()) < 1050


def test_no_pydantic_traceback_hangs_on_the_error():
    with pytest.raises(InputError) as caught:
        Bumper(1.0, -1.0, 1.0)
    assert caught.value.__cause__ is None
    assert caught.value.__suppress_context__


def test_another_layer_can_build_on_the_base_class():
    class Study(Model):
        oscillator: Oscillator
        offsets: list[Annotated[float, Accepts(LENGTH)]]
        title: str = ""

    study = validate(Study, {"oscillator": table(), "offsets": ["1 mm", 2]})
    assert study.offsets == [0.001, 2.0]
    with pytest.raises(InputError, match=r"^offsets\[1\]: '1 kg' is a mass; use a length"):
        validate(Study, {"oscillator": table(), "offsets": ["1 mm", "1 kg"]})
    with pytest.raises(InputError, match=r"^oscillator\.right: '' is not a table"):
        Study(oscillator=table(right=""), offsets=[])
    with pytest.raises(InputError, match=r"^title: 3 is not a string in quotes$"):
        Study(oscillator=table(), offsets=[], title=3)


@pytest.mark.parametrize("mass", [{}, {"mass": "550 m"}, {"mas": "550 kg"}])
def test_what_only_follows_from_a_wrong_mass_is_not_counted(mass):
    stop = {"stiffness": "1 MN/m", "restitution": 0.6, "gap": "5 mm"}
    data = {
        **mass,
        "isolator": {"period": "1 s", "damping_ratio": 0.1},
        "right": stop,
        "left": stop,
    }
    with pytest.raises(InputError, match=r"^mas[s]?: ") as refused:
        Oscillator.model_validate(data)
    assert "more to correct" not in str(refused.value)
    with pytest.raises(InputError, match=r"\(1 more to correct\)$"):
        Oscillator.model_validate({**data, "force": "3 kg"})


def test_what_a_misspelt_key_does_not_explain_is_counted():
    with pytest.raises(InputError, match=r"did you mean gap\? Use .* \(1 more to correct\)$"):
        Oscillator.model_validate(
            {
                "mass": 1.0,
                "isolator": {"stiffness": 1, "damping": 0},
                "right": {"gapp": 1, "stiffness": 1},
            }
        )


def test_many_unknown_keys_are_one_short_line():
    keys = {f"{'k' * 30}{i}": 1.0 for i in range(200_000)}
    with pytest.raises(InputError, match=r"\(199995 more to correct\)") as refused:
        Isolator(1.0, 1.0, **keys)
    assert len(str(refused.value)) < 1300
    with pytest.raises(InputError) as refused:
        Isolator.model_validate({"stiffness": 1.0, "damping": 1.0, "x" * 10**6: 1.0})
    assert len(str(refused.value)) < 1300
