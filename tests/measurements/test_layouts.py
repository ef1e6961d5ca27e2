"""Files as MATLAB, LabVIEW and analysers lay them out: the same channels, whatever their place."""

from __future__ import annotations

import gc

import h5py
import numpy as np
import pytest
import scipy.io

import vibroimpact as vi

pytestmark = pytest.mark.filterwarnings("ignore::vibroimpact.InputWarning")
"""What is noted is tested in the attribute, and that it is a warning in test_notes.py."""

RATE = 200.0
TIME = np.arange(60) / RATE
U, ACCELERATION, BASE = 0.01 * np.sin(TIME), 3.0 * np.cos(TIME), 0.4 * np.sin(7.0 * TIME)


def words(*texts: str) -> np.ndarray:
    """A cell array."""
    return np.array(texts, dtype=object)


def matrix(path):
    """A matrix, with the names and the units of its columns in cells beside it."""
    columns = [TIME, 1e3 * U, ACCELERATION / 9.80665, BASE / 9.80665]
    names = words("Time", "Relative displacement", "Mass acceleration", "Table acceleration")
    struct = {"data": np.column_stack(columns), "channels": names, "units": words("s", "mm", *"gg")}
    scipy.io.savemat(path, struct)


def scope(path):
    """Simulink's structure with time."""
    some = (("rel disp (mm)", 1e3 * U), ("mass acc", ACCELERATION), ("table acc", BASE))
    signals = [{"values": v[:, None], "dimensions": 1.0, "label": name} for name, v in some]
    record = {"time": TIME[:, None], "signals": words(*signals), "blockName": "rig/Scope"}
    scipy.io.savemat(path, {"out": record})


def rate(path):
    """Vectors, and how fast they were sampled."""
    some = {"rel_disp_mm": 1e3 * U, "acc_mass": ACCELERATION, "acc_table": BASE}
    scipy.io.savemat(path, {"fs": RATE, "run": some})


def compound(path):
    """A table of a compound type."""
    table = np.rec.fromarrays(
        [TIME, 1e3 * U, ACCELERATION, BASE], names="time,rel_disp_mm,acc_mass,acc_table"
    )
    with h5py.File(path, "w") as file:
        file["data"] = table


def groups(path):
    """A group for each channel, with its own step and unit."""
    some = (("rel disp", 1e3 * U, "mm"), ("mass acc", ACCELERATION, "m/s2"),
            ("table acc", BASE, "m/s2"))  # fmt: skip
    with h5py.File(path, "w") as file:
        for name, values, unit in some:
            group = file.create_group(name)
            group["data"] = values
            group.attrs["dt"], group.attrs["unit"] = 1.0 / RATE, unit


def rate_beside(path):
    """Channels of a file that says how fast they were sampled."""
    with h5py.File(path, "w") as file:
        file.attrs["Sampling Rate (Hz)"] = RATE
        for name, values in (
            ("rel disp", 1e3 * U),
            ("mass acc", ACCELERATION),
            ("table acc", BASE),
        ):
            file[name] = values
        file["rel disp"].attrs["unit"] = "mm"


def universal(path):
    """Functions that are told by entity and kind of the ordinate, under one title."""
    pyuff = pytest.importorskip("pyuff")
    file = pyuff.UFF(str(path))
    some = (("MASS", 12, ACCELERATION, "m/s^2"), ("BASE", 12, BASE, "m/s^2"),
            ("REL", 8, 1e3 * U, "mm"))  # fmt: skip
    for node, (entity, kind, values, unit) in enumerate(some):
        one = pyuff.prepare_58(
            binary=0, func_type=1, rsp_node=node, rsp_dir=1, ref_dir=1, ref_node=0, data=values,
            x=TIME, id1="Run 1", rsp_ent_name=entity, ref_ent_name="NONE", abscissa_spacing=1,
            abscissa_spec_data_type=17, ordinate_spec_data_type=kind, orddenom_spec_data_type=0,
            ordinate_axis_units_lab=unit,
        )  # fmt: skip
        file.write_sets(one, "add")


def settings(path):
    """Channels beside a group that is no test."""
    nptdms = pytest.importorskip("nptdms")
    some = (("Laser rel displacement", 1e3 * U, "mm"), ("Acc mass", ACCELERATION, "m/s^2"),
            ("Acc table", BASE, "m/s^2"))  # fmt: skip
    timed = {"wf_increment": 1.0 / RATE, "wf_start_offset": 0.0, "wf_samples": len(TIME)}
    written = [
        nptdms.ChannelObject("Run", name, values, {**timed, "unit_string": unit})
        for name, values, unit in some
    ]
    scaling = nptdms.ChannelObject("Settings", "Scaling", np.array([1.0, 2.0, 3.0]))
    with nptdms.TdmsWriter(str(path)) as writer:
        writer.write_segment([*written, scaling])


UNSTATED = (scope, rate, compound, rate_beside)
"""Layouts in which the accelerations have no unit."""


@pytest.mark.parametrize("write", UNSTATED)
def test_units_that_are_not_stated_are_asked_for(write, tmp_path):
    path = tmp_path / ("test.mat" if write in (scope, rate) else "test.h5")
    write(path)
    with pytest.raises(vi.InputError, match=r"states no unit of '[^']+', '[^']+'; pass it"):
        vi.read_measurement(path)


@pytest.mark.parametrize(
    ("write", "ending"),
    [
        (matrix, "mat"), (scope, "mat"), (rate, "mat"), (compound, "h5"), (groups, "h5"),
        (rate_beside, "h5"), (universal, "uff"), (settings, "tdms"),
    ],
)  # fmt: skip
def test_the_same_channels(write, ending, tmp_path):
    path = tmp_path / f"test.{ending}"
    write(path)
    used = {"acceleration": "m/s^2", "base_acceleration": "m/s^2"}
    data = vi.read_measurement(path, units=used if write in UNSTATED else None)
    rough = {"rtol": 1e-5, "atol": 1e-7}  # a universal file has single precision
    np.testing.assert_allclose(data["time"], TIME, **rough)
    np.testing.assert_allclose(data["displacement"], U, **rough)
    np.testing.assert_allclose(data["acceleration"], ACCELERATION, **rough)
    np.testing.assert_allclose(data["base_acceleration"], BASE, **rough)
    if write in (rate, groups, rate_beside):
        assert "the times were computed from" in data.attrs["notes"]


def nodes(path, channels, binary):
    """Functions that only their node distinguishes."""
    pyuff = pytest.importorskip("pyuff")
    for node, values in enumerate(channels, start=1):
        one = pyuff.prepare_58(
            binary=binary, func_type=1, rsp_node=node, rsp_dir=1, ref_dir=1, ref_node=0,
            data=values, x=TIME, id1="NONE", rsp_ent_name="NONE", ref_ent_name="NONE",
            abscissa_spacing=1, abscissa_spec_data_type=17, ordinate_spec_data_type=12,
            orddenom_spec_data_type=0, ordinate_axis_units_lab="m/s^2",
        )  # fmt: skip
        pyuff.UFF(str(path)).write_sets(one, "add")


def test_channels_of_one_name_are_told_by_their_node(tmp_path):
    path = tmp_path / "test.uff"
    nodes(path, [ACCELERATION, BASE], binary=0)
    assert "acceleration of node 2" in vi.read_measurement(path).attrs["left_out"]
    named = vi.read_measurement(path, columns={"base_acceleration": "acceleration of node 2"})
    np.testing.assert_allclose(named["base_acceleration"], BASE, rtol=1e-5, atol=1e-7)


@pytest.mark.filterwarnings("ignore::ResourceWarning")
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("count", [1, 2])
def test_binary_universal_files_are_read_whole_and_refused_cut(tmp_path, count):
    """Their last mark stands behind the numbers, with no line of its own."""
    path = tmp_path / "test.uff"
    nodes(path, [ACCELERATION, BASE][:count], binary=1)
    gc.collect()  # pyuff leaves the file open
    data = vi.read_measurement(path)
    np.testing.assert_allclose(data["acceleration"], ACCELERATION, rtol=1e-5, atol=1e-7)
    whole, cut = path.read_bytes(), tmp_path / "cut.uff"
    for share in (0.4, 0.9, 0.99):
        cut.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(vi.InputError, match="it is incomplete"):
            vi.read_measurement(cut)


def test_several_tests_go_by_their_names(tmp_path):
    path = tmp_path / "test.h5"
    with h5py.File(path, "w") as file:
        for name in ("run_01", "run_02"):
            file[f"{name}/time"], file[f"{name}/rel_disp_mm"] = TIME, 1e3 * U
    with pytest.raises(vi.InputError, match="pass one of 'run_01', 'run_02'"):
        vi.read_measurement(path)
    assert vi.read_measurement(path, group="run_02").displacement.values == pytest.approx(U)


def test_a_rate_that_is_none_and_names_that_say_nothing(tmp_path):
    path = tmp_path / "test.mat"
    scipy.io.savemat(path, {"fs": 0.0, "rel_disp_mm": 1e3 * U})
    with pytest.raises(vi.InputError, match="fs"):
        vi.read_measurement(path)
    scipy.io.savemat(path, {"fs": RATE, "ai0": U, "ai1": BASE})
    with pytest.raises(vi.InputError, match="'ai0' is not understood, 'ai1' is not"):
        vi.read_measurement(path)
