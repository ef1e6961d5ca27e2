"""LabVIEW's measurement files, as records and as measurements."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from records.layouts import VALUES, lvm


def written(tmp_path, lines: list[str], name: str = "test.lvm") -> str:
    path = tmp_path / name
    path.write_text("\n".join(lines) + "\n")
    return str(path)


@pytest.mark.parametrize("times", ["One", "No", "Multi"])
@pytest.mark.parametrize(("decimal", "separator"), [(".", "Tab"), (",", "Tab"), (".", "Comma")])
def test_records_of_all_layouts(tmp_path, times, decimal, separator):
    path = written(tmp_path, lvm(times, decimal, separator))
    for name, factor in (("North", 0.01), ("East", 0.02)):
        record = vi.Record.read(path, name)
        np.testing.assert_allclose(record.acceleration, factor * np.array(VALUES), rtol=1e-14)
        assert record.step == 0.01
        assert (record.about.format, record.about.notes) == ("LabVIEW", ())
    with pytest.raises(vi.InputError, match="has 2 components; pass 'North', 'East', or a number"):
        vi.Record.read(path)


@pytest.mark.parametrize("name", ["test.lvm", "test.txt"])
def test_a_measurement(tmp_path, name):
    lines = [line.replace("North", "Base acceleration") for line in lvm()]
    lines = [line.replace("East", "Acceleration") for line in lines]
    data = vi.read_measurement(written(tmp_path, lines, name))
    np.testing.assert_allclose(data["time"], 0.01 * np.arange(10), atol=1e-12)
    np.testing.assert_allclose(data["base_acceleration"], 0.01 * np.array(VALUES), rtol=1e-14)
    np.testing.assert_allclose(data["acceleration"], 0.02 * np.array(VALUES), rtol=1e-14)


@pytest.mark.filterwarnings("ignore::vibroimpact.InputWarning")
def test_segments_are_tests(tmp_path):
    lines = [line.replace("North", "Acceleration") for line in lvm()]
    again = lines[7:]
    path = written(tmp_path, [*lines, *again])
    with pytest.raises(
        vi.InputError, match="holds 2 tests, and none is chosen; pass one of '1', '2'"
    ):
        vi.read_measurement(path)
    assert len(vi.read_measurement(path, group="2")["time"]) == 10
    with pytest.raises(
        vi.InputError, match="line 1: the file has 2 segments; use a file with one segment"
    ):
        vi.Record.read(path, 1)


@pytest.mark.parametrize("at", range(0, 26, 2))
def test_what_is_damaged_is_refused_in_one_line(tmp_path, at):
    lines = lvm()
    lines[at] = "damaged"
    path = written(tmp_path, lines)
    for read in (lambda: vi.Record.read(path, 1), lambda: vi.read_measurement(path)):
        line = ""
        try:
            read()
        except (vi.InputError, vi.InputWarning) as refused:
            line = str(refused)
        assert "\n" not in line


def test_a_label_and_a_name_that_differ_are_refused(tmp_path):
    lines = [line.replace("North", "North (mm/s^2)") for line in lvm()]
    path = written(tmp_path, lines)
    with pytest.raises(
        vi.InputError, match=r"states two units of 'North.*', 'mm/s\^2' and '.+'; pass"
    ):
        vi.Record.read(path, 1)
    with pytest.warns(vi.InputWarning, match=r"the unit g replaces the unit in the file, mm/s\^2"):
        assert vi.Record.read(path, 1, unit="g").about.unit == "g"
    lines = [line.replace("North", "North_g") for line in lvm()]
    with pytest.warns(
        vi.InputWarning, match="the values are read in .+, although the name of the column states g"
    ):
        vi.Record.read(written(tmp_path, lines), 1)
