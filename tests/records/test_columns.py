"""Records read from columns of numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi

pytestmark = pytest.mark.filterwarnings("ignore::vibroimpact.InputWarning")
"""What is noted is tested in test_notes.py."""


def written(tmp_path, text: str):
    path = tmp_path / "record.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("text", "step"),
    [
        ("1\n2\n-3\n", 0.1),
        ("# one\n\n1 # first\n2\n-3", "100 ms"),
        ("time,a\n0.0,1\n0.1,2\n0.2,-3\n", None),
        ("time;a\r\n5.0;1\r\n5.1;2\r\n5.2;-3\r\n", None),
        ("\ufefft\ta\n0 1\n0.1\t2\n0.2 -3\n", None),
        ("0, 0.1, 0.2\n1, 2, -3\n", None),
    ],
)
def test_all_say_the_same(tmp_path, text, step):
    record = vi.Record.read(written(tmp_path, text), step=step, unit="m/s^2")
    np.testing.assert_array_equal(record.acceleration, [1.0, 2.0, -3.0])
    assert record.step == pytest.approx(0.1, rel=1e-12)


def test_units(tmp_path):
    path = written(tmp_path, "0.1\n-0.2\n0.3\n")
    np.testing.assert_allclose(
        vi.Record.read(path, step=0.1, unit="g").acceleration, [0.980665, -1.96133, 2.941995]
    )
    time = np.arange(50) * 0.02
    rows = "\n".join(f"{t!r},{20 * math.sin(3 * t)!r}" for t in time.tolist())
    moved = vi.Record.read(written(tmp_path, rows), unit="mm")
    expected = vi.Record.from_displacement(0.02 * np.sin(3 * time), 0.02)
    np.testing.assert_allclose(moved.acceleration, expected.acceleration, atol=1e-10)


def test_a_missing_step_and_a_missing_unit_are_told_at_once(tmp_path):
    path = written(tmp_path, "0.1\n-0.2\n0.3\n")
    both = r'^step: missing, .* \(--step 10ms\); unit: missing, too; .* unit="g" \(--unit g\)$'
    with pytest.raises(vi.InputError, match=both):
        vi.Record.read(path)
    with pytest.raises(vi.InputError, match=r"^step: missing, .* \(--step 10ms\)$"):
        vi.Record.read(path, unit="g")


@pytest.mark.parametrize(
    ("text", "step", "unit", "line"),
    [
        ("1\nnan\n2\n", 0.1, "m/s^2", r"record: .*, line 2: a value is missing"),
        ("1\n", 0.1, "m/s^2", r".*acceleration: 1 given; pass one sequence of at least 2"),
        ("", 0.1, "m/s^2", r"record: .* has no numbers"),
        ("words only\n", 0.1, "m/s^2", r"record: .* has no numbers"),
        ("1\n2\n", None, "m/s^2", r"step: missing, but .* has no times"),
        ("1\n2\n", 0.0, "m/s^2", r"step: 0.0 is not greater than 0"),
        ("1\n2\nend\n", 0.1, "m/s^2", r"record: .*, line 3: 'end' is not a row of numbers"),
        (
            "1,2,3\n4,5,6\n7,8,9\n",
            None,
            "m/s^2",
            r"component: missing, but .* has 2 components; pass '1', '2', or",
        ),
        ("1,2\n3\n", None, "m/s^2", r"record: .*, line 2: the row has 1 number, but the rows"),
        ("1,2\n3,4\n5\n", None, "m/s^2", r"record: .*, line 3: the row has 1 number, but the rows"),
        ("0,1\n0.1,2\n0.5,3\n", None, "m/s^2", r"record: .*, line 2: .* not evenly spaced"),
        ("0,0.1,0.5\n1,2,3\n", None, "m/s^2", r"record: .*, sample 1: .* not evenly spaced"),
        ("t,a\n0,1\n-0.1,2\n-0.2,3\n", None, "m/s^2", r"record: .*not evenly spaced"),
        ("0,1\n-0.1,2\n-0.2,3\n", None, "m/s^2", r"record: .*neither names nor times"),
        ("0,1\n0,2\n0,3\n", None, "m/s^2", r"record: .*neither names nor times"),
        ("1\n2\n", 0.1, "N", r"unit: .*"),
        ("1\n2\n", 0.1, "nonsense", r"unit: .*"),
        (
            "0\n0\n0\n0\n0\n1\n1\n1\n1\n1\n",
            0.1,
            "mm",
            r".*displacement\[\d\]: the displacement jumps",
        ),
    ],
)
def test_refused_in_one_line(tmp_path, text, step, unit, line):
    with pytest.raises(vi.InputError, match=f"^{line}") as refused:
        vi.Record.read(written(tmp_path, text), step=step, unit=unit)
    assert "\n" not in str(refused.value)


def test_what_is_no_text_file(tmp_path):
    with pytest.raises(vi.InputError, match=r"^record: .* cannot be read \(No such file"):
        vi.Record.read(tmp_path / "missing.csv", step=0.1)
    path = tmp_path / "binary.dat"
    path.write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(vi.InputError, match=r"^record: .* is not text"):
        vi.Record.read(path, step=0.1)


def test_names_and_units_above_the_columns(tmp_path):
    text = "made up\nTime [s],North (g),East (g)\n0,1,10\n0.1,2,20\n0.2,-3,-30\n"
    path = written(tmp_path, text)
    record = vi.Record.read(path, "east")
    np.testing.assert_allclose(record.acceleration, [98.0665, 196.133, -294.1995])
    assert (record.about.component, record.about.unit) == ("East", "g")
    with pytest.raises(
        vi.InputError, match="has 2 components; pass 'North', 'East', or a number from 1"
    ):
        vi.Record.read(path)
    assert vi.Record.read(path, 1, unit="m/s^2").peak == 3.0


COMMAS = {
    "semicolons": "t;a (m/s^2)\n0,00;1,5\n0,01;-2,5\n0,02;3\n",
    "tabs": "t\ta (m/s^2)\n0,00\t1,5\n0,01\t-2,5\n0,02\t3,0\n",
    "blanks": "0,00 1,5\n0,01 -2,5\n0,02 3,0\n",
    "quotes": '"t","a (m/s^2)"\n"0,00","1,5"\n"0,01","-2,5"\n"0,02","3,0"\n',
    "quotes and semicolons": '"t";"a (m/s^2)"\n"0,00";"1,5"\n"0,01";"-2,5"\n"0,02";"3,0"\n',
}


@pytest.mark.parametrize("how", COMMAS)
def test_decimal_commas(tmp_path, how):
    record = vi.Record.read(written(tmp_path, COMMAS[how]), unit="m/s^2")
    np.testing.assert_array_equal(record.acceleration, [1.5, -2.5, 3.0])
    assert record.step == pytest.approx(0.01, rel=1e-12)


def test_a_comma_that_may_mean_two_things(tmp_path):
    path = written(tmp_path, "1,5\n-2,5\n3,0\n")
    record = vi.Record.read(path, step=0.01, decimal=",", unit="m/s^2")
    np.testing.assert_array_equal(record.acceleration, [1.5, -2.5, 3.0])
    with pytest.raises(vi.InputError, match=r"neither names nor times.*decimal=','"):
        vi.Record.read(path)
    path = written(tmp_path, "0,001 1,500\n0,002 -2,500\n")
    assert vi.Record.read(path, unit="m/s^2").peak == 2.5
    path = written(tmp_path, "1,000 1,500\n2,000 -2,500\n")
    with pytest.raises(vi.InputError, match=r"the comma in '1,000' may be .* pass decimal=','"):
        vi.Record.read(path)
    assert vi.Record.read(path, decimal=",", unit="m/s^2", step=1.0).peak == 2.5
    with pytest.raises(
        vi.InputError, match=r"^decimal: ';' is not a decimal mark; pass '\.' or ','"
    ):
        vi.Record.read(path, decimal=";")


def test_the_end_of_the_data_is_no_row(tmp_path):
    text = "1\n2\n-3\n*** End Data ***\n"
    record = vi.Record.read(written(tmp_path, text), step=0.1, unit="m/s^2")
    np.testing.assert_array_equal(record.acceleration, [1.0, 2.0, -3.0])
    with pytest.raises(vi.InputError, match="line 5: numbers follow the end of the data"):
        vi.Record.read(written(tmp_path, text + "4\n"), step=0.1, unit="m/s^2")


def test_times_that_are_rounded_or_jitter(tmp_path):
    values = np.sin(0.1 * np.arange(300))
    rng = np.random.default_rng(3)
    for step, times, off in (
        (1 / 128, [f"{i / 128:.3f}" for i in range(300)], 5e-4),
        (1 / 256, [f"{i / 256:.3f}" for i in range(300)], 5e-4),
        (
            0.01,
            [repr(0.01 * i + j) for i, j in enumerate(rng.uniform(-1e-4, 1e-4, 300).tolist())],
            2e-4,
        ),
    ):
        rows = "".join(f"{t},{a!r}\n" for t, a in zip(times, values.tolist(), strict=True))
        record = vi.Record.read(written(tmp_path, rows), unit="m/s^2")
        assert record.step == pytest.approx(step, rel=off / (299 * step) * 2)
        np.testing.assert_array_equal(record.acceleration, values)
        (note,) = record.about.notes
        assert note.startswith("its times are uneven by up to 0.000")
        stated = vi.Record.read(written(tmp_path, rows), unit="m/s^2", step=step)
        assert stated.step == step


@pytest.mark.parametrize("gone", [1, 40, 150, 298])
def test_a_sample_that_is_missing_is_no_jitter(tmp_path, gone):
    for digits in (2, 6):
        rows = "".join(f"{0.01 * i:.{digits}f},{i % 7}\n" for i in range(300) if i != gone)
        path = written(tmp_path, rows)
        with pytest.raises(vi.InputError, match=r"not evenly spaced .*step= \(--step\)"):
            vi.Record.read(path)
        record = vi.Record.read(path, step=0.01, unit="m/s^2")
        assert len(record.acceleration) == 299
        assert "the step 10 ms replaces the uneven times in the file" in record.about.notes


@pytest.mark.parametrize(
    "head", ["time_s acc_g", "time (s) acceleration (g)", "time[s]  acc[g]", "Time Acc(g)"]
)
def test_units_of_a_header_between_spaces(tmp_path, head):
    path = tmp_path / "spaced.txt"
    rows = [f"{0.01 * i:.4f} {math.sin(i):.6f}" for i in range(60)]
    path.write_text("\n".join([head, *rows]), encoding="utf-8")
    record = vi.Record.read(path)
    assert abs(record.acceleration).max() == pytest.approx(9.80665, rel=1e-3)
    assert not any("no unit" in note for note in record.about.notes)


def test_a_sentence_above_the_numbers_names_no_columns(tmp_path):
    path = tmp_path / "sentence.txt"
    rows = [f"{0.01 * i:.4f} {math.sin(i):.6f}" for i in range(60)]
    path.write_text("\n".join(["Kobe station", *rows]), encoding="utf-8")
    with pytest.raises(vi.InputError, match=r"^unit: missing"):
        vi.Record.read(path)


@pytest.mark.parametrize("head", ["", ",a\n", "time,a\n", "X,CH1\n"])
@pytest.mark.parametrize("first", [0, 1])
def test_times_that_only_count_rows_need_a_step(tmp_path, head, first):
    """As an oscilloscope or a data frame without an index writes them."""
    rows = "\n".join(f"{first + i},{0.1 * math.sin(i)!r}" for i in range(40))
    path = written(tmp_path, head + rows)
    with pytest.raises(vi.InputError, match=r"only count the rows .*; pass step= \(--step\)"):
        vi.Record.read(path, unit="g")
    assert vi.Record.read(path, unit="g", step="5 ms").step == 0.005
