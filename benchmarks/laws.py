"""What samples, other stops and other isolators cost: beside the plain trajectory of problem P."""

import time

from benchmarks import ours
from benchmarks.peers.problem import P
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, interleave
from vibroimpact.engine.parameters import Law

_PERIODS, _SAMPLES = 1_000, 256
_ROUNDS = 21
_NANOSECONDS = 30.0
_PLAIN = "problem P"
_STOPS = {
    "rigid stops, restitution 0.6, in the place of its bumpers": (0.6, P.gap),
    "its bumpers moved in by 1.005, so that both are pressed at u = 0": (
        P.bumper_stiffness,
        P.bumper_damping,
        -0.005,
    ),
}

_TIMES = 2.0
_ISOLATORS = {
    "friction of a sixth of the shaking": (Law(friction=0.1), 1.0),
    "bilinear: half its stiffness yields at 0.2": (Law(hysteretic=1.0, limit=0.2), 1.0),
}


def yielding() -> Table:
    """Time the engine on problem P with isolators that yield or slide, a period and event."""
    rigs = {_PLAIN: ours.vector()}
    rigs |= {name: ours.yielding(*law) for name, law in _ISOLATORS.items()}
    calls = {name: ours.engine(_PERIODS, rig=rig) for name, rig in rigs.items()}
    seconds = interleave(calls, _ROUNDS, clock=time.thread_time)
    counts = {name: ours.ends(_PERIODS, rig) / _PERIODS for name, rig in rigs.items()}
    table = Table(
        f"Isolators that yield or slide, {_PERIODS:,} forcing periods, the engine alone",
        ("Isolator", "µs a period", "Events a period", "Times P's, an event", "Target", "Met"),
    )
    for name, values in seconds.items():
        share = counts[_PLAIN] / counts[name]
        spread = Spread.of([share * a / b for a, b in zip(values, seconds[_PLAIN], strict=True)])
        held = ("", "") if name == _PLAIN else (f"within {_TIMES:g}", met(spread.median < _TIMES))
        table.add(
            name,
            Spread.of(values).text(1e6 / _PERIODS),
            f"{counts[name]:.2f}",
            spread.text(),
            *held,
        )
    table.notes.append(
        "Events are contacts, detachments, turns of the mass, and the beginning of yielding."
    )
    return table


def sampling() -> Table:
    """Time `vi.simulate` with samples and without."""
    table = targets("A time history of problem P, warm")
    seconds = interleave(
        {
            "with": ours.simulate(_PERIODS, samples=_SAMPLES),
            "without": ours.simulate(_PERIODS),
        },
        _ROUNDS,
        clock=time.thread_time,
    )
    count = _PERIODS * _SAMPLES
    spread = Spread.of(
        [(a - b) / count for a, b in zip(seconds["with"], seconds["without"], strict=True)]
    )
    table.add(
        "vi.simulate, ns a sample",
        spread.text(1e9),
        f"under {_NANOSECONDS:g} ns",
        met(1e9 * spread.median < _NANOSECONDS),
    )
    table.notes.append(
        f"{_PERIODS:,} periods with {_SAMPLES} samples each, minus the same without samples: "
        "displacement, velocity, acceleration, both bumpers and the contact of each sample, all "
        "events, and the labelled dataset."
    )
    return table


def laws() -> Table:
    """Time the engine on problem P with its own and with other stops."""
    rigs = {_PLAIN: ours.vector()} | {name: ours.stopped(stop) for name, stop in _STOPS.items()}
    calls = {name: ours.engine(_PERIODS, rig=rig) for name, rig in rigs.items()}
    seconds = interleave(calls, _ROUNDS, clock=time.thread_time)
    table = Table(
        f"Other stops, {_PERIODS:,} forcing periods, one thread, the engine alone",
        ("Stops", "µs a period", "Events a period", "ns an event"),
    )
    for name, values in seconds.items():
        events = ours.events(_PERIODS, rigs[name]) / _PERIODS
        spread = Spread.of(values)
        table.add(
            name,
            spread.text(1e6 / _PERIODS),
            f"{events:.2f}",
            f"{1e9 * spread.median / (_PERIODS * events):.0f}",
        )
    table.notes.append(
        "The motions differ, and so does the number of their events: contacts, impacts and "
        "detachments."
    )
    return table
