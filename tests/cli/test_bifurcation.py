"""``vibroimpact bifurcation`` from the words typed to the files written."""

from __future__ import annotations

import json

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.facts import bifurcation_diagram as facts
from vibroimpact.facts.tables import as_text
from vibroimpact.stability.bifurcation_diagram import CREATED_BY

COMMAND = "bifurcation"
GAPS = ("B3-10mm-A3", "--vary", "gap=4.8mm:5mm:5")


def test_over_the_gap(tmp_path, run_in):
    code, out, errors = run_in(
        tmp_path, *GAPS, *("--frequency", "1.12Hz", "--random", "1", "--branches")
    )
    assert (code, errors) == (0, "")
    lines = [line.rstrip() for line in out.splitlines()]
    for line in ("Up", "Down", "Random 1", "Files", "  out/B3-10mm-A3-1.12Hz-gap-diagram.png"):
        assert lines.count(line) == 1
    (base,) = [line for line in lines if line.startswith("base ")]
    assert base.endswith("at 1.12 Hz")
    ranges = [line.split() for line in lines]
    expected = ["periodic,", "period", "2", "4R", "2L", "4.85", "to", "4.9", "2"]
    assert expected in [words[:9] for words in ranges]
    data = vi.load(tmp_path / "out" / "B3-10mm-A3-1.12Hz-gap-diagram.nc")
    case = vi.laboratory.case("B3-10mm-A3")
    same = vi.bifurcation_diagram(case, {"gap": (4.8e-3, 5e-3)}, 5, frequency=1.12, random=1)
    assert data.attrs["created_by"] == CREATED_BY
    for name in ("section_displacement", "exponents", "period"):
        np.testing.assert_array_equal(data[name], same[name])


def test_the_frequency_stands_in_title_and_names_unless_it_is_varied(tmp_path, run_in):
    few = ("B2-G1-A3", "--direction", "up", "--figure", "svg", "--vary")
    code, out, _ = run_in(tmp_path, *few, "gap=7mm:8mm:2", "--frequency", "2.2Hz", "--json")
    printed = json.loads(out)
    assert (code, printed["frequency"]) == (0, 2.2)
    assert printed["files"]["figure"] == "out/B2-G1-A3-2.2Hz-gap-diagram.svg"
    assert "B2-G1-A3, 2.2 Hz" in (tmp_path / printed["files"]["figure"]).read_text()
    printed = json.loads(run_in(tmp_path, *few, "frequency=2Hz:2.1Hz:2", "--json")[1])
    assert "frequency" not in printed
    assert printed["files"]["figure"] == "out/B2-G1-A3-frequency-diagram.svg"


def test_contacts_part_ranges_and_their_absence_is_told(tmp_path, run_in):
    few = ("B2-G1-A3", "--direction", "down", "--vary", "frequency=1.6Hz:2.8Hz:7")
    _, out, _ = run_in(tmp_path, *few)
    rows = [line.split()[3:] for line in out.splitlines() if line.startswith("periodic")]
    assert [row[:-2] for row in rows] == [
        ["1R", "1L", "1.6"],
        ["none", "1.8", "to", "2.8"],
    ]
    assert "touches a stop" not in out
    _, out, _ = run_in(tmp_path, *few[:4], "frequency=2.8Hz:2.9Hz:2")
    assert "Note: none of these motions touches a stop. Motions that do may coexist" in out
    ranges = json.loads(run_in(tmp_path, *few, "--json")[1])["starts"]["down"]
    assert [one["contacts"] for one in ranges] == [{"right": n, "left": n} for n in (1, 0)]


def test_no_undecided_motion_is_hidden():
    count = 40
    motion = np.array(["periodic"] * count, dtype=object)
    motion[-1] = "undecided"
    shape = ("start", "gap")
    data = xr.Dataset(
        {
            "motion": (shape, [motion.astype(str)]),
            "period": (shape, [[*range(1, count), 0]]),
            "exponents": ((*shape, "exponent"), -np.ones((1, count, 2))),
            "impacts": ((*shape, "stop"), np.ones((1, count, 1))),
            "displacement_max": (shape, np.ones((1, count))),
            "displacement_min": (shape, -np.ones((1, count))),
        },
        {
            "start": ["up"],
            "gap": ("gap", np.arange(count) / 1e3, {"units": "m"}),
            "stop": ["right"],
        },
        {"parameter": "gap"},
    )
    text = as_text(facts.text(data))
    assert text.count("periodic") == 12
    assert text.count("undecided") == 1
    assert f"and {count - 13} narrower ranges" in text


def test_different_motions_of_one_kind_are_told():
    """Both directions have one range of equal motions by kind, period and contacts."""
    hardening = vi.PolynomialIsolator("30 kN/m", "150 N s/m", "20 MN/m^3")
    rig = vi.Rig(vi.Oscillator(550, hardening), "0.05 g", frequency=1.5)
    data = vi.bifurcation_diagram(rig, {"isolator.cubic": ("0", "40 MN/m^3")}, 9)
    summary = facts.facts(data)
    assert [len(one) for one in summary["starts"].values()] == [1, 1]
    up, down = (data["displacement_max"].sel(start=start) for start in ("up", "down"))
    differ = np.flatnonzero(~np.isclose(up, down, rtol=1e-6))
    values = data["isolator.cubic"].values[differ]
    assert 1 < len(differ) < 9
    (one,) = summary["different_motions"]
    assert one == {"from": values[0], "to": values[-1], "values": len(differ)}
    text = as_text(facts.text(data))
    low, high = (f"{1e-6 * end:g}" for end in values[[0, -1]])
    assert f"\nDifferent periodic motions from different starts: {low} to {high} MN/m³\n" in text
    assert "isolator.cubic (MN/m³)" in text
    assert "exponent at most (1/s)" in text
    same = data.isel({"isolator.cubic": slice(0, differ[0])})
    assert facts.facts(same)["different_motions"] == []
    assert "Different periodic motions" not in as_text(facts.text(same))
    data["motion"][:] = "chaotic"  # which is compared with nothing
    assert facts.facts(data)["different_motions"] == []


def test_as_json_over_the_frequency_at_impacts(tmp_path, run_in):
    code, out, errors = run_in(
        tmp_path,
        *("B2-G1-A3", "--vary", "frequency=2Hz:2.4Hz:5", "--direction", "down"),
        *("--quantity", "impact-velocity", "--phase", "90deg", "--json"),
    )
    assert (code, errors) == (0, "")
    printed = json.loads(out)
    assert list(printed["starts"]) == ["down"]
    assert sum(one["values"] for one in printed["starts"]["down"]) == 5
    assert printed["starts"]["down"][0]["from"] == 2.0
    data = vi.load(tmp_path / printed["files"]["data"])
    assert "contact_start_velocity" in data
    assert float(data["section"].sel(component="phase")[0, 0]) == pytest.approx(np.pi / 2.0)


@pytest.mark.parametrize(
    ("words", "told_of"),
    [
        (GAPS, "--frequency: missing"),
        ((*GAPS, "--frequency", "0Hz"), "--frequency"),
        (
            ("B2-G1-A3", "--vary", "gap=1mm:2mm:1"),
            "--vary: gap: the number of values, '1', is not a whole",
        ),
        ((*GAPS, "--frequency", "1Hz", "--random", "-1"), "--random: -1"),
        (
            (*GAPS, "--frequency", "1Hz", "--direction", "none"),
            "--direction: neither a direction nor a start",
        ),
        (("B2-G1-A3", "--vary", "colour=1:2"), "--vary: 'colour'"),
        (
            ("B2-G1-A3", "--vary", "isolator.damping=-30%:30%", "--frequency", "2Hz"),
            "--vary: isolator.damping: '-30%:30%' is in percent, but a range has the values "
            "themselves; write them with a unit, such as 0.7985kN*s/m:1.483kN*s/m, which is ±30 %",
        ),
        (
            ("B2-G1-A3", "--vary", "isolator.stiffness=10:60kN/m", "--frequency", "2Hz"),
            "--vary: isolator.stiffness: '60kN/m' has a unit and '10' has none; write both with",
        ),
        (
            ("B2-G1-A3", "--vary", "frequency=3Hz:2Hz"),
            "--vary: frequency: the first value, 3 Hz",
        ),
    ],
)
def test_refused(run, words, told_of):
    code, out, errors = run(*words)
    assert (code, out) == (2, "")
    assert errors.startswith(f"vibroimpact: error: {told_of}")
