"""What is varied: ranges and values by path, as all functions read them."""

from __future__ import annotations

import pytest

import vibroimpact as vi
from vibroimpact.model.parameter_ranges import read_range, read_ranges, read_values

RIG = vi.laboratory.case("B2-G1-A3").rig
WALL = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), right=vi.RigidStop(0.5, 0.1))


def test_ranges_are_read_by_path_and_with_units():
    both = {"gap": ("-1 mm", "20 mm"), "right.stiffness": (1e5, 1e6)}
    gap, stiffness = read_ranges(both, RIG, 2)
    assert (gap.parameter.name, gap.ends, gap.field) == ("gap", (-1e-3, 0.02), "vary['gap']")
    assert stiffness.parameter.name == "stops.right.stiffness"
    assert stiffness.field == "vary['right.stiffness']"


def test_values_are_read_by_path_and_with_units():
    (one,) = read_values({"right.gap": ["1 mm", 0.02]}, RIG)
    assert (one.name, one.units) == ("stops.right.gap", "m")
    assert one.values.tolist() == [1e-3, 0.02]
    assert read_values(None, RIG) == ()


NO_MAPPING = [5, None, "gap", ("gap", (1, 2)), {1: (1, 2)}]


@pytest.mark.parametrize("vary", NO_MAPPING)
def test_what_is_not_a_mapping_of_names_is_refused(vary):
    with pytest.raises(
        vi.InputError,
        match=r"^vary: .*; pass a dict of ranges by parameter, with one parameter, such as "
        r'\{"frequency": \("1 Hz", "3 Hz"\)\}$',
    ):
        read_ranges(vary, RIG)
    with pytest.raises(
        vi.InputError,
        match=r"^vary: .*; pass a dict of values by parameter, with at least one parameter, such "
        r'as \{"gap": \["5 mm", "8 mm"\]\}$',
    ):
        read_values(vary, RIG, least=1)


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        ({}, "^vary: no parameter; pass a dict of ranges by parameter, with one parameter, such"),
        ({"gap": (0, 1), "mass": (1, 2)}, "^vary: 'gap', 'mass'; pass a dict of .*, with one para"),
        ({"damping_rato": (0, 1)}, r"^vary: 'damping_rato' is unknown; did you mean damping_ratio"),
        (
            {"gap": ("20 mm", "10 mm")},
            r"^vary\['gap'\]: the first value, 20 mm, is not below the second, 10 mm",
        ),
        (
            {"gap": (1.0, 1.0)},
            r"^vary\['gap'\]: the first value, 1 m, is not below the second, 1 m",
        ),
        ({"gap": ("1 kg", 0.01)}, r"^vary\['gap'\]\[0\]: '1 kg' is a mass; use a length"),
        (
            {"gap": 0.01},
            r"^vary\['gap'\]: 0\.01; pass the lowest and the highest value of gap as \(",
        ),
        ({"gap": (1, 2, 3)}, r"^vary\['gap'\]: \(1, 2, 3\); pass the lowest and the highest"),
        ({"gap": {1, 2}}, r"^vary\['gap'\]: \{1, 2\}; pass the lowest"),
        (
            {"gap": ("3 mm", 7)},
            r"^vary\['gap'\]: '3 mm' has a unit and 7 has none; write both with units$",
        ),
        ({"gap": ("3", "7 mm")}, r"^vary\['gap'\]: '7 mm' has a unit and '3' has none; write both"),
        ({"frequency": (1, "3 Hz")}, r"^vary\['frequency'\]: '3 Hz' has a unit and 1 has none"),
    ],
)
def test_ranges_that_cannot_be(vary, message):
    with pytest.raises(vi.InputError, match=message):
        read_ranges(vary, RIG)


def test_a_range_keeps_the_bounds_of_its_parameter():
    with pytest.raises(vi.InputError, match=r"^vary\['restitution'\]\[1\]: 1\.2"):
        read_ranges({"restitution": (0.5, 1.2)}, WALL)
    with pytest.raises(vi.InputError, match=r"^vary\['restitution'\]\[0\]: -0\.1"):
        read_ranges({"restitution": (-0.1, 0.5)}, WALL)


def test_0_needs_no_unit_and_a_share_has_none():
    both = {"gap": ("0", "7 mm"), "damping_ratio": ("5 %", 0.1)}
    gap, damping = read_ranges(both, RIG, 2)
    assert (gap.ends, damping.ends) == ((0.0, 7e-3), (0.05, 0.1))
    assert read_ranges({"gap": ("-1 mm", 0)}, RIG)[0].ends == (-1e-3, 0.0)


def test_a_range_begins_at_0_only_if_its_parameter_may_be_0():
    assert read_ranges({"gap": (0.0, 0.1)}, RIG)[0].ends == (0.0, 0.1)
    with pytest.raises(vi.InputError, match=r"^vary\['mass'\]\[0\]: 0 is not greater than 0"):
        read_ranges({"mass": (0, 1)}, RIG)
    (one,) = read_ranges({"gap": (0.0, 0.1)}, RIG)
    with pytest.raises(vi.InputError, match=r"^gap\[0\]: 0 is not greater than 0"):
        read_range(one.parameter, (0, "1 mm"), "gap", positive=True)


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        (
            {"gap": [0.1], "mass": [1.0]},
            "^vary: 'gap', 'mass'; .* with at most one parameter, such",
        ),
        ({"mas": [1.0]}, r"^vary: 'mas' is unknown; did you mean mass\?"),
        ({"amplitude": [1.0]}, "^vary: 'amplitude' is the shaking; remove it"),
        ({"gap": 0.1}, r"^vary\['gap'\]: 0\.1 is not a list; pass a list of values of gap"),
        ({"gap": []}, r"^vary\['gap'\]: the list is empty; pass at least one value of gap"),
        ({"gap": ["1 mm", "2 kg"]}, r"^vary\['gap'\]\[1\]: '2 kg' is a mass; use a length"),
        ({"gap": [1e-3, "1 mm"]}, r"^vary\['gap'\]: 1 mm is given twice; remove one of the two"),
        ({"gap": [1, 2, 3, 4]}, r"^vary\['gap'\]: more than 3 items; pass at most 3"),
    ],
)
def test_values_that_cannot_be(vary, message):
    with pytest.raises(vi.InputError, match=message):
        read_values(vary, RIG, most=1, longest=3, but=("amplitude",), why="is the shaking")


def test_two_names_of_one_parameter_are_refused():
    twice = {"gap": (0, 1), "stops.gap": (0, 2)}
    for read in (lambda: read_ranges(twice, RIG, 2), lambda: read_values(twice, RIG)):
        with pytest.raises(
            vi.InputError, match=r"^vary: 'gap' and 'stops\.gap' are the same parameter; remove one"
        ):
            read()
