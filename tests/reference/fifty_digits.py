"""A slow, independent reference: the rig's trajectory to fifty digits.

Only tests use it. It shares no code and no method with the package: where the package evaluates
closed forms from tables, this file

1. expands the linear motion of each phase (flight, or contact with one bumper) in a Taylor
   series of high order, over a step so short that a bound puts the remainder below the wanted
   digits;
2. finds the first zero of a clearance or of a contact force on the step by Descartes' rule of signs
   in exact integers with bisection (Collins and Akritas), which proves that there is none or
   isolates it, and then refines it by bracketed Newton steps;
3. changes phase there and goes on.

The model and its signs are those of the paper (Section 2 and equation 5): displacement u of the
mass relative to the base, deformation u_R >= 0 of the right and u_L <= 0 of the left bumper.

- Flight: M u'' + C u' + K u = F - M A_t, and C_j u_j' + K_j u_j = 0; shaking.py says what A_t is.
- Contact with the right bumper: u_R = u - G_R, and K_R u_R + C_R u_R' joins the left-hand side;
  the left bumper goes on relaxing. Contact with the left bumper mirrors it, u_L = u + G_L.
- Contact begins when the clearance G_R + u_R - u, or G_L + u - u_L, falls to zero, and ends when
  the contact force falls to zero. Where gaps are negative both bumpers may be in contact at once:
  their forces add, and each comes and goes by its own clearance and force.
- A rigid stop turns v into -e v where the mass reaches it. Infinitely many impacts in a finite
  time (chatter.py) end with the mass at rest on the stop. It rests until what presses it there,
  F - (K u + M A_t + force of the other bumper), falls through zero, and leaves with v = v' = 0.

The cost grows with the norm of the phase's matrix times its length: twenty cycles of the paper's
rig take about a second, contacts that last for thousands of M / C_j take minutes.
"""

from collections.abc import Iterator, Sequence
from itertools import zip_longest

from mpmath import mp, mpf

from reference.chatter import accumulation
from reference.first_zero import first_zero, polynomial_value
from reference.rig import Event, Reference, Rig, Side, State
from reference.shaking import Shaking, Sines


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
    """Follow the rig over whole forcing periods of one sine.

    `amplitude`, `frequency` and `phase` are those of the base acceleration
    amplitude * sin(2 pi frequency t + phase); m/s^2, Hz, rad. The rest is that of `follow`.
    """
    with mp.workdps(_working(digits, order)):
        shaking = Sines([amplitude], frequency, phase)
    return follow(rig, shaking, start, cycles, digits, order)


def follow(
    rig: Rig,
    shaking: Shaking,
    start: Sequence[float],
    spans: int,
    digits: int = 50,
    order: int = 64,
) -> Reference:
    """Follow the rig over whole spans of what shakes it.

    Parameters
    ----------
    rig : Rig
        The mass, its isolator and its stops. Floats are taken as the exact binary numbers.
    shaking : Sines or Lines
        What shakes it, made with as many digits as the run works with.
    start : (u, v, u_R, u_L)
        State at t = 0; m, m/s, m, m. Floats or mpf. A clearance that is zero to double rounding
        counts as touching: the bumper then presses, or lets go, as force and motion say.
    spans : int
        Number of forcing periods, or of lines of a record.
    digits : int
        Wanted correct digits of one step; a chaotic motion loses some of them on the way.
    order : int
        Order of the Taylor polynomials. The step follows from it, so two orders are two runs.

    Returns
    -------
    Reference
        States at t = 0 and behind each span, and all events. A contact or a rest that begins at
        t = 0 is part of the start and no event, unless an impact comes before it.

    Raises
    ------
    ValueError
        If the rig or the start is impossible.
    """
    with mp.workdps(_working(digits, order)):
        run = _Run(rig, shaking, start, order, mpf(10) ** -(digits + 10))
        states = [run.state]
        for _ in range(spans):
            run.span()
            states.append(run.state)
    return Reference(states, run.events)


def _working(digits: int, order: int) -> int:
    """Digits to work with: the terms of a series grow to exp(order / 3) before they fall."""
    return digits + 20 + order // 6


class _Run:
    """A trajectory under way: the state, what is in contact, and the time within the span."""

    def __init__(
        self,
        rig: Rig,
        shaking: Shaking,
        start: Sequence[float],
        order: int,
        tolerance: mpf,
    ) -> None:
        if not (rig.mass > 0 and rig.stiffness >= 0 and rig.damping >= 0):
            raise ValueError(f"impossible rig: {rig}")
        self.mass, self.stiffness, self.damping = map(mpf, (rig.mass, rig.stiffness, rig.damping))
        self.force = mpf(rig.force)
        self.shaking = shaking
        self.order, self.tolerance = order, tolerance
        pairs = (("right", 1, rig.right), ("left", -1, rig.left))
        self.sides = [Side(name, sign, stop) for name, sign, stop in pairs if stop is not None]
        self.overlap = sum(side.sign * side.wall for side in self.sides) < 0
        self.u, self.v = mpf(start[0]), mpf(start[1])
        self.bumper = {"right": mpf(start[2]), "left": mpf(start[3])}
        self.factorial, self.size = mp.factorial(order), mpf(0)
        self.number, self.elapsed, self.before = 0, mpf(0), mpf(0)
        self.period = shaking.span(0)
        self.events: list[Event] = []
        self.pressed: list[Side] = []
        self.resting: Side | None = None
        # How often the clearance or the force that ended the last phase vanishes here, by side.
        self.known_zeros: dict[str, int] = {}
        self.changes_here = 0
        for side in self.sides:
            self._settle(side)

    def _settle(self, side: Side) -> None:
        """Check the start against one stop, and undo the rounding of a touching start."""
        depth, bumper = side.sign * (self.u - side.wall), side.sign * self.bumper[side.name]
        if bumper < 0:
            raise ValueError(f"the {side.name} bumper is stretched, not pressed")
        clearance = bumper - depth
        touching = abs(clearance) <= mpf(2) ** -50 * (abs(self.u) + abs(side.wall))
        if side.restitution is not None:
            if bumper or (clearance < 0 and not touching):
                raise ValueError(f"the mass is inside the {side.name} stop, or presses it in")
            if touching:
                self.u = side.wall
        elif touching and depth >= 0:
            self.bumper[side.name] = self.u - side.wall
            if side.rate is None and depth > 0:
                self.pressed.append(side)
        elif clearance < 0:
            raise ValueError(f"the mass is inside the {side.name} bumper")
        elif side.rate is None and bumper > 0:
            raise ValueError(f"the elastic {side.name} bumper is deformed without contact")

    @property
    def state(self) -> State:
        return self.u, self.v, self.bumper["right"], self.bumper["left"]

    def span(self) -> None:
        """Go on to the end of the span."""
        self.period = self.shaking.span(self.number)
        while self.elapsed < self.period:
            self._step()
        self.before += self.period
        self.elapsed, self.number = mpf(0), self.number + 1

    def _step(self) -> None:
        """Go on to the next event, to the end of the step or to the end of the span."""
        longest = self.period - self.elapsed
        while True:
            step, u, v, push = self._series(longest)
            asked = [(side, *self._next_zero(side, step, u, v, push)) for side in self.sides]
            limits = [limit for _, _, limit in asked if limit is not None]
            if not limits:
                break
            longest = min(limits)
        zeros = [(zero, side) for side, zero, _ in asked if zero is not None]
        at, side = min(zeros, key=lambda pair: pair[0]) if zeros else (mpf(1), None)
        self.u, self.v = polynomial_value(u, at), polynomial_value(v, at)
        self._pass(step * at)
        if at > 0:
            self.known_zeros, self.changes_here = {}, 0
        if side is not None:
            self._change_phase(side)

    def _coefficients(self) -> tuple[mpf, mpf, mpf]:
        """k, c, b of u'' + c u' + k u = b - A_t."""
        stiffness, damping, load = self.stiffness, self.damping, self.force
        for side in self.pressed:
            stiffness = stiffness + side.stiffness
            damping = damping + side.damping
            load = load + side.stiffness * side.wall
        return stiffness / self.mass, damping / self.mass, load / self.mass

    def _series(self, longest: mpf) -> tuple[mpf, list[mpf], list[mpf], list[mpf]]:
        """Step and Taylor coefficients of u, v and b - A_t in x = time / step, 0 <= x <= 1.

        Let z = (s u, v, scaled pairs of the forcing) with s the largest of sqrt(k) and the rates of
        the forcing: z' = B z, and the norm of B is at most s + c + what the pairs add. Let
        z_n be the n-th coefficient of z. What follows the last, z_N, is at most |z_N| q / (1 - q)
        with q = |B| step / (N + 1). So the step is at most N / (3 |B|), and short enough that
        |z_N| is within the tolerance.
        """
        stiffness, damping, load = self._coefficients()
        scale = max(mp.sqrt(stiffness), self.shaking.rate)
        step = min(longest, self.order / (3 * (scale + damping + self.shaking.weight)))
        push, forcing, forcing_last = self.shaking.push(
            self.number, self.elapsed, step, self.order, self.factorial
        )
        push[0] += load
        u, v = [self.u], [self.v]
        for n in range(self.order):
            weight = step / (n + 1)
            u.append(weight * v[n])
            force = push[n] - damping * v[n] - stiffness * u[n]
            v.append(mpf(0) if self.resting else weight * force)
        self.size = abs(self.u) + (abs(self.v) + forcing) / scale
        last = scale * abs(u[-1]) + abs(v[-1]) + forcing_last
        excess = last / (self.tolerance * scale * self.size) if last else mpf(0)
        if excess > 1:
            shrink = excess ** (mpf(-1) / self.order)
            powers = [shrink**n for n in range(self.order + 1)]
            u = [value * power for value, power in zip(u, powers, strict=True)]
            v = [value * power for value, power in zip(v, powers, strict=True)]
            push = [value * power for value, power in zip(push, powers, strict=False)]
            step *= shrink
        return step, u, v, push

    def _next_zero(
        self, side: Side, step: mpf, u: list[mpf], v: list[mpf], push: list[mpf]
    ) -> tuple[mpf | None, mpf | None]:
        """First zero of what ends a phase of one side, or a shorter step on which to ask again."""
        if side is self.resting:
            holding = [-side.sign * self._coefficients()[0] * self.u]
            return self._first_zero(side, holding, [side.sign * value for value in push]), None
        if side in self.pressed:
            return self._release(side, u, v), None
        if self.pressed and not self.overlap:
            return None, None  # at most where one contact ends, when the other one may begin
        return self._touch(side, u, step)

    def _release(self, side: Side, u: list[mpf], v: list[mpf]) -> mpf | None:
        """First zero of the contact force on the step, as a fraction of it."""
        stiffness, damping = side.sign * side.stiffness, side.sign * side.damping
        rest = [-stiffness * side.wall]
        elastic, viscous = [stiffness * value for value in u], [damping * value for value in v]
        return self._first_zero(side, rest, elastic, viscous)

    def _touch(self, side: Side, u: list[mpf], step: mpf) -> tuple[mpf | None, mpf | None]:
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

    def _first_zero(self, side: Side, *terms: list[mpf]) -> mpf | None:
        """First zero of a sum of series that is not the event which began the phase."""
        total = [sum(column) for column in zip_longest(*terms, fillvalue=mp.zero)]
        known = self.known_zeros.get(side.name, 0)
        # At a touching start leading coefficients are exactly zero: the next one decides.
        while known < len(total) and not total[known]:
            known += 1
        return first_zero(total[known:]) if known < len(total) else None

    def _pass(self, time: mpf) -> None:
        """Let a time pass, in which the mass has moved to where it is now."""
        # The end of the span is a fixed number: the sum of its steps may miss it by a rounding.
        left = self.period - self.elapsed - self.tolerance * self.period
        self.elapsed = self.period if time >= left else self.elapsed + time
        for side in self.sides:
            if side in self.pressed:
                self.bumper[side.name] = self.u - side.wall
            else:
                fade = mpf(0) if side.rate is None else mp.exp(-side.rate * time)
                self.bumper[side.name] *= fade

    def _change_phase(self, side: Side) -> None:
        """Do what the zero of a clearance or of a force brings with it."""
        self.changes_here += 1
        if self.changes_here > 6:
            raise ArithmeticError(f"contact and flight alternate without end at t = {self.time}")
        if side is self.resting:
            # Acceleration, velocity and clearance are zero.
            self.resting, self.known_zeros[side.name] = None, 3
            self._note("detach", side)
        elif side.restitution is not None:
            self._hit(side)
        else:
            self._press_or_part(side)

    @property
    def time(self) -> mpf:
        return self.before + self.elapsed

    def _note(self, what: str, side: Side) -> None:
        if self.time > 0 or what != "contact" or self.events:
            self.events.append(Event(self.time, f"{what}_{side.name}", *self.state))

    def _press_or_part(self, side: Side) -> None:
        """Begin or end the contact with a bumper."""
        began = side not in self.pressed
        elastic = side.rate is None
        if began:
            self.pressed.append(side)
        else:
            self.pressed.remove(side)
        # Detachment from a damped bumper leaves the clearance and its slope zero; an elastic one
        # has no force at contact and no clearance at detachment.
        self.known_zeros[side.name] = int(elastic) if began else 2 - int(elastic)
        self.bumper[side.name] = mpf(0) if elastic and not began else self.u - side.wall
        self._note("contact" if began else "detach", side)

    def _hit(self, side: Side) -> None:
        """Hit a rigid stop: fly back, or rest there at once, or after a chatter."""
        e = side.restitution
        assert e is not None
        self.u = side.wall
        if side.sign * self.v > 0:
            self._note("impact", side)
            self.v *= -e
        else:
            self.v = mpf(0)  # a touching start, or a tangency that rounding takes for a hit
        self.known_zeros[side.name] = 1 if self.v else 2
        if not self.v:
            if self._pressing(side) >= 0:
                self._rest(side)
        elif e < 1 and self._chatters(side):
            start, memory = self.elapsed, dict(self.bumper)
            limit = accumulation(self._impacts(side), e, self.tolerance * self.period)
            self.elapsed, self.bumper = start, memory
            self.u, self.v = side.wall, mpf(0)
            self._pass(limit)
            self._rest(side)

    def _rest(self, side: Side) -> None:
        self.resting, self.known_zeros[side.name] = side, 0
        self._note("contact", side)

    def _pressing(self, side: Side) -> mpf:
        """Acceleration towards a stop that the mass would have there without velocity."""
        stiffness, _, load = self._coefficients()
        base = self.shaking.value(self.number, self.elapsed)
        return side.sign * (load - base - stiffness * side.wall)

    def _chatters(self, side: Side) -> bool:
        """Whether impacts on a stop certainly go on until they accumulate, within this span.

        While the acceleration towards the stop stays within a (1 ± d), d = (1 - e)/8, an impact is
        at most e ((1 + d)/(1 - d))^(1/2) times as fast as the last, which is less than (1 + 7 e)/8
        for e < 1: so velocities stay below twice the first, distances below 2 w²/a, and all is
        over before 3 w/(a (1 - e)).
        """
        w, a, e = abs(self.v), self._pressing(side), side.restitution
        assert e is not None
        if a <= 0:
            return False
        longest, farthest = 3 * w / (a * (1 - e)), 2 * w**2 / a
        stiffness, damping, _ = self._coefficients()
        drift = self.shaking.steepest * longest
        if drift + 2 * damping * w + stiffness * farthest > (1 - e) / 8 * a:
            return False
        for other in self.sides:
            if other is side:
                continue
            depth = other.sign * (side.wall - other.wall)
            if other in self.pressed:
                if other.stiffness * (depth - farthest) <= 2 * other.damping * w:
                    return False
            else:
                memory = other.sign * self.bumper[other.name]
                fade = mp.exp(-other.rate * longest) if other.rate is not None else 0
                if memory * fade - depth <= farthest:
                    return False
        return self.elapsed + longest < self.period

    def _impacts(self, side: Side) -> Iterator[mpf]:
        """Times of the impacts of a chatter, from the one that was, which is at zero."""
        start = self.elapsed
        yield mpf(0)
        while True:
            step, u, v, _ = self._series(4 * abs(self.v) / self._pressing(side))
            # The clearance begins at zero: what it is divided by time tells the next impact.
            at = first_zero([-side.sign * value for value in u[1:]])
            assert at is not None
            self.u, self.v = side.wall, polynomial_value(v, at)
            self._pass(step * at)
            self._note("impact", side)
            self.v *= -side.restitution
            yield self.elapsed - start
