"""Errors are short lines, however long the lists of names in them are."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.cli import main
from vibroimpact.errors import LONGEST, InputError, alternatives, meant, short_line, unknown
from vibroimpact.figures import resonance_family

NAMES = [f"channel {i}" for i in range(500)]


def test_an_unknown_name_is_followed_by_what_to_use():
    assert unknown("x", ["gap", "mass", "force"]) == "'x' is unknown; use gap, mass or force"
    assert unknown("gapp", ["gap"]) == "'gapp' is unknown; did you mean gap? Use gap"
    assert unknown(3, ["gap", "mass"]) == "3 is unknown; use gap or mass"
    assert alternatives([]) == ""


def test_a_suggestion_requires_the_stated_likeness():
    assert meant("gp", ["gap"]) == "did you mean gap? "
    assert meant("gp", ["gap"], cutoff=0.9) == ""


def test_a_long_list_loses_items_before_its_last():
    assert short_line(f"name: 'x'; use {alternatives(NAMES[:9])}").count(",") == 7
    line = short_line(f"name: 'x'; use {alternatives(NAMES)}")
    assert line.startswith("name: 'x'; use channel 0, channel 1, channel 2, ")
    kept = line.count("channel") - 2
    assert line.endswith(
        f"channel {kept - 1}, ... {498 - kept} more ..., channel 498 or channel 499"
    )
    assert LONGEST - 20 < len(line) <= LONGEST


def test_the_longer_of_two_lists_is_cut_first():
    keys = "use a, b, c, d, e or f"
    line = short_line(f"one: use {alternatives(NAMES)}; two: {keys}")
    assert line.endswith(f"channel 499; two: {keys}")
    assert len(line) <= LONGEST


@pytest.mark.parametrize("part", ["word ", "abcdefghi; ", "a b c d e f g h i j, "])
def test_what_is_no_list_loses_its_middle(part):
    message = str(InputError(f"field: {part * 100} the end"))
    assert message.startswith(f"field: {part.strip()}")
    assert message.endswith(" the end")
    assert " ... " in message
    assert LONGEST - 20 < len(message) <= LONGEST


def test_the_path_of_a_file_is_kept():
    path = f"/{'folder/' * 20}file.csv"
    message = str(InputError(f"file: {path!r}; use {alternatives(NAMES)}"))
    assert repr(path) in message
    assert len(message) <= LONGEST + len(repr(path))


def _many_columns(path):
    path.write_text(",".join(NAMES) + "\n" + ",".join("1" * len(NAMES)) + "\n")
    return path


def _many_groups(path):
    one = vi.simulate("B2-G1-A3", 1, frequency="2 Hz", samples=0)
    return vi.save(dict.fromkeys(NAMES[:40], one), path)


READERS = {
    "measurement": lambda folder: vi.read_measurement(_many_columns(folder / "a.csv")),
    "columns": lambda folder: vi.read_measurement(
        _many_columns(folder / "a.csv"), columns={"frequency": "f"}
    ),
    "units": lambda folder: vi.read_measurement(_many_columns(folder / "a.csv"), units={"f": "m"}),
    "record": lambda folder: vi.Record.read(_many_columns(folder / "a.csv"), step=0.01),
    "component": lambda folder: vi.Record.read(
        _many_columns(folder / "a.csv"), component="x", step=0.01
    ),
    "group": lambda folder: vi.load(_many_groups(folder / "a.nc"), "x"),
    "rows": lambda _: vi.to_table(xr.Dataset({name: (name, [1.0]) for name in NAMES}), "x"),
    "names": lambda _: vi.save(
        dict.fromkeys([*NAMES, "channel_0"], xr.Dataset({"a": 1})), "never.nc"
    ),
    "parameter": lambda _: vi.branch("B2-G1-A3", frequency="2 Hz", vary={"x": (1, 2)}),
    "oscillator": lambda _: vi.Oscillator.model_validate(dict.fromkeys(NAMES, 1)),
    "rigs": lambda _: resonance_family(
        vi.sweeps(["B2-G1-A3"] * 99, np.array([2.0, 2.1])), labels={"x": "y"}
    ),
}


@pytest.mark.parametrize("reader", READERS.values(), ids=READERS)
def test_errors_of_readers_are_short(tmp_path, monkeypatch, reader):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(vi.InputError) as error:
        reader(tmp_path)
    message = str(error.value)
    assert len(message) <= LONGEST + len(str(tmp_path / "'a.csv'"))
    assert message.count("channel") < 40


def test_errors_of_commands_are_short(tmp_path, capsys):
    study = tmp_path / "study.toml"
    study.write_text('case = "B2-G1-A3"\n' + "".join(f"key{i} = 1\n" for i in range(99)))
    for words in (
        ["sweep", str(study)],
        ["map", "--vary", "x" * 999 + "=1:2"],
        ["bifurcation", "B2-G1-A3", "--vary", "x=1:2"],
        ["sweep", "B2-G1-A3", *NAMES],
        ["x" * 999],
    ):
        assert main([*words]) == 2
        line = capsys.readouterr().err.replace(repr(str(study)), "").strip()
        assert "\n" not in line
        assert len(line) <= LONGEST + len("vibroimpact: error: ")
