"""The same work on a dask cluster of two processes as on two threads."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from typing import Any

import numpy as np

import vibroimpact as vi
from benchmarks.earthquakes import record
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, interleave, ratio

_WIDTH = 2
_SIDE = 20
_ROUNDS = 5
_OVER = 1.15
_BASINS = "B3-10mm-A3", (-0.012, 0.012), (-0.1, 0.1)


def _map(**how: Any) -> object:
    axes = (
        ("stiffness_ratio", np.geomspace(2.0, 60.0, _SIDE)),
        ("gap_ratio", np.linspace(0, 1, _SIDE)),
    )
    return vi.scenario_map(None, *axes, **how)


def _demands(**how: Any) -> object:
    records = [record(seed) for seed in range(30)]
    scales, gaps = np.linspace(0.1, 3.0, 20), np.linspace(0.005, 0.020, 10)
    return vi.demands("B3-G3-A3", records, scales, intensity="PGA", gaps=gaps, **how)


def _ensemble(**how: Any) -> object:
    case = vi.laboratory.case("B2-G1-A3")
    response = partial(vi.sweeps, frequencies=np.linspace(0.5, 5.0, 100), **how)
    spread = {"gap": "normal:5%", "stops.stiffness": "lognormal:0.2"}
    return vi.ensemble(
        vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.0)), spread, response, 2048
    )


def _work() -> dict[str, Callable[..., object]]:
    """What is done at both places, by its name."""
    return {
        f"map of {_SIDE} × {_SIDE} rigs": _map,
        "basins of 1,000 × 1,000 states": partial(vi.basins, *_BASINS, frequency=0.7, nodes=1000),
        "demands of 30 records × 20 scales × 10 gaps": _demands,
        "ensemble of 2,048 rigs swept both ways": _ensemble,
    }


@contextmanager
def _cluster() -> Iterator[Any]:
    distributed: Any = import_module("distributed")
    with (
        distributed.LocalCluster(
            n_workers=_WIDTH, threads_per_worker=1, processes=True, dashboard_address=None
        ) as local,
        distributed.Client(local, set_as_default=False) as client,
    ):
        yield client


def clusters() -> Table:
    """Measure four pieces of work on threads, on a cluster and on processes."""
    table = targets(f"Two workers of a dask cluster beside {_WIDTH} threads")
    with _cluster() as client:
        places: dict[str, dict[str, Any]] = {
            "threads": {"threads": _WIDTH},
            "cluster": {"where": client},
            "processes": {"threads": _WIDTH, "where": "processes"},
        }
        for name, work in _work().items():
            taken = interleave(
                {place: partial(work, **how) for place, how in places.items()}, _ROUNDS
            )
            over = ratio(taken["cluster"], taken["threads"])
            table.add(
                f"{name}: cluster over threads",
                over.text(),
                f"under {_OVER:g}",
                met(over.median < _OVER),
            )
            others = ratio(taken["processes"], taken["threads"])
            table.add(f"{name}: processes over threads", others.text(), "", "")
            table.add(f"{name}: threads, s", Spread.of(taken["threads"]).text(), "", "")
    table.notes.append(
        f"{_ROUNDS} rounds of the same call, in turn. Cluster and processes are started before."
    )
    return table
