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

    contact: int
    """Bumper pressed: -1 left, 0 none, 1 right."""
    length: float
    """s."""
    weights: Array
    """s; their sum is the length."""
    base: Array
    """Base acceleration at the nodes."""
    motion: Mechanics
    """At the nodes."""
    begin: Mechanics
    """As simulated."""
    end: Mechanics
    """As simulated."""
    arrived: Mechanics
    """At the end, by the matrix exponential from the beginning."""


def phases(rig: vi.Oscillator, shaken: vi.Harmonic, data: xr.Dataset) -> Iterator[Phase]:
    """The phases of a simulation with samples, in order."""
    names = ("displacement", "velocity", "right_bumper", "left_bumper")
    first, last = ([float(data[name][i]) for name in names] for i in (0, -1))
    rows = np.stack([data[f"event_{name}"].values for name in names], axis=-1)
    states = [Mechanics(*row) for row in [first, *rows.tolist(), last]]
    modes = [int(data["contact"][0]), *(data["event_contact"] * data["event_side"]).values]
    if data.sizes["event"]:  # the first sample may lie behind an event at once
        modes[0] = 0 if data["event_contact"][0] else int(data["event_side"][0])
    end = data["cycle"].values[-1]
    cycles = [0.0, *data["event_cycle"].values, float(end // 1)]
    within = [0.0, *data["event_cycle_time"].values, float(end % 1) * shaken.period]
    for i, contact in enumerate(modes):
        length = (cycles[i + 1] - cycles[i]) * shaken.period + (within[i + 1] - within[i])
        angle = shaken.phase + shaken.angular_frequency * within[i]
        yield _phase(rig, shaken, int(contact), length, angle, states[i], states[i + 1])


def _phase(
    rig: vi.Oscillator,
    shaken: vi.Harmonic,
    contact: int,
    length: float,
    angle: float,
    begin: Mechanics,
    end: Mechanics,
) -> Phase:
    # x = u less the face of the pressed bumper at rest, so that it keeps its digits.
    pressed = {1: rig.right, -1: rig.left, 0: None}[contact]
    k, c, face = rig.isolator.stiffness, rig.isolator.damping, 0.0
    load = 0.0
    if pressed:
        face = contact * pressed.gap
        load = -k * face
        k, c = k + pressed.stiffness, c + pressed.damping
    k, c, load = (value / rig.mass for value in (k, c, load))
    omega = shaken.angular_frequency
    x = begin.u - face
    if contact:
        x = begin.right if contact == 1 else begin.left

    # z = (x, v / rate, sin θ, cos θ, 1)
    rate = max(math.sqrt(k), c, omega)
    pieces = max(1, math.ceil(length * rate))
    h = length / pieces
    flow = np.zeros((5, 5))
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
        for side, bumper, was in ((1, rig.right, begin.right), (-1, rig.left, begin.left)):
            if side == contact:
                faces.append(z[0])
            elif bumper and bumper.damping > 0.0:
                faces.append(was * np.exp(-bumper.stiffness / bumper.damping * np.asarray(t)))
            else:
                faces.append(np.zeros_like(z[0]))
        return Mechanics(face + z[0], z[1] * rate, *faces)

    return Phase(
        contact,
        length,
        np.tile(_WEIGHTS * h, pieces),
        shaken.amplitude * at[2],
        mechanics(at, time),
        begin,
        end,
        mechanics(z, length),
    )
