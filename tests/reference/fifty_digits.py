"""A slow, independent reference: the rig's trajectory to fifty digits.

Only tests use it. It shares no code and no method with the package: where the package evaluates
closed forms from tables, this file

1. expands the linear motion of each phase (flight, or contact with one bumper) in a Taylor
   series of high order, over a step so short that a bound puts the remainder below the wanted
   digits;
2. finds the first zero of the clearance (flight) or of the contact force (contact) on the step by
   Descartes' rule of signs in exact integers with bisection (Collins and Akritas), which proves
   that there is none or isolates it, and then refines it by bracketed Newton steps;
3. changes phase there and goes on.

The model and its signs are those of the paper (Section 2 and equation 5): displacement u of the
mass relative to the base, deformation u_R >= 0 of the right and u_L <= 0 of the left bumper.

- Flight: M u'' + C u' + K u = -M A sin(2 pi f t + phase), and C_j u_j' + K_j u_j = 0.
- Contact with the right bumper: u_R = u - G_R, and K_R u_R + C_R u_R' joins the left-hand side;
  the left bumper goes on relaxing. Contact with the left bumper mirrors it, u_L = u + G_L.
- Contact begins when the clearance G_R + u_R - u, or G_L + u - u_L, falls to zero, and ends when
  the contact force falls to zero.

The cost grows with the norm of the phase's matrix times its length: twenty cycles of the paper's
rig take about a second, contacts that last for thousands of M / C_j take minutes.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import NamedTuple

from mpmath import mp, mpf

from reference.first_zero import first_zero, polynomial_value

State = tuple[mpf, mpf, mpf, mpf]


@dataclass(frozen=True)
class Stop:
    """A massless bumper: stiffness (N/m, positive), damping (N s/m), initial gap (m)."""

    stiffness: float
    damping: float
    gap: float


@dataclass(frozen=True)
class Rig:
    """A mass (kg) on an isolator (N/m, N s/m) between two optional bumpers."""

    mass: float
    stiffness: float
    damping: float
    right: Stop | None = None
    left: Stop | None = None


class Event(NamedTuple):
    """A change of phase: its time (s), what happened, and the state there.

    `kind` is 'contact_right', 'detach_right', 'contact_left' or 'detach_left'.
    """

    time: mpf
    kind: str
    u: mpf
    v: mpf
    u_right: mpf
    u_left: mpf


@dataclass(frozen=True)
class Reference:
    """The states (u, v, u_R, u_L) at every forcing period, and the events in order of time."""

    states: list[State]
    events: list[Event]


def integrate(
    rig: Rig,
    amplitude: float,
    frequency: float,
    phase: float,
    start: Sequence[float],
    cycles: int,
    digits: int = 50,
    order: int = 64,
) -> Reference:
    """Follow the rig over whole forcing periods.

    Parameters
    ----------
    rig : Rig
        The mass, its isolator and its bumpers. Floats are taken as the exact binary numbers.
    amplitude, frequency, phase : float
        Base acceleration amplitude * sin(2 pi frequency t + phase); m/s^2, Hz, rad.
    start : (u, v, u_R, u_L)
        State at t = 0; m, m/s, m, m. Floats or mpf. A clearance that is zero to double rounding
        counts as touching: the bumper then presses, or lets go, as force and motion say.
    cycles : int
        Number of forcing periods 1 / frequency.
    digits : int
        Wanted correct digits of one step; a chaotic motion loses some of them on the way.
    order : int
        Order of the Taylor polynomials. The step follows from it, so two orders are two runs.

    Returns
    -------
    Reference
        States at t = 0, T, ..., cycles * T and all events. A contact that begins at t = 0 is part
        of the start and no event.

    Raises
    ------
    ValueError
        If the rig or the start is impossible.
    """
    # The terms of a series grow to exp(order / 3) before they fall; the last guard digits cover it.
    with mp.workdps(digits + 20 + order // 6):
        run = _Run(rig, amplitude, frequency, phase, start, order, mpf(10) ** -(digits + 10))
        states = [run.state]
        for _ in range(cycles):
            run.cycle()
            states.append(run.state)
    return Reference(states, run.events)


class _Side:
    """One bumper with its sign: +1 on the right, -1 on the left; `wall` is its rest position."""

    def __init__(self, name: str, sign: int, stop: Stop) -> None:
        if not (stop.stiffness > 0 and stop.damping >= 0 and stop.gap >= 0):
            raise ValueError(f"impossible {name} stop: {stop}")
        self.name = name
        self.sign = sign
        self.wall = sign * mpf(stop.gap)
        self.stiffness = mpf(stop.stiffness)
        self.damping = mpf(stop.damping)
        # Relaxation rate; an elastic bumper is back at rest at once and remembers nothing.
        self.rate = self.stiffness / self.damping if stop.damping > 0 else None


class _Run:
    """A trajectory under way: the state, the bumper in contact, and the time within the cycle."""

    def __init__(
        self,
        rig: Rig,
        amplitude: float,
        frequency: float,
        phase: float,
        start: Sequence[float],
        order: int,
        tolerance: mpf,
    ) -> None:
        if not (rig.mass > 0 and rig.stiffness >= 0 and rig.damping >= 0 and frequency > 0):
            raise ValueError(f"impossible rig or frequency: {rig}, {frequency} Hz")
        self.mass, self.stiffness, self.damping = map(mpf, (rig.mass, rig.stiffness, rig.damping))
        self.amplitude, self.phase = mpf(amplitude), mpf(phase)
        self.omega = 2 * mp.pi * mpf(frequency)
        self.period = 1 / mpf(frequency)
        self.order, self.tolerance = order, tolerance
        pairs = (("right", 1, rig.right), ("left", -1, rig.left))
        self.sides = [_Side(name, sign, stop) for name, sign, stop in pairs if stop is not None]
        self.u, self.v = mpf(start[0]), mpf(start[1])
        self.bumper = {"right": mpf(start[2]), "left": mpf(start[3])}
        self.factorial, self.size = mp.factorial(order), mpf(0)
        self.elapsed, self.cycles_done = mpf(0), 0
        self.events: list[Event] = []
        self.contact: _Side | None = None
        # How often the clearance or the force that ended the last phase vanishes here, by side.
        self.known_zeros: dict[str, int] = {}
        self.changes_here = 0
        for side in self.sides:
            self._settle(side)

    def _settle(self, side: _Side) -> None:
        """Check the start against one bumper, and undo the rounding of a touching start."""
        depth, bumper = side.sign * (self.u - side.wall), side.sign * self.bumper[side.name]
        if bumper < 0:
            raise ValueError(f"the {side.name} bumper is stretched, not pressed")
        clearance = bumper - depth
        touching = abs(clearance) <= mpf(2) ** -50 * (abs(self.u) + abs(side.wall))
        if touching and depth >= 0:
            self.bumper[side.name] = self.u - side.wall
            if side.rate is None and depth > 0:
                self.contact = side
        elif clearance < 0:
            raise ValueError(f"the mass is inside the {side.name} bumper")
        elif side.rate is None and bumper > 0:
            raise ValueError(f"the elastic {side.name} bumper is deformed without contact")

    @property
    def state(self) -> State:
        return self.u, self.v, self.bumper["right"], self.bumper["left"]

    def cycle(self) -> None:
        """Go on to the end of the forcing period."""
        while self.elapsed < self.period:
            self._step()
        self.elapsed, self.cycles_done = mpf(0), self.cycles_done + 1

    def _step(self) -> None:
        """Go on to the next event, to the end of the step or to the end of the period."""
        longest = self.period - self.elapsed
        while True:
            step, u, v = self._series(longest)
            if self.contact is not None:
                found = [(self._release(u, v), self.contact)]
                break
            touches = [(self._touch(side, u, step), side) for side in self.sides]
            limits = [limit for (_, limit), _ in touches if limit is not None]
            if not limits:
                found = [(zero, side) for (zero, _), side in touches]
                break
            longest = min(limits)
        zeros = [(zero, side) for zero, side in found if zero is not None]
        at, side = min(zeros, key=lambda pair: pair[0]) if zeros else (mpf(1), None)
        self._advance(u, v, step * at, at)
        self.known_zeros = {}
        if at > 0:
            self.changes_here = 0
        if side is not None:
            self._change_phase(side)

    def _coefficients(self) -> tuple[mpf, mpf, mpf]:
        """(k, c, b) of the phase: u'' + c u' + k u = b - A sin(...)."""
        stiffness, damping, load = self.stiffness, self.damping, mpf(0)
        if self.contact is not None:
            stiffness = stiffness + self.contact.stiffness
            damping = damping + self.contact.damping
            load = self.contact.stiffness * self.contact.wall
        return stiffness / self.mass, damping / self.mass, load / self.mass

    def _series(self, longest: mpf) -> tuple[mpf, list[mpf], list[mpf]]:
        """Step and Taylor coefficients of u and v in x = time / step, 0 <= x <= 1.

        Let z = (s u, v, 8 A / omega sin, 8 A / omega cos) with s = max(sqrt(k), omega): z' = B z,
        and the norm of B is at most s + c + omega / 8. Let z_n be the n-th coefficient of z. What
        follows the last, z_N, is at most |z_N| q / (1 - q) with q = |B| step / (N + 1). So the
        step is at most N / (3 |B|), and short enough that |z_N| is within the tolerance.
        """
        stiffness, damping, load = self._coefficients()
        scale = max(mp.sqrt(stiffness), self.omega)
        step = min(longest, self.order / (3 * (scale + damping + self.omega / 8)))
        angle, turn = self.omega * self.elapsed + self.phase, self.omega * step
        # push[n]: coefficient of b - A sin(...), the sine's from its own recurrence.
        push = [-self.amplitude * mp.sin(angle), -self.amplitude * turn * mp.cos(angle)]
        for n in range(self.order - 1):
            push.append(-(turn**2) * push[n] / ((n + 1) * (n + 2)))
        push[0] += load
        u, v = [self.u], [self.v]
        for n in range(self.order):
            weight = step / (n + 1)
            u.append(weight * v[n])
            v.append(weight * (push[n] - damping * v[n] - stiffness * u[n]))
        forcing = 8 * abs(self.amplitude) / self.omega
        self.size = abs(self.u) + (abs(self.v) + forcing) / scale
        last = scale * abs(u[-1]) + abs(v[-1]) + forcing * turn**self.order / self.factorial
        excess = last / (self.tolerance * scale * self.size) if last else mpf(0)
        if excess > 1:
            shrink = excess ** (mpf(-1) / self.order)
            powers = [shrink**n for n in range(self.order + 1)]
            u = [value * power for value, power in zip(u, powers, strict=True)]
            v = [value * power for value, power in zip(v, powers, strict=True)]
            step *= shrink
        return step, u, v

    def _release(self, u: list[mpf], v: list[mpf]) -> mpf | None:
        """First zero of the contact force on the step, as a fraction of it."""
        side = self.contact
        assert side is not None
        stiffness, damping = side.sign * side.stiffness, side.sign * side.damping
        rest = [-stiffness * side.wall]
        elastic, viscous = [stiffness * value for value in u], [damping * value for value in v]
        return self._first_zero(side, rest, elastic, viscous)

    def _touch(self, side: _Side, u: list[mpf], step: mpf) -> tuple[mpf | None, mpf | None]:
        """First zero of a clearance on the step, or a shorter step on which to ask again.

        A relaxing bumper can be far faster than the mass. Its deformation only shrinks, so its
        value at the end bounds the clearance from below: usually that proves a long step free.
        Where it does not, the step shrinks until a series of the memory converges too.
        """
        memory = side.sign * self.bumper[side.name]
        gap, inward = [side.sign * side.wall], [-side.sign * value for value in u]
        if side.rate is None or memory <= mp.eps * self.size:
            return self._first_zero(side, gap, inward), None
        decay = side.rate * step
        power = self.tolerance * self.size / memory * self.factorial
        resolved = min(power ** (mpf(1) / self.order), mpf(self.order) / 3) / side.rate
        if step <= resolved:
            relaxing = [memory]
            for n in range(self.order):
                relaxing.append(-decay * relaxing[n] / (n + 1))
            return self._first_zero(side, gap, inward, relaxing), None
        inward[0] += gap[0] + memory * mp.exp(-decay)
        zero = first_zero(inward)
        # Below the zero of the bound the step is free. Staying clear of it by a tenth keeps
        # rounding from finding the same zero again.
        return None, zero if zero is None else max(step * zero * 9 / 10, resolved)

    def _first_zero(self, side: _Side, *terms: list[mpf]) -> mpf | None:
        """First zero of a sum of series that is not the event which began the phase."""
        total = [sum(column) for column in zip_longest(*terms, fillvalue=mp.zero)]
        known = self.known_zeros.get(side.name, 0)
        # At a touching start leading coefficients are exactly zero: the next one decides.
        while known < len(total) and not total[known]:
            known += 1
        return first_zero(total[known:]) if known < len(total) else None

    def _advance(self, u: list[mpf], v: list[mpf], time: mpf, fraction: mpf) -> None:
        """Move the state on by a part of the step."""
        self.u, self.v = polynomial_value(u, fraction), polynomial_value(v, fraction)
        # The end of the period is a fixed number: the sum of its steps may miss it by a rounding.
        left = self.period - self.elapsed
        self.elapsed = self.period if time >= left else self.elapsed + time
        for side in self.sides:
            if side is self.contact:
                self.bumper[side.name] = self.u - side.wall
            else:
                fade = mpf(0) if side.rate is None else mp.exp(-side.rate * time)
                self.bumper[side.name] *= fade

    def _change_phase(self, side: _Side) -> None:
        """Begin or end the contact with a bumper, and note it."""
        began = self.contact is None
        self.contact = side if began else None
        elastic = side.rate is None
        # Detachment from a damped bumper leaves the clearance and its slope zero; an elastic one
        # has no force at contact and no clearance at detachment.
        self.known_zeros[side.name] = int(elastic) if began else 2 - int(elastic)
        self.bumper[side.name] = mpf(0) if elastic and not began else self.u - side.wall
        time = self.cycles_done * self.period + self.elapsed
        if time > 0 or not began:
            kind = f"{'contact' if began else 'detach'}_{side.name}"
            self.events.append(Event(time, kind, *self.state))
        self.changes_here += 1
        if self.changes_here > 4:
            raise ArithmeticError(f"contact and flight alternate without end at t = {time}")
