"""The registry of parameters: what is read is what was written, and nothing else changes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

import numpy as np
import pytest

import vibroimpact as vi
from formula_stops import formula_stops
from vibroimpact.errors import InputError
from vibroimpact.model.isolators import ISOLATORS as ISOLATOR_KINDS
from vibroimpact.model.parameter_ranges import read_ranges
from vibroimpact.model.parameters import PARAMETERS, parameter, set_values
from vibroimpact.model.paths import put, walk
from vibroimpact.model.quantities import MASS
from vibroimpact.model.stops import STOPS
from vibroimpact.model.validation import Accepts, Model
from vibroimpact.scenarios.axes import NAMES

CASE = vi.laboratory.case("B2-G1-A3")
RIG, SHAKEN = CASE.oscillator, vi.Harmonic(CASE.amplitude, 2.0)
WALLS = RIG.replace(right=vi.RigidStop(0.4, 7.5e-3), left=vi.RigidStop(0.4, 7.5e-3))


HERTZ = vi.PowerBumper("2 GN/m^1.5", "7.5 mm", dissipation=0.4)
POUNDING = vi.JankowskiBumper("2 GN/m^1.5", "7.5 mm", 0.6, 550)
YIELDING = {"elastic_stiffness": 1e5, "post_yield_stiffness": 3e4, "yield_force": 800, "damping": 0}
ISOLATORS = {
    "friction": vi.FrictionIsolator(3e4, 1e3, 120),
    "yield_force": vi.BilinearIsolator(**YIELDING),
    "elastic_stiffness": vi.BilinearIsolator(**YIELDING),
    "post_yield_stiffness": vi.BoucWenIsolator(**YIELDING),
    "beta": vi.BoucWenIsolator(**YIELDING),
    "gamma": vi.BoucWenIsolator(**YIELDING),
    "cubic": vi.PolynomialIsolator(3e4, 0, 1e6, -1e7),
    "quintic": vi.PolynomialIsolator(3e4, 0, 1e6, -1e7),
} | {
    name: vi.ExponentialIsolator(1e5, 3e4, 300, 0, 20, 50)
    for name in ("reversal_stiffness", "final_stiffness", "decay", "hardening", "hardening_force")
}


def having(name: str) -> vi.Oscillator:
    """A rig that has the parameter."""
    oscillator = RIG.replace(isolator=ISOLATORS.get(name.removeprefix("isolator."), RIG.isolator))
    stops = {"restitution": WALLS.right, "mass": POUNDING, "exponent": HERTZ, "dissipation": HERTZ}
    for one in (RIG.right, *formula_stops(4e5, 7.5e-3).values()):
        stops = dict.fromkeys(dict(one), one) | stops
    stop = stops.get(name.rpartition(".")[2], RIG.right) if name.startswith("stops") else RIG.right
    return oscillator.replace(right=stop, left=stop)


@pytest.mark.parametrize("name", PARAMETERS)
def test_what_is_written_is_read(name):
    start = vi.Rig(having(name), SHAKEN)
    one = parameter(name, start)
    assert one.name == name
    here = one.read(start) or 120.0
    moved = one.vary(start, 1.5 * here)
    assert one.read(moved) == pytest.approx(1.5 * here, rel=1e-12)
    back = one.vary(moved, one.read(start))
    for number, value in zip(numbers(back), numbers(start), strict=True):
        assert number == pytest.approx(value, rel=1e-12)


def numbers(whole: vi.Rig) -> list[float]:
    rig, shaken = whole.oscillator, whole.sine
    sides = [value for stop in rig.stops.values() for value in dict(stop).values()]
    isolator = list(dict(rig.isolator).values())
    values = [rig.mass, *isolator, *sides, *shaken.model_dump().values()]
    return [value for value in values if isinstance(value, float)]


def test_names_and_units():
    assert all(name == one.name and one.long_name for name, one in PARAMETERS.items())
    assert parameter("stops.damping", RIG).units == "N s m-1"
    assert parameter("gap", RIG).physical
    assert not parameter("gap-ratio", RIG).physical
    assert set(NAMES) <= set(PARAMETERS)
    with pytest.raises(vi.InputError, match=r"^along: 'xy' is unknown; use frequency, .* or "):
        parameter("xy", RIG, "along")
    with pytest.raises(vi.InputError, match=r"did you mean stops.stiffness\? Use frequency, "):
        parameter("Stops.stifness", RIG)
    with pytest.raises(vi.InputError, match=r"'right_gap' .*did you mean right.gap\?"):
        parameter("right_gap", RIG)


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("gap", "gap"),
        ("stops.gap", "gap"),
        ("right.gap", "stops.right.gap"),
        ("oscillator.right.gap", "stops.right.gap"),
        ("stops.right.gap", "stops.right.gap"),
        ("friction", "isolator.friction"),
        ("isolator.damping-exponent", "isolator.damping_exponent"),
        ("shaking.amplitude", "amplitude"),
        ("oscillator.mass", "mass"),
    ],
)
def test_a_path_may_be_short_where_it_is_clear(path, name):
    rig = RIG.replace(isolator=ISOLATORS["friction"])
    assert parameter(path, rig).name == name


@pytest.mark.parametrize("name", ["stiffness", "damping"])
def test_a_number_that_the_isolator_and_the_stops_have_needs_its_path(name):
    with pytest.raises(vi.InputError, match=rf"use 'isolator\.{name}' or 'stops\.{name}'"):
        parameter(name, RIG)
    # Whatever this rig has: the meaning of a name must not depend on a law.
    with pytest.raises(vi.InputError, match=r"is not a path; use 'isolator\.damping'$"):
        parameter("damping", WALLS)


class _Frame(Model):
    """A tree with mappings, as that of several masses."""

    masses: Annotated[Mapping[str, Annotated[float, Accepts(MASS, above=0.0)]], "by name"]
    links: Mapping[str, vi.Isolator]


def test_paths_walk_mappings_and_models():
    frame = _Frame(masses={"roof": 250.0}, links={"isolator": vi.Isolator(3.0, 1.0)})
    values = {".".join(one.steps): one.value for one in walk(frame)}
    assert values["masses.roof"] == 250.0
    assert values["links.isolator.stiffness"] == 3.0
    changes = {("masses", "roof"): "300 kg", ("links", "isolator", "stiffness"): "4 kN/m"}
    moved = put(frame, changes)
    assert moved.masses == {"roof": 300.0}
    assert moved.links["isolator"] == vi.Isolator(4e3, 1.0)
    with pytest.raises(vi.InputError, match=r"^links\.isolator\.stiffness: '3 kg' is a mass"):
        put(frame, {("links", "isolator", "stiffness"): "3 kg"})


def test_values_are_set_at_once_and_an_absent_stop_is_made():
    rig = vi.Rig(RIG)
    start = set_values(rig, {"gap": "9 mm", "left": None, "isolator.damping": "2 kN s/m"})
    moved = start.oscillator
    assert (moved.right.gap, moved.left, moved.isolator.damping) == (9e-3, None, 2e3)
    made = set_values(start, {"left.stiffness": "1 MN/m", "left.damping": 0.0, "left.gap": "1 mm"})
    assert made.oscillator.left == vi.Bumper(1e6, 0.0, 1e-3)
    with pytest.raises(vi.InputError, match=r"^left\.damping: missing"):
        set_values(start, {"left.stiffness": "1 MN/m", "left.gap": "1 mm"})
    with pytest.raises(vi.InputError, match=r"^right\.gap: '1 kg' is a mass"):
        set_values(rig, {"right.gap": "1 kg"})
    with pytest.raises(vi.InputError, match=r"'isolator\.nothing' is unknown; use frequency"):
        set_values(rig, {"isolator.nothing": 1.0})


LAWS = [
    *(law.like(3e4, 100.0, 0.02) for law in ISOLATOR_KINDS.classes.values()),
    *ISOLATORS.values(),
    *(law.like(2e3, 5e-3, 7.5e-3, 0.6, 7.0, 550.0) for law in STOPS.classes.values()),
    *(HERTZ, POUNDING, RIG.right, WALLS.right),
]


@pytest.mark.parametrize("law", dict.fromkeys(one for one in LAWS if one is not None), ids=repr)
def test_every_number_of_a_law_is_read_from_text(law):
    part = "right" if law.is_stop else "isolator"
    rig = vi.Rig(RIG.replace(**{part: law}), SHAKEN)
    numbers = {name: value for name, value in dict(law).items() if isinstance(value, int | float)}
    assert numbers
    for name, value in numbers.items():
        assert set_values(rig, {f"{part}.{name}": repr(value)}) == rig


def test_sides_that_differ():
    uneven = RIG.replace(left=RIG.left.replace(damping=1.0))
    for name in ("stops.damping", "relaxation_time"):
        with pytest.raises(vi.InputError, match=r"use 'right\.damping' or 'left\.damping'"):
            parameter(name, uneven).read(vi.Rig(uneven, SHAKEN))
    assert parameter("left.damping", uneven).read(vi.Rig(uneven, SHAKEN)) == 1.0
    free = RIG.without_bumpers()
    with pytest.raises(vi.InputError, match="the rig has no stop with a stiffness"):
        parameter("relaxation_time", free).read(vi.Rig(free, SHAKEN))


def test_one_value_does_not_set_numbers_of_different_units():
    """1e6 would be N/m of one stop, and N/m^1.5 of the other."""
    rig = vi.Rig(RIG.replace(right=vi.PowerBumper(1e8, 7.5e-3)), SHAKEN)
    problem = r"units of stiffness, N/m and N/m\^1\.5.*use 'right\.stiffness' or 'left\.stiffness'"
    with pytest.raises(vi.InputError, match=problem):
        set_values(rig, {"stops.stiffness": 1e6})
    with pytest.raises(vi.InputError, match=problem):
        parameter("stops.stiffness", rig).vary(rig, 1e6)
    assert set_values(rig, {"gap": "1 mm"}).oscillator.left.gap == 1e-3


@pytest.mark.parametrize("path", ["right.kind", "isolator.kind"])
def test_a_law_is_not_changed_by_its_kind_alone(path):
    with pytest.raises(vi.InputError, match=rf"{path}: the law is \w+; to change it, edit"):
        set_values(vi.Rig(RIG, SHAKEN), {path: "power"})


@pytest.mark.parametrize("name", ["friction", "cubic", "decay", "dissipation", "left.mass"])
def test_a_rig_without_it_is_refused_in_one_line(name):
    with pytest.raises(
        vi.InputError, match=r"is not a parameter of this rig; .*[uU]se frequency, "
    ) as caught:
        parameter(name, RIG)
    assert "\n" not in str(caught.value)


def test_what_is_given_in_another_way_or_is_a_whole_number_is_not_varied():
    elastic = RIG.replace(right=HERTZ.replace(dissipation=None), left=None)
    with pytest.raises(vi.InputError, match=r"'stops\.dissipation' is not a parameter of this rig"):
        parameter("stops.dissipation", elastic)
    smooth = RIG.replace(isolator=ISOLATORS["beta"])
    for path, field, problem in (
        ("isolator.exponent", "vary", "takes whole numbers, so it cannot be varied; compute a rig"),
        (
            "isolator.exponent",
            "--vary",
            "takes whole .*; run the command once per value, with --set isolator.exponent=VALUE$",
        ),
        ("exponent", "vary", r"is not a path; use 'isolator\.exponent'$"),
    ):
        with pytest.raises(vi.InputError, match=f"^{field}: '{path}' {problem}"):
            parameter(path, smooth, field)


@pytest.mark.parametrize("path", ["exponent", "left.mass", "stops.exponent", "oscillator.decay"])
def test_a_path_is_named_as_it_was_typed(path):
    with pytest.raises(vi.InputError, match=f"^parameter: '{path}' is not a parameter of this rig"):
        set_values(vi.Rig(RIG, SHAKEN), {path: 3})


def test_messages_write_values_with_units():
    yielding = vi.Rig(RIG.replace(isolator=ISOLATORS["yield_force"]), SHAKEN)
    with pytest.raises(
        vi.InputError, match=r"^isolator\.elastic_stiffness at 10 kN/m: isolator\.post_yield_st"
    ):
        parameter("elastic_stiffness", yielding).vary(yielding, 1e4)
    uneven = vi.Rig(RIG.replace(left=RIG.left.replace(gap=5e-3)), SHAKEN)
    for name in ("gap", "gap_ratio"):
        with pytest.raises(
            vi.InputError, match=r"^gap: the stops have different values of gap, 5 mm and 7.5 mm; "
        ):
            parameter(name, uneven).read(uneven)


def test_a_unit_may_depend_on_an_exponent():
    fluid = RIG.replace(isolator=vi.Isolator(3e4, 100, 0.5), right=HERTZ)
    assert parameter("isolator.damping", fluid).units == "N (s/m)^0.5"
    assert parameter("isolator.damping", RIG).units == "N s m-1"
    assert parameter("right.stiffness", fluid).units == "N/m^1.5"
    assert parameter("left.stiffness", fluid).units == "N m-1"
    (one,) = read_ranges({"right.stiffness": ("1 GN/m^1.5", "3 GN/m^1.5")}, fluid)
    assert one.ends == (1e9, 3e9)
    mixed = fluid.replace(right=HERTZ.replace(stiffness=fluid.left.stiffness))
    with pytest.raises(vi.InputError, match=r"N/m and N/m\^1\.5; use 'right.stiffness' or"):
        parameter("stops.stiffness", mixed).read(vi.Rig(mixed, SHAKEN))


@pytest.mark.parametrize("name", ["stiffness_ratio", "relaxation_time", "gap_ratio"])
def test_ratios_are_those_of_linear_laws(name):
    bent = RIG.replace(isolator=ISOLATORS["cubic"])
    with pytest.raises(
        vi.InputError, match=r"^isolator: its law, polynomial, is not linear, so it has no"
    ):
        parameter(name, bent).read(vi.Rig(bent, SHAKEN))


@pytest.mark.parametrize("name", ["relaxation_time", "damping_ratio", "stops.right.stiffness"])
def test_a_branch_over_any_of_them_ends_on_the_orbit_of_that_rig(name):
    here = parameter(name, RIG).read(vi.Rig(RIG, SHAKEN))
    branch = vi.branch(vi.Rig(RIG, SHAKEN), vary={name: (0.9 * here, 1.1 * here)})
    last = branch.isel(point=-1)
    assert float(last[name]) == pytest.approx(1.1 * here)
    direct = vi.orbit(parameter(name, RIG).vary(vi.Rig(RIG, SHAKEN), 1.1 * here), last["section"])
    assert float(last["displacement_max"]) == pytest.approx(float(direct["displacement_max"]), 1e-9)


def test_other_values_that_it_may_have():
    gap, restitution = parameter("gap", RIG), parameter("restitution", WALLS)
    assert gap.beside(2.0) == 4.0
    assert gap.beside(0.0) == 1.0
    assert gap.beside(-1.0, 3.0) == -3.0
    assert restitution.beside(0.4) == 0.8
    assert restitution.beside(1.0) == 0.5
    assert restitution.beside(0.0, 6.0) == 1.0


def test_a_gap_ratio_is_over_free_flight_under_what_is_held():
    rig = vi.laboratory.case("B2-G1-A3").oscillator

    def read(shaking):
        return PARAMETERS["gap_ratio"].read(vi.Rig(rig, shaking))

    xi = rig.damping_ratio
    peak = 2e-3 / (2.0 * xi * np.sqrt(1.0 - xi**2))
    assert read(vi.Harmonic("2 mm", "2 Hz")) == pytest.approx(7.5e-3 / peak, rel=1e-12)
    force = vi.Harmonic(0.3 * rig.mass, 2.0, of="force")
    assert read(force) == pytest.approx(read(vi.Harmonic(0.3, 2.0)), rel=1e-12)
    machine = vi.Harmonic(2e-3 * rig.mass, 2.0, of="unbalance")
    assert read(machine) == pytest.approx(7.5e-3 / peak, rel=1e-12)
    with pytest.raises(vi.InputError, match="gap_ratio: gaps are scaled by the peak"):
        read(vi.Periodic(2.0, [0.1, 0.2]))


def test_of_a_bumper_beside_a_wall_the_numbers_are_its_own() -> None:
    rig = vi.Oscillator(
        550.0, vi.Isolator(26.0e3, 1.1e3), vi.Bumper(510.0e3, 900.0, 0.01), vi.RigidStop(0.7, 0.01)
    )
    shaken = vi.Harmonic(0.5, 1.0)
    assert parameter("stops.stiffness", rig).read(vi.Rig(rig, shaken)) == 510.0e3
    assert parameter("restitution", rig).read(vi.Rig(rig, shaken)) == 0.7


def test_a_stiffness_at_restitution_is_that_of_bumpers_made_by_it():
    def wall(stiffness):
        return vi.Bumper.from_restitution(RIG.mass, stiffness, 0.6, "7.5 mm")

    one = parameter("stiffness-at-restitution", RIG)
    begun = RIG.replace(right=wall(5e5), left=None)
    rig = one.vary(vi.Rig(begun, SHAKEN), 8e4).oscillator
    assert rig.right.stiffness == 8e4
    assert rig.right.damping == pytest.approx(wall(8e4).damping, rel=1e-14)


@pytest.mark.parametrize(
    "name",
    ["proportional_stiffness", "stiffness_at_restitution", "stiffness_ratio", "relaxation_time"],
)
@pytest.mark.parametrize("left", [HERTZ, RIG.left, None])
def test_what_sets_the_damping_of_bumpers_refuses_another_law(name, left):
    rig = vi.Rig(RIG.replace(right=HERTZ, left=left), SHAKEN)
    one = parameter(name, rig)
    for use in (one.read, lambda rig: one.vary(rig, 0.3), lambda rig: set_values(rig, {name: 0.3})):
        with pytest.raises(vi.InputError, match=rf"(?=.*'{name}').*power"):
            use(rig)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ({"stops.damping": 700.0}, {"stiffness_at_restitution": 8e4}),
        ({"stops.damping": 700.0}, {"stiffness_ratio": 5.0}),
        ({"mass": 1000.0}, {"isolator_period": 2.5}),
        ({"weight": "10 kN", "isolator_period": 2.5}, {"damping_ratio": 0.1}),
        ({"gap_ratio": 0.4}, {"damping_ratio": 0.1, "amplitude": 0.7}),
        ({"relaxation_time": 0.2}, {"stops.stiffness": 4e5, "isolator_period": 2.5}),
    ],
)
def test_values_set_together_are_had_in_either_order(first, second):
    rig = vi.Rig(RIG, SHAKEN)
    made = set_values(rig, {**first, **second})
    assert set_values(rig, {**second, **first}) == made
    for name, value in {**first, **second}.items():
        if name != "weight":
            assert parameter(name, made).read(made) == pytest.approx(value, rel=1e-14)
    if "damping_ratio" not in second and "isolator_period" in second:
        assert made.oscillator.damping_ratio == pytest.approx(RIG.damping_ratio, rel=1e-14)


def test_fields_are_set_at_once_so_that_none_of_them_is_refused_for_another():
    rig = vi.Rig(RIG.replace(isolator=vi.BilinearIsolator(2e5, 1e5, 100, 0)))
    values = {"isolator.post_yield_stiffness": 3e5, "isolator.elastic_stiffness": 6e5}
    assert set_values(rig, values).oscillator.isolator == vi.BilinearIsolator(6e5, 3e5, 100, 0)


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"right.gap": 1.0, "stops.right.gap": 2.0}, "'stops.right.gap' is given twice"),
        ({"left": None, "left.gap": 1.0}, "left.gap: left is set, too"),
        ({"damping_ratio": 0.1, "isolator.damping": 1.0}, "set the same quantity; remove one"),
    ],
)
def test_values_that_contradict_each_other(values, says):
    with pytest.raises(vi.InputError, match=says):
        set_values(vi.Rig(RIG), values)


@pytest.mark.parametrize(
    ("symbol", "name"),
    [
        ("omega", "'frequency'"),
        ("ω", "'frequency'"),
        ("F0", "'amplitude'"),
        ("A", "'amplitude'"),
        ("force_amplitude", "'amplitude'"),
        ("k", "'stops.stiffness'"),
        ("xi", "'damping_ratio'"),
        ("delta0", "'gap_ratio'"),
        ("λ", "'stiffness_ratio'"),
        ("e", "'stops.restitution'"),
    ],
)
def test_a_symbol_leads_to_its_parameter(symbol, name):
    with pytest.raises(InputError) as caught:
        parameter(symbol, RIG)
    assert str(caught.value).startswith(f"parameter: {symbol!r} is not a name of a parameter; use")
    assert name in str(caught.value)
    assert name.strip("'") in PARAMETERS


def test_a_wrong_parameter_is_reported_before_a_missing_frequency():
    rig = vi.Rig(vi.laboratory.case("B2-G1-A3").oscillator, "0.05 g")
    for call in (
        lambda: vi.bifurcation_diagram(rig, {"omega": (1, 2)}),
        lambda: vi.branch(rig, vary={"omega": (1, 2)}),
        lambda: vi.basin_stability(rig, vary={"omega": [1, 2]}),
        lambda: vi.bifurcation_curve(rig, None, vary={"gap": (1, 2), "omega": (1, 2)}),
    ):
        with pytest.raises(InputError, match=r"^vary: 'omega' is not a name"):
            call()


@pytest.mark.parametrize("side", ["right", "left"])
def test_names_of_a_rig_with_one_stop_name_this_stop(side) -> None:
    both = vi.laboratory.case("B2-G1-A3").oscillator
    rig = both.replace(**{"left" if side == "right" else "right": None})
    rigid = rig.replace(**{side: WALLS.right})
    for name, words in (
        ("gap", f"gap of the {side} side"),
        ("stops.stiffness", f"stiffness of the {side} bumper"),
        ("proportional_stiffness", f"stiffness of the {side} bumper, with damping in proportion"),
        ("stiffness_ratio", f"stiffness ratio of the {side} bumper"),
        ("relaxation_time", f"relaxation time of the {side} bumper"),
        ("damping_ratio", "damping ratio of the isolator"),
        (f"{side}.gap", f"gap of the {side} side"),
    ):
        assert parameter(name, rig).long_name == words
    assert parameter("restitution", rigid).long_name == f"restitution of the {side} stop"
    assert parameter("stops.stiffness", both).long_name == "stiffness of both bumpers"
