"""Rigs without units: how they are recognised, what they keep, and how their values are written."""

from __future__ import annotations

import contextvars
import math
import re

import pytest

import vibroimpact as vi
from vibroimpact.errors import InputError
from vibroimpact.model.frequency_text import forcings
from vibroimpact.model.quantities import ANGLE, FREQUENCY, LENGTH, fitting
from vibroimpact.model.stated_units import has_unit
from vibroimpact.model.study import read_rig_study
from vibroimpact.model.units import pretty, with_si_unit
from vibroimpact.model.written_units import has_no_units, unitless, write_for, written_for

SOFT = vi.Isolator(1.0, 0.1)


@pytest.mark.parametrize(
    ("oscillator", "units"),
    [
        (vi.Oscillator(1, SOFT), "none"),
        (vi.Oscillator("1", SOFT), "none"),
        (vi.Oscillator("1 kg", SOFT), "SI"),
        (vi.Oscillator(2, SOFT), "SI"),
        (vi.Oscillator(1, vi.Isolator(2.0, 0.1)), "SI"),
        (vi.Oscillator(2, SOFT, units="none"), "none"),
        (vi.Oscillator(1, SOFT, units="SI"), "SI"),
        (vi.Oscillator(1, vi.FrictionIsolator(1.0, 0.1, 0.2)), "none"),
        (vi.from_dimensionless(20.0, 0.5, 0.01, 0.15).oscillator, "none"),
        (vi.from_dimensionless(20.0, 0.5, 0.01, 0.15, amplitude="1 m/s^2").oscillator, "SI"),
        (vi.from_dimensionless(20.0, 0.5, 0.01, 0.15, mass=550, stiffness=3e4).oscillator, "SI"),
        (vi.laboratory.case("B2-G1-A3").oscillator, "SI"),
    ],
)
def test_a_mass_and_a_stiffness_of_1_without_a_stated_unit_have_none(oscillator, units):
    assert oscillator.units == units
    assert has_no_units(oscillator) == (units == "none")


def table(**changes):
    return {"mass": 1, "isolator": {"stiffness": 1, "damping": 0.1}, **changes}


@pytest.mark.parametrize(
    ("changes", "units"),
    [
        ({}, "none"),
        ({"right": {"stiffness": 20, "damping": 0, "gap": "2 m"}}, "SI"),
        ({"isolator": {"stiffness": "1 N/m", "damping": 0.1}}, "SI"),
        ({"isolator": {"kind": "friction", "stiffness": 1, "damping": 0, "friction": 2}}, "none"),
        ({"right": {"stiffness": 20, "restitution": "50 %", "gap": 2}}, "none"),
    ],
)
def test_a_unit_anywhere_in_a_table_counts(changes, units):
    assert vi.Oscillator.model_validate(table(**changes)).units == units


def test_a_change_keeps_the_units():
    assert vi.Oscillator(1, SOFT).replace(mass=3).units == "none"
    assert vi.Oscillator("1 kg", SOFT).replace(mass=1.0).units == "SI"
    assert vi.Oscillator(3, SOFT).replace(mass=1.0).units == "SI"


@pytest.mark.parametrize(
    "oscillator",
    [
        vi.Oscillator(1, SOFT),
        vi.Oscillator("1 kg", SOFT),
        vi.Oscillator(2, SOFT, units="none"),
        vi.Oscillator(2, SOFT),
    ],
)
def test_units_survive_a_file_and_a_repr(oscillator):
    assert vi.Oscillator.model_validate(oscillator.model_dump()) == oscillator
    assert eval(repr(oscillator), vars(vi).copy()) == oscillator


def test_usual_rigs_say_nothing_about_units():
    assert "units" not in vi.Oscillator(2, SOFT).model_dump()
    assert "units" not in repr(vi.Oscillator(2, SOFT))


def test_the_unit_of_the_shaking_counts():
    assert vi.Rig(vi.Oscillator(1, SOFT), 1.0).oscillator.units == "none"
    assert vi.Rig(vi.Oscillator(1, SOFT), "0.05 g").oscillator.units == "SI"
    assert vi.Rig(vi.Oscillator(1, SOFT), [0.1, 0.2]).oscillator.units == "none"
    assert vi.Rig(vi.Oscillator(1, SOFT), ["1 mm", "2 mm"]).oscillator.units == "SI"
    assert vi.Rig(vi.Oscillator(1, SOFT), vi.Record([0, 1, 0], 0.1)).oscillator.units == "none"


def test_a_unit_contradicts_a_rig_without_units():
    with pytest.raises(InputError, match=r"^mass: '2 kg' has a unit, but units is \"none\"; pass"):
        vi.Oscillator("2 kg", SOFT, units="none")
    with pytest.raises(InputError, match=r"^shaking: '1 mm' has a unit, but the rig has none"):
        vi.Rig(vi.Oscillator(2, SOFT, units="none"), "1 mm")


def test_unknown_units_are_refused():
    with pytest.raises(InputError, match=r"^units: 'cgs' is unknown; use 'SI' or 'none'$"):
        vi.Oscillator(1, SOFT, units="cgs")


STUDY = """
[oscillator]
mass = 1
isolator = {{ stiffness = 1, damping = 0.1 }}
right = {{ stiffness = 20, damping = 0, gap = 2 }}
{units}
[excitation]
amplitude = {amplitude}
"""


@pytest.mark.parametrize(
    ("units", "amplitude", "expected"),
    [("", "0.5", "none"), ("", '"0.5 m/s^2"', "SI"), ('units = "SI"', "0.5", "SI")],
)
def test_units_of_a_study(tmp_path, units, amplitude, expected):
    path = tmp_path / "one.toml"
    path.write_text(STUDY.format(units=units, amplitude=amplitude))
    assert read_rig_study(path).oscillator.units == expected


def test_values_are_written_without_units_within_the_context_alone():
    rig = vi.Rig(vi.Oscillator(1, SOFT, vi.Bumper(20.0, 0.0, 7.0)), 0.5)
    with written_for(rig):
        assert pretty(0.007, LENGTH) == "0.007"
        assert with_si_unit(7.0, LENGTH) == "7"
        assert pretty(1.0, ANGLE) == "1 rad"
        assert pretty(0.5 / math.pi, FREQUENCY) == "ω = 1"
        assert forcings(0.5 / math.pi, 1.0 / math.pi) == "ω = 1 to 2"
        assert fitting([2.0], FREQUENCY.scales) == (0.0, 1.0 / math.tau, "")
        assert fitting([2e3], LENGTH.scales) == (0.0, 1.0, "")
        with written_for(vi.Rig(vi.Oscillator(2, SOFT), 0.5)):
            assert pretty(0.007, LENGTH) == "7 mm"
        assert unitless()
    assert pretty(0.007, LENGTH) == "7 mm"
    assert forcings(0.5, 0.5) == "0.5 Hz"


def test_several_rigs_are_written_without_units_only_if_none_has_any():
    bare, full = vi.Oscillator(1, SOFT), vi.Oscillator(2, SOFT)
    for subjects, expected in (((bare, bare), True), ((bare, full), False), ((), False)):
        with written_for(*subjects):
            assert unitless() == expected
    assert has_no_units({"one": bare, "two": {"three": bare}})
    assert not has_no_units({"one": bare, "two": full})


def test_a_choice_to_the_end_of_a_context():
    def inside():
        write_for(vi.Oscillator(1, SOFT))
        return unitless()

    assert contextvars.copy_context().run(inside)
    assert not unitless()


def test_a_rig_shows_its_numbers_as_they_are():
    rig = vi.Rig(vi.Oscillator(1, SOFT, vi.Bumper(20.0, 0.0, 7.0)), vi.Harmonic(0.5, 1.0))
    for text in (str(rig), str(rig.oscillator), rig._repr_html_(), rig.oscillator._repr_html_()):
        assert "gap" in text
        assert not re.search(r"\d (?:m|kg|g|N|Hz)\b", text)
    assert "angular_frequency=6.28319" in str(rig)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        *((value, True) for value in ("5 mm", "0.05 g", "2 s")),
        *((value, False) for value in ("5 %", "90 deg", "7", 7.0, "k*u", "linear", None)),
    ],
)
def test_what_states_a_unit(value, expected):
    assert has_unit(value) == expected


def test_results_record_that_there_are_no_units(tmp_path):
    rig = vi.Rig(vi.Oscillator(1, SOFT, vi.Bumper(20.0, 0.0, 2.0)), 0.5)
    data = vi.sweep(rig, [0.15, 0.16])
    assert data.attrs["unit_system"] == "none"
    assert {data[name].attrs["units"] for name in data.variables} == {"1"}
    assert data["frequency"].values.tolist() == [0.15, 0.16]
    path = tmp_path / "swept.nc"
    vi.save(data, path)
    assert has_no_units(vi.load(path))
    usual = vi.sweep(rig.with_parts(rig.oscillator.replace(units="SI")), [0.15, 0.16])
    assert "unit_system" not in usual.attrs
    assert usual["displacement_max"].attrs["units"] == "m"
    assert usual["displacement_max"].values.tolist() == data["displacement_max"].values.tolist()


@pytest.mark.parametrize("value", ["5 mm", "0.05 g", ["1 mm", "2 mm"]])
def test_stated_none_is_kept_for_a_mass_and_a_stiffness_of_1(value):
    stated = vi.Oscillator(1, SOFT, units="none")
    for oscillator in (stated, stated.replace(right=vi.Bumper(20.0, 0.0, 2.0))):
        with pytest.raises(InputError, match=r"^shaking: .* has a unit, but the rig has none"):
            vi.Rig(oscillator, value)
    recognised = vi.Oscillator(1, SOFT).replace(right=vi.Bumper(20.0, 0.0, 2.0))
    assert vi.Rig(recognised, value).oscillator.units == "SI"


def test_a_record_with_a_unit_needs_a_rig_with_units(tmp_path):
    path = tmp_path / "shake.txt"
    path.write_text("".join(f"{0.01 * n} {0.1 * (n % 5 - 2)}\n" for n in range(50)))
    record = vi.Record.read(path, unit="g")
    stated = vi.Oscillator(1, SOFT, vi.Bumper(20.0, 0.0, 2.0), units="none")
    assert vi.Rig(vi.Oscillator(1, SOFT), record).oscillator.units == "SI"
    assert vi.Rig(stated, vi.Record(record.acceleration, 0.01)).oscillator.units == "none"
    for call in (
        lambda: vi.Rig(stated, record),
        lambda: vi.demands(stated, record),
        lambda: vi.required_gap(stated, records=record),
        lambda: vi.design_chart(stated, {"gap": [1, 2]}, records=record),
    ):
        with pytest.raises(InputError, match=r"contains accelerations in g, but the rig has no"):
            call()
    bare = vi.Record.read(path, unit="none")
    assert bare.acceleration.tolist() == pytest.approx((record.acceleration / 9.80665).tolist())
    assert vi.Rig(stated, bare).oscillator.units == "none"
    assert vi.Rig(vi.Oscillator(1, SOFT), bare).oscillator.units == "none"
    with pytest.raises(InputError, match=r"was read without a unit, but the rig has units"):
        vi.Rig(vi.Oscillator(2, SOFT), bare)
    for call in (
        lambda: vi.demands(stated, [vi.Record([0, 1, 0], 0.1)], vary={"gap": ["5 mm", "6 mm"]}),
        lambda: vi.demands(stated, [vi.Record([0, 1, 0], 0.1)], ["0.1 g"], intensity="pga"),
        lambda: vi.design_chart(vi.Rig(stated, 0.5), {"gap": ["5 mm", "6 mm"]}),
    ):
        with pytest.raises(InputError, match=r"^(vary\['gap'\]|scales): .* has a unit, but"):
            call()
    assert "unit_system" not in vi.demands(vi.Oscillator(1, SOFT), record).attrs


def test_a_study_that_states_none_refuses_a_unit(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text(STUDY.format(units='units = "none"', amplitude='"5 mm"'))
    with pytest.raises(InputError, match=r"excitation.amplitude: '5 mm' has a unit, but the rig"):
        read_rig_study(path)
