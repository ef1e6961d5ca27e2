"""Text tables of loggers and networks as measurements: what is stated is used."""

from __future__ import annotations

from datetime import datetime, timedelta

import numpy as np
import pytest

import vibroimpact as vi

pytestmark = pytest.mark.filterwarnings("ignore::vibroimpact.InputWarning")

G = 9.80665
TIME = 0.005 * np.arange(200)
A, B, C = (np.round(np.sin(rate * TIME + 0.1), 4) for rate in (9.0, 7.0, 5.0))


def table(head: str, *values, mark: str = ",") -> str:
    rows = zip(*values, strict=True)
    return head + "".join(mark.join(f"{one:.4f}" for one in row) + "\n" for row in rows)


def read(tmp_path, text: str, encoding: str = "utf-8", **said):
    path = tmp_path / "test.csv"
    path.write_bytes(text.encode(encoding))
    return vi.read_measurement(path, **said)


@pytest.mark.parametrize(
    "name",
    ["Acceleration X (g)", "Accelerometer X (g)", "accelX (g)", "accX_g", "ax (g)", "a_x [g]",
     "X (g)", "Z [g]", "Linear Acceleration x (g)", "AccX, g"],
)  # fmt: skip
def test_an_acceleration_along_an_axis_is_no_displacement(tmp_path, name):
    name = f'"{name}"'
    data = read(tmp_path, table(f"Time (s),{name}\n", TIME, A))
    np.testing.assert_allclose(data["acceleration"], A * G, rtol=1e-12)
    assert data.attrs["notes"] == ""


@pytest.mark.parametrize(
    ("name", "unit", "variable"),
    [("Force X", "N", "contact_force"), ("Velocity X", "m/s", "velocity"),
     ("X", "m", "displacement"), ("vx", "m/s", "velocity"), ("ux", "m", "displacement"),
     ("disp_x", "m", "displacement"),
     ("Table accel X", "m/s^2", "base_acceleration"), ("table x", "m", "base_displacement")],
)  # fmt: skip
def test_other_quantities_along_an_axis(tmp_path, name, unit, variable):
    data = read(tmp_path, table(f"Time (s),{name} ({unit})\n", TIME, A))
    np.testing.assert_allclose(data[variable], A, rtol=1e-12)


@pytest.mark.parametrize(
    "name", ["gyroX", "Gyro X", "Angular velocity X", "Temp X", "Y", "strain x"]
)
def test_what_is_no_linear_motion_is_left_out(tmp_path, name):
    data = read(tmp_path, table(f"Time (s),{name},acc (g)\n", TIME, B, A))
    assert data.attrs["left_out"] == name
    assert list(data) == ["acceleration"]


def test_a_second_column_of_a_quantity_is_named(tmp_path):
    text = table("Time (s),accelX,accelY\n", TIME, A, B)
    with pytest.raises(vi.InputError, match=r"states no unit of 'accelX'; pass it, such as units="):
        read(tmp_path, text)
    data = read(tmp_path, text, units={"acceleration": "g"})
    np.testing.assert_allclose(data["acceleration"], A * G, rtol=1e-12)
    assert (
        "columns of a quantity that another column has were left out: accelY"
        in (data.attrs["notes"])
    )
    both = read(
        tmp_path,
        text,
        columns={"base_acceleration": "accelY"},
        units={"accelX": "g", "accelY": "m/s^2"},
    )
    np.testing.assert_allclose(both["base_acceleration"], B, rtol=1e-12)


@pytest.mark.parametrize(
    "head",
    [
        "# Sample rate: 200 Hz\n# unit: gal\nbase acc,acc\n",
        "Sample rate,200,Hz\nSamples,200\nbase acc (gal),acc (gal)\n",
        "Sample rate;200\n\nbase acc (gal);acc (gal)\n",
        "#AmplitudeUnit:  gal\n! dt = 5 ms\nbase_acc\tacc\n",
        "(gal)\nSAMPLING INTERVAL (sec) : 0.005\nbase acc,acc\n",
    ],
)
def test_units_and_rates_above_the_table(tmp_path, head):
    mark = ";" if ";" in head else "\t" if "\t" in head else ","
    data = read(tmp_path, table(head, B, A, mark=mark))
    np.testing.assert_allclose(data["acceleration"], 0.01 * A, rtol=1e-12)
    np.testing.assert_allclose(data["base_acceleration"], 0.01 * B, rtol=1e-12)
    np.testing.assert_allclose(data["time"], TIME, atol=1e-12)
    assert data.attrs["left_out"] == ""


def test_components_of_a_network_are_named_by_the_user(tmp_path):
    text = table(
        "#AmplitudeUnit:  gal\n#SampleRate(Hz): 200\nTime U N E\n", TIME, A, B, C, mark=" "
    )
    with pytest.raises(vi.InputError, match="'U' is not understood, 'N' is not understood"):
        read(tmp_path, text)
    data = read(tmp_path, text, columns={"base_acceleration": "N"})
    np.testing.assert_allclose(data["base_acceleration"], 0.01 * B, rtol=1e-12)


@pytest.mark.parametrize(
    ("name", "unit", "variable"),
    [("Beschleunigung", "m/s²", "acceleration"),
     ("Tischbeschleunigung", "m/s²", "base_acceleration"),
     ("Weg", "m", "displacement"), ("Verschiebung", "m", "displacement"),
     ("Relativverschiebung", "m", "displacement"), ("Auslenkung", "m", "displacement"),
     ("Geschwindigkeit", "m/s", "velocity"), ("Kraft", "N", "contact_force"),
     ("Anschlagkraft", "N", "contact_force"), ("Accélération", "m/s²", "acceleration"),
     ("Déplacement", "m", "displacement"), ("Aceleración", "m/s²", "acceleration"),
     ("Spostamento", "m", "displacement"), ("Accelerazione base", "m/s²", "base_acceleration")],
)  # fmt: skip
@pytest.mark.parametrize("encoding", ["utf-8", "latin-1", "utf-16"])
def test_names_in_other_languages(tmp_path, name, unit, variable, encoding):
    rows = zip(TIME, A, strict=True)
    text = "".join(f"{t:.4f};{a:.4f}\n".replace(".", ",") for t, a in rows)
    data = read(tmp_path, f"Zeit [s];{name} [{unit}]\n" + text, encoding)
    np.testing.assert_allclose(data[variable], A, rtol=1e-12)


def test_a_column_that_is_not_understood_is_proposed_for_a_quantity_of_its_unit(tmp_path):
    text = table("Time (s),ai0 (g),ai1 (mm)\n", TIME, A, B)
    with pytest.raises(vi.InputError, match=r"columns=\{'acceleration': 'ai0'\}") as refused:
        read(tmp_path, text)
    assert str(refused.value).count("'ai0' is not understood") == 1
    data = read(tmp_path, text, columns={"acceleration": "ai0"})
    np.testing.assert_allclose(data["acceleration"], A * G, rtol=1e-12)


def test_resonance_curves_in_german(tmp_path):
    rows = [(f, way) for way in ("aufwärts", "abwärts") for f in (1.0, 1.5, 2.0)]
    text = "".join(f"{f};{way};{i}.5;{i}\n".replace(".", ",") for i, (f, way) in enumerate(rows, 1))
    head = "Frequenz [Hz];Richtung;Weg Spitze-Spitze [mm];Beschleunigung pp [m/s²]\n"
    data = read(tmp_path, head + text, "latin-1")
    np.testing.assert_allclose(
        data["displacement_excursion"].sel(direction="backward"), [0.0045, 0.0055, 0.0065]
    )
    np.testing.assert_allclose(data["acceleration_excursion"].sel(direction="forward"), [1, 2, 3])


def test_a_unit_of_the_file_that_cannot_be_used_is_replaced_by_that_of_the_user(tmp_path):
    text = table("Time (s),acc (V)\n", TIME, A)
    with pytest.raises(vi.InputError, match=r"'1 V' is not.*pass the right one as units=\{'acc'"):
        read(tmp_path, text)
    np.testing.assert_allclose(read(tmp_path, text, units={"acc": "g"})["acceleration"], A * G)
    path = tmp_path / "test.csv"
    with pytest.raises(vi.InputError, match=r"'1 V' is not.*pass the right one as unit="):
        vi.Record.read(path)
    np.testing.assert_allclose(vi.Record.read(path, unit="g").acceleration, A * G)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("Samples: 300", "line 1: the file announces 300 values, but 200 follow"),
        ("fs = 100", "states 'fs = 100', a step of 0.01 s, but the times have steps of 0.005 s"),
        ("Duration: 20 s", "'Duration: 20 s', but 200 samples in steps of 0.005 s last 0.995 s"),
        ("acc_unit: gal", "the file states the units 'g' and 'gal'"),
        ("AmplitudeUnit: gal", "the file states the units 'g' and 'gal'"),
    ],
)  # fmt: skip
def test_a_statement_that_the_values_contradict_is_refused_with_both(tmp_path, line, message):
    with pytest.raises(vi.InputError) as error:
        read(tmp_path, table(f"# {line}\nTime (s),acc (g)\n", TIME, A))
    assert message in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("form", "mark", "name"),
    [
        ("%Y-%m-%d %H:%M:%S.%f", ",", "Timestamp"),
        ("%Y-%m-%dT%H:%M:%S.%f", ";", "anything"),
        ("%d.%m.%Y %H:%M:%S,%f", ";", "Zeitpunkt"),
        ("%d/%m/%Y,%H:%M:%S.%f", ",", "Date,Time"),
        ("%H:%M:%S.%f", "\t", "Time"),
    ],
)
def test_date_stamps_of_loggers(tmp_path, form, mark, name):
    start = datetime(2024, 4, 30, 23, 59, 59, 500000)
    rows = "".join(
        f"{(start + timedelta(milliseconds=5 * i)).strftime(form)[:-3]}{mark}{a:.4f}\n"
        for i, a in enumerate(A)
    )
    head = f"Logger{mark}XYZ\nStart{mark}2024-04-30 23:59:59\n\n{name}{mark}acc (g)\n"
    data = read(tmp_path, head + rows)
    np.testing.assert_allclose(data["acceleration"], A * G, rtol=1e-12)
    np.testing.assert_allclose(data["time"], TIME, atol=1e-9)


def test_stamps_in_whole_seconds_need_a_rate(tmp_path):
    rows = "".join(
        f"2024-04-30 12:00:{int(t):02d},{a:.4f}\n" for t, a in zip(10 * TIME, A, strict=True)
    )
    with pytest.raises(
        vi.InputError, match=r"line 3: its time is that of the line above.* fs = 200"
    ):
        read(tmp_path, "Time,acc (g)\n" + rows)
    data = read(tmp_path, "# fs = 20 Hz\nTime,acc (g)\n" + rows)
    np.testing.assert_allclose(data["time"], 10 * TIME, atol=1e-9)
    assert "rounded, so the stated step of 0.05 s is used" in data.attrs["notes"]


@pytest.mark.parametrize(("name", "each"), [("time_us", 1e6), ("millis", 1e3), ("t_ns", 1e9)])
def test_units_of_times_in_names(tmp_path, name, each):
    data = read(tmp_path, table(f"{name},acc (g)\n", each * TIME, A))
    np.testing.assert_allclose(data["time"], TIME, rtol=1e-12, atol=1e-12)
