"""What closed forms say about a trajectory to fifty digits, phase by phase.

The reference integrator is judged by this; the two share the model's constants and nothing else.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise

from mpmath import mp, mpc, mpf

from reference.rig import Event, Reference, Rig, State, Stop, Wall

Shaken = tuple[float, float, float]
"""Amplitude (m/s²), frequency (Hz), phase (rad) of the base acceleration."""


def closed_form(
    coefficients: tuple[mpf, mpf, mpf], shaken: Shaken, time: mpf, state: State
) -> Callable[[mpf], tuple[mpf, mpf]]:
    """(u, v) later, for u'' + c u' + k u = b - A sin(omega t + phase), by complex exponentials."""
    stiffness, damping, load = coefficients
    amplitude, frequency, phase = map(mpf, shaken)
    omega = 2 * mp.pi * frequency
    swing = -amplitude / mpc(stiffness - omega**2, damping * omega)
    split = mp.sqrt(mpc(damping**2 / 4 - stiffness))
    roots = (split - damping / 2, -split - damping / 2)

    def forced(t: mpf) -> tuple[mpf, mpf]:
        turning = swing * mp.expj(omega * t + phase)
        return mp.im(turning) + load / stiffness, mp.im(turning * mpc(0, omega))

    here = forced(time)
    offset = (state[0] - here[0], state[1] - here[1])
    weights = [(offset[1] - roots[1 - i] * offset[0]) / (roots[i] - roots[1 - i]) for i in range(2)]

    def at(t: mpf) -> tuple[mpf, mpf]:
        u, v = forced(t)
        modes = [w * mp.exp(root * (t - time)) for w, root in zip(weights, roots, strict=True)]
        return u + mp.re(sum(modes)), v + mp.re(modes[0] * roots[0] + modes[1] * roots[1])

    return at


class Piece:
    """One phase, or a part of it. `touched` are the bumpers pressed and the wall rested on."""

    def __init__(
        self,
        rig: Rig,
        shaken: Shaken,
        touched: frozenset[str],
        begin: tuple[mpf, State],
        end: tuple[mpf, State],
    ):
        self.rig, self.shaken, self.touched = rig, shaken, touched
        self.begin, self.end = begin, end
        self.stops = {
            name: (sign, stop)
            for name, sign, stop in (("right", 1, rig.right), ("left", -1, rig.left))
            if stop is not None
        }
        self.pressed = {
            name: (sign, stop)
            for name, (sign, stop) in self.stops.items()
            if name in touched and isinstance(stop, Stop)
        }
        walls = [
            sign
            for name, (sign, s) in self.stops.items()
            if isinstance(s, Wall) and name in touched
        ]
        self.resting = walls[0] if walls else None
        stiffness, damping, load = mpf(rig.stiffness), mpf(rig.damping), mpf(0)
        for sign, stop in self.pressed.values():
            stiffness, damping = stiffness + mpf(stop.stiffness), damping + mpf(stop.damping)
            load += sign * mpf(stop.stiffness) * mpf(stop.gap)
        mass = mpf(rig.mass)
        self.coefficients = (stiffness / mass, damping / mass, load / mass)
        if self.resting:
            self.motion = lambda t: (begin[1][0], mpf(0))
        else:
            self.motion = closed_form(self.coefficients, shaken, *begin)

    def bumper(self, name: str, t: mpf) -> mpf:
        if name not in self.stops:
            return mpf(0)
        sign, stop = self.stops[name]
        if name in self.pressed:
            return self.motion(t)[0] - sign * mpf(stop.gap)
        memory = self.begin[1][2 if name == "right" else 3]
        if isinstance(stop, Wall) or not stop.damping:
            return mpf(0)
        return memory * mp.exp(-(t - self.begin[0]) * mpf(stop.stiffness) / mpf(stop.damping))

    def margin(self, name: str, t: mpf) -> mpf:
        """What of one side may not be negative: contact force (over 1000 K) or clearance."""
        u, v = self.motion(t)
        sign, stop = self.stops[name]
        unit = 1000 * mpf(self.rig.stiffness)
        if name in self.pressed:
            deformation = self.bumper(name, t)
            return sign * (mpf(stop.stiffness) * deformation + mpf(stop.damping) * v) / unit
        if name in self.touched:
            stiffness, _, load = self.coefficients
            amplitude, frequency, phase = map(mpf, self.shaken)
            base = amplitude * mp.sin(2 * mp.pi * frequency * t + phase)
            return sign * (load - base - stiffness * u) * mpf(self.rig.mass) / unit
        return mpf(stop.gap) + sign * (self.bumper(name, t) - u)


def pieces(
    rig: Rig, shaken: Shaken, run: Reference, touched: frozenset[str] = frozenset()
) -> Iterator[tuple[Piece, Event | None]]:
    """The pieces between events and periods, each with the event that ends it.

    `touched` is what the start touches; a detachment that comes first says it as well.
    """
    period = 1 / mpf(shaken[1])
    marks: list[tuple[mpf, State, Event | None]]
    marks = [(n * period, state, None) for n, state in enumerate(run.states)]
    marks += [(event.time, event[2:], event) for event in run.events]
    marks.sort(key=lambda mark: mark[0])
    for side in ("right", "left"):
        kinds = [event.kind for event in run.events if event.kind.endswith(side)]
        if kinds and kinds[0].startswith("detach"):
            touched |= {side}
    for begin, end in pairwise(marks):
        time, state = begin[:2]
        if begin[2] is not None and begin[2].kind.startswith("impact"):
            wall = rig.right if begin[2].kind == "impact_right" else rig.left
            assert isinstance(wall, Wall)
            state = (state[0], -mpf(wall.restitution) * state[1], *state[2:])
        yield Piece(rig, shaken, touched, (time, state), end[:2]), end[2]
        if end[2] is not None:
            what, side = end[2].kind.split("_")
            assert (side in touched) == (what == "detach")
            if what != "impact":
                touched ^= {side}


def largest_difference(one: Reference, other: Reference) -> mpf:
    """Over states and events; their kinds must agree."""
    assert [event.kind for event in one.events] == [event.kind for event in other.events]
    rows = [*zip(one.states, other.states, strict=True)]
    rows += [
        ((a.time, *a[2:]), (b.time, *b[2:])) for a, b in zip(one.events, other.events, strict=True)
    ]
    with mp.workdps(80):
        return max(abs(a - b) for row in rows for a, b in zip(*row, strict=True))
