"""Smooth laws that are not linear, beside heyoka and scipy, on one thread."""

import math
import time
from collections.abc import Callable
from typing import Any

import vibroimpact as vi
from benchmarks import ours
from benchmarks.peers.smooth_problems import BOUC_WEN, DUFFING, HUNT_CROSSLEY, SMOOTH, Smooth
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, interleave, ratio
from benchmarks.trajectory import optional
from vibroimpact.response.engine_system import engine_rig

PERIODS, SCIPY_PERIODS = 200, 50
_ROUNDS, _SCIPY_ROUNDS = 41, 3
_LEAST, _LEAST_OF_SCIPY = 3.0, 300.0
_TOLERANCE = {DUFFING.name: 1e-9, HUNT_CROSSLEY.name: 1e-14, BOUC_WEN.name: 1e-9}
_SCIPY_TOLERANCE = {DUFFING.name: 1e-11, HUNT_CROSSLEY.name: 1e-12, BOUC_WEN.name: 1e-11}
"""heyoka's, and with it its order: the fastest whose state error stays below 1e-11; and scipy's."""


def rig(problem: Smooth) -> vi.Oscillator:
    """As users write it, of mass 1 kg."""
    stop: vi.PowerBumper | vi.Bumper = vi.Bumper(
        problem.stiffness, problem.dissipation, problem.gap
    )
    if problem.power:
        stop = vi.PowerBumper(problem.stiffness, problem.gap, dissipation=problem.dissipation)
    isolator: Any = vi.Isolator(1.0, problem.damping)
    if problem.hysteretic:
        isolator = vi.BoucWenIsolator(*problem.hysteretic, problem.damping)
    elif problem.cubic:
        isolator = vi.PolynomialIsolator(1.0, problem.damping, problem.cubic)
    return vi.Oscillator(1.0, isolator, stop, stop)


def engine(problem: Smooth, periods: int) -> Callable[[], tuple[float, float]]:
    """Return a call of the engine from rest over a number of forcing periods."""
    hertz, phase = problem.frequency / math.tau, -0.5 * math.pi
    vector = engine_rig(vi.Rig(rig(problem), vi.Harmonic(problem.amplitude, hertz, phase)))
    return ours.trajectory(vector, problem.amplitude, hertz, phase, periods)


def smooth() -> list[Table]:
    """Measure each problem."""
    missing: list[str] = []
    heyoka, scipy = optional("heyoka_smooth", missing), optional("scipy_smooth", missing)
    table = Table(
        f"Smooth laws that are not linear, {PERIODS} forcing periods, one thread",
        ("Solver", "µs a period", "Times the engine's", "State error"),
    )
    verdicts = targets("Targets of smooth laws")
    for problem in SMOOTH:
        ours = engine(problem, PERIODS)
        error = problem.error(PERIODS, *ours())
        calls: dict[str, Callable[[], Any]] = {"engine": ours}
        if heyoka is not None:
            built = heyoka.build(problem, _TOLERANCE[problem.name])
            calls["heyoka"] = _bound(heyoka.run, built, PERIODS)
        seconds = interleave(calls, _ROUNDS, clock=time.thread_time)
        scale = 1e6 / PERIODS
        table.add(
            f"{problem.name}: engine", Spread.of(seconds["engine"]).text(scale), "1", f"{error:.1e}"
        )
        if heyoka is not None:
            behind = ratio(seconds["heyoka"], seconds["engine"])
            peer_error = problem.error(PERIODS, *calls["heyoka"]())
            table.add(
                "heyoka",
                Spread.of(seconds["heyoka"]).text(scale),
                behind.text(),
                f"{peer_error:.1e}",
            )
            _judge(verdicts, f"{problem.name}, than heyoka", behind, _LEAST)
        if scipy is not None:
            tolerance = _SCIPY_TOLERANCE[problem.name]
            slow = _bound(scipy.run, problem, SCIPY_PERIODS, tolerance)
            pair = interleave(
                {"engine": ours, "scipy": slow}, _SCIPY_ROUNDS, clock=time.thread_time
            )
            share = SCIPY_PERIODS / PERIODS
            behind = ratio(pair["scipy"], [share * one for one in pair["engine"]])
            peer_error = problem.error(SCIPY_PERIODS, *slow())
            table.add(
                "scipy DOP853",
                Spread.of(pair["scipy"]).text(1e6 / SCIPY_PERIODS),
                behind.text(),
                f"{peer_error:.1e}",
            )
            _judge(verdicts, f"{problem.name}, than scipy DOP853", behind, _LEAST_OF_SCIPY)
        verdicts.add(
            f"{problem.name}, state error", f"{error:.1e}", "at most 1e-11", met(error <= 1e-11)
        )
    table.notes.append(f"All events are located. scipy runs {SCIPY_PERIODS} periods.")
    table.notes += [f"{name} is not installed and was left out." for name in missing]
    return [table, verdicts]


def _judge(verdicts: Table, what: str, behind: Spread, least: float) -> None:
    value = f"{behind.text()} times faster"
    verdicts.add(what, value, f"at least {least:,.0f} times", met(behind.median >= least))


def _bound(run: Callable[..., Any], *first: Any) -> Callable[[], Any]:
    return lambda: run(*first)
