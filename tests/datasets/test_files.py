"""Datasets to files and back: whole or not at all."""

from __future__ import annotations

import subprocess
import sys
from functools import cache
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from samples import sample
from vibroimpact.datasets.files import write_whole

CASE = vi.laboratory.case("B2-G1-A3")


@cache
def made(kind: str) -> xr.Dataset:
    shaken = vi.Harmonic(CASE.amplitude, 1.1)
    match kind:
        case "sweep":
            return vi.sweep(vi.Rig(CASE.oscillator, CASE.amplitude), [0.6, 1.0, 2.5])
        case "sweeps":
            return vi.sweeps([CASE, vi.laboratory.case("B1-G1-A1")], [0.6, 1.0])
        case "simulation":
            return vi.simulate(vi.Rig(CASE.oscillator, shaken), 3)
        case "one-sided":
            return vi.simulate(vi.Rig(CASE.oscillator.replace(left=None), shaken), 3)
        case "no event":
            return vi.simulate(vi.Rig(CASE.oscillator.without_bumpers(), shaken), 1)
        case _:
            return vi.simulate(vi.Rig(CASE.oscillator, shaken), 3, samples=0)


@pytest.mark.parametrize(
    "kind", ["sweep", "sweeps", "simulation", "one-sided", "no event", "final state"]
)
def test_there_and_back(kind: str, tmp_path: Path) -> None:
    data = made(kind)
    path = vi.save(data, tmp_path / "data.nc")
    assert path == tmp_path / "data.nc"
    back = vi.load(path)
    xr.testing.assert_equal(back, data)
    for name in data.variables:
        for attribute in ("units", "long_name"):
            assert back[name].attrs[attribute] == data[name].attrs[attribute]
    assert back.attrs == data.attrs
    assert [p.name for p in tmp_path.iterdir()] == ["data.nc"]


def test_a_loaded_simulation_goes_on(tmp_path: Path) -> None:
    data = made("simulation")
    shaken = vi.Harmonic(CASE.amplitude, 1.1)
    ends = [
        vi.simulate(vi.Rig(CASE.oscillator, shaken), 2, start)["final_state"]
        for start in (data, vi.load(vi.save(data, tmp_path / "data.nc")))
    ]
    np.testing.assert_array_equal(*ends)


@pytest.mark.parametrize("share", [0.0, 0.001, 0.1, 0.5, 0.9, 0.999])
def test_a_truncated_file_is_refused(share: float, tmp_path: Path) -> None:
    whole = vi.save(made("sweep"), tmp_path / "data.nc").read_bytes()
    path = tmp_path / "short.nc"
    path.write_bytes(whole[: int(share * len(whole))])
    refused(path, "damaged or not a NetCDF file")


def test_what_is_not_ours_is_refused(tmp_path: Path) -> None:
    refused(tmp_path / "none.nc", "does not exist")
    refused(
        tmp_path, "is a folder; pass a NetCDF file, or, to read the store of a map or of demands"
    )
    text = tmp_path / "text.nc"
    text.write_text("frequency,eta\n1,2\n")
    refused(text, "damaged or not a NetCDF file")
    foreign = tmp_path / "foreign.nc"
    xr.Dataset({"x": ("t", [1.0, 2.0])}).to_netcdf(foreign, engine="h5netcdf")
    refused(foreign, "was not written by vibroimpact")


def refused(path: Path, why: str) -> None:
    with pytest.raises(vi.InputError) as caught:
        vi.load(path)
    message = str(caught.value)
    assert message.startswith(f"file: {str(path)!r}")
    assert why in message
    assert "; pass " in message or message.endswith("to read files of other programs")
    assert "\n" not in message


def test_every_flipped_bit_is_noticed(tmp_path: Path) -> None:
    whole = vi.save(made("sweep"), tmp_path / "data.nc").read_bytes()
    path = tmp_path / "flipped.nc"
    rng = np.random.default_rng(1)
    for at in rng.choice(len(whole) - 85, sample(400, 15), replace=False):  # 85: of the checksum
        content = bytearray(whole)
        content[at] ^= 1 << int(rng.integers(8))
        path.write_bytes(content)
        refused(path, "does not match its checksum")


def test_a_file_that_another_program_changed_is_read_with_a_warning(tmp_path: Path) -> None:
    path = vi.save(made("sweep"), tmp_path / "data.nc")
    with h5py.File(path, "a") as file:
        file.attrs["title"] = "changed"
    path.write_bytes(path.read_bytes().split(b"\nvibroimpact sha256 ")[0])
    message = "it has no checksum because another program changed it"
    with pytest.warns(vi.InputWarning, match=message):
        assert vi.load(path).attrs["title"] == "changed"


@pytest.mark.parametrize("engine", ["h5netcdf", "h5py"])
def test_other_programs_read_what_is_saved(engine: str, tmp_path: Path) -> None:
    data = made("sweep")
    path = vi.save(data, tmp_path / "data.nc")
    if engine == "h5netcdf":
        xr.testing.assert_equal(xr.load_dataset(path, engine="h5netcdf"), data)
        return
    with h5py.File(path) as file:
        np.testing.assert_array_equal(file["eta_d"][:], data["eta_d"].values)


@pytest.mark.full
def test_a_full_disk_is_an_error_and_keeps_what_was_there(tmp_path: Path) -> None:
    """In a process whose files may have so many bytes only, for the figure as for the data."""
    for name in ("data.nc", "data.csv"):
        path = tmp_path / name
        path.write_text("old")
        script = (
            "import vibroimpact as vi\n"
            "data = vi.sweep(vi.laboratory.case('B2-G1-A3'), [0.6, 1.0])\n"
            "import resource\n"
            "resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))\n"
            f"try:\n    vi.save(data, {str(path)!r})\n"
            "except vi.InputError as error:\n    print(error)\n"
        )
        run = subprocess.run(
            [sys.executable, "-c", script], capture_output=True, text=True, check=False
        )
        assert (run.returncode, run.stderr) == (0, "")
        assert run.stdout == (
            f"output: {str(path)!r} cannot be written (File too large); choose an existing "
            "folder that you may write to\n"
        )
        assert path.read_text() == "old"
    assert {p.name for p in tmp_path.iterdir()} == {"data.nc", "data.csv"}


def test_a_file_that_is_there_is_replaced(tmp_path: Path) -> None:
    path = tmp_path / "data.nc"
    path.write_text("old")
    vi.save(made("sweep"), path)
    xr.testing.assert_equal(vi.load(path), made("sweep"))
    vi.save(made("simulation"), path)
    xr.testing.assert_equal(vi.load(path), made("simulation"))


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_a_write_that_fails_leaves_what_was_there(
    error: BaseException, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "data.nc"
    path.write_text("old")

    def write(beside: Path, content: bytes) -> None:
        assert beside.parent == tmp_path
        assert path.read_text() == "old"
        beside.write_text("half")
        raise error

    monkeypatch.setattr(Path, "write_bytes", write)
    expected = vi.InputError if isinstance(error, OSError) else type(error)
    with pytest.raises(expected) as caught:
        write_whole(path, "new")
    if isinstance(error, OSError):
        assert str(caught.value).startswith(f"output: {str(path)!r} cannot be written (No space")
    assert path.read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["data.nc"]


def test_a_folder_that_cannot_be_written_to(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    for path in (tmp_path / "missing" / "data.nc", blocked / "data.nc", Path("/proc/data.nc")):
        with pytest.raises(
            vi.InputError, match=r"^output: .* cannot be written .*; choose an existing"
        ):
            vi.save(made("final state"), path)
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


def test_a_folder_of_that_name_is_refused(tmp_path: Path) -> None:
    (tmp_path / "data.nc").mkdir()
    with pytest.raises(vi.InputError, match=r"^output: .* cannot be written"):
        vi.save(made("final state"), tmp_path / "data.nc")
    assert [p.name for p in tmp_path.iterdir()] == ["data.nc"]


# Several datasets in one file


def several() -> dict[str, xr.Dataset]:
    return {"forward branch": made("simulation"), "2.6Hz/free": made("no event")}


def test_several_there_and_back(tmp_path: Path) -> None:
    path = vi.save(several(), tmp_path / "data.nc")
    assert path == tmp_path / "data.nc"
    for group, data in zip(("forward_branch", "2.6Hz_free"), several().values(), strict=True):
        back = vi.load(path, group=group)
        xr.testing.assert_identical(back, data)  # with all attributes
        assert list(back.variables) == list(data.variables)
    assert [p.name for p in tmp_path.iterdir()] == ["data.nc"]


def test_a_motion_from_a_group_goes_on(tmp_path: Path) -> None:
    path = vi.save(several(), tmp_path / "data.nc")
    shaken = vi.Harmonic(CASE.amplitude, 1.1)
    ends = [
        vi.simulate(vi.Rig(CASE.oscillator, shaken), 2, start)["final_state"]
        for start in (made("simulation"), vi.load(path, group="forward_branch"))
    ]
    np.testing.assert_array_equal(*ends)


@pytest.mark.full
def test_a_group_has_to_be_one_of_those_in_the_file(tmp_path: Path) -> None:
    path = vi.save(several(), tmp_path / "data.nc")
    for group in (None, "none", "forward branch", "forward", ""):
        with pytest.raises(vi.InputError) as caught:
            vi.load(path, group=group)
        message = str(caught.value)
        wrong = f"{str(path)!r} has no group {group!r}; " if group is not None else "missing, but "
        assert message.startswith(f"group: {wrong}")
        assert str(path) in message
        assert message.endswith("; pass one of forward_branch, 2.6Hz_free")
        assert ("several groups" in message) is (group is None)
        assert "\n" not in message


def test_a_group_of_a_file_that_holds_one_dataset_is_refused(tmp_path: Path) -> None:
    path = vi.save(made("simulation"), tmp_path / "data.nc")
    with pytest.raises(vi.InputError) as caught:
        vi.load(path, group="forward_branch")
    message = str(caught.value)
    assert "forward_branch" in message
    assert repr(str(path)) in message
    assert "\n" not in message


def test_groups_that_are_damaged_or_not_ours_are_refused(tmp_path: Path) -> None:
    whole = vi.save(several(), tmp_path / "data.nc").read_bytes()
    short = tmp_path / "short.nc"
    for share in (0.1, 0.9, 0.999):
        short.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(vi.InputError, match="damaged or not a NetCDF file"):
            vi.load(short, group="forward_branch")
    foreign = tmp_path / "foreign.nc"
    tree = xr.DataTree.from_dict({"forward_branch": xr.Dataset({"x": ("t", [1.0, 2.0])})})
    tree.to_netcdf(foreign, engine="h5netcdf")
    with pytest.raises(vi.InputError, match="was not written by vibroimpact"):
        vi.load(foreign, group="forward_branch")


SHAKEN = {
    "harmonics": vi.Periodic(1.1, (0.4, 0.2), (0.3, 1.0), 0.2),
    "displacement": vi.Harmonic("8 mm", 1.1),
    "force": vi.Harmonic("250 N", 1.1, 0.4),
    "unbalance": vi.Harmonic("5 kg m", 1.1, 0.4),
    "harmonics of displacement": vi.Periodic(1.1, ("8 mm", "1 mm")),
}


@pytest.mark.parametrize("kind", sample([*SHAKEN], [*SHAKEN][-1:]))
def test_any_shaking_comes_back(kind: str, tmp_path: Path) -> None:
    """What is worked out of a loaded motion is what it is of the motion itself."""
    rig = CASE.oscillator.replace(force=100.0)
    for data in (vi.simulate(vi.Rig(rig, SHAKEN[kind]), 6), vi.orbit(vi.Rig(rig, SHAKEN[kind]))):
        back = vi.load(vi.save(data, tmp_path / "data.nc"))
        xr.testing.assert_equal(back, data)
        assert int(back.sizes["event"]) > 0
        for worked_out in (vi.contacts, vi.fourier_spectrum, vi.stroboscopic_section):
            xr.testing.assert_equal(worked_out(back), worked_out(data))
        ends = [
            vi.simulate(vi.Rig(rig, SHAKEN[kind]), 2, one, 0)["final_state"] for one in (data, back)
        ]
        np.testing.assert_array_equal(*ends)


def test_a_motion_through_a_record_comes_back(tmp_path: Path) -> None:
    record = vi.Record(2.0 * np.sin(0.1 * np.arange(400)), 0.02)
    data = vi.simulate(vi.Rig(CASE.oscillator, record), tail=1.0)
    back = vi.load(vi.save(data, tmp_path / "data.nc"))
    xr.testing.assert_equal(back, data)
    assert back.attrs == data.attrs
    assert int(back.sizes["event"]) > 2
    ends = [
        vi.simulate(vi.Rig(CASE.oscillator, record), start=one, samples=0)["final_state"]
        for one in (data, back)
    ]
    np.testing.assert_array_equal(*ends)
