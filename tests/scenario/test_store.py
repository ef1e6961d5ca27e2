"""Stores of maps: read when complete, kept when foreign, locked when in use."""

from __future__ import annotations

import shutil

import pytest
import xarray as xr
import zarr

import vibroimpact as vi
from vibroimpact.scenario import folder

# What is kept does not depend on how much it is.
X, Y = ("stiffness_ratio", [1.0, 16.0]), ("gap_ratio", [0.2, 0.6, 0.9])
OPTIONS = {"refine": 1, "block": 2, "step": 0.05}


def test_a_finished_map_is_read_and_not_computed(tmp_path):
    first = vi.scenario_map(X, Y, **OPTIONS, store=tmp_path / "map").load()
    told = []
    again = vi.scenario_map(
        X, Y, **OPTIONS, store=tmp_path / "map", progress=lambda *at: told.append(at)
    )
    xr.testing.assert_identical(again.load(), first)
    assert told == []


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"refine": 2}, "refine"),
        ({"step": 0.03}, "step"),
        ({"thresholds": vi.Thresholds(extent=0.1)}, "thresholds"),
        ({"base": vi.from_dimensionless(1.0, 1.0, 0.02, 0.15)}, "base"),
    ],
)
def test_a_store_with_another_map_is_refused_and_kept(tmp_path, changes, field):
    store = tmp_path / "map"
    first = vi.scenario_map(X, Y, **OPTIONS, store=store).load()
    with pytest.raises(vi.InputError, match=rf"store: .* holds another map: {field} differ"):
        vi.scenario_map(X, Y, **{**OPTIONS, **changes}, store=store)
    xr.testing.assert_identical(vi.scenario_map(X, Y, **OPTIONS, store=store).load(), first)


def test_what_is_no_map_is_refused_and_kept(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "mine").write_text("kept")
    (tmp_path / "file").write_text("kept")
    zarr.open_group(tmp_path / "other", mode="w").create_array("a", shape=(2,), dtype="f8")
    for name in ("folder", "file", "other"):
        with pytest.raises(
            vi.InputError, match=r"store: .* exists and is no map, or a damaged one"
        ):
            vi.scenario_map(X, Y, **OPTIONS, store=tmp_path / name)
    assert (tmp_path / "folder" / "mine").read_text() == "kept"
    with pytest.raises(vi.InputError, match=r"store: .* cannot be written .*does not exist"):
        vi.scenario_map(X, Y, **OPTIONS, store=tmp_path / "missing" / "map")
    for wrong in (3, "a\0b"):
        with pytest.raises(vi.InputError, match=r"store: .*the path of a folder is accepted"):
            vi.scenario_map(X, Y, **OPTIONS, store=wrong)


def test_a_store_in_use_is_refused(tmp_path):
    store = tmp_path / "map"
    refused = []

    def second(done: int, total: int) -> None:
        if not refused:
            with pytest.raises(vi.InputError, match="being written by another process") as error:
                vi.scenario_map(X, Y, **OPTIONS, store=store)
            refused.append(error)

    vi.scenario_map(X, Y, **OPTIONS, store=store, progress=second)
    assert refused


def test_a_damaged_store_is_refused(tmp_path):
    axes = ("stiffness_ratio", [1.0, 2.0]), ("gap_ratio", [0.5, 0.6])
    vi.scenario_map(*axes, step=0.05, store=tmp_path / "map")
    shutil.rmtree(tmp_path / "map" / "extent")
    with pytest.raises(vi.InputError, match="is no map, or a damaged one"):
        vi.scenario_map(*axes, step=0.05, store=tmp_path / "map")


def test_a_link_is_the_folder_that_it_leads_to(tmp_path):
    """Also for the lock, or two processes could write one map."""
    (tmp_path / "link").symlink_to(tmp_path / "map", target_is_directory=True)
    axes = ("stiffness_ratio", [1.0, 2.0]), ("gap_ratio", [0.5, 0.6])
    refused = []

    def second(done: int, total: int) -> None:
        if not refused:
            with pytest.raises(vi.InputError, match="being written by another process") as error:
                vi.scenario_map(*axes, step=0.05, store=tmp_path / "map")
            refused.append(error)

    vi.scenario_map(*axes, step=0.05, store=tmp_path / "link", progress=second)
    assert refused
    assert (tmp_path / "map" / "zarr.json").is_file()
    assert {p.name for p in tmp_path.iterdir()} == {"link", "map"}


def test_a_store_of_another_version_is_refused(tmp_path, monkeypatch):
    axes = ("stiffness_ratio", [1.0, 2.0]), ("gap_ratio", [0.5, 0.6])
    vi.scenario_map(*axes, step=0.05, store=tmp_path / "map")
    monkeypatch.setattr(folder, "__version__", "99.0")
    with pytest.raises(vi.InputError, match="vibroimpact_version differ"):
        vi.scenario_map(*axes, step=0.05, store=tmp_path / "map")
