"""Text tables of networks and loggers, in every arrangement and wording, as records.

Each input of this page holds the same 400 values of one component in cm/s², at 200 Hz.
"""

from __future__ import annotations

from datetime import datetime, timedelta

import numpy as np
import pytest

import vibroimpact as vi

pytestmark = pytest.mark.filterwarnings("error::vibroimpact.InputWarning")
"""Where all is stated, nothing is assumed."""

COUNT, STEP = 400, 0.005
TIME = STEP * np.arange(COUNT)
A, B, C = (
    np.round(size * np.sin(rate * TIME) * np.sin(np.pi * TIME / 2.0), 3)
    for size, rate in ((50.0, 9.0), (30.0, 7.0), (20.0, 5.0))
)
PEAK = float(np.abs(A).max())


def written(tmp_path, text: str, encoding: str = "utf-8"):
    path = tmp_path / "quake.txt"
    path.write_bytes(text.encode(encoding))
    return path


def lines(values, each: int, form: str = "{:10.3f}") -> str:
    """Values that continue from line to line."""
    texts = [form.format(value) for value in values]
    return "".join("".join(texts[i : i + each]) + "\n" for i in range(0, len(texts), each))


def pairs(each: int, mark: str = " ") -> str:
    texts = [f"{t:.3f}{mark}{a:.3f}" for t, a in zip(TIME, A, strict=True)]
    return "".join(mark.join(texts[i : i + each]) + "\n" for i in range(0, COUNT, each))


def columns(*values, mark: str = ",", form: str = "{:.3f}") -> str:
    rows = zip(*values, strict=True)
    return "".join(mark.join(form.format(one) for one in row) + "\n" for row in rows)


def check(path, expected=A, size: float = 0.01, **said) -> vi.Record:
    record = vi.Record.read(path, **said)
    np.testing.assert_allclose(record.acceleration, size * expected, rtol=1e-12, atol=1e-15)
    assert record.step == pytest.approx(STEP, rel=1e-9)
    return record


HEADERS = {
    "lines": "STATION X\nNO. OF POINTS: 400\n0.005 SEC\nUNIT: CM/SEC/SEC\n",
    "one line": "CORRECTED ACCELEROGRAM  400 POINTS AT 0.005 SEC, CM/SEC/SEC\n",
    "one statement": "NO. OF POINTS: 400 OF 0.005 SEC.  UNIT CM/SEC/SEC\n",
    "a peak": f"NPTS 400, DT 0.005\nMAX. ACC. = -{PEAK:.2f} AT 1.25 SEC\nUNITS: GAL\n",
    "numbers": "values in cm/s2\n400 0.005\n",
    "a number": "values in cm/s2, dt = 0.005 s\n400\n",
    "comments": "# samples: 400\n% fs = 200 Hz\n! units: gal\n",
    "a sentence": "Kobe, Japan, one, two, three, four, five, six\n400 POINTS AT 0.005 SEC, GAL\n",
    "a duration": "400 samples, sampled at 200 Hz\nrecord length (s): 2.00\nacceleration in gal\n",
}


@pytest.mark.parametrize("each", [1, 5, 7, 8, 10, 400])
@pytest.mark.parametrize("header", HEADERS)
def test_values_that_continue_from_line_to_line(tmp_path, header, each):
    text = HEADERS[header] + lines(A, each)
    check(written(tmp_path, text))
    check(written(tmp_path, "\ufeff" + text.replace("\n", "\r\n")))


def test_the_arrangement_of_numbers_without_names_is_asked_for(tmp_path):
    head = "dt = 0.005 s, units: gal\n"
    with pytest.raises(vi.InputError) as error:
        vi.Record.read(written(tmp_path, head + lines(A, 8)))
    message = str(error.value)
    assert (
        "its rows of 8 numbers have neither names nor times: are they 8 components, or" in message
    )
    assert message.endswith("such as 'NPTS = 400', or name the columns")
    check(written(tmp_path, "NPTS = 400, " + head + lines(A, 8)))
    eight = lines(np.column_stack([A] * 8).ravel(), 8)
    check(written(tmp_path, "400 samples\n" + head + eight), component=3)
    with pytest.warns(vi.InputWarning, match="the 7 values of each line were read one after the"):
        check(written(tmp_path, head + lines(A, 7)))
    with pytest.raises(vi.InputError, match="are they 7 components"):  # it may be cut there
        vi.Record.read(written(tmp_path, (head + lines(A, 7))[:-1]))


@pytest.mark.parametrize("each", [1, 2, 5])
@pytest.mark.parametrize("mark", [" ", ",", "\t", ";"])
def test_pairs_of_time_and_value(tmp_path, each, mark):
    check(written(tmp_path, "acc in cm/s/s\n" + pairs(each, mark)))
    check(written(tmp_path, "NPTS: 400\nacc in cm/s/s\n" + pairs(each, mark)))
    with pytest.raises(
        vi.InputError, match="line 1: the file announces 399 values, but 400 follow"
    ):
        vi.Record.read(written(tmp_path, "NPTS: 399\nacc in cm/s/s\n" + pairs(each, mark)))


@pytest.mark.parametrize(
    "head",
    [
        "Time Acc(gal) Time Acc(gal)\n",
        "Time,Acc,Time,Acc\ns,gal,s,gal\n",
        "t (s),a (gal)" * 2 + "\n",
    ],
)
def test_pairs_whose_names_repeat(tmp_path, head):
    head = head.replace(")t", "),t")
    check(written(tmp_path, head + pairs(2, "," if "," in head else " ")))


COMPONENTS = {
    "network": "#SampleRate(Hz): 200\n#RecordLength(sec): 2.00\n#AmplitudeUnit:  gal. corr.\n"
    "#AmplitudeMAX. U: {most:.3f}~ -{least:.3f}\n#DataSequence: Time U(+); N(+); E(+)\n"
    "#Data: 4F10.3\n",
    "names": "#AmplitudeUnit:  gal\n#SampleRate(Hz): 200\nTime U N E\n",
    "units": "Time[s],U[gal],N[gal],E[gal]\n",
    "units below": "Time\tU\tN\tE\ns\tgal\tgal\tgal\n",
    "no name of the times": "SAMPLE RATE 200 HZ\n(gal)\n   U    N    E\n",
    "a list of units": "# units: s, gal, gal, gal\nTime,U,N,E\n",
}  # fmt: skip


@pytest.mark.parametrize("header", COMPONENTS)
def test_components_beside_their_times(tmp_path, header):
    head = COMPONENTS[header].format(most=A.max(), least=-A.min())
    path = written(tmp_path, head + columns(TIME, A, B, C, mark=" "))
    for name, expected in (("U", A), ("N", B), ("E", C)):
        check(path, expected, component=name)


@pytest.mark.parametrize(
    "head",
    [
        "SAMPLING INTERVAL (sec) : 0.005\n N-S(gal)  E-W(gal)  U-D(gal)\n",
        "(gal)\nSAMPLING INTERVAL (sec) : 0.005\n N-S  E-W  U-D\n",
        " SAMPLING RATE= 200Hz\n UNIT  = gal(cm/s/s)\n INITIAL TIME = 2004 09 05\n N-S, E-W, U-D\n",
    ],
)
def test_a_first_column_that_does_not_rise_is_a_component(tmp_path, head):
    for sign in (1.0, -1.0):
        values = [sign * one for one in (A, B, C)]
        path = written(tmp_path, head + columns(*values, mark="," if "," in head else "  "))
        for name, expected in zip(("N-S", "E-W", "U-D"), values, strict=True):
            check(path, expected, component=name)


def test_times_in_any_column_numbers_of_rows_and_repeated_times(tmp_path):
    number = np.arange(1, COUNT + 1)
    check(written(tmp_path, "acc (gal),time (s)\n" + columns(A, TIME)))
    check(written(tmp_path, "No,Time,Acc (gal)\n" + columns(number, TIME, A)))
    check(written(tmp_path, "gal\n" + columns(number, TIME, A)))
    check(written(tmp_path, "dt = 0.005 s, gal\n" + columns(number, A)))
    text = "Time (s),A (gal),Time (s),B (gal)\n" + columns(TIME, A, TIME, B)
    check(written(tmp_path, text), B, component="B")
    with pytest.raises(vi.InputError, match=r"component: missing, .* pass 'f', 'A', or a number"):
        vi.Record.read(written(tmp_path, "f (Hz),A (gal)\n" + columns(TIME, A)))


@pytest.mark.parametrize(
    ("name", "size"),
    [("acc_g", 9.80665), ("acc_mg", 9.80665e-3), ("acc_ms2", 1.0), ("acc_cms2", 0.01),
     ("acc_gal", 0.01), ("Acc [g]", 9.80665), ("Acc(m/s²)", 1.0), ('"Acc, g"', 9.80665),
     ("Acc/g", 9.80665), ("acc in g", 9.80665), ("a (m s^-2)", 1.0), ("a [ms-2]", 1.0),
     ("Acceleration X (g)", 9.80665), ("accelX (gal)", 0.01)],
)  # fmt: skip
@pytest.mark.parametrize("mark", [",", ";", "\t"])
def test_units_in_names(tmp_path, name, size, mark):
    rows = columns(TIME, A / 25.0, mark=mark, form="{:.6f}")
    rows = rows if mark == "," else rows.replace(".", ",")
    check(written(tmp_path, f"t (s){mark}{name}\n{rows}"), A / 25.0, size)


def test_a_unit_that_is_stated_nowhere_is_asked_for(tmp_path):
    for text in ("Time (s),accelX,accelY\n" + columns(TIME, A, B), "dt = 0.005\n" + columns(A)):
        path = written(tmp_path, text)
        component = 1 if "accelX" in text else None
        with pytest.raises(vi.InputError, match=f"^unit: missing, .* is {PEAK:g}; pass it"):
            vi.Record.read(path, component)
        check(path, component=component, unit="gal")


@pytest.mark.parametrize(
    ("head", "message"),
    [
        ("NPTS: 500", "line 1: the file announces 500 values, but 400 follow"),
        ("fs = 100 Hz", "'fs = 100 Hz', a step of 0.01 s, but the times have steps of 0.005 s"),
        ("dt = 0.005 s\n# fs = 100", "line 1 states 'dt = 0.005 s', but line 2 states 'fs = 100'"),
        ("duration: 8 s", "'duration: 8 s', but 400 samples in steps of 0.005 s last 1.995 s"),
        ("PGA = 0.5 g", f"states a peak of 490.332 gal, but the largest value is {PEAK:g} gal"),
        (
            "MAX = 99.5",
            f"a peak of 99.5 gal, but the largest value is {PEAK:g} gal",
        ),
        ("units: g", "states two units, 'gal' and 'g'"),
    ],
)
def test_a_statement_that_the_values_contradict_is_refused_with_both(tmp_path, head, message):
    path = written(tmp_path, f"# {head}\ntime (s),acc (gal)\n" + columns(TIME, A))
    with pytest.raises(vi.InputError) as error:
        vi.Record.read(path)
    assert message in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.filterwarnings("ignore::vibroimpact.InputWarning")
def test_the_user_settles_a_contradiction(tmp_path):
    rows = columns(TIME, A)
    for head in ("fs = 100 Hz", "duration: 8 s"):
        path = written(tmp_path, f"# {head}\ntime (s),acc (gal)\n" + rows)
        check(path, step=STEP)
    check(written(tmp_path, "# units: g\ntime (s),acc (gal)\n" + rows), unit="gal")


@pytest.mark.parametrize(
    "peak",
    [
        "PGA = {0:.2f} gal",
        "PGA = {1:.4f} g",
        "max value: {0:.1f}",
        "min = {2:.2f}, max = {3:.2f} gal",
    ],
)
def test_a_stated_peak_that_fits(tmp_path, peak):
    head = "# " + peak.format(PEAK, PEAK / 980.665, A.min(), A.max()) + "\n"
    check(written(tmp_path, f"{head}time (s),acc (gal)\n" + columns(TIME, A)))


def test_a_stated_peak_gives_the_unit(tmp_path):
    path = written(tmp_path, f"# PGA: {PEAK:.2f} gal\n# dt = 0.005 s\n" + columns(A))
    assert check(path).about.unit == "gal"


@pytest.mark.parametrize(
    ("form", "mark", "name"),
    [
        ("%Y-%m-%dT%H:%M:%S.%f", ",", "Timestamp"),
        ("%Y-%m-%d %H:%M:%S.%f", ",", "Date/Time"),
        ("%Y-%m-%d %H:%M:%S.%f", " ", "Timestamp"),
        ("%d.%m.%Y %H:%M:%S,%f", ";", "Zeit"),
        ("%d/%m/%Y %H:%M:%S.%f", "\t", "Timestamp (dd/mm/yyyy hh:mm:ss)"),
        ("%m/%d/%Y %H:%M:%S.%f", ",", "anything"),
        ("%H:%M:%S.%f", ",", "Time"),
        ("%d/%m/%Y,%H:%M:%S.%f", ",", "Date,Time"),
        ("%H:%M:%S:%f", ",", "Time"),
    ],
)
def test_date_stamps(tmp_path, form, mark, name):
    start = datetime(2024, 4, 30, 23, 59, 59)
    at = [start + timedelta(milliseconds=5 * i) for i in range(COUNT)]
    rows = "".join(
        f"{one.strftime(form)[:-3]}{mark}{a:.3f}\n" for one, a in zip(at, A, strict=True)
    )
    check(written(tmp_path, f"{name}{mark}Acc(gal)\n{rows}"))


def test_stamps_and_times_that_are_rounded_need_a_stated_step(tmp_path):
    start = datetime(2024, 4, 30, 23, 59, 59)
    rows = "".join(
        f"{(start + timedelta(milliseconds=5 * i)).strftime('%Y-%m-%d %H:%M:%S')},{a:.3f}\n"
        for i, a in enumerate(A)
    )
    with pytest.raises(vi.InputError, match="not evenly spaced"):
        vi.Record.read(written(tmp_path, "Time,Acc (gal)\n" + rows))
    for text in (rows, columns(np.floor(100.0 * TIME + 1e-9) / 100.0, A)):
        path = written(tmp_path, "# sampling rate: 200 Hz\nTime,Acc (gal)\n" + text)
        with pytest.warns(vi.InputWarning, match="rounded, so the stated step of 0.005 s is used"):
            check(path)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-8-sig", "latin-1"])
def test_encodings_quotes_exponents_and_words(tmp_path, encoding):
    check(written(tmp_path, "Zeit (s)\tacc (gal)\n" + columns(TIME, A, mark="\t"), encoding))
    rows = "".join(f'"{t:.3f}","{a:.3f}"\n' for t, a in zip(TIME, A, strict=True))
    check(written(tmp_path, '"Time (s)","acc (gal)"\n' + rows, encoding))
    check(written(tmp_path, "dt=0.005, gal\n" + columns(A, form="{:.5E}").replace("E", "D")))
    rows = "".join(f"{t:.3f},{a:.3f},OK\n" for t, a in zip(TIME, A, strict=True))
    with pytest.warns(vi.InputWarning, match="columns of words were left out: State"):
        check(written(tmp_path, "Time (s),Acc (gal),State\n" + rows))


def test_a_component_with_holes_does_not_keep_others_from_being_read(tmp_path):
    rows = "".join(
        f"{t:.3f},{a:.3f},{'' if i % 9 else '20'}\n"
        for i, (t, a) in enumerate(zip(TIME, A, strict=True))
    )
    path = written(tmp_path, "Time (s),Acc (gal),Temp (gal)\n" + rows)
    check(path, component="Acc")
    with pytest.raises(vi.InputError, match="line 3, column 'Temp': a value is missing"):
        vi.Record.read(path, "Temp")


def test_a_table_that_words_interrupt_is_refused(tmp_path):
    for first in (3, 200, 397):
        rows = columns(TIME, A).splitlines()
        rows.insert(first, "the sensor was moved")
        path = written(tmp_path, "Time (s),Acc (gal)\n" + "\n".join(rows) + "\n")
        with pytest.raises(
            vi.InputError, match=f"line {first + 2}: 'the sensor was moved' is not a r"
        ):
            vi.Record.read(path)


def test_a_count_above_a_table_is_no_file_of_peer(tmp_path):
    for head in ("# NPTS = 400\n", "NPTS = 400\nUNITS: GAL\n"):
        path = written(tmp_path, head + "time (s),acc (gal)\n" + columns(TIME, A))
        assert check(path).about.format == "columns"


@pytest.mark.parametrize("count", [1, 3])
def test_the_first_rows_are_rows_although_a_cell_of_them_is_a_word(tmp_path, count):
    words = ["start"] * count + [""] * (COUNT - count)
    rows = zip(TIME, A, words, strict=True)
    text = "".join(f"{t:.3f},{a:.3f},{word}\n" for t, a, word in rows)
    path = written(tmp_path, "Time (s),Acceleration (gal),Marker\n" + text)
    with pytest.warns(vi.InputWarning, match="columns of words were left out: Marker"):
        check(path)
    stamps = (datetime(2024, 3, 5, 10) + timedelta(seconds=float(t)) for t in TIME)
    rows = zip(stamps, A, words, strict=True)
    text = "".join(f"{t.isoformat(' ', 'milliseconds')},{a:.3f},{word}\n" for t, a, word in rows)
    path = written(tmp_path, "Time,Acceleration (gal),Marker\n" + text)
    with pytest.warns(vi.InputWarning, match="columns of words were left out: Marker"):
        check(path)


def test_a_word_in_place_of_the_first_value_is_refused(tmp_path):
    text = columns(TIME, A).replace("\n0.005,", "\n0.005,OVL", 1).replace("0.000,", "0.000,OVL", 1)
    path = written(tmp_path, "Time (s),Acceleration (gal)\n" + text)
    with pytest.raises(vi.InputError, match=r"line 2, column 'Acceleration': 'OVL.* is not a numb"):
        vi.Record.read(path)


@pytest.mark.parametrize("word", ["1.#QNAN", "-1.#IND", "1.#INF", "1.#IND00", "nan(ind)"])
def test_values_of_windows_that_are_not_finite_are_no_numbers(tmp_path, word):
    text = columns(TIME, A).replace("\n0.500,", f"\n0.500,{word}~", 1)
    text = "".join(line.partition("~")[0] + "\n" for line in text.splitlines())
    with pytest.raises(
        vi.InputError, match=r"line 102, column 'Accel.*: (?:a value is missing|inf is not)"
    ):
        vi.Record.read(written(tmp_path, "Time (s),Acceleration (gal)\n" + text))


@pytest.mark.parametrize(
    ("name", "each"),
    [("timestamp_us", 1e6), ("t_us", 1e6), ("Time us", 1e6), ("micros", 1e6), ("time_µs", 1e6),
     ("millis", 1e3), ("ms", 1e3), ("msec", 1e3), ("time_msec", 1e3), ("Time (milliseconds)", 1e3),
     ("TimeMs", 1e3), ("Time in ms", 1e3), ("time_ns", 1e9), ("Timestamp (ns)", 1e9),
     ("nanoseconds", 1e9), ("Time [nsec]", 1e9)],
)  # fmt: skip
def test_units_of_times_in_names(tmp_path, name, each):
    check(written(tmp_path, f"{name},acc (gal)\n" + columns(each * TIME, A)))


@pytest.mark.parametrize(("unit", "each"), [("ms", 10**3), ("us", 10**6), ("ns", 10**9)])
def test_times_since_1970_without_a_unit(tmp_path, unit, each):
    rows = (
        f"{1709632800 * each + round(each * t)},{a:.3f}\n" for t, a in zip(TIME, A, strict=True)
    )
    path = written(tmp_path, "timestamp,acc (gal)\n" + "".join(rows))
    with pytest.warns(vi.InputWarning, match=f"times are read in {unit} since 1970"):
        record = vi.Record.read(path)
    assert record.step == pytest.approx(STEP, rel=1e-6)


def test_names_of_other_numbers_of_columns_name_none_of_them(tmp_path):
    """With one name too few, a name would be that of the column before it."""
    path = written(tmp_path, "Time (s),Acc (gal)\n" + columns(TIME, A, B))
    check(path, component="1")
    check(path, B, component="2")
    with pytest.raises(vi.InputError, match="pass '1', '2'"):
        vi.Record.read(path, "Acc")


@pytest.mark.parametrize("head", ["NS component, PGA = {} gal", "NS; peak acceleration = {} gal"])
def test_a_peak_beside_words_above_two_columns_is_no_name(tmp_path, head):
    check(written(tmp_path, head.format(f"{PEAK:.3f}") + "\n" + columns(TIME, A, mark=" ")))
    path = written(tmp_path, head.format(f"{100.0 * PEAK:.3f}") + "\n" + columns(TIME, A, mark=" "))
    with pytest.raises(vi.InputError, match="unit: missing"):  # of none is this the peak
        vi.Record.read(path)


@pytest.mark.parametrize("kind", ["TSPAIR", "SLIST"])
def test_a_rate_after_a_number_of_samples_is_no_second_number(tmp_path, kind):
    head = f"TIMESERIES XX_NWH_00_HNE_R, 400 samples, 200 sps, 2024-03-05T10:00:00.000, {kind}, "
    text = lines(A, 6)
    if kind == "TSPAIR":
        stamps = (datetime(2024, 3, 5, 10) + timedelta(seconds=float(t)) for t in TIME)
        pairs_ = zip(stamps, A, strict=True)
        text = "".join(f"{t.isoformat(timespec='microseconds')}  {a:.3f}\n" for t, a in pairs_)
    check(written(tmp_path, head + "FLOAT, CM/S**2\n" + text))


def test_the_header_of_campbell_loggers(tmp_path):
    head = (
        '"TOA5","NWH","CR1000","1234","CR1000.Std.32","CPU:a.CR1","5555","Table1"\n'
        '"TIMESTAMP","RECORD","North","East"\n"TS","RN","gal","gal"\n"","","Smp","Smp"\n'
    )
    stamps = (datetime(2024, 3, 5, 10) + timedelta(seconds=float(t)) for t in TIME)
    rows = zip(stamps, A, B, strict=True)
    text = "".join(
        f'"{t.isoformat(" ", "milliseconds")}",{i},{a:.3f},{b:.3f}\n'
        for i, (t, a, b) in enumerate(rows)
    )
    check(written(tmp_path, head + text), component="North")
    check(written(tmp_path, head + text), B, component="East")


def test_comments_after_a_semicolon(tmp_path):
    head = (
        ";Title, made up\n;Start_time, 2024-03-05, 10:00:00.000\n;Temperature, -999.00, deg C\n"
        ";SampleRate, 200,Hz\n;Headers, time,Ax,Ay,Az\n"
    )
    path = written(tmp_path, head + columns(TIME, A, B, C))
    check(path, B, component="Ay", unit="gal")
    # With semicolons between the columns, the first name may be left out.
    rows = (f"{i};{a:.3f};{b:.3f}\n" for i, (a, b) in enumerate(zip(A, B, strict=True)))
    path = written(tmp_path, "fs = 200 Hz\n;North (gal);East (gal)\n" + "".join(rows))
    check(path, B, component="East")


def test_a_column_without_values_is_no_component(tmp_path):
    rows = "".join(f"{t:.3f},,{a:.3f}\n" for t, a in zip(TIME, A, strict=True))
    check(written(tmp_path, "Time (s),North (gal),East (gal)\n" + rows))


def test_a_missing_value_is_shown_with_its_column(tmp_path):
    text = columns(TIME, A, B).replace(f"0.500,{A[100]:.3f}", "0.500,", 1)
    path = written(tmp_path, "Time (s),North (gal),East (gal)\n" + text)
    with pytest.raises(vi.InputError, match="line 102, column 'North': a value is missing"):
        vi.Record.read(path, "North")


def test_brackets_of_full_width(tmp_path):
    text = columns(1e3 * TIME, A)
    check(written(tmp_path, "时间（ms）,加速度（gal）\n" + text))


@pytest.mark.parametrize(
    ("head", "mark"),
    [("acceleration in gal\nNPTS = 400, DT = 0.005\n", " "),
     ("Time (s), Acc (gal)\nNPTS = 400\n", ","), ("acceleration in gal\nNPTS = 400\n", ", ")],
)  # fmt: skip
def test_a_count_above_as_many_rows_of_columns_is_no_file_of_peer(tmp_path, head, mark):
    check(written(tmp_path, head + columns(TIME, A, mark=mark)))
    text = f"acceleration in gal, dt = 0.005\nN-S E-W U-D\nNPTS = 400\n{columns(A, B, C, mark=' ')}"
    check(written(tmp_path, text), B, component="2")
