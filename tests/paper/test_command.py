"""``python -m paper`` from the words typed to the files written."""

from __future__ import annotations

import json

import pytest

from paper.__main__ import main
from paper.claims import CLAIMS, dimensionless


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    """Run the command in an empty folder; return exit code, stdout and stderr."""
    monkeypatch.chdir(tmp_path)

    def run(*words):
        try:
            code = main(words)
        except SystemExit as ended:
            code = ended.code
        out, errors = capsys.readouterr()
        return (
            code,
            out,
            "".join(line for line in errors.splitlines(keepends=True) if "compiling" not in line),
        )

    return run


@pytest.fixture
def few(monkeypatch):
    """Statements that are judged at once, one of them not reproduced."""
    claims = tuple(
        claim
        for claim in dimensionless.CLAIMS
        if claim.key in ("table-gaps", "gap-is-of-both-sides", "range-of-gaps")
    )
    monkeypatch.setattr("paper.claims.CLAIMS", claims)
    return claims


def test_claims_and_a_table(run, tmp_path, few):
    code, out, errors = run("--only", "table1,claims")
    assert (code, errors) == (0, "")
    lines = [line.rstrip() for line in out.splitlines()]
    assert lines[:4] == [
        "Statements of the paper: 3",
        "    2 reproduced",
        "    1 not reproduced",
        "    0 needs the experiment's data",
    ]
    assert "Not reproduced" in lines
    assert "both sides 0.434, one side 0.217" in out
    assert lines[-3:] == ["Files", "  out/paper/table1-claims.md", "  out/paper/table1-claims.html"]
    assert "  inputs: 2 reproduced, 1 not reproduced" in lines
    html = (tmp_path / "out/paper/table1-claims.html").read_text(encoding="utf-8")
    assert "Table 1" in html
    assert not (tmp_path / "out/paper/figures").exists()


def test_json(run, tmp_path, few):
    code, out, errors = run("--only", "claims", "--json", "-o", "there", "--threads", "1")
    assert (code, errors) == (0, "")
    facts = json.loads(out)
    assert facts["verdicts"] == {
        "reproduced": 2,
        "not reproduced": 1,
        "needs the experiment's data": 0,
    }
    assert facts["kinds"] == {"inputs": facts["verdicts"]}
    assert {one["kind"] for one in facts["claims"]} == {"inputs"}
    assert [one["key"] for one in facts["claims"]] == [claim.key for claim in few]
    (lost,) = (one for one in facts["claims"] if one["verdict"] == "not reproduced")
    assert lost["section"] == "7"
    assert "one side 0.217" in lost["number"]
    assert set(facts["files"]) == {"markdown", "html"}
    for path in facts["files"].values():
        assert (tmp_path / path).is_file()


def test_a_figure(run, tmp_path):
    code, out, errors = run("--only", " fig03 ", "--figure", "svg")
    assert (code, errors) == (0, "")
    assert "Statements" not in out
    image = tmp_path / "out/paper/figures/fig03.svg"
    assert image.read_text(encoding="utf-8").startswith("<?xml")
    assert "figures/fig03.svg" in (tmp_path / "out/paper/fig03.md").read_text(encoding="utf-8")


def test_everything(run, tmp_path, few, monkeypatch):
    from paper.items import ITEMS

    monkeypatch.setattr("paper.items.ITEMS", ITEMS[:1])
    code, out, errors = run()
    assert (code, errors) == (0, "")
    for name in ("report.md", "report.html", f"figures/{ITEMS[0].key}.png"):
        assert f"  out/paper/{name}" in out.splitlines()
        assert (tmp_path / "out/paper" / name).stat().st_size > 1000


@pytest.mark.parametrize("only", ["fig99", "fig03,", "claim", "-1", ""])
def test_unknown_key(run, tmp_path, only):
    code, out, errors = run(f"--only={only}")
    assert (code, out) == (2, "")
    (line,) = errors.splitlines()
    key = only.split(",")[-1]
    assert (
        f"--only: {key!r} is unknown; pass one or more of these, separated by commas: fig03, "
        in line
    )
    assert "table1" in line
    assert line.endswith(", claims")
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize("threads", ["0", "-1", "1.5"])
def test_threads(run, tmp_path, threads):
    code, out, errors = run("--only", "table1", f"--threads={threads}")
    assert (code, out) == (2, "")
    assert "threads" in errors.lower()
    assert not any(tmp_path.iterdir())


def test_a_folder_that_cannot_be_made(run, tmp_path):
    (tmp_path / "file").write_text("", encoding="utf-8")
    code, _, errors = run("--only", "table1", "-o", "file/there")
    assert code == 2
    assert "--output: 'file/there' cannot be written to" in errors


def test_nothing_is_left_out_of_the_command(run):
    code, out, _ = run("--help")
    assert code == 0
    assert "--only" in out
    assert len(CLAIMS) > 35
