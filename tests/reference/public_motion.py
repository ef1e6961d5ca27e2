"""What `vi.simulate` is given and reports, in the words of the 50-digit reference."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr
from mpmath import mp, mpf

import vibroimpact as vi
from reference.paper_signs import in_paper_signs
from reference.rig import Reference, Rig, Stop, Wall
from reference.shaking import Lines, Shaking, Sines
from vibroimpact.model import equilibrium

WORDS = {0: "detach", 1: "contact", 2: "impact"}
"""By `event_contact`. On a rigid stop contact and detachment are the beginning and end of rest."""


class Seen(NamedTuple):
    kind: str
    """Such as 'impact_right'."""
    time: float
    """s."""
    u: float
    v: float
    """Of an impact, that before it."""


def events(data: xr.Dataset) -> list[Seen]:
    columns = ("event_contact", "event_stop", "event_time", "event_displacement", "event_velocity")
    rows = zip(*(data[name].values.tolist() for name in columns), strict=True)
    return [Seen(f"{WORDS[what]}_{stop}", time, u, v) for what, stop, time, u, v in rows]


def reference_rig(rig: vi.Oscillator) -> Rig:
    stops = (
        stop
        and (
            Wall(stop.restitution, stop.gap)
            if isinstance(stop, vi.RigidStop)
            else Stop(stop.stiffness, stop.damping, stop.gap)
        )
        for stop in (rig.right, rig.left)
    )
    isolator = rig.isolator
    return Rig(rig.mass, isolator.stiffness, isolator.damping, *stops, force=rig.force)


def reference_shaking(rig: vi.Oscillator, shaken: vi.Harmonic | vi.Periodic | vi.Record) -> Shaking:
    """What moves the base, or the base motion that does what a force on the mass does."""
    with mp.workdps(100):
        if isinstance(shaken, vi.Record):
            return Lines(shaken.acceleration.tolist(), shaken.step)
        several = isinstance(shaken, vi.Periodic)
        amplitudes = shaken.amplitudes if several else (shaken.amplitude,)
        omega = 2 * mp.pi * mpf(shaken.frequency)
        sizes = {
            "acceleration": lambda n, size: mpf(size),
            "displacement": lambda n, size: -mpf(size) * (n * omega) ** 2,
            "force": lambda n, size: -mpf(size) / mpf(rig.mass),
            "unbalance": lambda n, size: -mpf(size) * (n * omega) ** 2 / mpf(rig.mass),
        }[shaken.of]
        return Sines(
            [sizes(n, size) for n, size in enumerate(amplitudes, start=1)],
            shaken.frequency,
            shaken.phase,
            shaken.phases if several else None,
        )


def reference_start(rig: vi.Oscillator, start: vi.State | None) -> tuple[float | mpf, ...]:
    """The start, or the equilibrium, with the bumpers as far pressed as the mass reaches."""
    start = equilibrium(rig) if start is None else start
    u, v = start.displacement, start.velocity
    with mp.workdps(60):
        deformations = [
            sign * max(sign * mpf(u) - mpf(stop.gap), mpf(0))
            if isinstance(stop, vi.Bumper)
            else 0.0
            for sign, stop in ((1, rig.right), (-1, rig.left))
        ]
    return (u, v, *deformations)


SLOW = 1e-2
"""An impact slower than this share of the fastest may belong to the end of a chatter."""


def assert_agreement(data: xr.Dataset, run: Reference, span: float, tolerance: float) -> list[str]:
    """A motion sampled once a span (s) is that of the reference; its events' kinds.

    Differences of states are shares of the largest displacement or velocity, those of times
    shares of a span.
    """
    sampled = ("displacement", "velocity", "right_bumper", "left_bumper")
    signed = in_paper_signs(data)
    sections = np.stack([signed[name].values for name in sampled], axis=-1)
    known = [*run.states, *((event.u, event.v) for event in run.events)]
    size, speed = (max(abs(float(state[i])) for state in known) for i in (0, 1))
    for row, exact in zip(sections.tolist(), run.states, strict=True):
        for value, other, unit in zip(row, exact, (size, speed, size, size), strict=True):
            assert abs(float(value - other)) <= tolerance * unit

    fastest = max((abs(e.v) for e in run.events if e.kind.startswith("impact")), default=0)

    def is_compared(kind: str, v: float) -> bool:
        return not kind.startswith("impact") or abs(v) > SLOW * fastest

    exact = [event for event in run.events if is_compared(event.kind, event.v)]
    # To the reference, a contact at once is part of the start.
    compared = (e for e in events(data) if is_compared(e.kind, e.v))
    seen = [e for e in compared if e.time > 0 or "contact" not in e.kind]
    kinds = [e.kind for e in exact]
    assert [e.kind for e in seen] == kinds
    for one, other in zip(seen, exact, strict=True):
        assert abs(float(one.time - other.time)) <= tolerance * span
        assert abs(float(one.u - other.u)) <= tolerance * size
        assert abs(float(one.v - other.v)) <= tolerance * speed
    return kinds
