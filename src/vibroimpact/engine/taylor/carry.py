"""What becomes of small disturbances under curved laws: their own equation, step by step.

Along a motion a disturbance (δu, δu̇, δz) obeys the linear equation whose coefficients are the
slopes of the laws there. These are series as the motion is, and so is the disturbance. At events
see `observers.tangent`; besides, z′ may jump at an impact or where a spring yields, and friction
takes the velocity of whatever comes to rest.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.tables import resting
from vibroimpact.engine.motion import DETACHED, LEFT, RIGHT, SETTLING, TURNED, Motion, Stretch
from vibroimpact.engine.observers.tangent import DISTURBANCE, MEMORY, contraction, rebound, tie
from vibroimpact.engine.series.layout import (
    BY_SPEED,
    BY_V,
    BY_X,
    BY_Z,
    BY_Z_OF_Z,
    D_V,
    D_X,
    D_Z,
    DEGREE,
    DRAG,
    FALLING,
    FIFTH,
    POWERS,
    PRESSED,
    PUSH,
    RISING,
    ROOM,
    SPEED,
    SQUARE,
    U,
    X,
    Z,
)
from vibroimpact.engine.series.values import Frame, Laws, Push
from vibroimpact.engine.taylor.frame import (
    acceleration_of,
    branch_of,
    curved_stop,
    push_of,
    pushing,
    stuck,
    without_friction,
)
from vibroimpact.engine.taylor.laws import laws_of
from vibroimpact.engine.taylor.pieces import begun, coordinate, motion_at
from vibroimpact.engine.taylor.powers import convolved, pushed, raised_to

_YIELDED = 2.0**-40
"""Share of the largest memory by which rounding may leave a spring short of where it yields."""


@kernel
def _stop_slopes(
    plan: Vector, push: Push, sign: float, deformation: int, at: int, h: float, speed: float, n: int
) -> None:
    """Add coefficient n of the slopes of a power-law stop, `sign` being that of δ′ to x′."""
    exponent = push.exponent
    raised_to(plan, deformation, exponent - 1.0, at, n)
    plan[at + ROOM + n] = convolved(plan, at, deformation, n)  # δⁿ
    squared = h * h
    by_x = plan[at + n]
    if push.dissipation != 0.0:
        by_x += sign * push.dissipation / h * pushed(plan, at, n)
        plan[BY_V + n] += h * push.stiffness * push.dissipation * plan[at + ROOM + n]
        if speed > 0.0:
            worked = sign * pushed(plan, at + ROOM, n) * h * push.stiffness * push.dissipation
            plan[BY_SPEED + (0 if sign > 0.0 else ROOM) + n] -= worked / speed
    plan[BY_X + n] += squared * push.stiffness * exponent * by_x
    if push.viscous != 0.0:
        raised_to(plan, deformation, -0.75, at + 2 * ROOM, n)
        plan[at + 3 * ROOM + n] = convolved(plan, at + 2 * ROOM, deformation, n)
        plan[BY_X + n] += 0.25 * h * push.viscous * sign * pushed(plan, at + 2 * ROOM, n)
        plan[BY_V + n] += h * push.viscous * plan[at + 3 * ROOM + n]


@kernel
def slopes(plan: Vector, motion: Motion, frame: Frame, laws: Laws, h: float) -> None:
    """Write the series of the laws' slopes over the step in hand, which takes h seconds."""
    squared = h * h
    branch, push, other, apart, drag = laws
    cubic, quintic = plan[par.CUBIC] * squared, plan[par.QUINTIC] * squared
    sinh, steep = plan[par.SINH] * squared, plan[par.SINH_RATE]
    sharpness = int(plan[par.SHARPNESS])
    exponent = plan[par.DRAG]
    mine = motion.left if motion.mode == LEFT else motion.right
    # Only a speed that makes the dissipation matters.
    side = LEFT if motion.mode == LEFT else RIGHT
    if plan[par.BUMPER + par.WIDTH * (side - 1) + par.DISSIPATION] >= 0.0:
        mine = 0.0
    others = motion.left
    if plan[par.BUMPER + par.WIDTH + par.DISSIPATION] >= 0.0:
        others = 0.0
    for n in range(DEGREE + 1):
        plan[U + n] = plan[X + n]
        plan[PRESSED + n] = -plan[X + n]
        for series in (BY_X, BY_V, BY_Z, BY_Z_OF_Z, BY_SPEED, BY_SPEED + ROOM):
            plan[series + n] = 0.0
    plan[U] += frame.offset
    plan[PRESSED] += apart
    plan[BY_X], plan[BY_V] = frame.stiffness * squared, frame.damping * h
    if sinh != 0.0:
        plan[RISING], plan[FALLING] = math.exp(steep * plan[U]), math.exp(-steep * plan[U])
    for n in range(DEGREE):
        if cubic != 0.0 or quintic != 0.0:
            plan[SQUARE + n] = convolved(plan, U, U, n)
            plan[BY_X + n] += 3.0 * cubic * plan[SQUARE + n]
            if quintic != 0.0:
                plan[FIFTH + n] = convolved(plan, SQUARE, SQUARE, n)
                plan[BY_X + n] += 5.0 * quintic * plan[FIFTH + n]
        if sinh != 0.0:
            plan[BY_X + n] += sinh * steep * (plan[RISING + n] + plan[FALLING + n])
            plan[RISING + n + 1] = steep * pushed(plan, RISING, n) / (n + 1)
            plan[FALLING + n + 1] = -steep * pushed(plan, FALLING, n) / (n + 1)
        if plan[par.HYSTERETIC] != 0.0:
            plan[POWERS + n] = 1.0 if n == 0 else 0.0
            power = POWERS
            for _ in range(sharpness - 1):
                plan[power + ROOM + n] = convolved(plan, power, Z, n)
                power += ROOM
            plan[BY_Z + n] = -branch.bend * convolved(plan, power, Z, n)
            if n == 0:
                plan[BY_Z] += branch.slope
            plan[BY_Z_OF_Z + n] = sharpness * branch.bend * pushed(plan, power, n)
        if drag != 0.0:
            plan[SPEED + n] = branch.way * ((n + 1) * plan[X + n + 1])
            if exponent == 2.0:
                plan[DRAG + n] = plan[SPEED + n]
            else:
                raised_to(plan, SPEED, exponent - 1.0, DRAG, n)
            plan[BY_V + n] += exponent * drag * h ** (2.0 - exponent) * plan[DRAG + n]
        if push.stiffness != 0.0:
            _stop_slopes(plan, push, 1.0, X, PUSH, h, mine, n)
        if other.stiffness != 0.0:
            _stop_slopes(plan, other, -1.0, PRESSED, PUSH + 4 * ROOM, h, others, n)


@kernel
def _moved(plan: Vector, q: Vector, at: int, h: float, speeds: tuple[float, float]) -> None:
    """Carry one disturbance over the step."""
    plan[D_X], plan[D_V], plan[D_Z] = q[at], q[at + 1] * h, q[at + MEMORY]
    hysteretic = plan[par.HYSTERETIC] * h * h
    for n in range(DEGREE - 1):
        force = convolved(plan, BY_X, D_X, n) + convolved(plan, BY_V, D_V, n)
        force += plan[BY_SPEED + n] * speeds[0] + plan[BY_SPEED + ROOM + n] * speeds[1]
        if hysteretic != 0.0:
            force += hysteretic * plan[D_Z + n]
            grown = convolved(plan, BY_Z, D_V, n) - convolved(plan, BY_Z_OF_Z, D_Z, n)
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
def carry(plan: Vector, stretch: Stretch, q: Vector, rows: int) -> float:
    """Carry disturbances (rows of q) through a stretch and the event that ends it.

    Returns
    -------
    float
        The integral of minus the divergence of (u, u̇, z), impacts included.
    """
    before, _, event, length, arrival, after = stretch
    mode = before.mode
    lost = 0.0
    if before.fresh & SETTLING:
        _settled(plan, before, q, rows)
    elif resting(plan, mode):
        for i in range(rows):
            q[i * DISTURBANCE], q[i * DISTURBANCE + 1] = 0.0, 0.0
    elif stuck(plan, before):
        for i in range(rows):
            q[i * DISTURBANCE + 1] = 0.0
    else:
        lost = _along(plan, before, length, q, rows)
    for side in range(1, 3):
        rate = plan[par.BUMPER + par.WIDTH * (side - 1) + par.RATE]
        kept = mode & side and curved_stop(plan, side)
        fading = math.exp(-rate * length) if rate < math.inf else 0.0
        for i in range(rows):
            at = i * DISTURBANCE + 1 + side
            if mode & side and not kept:
                q[at] = q[i * DISTURBANCE]
            elif not kept:
                q[at] *= fading
    for i in range(rows):
        _event(plan, before, event, arrival, after, q, i * DISTURBANCE)
    return lost + contraction(plan, event, after)


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
        q[at], q[at + 1] = 0.0, 0.0


@kernel
def _along(plan: Vector, before: Motion, length: float, q: Vector, rows: int) -> float:
    lost = 0.0
    t = 0.0
    here = before
    while t < length:
        frame, h = begun(plan, here, length - t)
        x = coordinate(plan, here)
        laws, _, _ = laws_of(plan, here, frame, x, length - t)
        slopes(plan, here, frame, laws, h)
        there = motion_at(plan, here, frame, 1.0)
        left_out = _left_out(plan, here, there, frame, laws)
        for i in range(rows):
            at = i * DISTURBANCE
            mine = q[at + 3] if here.mode == LEFT else q[at + 2]
            _moved(plan, q, at, h, (mine, q[at + 3]))
            q[at + 1] -= left_out * q[at]
        for n in range(DEGREE):
            lost += (plan[BY_V + n] + plan[BY_Z_OF_Z + n]) / (n + 1)
        if not t + h < length * (1.0 - 1e-15):
            break
        t += h
        here = there
    return lost


@kernel
def _left_out(plan: Vector, here: Motion, there: Motion, frame: Frame, laws: Laws) -> float:
    """What a stop that is hardly pressed does to a disturbance, as it is left out of the series.

    Its impulse is ∫ F dx/x′: of where the mass is, the slope is F/x′.
    """
    found = 0.0
    for side in range(1, 3):
        if not (here.mode & side and curved_stop(plan, side)):
            continue
        primary = side == RIGHT or here.mode == LEFT
        if (laws.push if primary else laws.other).stiffness != 0.0:
            continue
        sign = 1.0 if side == RIGHT else -1.0
        closing = sign * there.v
        if closing > 0.0:
            memory = there.right if side == RIGHT else there.left
            push = push_of(plan, side, closing, memory)
            gap = plan[par.BUMPER + par.WIDTH * (side - 1) + par.GAP]
            found += pushing(push, sign * there.u - gap, closing) / closing
    return found


@kernel
def _event(
    plan: Vector, before: Motion, event: int, arrival: float, after: Motion, q: Vector, at: int
) -> None:
    """What an event does to one disturbance."""
    if event in (RIGHT, LEFT):
        stop = par.BUMPER + par.WIDTH * (event - 1)
        u, v = q[at], q[at + 1]
        if plan[stop + par.KIND] == par.RIGID:
            e, slope = rebound(plan, event, arrival, after)
            q[at], q[at + 1] = -e * u, -e * v + slope * u
            if plan[par.HYSTERETIC] != 0.0 and arrival != 0.0:
                # A spring that has not yielded before follows u up to the impact, also if it
                # would yield there.
                met = _rate(plan, before, arrival, after.z)
                q[at + MEMORY] -= (met + e * _rate(plan, after, after.v, after.z)) * u
            tie(after.mode, q, at)
        elif curved_stop(plan, event):
            # Of its speed where it meets the stop, which it does sooner by δu/u̇.
            q[at + 1 + event] = 0.0
            if plan[stop + par.DISSIPATION] < 0.0 and arrival != 0.0:
                q[at + 1 + event] = v - acceleration_of(plan, after) / arrival * u
        else:
            q[at + 1] -= plan[stop + par.BUMPER_DAMPING] * (u - q[at + 1 + event])
            q[at + 1 + event] = u
    elif event == DETACHED:
        side = after.fresh & (RIGHT | LEFT)
        if curved_stop(plan, side):
            q[at + 1 + side] = 0.0
    elif event == TURNED:
        if after.v == 0.0 and not stuck(plan, before):
            if stuck(plan, after):
                q[at + 1] = 0.0
            elif plan[par.FRICTION] != 0.0:
                a = without_friction(plan, after)
                way = math.copysign(plan[par.FRICTION], a)
                q[at + 1] *= (a - way) / (a + way)
        if abs(after.z) >= plan[par.YIELD]:
            q[at + MEMORY] = 0.0


@kernel
def _rate(plan: Vector, motion: Motion, v: float, end: float) -> float:
    """z′/u̇ at a velocity, on the branch of a motion and where its memory has become `end`."""
    mode, fresh, u, _, right, left, z, age, clock = motion
    moving = Motion(mode, fresh, u, v, right, left, z, age, clock)
    branch = branch_of(plan, moving, 1.0)
    return branch.slope - branch.bend * end ** int(plan[par.SHARPNESS])
