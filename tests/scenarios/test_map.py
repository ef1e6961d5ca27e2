"""Maps: the same whatever the threads and blocks, and however often they were stopped."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray as xr
import zarr

import vibroimpact as vi
from scenarios.small_map import AXES, OPTIONS, rig_of, small
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.scenarios import map as mapping
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.classify import classify
from vibroimpact.scenarios.map_node import COUNTS, VALUES
from vibroimpact.scenarios.scenario import Scenario
from vibroimpact.scenarios.sweep_frequencies import frequencies
from vibroimpact.tasks import executors


@pytest.mark.full
def test_nodes_are_classified_as_one_by_one():
    data = small()
    step = OPTIONS["step"]
    for y in (0, 3, 8):
        for x in (0, 4, 6):
            rig = vi.from_dimensionless(
                float(data["stiffness_ratio"][x]), float(data["gap_ratio"][y]), 0.01, 0.15
            )
            alone = classify(rig, frequencies(one_sine(rig), step))
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
        data = vi.scenario_map(None, AXES, **{**OPTIONS, **options}, store=tmp_path / name)
        xr.testing.assert_equal(data.load(), small())


@pytest.mark.full
def test_many_rigs_go_to_processes_by_themselves(monkeypatch):
    asked = []

    def workers_for(threads, where="threads"):
        asked.append(where)
        return executors.workers_for(threads, where)

    monkeypatch.setattr(mapping, "workers_for", workers_for)
    for most in (20, 21):
        monkeypatch.setattr(mapping, "_MANY", most)
        data = vi.scenario_map(None, AXES, **OPTIONS, threads=2)
        xr.testing.assert_identical(data, small())
    assert asked == ["threads", "processes", "threads", "threads"]
    monkeypatch.setattr(mapping, "_MANY", 1)
    vi.scenario_map(None, AXES, **OPTIONS, threads=1)
    assert asked[4:] == ["threads", "threads"]


def test_a_map_that_was_stopped_is_completed_to_the_same(tmp_path):
    stops = 0
    for limit in (0, 3, 5, 9, 20):
        countdown = iter(range(limit + 1))

        def stop(done: int, total: int, countdown=countdown) -> None:
            if next(countdown, None) is None:
                raise KeyboardInterrupt

        try:
            vi.scenario_map(None, AXES, **OPTIONS, store=tmp_path / "map", progress=stop)
        except KeyboardInterrupt:
            stops += 1
    assert stops >= 3
    held = zarr.open_group(tmp_path / "map", mode="r")
    done = int(np.asarray(held["done"][:]).sum())
    assert done > 0
    data = vi.scenario_map(None, AXES, **OPTIONS, store=tmp_path / "map")
    xr.testing.assert_identical(data.load(), small())


@pytest.mark.full
def test_a_process_that_was_killed(tmp_path):
    """At any moment, without a chance to tidy up."""
    code = (
        "import numpy as np, vibroimpact as vi\n"
        "vi.scenario_map(None, {'stiffness_ratio': np.geomspace(1.0, 64.0, 4),"
        f" 'gap_ratio': np.linspace(0.0, 1.0, 5)}}, **{OPTIONS!r}, store='map')\n"
    )
    kills = 0
    for delay in (0.0, 0.4, 1.0):
        child = subprocess.Popen([sys.executable, "-c", code], cwd=tmp_path)
        # Begin to count when the store is there: before that it is imports.
        waited = time.monotonic()
        while child.poll() is None and time.monotonic() - waited < 600.0:
            if (tmp_path / "map").exists():
                break
            time.sleep(0.01)
        time.sleep(delay)
        if child.poll() is None:
            os.kill(child.pid, signal.SIGKILL)
            kills += 1
        child.wait()
    assert kills
    data = vi.scenario_map(None, AXES, **OPTIONS, store=tmp_path / "map")
    xr.testing.assert_identical(data.load(), small())


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"step": 0.0}, "step"),
        ({"refine": -1}, "refine: -1"),
        ({"block": 0}, "block: 0"),
        ({"threads": 0}, "threads: 0"),
        ({"rig": 3}, "rig: 3 is not a rig"),
        (
            {"rig": vi.Rig(vi.Oscillator(1.0, vi.Isolator(1.0, 0.3)), 1.0)},
            "rig: there is no stop",
        ),
    ],
)
def test_wrong_values_are_refused(options, message):
    with pytest.raises(vi.InputError, match=message):
        vi.scenario_map(**{"rig": None, "vary": AXES, **OPTIONS, **options})


def test_a_physical_map_agrees_with_the_dimensionless_one():
    """The same nodes, reached through gap and bumper stiffness of a laboratory rig."""
    case = vi.laboratory.case("B3-10mm-A3")
    peak = case.oscillator.right.gap / vi.to_dimensionless(rig_of(case)).right.gap
    stiffness = [
        ratio * case.oscillator.isolator.stiffness for ratio in AXES["stiffness_ratio"][2:]
    ]
    gaps = [ratio * peak for ratio in AXES["gap_ratio"][1:4]]
    data = vi.scenario_map(
        rig_of(case),
        {"proportional_stiffness": stiffness, "gap": gaps},
        step=OPTIONS["step"],
        block=2,
    )
    scaled = small().isel(gap_ratio=slice(2, 7, 2), stiffness_ratio=slice(4, 7, 2))
    np.testing.assert_array_equal(data["scenario"], scaled["scenario"])
    np.testing.assert_allclose(data["peak_eta_a_forward"], scaled["peak_eta_a_forward"], rtol=1e-6)
