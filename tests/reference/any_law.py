"""A slow, independent reference for every law: the trajectory to fifty digits.

Only tests use it. It shares no method with the package, and of its code only the names of the
parameters: rigs and shakings are those of the public interface. The motion is expanded in Taylor
series of high order (`jets`) between events; the first zero of what ends a piece is found as in
`fifty_digits`, proved to be the first. The rules of bumpers and walls are those of that file.

**Singular starts.** Forces as d^1.5, d^0.25 or |v|^0.5 have no Taylor series in time where d or v
is zero. In a curved stop the unknown is w with d = w^q, and for a dashpot of exponent p/r it is s
with |v| = s^r. Both are followed in a variable tau with

    dt/dtau = (q w^(q-1)) (r s^(r-1)),

by which w' = ± v r s^(r-1) and s' = ± a q w^(q-1) are polynomials: nothing is singular, neither at
the face nor where the mass turns. Where both v and a are zero with r > 1, the start of a motion
from rest, tau stands still. There the run begins a time `INSTANT` later: any velocity below the
one that the push alone would give, its slope times INSTANT²/2, is right to that much, and dashpots
forget the difference.

**Turns.** Laws change their formula with the sign of v; so every zero of v is an event, and the
sign behind it follows from the forces there. With friction the mass may stick.

Out of reach, and refused: chatter and rest on a rigid stop, both stops at once, and exponents that
are no small fractions.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from mpmath import mp, mpf

import vibroimpact as vi
from reference import laws_mpmath as laws
from reference.jets import Jet, Tape, Unknown, rescaled, value, zero_of_jet
from reference.law_series import fraction, law_of, restoring
from reference.law_stops import Side, times
from reference.public_motion import reference_shaking
from reference.shaking import Lines

DIGITS = 105
"""To work with: a little more than the series have."""
INSTANT = mpf(10) ** -26
"""s."""
SLOWEST = mpf(10) ** -9
"""Impact, m/s; slower ones are a chatter."""


class Event(NamedTuple):
    """Its time (s), what happened, and u and v there, before an impact."""

    time: mpf
    kind: str
    u: mpf
    v: mpf


class Step(NamedTuple):
    """One step's series in x from 0 to 1, for who wants to judge them."""

    t: list[int]
    u: list[int]
    v: list[int]
    z: list[int]
    span: mpf
    """The x up to which it was gone."""
    contact: str | None
    stuck: bool
    chi: mpf
    clamped: bool


@dataclass
class Motion:
    """States (u, v) at the start and behind each period or line, the memory z there, and the
    events."""

    states: list[tuple[mpf, mpf]] = field(default_factory=list)
    memory: list[mpf] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)


def follow(
    rig: vi.Oscillator,
    shaken: vi.Harmonic | vi.Periodic | vi.Record,
    cycles: int,
    start: tuple[Any, Any] = (0, 0),
    order: int = 44,
    digits: int = 42,
    watch: Callable[[Step], None] | None = None,
) -> Motion:
    """Follow a rig over whole forcing periods, or from one sample of a record to the next.

    Parameters
    ----------
    rig, shaken
        By the public interface. Floats are taken as the exact binary numbers.
    cycles
        How many periods, or lines of a record; behind its end the base stands still.
    start
        (u, v) at t = 0, with nothing touched and no memory; m, m/s.
    order, digits
        Of the series, and how small its last terms are. Two orders are two runs.
    watch
        Is given every step.

    Returns
    -------
    Motion
        States, and events in order of time.

    Raises
    ------
    ValueError
        If the rig is out of reach.
    ArithmeticError
        If events do not come to an end: chatter.
    """
    with mp.workdps(DIGITS):
        run = _Run(rig, shaken, start, order, int(digits * 3.33), watch)
        run.note_state()
        for n in range(cycles):
            run.through(n)
            run.note_state()
    return run.motion


class _Run:
    """Where the motion is, and what piece of it."""

    def __init__(
        self,
        rig: vi.Oscillator,
        shaken: vi.Harmonic | vi.Periodic | vi.Record,
        start: tuple[Any, Any],
        order: int,
        tolerance: int,
        watch: Callable[[Step], None] | None,
    ) -> None:
        self.order, self.tolerance, self.watch = order, tolerance, watch
        self.mass, self.load = mpf(rig.mass), mpf(rig.force)
        self.law = law_of(rig.isolator)
        self.friction = mpf(getattr(self.law, "friction", 0))
        self.damping = mpf(rig.isolator.damping)
        exponent = fraction(rig.isolator.damping_exponent) if self.damping else fraction(1)
        self.degree, self.root = exponent.numerator, exponent.denominator
        pairs = (("right", 1, rig.right), ("left", -1, rig.left))
        self.sides = [Side(name, sign, stop) for name, sign, stop in pairs if stop is not None]
        self.shaking = reference_shaking(rig, shaken)
        self.span, self.begun = 0, mpf(0)
        self.t, self.z, self.u, self.v = mpf(0), mpf(0), mpf(start[0]), mpf(start[1])
        self.w, self.s = mpf(0), abs(self.v) ** (1 / mpf(self.root))
        if any(side.sign * self.u >= side.gap for side in self.sides):
            raise ValueError("the start touches a stop")
        self.memory: dict[str, mpf] = {}
        self.contact: Side | None = None
        self.chi, self.clamped, self.stuck = mpf(0), False, False
        self.way, self.branch = laws.sign(self.v), 0
        self.step = self.shaking.span(0) / 1000
        self.known: dict[Any, int] = {}
        self.changes_here = 0
        self.motion = Motion()
        if not self.v:
            self._turn()
        self._sign_of_memory()

    def note_state(self) -> None:
        """Keep where it is."""
        self.motion.states.append((self.u, self.v))
        self.motion.memory.append(self.z)

    def through(self, span: int) -> None:
        """Go on to the end of a period or line."""
        shaking = self.shaking
        if isinstance(shaking, Lines):
            self.span, self.begun = span, span * shaking.step
        end = (span + 1) * shaking.span(span)
        while self.t < end:
            self._step(end)

    # -- one step

    def _step(self, end: mpf) -> None:
        tape = Tape()
        t, u, v, z, waiting = self._series(tape)
        # Not by subtraction of jets: the end is a number.
        waiting.append(("end", t * -1 + end))
        tape.run(self.step, self.order)
        factor = tape.stretch(self.tolerance)
        at, what = mpf(1), None
        for key, jet in waiting:
            zero = zero_of_jet(rescaled(jet.c, factor), self.known.get(key, 0))
            if zero is not None and zero < at:
                at, what = zero, key

        def now(jet: Jet) -> mpf:
            return value(rescaled(jet.c, factor), at)

        if self.watch is not None:
            series = [rescaled(jet.c, factor) for jet in (t, u, v, z)]
            name = self.contact.name if self.contact else None
            self.watch(Step(*series, at, name, self.stuck, self.chi, self.clamped))
        self.step *= factor
        if at > 0:
            self.known, self.changes_here = {}, 0
        self.t, self.z = now(t), now(z)
        self.memory = {name: now(one) for name, one in self.relaxing.items()}
        self.memory = {name: one for name, one in self.memory.items() if one > mpf(10) ** -80}
        if not self.stuck:
            self.u, self.v, self.s = now(u), now(v), now(self.speed)
            if self.depth is not None:
                self.w = now(self.depth)
        if what == "end":
            self.t = end
        elif what is not None:
            self._change(what)

    def _series(self, tape: Tape) -> tuple[Jet, Jet, Jet, Jet, list[tuple[Any, Jet]]]:
        """The unknowns t, u, v, z, and what ends the piece where it falls to zero."""
        t, z = Unknown(tape, self.t), Unknown(tape, self.z)
        waves, base = [], tape.constant(0)
        if isinstance(self.shaking, Lines):
            slope = self.shaking.slope(self.span)
            base = t * slope + (self.shaking.value(self.span, 0) - slope * self.begun)
        else:
            for n, size, turned in self.shaking.parts:
                angle = n * (self.shaking.omega * self.t + self.shaking.phase) + turned
                wave = Unknown(tape, mp.sin(angle)), Unknown(tape, mp.cos(angle))
                waves.append((n * self.shaking.omega, *wave))
                base = base + wave[0] * size
        self.relaxing = {name: Unknown(tape, one) for name, one in self.memory.items()}
        waiting: list[tuple[Any, Jet]] = []
        clock: Jet | None = None
        self.depth = None
        side = self.contact
        if self.stuck:
            u, v = tape.constant(self.u), tape.constant(0)
            force = restoring(self.law, tape, u, None, z, 0, self.branch, self.u)
            push = (force * -1 + self.load) * (1 / self.mass) - base
            if side is not None:
                push = push - side.sign * side.held(self.u) / self.mass
            limit = self.friction / self.mass
            waiting += [(("slip", 1), push * -1 + limit), (("slip", -1), push + limit)]
        else:
            s = self.speed = Unknown(tape, self.s)
            v = s.power(self.root) * self.way
            slow = s.power(self.root - 1) * self.root if self.root > 1 else None
            steep: Jet | None = None
            if side is not None and side.curved:
                w = self.depth = Unknown(tape, self.w)
                if side.root > 1:
                    steep = w.power(side.root - 1) * side.root
                u = (w.power(side.root) + side.gap) * side.sign
                w.rate = times(v * side.sign, slow)
            else:
                u = Unknown(tape, self.u)
            clock = slow if steep is None else times(steep, slow)
            du = times(v, clock)
            if isinstance(u, Unknown):
                u.rate = du
            force = restoring(self.law, tape, u, du, z, self.way, self.branch, self.u)
            if self.damping:
                force = force + s.power(self.degree) * (self.damping * self.way)
            if self.friction:
                force = force + self.friction * self.way
            if side is not None:
                pressing, margin = side.pressing(u, v, self.depth, self.way, self.chi)
                waiting.append(("part", pressing if self.depth is None else self.depth))
                if margin is not None:
                    waiting.append(("clamp", margin * -1 if self.clamped else margin))
                if not self.clamped:
                    force = force + pressing * side.sign
            a = (force * -1 + self.load) * (1 / self.mass) - base
            s.rate = times(a * self.way, steep)
            waiting.append(("turn", s))
            if isinstance(self.law, laws.Bilinear) and not self.branch:
                waiting.append(("yield", z * -self.way + self.law.limit))
            if isinstance(self.law, laws.BoucWen):
                waiting.append(("zero", z * self.branch))
        t.rate = clock if clock is not None else tape.constant(1)
        for omega, sine, cosine in waves:
            sine.rate, cosine.rate = times(cosine * omega, clock), times(sine * -omega, clock)
        for other in self.sides:
            memory = self.relaxing.get(other.name)
            if memory is not None:
                memory.rate = times(memory * -other.rate, clock)
            if side is None:
                clearance = u * -other.sign + other.gap
                waiting.append(
                    (("touch", other), clearance if memory is None else clearance + memory)
                )
        return t, u, v, z, waiting

    # -- events

    def _note(self, kind: str) -> None:
        self.motion.events.append(Event(self.t, kind, self.u, self.v))

    def _change(self, what: Any) -> None:
        self.changes_here += 1
        if self.changes_here > 8:
            raise ArithmeticError(f"{what} without end at t = {mp.nstr(self.t, 20)}")
        if what == "turn":
            self.s = self.v = mpf(0)
            self._turn()
        elif what == "yield":
            self.z, self.branch = self.way * self.law.limit, 1
            self._note("yield")
        elif what == "zero":
            self.z, self.branch, self.known["zero"] = mpf(0), self.way, 1
        elif what == "part":
            self._part()
        elif what == "clamp":
            self.clamped, self.known["clamp"] = not self.clamped, 1
        elif what[0] == "slip":
            self.stuck, self.way = False, what[1]
            # Velocity and acceleration are zero.
            self.known["turn"] = 2
            self._note("slip")
            self._leave_rest()
        else:
            self._touch(what[1])

    def _push(self) -> mpf:
        """The acceleration without velocity and friction."""
        force = self.load - self.law.force(self.u, 0, self.z)
        if self.contact is not None:
            force -= self.contact.sign * self.contact.held(self.u)
        return force / self.mass - self.shaking.value(self.span, self.t - self.begun)

    def _turn(self) -> None:
        """Say where the mass goes from v = 0."""
        if isinstance(self.law, laws.Bilinear):
            self.branch = 0
        push = self._push()
        if self.friction and abs(push) <= self.friction / self.mass:
            if not self.stuck:
                self.stuck, self.way = True, 0
                self._note("stick")
            return
        self.stuck = False
        self.way = laws.sign(push)
        if not push:
            self.way = laws.sign(self._steepening())
            if not self.way:
                raise ValueError("the start is at rest, and what shakes it begins too flat")
            self._leave_rest()
        self._sign_of_memory()

    def _steepening(self) -> mpf:
        """The slope of the push at rest."""
        shaking, total = self.shaking, mpf(0)
        if isinstance(shaking, Lines):
            return -shaking.slope(self.span)
        for n, size, turned in shaking.parts:
            angle = n * (shaking.omega * self.t + shaking.phase) + turned
            total -= size * n * shaking.omega * mp.cos(angle)
        return total

    def _leave_rest(self) -> None:
        """Step over the instant in which tau would stand still."""
        if self.root > 1:
            self.t += INSTANT
            self.v = self._steepening() * INSTANT**2 / 2
            self.s = abs(self.v) ** (1 / mpf(self.root))
            self.known.pop("turn", None)
        self._sign_of_memory()

    def _sign_of_memory(self) -> None:
        if isinstance(self.law, laws.BoucWen):
            self.branch = laws.sign(self.z) or self.way

    def _touch(self, side: Side) -> None:
        if side.rigid:
            self._note(f"impact_{side.name}")
            if abs(self.v) < SLOWEST or not side.stop.restitution:
                raise ArithmeticError(f"impacts without end at t = {mp.nstr(self.t, 20)}")
            self.u, self.v = side.sign * side.gap, -self.v * mpf(side.stop.restitution)
            self.way = -self.way
            self.s = abs(self.v) ** (1 / mpf(self.root))
            if isinstance(self.law, laws.Bilinear):
                self.branch = 0
            return
        self._note(f"contact_{side.name}")
        self.contact = side
        if not self.memory.pop(side.name, None):
            self.u = side.sign * side.gap
        self.w, self.clamped = mpf(0), False
        if side.curved:
            self.chi = side.chi if side.number is None else side.number / abs(self.v)
        if self.stuck:
            self._turn()

    def _part(self) -> None:
        side = self.contact
        assert side is not None
        self.contact, self.chi, self.clamped = None, mpf(0), False
        if side.curved or side.rate is None:
            self.u = side.sign * side.gap
        else:
            # A damped bumper leaves the clearance and its slope zero.
            self.memory[side.name] = side.sign * self.u - side.gap
            self.known["touch", side] = 2
        self._note(f"detach_{side.name}")
