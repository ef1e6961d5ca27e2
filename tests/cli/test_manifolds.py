"""``vibroimpact manifolds``."""

from __future__ import annotations

import json

import pytest

import vibroimpact as vi

COMMAND = "manifolds"
WINDOW = ("--displacement", "-11mm:11mm", "--velocity", "-0.104:0.104")
WORDS = ("B3-10mm-A3", "--frequency", "0.7Hz", "--nodes", "20", *WINDOW)
NAME = "B3-10mm-A3-0.7Hz-manifolds"


def test_text_and_files(run, tmp_path):
    code, out, errors = run(*WORDS, "--longest", "1")
    assert (code, errors) == (0, "")
    first = next(line for line in out.splitlines() if line.startswith("1 "))
    assert first.split() == ["1", "5.304", "1.984", "1", "5.856,", "0.005038"]
    assert "  2 of 2: the curve reaches the maximum length" in out
    assert "2 of 4 curves continue beyond their ends" in out
    assert "  2 of 2: the curve ends at a steady motion" in out
    assert "stable and unstable manifolds do not cross" in out
    assert {p.name for p in (tmp_path / "out").iterdir()} == {f"{NAME}.nc", f"{NAME}.png"}


@pytest.mark.full
@pytest.mark.parametrize("option", ["--curve-cycles", "--longest"])
def test_advice_names_the_option(run, tmp_path, option):
    few = {"--curve-cycles": "2000", "--longest": "1"}[option]
    code, out, _ = run(*WORDS, option, few)
    assert code == 0
    assert f"; raise {option}" in " ".join(out.split())
    assert "curve_cycles" not in out
    argument = option.removeprefix("--").replace("-", "_")
    data = vi.load(tmp_path / "out" / f"{NAME}.nc")
    assert f"raise {argument}" in data.attrs["notes"]
    facts = json.loads(run(*WORDS, option, few, "--json")[1])
    assert f"raise {option}" in "".join(facts["notes"])


def test_a_saddle_that_is_given(run, tmp_path):
    begun = ("--saddle", "-5.3mm,-2mm/s", "--phase", "180deg")
    code, out, _ = run(*WORDS, *begun, "--longest", "0.2", "--json")
    assert code == 0
    facts = json.loads(out)
    data = vi.load(tmp_path / facts["files"]["data"])
    # The mirror image of the one that the border at no phase leads to.
    (saddle,) = facts["saddles"]
    assert saddle["displacement"] == pytest.approx(-0.005304, rel=1e-3)
    assert saddle["displacement"] == float(data["saddle_displacement"][0])
    assert [one["kind"] for one in facts["curves"]] == list(data["curve_kind"].values)
    assert facts["crossings"] == 0


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--saddle", "5mm"), "--saddle: '5mm'; pass a displacement and a velocity"),
        (
            ("--saddle", "2.6mm,-27mm/s"),
            "--saddle[0]: this orbit is not a saddle, because the absolute values of its "
            "multipliers are",
        ),
        (("--spacing", "0"), "--spacing: "),
        (("--period", "0"), "--period: 0"),
    ],
)
def test_what_is_refused(run, tmp_path, words, named):
    code, out, errors = run(*WORDS, *words)
    assert (code, out) == (2, "")
    assert named in errors
    assert list(tmp_path.iterdir()) == []


@pytest.mark.full
def test_without_borders_there_is_no_saddle(run):
    code, out, _ = run("B3-Ginf-A3", "--frequency", "0.7Hz", "--nodes", "4", *WINDOW)
    assert code == 0
    assert "no saddle was found on the borders between basins" in out
