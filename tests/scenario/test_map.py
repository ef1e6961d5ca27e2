"""Maps: the same whatever the threads and blocks, and however often they were stopped."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from functools import cache

import numpy as np
import pytest
import xarray as xr
import zarr

import vibroimpact as vi
from vibroimpact.response.variables import VARIABLES
from vibroimpact.scenario.borders import jump_border
from vibroimpact.scenario.cell import COUNTS, VALUES
from vibroimpact.scenario.frequencies import frequencies
from vibroimpact.scenario.kinds import Scenario

X = ("stiffness_ratio", np.geomspace(1.0, 64.0, 4))
Y = ("gap_ratio", np.linspace(0.0, 1.0, 5))
OPTIONS = {"refine": 1, "block": 2, "step": 0.02}


@cache
def small() -> xr.Dataset:
    return vi.scenario_map(X, Y, **OPTIONS)


def test_nodes_are_classified_as_one_by_one():
    data = small()
    step = OPTIONS["step"]
    for y in (0, 3, 8):
        for x in (0, 4, 6):
            rig = vi.from_dimensionless(
                float(data["stiffness_ratio"][x]), float(data["gap_ratio"][y]), 0.01, 0.15
            )
            alone = vi.classify(*rig, frequencies(*rig, step))
            assert Scenario(int(data["scenario"][y, x])).label == alone.scenario, (x, y)


def test_what_a_map_shows():
    data = small()
    assert data["scenario"].dims == ("gap_ratio", "stiffness_ratio")
    assert data["scenario"].shape == (9, 7)
    kinds = data["scenario"].values
    assert set(np.unique(kinds[0])) == {Scenario.S5}
    assert set(np.unique(kinds[-1])) == {Scenario.S0}
    assert kinds[4, 0] == Scenario.S6  # λ = 1
    assert kinds[6, -1] == Scenario.S2
    assert kinds[1, -1] == Scenario.S4
    # Features where computed, and there alone.
    computed = data["level"].values >= 0
    assert 0.3 < computed.mean() < 0.95
    for name in ("peak_eta_a_forward", "confidence", "extent"):
        np.testing.assert_array_equal(np.isfinite(data[name].values), computed)
    np.testing.assert_array_equal(data["left_hysteresis_count"].values >= 0, computed)
    hard = data.isel(gap_ratio=6, stiffness_ratio=-1)
    assert float(hard["jump_down_ratio"]) > float(hard["jump_up_ratio"]) > 1.0
    assert float(hard["peak_eta_a_forward"]) > float(hard["peak_eta_a_backward"]) > 1.0


def test_every_variable_is_described():
    data = small()
    assert {"scenario", "level", *VALUES, *COUNTS} == set(data.data_vars)
    for name in data.variables:
        assert data[name].attrs["long_name"] == VARIABLES[name].long_name
        assert data[name].attrs["units"] == VARIABLES[name].units
    assert data["scenario"].attrs["flag_meanings"].split()[4] == "S4"
    settings = json.loads(data.attrs["parameters"])
    assert settings["thresholds"]["extent"] == 0.08
    assert settings["x"]["name"] == "stiffness_ratio"


def test_no_result_depends_on_threads_or_blocks_or_where_it_is_kept(tmp_path):
    for name, options in (("one", {"threads": 1, "block": 2}), ("big", {"threads": 3, "block": 9})):
        data = vi.scenario_map(X, Y, **{**OPTIONS, **options}, store=tmp_path / name)
        xr.testing.assert_equal(data.load(), small())


def test_a_map_that_was_stopped_is_completed_to_the_same(tmp_path):
    stops = 0
    for limit in (0, 3, 5, 9, 20):
        told = iter(range(limit + 1))

        def stop(done: int, total: int, told=told) -> None:
            if next(told, None) is None:
                raise KeyboardInterrupt

        try:
            vi.scenario_map(X, Y, **OPTIONS, store=tmp_path / "map", progress=stop)
        except KeyboardInterrupt:
            stops += 1
    assert stops >= 3
    held = zarr.open_group(tmp_path / "map", mode="r")
    done = int(np.asarray(held["done"][:]).sum())
    assert done > 0
    data = vi.scenario_map(X, Y, **OPTIONS, store=tmp_path / "map")
    xr.testing.assert_identical(data.load(), small())


def test_a_process_that_was_killed(tmp_path):
    """At any moment, without a chance to tidy up."""
    code = (
        "import numpy as np, vibroimpact as vi\n"
        "vi.scenario_map(('stiffness_ratio', np.geomspace(1.0, 64.0, 4)),"
        " ('gap_ratio', np.linspace(0.0, 1.0, 5)), refine=1, block=2, step=0.02, store='map')\n"
    )
    kills = 0
    for delay in (0.0, 0.4, 1.0):
        child = subprocess.Popen([sys.executable, "-c", code], cwd=tmp_path)
        # Begin to count when the store is there: before that it is imports.
        waited = time.monotonic()
        while child.poll() is None and time.monotonic() - waited < 30.0:
            if (tmp_path / "map").exists():
                break
            time.sleep(0.01)
        time.sleep(delay)
        if child.poll() is None:
            os.kill(child.pid, signal.SIGKILL)
            kills += 1
        child.wait()
    assert kills
    data = vi.scenario_map(X, Y, **OPTIONS, store=tmp_path / "map")
    xr.testing.assert_identical(data.load(), small())


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
    vi.scenario_map(X, Y, **OPTIONS, store=store)
    with pytest.raises(vi.InputError, match=rf"store: .* holds another map: {field} differ"):
        vi.scenario_map(X, Y, **{**OPTIONS, **changes}, store=store)
    xr.testing.assert_identical(vi.scenario_map(X, Y, **OPTIONS, store=store).load(), small())


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
    for store in (3, "a\0b"):
        with pytest.raises(vi.InputError, match=r"store: .*the path of a folder is accepted"):
            vi.scenario_map(X, Y, **OPTIONS, store=store)


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


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"step": 0.0}, "step"),
        ({"refine": -1}, "refine: -1"),
        ({"block": 0}, "block: 0"),
        ({"threads": 0}, "threads: 0"),
        ({"base": 3}, "base: 3 is no rig"),
        ({"base": (vi.Oscillator(1.0, vi.Isolator(1.0, 0.3)), 1.0)}, "base: there is no bumper"),
    ],
)
def test_wrong_values_are_refused(options, message):
    with pytest.raises(vi.InputError, match=message):
        vi.scenario_map(X, Y, **{**OPTIONS, **options})


def test_a_physical_map_agrees_with_the_dimensionless_one():
    """The same nodes, reached through gap and bumper stiffness of a laboratory rig."""
    case = vi.laboratory.case("B3-10mm-A3")
    peak = case.oscillator.right.gap / vi.to_dimensionless(*_rig(case)).right.gap
    stiffness = [ratio * case.oscillator.isolator.stiffness for ratio in X[1][2:]]
    gaps = [ratio * peak for ratio in Y[1][1:4]]
    data = vi.scenario_map(
        ("bumper_stiffness", stiffness), ("gap", gaps), _rig(case), step=0.02, block=2
    )
    scaled = small().isel(gap_ratio=slice(2, 7, 2), stiffness_ratio=slice(4, 7, 2))
    np.testing.assert_array_equal(data["scenario"], scaled["scenario"])
    np.testing.assert_allclose(data["peak_eta_a_forward"], scaled["peak_eta_a_forward"], rtol=1e-6)


def _rig(case):
    return case.oscillator, case.amplitude


def test_the_border_of_jumps_is_the_cusp_of_the_folds():
    """At B2-G1-A3's gap, found over two parameters from either fold: λ = 1.6276962."""
    case = vi.laboratory.case("B2-G1-A3")
    delta = vi.to_dimensionless(*_rig(case)).right.gap
    data = vi.scenario_map(
        ("stiffness_ratio", np.geomspace(1.0, 4.0, 9)),
        ("gap_ratio", [delta, delta + 0.2]),
        _rig(case),
        step=0.02,
    )
    border = jump_border(data)
    assert border.sizes["border_point"] == 2
    assert float(border["gap_ratio"][0]) == delta
    assert float(border["stiffness_ratio"][0]) == pytest.approx(1.6276962, abs=1e-6)
    # It lies between the nodes that it parts.
    for k in range(2):
        jumping = np.isin(data["scenario"].values[k], [Scenario.S2, Scenario.S3])
        first = int(np.argmax(jumping))
        low, high = data["stiffness_ratio"].values[[first - 1, first]]
        assert low < float(border["stiffness_ratio"][k]) < high
    with pytest.raises(vi.InputError, match="data: this is no map"):
        jump_border(xr.Dataset())


def test_a_map_without_such_a_border():
    data = vi.scenario_map(("damping_ratio", [0.1, 0.2]), ("relaxation_time", [0.01, 0.02]))
    assert jump_border(data).sizes["border_point"] == 0


def test_progress_counts_up(tmp_path):
    told = []
    vi.scenario_map(X, Y, **OPTIONS, progress=lambda *at: told.append(at))
    done = [d for d, _ in told]
    assert done == sorted(done)
    assert [t for _, t in told] == sorted(t for _, t in told)
    assert told[-1][0] == told[-1][1] == int((small()["level"] >= 0).sum())


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
