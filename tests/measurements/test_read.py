"""Files of tests become datasets; what is guessed is told, and nothing is lost."""

import sys

import h5py
import numpy as np
import pytest
import scipy.io

import vibroimpact as vi
from measured import measured
from vibroimpact.measurements.names import meaning

pytestmark = pytest.mark.filterwarnings("ignore::vibroimpact.InputWarning")
"""What is noted is tested in the attribute, and that it is a warning in test_notes.py."""


def written(folder, text, name="test.csv"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("name", "variable", "direction", "unit"),
    [
        ("f (Hz)", "frequency", None, "Hz"),
        ("f_kHz", "frequency", None, "kHz"),
        ("frequency rad/s", "frequency", None, "rad/s"),
        ("Ed_µm", "displacement_excursion", None, "µm"),
        ("a/g", "acceleration", None, "g"),
        ("a_g", "base_acceleration", None, None),
        ("Ea m/s²", "acceleration_excursion", None, "m/s^2"),
        ("Ea_m/s^2", "acceleration_excursion", None, "m/s^2"),
        ("v_mm/s", "velocity", None, "mm/s"),
        ("velocity m/s", "velocity", None, "m/s"),
        ("contact force kN", "contact_force", None, "kN"),
        ("Force_N", "contact_force", None, "N"),
        ("acc_mV", "acceleration", None, "mV"),
        ("displacement p-p", "displacement_excursion", None, None),
        ("Ed p-p", "displacement_excursion", None, None),
        ("Acceleration Pk-Pk", "acceleration_excursion", None, None),
        ("disp p2p mm", "displacement_excursion", None, "mm"),
        ("Ed", "displacement_excursion", None, None),
        ("E_d forward", "displacement_excursion", "forward", None),
        ("Ed_up_mm", "displacement_excursion", "forward", "mm"),
        ("ea_g", "acceleration_excursion", None, "g"),
        ("Ea (f)", "acceleration_excursion", "forward", None),
        ("umin_mm", "displacement_min", None, "mm"),
        ("η_d backward", "eta_d", "backward", None),
        ("Table acceleration", "base_acceleration", None, None),
        ("mass displacement", "mass_displacement", None, None),
        ("peak-to-peak displacement", "displacement_excursion", None, None),
        ("Time", "time", None, None),
    ],
)
def test_what_a_name_says(name, variable, direction, unit):
    column = meaning(name)
    assert (column.variable, column.direction, column.unit) == (variable, direction, unit)


@pytest.mark.parametrize(
    ("name", "size"),
    [
        *((name, 1.0) for name in ("f_Hz", "f/Hz", "frequency Hz", "Frequency_Hz", "f_hz")),
        *((name, 1.0) for name in ("f (hz)", "f (HZ)", "Freq [Hz]", "FREQUENCY_HZ", "f (1/s)")),
        *((name, 1e3) for name in ("f_kHz", "f (khz)", "f/kHz", "f (KHZ)")),
        *((name, 1.0 / 60.0) for name in ("f (rpm)", "f (RPM)", "f_rpm")),
    ],
)
def test_units_of_a_frequency_in_any_capitals(tmp_path, name, size):
    data = vi.read_measurement(written(tmp_path, f"{name},Ed (mm)\n1.5,2\n"))
    assert data.frequency.values == pytest.approx([1.5 * size])


@pytest.mark.parametrize(
    ("name", "size"),
    [
        *((name, 1e-3) for name in ("u (mm)", "u (MM)", "u_mm", "u/mm")),
        *((name, 1e-2) for name in ("u (cm)", "u (Cm)", "u_cm")),
        *((name, 1e-6) for name in ("u (µm)", "u_µm", "u_um")),
        *((name, 9.80665) for name in ("acc (g)", "acc (G)", "acc_g", "a/g")),
        *((name, 9.80665e-3) for name in ("acc (mg)", "acc (MG)")),
        *((name, 1.0) for name in ("acc (m/s2)", "acc (M/S^2)", "acc (ms-2)", "acc m/s²")),
        *((name, 1e3) for name in ("force (kN)", "force (KN)", "force (kn)", "force_kN")),
        *((name, 1.0) for name in ("force (N)", "force (n)", "force_N")),
        *((name, size) for name, size in (("force (MN)", 1e6), ("force (mN)", 1e-3))),
    ],
)
def test_units_of_a_history_in_any_capitals(tmp_path, name, size):
    data = vi.read_measurement(written(tmp_path, f"Time (S),{name}\n0,2\n1,3\n"))
    (channel,) = data.data_vars
    assert data[channel].values == pytest.approx([2.0 * size, 3.0 * size])


def test_a_line_of_units_in_any_capitals(tmp_path):
    data = vi.read_measurement(written(tmp_path, "f,Ed\nkHz,CM\n0.002,1\n"))
    assert data.frequency.values == pytest.approx([2.0])
    assert data.displacement_excursion.values.ravel() == pytest.approx([0.01])


def test_a_name_that_says_nothing():
    assert meaning("Temperature") is None


def test_units_repeats_gaps_and_rows_without_a_frequency_are_told(tmp_path):
    path = written(
        tmp_path,
        "Test 3\nfreq,Ed,Ea,dir,remark\nHz,mm,g,,\n3,5,.2,up,1\n1,10,0.1,up,1\n2,20,nan,up,1\n"
        "2,8,.3,down,1\n2,8.1,.3,down,1\n,3,2,up,1\n",
    )
    data = vi.read_measurement(path)
    assert data.displacement_excursion.dims == ("direction", "frequency", "repeat")
    assert data.displacement_excursion.sel(direction="forward")[:, 0].values == pytest.approx(
        [0.010, 0.020, 0.005]
    )
    assert data.displacement_excursion.sel(direction="backward", frequency=2).values == (
        pytest.approx([0.008, 0.0081])
    )
    assert data.acceleration_excursion.sel(direction="forward").values[0, 0] == pytest.approx(
        0.980665
    )
    notes = data.attrs["notes"].splitlines()
    assert "rows without a frequency were left out: 1 (line 9)" in notes
    assert "missing values: 1" in notes
    assert any("measured up to 2 times" in note for note in notes)
    assert data.attrs["left_out"] == "remark"


def test_decimal_commas_and_an_amplitude_beside_the_numbers(tmp_path):
    path = written(tmp_path, "# amplitude = 0.05 g\nf (Hz);Ed up [mm];Ed down [mm]\n1,5;2,5;3\n")
    data = vi.read_measurement(path)
    assert data.attrs["amplitude"] == 0.05 * 9.80665
    assert data.displacement_excursion.values.ravel() == pytest.approx([0.0025, 0.003])


@pytest.mark.parametrize(
    ("said", "mark", "amplitude"),
    [
        ("# amplitude = 0,04 g", ";", 0.04 * 9.80665),
        ("# amplitude = 0.04 g", ";", 0.04 * 9.80665),
        ("amplitude;0,04 g", ";", 0.04 * 9.80665),
        ("# amplitude (m/s²): 0,392", "\t", 0.392),
        ("# amplitude = 1,000 g", ";", 9.80665),
        ("# amplitude = 0,04 g", ",", 0.04 * 9.80665),
    ],
)
def test_an_amplitude_with_a_decimal_comma(tmp_path, said, mark, amplitude):
    path = written(tmp_path, f"{said}\nf_Hz{mark}Ed_mm\n1{mark}2\n")
    assert vi.read_measurement(path).attrs["amplitude"] == pytest.approx(amplitude)


@pytest.mark.parametrize(
    ("said", "amplitude", "note"),
    [
        ("Amplitude;0,04 g", 0.392266, ""),
        ("# amplitude_g = 0.04", 0.392266, ""),
        ("# amplitude (m/s²) = 0.4", 0.4, ""),
        ("# Amplitude [g]: 0,04", 0.392266, ""),
        ("# amplitude;0.04 g", 0.392266, ""),
        ("# amplitude_g = 0.04 g", 0.392266, ""),
        ("# A_g = 0.04", None, "columns were not understood and were left out: A_g = 0.04"),
        ("# peak; 4 mm", None, "columns were not understood and were left out: peak = 4 mm"),
        ("# Date: 2024-05-01\n# at 12:30\n# table peak 0.04 g\n# by: us", None, ""),
    ],
)
def test_numbers_beside_the_columns_are_read_or_told(tmp_path, said, amplitude, note):
    path = written(tmp_path, f"{said}\nf (Hz);direction;Ed (mm)\n1;up;2\n2;down;3\n")
    data = vi.read_measurement(path)
    assert data.attrs.get("amplitude") == (amplitude and pytest.approx(amplitude))
    assert data.attrs.get("amplitude_source") == (amplitude and "test.csv")
    assert data.attrs["notes"].endswith(note)
    assert bool(data.attrs["notes"]) == bool(note)
    data = vi.read_measurement(path, amplitude="0.05 g")
    assert data.attrs["amplitude"] == pytest.approx(0.4903325)
    assert data.attrs["amplitude_source"] == "the call"


def test_an_amplitude_without_a_unit_is_refused(tmp_path):
    path = written(tmp_path, "# amplitude = 0.04\nf (Hz);direction;Ed (mm)\n1;up;2\n2;down;3\n")
    scipy.io.savemat(tmp_path / "a.mat", {"f_Hz": [1.0, 2.0], "Ed_mm": [1.0, 2], "amplitude": 0.04})
    for file in (path, tmp_path / "a.mat"):
        with pytest.raises(vi.InputError, match=r"amplitude = 0\.04 has no unit; pass amplitude= "):
            vi.read_measurement(file)
        data = vi.read_measurement(file, amplitude="0.04 g")
        assert data.attrs["amplitude"] == pytest.approx(0.392266)


@pytest.mark.parametrize("group", ["", "test"])
@pytest.mark.parametrize(
    ("beside", "amplitude", "note"),
    [
        ({"amplitude_g": 0.04}, 0.392266, ""),
        ({"amplitude": "0.04 g"}, 0.392266, ""),
        ({"A_g": 0.04, "name": "B2"}, None, "left out: A_g = 0.04"),
    ],
)
def test_numbers_beside_the_vectors_of_matlab(tmp_path, group, beside, amplitude, note):
    record = {"f_Hz": [1.0, 2.0, 3.0], "Ed_mm": [1.0, 2.0, 3.0], **beside}
    scipy.io.savemat(tmp_path / "test.mat", {group: record} if group else record)
    data = vi.read_measurement(tmp_path / "test.mat")
    assert data.attrs.get("amplitude") == (amplitude and pytest.approx(amplitude))
    assert note in data.attrs["notes"]
    assert ("entries outside the columns" in data.attrs["notes"]) == (amplitude is None)


def test_numbers_and_letters_beside_the_vectors_of_hdf5(tmp_path):
    letters = np.array([[ord(letter)] for letter in "0.04 g"], dtype="uint16")
    for name, value, mark in (
        ("units.h5", 0.04, {"units": "g"}),
        ("letters.h5", letters, {"MATLAB_class": np.bytes_("char")}),
    ):
        with h5py.File(tmp_path / name, "w") as file:
            file["f_Hz"], file["Ed_mm"] = [1.0, 2.0], [3.0, 4.0]
            file["amplitude"] = value
            file["amplitude"].attrs.update(mark)
            file.attrs.update({"A_g": 0.04, "creator": "logger", "MATLAB_int_decode": 2})
        data = vi.read_measurement(tmp_path / name)
        assert data.attrs["amplitude"] == pytest.approx(0.392266)
        assert data.attrs["notes"].endswith(
            "columns were not understood and were left out: A_g = 0.04"
        )


def test_a_folder_is_no_file(tmp_path):
    with pytest.raises(vi.InputError, match="is a folder; pass the path of a file"):
        vi.read_measurement(tmp_path)


def test_a_comma_that_may_part_thousands_is_refused(tmp_path):
    with pytest.raises(vi.InputError, match="'1,000 mg' has a comma; write a decimal point"):
        vi.read_measurement(written(tmp_path, "# amplitude = 1,000 mg\nf_Hz,Ed_mm\n1,2\n"))


@pytest.mark.parametrize(
    ("rows", "directions", "note"),
    [
        ("1,10\n2,20\n3,5\n", ["forward"], "forward was assumed"),
        ("3,5\n2,20\n1,10\n", ["backward"], "backward was assumed"),
        ("1,10\n2,20\n3,5\n2,3\n1,2\n", ["forward", "backward"], "backward from line 5"),
        ("1,10\n", ["forward"], "only one frequency"),
    ],
)
def test_a_direction_that_no_column_tells(tmp_path, rows, directions, note):
    data = vi.read_measurement(written(tmp_path, "f (Hz),Ed (mm)\n" + rows))
    assert data.direction.values.tolist() == directions
    assert note in data.attrs["notes"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("f,Ed (mm)\n1,2\n3,4\n2,3\n5,6\n", "direction='forward'"),
        ("f,Ed\n1,2\n3,4\n", "states no unit of 'Ed'; pass it, such as units={'Ed': 'mm'} (--u"),
        ("f,Ed\n1,2\n2,x\n3,4\n4,5\n", "line 3, column 'Ed': 'x' is not a number"),
        (
            "b,c\n1,2\n",
            "'b' is not understood, 'c' is not understood; the frequency or the time, and",
        ),
        ("b,c\n1,2\n", "columns={'frequency': 'b', 'displacement_excursion': 'c'}"),
        (
            "f,ch 3\n1,2\n",
            "'f' is read as frequency, 'ch 3' is not understood; the measured quantity",
        ),
        (
            "f,ch 3\n1,2\n",
            "columns={'displacement_excursion': 'ch 3'} (--columns displacement-excursion 'ch 3')",
        ),
        ("f,u (mm)\n1,2\n", "'u' is read as displacement; the measured quantity is missing"),
        ("f,u (mm)\n1,2\n", "columns={'displacement_excursion': 'u'}"),
        ("drive,Ed\n1,2\n", "as in columns={'frequency': 'drive'}"),
        ("time,ch 3\n1,2\n", "as in columns={'displacement': 'ch 3'}"),
        (
            "u,a\n1,2\n",
            "the time, or a sampling rate fs, is missing, so name the column as in columns={'time'",
        ),
        ("f,Ea (mV)\n1,2\n", "'1 mV' is not an acceleration"),
        ("", "is empty"),
        ("1,2\n2,3\n", "does not name its 2 columns"),
        ("f,Ed (kg)\n1,2\n", "is a mass"),
        ("f,Ed (mm),dir\n1,2,sideways\n", "the direction 'sideways'"),
        ("f,Ed\n1,2\n2,3,4\n", "line 3: the row has 3 numbers, but the rows above have 2"),
        ("f,Ed (mm)\n1,nan\n", "no row has both a frequency greater than 0 and a measured value"),
        ("time,u (mm)\n1,2\n1,3\n", "occurs twice"),
    ],
)
def test_what_cannot_be_read_is_refused_with_its_place(tmp_path, text, message):
    with pytest.raises(vi.InputError) as error:
        vi.read_measurement(written(tmp_path, text))
    assert message in str(error.value)
    assert "\n" not in str(error.value)


def test_columns_and_units_that_are_said(tmp_path):
    path = written(tmp_path, "one,two,three\n1,5,2\n2,6,3\n")
    data = vi.read_measurement(
        path,
        columns={"frequency": "one", "displacement_excursion_backward": "two"},
        units={"two": "cm"},
        amplitude="0.03 g",
    )
    assert data.displacement_excursion.sel(direction="backward").values.tolist() == [0.05, 0.06]
    assert data.attrs["amplitude"] == pytest.approx(0.03 * 9.80665)
    with pytest.raises(
        vi.InputError, match="columns: 'frequenzy' is unknown; did you mean frequency"
    ):
        vi.read_measurement(path, columns={"frequenzy": "one"})
    with pytest.raises(vi.InputError, match="is not a column"):
        vi.read_measurement(path, columns={"frequency": "four"})


def channels():
    time = np.linspace(0.0, 1.0, 11)
    return time, 0.01 * time, 2.0 * time


def test_matlab(tmp_path):
    time, u, base = channels()
    record = {"time": time, "u": u, "ag": base, "amplitude": "0.05 g"}
    scipy.io.savemat(tmp_path / "a.mat", {"test1": record})
    data = vi.read_measurement(tmp_path / "a.mat", units={"u": "m", "ag": "m/s^2"})
    assert data.displacement.values == pytest.approx(u)
    assert data.base_acceleration.values == pytest.approx(base)
    assert data.attrs["amplitude"] == pytest.approx(0.4903325)


def test_hdf5_with_units_and_absolute_displacements(tmp_path):
    time, u, base = channels()
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["time"], file["table_acc"] = time, base
        file["table_acc"].attrs["units"] = "g"
        file["mass displacement"], file["base displacement"] = 3.0 * u, u
        file["mass displacement"].attrs["units"] = file["base displacement"].attrs["units"] = "m"
    data = vi.read_measurement(tmp_path / "a.h5")
    assert data.displacement.values == pytest.approx(2.0 * u)
    assert data.base_acceleration.values == pytest.approx(9.80665 * base)


def test_universal_file(tmp_path):
    pyuff = pytest.importorskip("pyuff")
    time, u, base = channels()
    file = pyuff.UFF(str(tmp_path / "a.uff"))
    for name, values, unit in (("displacement", u, "m"), ("table acc", base, "m/s^2")):
        one = pyuff.prepare_58(
            binary=0, func_type=1, rsp_node=1, rsp_dir=3, ref_dir=3, ref_node=0, data=values,
            x=time, id1=name, rsp_ent_name="rsp", ref_ent_name="ref", abscissa_spacing=1,
            abscissa_spec_data_type=17, ordinate_spec_data_type=8, orddenom_spec_data_type=0,
            ordinate_axis_units_lab=unit,
        )  # fmt: skip
        file.write_sets(one, "add")
    data = vi.read_measurement(tmp_path / "a.uff")
    assert data.displacement.values == pytest.approx(u)
    assert data.base_acceleration.values == pytest.approx(base)


def test_tdms(tmp_path):
    nptdms = pytest.importorskip("nptdms")
    time, u, base = channels()
    timed = {"wf_increment": 0.1, "wf_start_offset": 0.0, "wf_samples": len(time)}
    some = [
        nptdms.ChannelObject("run", "displacement", u, {**timed, "unit_string": "m"}),
        nptdms.ChannelObject("run", "base acceleration", base, {**timed, "unit_string": "g"}),
    ]
    with nptdms.TdmsWriter(str(tmp_path / "a.tdms")) as writer:
        writer.write_segment(some)
    data = vi.read_measurement(tmp_path / "a.tdms")
    assert data.time.values == pytest.approx(time)
    assert data.displacement.values == pytest.approx(u)
    assert data.base_acceleration.values == pytest.approx(9.80665 * base)


def test_a_library_that_is_absent_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "nptdms", None)
    with pytest.raises(vi.InputError, match="pip install nptdms"):
        vi.read_measurement(written(tmp_path, "TDSm", "a.tdms"))


@pytest.mark.parametrize("ending", ["mat", "h5", "tdms", "uff"])
def test_a_damaged_file_is_refused(tmp_path, ending):
    with pytest.raises(vi.InputError, match=r"damaged|holds no columns"):
        vi.read_measurement(written(tmp_path, "no such file", f"a.{ending}"))


def test_runs_of_one_file():
    path = measured("pad_impacts/pad_40mm.csv")
    with pytest.raises(vi.InputError, match="'Run 1', 'Run 2'"):
        vi.read_measurement(path)
    data = vi.read_measurement(path, group="Run 2")
    assert data.contact_force.notnull().all()
    assert "displacement is missing at 375 of 500 times" in data.attrs["notes"]
