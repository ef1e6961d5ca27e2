"""What becomes of small disturbances under curved laws: their own equation, step by step.

Along a motion a disturbance (δu, δu̇, δz) obeys the linear equation whose coefficients are the
slopes of the laws there. These are series as the motion is, and so is the disturbance. At events
it jumps (see `saltation`).
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine import saltation
from vibroimpact.engine.event import DETACHMENT, IMPACT, TURN, begins_contact, kind_of, stop_of
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import Motion, Stretch, facing, main_stop
from vibroimpact.engine.one_mass.disturbed_events import DISTURBANCE, MEMORY, contraction, meet
from vibroimpact.engine.series.layout import (
    BY_CHI,
    BY_V,
    BY_X,
    BY_Z,
    BY_Z_OF_Z,
    D_V,
    D_X,
    D_Z,
    DEGREE,
    ROOM,
)
from vibroimpact.engine.series.values import Frame, Laws
from vibroimpact.engine.state import SETTLING
from vibroimpact.engine.stops.curved import curved_stop, push_of, stop_force
from vibroimpact.engine.stops.rigid import resting
from vibroimpact.engine.taylor.laws import laws_of
from vibroimpact.engine.taylor.mode_forces import (
    acceleration_of,
    branch_of,
    stop_push,
    stuck,
    without_friction,
)
from vibroimpact.engine.taylor.pieces import begun, coordinate, motion_at, sloped
from vibroimpact.engine.taylor.plan import motion_rate
from vibroimpact.engine.taylor.step_setup import varies

_SLOPES_LAST = 2.0**-47
"""What the last term of the slopes' series may be; it enters a disturbance by a 20th."""

_OWN_REACH = 1.6
"""Of a disturbance's own rate times the step; of exp(1.6) the series leaves out 5e-15."""

_CUT, _LEAST_SHARE = 100, 2.0**-10
"""How often a step is shortened at most, and to which share at once."""

_YIELDED = 2.0**-40
"""Share of the largest memory by which rounding may leave a spring short of where it yields."""


@kernel
def _convolved(plan: Vector, a: int, b: int, n: int) -> float:
    """Coefficient n of the product of two series."""
    even = 0.0
    odd = 0.0
    for j in range(0, n, 2):
        even += plan[a + j] * plan[b + n - j]
        odd += plan[a + j + 1] * plan[b + n - j - 1]
    if n % 2 == 0:
        even += plan[a + n] * plan[b]
    return even + odd


@kernel
def _by_speed(plan: Vector, stop: int, speed: float) -> float:
    """From the slope by a stop's dissipation to that by the speed at which the stop was met.

    Only of a stop of restitution does that speed make the dissipation.
    """
    if plan[par.stop_at(stop) + par.DISSIPATION] >= 0.0 or not speed > 0.0:
        return 0.0
    return -1.0 / speed


@kernel
def _moved(plan: Vector, q: Vector, at: int, h: float, speeds: tuple[float, float]) -> None:
    """Carry one disturbance over the step; `speeds` are shares of the stops' dissipations."""
    plan[D_X], plan[D_V], plan[D_Z] = q[at], q[at + 1] * h, q[at + MEMORY]
    hysteretic = plan[par.HYSTERETIC] * h * h
    for n in range(DEGREE - 1):
        force = _convolved(plan, BY_X, D_X, n) + _convolved(plan, BY_V, D_V, n)
        force += plan[BY_CHI + n] * speeds[0] + plan[BY_CHI + ROOM + n] * speeds[1]
        if hysteretic != 0.0:
            force += hysteretic * plan[D_Z + n]
            grown = _convolved(plan, BY_Z, D_V, n) - _convolved(plan, BY_Z_OF_Z, D_Z, n)
            plan[D_Z + n + 1] = grown / (n + 1)
        plan[D_X + n + 1] = plan[D_V + n] / (n + 1)
        plan[D_V + n + 1] = -force / (n + 1)
    x, v, z = 0.0, 0.0, 0.0
    for n in range(DEGREE - 1, -1, -1):
        x += plan[D_X + n]
        v += plan[D_V + n]
        z += plan[D_Z + n]
    q[at], q[at + 1] = x, v / h
    if hysteretic != 0.0:
        q[at + MEMORY] = z


@kernel
def _is_disturbed(q: Vector, at: int) -> bool:
    is_nonzero = False
    for i in range(at, at + DISTURBANCE):
        is_nonzero = is_nonzero or q[i] != 0.0
    return is_nonzero


@kernel
def carry(plan: Vector, stretch: Stretch, q: Vector, rows: int) -> float:
    """See `motions.carry`."""
    before, _, event, length, arrival, after = stretch
    mode = before.mode
    lost = 0.0
    if before.fresh & SETTLING:
        _settled(plan, before, q, rows)
    elif resting(plan, mode):
        for i in range(rows):
            saltation.rest(q, i * DISTURBANCE)
    elif stuck(plan, before):
        for i in range(rows):
            q[i * DISTURBANCE + 1] = 0.0
    else:
        lost = _along(plan, before, length, q, rows)
    for stop in range(2):
        rate = plan[par.stop_at(stop) + par.RATE]
        kept = mode >> stop & 1 and curved_stop(plan, stop)
        fading = math.exp(-rate * length) if rate < math.inf else 0.0
        for i in range(rows):
            at = i * DISTURBANCE + 2 + stop
            if mode >> stop & 1 and not kept:
                q[at] = q[i * DISTURBANCE]
            elif not kept:
                q[at] *= fading
    _event(plan, before, event, arrival, after, q, rows)
    return lost + contraction(plan, event, arrival, after)


@kernel
def _settled(plan: Vector, before: Motion, q: Vector, rows: int) -> None:
    """Complete a chatter: the isolator's memory stays what it was at the last impact followed.

    That impact comes later by −δu/u̇, and until then z follows u. A spring that rests where it
    yields has yielded on its way to the stop, and remembers nothing.
    """
    limit = plan[par.YIELD]
    yielded = limit < math.inf and abs(before.z) >= limit * (1.0 - _YIELDED)
    rate = 0.0
    if plan[par.HYSTERETIC] != 0.0:
        rate = _rate(plan, before, before.v, before.z)
    for i in range(rows):
        at = i * DISTURBANCE
        q[at + MEMORY] = 0.0 if yielded else q[at + MEMORY] - rate * q[at]
        saltation.rest(q, at)


@kernel
def _along(plan: Vector, before: Motion, length: float, q: Vector, rows: int) -> float:
    lost = 0.0
    t = 0.0
    here = before
    while t < length:
        frame, h = _sloped_step(plan, here, length - t)
        x = coordinate(plan, here)
        laws, _, _ = laws_of(plan, here, frame, x, length - t)
        main = main_stop(here.mode)
        primary = _by_speed(plan, main, here.faces[main])
        # A disturbance of the left stop's speed has the sign of the velocity.
        other = -_by_speed(plan, 1, here.faces[1])
        there = motion_at(plan, here, frame, 1.0)
        pressed = _stops_left_out(plan, here, there, laws)
        dragged = _drag_left_out(plan, here, there, laws)
        for i in range(rows):
            at = i * DISTURBANCE
            if not _is_disturbed(q, at):
                continue
            mine = q[at + 2 + main]
            _moved(plan, q, at, h, (primary * mine, other * q[at + 3]))
            q[at + 1] = q[at + 1] * math.exp(-dragged) - pressed * q[at]
        for n in range(DEGREE):
            lost += (plan[BY_V + n] + plan[BY_Z_OF_Z + n]) / (n + 1)
        lost += dragged
        if not t + h < length * (1.0 - 1e-15):
            break
        t += h
        here = there
    return lost


@kernel
def _sloped_step(plan: Vector, here: Motion, longest: float) -> tuple[Frame, float]:
    """Write a step that begins with this motion, and the slopes of its forces; its frame, length.

    A force that is a power of a small velocity or deformation may be nothing beside the others and
    its slope not: the step is as short as the series of the slopes want. Where a spring has all but
    yielded, its memory stands still, and the step is as short as a disturbance of it wants, which
    dies out.
    """
    frame, h = begun(plan, here, longest)
    sloped(plan, h)
    # A motion may be slow where a disturbance of it is not: its steps reach too far for that.
    own = max(abs(plan[BY_V]), math.sqrt(abs(plan[BY_X])))
    if _OWN_REACH < own < math.inf:
        frame, h = begun(plan, here, h * max(_OWN_REACH / own, _LEAST_SHARE))
        sloped(plan, h)
    powers, remembers = varies(plan, here.mode), plan[par.HYSTERETIC] != 0.0
    if not (powers or remembers):
        return frame, h
    for _ in range(_CUT):
        excess = _last_slopes(plan, h) if powers else 0.0
        if remembers:
            excess = max(excess, _last_memory(plan))
        if excess <= 1.0:
            break
        share = _LEAST_SHARE
        if excess < math.inf:
            share = max(0.9 * excess ** (-1.0 / (DEGREE - 1)), share)
        frame, h = begun(plan, here, h * share)
        sloped(plan, h)
    return frame, h


@kernel
def _last_slopes(plan: Vector, h: float) -> float:
    """What the last terms of the slopes' series add to a disturbance, over what they may."""
    last = DEGREE - 1
    by_v = max(abs(plan[BY_V + last]), 0.5 * abs(plan[BY_V + last - 1]))
    by_x = max(abs(plan[BY_X + last]), 0.5 * abs(plan[BY_X + last - 1]))
    return (by_v + by_x / (motion_rate(plan) * h)) / _SLOPES_LAST  # type: ignore[no-any-return]


@kernel
def _last_memory(plan: Vector) -> float:
    """The last term of a disturbance of the memory that dies out, over what it may be."""
    rate, term = 0.0, 1.0
    for n in range(DEGREE):
        rate += abs(plan[BY_Z_OF_Z + n])
    for n in range(1, DEGREE):
        term *= rate / n
    return term / _SLOPES_LAST


@kernel
def _stops_left_out(plan: Vector, here: Motion, there: Motion, laws: Laws) -> float:
    """What a stop that is hardly pressed does to a disturbance, as it is left out of the series.

    Its impulse is ∫ F dx/x′: of where the mass is, the slope is F/x′.
    """
    effect = 0.0
    for stop in range(2):
        if not (here.mode >> stop & 1 and curved_stop(plan, stop)):
            continue
        primary = stop == main_stop(here.mode)
        if (laws.push if primary else laws.other).stiffness != 0.0:
            continue
        sign = facing(stop)
        if here.v * there.v >= 0.0:
            effect += _per_speed(plan, there, stop, sign) - _per_speed(plan, here, stop, sign)
    return effect


@kernel
def _per_speed(plan: Vector, motion: Motion, stop: int, sign: float) -> float:
    """F/x′ of a pressed stop; 0 where the mass stands."""
    closing = sign * motion.v
    if closing == 0.0:
        return 0.0
    push = push_of(plan, stop, closing, motion.faces[stop])
    gap = plan[par.stop_at(stop) + par.GAP]
    return stop_force(plan, stop, push, sign * motion.u - gap, closing) / closing


@kernel
def _drag_left_out(plan: Vector, here: Motion, there: Motion, laws: Laws) -> float:
    """∫ of a drag's slope by the velocity, while the drag is left out of the series: ∫ dF/x″."""
    if laws.drag != 0.0 or plan[par.DRAG] == 1.0 or plan[par.DAMPING] == 0.0:
        return 0.0
    begins, ends = acceleration_of(plan, here), acceleration_of(plan, there)
    if not begins * ends >= 0.0 or begins + ends == 0.0:
        return 0.0
    exponent = plan[par.DRAG]
    gained = math.copysign(abs(there.v) ** exponent, there.v)
    gained -= math.copysign(abs(here.v) ** exponent, here.v)
    return abs(plan[par.DAMPING] * gained / (0.5 * (begins + ends)))  # type: ignore[no-any-return]


@kernel
def _event(
    plan: Vector,
    before: Motion,
    event: int,
    arrival: float,
    after: Motion,
    q: Vector,
    rows: int,
) -> None:
    """What an event does to disturbances."""
    kind, stop = kind_of(event), stop_of(event)
    if begins_contact(event):
        if curved_stop(plan, stop):
            _meet_curved(plan, stop, arrival, after, q, rows)
            return
        if kind == IMPACT and plan[par.HYSTERETIC] != 0.0 and arrival != 0.0:
            # A spring that has not yielded before follows u up to the impact, also if it
            # would yield there.
            met = _rate(plan, before, arrival, after.z) * arrival
            left = _rate(plan, after, after.v, after.z) * after.v
            for i in range(rows):
                at = i * DISTURBANCE
                saltation.jump(q, at + MEMORY, -q[at] / arrival, met, left)
        meet(plan, event, arrival, after, q, rows)
    elif kind == DETACHMENT:
        if curved_stop(plan, stop):
            for i in range(rows):
                saltation.detachment(q, i * DISTURBANCE + 2 + stop)
    elif kind == TURN:
        if after.v == 0.0 and not stuck(plan, before):
            here, gone = 1.0, 1.0
            if stuck(plan, after):
                gone = 0.0
            elif plan[par.FRICTION] != 0.0:
                a = without_friction(plan, after)
                way = math.copysign(plan[par.FRICTION], a)
                here, gone = a + way, a - way
            for i in range(rows):
                saltation.turn(q, i * DISTURBANCE, here, gone)
        if abs(after.z) >= plan[par.YIELD]:
            for i in range(rows):
                saltation.yielding(q, i * DISTURBANCE + MEMORY)


@kernel
def _meet_curved(
    plan: Vector, stop: int, arrival: float, after: Motion, q: Vector, rows: int
) -> None:
    """Let disturbances meet a stop of a curved law; its own part is how fast it is met."""
    numbers = par.stop_at(stop)
    jumps = plan[numbers + par.KIND] == par.FORMULA and arrival != 0.0
    remembers = plan[numbers + par.DISSIPATION] < 0.0 and arrival != 0.0
    force = stop_push(plan, after, stop) if jumps else 0.0
    acceleration = acceleration_of(plan, after) if remembers else 0.0
    for i in range(rows):
        at = i * DISTURBANCE
        own = at + 2 + stop
        q[own] = 0.0
        if jumps:
            saltation.force_jump(q, at, arrival, force)
        if remembers:
            q[own] = q[at + 1]
            saltation.jump(q, own, -q[at] / arrival, acceleration, 0.0)


@kernel
def _rate(plan: Vector, motion: Motion, v: float, end: float) -> float:
    """z′/u̇ at a velocity, on the branch of a motion and where its memory has become `end`."""
    mode, fresh, u, _, faces, z, age, clock = motion
    moving = Motion(mode, fresh, u, v, faces, z, age, clock)
    branch = branch_of(plan, moving, 1.0)
    return branch.slope - branch.bend * end ** int(plan[par.SHARPNESS])
