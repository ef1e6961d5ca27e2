"""Values that options replace stand in titles, file names and data; replaced files are told."""

from __future__ import annotations

import json

import pytest

from vibroimpact.cli.options import RigOptions
from vibroimpact.cli.rig import subject

COMMAND = "sweep"
FEW = ("--frequencies", "1Hz,2Hz")


@pytest.mark.parametrize(
    ("options", "name", "slug"),
    [
        ({"gap": "9mm"}, "B2-G1-A3, gap 9 mm", "B2-G1-A3-gap-9mm"),
        ({"values": ("left.gap=0.009",)}, "B2-G1-A3, left gap 9 mm", "B2-G1-A3-left-gap-9mm"),
        (
            {"values": ("mass=600kg", "right=none")},
            "B2-G1-A3, mass 600 kg, no right stop",
            "B2-G1-A3-mass-600kg-no-right-stop",
        ),
        (
            {"amplitude": "0.04g", "values": ("stops.damping=1.2 kN s/m",)},
            "B2-G1-A3, amplitude 0.04 g, stops damping 1.2 kN s/m",
            "B2-G1-A3-amplitude-0.04g-stops-damping-1.2kNs_m",
        ),
        (
            {"values": ("isolator.stiffness=20 kN/m",), "parameters": "identified"},
            "B2-G1-A3, identified parameters, isolator stiffness 20 kN/m",
            "B2-G1-A3-identified-isolator-stiffness-20kN_m",
        ),
        # What is as it was is no change.
        ({"gap": "7.5 mm", "amplitude": "0.05 g", "values": ("mass=550",)}, "B2-G1-A3", "B2-G1-A3"),
        ({"gap": "9mm", "values": ("right.gap=9mm",)}, "B2-G1-A3, gap 9 mm", "B2-G1-A3-gap-9mm"),
    ],
)
def test_a_changed_case_says_so(options, name, slug):
    assert subject("B2-G1-A3", RigOptions(**options))[:2] == (name, slug)


def test_a_name_names_the_files_and_the_title_tells_the_changes():
    what = subject("B2-G1-A3", RigOptions(gap="9mm"), "mine")
    assert what[:2] == ("B2-G1-A3, gap 9 mm", "mine")


def test_a_long_title_is_broken_between_changes():
    options = RigOptions(
        values=("mass=560kg", "left.stiffness=500kN/m", "left.damping=1.234 kN s/m")
    )
    assert subject("B2-G1-A3", options).title == (
        "B2-G1-A3, mass 560 kg, left stiffness 500 kN/m,\nleft damping 1.234 kN s/m"
    )


def test_many_changes_make_a_file_name_that_any_disk_takes():
    paths = [
        "mass",
        *(f"isolator.{name}" for name in ("stiffness", "damping")),
        *(f"{whose}.stiffness" for whose in ("right", "left")),
        *(f"{whose}.damping" for whose in ("right", "left")),
    ]
    values = tuple(f"{path}=123456.789e-{3 + i}" for i, path in enumerate(paths))
    what = subject("B2-G1-A3", RigOptions(gap="123456.789e-3", values=(*values, "left.gap=4")))
    other = subject("B2-G1-A3", RigOptions(gap="123456.789e-3", values=(*values, "left.gap=5")))
    assert len(what.slug) < 160
    assert what.slug != other.slug


def test_the_parameter_set_of_a_study_that_an_option_replaces(tmp_path):
    path = tmp_path / "fine.toml"
    path.write_text('case = "B2-G1-A3"')
    assert subject(str(path), RigOptions(parameters="table"))[:2] == ("fine", "fine")
    assert subject(str(path), RigOptions(parameters="identified"))[:2] == (
        "fine, identified parameters",
        "fine-identified",
    )
    path.write_text('case = "B2-G1-A3"\nparameters = "identified"')
    assert subject(str(path), RigOptions(parameters="identified"))[:2] == ("fine", "fine")
    assert subject(str(path), RigOptions(parameters="table"))[:2] == (
        "fine, table parameters",
        "fine-table",
    )


@pytest.mark.full
def test_a_replaced_file_is_told(run, tmp_path):
    run("B2-G1-A3", *FEW)
    (tmp_path / "out/B2-G1-A3-sweep.txt").unlink()
    _, out, _ = run("B2-G1-A3", *FEW)
    lines = [line.strip() for line in out.splitlines()]
    assert lines[-3:] == [
        "out/B2-G1-A3-sweep.nc (replaced)",
        "out/B2-G1-A3-sweep.png (replaced)",
        "out/B2-G1-A3-sweep.txt",
    ]
    _, out, _ = run("B2-G1-A3", *FEW, "--json")
    assert json.loads(out)["replaced"] == [f"out/B2-G1-A3-sweep.{e}" for e in ("nc", "png", "txt")]
    _, out, _ = run("B2-G1-A3", *FEW, "--json", "--gap", "9mm")
    facts = json.loads(out)
    assert (facts["name"], facts["replaced"]) == ("B2-G1-A3, gap 9 mm", [])


@pytest.mark.full
def test_a_gap_in_metres_that_was_meant_in_millimetres(run):
    code, _, errors = run("B2-G1-A3", *FEW, "--gap", "15")
    assert code == 0
    assert errors.startswith(
        "vibroimpact: warning: gap: 15 m is 434 times the largest displacement "
    )
    assert errors.endswith("is 15 mm meant?\n")
    assert errors.count("\n") == 1
    for gap in ("15mm", "1m", "0"):
        assert run("B2-G1-A3", *FEW, "--gap", gap)[2] == ""
