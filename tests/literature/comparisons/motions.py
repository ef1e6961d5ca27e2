"""Motions and branches by other integrators, other programs, and the paper's own numbers."""

from __future__ import annotations

import importlib.util
import math
from functools import cache

import numpy as np
import xarray as xr

import vibroimpact as vi
from benchmarks.peers import auto07, scipy_peer
from benchmarks.peers.problem import REFERENCE, P
from literature.comparisons.comparison import AbsentError, Comparison, data
from paper import table1

# --- problem P: a sine between two Kelvin–Voigt bumpers


@cache
def problem_p(periods: int) -> tuple[float, float]:
    """Ours, x and x′ after so many periods."""
    stop = vi.Bumper(P.bumper_stiffness, P.bumper_damping, P.gap)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 2.0 * P.damping_ratio), stop, stop)
    shaken = vi.Harmonic(P.amplitude, P.frequency / math.tau, -math.pi / 2)
    x, v = vi.simulate(vi.Rig(rig, shaken), periods, samples=0)["final_state"].values[:2]
    return float(x), float(v)


def heyoka(periods: int) -> float:
    """Its x, with both bumpers as state variables."""
    if importlib.util.find_spec("heyoka") is None:
        raise AbsentError("heyoka")
    from benchmarks.peers import heyoka_general

    return heyoka_general.run(heyoka_general.build(P), periods)[0]


FIFTY = "own reference, 50 digits"
_PROBLEM_P = [
    Comparison(
        FIFTY,
        "problem P: x after 1000 periods",
        repr(REFERENCE[1000][0]),
        lambda: problem_p(1000)[0],
        1e-12,
    ),
    Comparison(
        "scipy",
        "problem P: x after 50 periods",
        lambda: scipy_peer.run(50)[0],
        lambda: problem_p(50)[0],
        1e-11,
    ),
    Comparison(
        "heyoka 7.13.2",
        "problem P: x after 1000 periods",
        "1.06916569206",
        lambda: problem_p(1000)[0],
        1e-11,
        again=lambda: heyoka(1000),
    ),
]

# --- x″ + 0.1 x′ + x = 0.2 cos Ωt between elastic stops of stiffness 10 at ±1

STOPS = vi.Oscillator(
    1.0, vi.Isolator(1.0, 0.1), vi.Bumper(10.0, 0.0, 1.0), vi.Bumper(10.0, 0.0, 1.0)
)


@cache
def elastic_stops(phase: float = 0.0) -> xr.Dataset:
    """The branch over Ω from 1 to 2.5."""
    return vi.branch(
        vi.Rig(STOPS, vi.Harmonic(0.2, 2.0 / math.tau, phase)),
        vary={"frequency": (1.0 / math.tau, 2.5 / math.tau)},
    )


def elastic_limits(kind: str, data: xr.Dataset | None = None) -> list[float]:
    """Ω of its bifurcations of one kind."""
    data = elastic_stops() if data is None else data
    values = data["bifurcation_value"].values[data["bifurcation_kind"].values == kind]
    return sorted(math.tau * values)


def elastic_grazing() -> float:
    """Ω⁴ − (2 − 4ζ²) Ω² + 1 − a² = 0, the larger root."""
    return math.sqrt(max(np.roots([1.0, -(2.0 - 4.0 * 0.05**2), 1.0 - 0.2**2]).real))


def auto_fold(which: int) -> float:
    """Ω of AUTO-07p's lower and upper limit point, its contact smoothed over 1e-5."""
    branch = auto07.continued(1e-5, 400, 0.005, 1)
    if branch is None:
        raise AbsentError("AUTO-07p")
    return sorted(branch.folds)[which]


AUTO = "AUTO-07p 0.9.2"
_STOPS = [
    Comparison(
        "another continuation",
        "elastic stops: Ω of the upper fold",
        "1.5339796",
        lambda: elastic_limits("fold")[-1],
        1e-7,
    ),
    Comparison(
        "closed form",
        "elastic stops: Ω of the grazing",
        elastic_grazing,
        lambda: min(elastic_limits("grazing"), key=lambda value: abs(value - elastic_grazing())),
        1e-11,
    ),
    Comparison(
        AUTO,
        "elastic stops: Ω of the upper fold",
        "1.53398",
        lambda: elastic_limits("fold")[-1],
        again=lambda: auto_fold(-1),
    ),
    Comparison(
        AUTO,
        "elastic stops: Ω of the lower fold",
        "1.08086",
        lambda: elastic_limits("fold")[0],
        again=lambda: auto_fold(0),
    ),
]

# --- Siconos: m = 1 g, k = 100 N/m, e = 0.9, its weight towards the stop at 0, from x = 1

SICONOS = "Siconos"
SICONOS_RIG = vi.Oscillator(
    1e-3, vi.Isolator(100.0, 0.0), None, vi.RigidStop(0.9, 0.0), force=-1e-3 * 9.81
)
BOUNCES = 10


def siconos_times() -> np.ndarray:
    """When it struck."""
    rows = np.loadtxt(data("siconos/LinearOscillatorED.ref"), skiprows=1)
    struck = np.flatnonzero(np.diff(rows[:, 0]) == 0.0)
    return rows[struck, 0]


def _siconos_ours() -> float:
    shaken = vi.Harmonic(0.0, 100.0)
    motion = vi.simulate(vi.Rig(SICONOS_RIG, shaken), 12, vi.State(1.0), samples=1)
    return float(motion["event_time"][BOUNCES - 1])


# --- the paper

PAPER = "the paper"


def _printed(names: str) -> tuple[int, int]:
    """How many numbers of Table 1 come out to the digit, and how many there are."""
    ours = table1.computed()
    pairs = [
        (table1.written(name, ours[a][name]), table1.written(name, value))
        for a, row in table1.PRINTED.items()
        for name, value in row.items()
        if name.startswith(names)
    ]
    return sum(one == other for one, other in pairs), len(pairs)


def attached_resonance() -> float:
    """Frequency (Hz) of the largest displacement of B3-0mm-A3."""
    case = vi.laboratory.case("B3-0mm-A3")
    curves = vi.sweep(
        vi.Rig(case.oscillator, case.amplitude), np.arange(500, 601) / 100, ("forward",)
    )
    excursion = curves["displacement_excursion"].squeeze()
    return float(excursion["frequency"][int(excursion.values.argmax())])


_PAPER = [
    Comparison(
        PAPER,
        "Table 1: how many of the gaps δ come out to the digit",
        "12",
        lambda: _printed("G")[0],
    ),
    Comparison(
        PAPER,
        "Table 1: how many of the stiffness ratios λ",
        "12",
        lambda: _printed("B")[0],
    ),
    Comparison(
        PAPER,
        "Section 6: resonance of B3-A3 with the bumpers attached (Hz)",
        "5.4",
        attached_resonance,
        differs="the text says “about”; its own parameters give this",
    ),
]

COMPARISONS = [
    *_PAPER,
    *_STOPS,
    *_PROBLEM_P,
    Comparison(
        SICONOS,
        f"time (s) of impact {BOUNCES} of its bouncing mass",
        lambda: float(siconos_times()[BOUNCES - 1]),
        _siconos_ours,
        1e-12,
    ),
]
