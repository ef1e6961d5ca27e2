"""What was found, as plain values and in words: the same for command line, page and reports."""

import json
import math

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.facts import largest, motions, scenario, sweeps
from vibroimpact.facts.tables import Column, Row, as_text, sheet, sheet_of, table_of
from vibroimpact.response.resonance import features
from vibroimpact.scenarios.scenario import Scenario


@pytest.fixture(scope="module")
def swept():
    return vi.sweep("B2-G1-A3", np.round(np.arange(0.5, 3.51, 0.1), 10))


def test_the_largest_is_that_of_the_sweep_and_where(swept):
    facts = largest.facts(swept)
    one = facts["peak_acceleration"]
    assert one["value"] == float(swept.peak_acceleration.max())
    there = swept.sel(frequency=one["frequency"], direction=one["direction"])
    assert float(there.peak_acceleration) == one["value"]
    assert facts["displacement_min"]["value"] == float(swept.displacement_min.min())
    assert not any(name.startswith("peak_impulse") for name in facts)  # no stop is rigid


def test_the_largest_of_a_rig_that_touches_nothing_has_no_force():
    facts = largest.facts(vi.sweep("B2-G1-A3", [4.5], "backward"))
    assert set(facts) == {"displacement_max", "displacement_min", "peak_acceleration"}


def test_equal_sweeps_name_the_forward_one():
    data = vi.sweep("B2-G1-A3", [3.0, 3.2])
    assert {one["direction"] for one in largest.facts(data).values()} == {"forward"}


def test_a_sweep_is_told_in_plain_values_and_in_the_same_words(swept):
    traits = features(swept)
    facts = sweeps.facts(swept, traits, ["look closer"])
    assert json.loads(json.dumps(facts))["largest"] == facts["largest"]  # plain numbers and texts
    assert facts["frequencies"] == {"from": 0.5, "to": 3.5, "count": 31}
    text = as_text(sweeps.text(swept, traits, ["look closer"]))
    assert "31 frequencies from 0.5 to 3.5 Hz, forward and backward" in text
    for jump in facts["jumps"]:
        low, high = jump["before"], jump["after"]
        assert f"{low:g} and {high:g}" in text
    (hysteresis,) = facts["hysteresis"]
    assert f"{hysteresis['low']:g} to {hysteresis['high']:g} Hz: right" in text
    assert "Advice: look closer" in text


def test_rigid_stops_are_called_stops():
    """A bumper deforms; where one of the two stops is rigid, both are stops."""
    bumper = vi.Bumper("100 kN/m", "1 kN s/m", "5 mm")
    isolator = vi.Isolator("26 kN/m", "1 kN s/m")

    def words(right, left):
        rig = vi.Rig(vi.Oscillator("550 kg", isolator, right, left), "0.05 g")
        data = vi.sweep(rig, [1.0, 1.1])
        motion = vi.steady(rig, frequency=1.1)
        both = sweeps.text(data, features(data), []), motions.text({1.1: {"motion": motion}})
        return " ".join("".join(as_text(one) for one in both).split())

    for stops in ((vi.RigidStop(0.6, "5 mm"), None), (bumper, vi.RigidStop(0.6, "5 mm"))):
        text = words(*stops)
        assert "Contact with a stop" in text
        assert "of it lost in the stops" in text
        assert "umper" not in text
    text = words(bumper, bumper)
    assert "Contact with a bumper" in text
    assert "of it lost in the bumpers" in text


def test_one_direction_has_no_hysteresis_to_seek():
    data = vi.sweep("B2-G1-A3", [1.0, 1.2], "forward")
    text = as_text(sweeps.text(data, features(data), []))
    assert "2 frequencies from 1 to 1.2 Hz, forward" in text
    assert "not computed, because it needs both sweep directions" in text


def test_each_scenario_has_a_meaning():
    meanings = [scenario.meaning(one.label) for one in Scenario]
    assert all(meanings)
    assert len(set(meanings)) == len(meanings)
    with pytest.raises(StopIteration):
        scenario.meaning("S9")


def test_tables_as_text_have_no_marks_of_a_terminal():
    table = sheet([("gap", "7.5 mm", "of both sides")])
    assert as_text(table).split() == ["gap", "7.5", "mm", "of", "both", "sides"]
    columns = (Column("sweep", "direction", left=True), Column("η_a", "ends", left=True))
    titled = table_of([{"direction": "forward", "ends": "1 → 2"}], columns, "Jumps")
    lines = as_text(titled, width=40).splitlines()
    assert lines[0].strip() == "Jumps"
    assert "\x1b" not in "".join(lines)
    assert all(line == line.rstrip() for line in lines)


def test_a_sheet_of_declared_rows():
    """Of both sides, in one unit that fits all values of a row, unless others choose it."""
    data = xr.Dataset(
        {"peak_force": ("stop", [2e3]), "displacement_min": -1e-3, "displacement_max": 2.0},
        {"stop": ["left"]},
    )
    ends = ("displacement_min", "displacement_max")
    rows = (
        Row("force", "peak_force", words="{} at most", remark=lambda whole: f"of {whole}"),
        Row("range", ends, 3),
        Row("lowest", ends[0], like=ends),
        Row("absent", "peak_acceleration", applies=lambda whole: whole == "another"),
        Row("own", lambda whole: whole, of=("eccentricity",)),
    )
    assert [line.rstrip() for line in as_text(sheet_of(data, rows, "one")).splitlines()] == [
        "force     0 kN right, 2 kN left at most    of one",
        "range     -0.001 to 2 m",
        "lowest    -0.001 m",
        "own       one",
    ]
    assert [row.variables for row in rows[1:]] == [
        ends,
        ends[:1],
        ("peak_acceleration",),
        ("eccentricity",),
    ]


def test_another_number_of_a_motion_is_written_without_an_entry():
    plain = vi.steady("B2-G1-A3", frequency=2.0)
    data = plain.assign(peak_force=("stop", [1.5e3, math.inf]), peak_transmitted_force=250.0)
    (table,) = motions.facts({2.0: {"one": data}})
    assert table["peak_force"] == {"right": 1500.0, "left": math.inf}
    assert table["peak_transmitted_force"] == 250.0
    lines = as_text(motions.text({2.0: {"one": data}})).splitlines()
    row = next(line for line in lines if line.startswith("peak force"))
    assert row.split(maxsplit=2)[2].rstrip() == "1.5 kN right, infinite left"
    assert any(line.split() == ["peak", "transmitted", "force", "250", "N"] for line in lines)
    before = as_text(motions.text({2.0: {"one": plain}})).splitlines()
    assert len(lines) == len(before) + 2
