"""Options replace values of a case or a study."""

from __future__ import annotations

import pytest

import vibroimpact as vi
from vibroimpact.cli import rig as command
from vibroimpact.cli.options import RigOptions
from vibroimpact.cli.rig import subject

CASE = vi.laboratory.case("B2-G1-A3").oscillator


def changed(oscillator, options):
    """The oscillator with the values of these options."""
    return command.changed(oscillator, command.stated(options))


def test_a_case():
    what = subject("b2-g1-a3", RigOptions())
    case = vi.laboratory.case("B2-G1-A3")
    assert what[:4] == ("B2-G1-A3", "B2-G1-A3", case.oscillator, vi.Harmonic(case.amplitude, 1.0))
    assert subject("510kN/m-G1-0.05g", RigOptions())[:2] == (
        "510kN/m-G1-0.05g",
        "510kN_m-G1-0.05g",
    )


@pytest.mark.parametrize("which", ["identified", "refined"])
def test_parameter_sets(which):
    what = subject("B2-G1-A3", RigOptions(parameters=which))
    assert what.oscillator == vi.laboratory.case("B2-G1-A3", which).oscillator
    assert what.name == f"B2-G1-A3, {which} parameters"
    assert what.slug == f"B2-G1-A3-{which}"


def test_name():
    assert subject("B2-G1-A3", RigOptions(), "my/rig 1")[:2] == (
        "B2-G1-A3",
        "my_rig_1-89515662",
    )
    assert subject("B2-G1-A3", RigOptions(), "../..").slug == "rig-0cfd1c96"


def test_every_option_replaces_its_value_and_nothing_else():
    for options, expected in [
        (RigOptions(values=("mass=600kg",)), CASE.replace(mass=600.0)),
        (
            RigOptions(values=("isolator.stiffness=20 kN/m",)),
            CASE.replace(isolator=CASE.isolator.replace(stiffness=20e3)),
        ),
        (
            RigOptions(values=("isolator.damping=1 kN s/m",)),
            CASE.replace(isolator=CASE.isolator.replace(damping=1e3)),
        ),
        (RigOptions(values=("right.gap=1mm",)), CASE.replace(right=CASE.right.replace(gap=1e-3))),
        (RigOptions(values=("left.damping=0",)), CASE.replace(left=CASE.left.replace(damping=0.0))),
        (
            RigOptions(values=("stops.left.stiffness=1MN/m",)),
            CASE.replace(left=CASE.left.replace(stiffness=1e6)),
        ),
        (RigOptions(values=("left=none",)), CASE.replace(left=None)),
        (RigOptions(values=("left=none", "stops.right=none")), CASE.without_bumpers()),
    ]:
        assert changed(CASE, options) == expected
    assert changed(CASE, RigOptions()) == CASE


def test_options_of_both_sides():
    both = changed(CASE, RigOptions(gap="9mm", values=("stops.stiffness=1MN/m", "stops.damping=5")))
    assert both.right == both.left == vi.Bumper(1e6, 5.0, 9e-3)
    # One side's option comes before that of both.
    assert changed(CASE, RigOptions(gap="9mm", values=("left.gap=3mm",))).left.gap == 3e-3
    # They change what is there, and make no bumper beside it.
    one_sided = CASE.replace(left=None)
    assert changed(one_sided, RigOptions(gap="9mm")).left is None
    assert changed(CASE, RigOptions(gap="9mm", values=("right=none",))).right is None


def test_new_bumpers_need_all_three_values():
    free = CASE.without_bumpers()
    made = changed(free, RigOptions(gap="9mm", values=("stops.stiffness=1MN/m", "stops.damping=5")))
    assert made.right == made.left == vi.Bumper(1e6, 5.0, 9e-3)
    values = ("left.gap=9mm", "left.stiffness=1MN/m", "left.damping=5")
    made = changed(free, RigOptions(values=values))
    assert (made.right, made.left) == (None, vi.Bumper(1e6, 5.0, 9e-3))
    with pytest.raises(vi.InputError, match=r"--set: right\.stiffness: missing"):
        changed(free, RigOptions(gap="9mm"))
    with pytest.raises(vi.InputError, match=r"--set: left\.damping: missing"):
        changed(CASE.replace(left=None), RigOptions(values=("left.gap=9mm", "left.stiffness=5")))


WALL = vi.RigidStop(0.8, 0.01)


def test_options_of_bumpers_pass_rigid_stops_by():
    mixed = CASE.replace(left=WALL)
    made = changed(mixed, RigOptions(gap="-9mm", values=("stops.stiffness=1MN/m",)))
    assert made.left == WALL.replace(gap=-9e-3)
    assert made.right == CASE.right.replace(gap=-9e-3, stiffness=1e6)
    assert changed(mixed, RigOptions(values=("left.gap=3mm",))).left.gap == 3e-3


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("stops.damping=5", "--set: 'stops.damping' is not a parameter of this rig; "),
        ("left.stiffness=5", "--set: 'left.stiffness' is not a parameter of this rig; "),
    ],
)
def test_rigid_stops_have_no_stiffness(options, message):
    walls = CASE.replace(right=WALL, left=WALL)
    with pytest.raises(vi.InputError, match=message):
        changed(walls, RigOptions(values=(options,)))


def test_gravity():
    assert subject("B2-G1-A3", RigOptions(amplitude="0.04 g")).repeated.amplitude == 0.392266


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"mass": "-5kg"}, "--set: mass: '-5kg' is not greater than 0"),
        ({"mass": "5m"}, "--set: mass: '5m' is a length; use a mass"),
        ({"isolator.stiffness": "nan"}, "--set: isolator.stiffness: 'nan' is not finite"),
        ({"isolator.damping": "-1"}, "--set: isolator.damping: '-1' is less than 0"),
        ({"gap": "15 kg"}, "gap: '15 kg' is a mass; use a length"),
        ({"stops.right.damping": "-1"}, "--set: right.damping: '-1' is less than 0"),
        ({"stops.stiffness": "0"}, "--set: right.stiffness: '0' is not greater than 0"),
        ({"amplitude": "0g"}, "--amplitude: 0; set it in the study, or pass"),
        ({"amplitude": "5 kg"}, "--amplitude: '5 kg' is a mass"),
        (
            {"left.gap": "1mm", "left": "none"},
            "--set: left.gap: left is set, too; remove one of the two",
        ),
        ({"nothing": "1"}, "--set: 'nothing' is unknown; use frequency, .*isolator.stiffness"),
        ({"stiffness": "1"}, "--set: 'stiffness' is not a path; use 'isolator.stiffness' or"),
        ({"frequency": "1Hz"}, "use --frequency"),
        ({"right.gap": ""}, "pass PATH=VALUE in one word, such as gap=9mm"),
    ],
)
def test_what_cannot_be_used(options, message):
    with pytest.raises(vi.InputError, match=message):
        subject("B2-G1-A3", of(**options))


def of(gap=None, amplitude=None, **values):
    """Options with these values."""
    return RigOptions(
        gap=gap, amplitude=amplitude, values=tuple(f"{k}={v}" for k, v in values.items())
    )


HERTZ = vi.PowerBumper("2 GN/m^1.5", "7.5 mm", dissipation=0.4)


def test_options_are_read_by_the_laws_of_the_rig():
    fluid = vi.Oscillator(550, vi.Isolator(3e4, 1e3, 0.5), HERTZ, CASE.left)
    made = changed(
        fluid, of(**{"isolator.damping": "2 kN (s/m)^0.5", "right.stiffness": "3 GN/m^1.5"})
    )
    assert made.isolator == fluid.isolator.replace(damping=2e3)
    assert made.right == HERTZ.replace(stiffness=3e9)
    with pytest.raises(
        vi.InputError, match=r"damping: '2 kN s/m' is a damping; use a damping in N"
    ):
        changed(fluid, of(**{"isolator.damping": "2 kN s/m"}))
    with pytest.raises(vi.InputError, match=r"--set: stops.stiffness: the stops have different un"):
        changed(fluid, of(**{"stops.stiffness": "1 MN/m"}))
    assert changed(fluid, of(**{"stops.damping": "5"})).right == HERTZ
    assert changed(fluid, of(**{"stops.damping": "5"})).left.damping == 5.0
    yielding = CASE.replace(isolator=vi.BilinearIsolator(1e5, 3e4, 400, 0))
    with pytest.raises(vi.InputError, match=r"is not a parameter of this rig; .*elastic_stiffness"):
        changed(yielding, of(**{"isolator.stiffness": "3"}))


def test_an_exponent_does_not_change_the_meaning_of_another_number():
    fluid = vi.Oscillator(550, vi.Isolator(3e4, 1e3, 0.5), HERTZ, CASE.left)
    before = HERTZ.stiffness
    with pytest.raises(
        vi.InputError,
        match=r"^--set: stops\.right\.stiffness: the other exponent would turn .*N/m\^1\.5 into "
        r".*N/m\^2\.5; set it, too$",
    ):
        changed(fluid, of(**{"right.exponent": "2.5"}))
    with pytest.raises(
        vi.InputError, match=r"^--set: isolator\.damping: .* \(s/m\)\^0\.5 into 1 kN s"
    ):
        changed(fluid, of(damping_exponent="1"))
    for path, value in (("right.stiffness", "2 MN/m^2.5"), ("stops.right.stiffness", str(before))):
        made = changed(fluid, of(**{"right.exponent": "2.5", path: value}))
        assert made.right.exponent == 2.5
    free = fluid.replace(isolator=vi.Isolator(3e4, 0, 0.5))
    assert changed(free, of(damping_exponent="1")).isolator == vi.Isolator(3e4, 0)
    assert changed(fluid, of(**{"right.exponent": "1.5"})) == fluid
    assert changed(fluid, of(isolator="none")).isolator.damping == 0.0
    bare = vi.Oscillator(1, vi.Isolator(1, 1, 0.5), units="none")
    assert changed(bare, of(damping_exponent="2")).isolator.damping_exponent == 2.0


STUDY = """
[oscillator]
mass = "550 kg"
isolator = {{ {isolator} }}
right = {{ kind = "power", stiffness = "2 GN/m^1.5", gap = "7.5 mm", restitution = 0.6 }}

[excitation]
amplitude = "0.05 g"
"""


@pytest.mark.parametrize(
    ("isolator", "law"),
    [
        (
            'kind = "friction", stiffness = 3e4, damping = 0, friction = "120 N"',
            vi.FrictionIsolator(3e4, 0, 120),
        ),
        (
            'kind = "bouc-wen", elastic_stiffness = 1e5, post_yield_stiffness = 3e4, '
            'yield_force = "400 N", damping = 5, exponent = 2',
            vi.BoucWenIsolator(1e5, 3e4, 400, 5, 2),
        ),
        (
            'stiffness = 3e4, damping = "3 kN (s/m)^0.5", damping_exponent = 0.5',
            vi.Isolator(3e4, 3e3, 0.5),
        ),
    ],
)
def test_a_study_may_name_any_law(isolator, law, tmp_path):
    from vibroimpact.cli.study import read_study

    path = tmp_path / "rig.toml"
    path.write_text(STUDY.format(isolator=isolator), encoding="utf-8")
    rig = read_study(path).oscillator
    assert rig == vi.Oscillator(550, law, HERTZ.replace(dissipation=None, restitution=0.6))
    path.write_text(STUDY.format(isolator=f"{isolator}, colour = 1"), encoding="utf-8")
    with pytest.raises(vi.InputError, match=r"oscillator\.isolator\.colour: unknown key; "):
        read_study(path)


def test_a_law_is_told_with_all_its_numbers():
    assert vi.FrictionIsolator(3e4, 0, 120).summary() == (
        "friction, stiffness 30 kN/m, damping 0 N s/m, friction 120 N"
    )
    assert HERTZ.summary() == (
        "power, stiffness 2000 MN/m^1.5, gap 7.5 mm, exponent 1.5, dissipation 0.4 s/m"
    )


def test_a_period_and_a_damping_ratio_stand_for_stiffness_and_damping():
    made = changed(CASE, of(mass="5000t", isolator_period="2.5s", damping_ratio="15 %"))
    assert made.isolator == vi.Isolator.from_period("5000 t", 2.5, 0.15)
    # A period alone keeps the damping ratio, whatever becomes of the mass.
    kept = changed(CASE, of(mass="5000t", isolator_period="2.5s"))
    assert kept.damping_ratio == pytest.approx(CASE.damping_ratio, rel=1e-14)
    assert 1.0 / kept.natural_frequency == pytest.approx(2.5, rel=1e-14)
    # Beside the other two, each sets its own.
    assert (
        changed(CASE, of(**{"isolator_period": "2s", "isolator.damping": "5"})).isolator.damping
        == 5.0
    )
    stiff = changed(CASE, of(**{"isolator.stiffness": "20kN/m", "damping_ratio": "0.1"}))
    assert (stiff.isolator.stiffness, round(stiff.damping_ratio, 14)) == (20e3, 0.1)
    damped = changed(CASE, of(damping_ratio="0.1"))
    assert damped.isolator.stiffness == CASE.isolator.stiffness


def test_a_weight_stands_for_a_mass():
    assert changed(CASE, of(weight="9806.65 N")).mass == 1000.0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"isolator_period": "2s", "isolator.stiffness": "1"},
            "--set: isolator_period and isolator.stiffness set the same quantity",
        ),
        (
            {"damping_ratio": "0.1", "isolator.damping": "1"},
            "--set: damping_ratio and isolator.damping set the same quantity; remove one",
        ),
        (
            {"weight": "1 N", "mass": "1"},
            "--set: weight and mass set the same quantity; remove one of the two",
        ),
        ({"isolator_period": "2 Hz"}, "--set: isolator_period: '2 Hz' is a frequency; use a time"),
        ({"damping_ratio": "-1"}, "--set: damping_ratio: '-1' is less than 0"),
        ({"weight": "5 t"}, "--set: weight: '5 t' is a mass; use a force greater than 0"),
        (
            {"mass": "5000g"},
            "--set: mass: '5000g' has a g, which is gravity here; write gram, kg or t",
        ),
        ({"mass": "50MN"}, "--set: mass: '50MN' is a force, the weight of 5098.58 t; use a mass"),
    ],
)
def test_two_ways_at_once_are_refused(options, message):
    with pytest.raises(vi.InputError) as caught:
        changed(CASE, of(**options))
    assert str(caught.value).startswith(message)


def test_a_yielding_isolator_has_no_one_period():
    yielding = CASE.replace(isolator=vi.BilinearIsolator(2e5, 1e5, 100, 0))
    with pytest.raises(vi.InputError, match="--set: 'isolator_period' sets the stiffness"):
        changed(yielding, of(isolator_period="2s"))
