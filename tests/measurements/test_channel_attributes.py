"""Units, scales, steps and holes that binary files state are used; what is damaged is refused."""

from __future__ import annotations

import os
import random
import zlib
from pathlib import Path

import h5py
import numpy as np
import pytest
import scipy.io
import scipy.sparse

import vibroimpact as vi
from samples import sample

pytestmark = pytest.mark.filterwarnings("ignore::vibroimpact.InputWarning")
"""What is noted is tested in the attribute, and that it is a warning in test_notes.py."""

TIME = 0.004 * np.arange(250)
U = np.sin(20.0 * TIME)
CUTS = sample(60, 12)


def hdf5(path: Path, time_unit: str | None = "s", **about) -> Path:
    """A displacement with attributes, beside its times."""
    with h5py.File(path, "w") as file:
        file["time"], file["displacement"] = TIME, U
        file["time"].attrs["units"] = "s"
        file["displacement"].attrs.update(about)
    return path


@pytest.mark.parametrize("key", ["units", "UNITS", "Unit", "Einheit", "NI_UnitDescription"])
def test_a_unit_under_any_usual_name(tmp_path, key):
    data = vi.read_measurement(hdf5(tmp_path / "a.h5", **{key: "mm"}))
    np.testing.assert_allclose(data["displacement"], 1e-3 * U, rtol=1e-12)
    assert data.attrs["notes"] == ""


def test_scales_and_absent_values_of_hdf5(tmp_path):
    about = {"units": "m", "scale_factor": 0.01, "add_offset": 0.5, "_FillValue": U[7]}
    data = vi.read_measurement(hdf5(tmp_path / "a.h5", **about, missing_value=U[9]))
    expected = 0.01 * U + 0.5
    expected[[7, 9]] = np.nan
    np.testing.assert_allclose(data["displacement"], expected, rtol=1e-12)


@pytest.mark.parametrize(
    ("about", "message"),
    [
        ({"units": 3}, "states units = 3, which is not a unit"),
        ({"units": "furlong-ish"}, "a unit that"),
        ({"units": "mm", "scale": "twice"}, "states scale = 'twice', which is not a scale"),
        ({"units": "mm", "scale_factor": [1.0, 2.0]}, r"scale_factor = \[1.0, 2.0\], which is no"),
        (
            {"units": "mm", "scale": 2.0, "scale_factor": 3.0},
            "scale_factor = 3.0 in addition to the",
        ),
        ({"units": ["mm", "s"]}, r"states units = \['mm', 's'\], which is not a unit"),
        ({"units": "mm", "unit": "m"}, "in addition to the unit 'm'"),
        *(
            ({"units": "mm", name: 0.5}, f"states {name} = 0.5, which may have been applied")
            for name in ("gain", "Sensitivity", "offset", "full_scale", "cal_factor", "pre_gain")
        ),
        ({"units": "mm", "sensitivity": "100 mV/g"}, "'100 mV/g', which may have been applied"),
    ],
)
def test_what_looks_like_a_unit_or_scale_and_is_none_is_refused(tmp_path, about, message):
    path = hdf5(tmp_path / "a.h5", **about)
    with pytest.raises(vi.InputError, match=message) as refused:
        vi.read_measurement(path)
    assert "\n" not in str(refused.value)
    data = vi.read_measurement(path, units={"displacement": "cm"})
    factor = about.get("scale") if about.get("scale") == 2.0 else 1.0
    np.testing.assert_allclose(data["displacement"], 1e-2 * factor * U, rtol=1e-12)


def test_what_changes_no_value_is_no_scale(tmp_path):
    about = {"gain": 1.0, "offset": 0, "calibration_date": "2024-05-01", "unit_under_test": "B2",
             "units": "mm", "unit": "millimeter", "calibration_due": 2025}  # fmt: skip
    data = vi.read_measurement(hdf5(tmp_path / "a.h5", **about))
    np.testing.assert_allclose(data["displacement"], 1e-3 * U, rtol=1e-12)


def beside(path: Path, where: str, name: str, value) -> Path:
    """A displacement in mm beside which something is stated, in any format."""
    counts = np.round(1000.0 * U)
    if where.startswith("mat"):
        about = {"values": counts, "units": "mm", name: value}
        record = {"time": TIME, "displacement": counts, "units": "mm", name: value}
        signal = {"time": TIME, "displacement": {"name": "displacement", **about}}
        variables = {"mat": record, "mat struct": {"run": record}, "mat signal": signal}[where]
        scipy.io.savemat(path := path / "a.mat", variables)
    elif where.startswith("h5"):
        with h5py.File(path := path / "a.h5", "w") as file:
            group = file.create_group("run") if where == "h5 group" else file
            group["time"], group["displacement"] = TIME, counts
            group["displacement"].attrs["units"] = "mm"
            if where == "h5 beside":
                group[name] = value
            else:
                group.attrs[name] = value
    elif where.startswith("tdms"):
        nptdms = pytest.importorskip("nptdms")
        about = {"wf_increment": 0.004, "unit_string": "mm"}
        extra = {where.removeprefix("tdms "): {name: value}}
        with nptdms.TdmsWriter(str(path := path / "a.tdms")) as file:
            file.write_segment([
                nptdms.RootObject(extra.get("root", {})),
                nptdms.GroupObject("run", extra.get("group", {})),
                nptdms.ChannelObject("run", "displacement", counts, about | extra.get("own", {})),
            ])  # fmt: skip
    else:
        rows = "\n".join(f"{t},{u}" for t, u in zip(TIME, counts, strict=True))
        path = path / "a.csv"
        path.write_text(f"# {name} = {value}\ntime (s),displacement (mm)\n{rows}\n")
    return path


PLACES = ["mat", "mat struct", "mat signal", "h5", "h5 group", "h5 beside",
          "tdms own", "tdms group", "tdms root", "csv"]  # fmt: skip


@pytest.mark.parametrize("where", PLACES)
def test_scales_are_used_wherever_they_are_stated(tmp_path, where):
    for name in ("scale", "scale_factor", "displacement_scale"):
        if where == "mat signal" and name == "displacement_scale":
            continue
        data = vi.read_measurement(beside(tmp_path, where, name, 0.25))
        np.testing.assert_allclose(data["displacement"], 0.25e-3 * np.round(1000.0 * U), atol=1e-15)
    for name, value in (("gain", 0.25), ("sensitivity", 0.25), ("scale", "log")):
        with pytest.raises(vi.InputError, match=f"'displacement': the file states {name} ="):
            vi.read_measurement(beside(tmp_path, where, name, value))


def test_a_scale_beside_several_channels_is_refused(tmp_path):
    path = tmp_path / "a.mat"
    scipy.io.savemat(path, {"time": TIME, "u_mm": U, "acceleration": U, "scale": 0.5})
    with pytest.raises(vi.InputError, match=r"scale = '0\.5', which belongs to one channel, but"):
        vi.read_measurement(path)
    scipy.io.savemat(path, {"time": TIME, "u_mm": U, "acceleration": U, "force_gain": 0.5})
    with pytest.raises(vi.InputError, match=r"force_gain = '0\.5', but there is no channel"):
        vi.read_measurement(path)


@pytest.mark.parametrize("name", ["UNITS", "Einheiten", "units"])
@pytest.mark.parametrize("ending", ["mat", "h5"])
def test_lists_of_units_that_belong_to_no_channel_are_refused(tmp_path, name, ending):
    path = tmp_path / f"a.{ending}"
    for unit_list in (["s", "mm"], ["s", "mm", "mm"]):
        variables = {"time": TIME, "u": U, name: np.array(unit_list, dtype=object)}
        if ending == "mat":
            scipy.io.savemat(path, variables)
        else:
            with h5py.File(path, "w") as file:
                for key, value in variables.items():
                    file[key] = value
        with pytest.raises(vi.InputError, match=f"the file states {name} = 's, mm"):
            vi.read_measurement(path)
        data = vi.read_measurement(path, units={"time": "s", "u": "mm"})
        np.testing.assert_allclose(data["displacement"], 1e-3 * U, rtol=1e-12)
    matrix = {"data": np.column_stack([TIME, U]), "names": np.array(["time", "u"], dtype=object)}
    path = tmp_path / "b.mat"
    scipy.io.savemat(path, {**matrix, name: np.array(["s", "mm", "mm"], dtype=object)})
    with pytest.raises(vi.InputError, match=f"the file states {name} = 's, mm, mm'"):
        vi.read_measurement(path)
    scipy.io.savemat(path, {**matrix, name: np.array(["s", "mm"], dtype=object)})
    np.testing.assert_allclose(vi.read_measurement(path)["displacement"], 1e-3 * U, rtol=1e-12)


def test_units_beside_the_columns_of_a_text(tmp_path):
    rows = "\n".join(f"{t},{u}" for t, u in zip(TIME, U, strict=True))
    for said in (
        "# units: s, mm\n",
        "# unit = mm\n",
        "# u_unit = mm\n",
        "# displacement units: mm\n",
    ):
        (tmp_path / "a.csv").write_text(f"{said}time,u\n{rows}\n")
        data = vi.read_measurement(tmp_path / "a.csv")
        np.testing.assert_allclose(data["displacement"], 1e-3 * U, rtol=1e-12)
    (tmp_path / "a.csv").write_text(f"# units: s, mm, g\ntime,u\n{rows}\n")
    with pytest.raises(vi.InputError, match="'s, mm, g'"):
        vi.read_measurement(tmp_path / "a.csv")


def test_units_of_steps_beside_the_channels(tmp_path):
    variables = {"u_mm": U, "dt": 4.0, "dt_unit": "ms"}
    for content in (variables, {"u_mm": U, "dt": 4.0, "time_unit": "ms"}):
        scipy.io.savemat(tmp_path / "a.mat", content)
        data = vi.read_measurement(tmp_path / "a.mat")
        np.testing.assert_allclose(data["time"], TIME, rtol=1e-12)
    scipy.io.savemat(tmp_path / "a.mat", {"u_mm": U, "dt": 0.004, "fs": 200.0})
    with pytest.raises(vi.InputError, match="state two different time steps"):
        vi.read_measurement(tmp_path / "a.mat")
    scipy.io.savemat(tmp_path / "a.mat", {"u_mm": U, "dt": 0.004, "fs": 250.0})
    np.testing.assert_allclose(vi.read_measurement(tmp_path / "a.mat")["time"], TIME, rtol=1e-12)


def test_units_of_a_compound_table(tmp_path):
    table = np.array(list(zip(TIME, U, strict=True)), dtype=[("time", "f8"), ("u", "f8")])
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["table"] = table
        file["table"].attrs["units"] = ["s", "mm"]
    data = vi.read_measurement(tmp_path / "a.h5")
    np.testing.assert_allclose(data["displacement"], 1e-3 * U, rtol=1e-12)


def test_a_step_of_its_own_for_each_dataset(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for name, dt in (("displacement", 0.004), ("base_acceleration", 0.002)):
            file[name] = U
            file[name].attrs.update(dt=dt, units="mm" if dt == 0.004 else "g")
    with pytest.raises(vi.InputError, match="holds 2 tests") as refused:
        vi.read_measurement(tmp_path / "a.h5")
    assert "(0.004 s from 0 s on)" in str(refused.value)
    data = vi.read_measurement(tmp_path / "a.h5", group="(0.002 s from 0 s on)")
    np.testing.assert_allclose(data["time"], 0.002 * np.arange(250), rtol=1e-12)


def test_data_outside_of_an_hdf5_file_are_refused(tmp_path):
    (tmp_path / "raw").write_bytes(U.tobytes())
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["time"] = TIME
        file.create_dataset("u", (250,), "f8", external=[(str(tmp_path / "raw"), 0, 2000)])
    with pytest.raises(vi.InputError, match="'u': its data are in other files"):
        vi.read_measurement(tmp_path / "a.h5")


def test_an_hdf5_file_that_announces_more_than_it_holds(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file.create_dataset("u", (2 * 10**9,), "f8", chunks=(1000,))
    assert (tmp_path / "a.h5").stat().st_size < 5000
    with pytest.raises(vi.InputError, match="has more than 256 MiB of data"):
        vi.read_measurement(tmp_path / "a.h5")


def test_matlab_groups_keep_their_own(tmp_path):
    runs = [{"time": TIME, "u_mm": U}, {"time": TIME, "u_mm": 2.0 * U}]
    nested = {"A": {"data_": runs[0]}, "B": {"data_": runs[1]}}
    for variables, names in (
        ({"runs": runs}, ["runs(1)", "runs(2)"]),
        (nested, ["A.data_", "B.data_"]),
    ):
        scipy.io.savemat(tmp_path / "a.mat", variables)
        for name, factor in zip(names, (1e-3, 2e-3), strict=True):
            data = vi.read_measurement(tmp_path / "a.mat", group=name)
            np.testing.assert_allclose(data["displacement"], factor * U, rtol=1e-12)


def test_structs_of_name_data_and_units(tmp_path):
    signals = [
        {"name": "time", "data": TIME, "units": "s"},
        {"name": "displacement", "data": U, "units": "mm"},
    ]
    scipy.io.savemat(tmp_path / "a.mat", {"signals": signals})
    data = vi.read_measurement(tmp_path / "a.mat")
    np.testing.assert_allclose(data["displacement"], 1e-3 * U, rtol=1e-12)
    variables = {"t": 1e3 * TIME, "t_unit": "ms", "u": U, "u_units": "cm"}
    scipy.io.savemat(tmp_path / "b.mat", variables)
    data = vi.read_measurement(tmp_path / "b.mat")
    np.testing.assert_allclose(data["time"], TIME, rtol=1e-12)
    np.testing.assert_allclose(data["displacement"], 1e-2 * U, rtol=1e-12)


def test_sparse_columns_are_read_and_complex_ones_named(tmp_path):
    sparse = scipy.sparse.csc_array(U[:, np.newaxis])
    variables = {"time": TIME, "u_mm": sparse, "acceleration": np.exp(1j * TIME)}
    scipy.io.savemat(tmp_path / "a.mat", variables)
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for name, values in {**variables, "u_mm": U}.items():
            file[name] = values
    for name in ("a.mat", "a.h5"):
        data = vi.read_measurement(tmp_path / name)
        np.testing.assert_allclose(data["displacement"], 1e-3 * U, rtol=1e-12)
        assert "left out: acceleration (complex numbers)" in data.attrs["notes"]


@pytest.mark.full
def test_a_matlab_file_that_unpacks_to_more_than_memory_holds(tmp_path):
    head = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"
    packed = zlib.compressobj(9)
    body = b"".join(packed.compress(bytes(2**20)) for _ in range(300)) + packed.flush()
    (tmp_path / "a.mat").write_bytes(head + np.array([15, len(body)], "<u4").tobytes() + body)
    with pytest.raises(vi.InputError, match="has more than 256 MiB of data"):
        vi.read_measurement(tmp_path / "a.mat")


def tdms(path: Path, *channels: tuple[str, np.ndarray, dict], group: str = "run") -> Path:
    nptdms = pytest.importorskip("nptdms")
    with nptdms.TdmsWriter(str(path)) as file:
        for name, values, about in channels:
            file.write_segment([nptdms.ChannelObject(group, name, values, properties=about)])
    return path


def test_channels_of_tdms_keep_their_own_times(tmp_path):
    path = tdms(
        tmp_path / "a.tdms",
        ("displacement", U, {"wf_increment": 0.004, "NI_UnitDescription": "mm"}),
        ("base_acceleration", np.tile(U, 4), {"wf_increment": 0.002, "unit_string": "g"}),
    )
    for group, step, count in (("run (0.004 s from 0 s on)", 0.004, 250),
                               ("run (0.002 s from 0 s on)", 0.002, 1000)):  # fmt: skip
        data = vi.read_measurement(path, group=group)
        np.testing.assert_allclose(data["time"], step * np.arange(count), rtol=1e-12)
    at = np.datetime64("2020-01-01T00:00:00")
    late = {"wf_increment": 4.0, "wf_xunit_string": "ms", "wf_start_offset": 0.0}
    path = tdms(
        tmp_path / "b.tdms",
        ("u_mm", U, late | {"wf_start_time": at}),
        ("acceleration_g", U, late | {"wf_start_time": at + np.timedelta64(500, "ms")}),
    )
    data = vi.read_measurement(path, group="run (0.004 s from 0.5 s on)")
    np.testing.assert_allclose(data["time"], 0.5 + TIME, rtol=1e-9)


def test_units_of_tdms_that_differ_are_refused(tmp_path):
    pair = {"wf_increment": 0.004, "NI_UnitDescription": "m", "unit_string": "mm"}
    for name, about in (("u", pair), ("u (mm)", {"wf_increment": 0.004, "unit_string": "m"})):
        path = tdms(tmp_path / "a.tdms", (name, U, about))
        with pytest.raises(vi.InputError, match=r"states (the units 'mm' and 'm'|unit_string = )"):
            vi.read_measurement(path)
    path = tdms(tmp_path / "a.tdms", ("u", U, pair | {"NI_UnitDescription": "Millimeter"}))
    with pytest.raises(vi.InputError, match="unit"):
        vi.read_measurement(path)
    path = tdms(tmp_path / "a.tdms", ("u", U, pair | {"NI_UnitDescription": "millimeter"}))
    np.testing.assert_allclose(vi.read_measurement(path)["displacement"], 1e-3 * U, rtol=1e-12)
    path = tdms(tmp_path / "a.tdms", ("u_mm", U, {"wf_increment": 0.004, "unit_string": "m"}))
    data = vi.read_measurement(path)
    np.testing.assert_allclose(data["displacement"], U, rtol=1e-12)
    assert "'u_mm' was read in m, although its name states mm" in data.attrs["notes"]


@pytest.mark.parametrize("name", ["displacement", "time"])
@pytest.mark.parametrize("about", [{"wf_increment": 0.004}, {}])
def test_an_empty_channel_hides_no_other(tmp_path, name, about):
    good = ("u_mm", U, {"wf_increment": 0.004})
    path = tdms(tmp_path / "a.tdms", (name, np.zeros(0), about), good)
    data = vi.read_measurement(path)
    np.testing.assert_allclose(data["displacement"], 1e-3 * U, rtol=1e-12)
    np.testing.assert_allclose(data["time"], TIME, rtol=1e-12)
    assert f"columns without values were left out: {name}" in data.attrs["notes"]


def test_names_of_files_steer_no_terminal(tmp_path):
    name = "disp\x1b[31m\n[x]\u2028_mm"
    spare = ("spare\x1b[2J\n|<b>", U, {"wf_increment": 0.004})
    path = tdms(tmp_path / "a.tdms", (name, U, {"wf_increment": 0.004}), spare, group="r\n\x07")
    data = vi.read_measurement(path)
    text = data.attrs["notes"] + data.attrs["left_out"]
    assert "spare" in text
    assert not any(letter < " " and letter != "\n" for letter in text)
    lines = (data.attrs["notes"] + "\n" + data.attrs["left_out"]).splitlines()
    begins = ("the time", "columns were not understood", "spare")
    assert all(line.startswith(begins) for line in lines)
    again = vi.read_measurement(path, columns={"acceleration": spare[0]}, units={spare[0]: "g"})
    np.testing.assert_allclose(again["acceleration"], 9.80665 * U, rtol=1e-12)


def uff(path: Path, *sets: dict) -> Path:
    pyuff = pytest.importorskip("pyuff")
    file = pyuff.UFF(str(path))
    for one in sets:
        file.write_sets(one, "add")
    return path


def function(kind: int, x: np.ndarray, y: np.ndarray, **about) -> dict:
    return {
        "type": 58, "func_type": 1, "rsp_node": 1, "rsp_dir": 1, "ref_node": 0, "ref_dir": 0,
        "data": y, "x": x, "id1": "", "rsp_ent_name": "NONE", "ref_ent_name": "NONE",
        "abscissa_spacing": 1, "abscissa_spec_data_type": 17, "ordinate_spec_data_type": kind,
        "orddenom_spec_data_type": 0, "binary": 0, **about,
    }  # fmt: skip


def test_units_of_universal_files(tmp_path):
    units = {"type": 164, "units_code": 9, "units_description": "mm", "temp_mode": 1,
             "length": 1000.0, "force": 1.0, "temp": 1.0, "temp_offset": 273.15}  # fmt: skip
    data = vi.read_measurement(uff(tmp_path / "a.uff", units, function(8, TIME, 1e3 * U)))
    np.testing.assert_allclose(data["displacement"], U, atol=1e-6)
    assert data.attrs["notes"] == ""
    path = uff(tmp_path / "b.uff", function(8, 1e3 * TIME, U, abscissa_axis_units_lab="ms",
                                            ordinate_axis_units_lab="mm"))  # fmt: skip
    data = vi.read_measurement(path)
    np.testing.assert_allclose(data["time"], TIME, atol=1e-6)
    np.testing.assert_allclose(data["displacement"], 1e-3 * U, atol=1e-8)
    path = uff(
        tmp_path / "c.uff",
        function(8, 60.0 * (1.0 + TIME), U, id1="displacement max (mm)",
                 abscissa_spec_data_type=18, abscissa_axis_units_lab="RPM"),
        function(12, 60.0 * (1.0 + TIME), np.exp(1j * TIME), id1="acceleration max (g)",
                 abscissa_spec_data_type=18, abscissa_axis_units_lab="RPM"),
    )  # fmt: skip
    data = vi.read_measurement(path, direction="forward")
    np.testing.assert_allclose(data["frequency"], 1.0 + TIME, rtol=1e-6)
    assert "acceleration_max" not in data
    assert "acceleration max (complex numbers)" in data.attrs["notes"]


@pytest.mark.parametrize("ending", ["uff", "tdms", "mat", "h5"])
def test_a_file_that_was_cut_is_refused(tmp_path, ending):
    path = tmp_path / f"whole.{ending}"
    if ending == "uff":
        uff(
            path,
            *(
                function(kind, TIME, U, ordinate_axis_units_lab=unit)
                for kind, unit in ((8, "mm"), (12, "g"))
            ),
        )
    elif ending == "tdms":
        tdms(path, ("u_mm", U, {"wf_increment": 0.004}), ("acc_g", U, {"wf_increment": 0.004}))
    elif ending == "mat":
        scipy.io.savemat(path, {"time": TIME, "u_mm": U}, do_compression=True)
    else:
        hdf5(path, units="mm")
    assert len(vi.read_measurement(path)["time"]) == 250
    data = path.read_bytes()
    draw = random.Random(5)
    for size in [len(data) - 9, *(draw.randrange(1, len(data) - 8) for _ in range(CUTS))]:
        cut = tmp_path / f"cut.{ending}"
        cut.write_bytes(data[:size])
        with pytest.raises(vi.InputError) as refused:
            vi.read_measurement(cut)
        assert "\n" not in str(refused.value)


def test_values_that_are_not_finite_and_cells_that_are_too_long(tmp_path):
    path = tmp_path / "a.csv"
    for value in ("inf", "1e310"):
        path.write_text(f"time,u (mm)\n0,1\n0.1,{value}\n0.2,3\n")
        with pytest.raises(vi.InputError, match="line 3, column 'u': inf is not finite"):
            vi.read_measurement(path)
    path.write_text(f"time,u (mm)\n0,1\n0.1,{'1' * 200_000}x\n0.2,3\n")
    with pytest.raises(vi.InputError, match="line 3, column 'u'") as refused:
        vi.read_measurement(path)
    assert len(str(refused.value)) < 400
    path.write_text(",".join(["1"] * 20_000) + "\n")
    with pytest.raises(vi.InputError, match="has 20000 columns; pass at most 10000 columns"):
        vi.read_measurement(path)


def test_a_pipe_is_no_file(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for read in (vi.read_measurement, vi.Record.read):
        with pytest.raises(vi.InputError, match="is not a regular file; pass the path of a file"):
            read(tmp_path / "pipe")


def test_damage_on_which_scipy_ends_the_process_is_refused(tmp_path):
    """A kind of numbers that does not exist; complex numbers without imaginary parts."""
    path = tmp_path / "a.mat"
    scipy.io.savemat(path, {"time": TIME, "u_mm": U})
    whole = path.read_bytes()
    for at, bits in ((177, 0x80), (145, 0x08), (180, 0x01)):
        damaged = bytearray(whole)
        damaged[at] ^= bits
        path.write_bytes(damaged)
        with pytest.raises(vi.InputError, match="is damaged or not a MAT file"):
            vi.read_measurement(path)
    scipy.io.savemat(path, {"s": scipy.sparse.csc_array(U[:, np.newaxis])})
    damaged = bytearray(path.read_bytes())
    at = damaged.index(np.arange(20, 30, dtype="<i4").tobytes())
    damaged[at + 3] = 0x40
    path.write_bytes(damaged)
    with pytest.raises(vi.InputError, match="is damaged or not a MAT file"):
        vi.read_measurement(path)


def test_damage_on_which_hdf5_never_ends_is_refused(tmp_path):
    path = hdf5(tmp_path / "a.h5", units="mm")
    damaged = bytearray(path.read_bytes())
    heap = damaged.index(b"GCOL")
    damaged[heap + 16 : heap + 48] = bytes(32)
    path.write_bytes(damaged)
    with pytest.raises(vi.InputError, match="free space without a size"):
        vi.read_measurement(path)


def test_scales_that_nptdms_cannot_apply_are_refused(tmp_path, capfd):
    about = {"NI_Number_Of_Scales": 1, "NI_Scaling_Status": "unscaled", "wf_increment": 0.004,
             "NI_Scale[0]_Scale_Type": "Cubic"}  # fmt: skip
    own = {"NI_Scale[0]_Scale_Type": "Linear", "NI_Scale[0]_Linear_Slope": 2.0,
           "NI_Scale[0]_Linear_Y_Intercept": 0.0, "NI_Scale[0]_Linear_Input_Source": 0}  # fmt: skip
    for other, message in (
        ({}, "Unsupported scale type"),
        ({"NI_Number_Of_Scales": 2**30}, "NI_Number_Of_Scales = 1073741824"),
        (own, "is damaged or not a TDMS file"),
    ):
        with pytest.raises(vi.InputError, match=message):
            vi.read_measurement(tdms(tmp_path / "a.tdms", ("u_mm", U, about | other)))
    assert capfd.readouterr().err == ""
