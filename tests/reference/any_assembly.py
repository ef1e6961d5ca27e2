"""Assemblies with curved links and stops to forty digits, by Taylor series.

What `any_law` is for one mass, for several: all unknowns have a series of each step, laws are
polynomials in them, and the first zero of each function that ends a piece is proved to be the first
(`first_zero`). A pressed stop of a fractional power p/q has the unknown w with depth w^q, and all
series are in a variable in which time goes as the product of q w^(q - 1) of all of these.

A link with friction sticks while the force that holds its ends together is within that of friction.
Out of reach are two links that stick at once, dashpots of a power, chatter with rest, and what
happens at one instant.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from mpmath import mp, mpf

import vibroimpact as vi
from reference import laws_mpmath as laws
from reference.any_law import DIGITS, SLOWEST
from reference.first_zero import polynomial_value
from reference.jets import Jet, Tape, Unknown, number, rescaled, value, zero_of_jet
from reference.law_series import law_of, restoring
from reference.law_stops import Side, times
from reference.shaking import Sines

_PLACES = 33
"""At which a slope's sign is looked at to find the extremes of a step."""


class Event(NamedTuple):
    """Its time (s), the stop, and what happened: contact, detach or impact."""

    time: mpf
    stop: str
    kind: str


@dataclass
class Motion:
    """States (u and v of all masses) at the start and after each period, events, and extremes."""

    states: list[tuple[mpf, ...]] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    peaks: dict[str, mpf] = field(default_factory=dict)
    """Of each mass the largest |u| (m)."""
    forces: dict[str, mpf] = field(default_factory=dict)
    """Of each stop the largest force (N); none of a rigid one."""


class _Ends(NamedTuple):
    """The masses at both ends of a link or stop, by number; None for the base."""

    left: int | None
    right: int | None

    def apart(self, x: list[Any]) -> Any:
        """x_left - x_right."""
        if self.left is None:
            assert self.right is not None
            return x[self.right] * -1
        return x[self.left] if self.right is None else x[self.left] - x[self.right]


class _Link:
    """A link, with its memory and where on its law it is."""

    def __init__(self, ends: _Ends, isolator: Any) -> None:
        self.ends, self.law = ends, law_of(isolator)
        if isolator.damping_exponent != 1:
            raise ValueError(f"{isolator} is out of reach")
        self.damping = mpf(isolator.damping)
        self.friction = mpf(getattr(self.law, "friction", 0))
        smooth = isinstance(self.law, laws.Linear | laws.Polynomial)
        self.turns = bool(self.friction) or not smooth
        self.z, self.branch, self.way, self.sticks = mpf(0), 0, 0, False

    def moves(self, rate: mpf) -> None:
        """Note which way s = u_right - u_left goes."""
        way = laws.sign(rate)
        if way != self.way and isinstance(self.law, laws.Bilinear):
            self.branch = 0
        self.way = way
        if self.friction:
            self.sticks = not way
        if isinstance(self.law, laws.BoucWen):
            self.branch = laws.sign(self.z) or way


class _Stop:
    """A stop, and whether it is pressed."""

    def __init__(self, name: str, ends: _Ends, law: Any, masses: list[mpf]) -> None:
        if isinstance(law, vi.JankowskiBumper) and law.mass is None:
            parts = [1 / masses[i] for i in ends if i is not None]
            law = law.replace(mass=float(1 / sum(parts)))
        self.name, self.ends, self.side = name, ends, Side(name, 1, law)
        self.pressed, self.clamped, self.way = False, False, 1
        self.chi, self.w, self.memory = mpf(0), mpf(0), mpf(0)


def follow(
    rig: vi.Rig,
    cycles: int,
    start: vi.State | None = None,
    order: int = 44,
    digits: int = 42,
    extremes: bool = True,
) -> Motion:
    """Follow an assembly over whole forcing periods of a shaken base.

    Parameters
    ----------
    rig
        By the public interface. Floats are taken as the exact binary numbers.
    cycles
        How many.
    start
        Displacements and velocities at t = 0, nothing touched. Links that turn must move there.
    order, digits
        Of the series, and how small its last terms are. Two orders are two runs.
    extremes
        Whether peaks and forces are looked for.
    """
    with mp.workdps(DIGITS):
        run = _Run(rig, start, order, int(digits * 3.33), extremes)
        run.note_state()
        for n in range(cycles):
            run.through((n + 1) * run.shaking.period)
            run.note_state()
    return run.motion


class _Run:
    """Where the motion is, and what piece of it."""

    def __init__(
        self, rig: vi.Rig, start: vi.State | None, order: int, tolerance: int, extremes: bool
    ) -> None:
        assembly, shaken = rig.system, rig.harmonic
        self.order, self.tolerance, self.extremes = order, tolerance, extremes
        self.names = list(assembly.names)
        self.masses = [mpf(assembly.masses[name]) for name in self.names]
        self.load = [mpf(assembly.forces.get(name, 0.0)) for name in self.names]
        at = {name: i for i, name in enumerate(self.names)} | {"ground": None}

        def ends(one: Any) -> _Ends:
            return _Ends(at[one.left], at[one.right])

        self.links = [_Link(ends(one), one.law) for one in assembly.links.values()]
        self.stops = [
            _Stop(name, ends(one), one.law, self.masses) for name, one in assembly.stops.items()
        ]
        self.shaking = Sines([shaken.amplitude], shaken.frequency, shaken.phase)
        self.t, n = mpf(0), len(self.names)
        initial = (start.displacement, start.velocity) if start is not None else ({}, {})
        self.u, self.v = ([mpf(one.get(name, 0.0)) for name in self.names] for one in initial)
        for link in self.links:
            link.moves(-link.ends.apart(self.v))
            if link.turns and not link.way:
                raise ValueError("a link that turns must move at the start")
        if any(stop.ends.apart(self.u) >= stop.side.gap for stop in self.stops):
            raise ValueError("the start touches a stop")
        self.step = self.shaking.period / 1000
        self.known: dict[Any, int] = {}
        self.changes_here = 0
        self.motion = Motion(peaks=dict.fromkeys(self.names, mpf(0)))
        self.motion.forces = {s.name: mpf(0) for s in self.stops if not s.side.rigid}
        assert len(self.u) == n

    def note_state(self) -> None:
        """Keep where it is."""
        self.motion.states.append((*self.u, *self.v))

    def through(self, end: mpf) -> None:
        """Go on to a time."""
        while self.t < end:
            self._step(end)

    # -- one step

    def _step(self, end: mpf) -> None:
        tape = Tape()
        waiting, pressing = self._series(tape)
        waiting.append(("end", self.jet_t * -1 + end))
        tape.run(self.step, self.order)
        factor = tape.stretch(self.tolerance)
        at, what = mpf(1), None
        for key, jet in waiting:
            zero = zero_of_jet(rescaled(jet.c, factor), self.known.get(key, 0))
            if zero is not None and zero < at:
                at, what = zero, key

        def series(jet: Jet) -> list[int]:
            return rescaled(jet.c, factor)

        def now(jet: Jet) -> mpf:
            return value(series(jet), at)

        if self.extremes:
            for name, jet in zip(self.names, self.jets_u, strict=True):
                self.motion.peaks[name] = max(self.motion.peaks[name], _largest(series(jet), at))
            for stop, jet in pressing:
                largest = _largest(series(jet), at)
                self.motion.forces[stop.name] = max(self.motion.forces[stop.name], largest)
        self.step *= factor
        if at > 0:
            self.known, self.changes_here = {}, 0
        self.t = now(self.jet_t)
        self.u, self.v = ([now(jet) for jet in jets] for jets in (self.jets_u, self.jets_v))
        for link, jet in zip(self.links, self.jets_z, strict=True):
            link.z = now(jet)
        for stop in self.stops:
            if stop in self.jets_memory:
                stop.memory = now(self.jets_memory[stop])
                if stop.memory < mpf(10) ** -80:
                    stop.memory = mpf(0)
            if stop in self.jets_w:
                stop.w = now(self.jets_w[stop])
        if what == "end":
            self.t = end
        elif what is not None:
            self._change(*what)

    def _series(self, tape: Tape) -> tuple[list[tuple[Any, Jet]], list[tuple[_Stop, Jet]]]:
        """What ends the piece where it falls to zero, and the forces of pressed stops."""
        n = len(self.names)
        self.jet_t = t = Unknown(tape, self.t)
        (order, size, turned), *_ = self.shaking.parts
        angle = order * (self.shaking.omega * self.t + self.shaking.phase) + turned
        sine, cosine = Unknown(tape, mp.sin(angle)), Unknown(tape, mp.cos(angle))
        self.jets_u = u = [Unknown(tape, one) for one in self.u]
        self.jets_v = v = [Unknown(tape, one) for one in self.v]
        self.jets_z = [Unknown(tape, link.z) for link in self.links]
        curved = [s for s in self.stops if s.pressed and s.side.curved]
        self.jets_w = {stop: Unknown(tape, stop.w) for stop in curved}
        steep = {
            stop: self.jets_w[stop].power(stop.side.root - 1) * stop.side.root
            for stop in curved
            if stop.side.root > 1
        }
        clock: Jet | None = None
        for one in steep.values():
            clock = times(one, clock)
        force = [tape.constant(one) for one in self.load]

        def push(ends: _Ends, jet: Jet) -> None:
            """Of the left body to the left, of the right one to the right."""
            if ends.left is not None:
                force[ends.left] = force[ends.left] - jet
            if ends.right is not None:
                force[ends.right] = force[ends.right] + jet

        waiting: list[tuple[Any, Jet]] = []
        for i, (link, z) in enumerate(zip(self.links, self.jets_z, strict=True)):
            s, rate = (link.ends.apart(x) * -1 for x in (u, v))
            here = -link.ends.apart(self.u)
            way, branch = link.way, link.branch
            jet = restoring(link.law, tape, s, times(rate, clock), z, way, branch, here)
            if link.friction and not link.sticks:
                jet = jet + link.friction * way
            push(link.ends, (jet + rate * link.damping) * -1)
            if link.turns and not link.sticks:
                waiting.append((("turn", i), rate * way))
            if isinstance(link.law, laws.Bilinear) and not branch:
                waiting.append((("yield", i), z * -way + link.law.limit))
            if isinstance(link.law, laws.BoucWen):
                waiting.append((("zero", i), z * branch))
        pressing = []
        self.jets_memory = {}
        for i, stop in enumerate(self.stops):
            side, s, rate = stop.side, stop.ends.apart(u), stop.ends.apart(v)
            if not stop.pressed:
                clearance = s * -1 + side.gap
                if stop.memory:
                    memory = Unknown(tape, stop.memory)
                    memory.rate = times(memory * -side.rate, clock)
                    self.jets_memory[stop] = memory
                    clearance = clearance + memory
                waiting.append((("touch", i), clearance))
                continue
            w = self.jets_w.get(stop)
            jet, margin = side.pressing(s, rate, w, stop.way, stop.chi)
            waiting.append((("part", i), jet if w is None else w))
            if w is not None:
                # dw/dt = depth'/(q w^(q-1)), of which the clock has the denominator.
                others = None
                for other, one in steep.items():
                    if other is not stop:
                        others = times(one, others)
                w.rate = times(rate, others if stop in steep else clock)
            if isinstance(side.stop, vi.JankowskiBumper):
                waiting.append((("slow", i), rate * stop.way))
            if margin is not None:
                waiting.append((("clamp", i), margin * (-1 if stop.clamped else 1)))
            if not stop.clamped:
                push(stop.ends, jet)
                pressing.append((stop, jet))
        base = sine * size
        for i, link in enumerate(self.links):
            if link.sticks:
                hold = self._hold(link, force, base)
                push(link.ends, hold)
                waiting += [
                    (("left", i), hold * -1 + link.friction),
                    (("right", i), hold + link.friction),
                ]
        for i in range(n):
            u[i].rate = times(v[i], clock)
            v[i].rate = times(force[i] * (1 / self.masses[i]) - base, clock)
        t.rate = clock if clock is not None else tape.constant(1)
        turn = order * self.shaking.omega
        sine.rate, cosine.rate = times(cosine * turn, clock), times(sine * -turn, clock)
        return waiting, pressing

    def _hold(self, link: _Link, force: list[Any], base: Any) -> Any:
        """Force on the right body that holds the ends of a link together, of jets or numbers."""
        if sum(other.sticks for other in self.links) > 1:
            raise ArithmeticError(f"two links stick at t = {mp.nstr(self.t, 20)}")
        left, right = link.ends
        apart, ease = base * 0, mpf(0)
        for i, sign in ((left, 1), (right, -1)):
            if i is not None:
                apart = apart + (force[i] * (1 / self.masses[i]) - base) * sign
                ease += 1 / self.masses[i]
        return apart * (1 / ease)

    def _comes_to_rest(self, i: int) -> None:
        """A link with friction turns: it sticks if friction can hold it."""
        link = self.links[i]
        before, link.sticks = link.way, True
        left, right = link.ends
        if right is None:
            self.v[left] = mpf(0)
        else:
            self.v[right] = mpf(0) if left is None else self.v[left]
        tape = Tape()
        waiting, _ = self._series(tape)
        tape.run(self.step, 1)
        if any(jet.c[0] < 0 for key, jet in waiting if key in (("left", i), ("right", i))):
            link.sticks = False
            link.moves(mpf(-before))

    # -- events

    def _note(self, stop: _Stop, kind: str) -> None:
        self.motion.events.append(Event(self.t, stop.name, kind))

    def _change(self, what: str, i: int) -> None:
        self.changes_here += 1
        if self.changes_here > 8:
            raise ArithmeticError(f"{what} without end at t = {mp.nstr(self.t, 20)}")
        self.known[what, i] = 1
        if what in ("turn", "yield", "zero"):
            link = self.links[i]
            if what == "turn" and link.friction:
                self._comes_to_rest(i)
            elif what == "turn":
                link.moves(mpf(-link.way))
            elif what == "yield":
                link.z, link.branch = link.way * link.law.limit, 1
            else:
                link.z, link.branch = mpf(0), link.way
            return
        if what in ("left", "right"):
            # It slides off with neither a speed nor an acceleration.
            self.links[i].moves(mpf(-1 if what == "left" else 1))
            self.known["turn", i] = 2
            return
        stop = self.stops[i]
        side = stop.side
        if what == "slow":
            stop.way = -stop.way
        elif what == "clamp":
            stop.clamped = not stop.clamped
        elif what == "part":
            stop.pressed = stop.clamped = False
            stop.w = mpf(0)
            self.known["touch", i] = 1
            if not side.curved and side.rate is not None:
                # A damped bumper leaves the clearance and its slope zero.
                stop.memory = stop.ends.apart(self.u) - side.gap
                self.known["touch", i] = 2
            self._note(stop, "detach")
        elif side.rigid:
            self._hit(stop)
        else:
            closing = stop.ends.apart(self.v)
            stop.pressed, stop.memory, stop.w, stop.way = True, mpf(0), mpf(0), 1
            self.known["part", i] = 1 if side.curved or side.rate is None else 0
            if side.curved:
                stop.chi = side.chi if side.number is None else side.number / closing
            self._note(stop, "contact")

    def _hit(self, stop: _Stop) -> None:
        self._note(stop, "impact")
        e, closing = mpf(stop.side.stop.restitution), stop.ends.apart(self.v)
        if closing < SLOWEST or not e:
            raise ArithmeticError(f"impacts without end at t = {mp.nstr(self.t, 20)}")
        parts = {i: 1 / self.masses[i] for i in stop.ends if i is not None}
        kick = (1 + e) * closing / sum(parts.values())
        for i, share in parts.items():
            self.v[i] += kick * share * (-1 if i == stop.ends.left else 1)
        for link in self.links:
            if link.turns:
                link.moves(-link.ends.apart(self.v))
        for other in self.stops:
            if other.pressed:
                other.way = laws.sign(other.ends.apart(self.v))


def _largest(series: list[int], at: mpf) -> mpf:
    """The largest absolute value of a polynomial on [0, at]."""
    terms = [number(one) for one in series]
    slope = [n * one for n, one in enumerate(terms)][1:]
    places = [at * k / (_PLACES - 1) for k in range(_PLACES)]
    plain = np.array([float(one) for one in slope])
    signs = np.sign(np.polynomial.polynomial.polyval(np.array(places, float), plain))
    extremes = [polynomial_value(terms, mpf(0)), polynomial_value(terms, at)]
    for k in np.flatnonzero(signs[1:] * signs[:-1] <= 0):
        low, high = places[k], places[k + 1]
        rising = polynomial_value(slope, low) > 0
        for _ in range(60):  # an extreme is right to the square of that
            middle = (low + high) / 2
            if (polynomial_value(slope, middle) > 0) == rising:
                low = middle
            else:
                high = middle
        extremes.append(polynomial_value(terms, low))
    return max(map(abs, extremes))
