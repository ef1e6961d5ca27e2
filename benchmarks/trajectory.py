"""One trajectory of problem P, beside heyoka and scipy, on one thread."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from types import ModuleType
from typing import Any

import numpy as np

from benchmarks import ours
from benchmarks.floor import floor
from benchmarks.peers.problem import state_error
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, interleave, ratio

PERIODS, SCIPY_PERIODS = 1_000, 50
SHORT = (1, 10, 100)
_ROUNDS, _SCIPY_ROUNDS = 41, 11
_CONTACTS = 2

ENGINE, SIMULATE = "vibroimpact, engine", "vibroimpact, vi.simulate"
GENERAL, SPECIALISED = "heyoka, general", "heyoka, specialised to P"
SCIPY = "scipy DOP853"
_FLOOR = "event times known beforehand"


@dataclass(frozen=True, slots=True)
class Peer:
    """A solver on problem P."""

    run: Callable[[int], tuple[float, ...]]
    """From rest over a number of periods, to x, x′, ..."""
    ready: str
    """Time from nothing to the first step."""


@dataclass(frozen=True, slots=True)
class Peers:
    """The solvers that are installed, and what is missing."""

    solvers: dict[str, Peer]
    missing: list[str]


def peers() -> Peers:
    """Build the other solvers."""
    solvers: dict[str, Peer] = {}
    missing: list[str] = []
    for name, module in ((GENERAL, "heyoka_general"), (SPECIALISED, "heyoka_peer")):
        peer = optional(module, missing)
        if peer is not None:
            begin = time.perf_counter()
            built = peer.build()
            ready = f"{1e3 * (time.perf_counter() - begin):.0f} ms"
            solvers[name] = Peer(_bound(peer.run, built), ready)
    scipy = optional("scipy_peer", missing)
    if scipy is not None:
        solvers[SCIPY] = Peer(scipy.run, "none")
    return Peers(solvers, list(dict.fromkeys(missing)))


def trajectory(others: Peers, ready: str) -> list[Table]:
    """Measure.

    Parameters
    ----------
    others
        From `peers`.
    ready
        Compile time of the engine, in words.
    """
    known = floor(PERIODS)
    calls: dict[str, Callable[[], Any]] = {
        ENGINE: ours.engine(PERIODS),
        SIMULATE: ours.simulate(PERIODS),
    }
    for name in (GENERAL, SPECIALISED):
        if name in others.solvers:
            calls[name] = _bound(others.solvers[name].run, PERIODS)
    calls[_FLOOR] = known.call
    seconds = interleave(calls, _ROUNDS, clock=time.thread_time)
    periods = dict.fromkeys(calls, PERIODS)
    if SCIPY in others.solvers:
        # Beside scipy's turns of a fifth of a second the engine has rounds of its own.
        calls[SCIPY] = _bound(others.solvers[SCIPY].run, SCIPY_PERIODS)
        periods[SCIPY] = SCIPY_PERIODS
        pair = interleave(
            {ENGINE: calls[ENGINE], SCIPY: calls[SCIPY]}, _SCIPY_ROUNDS, clock=time.thread_time
        )
        seconds[SCIPY] = pair[SCIPY]
    per_period = {name: [s / periods[name] for s in values] for name, values in seconds.items()}
    behind = {
        name: ratio(values, per_period[ENGINE])
        for name, values in per_period.items()
        if name != SCIPY
    }
    if SCIPY in seconds:
        behind[SCIPY] = ratio(per_period[SCIPY], [s / PERIODS for s in pair[ENGINE]])
    errors = {
        name: state_error(periods[name], *calls[name]()[:2]) for name in calls if name != _FLOOR
    }

    table = Table(
        f"One trajectory of problem P, {PERIODS:,} forcing periods, one thread",
        ("Solver", "µs a period", "ns a contact", "Times the engine's", "State error", "Compiling"),
    )
    for name in calls:
        if name == _FLOOR:
            continue
        spread = Spread.of(per_period[name])
        table.add(
            name,
            spread.text(1e6),
            f"{1e9 * spread.median / _CONTACTS:,.0f}",
            "1" if name == ENGINE else behind[name].text(),
            f"{errors[name]:.1e}",
            ready if name in (ENGINE, SIMULATE) else others.solvers[name].ready,
        )
    table.notes.append(
        f"{_ROUNDS} rounds (scipy: {_SCIPY_ROUNDS}). scipy runs {SCIPY_PERIODS} periods, with the "
        "error after them. A contact is its landing and its detachment."
    )
    table.notes += [f"{name} is not installed and was left out." for name in others.missing]

    verdicts = targets("Targets of the trajectory")
    for name, least in ((GENERAL, 30.0), (SPECIALISED, 30.0), (SCIPY, 3000.0)):
        if name in behind:
            spread = behind[name]
            value = f"{spread.text()} times faster"
            verdicts.add(
                f"engine, than {name}",
                value,
                f"at least {least:,.0f} times",
                met(spread.median >= least),
            )
        else:
            verdicts.add(
                f"engine, than {name}", "not measured", f"at least {least:,.0f} times", "unknown"
            )
    if GENERAL in seconds:
        spread = ratio(seconds[GENERAL], seconds[SIMULATE])
        verdicts.add(
            f"{SIMULATE}, than {GENERAL}",
            f"{spread.text()} times faster",
            "at least 30 times",
            met(spread.median >= 30.0),
        )
    verdicts.add(
        "engine, state error",
        f"{errors[ENGINE]:.1e}",
        "at most 1e-11",
        met(errors[ENGINE] <= 1e-11),
    )

    bound = Table("How far the engine is from its own limit", ("Measured", "Value"))
    bound.add("contacts a period", str(known.orbit.contacts))
    bound.add("table rows checked in search of events, a period", str(known.rows))
    bound.add("roots solved to rounding, a period", str(len(known.orbit.modes)))
    spread = Spread.of(per_period[_FLOOR])
    bound.add("same motion, all event times known beforehand, ns a period", spread.text(1e9))
    engine = ratio(per_period[ENGINE], per_period[_FLOOR])
    bound.add("engine, times that", engine.text())
    return [table, verdicts, bound]


def short_runs(others: Peers) -> Table:
    """Time runs so short that setting up counts, of the engine and all others."""
    table = Table(
        "Short runs of problem P: µs a run, setting up included",
        ("Solver", *(f"{n} period{'s' if n > 1 else ''}" for n in SHORT)),
    )
    columns = []
    for n in SHORT:
        calls: dict[str, Callable[[], Any]] = {
            ENGINE: ours.engine(n),
            SIMULATE: ours.simulate(n),
        }
        calls |= {name: _bound(peer.run, n) for name, peer in others.solvers.items()}
        if n > SCIPY_PERIODS:
            calls.pop(SCIPY, None)
        seconds = interleave(calls, _SCIPY_ROUNDS, 0.005, time.thread_time)
        columns.append({name: Spread.of(values) for name, values in seconds.items()})
    for name in columns[0]:
        table.add(name, *(c[name].text(1e6) if name in c else "" for c in columns))
    table.notes.append(
        "The engine computes its tables again in each run. heyoka's integrator is compiled before "
        "the runs."
    )
    return table


def many(others: Peers) -> Table | None:
    """Time as many trajectories as heyoka's batch mode takes at once, from several starts."""
    batch = optional("heyoka_batch", [])
    if batch is None:
        return None
    built = batch.build()
    starts = np.random.default_rng(0).uniform(-0.5, 0.5, (2, batch.lanes))
    one, general = ours.engine(PERIODS), _bound(others.solvers[GENERAL].run, PERIODS)
    error = max(
        state_error(PERIODS, float(x), float(v)) for x, v in batch.run(built, starts, PERIODS).T
    )

    def repeated(call: Callable[[], Any]) -> Callable[[], None]:
        def calls() -> None:
            for _ in range(batch.lanes):
                call()

        return calls

    names = (
        f"{ENGINE}, one after the other",
        f"{GENERAL}, one after the other",
        "heyoka, batch mode, specialised to P",
    )
    calls = (repeated(one), repeated(general), _bound(batch.run, built, starts, PERIODS))
    errors = (state_error(PERIODS, *one()), state_error(PERIODS, *general()[:2]), error)
    seconds = interleave(
        dict(zip(names, calls, strict=True)), _SCIPY_ROUNDS, clock=time.thread_time
    )
    scale = 1e6 / (PERIODS * batch.lanes)
    table = Table(
        f"{batch.lanes} trajectories of problem P, one thread",
        ("Solver", "µs a period and trajectory", "Times the engine's", "State error"),
    )
    for name, off in zip(names, errors, strict=True):
        behind = "1" if name == names[0] else ratio(seconds[name], seconds[names[0]]).text()
        table.add(name, Spread.of(seconds[name]).text(scale), behind, f"{off:.1e}")
    table.notes.append(
        "The trajectories of the batch have different initial states. The other solvers run from "
        "rest. All trajectories end on the same orbit, so one reference is valid for all."
    )
    return table


def _bound(run: Callable[..., Any], *first: Any) -> Callable[..., Any]:
    return lambda *rest: run(*first, *rest)


def optional(module: str, missing: list[str]) -> ModuleType | None:
    """Import a peer, unless the package that it needs is not installed."""
    try:
        return import_module(f"benchmarks.peers.{module}")
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith("benchmarks"):
            raise
        missing.append(error.name.partition(".")[0])
        return None
