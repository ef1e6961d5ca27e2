"""Stores of maps: read when complete, kept when foreign, locked when in use."""

from __future__ import annotations

import json
import shutil
import signal
import subprocess
import sys
import textwrap
import warnings
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
import zarr

import vibroimpact as vi
from samples import sample
from vibroimpact.stores import zarr_store

# What is kept does not depend on how much it is.
AXES = {"stiffness_ratio": [1.0, 16.0], "gap_ratio": [0.2, 0.6, 0.9]}
OPTIONS = {"refine": 1, "block": 2, "step": 0.1}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A finished map in a folder, and the same in memory."""
    store = tmp_path_factory.mktemp("whole") / "map"
    return store, vi.scenario_map(None, AXES, **OPTIONS, store=store).load()


def test_a_finished_map_is_read_and_not_computed(whole):
    counts = []
    again = vi.scenario_map(
        None, AXES, **OPTIONS, store=whole[0], progress=lambda *at: counts.append(at)
    )
    xr.testing.assert_identical(again.load(), whole[1])
    assert counts == []


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"refine": 2}, "refine"),
        ({"step": 0.03}, "step"),
        ({"thresholds": vi.Thresholds(extent=0.1)}, "thresholds"),
        ({"rig": vi.from_dimensionless(1.0, 1.0, 0.02, 0.15)}, "base"),
    ],
)
def test_a_store_with_another_map_is_refused_and_kept(whole, changes, field):
    store, first = whole
    message = rf"store: .* contains a map with other values of {field};"
    with pytest.raises(vi.InputError, match=message):
        vi.scenario_map(vary=AXES, store=store, **{"rig": None, **OPTIONS, **changes})
    xr.testing.assert_identical(vi.scenario_map(None, AXES, **OPTIONS, store=store).load(), first)


def test_what_is_no_map_is_refused_and_kept(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "mine").write_text("kept")
    (tmp_path / "file").write_text("kept")
    zarr.open_group(tmp_path / "other", mode="w").create_array("a", shape=(2,), dtype="f8")
    for name in ("folder", "file", "other"):
        with pytest.raises(vi.InputError, match=r"store: .* exists, but contains no readable map"):
            vi.scenario_map(None, AXES, **OPTIONS, store=tmp_path / name)
    assert (tmp_path / "folder" / "mine").read_text() == "kept"
    with pytest.raises(vi.InputError, match=r"store: .* cannot be written .*does not exist"):
        vi.scenario_map(None, AXES, **OPTIONS, store=tmp_path / "missing" / "map")
    for wrong in (3, "a\0b"):
        with pytest.raises(
            vi.InputError, match=r"store: .* is not a path; pass the path of a folder"
        ):
            vi.scenario_map(None, AXES, **OPTIONS, store=wrong)


def test_a_store_in_use_is_refused(tmp_path):
    store = tmp_path / "map"
    refused = []

    def second(done: int, total: int) -> None:
        if not refused:
            with pytest.raises(vi.InputError, match="being written by another process") as error:
                vi.scenario_map(None, AXES, **OPTIONS, store=store)
            refused.append(error)

    vi.scenario_map(None, AXES, **OPTIONS, store=store, progress=second)
    assert refused


@pytest.mark.skipif(sys.platform == "win32", reason="kills a process")
def test_what_a_killed_process_leaves_does_no_harm(whole, tmp_path):
    """Its lock is not held any more, though the file of it stays."""
    store, lock = tmp_path / "map", tmp_path / ".map.lock"
    code = f"""
        import os, signal
        import vibroimpact as vi
        def kill(done, total):
            if done:
                os.kill(os.getpid(), signal.SIGKILL)
        vi.scenario_map(
            None, {AXES!r}, **{OPTIONS!r}, store={str(store)!r}, progress=kill
        )
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], check=False)
    assert done.returncode == -signal.SIGKILL
    assert lock.exists()
    again = vi.scenario_map(None, AXES, **OPTIONS, store=store).load()
    xr.testing.assert_identical(again, whole[1])
    assert not lock.exists()


def chunks(array):
    return sorted(path for path in (array / "c").rglob("*") if path.is_file())


def remove(path):
    path.unlink()


def replace_by_folder(path):
    path.unlink()
    path.mkdir()


def truncate(path):
    path.write_bytes(path.read_bytes()[:-3])


def flip(path):
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 4
    path.write_bytes(content)


DAMAGES = [remove, replace_by_folder, truncate, flip]


def mended(store):
    with pytest.warns(vi.InputWarning, match=r"is damaged; \d of its 2 parts are computed again"):
        return vi.scenario_map(None, AXES, **OPTIONS, store=store).load()


CASES = [("scenario", damage) for damage in DAMAGES] + [("gap_ratio", flip), ("level", remove)]


@pytest.mark.parametrize(("array", "damage"), sample(CASES, CASES[::2]))
def test_a_damaged_file_is_made_again(whole, tmp_path, array, damage):
    shutil.copytree(whole[0], store := tmp_path / "map")
    damage(chunks(store / array)[0])
    xr.testing.assert_identical(mended(store), whole[1])
    with warnings.catch_warnings():  # and is whole then
        warnings.simplefilter("error")
        vi.scenario_map(None, AXES, **OPTIONS, store=store)


@pytest.mark.parametrize("damage", sample(DAMAGES, DAMAGES[::3]))
def test_damage_after_opening_is_an_error_in_one_line(whole, tmp_path, damage):
    """Values of a map with a store are read when they are used, which may be much later."""
    shutil.copytree(whole[0], store := tmp_path / "map")
    opened = vi.scenario_map(None, AXES, **OPTIONS, store=store)
    damage(chunks(store / "extent")[0])
    said = r"store: '.*map' was damaged after it was opened \(extent: .+\); .* damaged parts again"
    for part in (opened.extent, opened.extent[1, :2], opened.isel(gap_ratio=[0, 2]).extent):
        with pytest.raises(vi.InputError, match=said) as error:
            part.load()
        assert "\n" not in str(error.value)
    xr.testing.assert_identical(opened.scenario.load(), whole[1].scenario)
    xr.testing.assert_identical(mended(store), whole[1])


def test_parts_that_are_read_later_are_those_of_the_map(whole):
    """In every way of indexing that xarray has."""
    opened = vi.scenario_map(None, AXES, **OPTIONS, store=whole[0])
    rows, columns = xr.DataArray([0, 2, 1], dims="k"), xr.DataArray([1, 1, 0], dims="k")
    for part in (
        lambda data: data.extent[1:, ::2],
        lambda data: data.extent[::-1, 0],
        lambda data: data.scenario[2, [0, 2]],
        lambda data: data.extent.isel(gap_ratio=rows, stiffness_ratio=columns),
        lambda data: data.sel(gap_ratio=0.6).extent,
    ):
        xr.testing.assert_identical(part(opened).load(), part(whole[1]))


def test_what_is_interrupted_leaves_no_files_of_its_own(tmp_path, monkeypatch):
    """Neither while the store is created, nor while a block is computed."""

    def interrupt(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        # Its own only: an interrupt within the threads of zarr would never come back.
        patch.setattr(zarr_store, "os", SimpleNamespace(replace=interrupt))
        with pytest.raises(KeyboardInterrupt):
            vi.scenario_map(None, AXES, **OPTIONS, store=tmp_path / "map")
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(KeyboardInterrupt):
        vi.scenario_map(None, AXES, **OPTIONS, store=tmp_path / "map", progress=interrupt)
    assert [path.name for path in tmp_path.iterdir()] == ["map"]


@pytest.mark.parametrize("damage", sample(DAMAGES, DAMAGES[1::2]))
def test_a_lost_mark_costs_a_block_at_most(whole, tmp_path, damage):
    shutil.copytree(whole[0], store := tmp_path / "map")
    for file in chunks(store / "done")[::2]:
        damage(file)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vi.InputWarning)
        again = vi.scenario_map(None, AXES, **OPTIONS, store=store)
    xr.testing.assert_identical(again.load(), whole[1])


@pytest.mark.parametrize("damage", [remove, truncate])
def test_a_damaged_description_of_an_array_is_made_again(whole, tmp_path, damage):
    shutil.copytree(whole[0], store := tmp_path / "map")
    damage(store / "extent" / "zarr.json")
    xr.testing.assert_identical(mended(store), whole[1])


@pytest.mark.parametrize(
    ("key", "value"),
    [("shape", [2, 2]), ("data_type", "float32"), ("fill_value", 0.0), ("codecs", [])],
)
def test_a_description_that_is_not_as_it_was_is_made_again(whole, tmp_path, key, value):
    shutil.copytree(whole[0], store := tmp_path / "map")
    file = store / "scenario" / "zarr.json"
    file.write_text(json.dumps({**json.loads(file.read_text()), key: value}))
    xr.testing.assert_identical(mended(store), whole[1])


@pytest.mark.parametrize(
    "content", ["", "[]", '{"zarr_format": 3}', "[" * 50_000, '{"parameters": "[]"}']
)
def test_a_folder_whose_own_description_is_damaged_is_refused(whole, tmp_path, content):
    shutil.copytree(whole[0], store := tmp_path / "map")
    file = store / "zarr.json"
    if "parameters" in content:
        held = json.loads(file.read_text())
        held["attributes"]["parameters"] = "[]"
        content = json.dumps(held)
    file.write_text(content)
    with pytest.raises(vi.InputError, match=r"contains no readable map|contains a map with other"):
        vi.scenario_map(None, AXES, **OPTIONS, store=store)


@pytest.mark.full
def test_every_flipped_bit_of_a_chunk_is_noticed(whole, tmp_path):
    shutil.copytree(whole[0], store := tmp_path / "map")
    rng = np.random.default_rng(1)
    files = sorted(p for p in store.rglob("*") if p.is_file() and p.name != "zarr.json")
    for i in rng.choice(len(files), sample(len(files), 4), replace=False):
        content = bytearray(files[i].read_bytes())
        content[rng.integers(len(content))] ^= 1 << int(rng.integers(8))
        files[i].write_bytes(content)
        with pytest.warns(vi.InputWarning, match="is damaged"):
            xr.testing.assert_identical(
                vi.scenario_map(None, AXES, **OPTIONS, store=store).load(), whole[1]
            )


def test_a_link_is_the_folder_that_it_leads_to(tmp_path):
    """Also for the lock, or two processes could write one map."""
    (tmp_path / "link").symlink_to(tmp_path / "map", target_is_directory=True)
    axes = {"stiffness_ratio": [1.0, 2.0], "gap_ratio": [0.5, 0.6]}
    refused = []

    def second(done: int, total: int) -> None:
        if not refused:
            with pytest.raises(vi.InputError, match="being written by another process") as error:
                vi.scenario_map(None, axes, step=0.05, store=tmp_path / "map")
            refused.append(error)

    vi.scenario_map(None, axes, step=0.05, store=tmp_path / "link", progress=second)
    assert refused
    assert (tmp_path / "map" / "zarr.json").is_file()
    assert {p.name for p in tmp_path.iterdir()} == {"link", "map"}


def test_a_store_of_another_version_is_refused(tmp_path, monkeypatch):
    axes = {"stiffness_ratio": [1.0, 2.0], "gap_ratio": [0.5, 0.6]}
    vi.scenario_map(None, axes, step=0.05, store=tmp_path / "map")
    monkeypatch.setattr(zarr_store, "__version__", "99.0")
    with pytest.raises(vi.InputError, match=r"of version .* of vibroimpact, but this is version"):
        vi.scenario_map(None, axes, step=0.05, store=tmp_path / "map")
