"""What is assumed of a measurement reaches whoever reads it."""

from __future__ import annotations

import warnings

import pytest

import vibroimpact as vi
from vibroimpact.cli import main


@pytest.fixture
def path(tmp_path):
    file = tmp_path / "test.csv"
    file.write_text("f,Ed (mm),Temp\n1,10,20\n2,20,20\n3,5,20\n")
    return file


def test_notes_are_one_warning(path):
    with pytest.warns(vi.InputWarning) as caught:
        data = vi.read_measurement(path)
    fact, *notes = data.attrs["notes"].splitlines()
    assert fact == "test.csv: no backward sweep was measured"
    assert any("Temp" in note for note in notes)
    assert [str(one.message) for one in caught] == [
        f"measurement {str(path)!r}: {'; '.join(notes)}"
    ]
    assert caught[0].filename == __file__


def test_a_file_that_says_all_gives_no_warning(tmp_path):
    file = tmp_path / "clear.csv"
    rows = [f"{frequency},{way},1" for way in ("forward", "backward") for frequency in (1, 2)]
    head = ["# amplitude = 0.05 g", "f (Hz),direction,Ed (mm)"]
    file.write_text("\n".join([*head, *rows]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert vi.read_measurement(file).attrs["notes"] == ""


def test_commands_print_them(path, capsys):
    assert main(["identify", str(path), "--rig", "B2-G1-A3", "--free", "nonsense"]) == 2
    assert f"warning: measurement {str(path)!r}: " in capsys.readouterr().err


@pytest.mark.parametrize("mark", ["9999", "-9999", "999.99", "-999.0", "1e38", "-99999"])
def test_marks_of_dropouts_are_doubted(tmp_path, mark):
    file = tmp_path / "dropouts.csv"
    cells = [mark if i in (3, 7) else f"{0.5 * i}" for i in range(20)]
    rows = [f"{1 + 0.1 * i:g},forward,{cell}" for i, cell in enumerate(cells)]
    file.write_text("\n".join(["f (Hz),direction,Ed (mm)", *rows]))
    message = r"column Ed.* has the value .* in 2 of 20 rows, far from all others \(at most 9\.5\)"
    with pytest.warns(vi.InputWarning, match=message):
        assert "leave these cells empty" in vi.read_measurement(file).attrs["notes"]


@pytest.mark.parametrize("value", ["99.9", "999", "1234", "95"])
def test_other_values_are_not_doubted(tmp_path, value):
    """Neither far values without nines, nor nines among values of their size."""
    file = tmp_path / "values.csv"
    usual = 300.0 if value == "999" else 10.0
    rows = [f"{1 + 0.1 * i:g},forward,{usual}" for i in range(20)]
    file.write_text("\n".join(["f (Hz),direction,Ed (mm)", *rows, f"4,forward,{value}"]))
    assert "rows, far from" not in vi.read_measurement(file).attrs["notes"]
