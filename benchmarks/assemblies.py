"""Several masses, beside heyoka, scipy and OpenSeesPy, on one thread."""

import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import vibroimpact as vi
from benchmarks import fresh
from benchmarks.peers.assembly_problems import (
    ASSEMBLIES,
    CUBIC_FRAME,
    CUBIC_NEIGHBOURS,
    FRAME,
    GROUND,
    NEIGHBOURS,
    Bumper,
    Link,
    Masses,
)
from benchmarks.records import record as synthetic
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, interleave, ratio
from benchmarks.trajectory import optional
from vibroimpact.engine import batch
from vibroimpact.engine.assembly import layout, record
from vibroimpact.engine.assembly.plan import state_width
from vibroimpact.engine.flow_tables import plan_of
from vibroimpact.engine.status import Status
from vibroimpact.response.assembly_rig import assembly_numbers, link_parts
from vibroimpact.response.written_motion import EVENTS_AT_ONCE

PERIODS, SCIPY_PERIODS = 500, 50
_MOST = 1000
"""Events a period."""
_ROUNDS, _SCIPY_ROUNDS = 21, 3
_TOLERANCE = {
    NEIGHBOURS.name: 1e-13,
    FRAME.name: 1e-12,
    CUBIC_NEIGHBOURS.name: 1e-9,
    CUBIC_FRAME.name: 1e-12,
}
"""heyoka's, and with it its order: the fastest whose state error stays below 1e-11."""
_TIMES: dict[bool, tuple[float, float | None]] = {False: (10.0, 3000.0), True: (3.0, None)}
"""Of heyoka and of scipy, without a curved link and with one."""
_SIMULATE, _ENGINE = "vibroimpact, vi.simulate", "vibroimpact, engine"
_HEYOKA, _SCIPY = "heyoka, general", "scipy DOP853"

_COUNTS = (1, 2, 3, 4, 6, 8, 10, 14, 20)
_ROW_PERIODS = 100

_MILLISECONDS, _OPENSEES = 30.0, 300.0
_DIVISIONS = (1, 10, 100)


def assembly(problem: Masses) -> vi.Assembly:
    """Return a problem as users write it."""
    names = {GROUND: "ground"} | {i: f"m{i}" for i in range(len(problem.masses))}
    links: dict[str, vi.Link] = {}
    for i, (left, right, k, c, cubic) in enumerate(problem.links):
        law = vi.PolynomialIsolator(k, c, cubic) if cubic else vi.Isolator(k, c)
        links[f"l{i}"] = vi.Link(names[left], names[right], law)
    stops = {
        f"s{i}": vi.Link(names[left], names[right], vi.Bumper(k, c, gap))
        for i, (left, right, k, c, gap) in enumerate(problem.bumpers)
    }
    masses = {names[i]: mass for i, mass in enumerate(problem.masses)}
    return vi.Assembly(masses, links=links, stops=stops)


def rig(problem: Masses) -> vi.Rig:
    """Return it with what shakes it."""
    shaking = vi.Harmonic(problem.amplitude, problem.hertz, problem.phase)
    return vi.Rig(assembly(problem), shaking)


class Followed:
    """A problem as the engine follows it from rest: as `vi.simulate`, or without tables."""

    def __init__(self, problem: Masses, periods: int, tables: bool = True) -> None:
        masses = assembly(problem)
        self.problem, self.periods, self.n = problem, float(periods), len(problem.masses)
        self.vector = assembly_numbers(masses, rig(problem).periodic, tables=tables)
        self.plan = plan_of(self.vector, batch.trajectory.groups)
        self.state = np.zeros(state_width(self.n, len(masses.stops) + len(link_parts(masses))))
        self.samples = np.empty((record.samples_of(self.n, len(masses.stops)), 0))
        self.events = np.empty((_MOST + EVENTS_AT_ONCE, record.event_width(self.n)))

    def run(self) -> int:
        """Follow it; the number of events."""
        self.state[:] = 0.0
        at, events = 0, 0
        while at < self.periods:
            at, count, outcome = batch.trajectory.on(
                *(self.plan, self.vector, self.problem.amplitude, self.problem.hertz),
                *(self.problem.phase, self.state, float(at), self.periods, 0, _MOST),
                *(self.samples, self.events),
            )
            events += count
            if outcome != Status.DONE:
                raise RuntimeError("the engine gave up")
        return events


def engine(problem: Masses, periods: int, tables: bool = True) -> Callable[[], tuple[float, ...]]:
    """Return a call of the engine from rest."""
    followed = Followed(problem, periods, tables)

    def call() -> tuple[float, ...]:
        followed.run()
        return tuple(followed.state[2 : 2 + 2 * followed.n].tolist())

    return call


def counts(problem: Masses, periods: int) -> tuple[float, float]:
    """Count contacts and detachments a period, and the steps that are taken, from rest."""
    followed = Followed(problem, periods)
    before = float(followed.plan[layout.STEPS])
    events = followed.run()
    return events / periods, (float(followed.plan[layout.STEPS]) - before) / periods


def simulate(problem: Masses, periods: int) -> Callable[[], tuple[float, ...]]:
    """Return the same by the public function."""
    shaken, n = rig(problem), len(problem.masses)

    def call() -> tuple[float, ...]:
        end = vi.simulate(shaken, periods, samples=0)["final_state"]
        return tuple(end.values[: 2 * n].tolist())

    return call


def assemblies() -> list[Table]:
    """Measure each problem."""
    missing: list[str] = []
    heyoka = optional("heyoka_assemblies", missing)
    scipy = optional("scipy_assemblies", missing)
    table = Table(
        f"Several masses, {PERIODS} forcing periods, one thread",
        ("Solver", "µs a period", "Times the engine's", "State error"),
    )
    verdicts = targets("Targets of several masses")
    parts = []
    for problem in ASSEMBLIES:
        calls: dict[str, Callable[[], Any]] = {_ENGINE: engine(problem, PERIODS)}
        calls[_SIMULATE] = simulate(problem, PERIODS)
        mine = [*calls]
        if heyoka is not None:
            built = heyoka.build(problem, _TOLERANCE[problem.name])
            calls[_HEYOKA] = _bound(heyoka.run, built, PERIODS)
        of_events, of_series = counts(problem, SCIPY_PERIODS)
        said = f"{problem.name}, {of_events:.1f} and {of_series:.0f}"
        if heyoka is not None:
            said += f" (heyoka: {heyoka.steps(built, SCIPY_PERIODS) / SCIPY_PERIODS:.0f} steps)"
        parts.append(said)
        seconds = interleave(calls, _ROUNDS, clock=time.thread_time)
        for name, values in seconds.items():
            table.add(
                f"{problem.name}: {name}",
                Spread.of(values).text(1e6 / PERIODS),
                "1" if name == _ENGINE else ratio(values, seconds[_ENGINE]).text(),
                f"{problem.error(PERIODS, calls[name]()):.1e}",
            )
        least, least_of_scipy = _TIMES[problem.curved]
        for name in mine if heyoka is not None else ():
            behind = ratio(seconds[_HEYOKA], seconds[name])
            _judge(verdicts, f"{problem.name}: {name}, than heyoka", behind, least)
        if scipy is not None:
            slow = _bound(scipy.run, problem, SCIPY_PERIODS)
            fast = {name: calls[name] for name in mine}
            pair = interleave({**fast, _SCIPY: slow}, _SCIPY_ROUNDS, clock=time.thread_time)
            share = SCIPY_PERIODS / PERIODS
            slower = {
                name: ratio(pair[_SCIPY], [share * one for one in pair[name]]) for name in mine
            }
            table.add(
                f"{problem.name}: {_SCIPY}",
                Spread.of(pair[_SCIPY]).text(1e6 / SCIPY_PERIODS),
                slower[_ENGINE].text(),
                f"{problem.error(SCIPY_PERIODS, slow()):.1e}",
            )
            for name in mine:
                if least_of_scipy is not None:
                    what = f"{problem.name}: {name}, than scipy DOP853"
                    _judge(verdicts, what, slower[name], least_of_scipy)
        error = problem.error(PERIODS, calls[_ENGINE]())
        verdicts.add(
            f"{problem.name}: engine, state error",
            f"{error:.1e}",
            "at most 1e-11",
            met(error <= 1e-11),
        )
    table.notes.append(
        f"Contacts and detachments, and steps, a period: {'; '.join(parts)}. scipy runs "
        f"{SCIPY_PERIODS} periods at a relative tolerance of 1e-10. The state error is relative "
        "to the largest displacement and velocity. Linear contact modes have tables."
    )
    table.notes += [f"{name} is not installed and was left out." for name in missing]
    return [table, verdicts]


def row(n: int) -> Masses:
    """Masses side by side, each on a spring of its own and on its neighbour; a wall at the last."""
    links = [(GROUND, i, 150.0 + 30.0 * i / n, 0.9) for i in range(n)]
    links += [(i, i + 1, 50.0, 0.2) for i in range(n - 1)]
    return Masses(
        f"row of {n}",
        tuple(1.0 + 0.2 * (i % 3) for i in range(n)),
        tuple(Link(*one) for one in links),
        (Bumper(n - 1, GROUND, 2.5e4, 25.0, 0.02),),
        3.0,
        1.9,
        0.3,
        {},
    )


def masses() -> Table:
    """Time rows of 1 to 20 masses."""
    table = Table(
        "Cost of a row of masses at a wall, the engine alone: µs a period",
        ("Masses", "Without tables", "Exponent", "With tables", "Exponent"),
    )
    calls: dict[str, Callable[[], Any]] = {}
    for n in _COUNTS:
        for tables in (False, True):
            calls[f"{n} {tables}"] = engine(row(n), _ROW_PERIODS, tables)
    seconds = interleave(calls, _ROUNDS, 0.005, time.thread_time)
    before: dict[bool, tuple[int, float]] = {}
    for n in _COUNTS:
        cells = []
        for tables in (False, True):
            spread = Spread.of(seconds[f"{n} {tables}"])
            cells.append(spread.text(1e6 / _ROW_PERIODS))
            if tables in before:
                m, least = before[tables]
                cells.append(f"{math.log(spread.least / least) / math.log(n / m):.2f}")
            else:
                cells.append("")
            before[tables] = n, spread.least
        table.add(str(n), *cells)
    table.notes.append(
        "Two events a period. The exponent is the slope of log time over log number from the row "
        "above, of the shortest times."
    )
    return table


def moat_rig() -> vi.Rig:
    """A building of four masses between two bumpers at its base, under the record of `records`."""
    storey = vi.Isolator("400 MN/m", "2 MN s/m")
    bumper = vi.Bumper("60 MN/m", "0.6 MN s/m", "4 cm")
    building = vi.Assembly(
        {"base": "300 t", "first": "250 t", "second": "250 t", "roof": "200 t"},
        links={
            "isolator": vi.Link("ground", "base", vi.Isolator("10 MN/m", "0.9 MN s/m")),
            "storey_1": vi.Link("base", "first", storey),
            "storey_2": vi.Link("first", "second", storey),
            "storey_3": vi.Link("second", "roof", storey),
        },
        stops={
            "right": vi.Link("base", "ground", bumper),
            "left": vi.Link("ground", "base", bumper),
        },
    )
    return vi.Rig(building, synthetic())


def moat() -> Table:
    """Time a building at its moat under a record, and OpenSees beside it."""
    shaken = moat_rig()
    whole = vi.simulate(shaken)
    count = len(shaken.record.acceleration)
    table = targets(f"Four masses at their moat under a record of {count:,} samples, warm")
    seconds = interleave(
        {
            "samples": lambda: vi.simulate(shaken),
            "end": lambda: vi.simulate(shaken, samples=0),
        },
        _SCIPY_ROUNDS,
        clock=time.thread_time,
    )
    spreads = {name: Spread.of(values) for name, values in seconds.items()}
    for name, what in (
        ("samples", "vi.simulate, every sample and event, ms"),
        ("end", "vi.simulate, final state alone, ms"),
    ):
        table.add(
            what,
            spreads[name].text(1e3),
            f"under {_MILLISECONDS:g} ms",
            met(1e3 * spreads[name].median < _MILLISECONDS),
        )
    touches = int((whole["event_contact"] == 1).sum())
    exact = whole["displacement"].sel(mass="base").values[:count]
    peak = float(np.abs(exact).max())
    table.notes.append(
        f"The base has {touches} contacts and a peak of {1e3 * peak:.4f} mm at the samples."
    )
    missing: list[str] = []
    peer = optional("opensees_assembly", missing)
    table.notes += [f"{name} is not installed and was left out." for name in missing]
    if peer is None:
        return table
    for divisions in _DIVISIONS:
        begin = time.thread_time()
        displacement = peer.follow(shaken.system, "base", shaken.record, divisions)
        spent = time.thread_time() - begin
        error = float(np.abs(displacement - exact).max()) / peak
        for name, what in (("samples", "every sample and event"), ("end", "final state alone")):
            times = spent / spreads[name].median
            last = divisions == _DIVISIONS[-1]
            table.add(
                f"OpenSeesPy, {divisions} steps a sample: times as long as {what}",
                f"{times:,.0f} ({spent:.2f} s), off by {error:.1e} of the peak",
                f"at least {_OPENSEES:g} times" if last else "",
                met(times >= _OPENSEES) if last else "",
            )
    table.notes.append(
        "OpenSeesPy is off by the largest difference at any sample. With any of these numbers of "
        "steps it does not reach the accuracy of vi.simulate, so that at the same error the ratio "
        "is larger than in the last rows."
    )
    return table


_FIRST = """
import time
import vibroimpact as vi
link = vi.Isolator(100.0, 1.0)
def first(n, law, stop):
    names = ["ground", *(f"m{{i}}" for i in range(n))]
    links = {{a: vi.Link(b, a, law) for b, a in zip(names, names[1:])}}
    rig = vi.Rig(
        vi.Assembly({{a: 1.0 for a in names[1:]}}, links=links,
                    stops={{"s": vi.Link(names[-1], "ground", stop)}}),
        vi.Harmonic(2.0, 1.6),
    )
    begin = time.perf_counter()
    {call}
    return time.perf_counter() - begin
print(first(2, link, vi.Bumper(1e4, 10.0, 0.01)))
print(first(5, link, vi.RigidStop(0.6, 0.01)))
cubic = vi.PolynomialIsolator(100.0, 1.0, 1e4)
print(first(2, cubic, vi.Bumper(1e4, 10.0, 0.01)))
print(first(3, vi.BilinearIsolator(400.0, 60.0, 2.0, 0.5), vi.PowerBumper(1e5, 0.01)))
"""
_CALLS = {"vi.simulate": "vi.simulate(rig, 3)", "vi.sweep": "vi.sweep(rig, [1.5, 1.6])"}
_SHAPES = (
    "two masses, linear",
    "then five masses at a rigid stop",
    "then two masses, a cubic link",
    "then three masses, bilinear links, a Hertzian stop",
)


def first_use() -> Table:
    """Time first uses in a new process that has an empty cache."""
    table = targets("First use of an assembly, in a new process with an empty cache")
    for name, call in _CALLS.items():
        for engine in ("library", "numba"):
            with fresh.empty_cache() as environment:
                ended = fresh.python(
                    _FIRST.format(call=call), {**environment, "VIBROIMPACT_ENGINE": engine}
                )
                compiled = fresh.compiled(environment)
            for shape, seconds in zip(_SHAPES, ended.output.split(), strict=True):
                table.add(
                    f"{name}, {engine}: {shape}, s",
                    f"{float(seconds):.2g}",
                    "under 15 s",
                    met(float(seconds) < 15),
                )
            if engine == "library":
                table.add(f"{name}: functions compiled", str(compiled), "0", met(not compiled))
            else:
                table.add(f"{name}, {engine}: functions compiled", str(compiled), "", "")
    return table


def _judge(verdicts: Table, what: str, behind: Spread, least: float) -> None:
    value = f"{behind.text()} times faster"
    verdicts.add(what, value, f"at least {least:,.0f} times", met(behind.median >= least))


def _bound(run: Callable[..., Any], *first: Any) -> Callable[[], Any]:
    return lambda: run(*first)
