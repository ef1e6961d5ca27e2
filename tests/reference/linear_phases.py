"""A second way to see a motion: its phases one by one, by matrix exponentials.

`vi.simulate` says where each phase begins and ends. Between, the motion is linear, so that its
state anywhere in the phase follows from the one at the beginning by exp(L t): here by the plain
power series over pieces on which the fastest rate turns by less than one radian. Nothing is
shared with the engine but the events that are to be judged.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

import vibroimpact as vi

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
    """Base acceleration at the nodes."""
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


def phases(rig: vi.Oscillator, shaken: vi.Harmonic, data: xr.Dataset) -> Iterator[Phase]:
    """The phases of a simulation with samples, in order."""
    names = ("displacement", "velocity", "right_bumper", "left_bumper")
    first, last = ([float(data[name][i]) for name in names] for i in (0, -1))
    rows = np.stack([data[f"event_{name}"].values for name in names], axis=-1)
    if len(rows) and data["event_time"][0] == 0.0:
        first = rows[0].tolist()  # the first sample lies behind an event at once
    states = [Mechanics(*row) for row in [first, *rows.tolist(), last]]
    happened = [
        (EVENTS[what], side)
        for what, side in zip(
            data["event_contact"].values.tolist(), data["event_side"].values.tolist(), strict=True
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
        angle = shaken.phase + shaken.angular_frequency * within[i]
        yield _phase(rig, shaken, touched, length, angle, begin, states[i + 1], then)
        begin = states[i + 1]
        if then is None:
            return
        what, side = then
        if what == "impact":
            wall = rig.right if side == 1 else rig.left
            assert isinstance(wall, vi.RigidStop)
            begin = begin._replace(v=-wall.restitution * begin.v)
        else:
            assert (side in touched) == (what == "detach")
            touched ^= {side}


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
    shaken: vi.Harmonic,
    touched: frozenset[int],
    length: float,
    angle: float,
    begin: Mechanics,
    end: Mechanics,
    then: tuple[str, int] | None,
) -> Phase:
    stops = {1: rig.right, -1: rig.left}
    pressed = [side for side in sorted(touched) if isinstance(stops[side], vi.Bumper)]
    resting = len(pressed) < len(touched)
    # x = u less the face of a pressed bumper at rest, so that it keeps its digits.
    k, c, face, load = rig.isolator.stiffness, rig.isolator.damping, 0.0, 0.0
    x = begin.u
    if pressed:
        face = pressed[0] * stops[pressed[0]].gap
        x = begin.right if pressed[0] == 1 else begin.left
        load = -k * face
    for side in pressed:
        load += stops[side].stiffness * (side * stops[side].gap - face)
        k, c = k + stops[side].stiffness, c + stops[side].damping
    k, c, load = (value / rig.mass for value in (k, c, load))
    omega = shaken.angular_frequency

    # z = (x, v / rate, sin θ, cos θ, 1)
    rate = max(math.sqrt(k), c, omega)
    pieces = max(1, math.ceil(length * rate))
    h = length / pieces
    flow = np.zeros((5, 5))
    if not resting:
        flow[0, 1] = rate
        flow[1] = -k / rate, -c, -shaken.amplitude / rate, 0.0, load / rate
    flow[2, 3], flow[3, 2] = omega, -omega
    terms = [np.eye(5)]
    for n in range(1, _TERMS):
        terms.append(terms[-1] @ flow * (h / n))
    series = np.array(terms)
    to_nodes = np.einsum("qn,nij->qij", _POWERS, series)
    step = series.sum(axis=0)
    z = np.array([x, begin.v / rate, math.sin(angle), math.cos(angle), 1.0])
    starts = []
    for _ in range(pieces):
        starts.append(z)
        z = step @ z
    at = np.einsum("qij,pj->ipq", to_nodes, np.array(starts)).reshape(5, -1)
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
        shaken.amplitude * at[2],
        mechanics(at, time),
        begin,
        end,
        mechanics(z, length),
        then,
    )
