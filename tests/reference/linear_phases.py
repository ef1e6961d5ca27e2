"""A second way to see a motion: its phases one by one, by matrix exponentials.

`vi.simulate` says where each phase begins and ends. Between, the motion is linear, so that its
state anywhere in the phase follows from the one at the beginning by exp(L t): here by the plain
power series over pieces on which the fastest rate turns by less than one radian. Nothing is
shared with the engine but the events that are to be judged.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

import vibroimpact as vi
from reference.paper_signs import in_paper_signs

Array = NDArray[np.float64]

_TERMS = 30
_NODES, _WEIGHTS = (a / 2 for a in np.polynomial.legendre.leggauss(16))
_NODES = _NODES + 0.5
_POWERS = _NODES[:, None] ** np.arange(_TERMS)


class Mechanics(NamedTuple):
    """A state, or arrays of states: displacement, velocity, deformations (u_L ≤ 0)."""

    u: Array
    v: Array
    right: Array
    left: Array


class Phase(NamedTuple):
    """One phase, with its motion at the nodes of a Gauss-Legendre quadrature over its length."""

    touched: frozenset[int]
    """Bumpers pressed, and the rigid stop rested on: of -1 left, 1 right."""
    length: float
    """s."""
    weights: Array
    """s; their sum is the length."""
    base: Array
    """Base acceleration at the nodes, or what does the same as a force on the mass."""
    motion: Mechanics
    """At the nodes."""
    begin: Mechanics
    """As simulated; behind an impact with the velocity of return."""
    end: Mechanics
    """As simulated."""
    arrived: Mechanics
    """At the end, by the matrix exponential from the beginning."""
    then: tuple[str, int] | None
    """The event at its end, if there is one: contact, detach or impact, and the side."""

    @property
    def contact(self) -> int:
        """The side of the only contact, 0 if there is none."""
        (side,) = self.touched or {0}
        return side


EVENTS = {0: "detach", 1: "contact", 2: "impact"}
"""By `event_contact`."""


class Shaking(NamedTuple):
    """w' = S w, of which A_t is a linear function."""

    generator: Array
    """S, 1/s."""
    now: Array
    """w at the beginning."""
    weights: Array
    """A_t = weights · w."""
    rate: float
    """Norm of S."""


def _sines(rig: vi.Oscillator, shaken: vi.Harmonic | vi.Periodic, time: float) -> Shaking:
    """Harmonics at a time in the first cycle: (sin, cos) of each."""
    several = isinstance(shaken, vi.Periodic)
    sizes = np.array(shaken.amplitudes if several else [shaken.amplitude])
    angles = np.array(shaken.phases if several else [0.0])
    n = np.arange(1, len(sizes) + 1)
    rates = n * shaken.angular_frequency
    if shaken.of in ("displacement", "unbalance"):
        sizes = sizes * rates**2
    if shaken.of in ("force", "unbalance"):
        sizes = sizes / rig.mass
    if shaken.of != "acceleration":
        sizes = -sizes
    angle = n * (shaken.phase + shaken.angular_frequency * time) + angles
    none = np.zeros((len(n), len(n)))
    generator = np.block([[none, np.diag(rates)], [-np.diag(rates), none]])
    return Shaking(
        generator,
        np.concatenate([np.sin(angle), np.cos(angle)]),
        np.concatenate([sizes, np.zeros(len(n))]),
        float(rates[-1]),
    )


def _line(record: vi.Record, time: float, interval: float) -> Shaking:
    """A line between two samples: A_t and what it gains in a step."""
    values = np.append(record.acceleration, 0.0)
    number = min(int((time + 0.5 * interval) / record.step), len(values) - 1)
    gain = values[number + 1] - values[number] if number + 2 < len(values) else 0.0
    here = values[number] + gain * (time / record.step - number) if number + 2 < len(values) else 0
    return Shaking(
        np.array([[0.0, 1.0 / record.step], [0.0, 0.0]]),
        np.array([here, gain]),
        np.array([1.0, 0.0]),
        1.0 / record.step,
    )


def lines(rig: vi.Oscillator, record: vi.Record, data: xr.Dataset) -> Iterator[Phase]:
    """The phases of a motion through a record, one sample a step, each cut where lines meet."""
    data = in_paper_signs(data)
    names = ("displacement", "velocity", "right_bumper", "left_bumper")
    at = [
        (float(t), Mechanics(*(float(data[name][i]) for name in names)), None)
        for i, t in enumerate(data["time"].values)
    ]
    at += [
        (
            float(data["event_time"][i]),
            Mechanics(*(float(data[f"event_{name}"][i]) for name in names)),
            (
                EVENTS[int(data["event_contact"][i])],
                int(data["event_side"][i]),
            ),
        )
        for i in range(data.sizes["event"])
    ]
    at.sort(key=lambda one: one[0])
    happened = [then for _, _, then in at if then]
    begin = at[0][1]
    touched = frozenset(
        side for side in (1, -1) if _touched_first(rig, side, happened, begin, at[-1][1])
    )
    for (start, _, _), (end, state, then) in pairwise(at):
        shaking = _line(record, start, end - start)
        yield _phase(rig, shaking, touched, end - start, begin, state, then)
        begin, touched = _behind(rig, state, touched, then)


def _behind(
    rig: vi.Oscillator, state: Mechanics, touched: frozenset[int], then: tuple[str, int] | None
) -> tuple[Mechanics, frozenset[int]]:
    """State and contacts behind an event."""
    if then is None:
        return state, touched
    what, side = then
    wall = rig.right if side == 1 else rig.left
    if what == "impact":
        assert isinstance(wall, vi.RigidStop)
        return state._replace(v=-wall.restitution * state.v), touched
    assert (side in touched) == (what == "detach")
    return state, touched ^ {side}


def phases(
    rig: vi.Oscillator, shaken: vi.Harmonic | vi.Periodic, data: xr.Dataset
) -> Iterator[Phase]:
    """The phases of a simulation with samples, in order."""
    data = in_paper_signs(data)
    names = ("displacement", "velocity", "right_bumper", "left_bumper")
    first, last = ([float(data[name][i]) for name in names] for i in (0, -1))
    rows = np.stack([data[f"event_{name}"].values for name in names], axis=-1)
    if len(rows) and data["event_time"][0] == 0.0:
        first = rows[0].tolist()  # the first sample lies behind an event at once
    states = [Mechanics(*row) for row in [first, *rows.tolist(), last]]
    happened = [
        (EVENTS[what], side)
        for what, side in zip(
            data["event_contact"].values.tolist(),
            data["event_side"].values.tolist(),
            strict=True,
        )
    ]
    touched = frozenset(
        side for side in (1, -1) if _touched_first(rig, side, happened, states[0], states[-1])
    )
    end = data["cycle"].values[-1]
    cycles = [0.0, *data["event_cycle"].values, float(end // 1)]
    within = [0.0, *data["event_cycle_time"].values, float(end % 1) * shaken.period]
    begin = states[0]
    for i, then in enumerate([*happened, None]):
        length = (cycles[i + 1] - cycles[i]) * shaken.period + (within[i + 1] - within[i])
        shaking = _sines(rig, shaken, within[i])
        yield _phase(rig, shaking, touched, length, begin, states[i + 1], then)
        begin, touched = _behind(rig, states[i + 1], touched, then)


def chatters(rig: vi.Oscillator, phase: Phase) -> bool:
    """Whether a phase ends with the rest that a chatter leads to: not all impacts are listed."""
    if phase.then is None or phase.then[0] != "contact":
        return False
    return isinstance(rig.right if phase.then[1] == 1 else rig.left, vi.RigidStop)


def _touched_first(
    rig: vi.Oscillator,
    side: int,
    happened: list[tuple[str, int]],
    begin: Mechanics,
    end: Mechanics,
) -> bool:
    """Whether a motion begins in contact with a side: its first event there tells, or its ends."""
    stop = rig.right if side == 1 else rig.left
    if stop is None:
        return False
    for what, where in happened:
        if where == side:
            return what == "detach"
    if isinstance(stop, vi.RigidStop):
        return all(side * x.u == stop.gap and x.v == 0.0 for x in (begin, end))
    faces = [x.right if side == 1 else x.left for x in (begin, end)]
    return all(
        face != 0.0 and abs(side * (x.u - face) - stop.gap) <= 1e-12 * abs(x.u - face)
        for face, x in zip(faces, (begin, end), strict=True)
    )


def _phase(
    rig: vi.Oscillator,
    shaking: Shaking,
    touched: frozenset[int],
    length: float,
    begin: Mechanics,
    end: Mechanics,
    then: tuple[str, int] | None,
) -> Phase:
    stops = {1: rig.right, -1: rig.left}
    pressed = [side for side in sorted(touched) if isinstance(stops[side], vi.Bumper)]
    resting = len(pressed) < len(touched)
    # x = u less the face of a pressed bumper at rest, so that it keeps its digits.
    k, c, face, load = rig.isolator.stiffness, rig.isolator.damping, 0.0, rig.force
    x = begin.u
    if pressed:
        face = pressed[0] * stops[pressed[0]].gap
        x = begin.right if pressed[0] == 1 else begin.left
        load -= k * face
    for side in pressed:
        load += stops[side].stiffness * (side * stops[side].gap - face)
        k, c = k + stops[side].stiffness, c + stops[side].damping
    k, c, load = (value / rig.mass for value in (k, c, load))

    # z = (x, v / rate, w, 1)
    rate = max(math.sqrt(k), c, shaking.rate)
    pieces = max(1, math.ceil(length * rate))
    h = length / pieces
    size = 3 + len(shaking.now)
    flow = np.zeros((size, size))
    if not resting:
        flow[0, 1] = rate
        flow[1] = np.array([-k, -c * rate, *-shaking.weights, load]) / rate
    flow[2:-1, 2:-1] = shaking.generator
    terms = [np.eye(size)]
    for n in range(1, _TERMS):
        terms.append(terms[-1] @ flow * (h / n))
    series = np.array(terms)
    to_nodes = np.einsum("qn,nij->qij", _POWERS, series)
    step = series.sum(axis=0)
    z = np.array([x, begin.v / rate, *shaking.now, 1.0])
    starts = []
    for _ in range(pieces):
        starts.append(z)
        z = step @ z
    at = np.einsum("qij,pj->ipq", to_nodes, np.array(starts)).reshape(size, -1)
    time = (h * (np.arange(pieces)[:, None] + _NODES)).ravel()

    def mechanics(z: Array, t: Array | float) -> Mechanics:
        faces = []
        for side, was in ((1, begin.right), (-1, begin.left)):
            stop = stops[side]
            if side in pressed:
                faces.append(z[0] + (face - side * stop.gap))
            elif isinstance(stop, vi.Bumper) and stop.damping > 0.0:
                faces.append(was * np.exp(-stop.stiffness / stop.damping * np.asarray(t)))
            else:
                faces.append(np.zeros_like(z[0]))
        return Mechanics(face + z[0], z[1] * rate, *faces)

    return Phase(
        touched,
        length,
        np.tile(_WEIGHTS * h, pieces),
        shaking.weights @ at[2:-1],
        mechanics(at, time),
        begin,
        end,
        mechanics(z, length),
        then,
    )
