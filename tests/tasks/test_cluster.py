"""On a dask cluster of processes everything is as on threads, whatever dies meanwhile."""

from __future__ import annotations

import os
import signal
import threading
import time
from contextlib import contextmanager

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact.tasks.cluster import Cluster
from vibroimpact.tasks.threads import LostError, each

distributed = pytest.importorskip("distributed")
dask = pytest.importorskip("dask")

GRID = np.linspace(0.5, 3.0, 30)
SIDE = sample(12, 5)
AXES = {
    "stiffness_ratio": np.geomspace(2.0, 60.0, SIDE),
    "gap_ratio": np.linspace(0.0, 1.0, SIDE),
}


@pytest.fixture(scope="module")
def cluster():
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0"
        ) as local,
        distributed.Client(local, set_as_default=False) as client,
    ):
        yield client


@pytest.fixture(scope="module")
def on_threads():
    return vi.scenario_map(None, AXES, refine=1, block=2)


def test_sweeps(cluster):
    rigs = {"one": "B2-G1-A3", "two": "B3-G2-A2", "three": "B1-G1-A3"}
    counts = []
    there = vi.sweeps(rigs, GRID, where=cluster, progress=lambda *at: counts.append(at))
    assert there.identical(vi.sweeps(rigs, GRID))
    assert counts[-1] == (6 * len(GRID), 6 * len(GRID))


def test_demands(cluster):
    time = np.arange(0.0, 5.0, 0.01)
    record = vi.Record(np.sin(7.0 * time) * np.exp(-time / 2.0), 0.01)
    asked = ("B2-G1-A3", record, np.linspace(0.5, 3.0, 20))
    there = vi.demands(*asked, where=cluster.scheduler.address)
    assert there.identical(vi.demands(*asked))


def test_basins(cluster):
    asked = {"nodes": sample(400, 190)}  # 19 regions
    there = vi.basins("B3-10mm-A3", frequency="0.70 Hz", where=cluster, **asked)
    assert there.identical(vi.basins("B3-10mm-A3", frequency="0.70 Hz", **asked))


def _shares(**how):
    return vi.basin_stability(
        "B3-10mm-A3", frequency=0.7, vary={"gap": [0.004, 0.006]}, states=20, **how
    )


def _diagram(**how):
    case = vi.laboratory.case("B3-10mm-A3")
    shaking = vi.Harmonic(case.amplitude, 1.12)
    return vi.bifurcation_diagram(
        vi.Rig(case.oscillator, shaking), {"gap": ("5 mm", "6 mm")}, 3, **how
    )


def _growth(**how):
    return vi.lyapunov_exponents("B3-10mm-A3", [0.7, 1.1], 40, transient=10, **how)


def _designs(**how):
    return vi.design_chart("B2-G1-A3", {"gap": ["5 mm", "8 mm"]}, step=0.2, **how)


@pytest.mark.parametrize("computed", [_shares, _diagram, _growth, _designs])
def test_everything_else_of_many_tasks(cluster, computed):
    assert computed(where=cluster).identical(computed())


@pytest.mark.full
def test_a_map_outlives_workers(cluster, on_threads):
    killed = []

    def kill(done, total):
        if done > total // 3 and len(killed) < 2:
            # One that has just died may not have been missed yet.
            alive = cluster.run(os.getpid, on_error="ignore").values()
            for pid in [pid for pid in alive if pid not in killed][:1]:
                killed.append(pid)
                os.kill(pid, signal.SIGKILL)

    there = vi.scenario_map(None, AXES, refine=1, block=2, where=cluster, progress=kill)
    assert len(killed) == 2
    assert there.identical(on_threads)


@pytest.mark.full
def test_a_map_is_completed_when_the_scheduler_died(tmp_path, on_threads):
    local = distributed.LocalCluster(
        n_workers=1, threads_per_worker=2, processes=False, dashboard_address=":0"
    )
    client = distributed.Client(local, set_as_default=False)
    store = tmp_path / "map.zarr"

    def die(done, total):
        if done > total // 3:
            local.close(timeout=10)

    with pytest.raises(LostError, match="connection to the cluster was lost"):
        vi.scenario_map(None, AXES, refine=1, block=2, store=store, where=client, progress=die)
    client.close()
    left = []
    again = vi.scenario_map(
        None, AXES, refine=1, block=2, store=store, progress=lambda *at: left.append(at[0])
    )
    assert left[0] > 0  # what was done is not done again
    assert again.load().identical(on_threads)


def _length(item, tally):
    return len(item)


def test_no_message_is_larger_than_the_scheduler_likes(cluster, recwarn):
    items = [bytes(2_000_000)[i:] for i in range(12)]
    there = each(_length, items, threads=Cluster(cluster))
    assert there == [len(item) for item in items]
    assert not [str(one.message) for one in recwarn if "large graph" in str(one.message)]


def _raising(item, _):
    if item == 3:
        raise vi.InputError("gap: 3")
    return item


def test_what_a_task_raises_is_raised_here(cluster):
    with pytest.raises(vi.InputError, match="gap: 3"):
        each(_raising, range(6), threads=Cluster(cluster))
    assert each(lambda item, _: item, range(3), threads=Cluster(cluster)) == [0, 1, 2]


def test_ctrl_c_leaves_no_task(cluster):
    def stop(done, total):
        raise KeyboardInterrupt

    before = set(cluster.futures)  # an error's traceback may hold one
    with pytest.raises(KeyboardInterrupt):
        each(
            lambda item, _: time.sleep(0.5 * (item > 0)),
            range(20),
            threads=Cluster(cluster),
            progress=stop,
        )
    end = time.monotonic() + 120.0
    while not set(cluster.futures) <= before and time.monotonic() < end:
        time.sleep(0.05)
    assert set(cluster.futures) <= before


def test_a_result_that_cannot_be_fetched_is_told(cluster, monkeypatch):
    async def gather(*_, **__):
        raise OSError("no route")

    monkeypatch.setattr(type(cluster), "_gather", gather)
    monkeypatch.setattr(distributed.Future, "result", _lost)
    with pytest.raises(LostError, match=r"connection to the cluster was lost; .*no route"):
        each(lambda item, _: item, range(4), threads=Cluster(cluster))


def _lost(future, **_):
    raise OSError("no route")


def _dies(item, _):
    os.kill(os.getpid(), signal.SIGKILL)


@contextmanager
def _local(workers, **how):
    with (
        distributed.LocalCluster(
            n_workers=workers, threads_per_worker=1, dashboard_address=":0", **how
        ) as local,
        distributed.Client(local, set_as_default=False) as client,
    ):
        yield local, client


def test_a_task_that_kills_its_workers_is_told():
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 0}),
        _local(1, processes=True) as (_, client),
        pytest.raises(LostError, match="a task made the workers of the cluster fail"),
    ):
        each(_dies, range(1), threads=Cluster(client))


def test_a_cluster_that_is_closed_while_items_are_left_is_told():
    with (
        _local(2, processes=False) as (local, client),
        pytest.raises(LostError, match="connection to the cluster was lost"),
    ):
        each(
            lambda item, _: time.sleep(0.1),
            range(60),
            threads=Cluster(client),
            progress=lambda *_: local.close(timeout=10),
        )


def test_a_cluster_without_workers_is_told_and_not_waited_for_for_ever(monkeypatch, capsys):
    monkeypatch.setattr("vibroimpact.tasks.cluster._ASKED", 0.1)
    monkeypatch.setattr("vibroimpact.tasks.cluster._SOON", 0.3)
    monkeypatch.setattr("vibroimpact.tasks.cluster._LONGEST", 1.0)
    with (
        _local(0, processes=False) as (_, client),
        pytest.raises(LostError, match="has had no worker for 1 s"),
    ):
        each(lambda item, _: item, range(3), threads=Cluster(client))
    assert capsys.readouterr().err == (
        "vibroimpact: the cluster has no worker; waiting for one, at most 1 s ...\n"
    )


def test_workers_that_come_late_are_waited_for(monkeypatch):
    monkeypatch.setattr("vibroimpact.tasks.cluster._ASKED", 0.1)
    with _local(0, processes=False) as (local, client):
        late = threading.Timer(1.0, lambda: local.scale(1))
        late.start()
        assert each(lambda item, _: item, range(3), threads=Cluster(client)) == [0, 1, 2]


def test_a_closed_client_is_refused():
    with _local(0, processes=False) as (_, client):
        pass
    with pytest.raises(vi.InputError, match="where: this client is closed"):
        vi.sweeps(["B2-G1-A3"], GRID, where=client)
    with pytest.raises(LostError, match="connection to the cluster was lost"):
        each(lambda item, _: item, range(3), threads=Cluster(client))


@pytest.mark.full
def test_workers_that_join_later_take_part():
    joined = []
    with _local(1, processes=False) as (local, client):
        names = each(
            lambda item, _: time.sleep(0.3) or threading.get_ident(),
            range(24),
            threads=Cluster(client),
            progress=lambda *_: joined or joined.append(local.scale(3)),
        )
    assert len(set(names)) == 3


@pytest.mark.full
def test_threads_and_a_cluster_exclude_one_another(cluster):
    message = (
        r"^threads: 2 has no effect with where=.*, because each worker of a cluster sets its own "
        "number of threads; leave threads out, or pass where='threads' or 'processes'$"
    )
    with pytest.raises(vi.InputError, match=message):
        vi.sweeps(["B2-G1-A3"], GRID, threads=2, where=cluster)
