"""Basins of attraction: a million states, and a loop over scipy for a hundredth of them."""

import math
import time

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import vibroimpact as vi
from benchmarks import ours
from benchmarks.report import Table, met, targets

_CODE, _HERTZ = "B3-10mm-A3", 0.7
_WINDOW = (-0.012, 0.012), (-0.1, 0.1)
_SIDE = 1000
_LIMIT = 60.0
_THREADS = 2
_SHARE = 100
_CHECKED = 40
_NEAR = 1e-6
"""Distance (m) at which the loop calls a state settled."""
_MOST = 200


def basins() -> Table:
    """Measure `vi.basins` of a million states, and a loop by hand of a few of a hundredth."""
    table = targets("Basins of attraction")
    vi.basins(_CODE, *_WINDOW, frequency=_HERTZ, nodes=20)
    begin = time.perf_counter()
    data = vi.basins(_CODE, *_WINDOW, frequency=_HERTZ, nodes=_SIDE, threads=_THREADS)
    taken = time.perf_counter() - begin
    states = data["basin"].size
    table.add(
        f"{_SIDE:,} × {_SIDE:,} states of {_CODE} at {_HERTZ} Hz, {_THREADS} threads, s",
        f"{taken:.1f}",
        f"under {_LIMIT:g} s",
        met(taken < _LIMIT),
    )
    cycles = float(data["capture_cycles"].mean())
    table.add("forcing cycles a state, until it is caught", f"{cycles:.2f}", "", "")
    generator = np.random.default_rng(0)
    picked = generator.integers(0, _SIDE, (_CHECKED, 2))
    begin = time.perf_counter()
    theirs = [
        _by_hand(data, float(data["displacement"][i]), float(data["velocity"][j]))
        for i, j in picked
    ]
    each = (time.perf_counter() - begin) / _CHECKED
    ours = [int(data["basin"][j, i]) for i, j in picked]
    table.add(
        f"a loop over scipy for a hundredth ({states // _SHARE:,} states), over that, one thread",
        f"{each * states / _SHARE / taken:,.0f}",
        "",
        "",
    )
    alike = sum(a == b for a, b in zip(ours, theirs, strict=True))
    table.notes.append(
        "The loop integrates with solve_ivp (LSODA, 1e-8) until the state is near one of the "
        "motions, which are passed to it, with bumpers without memory. It is timed over "
        f"{_CHECKED} states, {alike} of which lead to the same motion as in vi.basins."
    )
    return table


def _by_hand(data: xr.Dataset, u: float, v: float) -> int:
    """Follow one state as one would without this package, the motions being known."""
    case = vi.laboratory.case(_CODE)
    rig = case.oscillator
    isolator, bumper = ours.linear(rig)
    k, c, gap = bumper.stiffness, bumper.damping, bumper.gap
    omega = 2.0 * math.pi * _HERTZ

    def rate(t: float, y: NDArray[np.float64]) -> tuple[float, float]:
        depth = abs(y[0]) - gap
        push = 0.0
        if depth > 0.0:
            push = math.copysign(max(k * depth + c * math.copysign(1.0, y[0]) * y[1], 0.0), y[0])
        force = isolator.stiffness * y[0] + isolator.damping * y[1] + push
        return y[1], -force / rig.mass - case.amplitude * math.sin(omega * t)

    places = np.column_stack([data["section_displacement"], data["section_velocity"] / omega])
    state = np.array([u, v])
    for _ in range(_MOST):
        state = solve_ivp(
            rate, (0.0, 1.0 / _HERTZ), state, "LSODA", rtol=1e-8, atol=1e-10, max_step=0.05
        ).y[:, -1]
        away = np.abs(places - state / [1.0, omega]).max(axis=1)
        if away.min() < _NEAR:
            return int(data["section_attractor"][int(away.argmin())])
    return -1
