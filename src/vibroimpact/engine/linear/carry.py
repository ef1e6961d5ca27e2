"""What becomes of small disturbances between linear laws: in closed form, phase by phase."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.tables import resting
from vibroimpact.engine.motion import BOTH, LEFT, RIGHT, Motion, Stretch
from vibroimpact.engine.observers.tangent import DISTURBANCE, contraction, rebound, tie


@kernel
def transition(c: float, k: float, t: float) -> tuple[float, float, float, float]:
    """The solution of x″ + c x′ + k x = 0 after the time t, as the matrix of (x, x′), row by row.

    Critical damping needs no special treatment: the sine over the frequency is taken in its limit.
    """
    beta = 0.5 * c
    square = beta * beta - k
    w = math.sqrt(abs(square))
    if square < 0.0:
        decay = math.exp(-beta * t)
        cosine = decay * math.cos(w * t)
        sine = decay * math.sin(w * t)
    else:
        # Without a spring one of the two stays, also where no dashpot makes the other one fade.
        slow = math.exp(-k / (beta + w) * t) if k > 0.0 else 1.0
        fast = math.exp(-(beta + w) * t)
        cosine = 0.5 * (slow + fast)
        sine = 0.5 * (slow - fast)
    ratio = sine / w if w * t > 1e-8 else math.exp(-beta * t) * t
    return cosine + beta * ratio, ratio, -k * ratio, cosine - beta * ratio


@kernel
def damping(plan: Vector, mode: int) -> float:
    """Damping per unit mass in a mode, that of pressed bumpers included (1/s)."""
    here: float = plan[par.DAMPING]
    for side in range(1, 3):
        if mode & side:
            here += plan[par.BUMPER + par.WIDTH * (side - 1) + par.BUMPER_DAMPING]
    return here


@kernel
def phase_transition(plan: Vector, mode: int, t: float) -> tuple[float, float, float, float]:
    """`transition` of the mode; at rest nothing is left of a disturbance."""
    if resting(plan, mode):
        return 0.0, 0.0, 0.0, 0.0
    k = plan[par.STIFFNESS]
    for side in range(1, 3):
        if mode & side:
            k += plan[par.BUMPER + par.WIDTH * (side - 1) + par.BUMPER_STIFFNESS]
    return transition(damping(plan, mode), k, t)


@kernel
def disturb(
    plan: Vector,
    mode: int,
    event: int,
    arrival: float,
    after: Motion,
    t: float,
    q: Vector,
    rows: int,
) -> None:
    """Carry disturbances (rows of q) through one phase and the event that ends it.

    Parameters
    ----------
    mode : int
        The phase.
    event, arrival, after
        What ended it, as in `flows.advance`.
    t : float
        How long it lasted (s).
    """
    uu, uv, vu, vv = phase_transition(plan, mode, t)
    for side in range(1, 3):
        rate = plan[par.BUMPER + par.WIDTH * (side - 1) + par.RATE]
        fading = math.exp(-rate * t) if rate < math.inf else 0.0
        for i in range(rows):
            q[i * DISTURBANCE + 1 + side] *= fading
    for i in range(rows):
        at = i * DISTURBANCE
        u, v = q[at], q[at + 1]
        q[at] = uu * u + uv * v
        q[at + 1] = vu * u + vv * v
        tie(mode, q, at)
    if event not in (RIGHT, LEFT):
        return
    stop = par.BUMPER + par.WIDTH * (event - 1)
    if plan[stop + par.KIND] == par.RIGID:
        e, slope = rebound(plan, event, arrival, after)
        for i in range(rows):
            at = i * DISTURBANCE
            u, v = q[at], q[at + 1]
            q[at] = -e * u
            q[at + 1] = -e * v + slope * u
            tie(after.mode, q, at)
    else:
        pressed = plan[stop + par.BUMPER_DAMPING]
        for i in range(rows):
            at = i * DISTURBANCE
            q[at + 1] -= pressed * (q[at] - q[at + 1 + event])
            q[at + 1 + event] = q[at]


@kernel
def disturb_area(
    plan: Vector, mode: int, event: int, arrival: float, after: Motion, t: float, w: Vector
) -> None:
    """Carry the area that two disturbances span, as `disturb` carries each.

    The components are the 2 × 2 minors u∧v, u∧R, u∧L, v∧R, v∧L, R∧L of the two. Where one
    disturbance dies out much faster than the other, the area keeps the digits that their
    difference loses: in flight u∧v only shrinks by exp(−c t).
    """
    uu, uv, vu, vv = phase_transition(plan, mode, t)
    rate_r = plan[par.BUMPER + par.RATE]
    rate_l = plan[par.BUMPER + par.WIDTH + par.RATE]
    right = math.exp(-rate_r * t) if rate_r < math.inf else 0.0
    left = math.exp(-rate_l * t) if rate_l < math.inf else 0.0
    w[0] *= 0.0 if resting(plan, mode) else math.exp(-damping(plan, mode) * t)
    w[1], w[3] = right * (uu * w[1] + uv * w[3]), right * (vu * w[1] + vv * w[3])
    w[2], w[4] = left * (uu * w[2] + uv * w[4]), left * (vu * w[2] + vv * w[4])
    w[5] *= right * left
    if event not in (RIGHT, LEFT):
        press_area(mode, w)
        return
    stop = par.BUMPER + par.WIDTH * (event - 1)
    if plan[stop + par.KIND] == par.RIGID:
        e, slope = rebound(plan, event, arrival, after)
        w[0] *= e * e
        w[1], w[3] = -e * w[1], -e * w[3] + slope * w[1]
        w[2], w[4] = -e * w[2], -e * w[4] + slope * w[2]
    else:
        if mode & (BOTH - event):  # the other bumper moves with the mass
            press_area(mode, w)
        pressed = plan[stop + par.BUMPER_DAMPING]
        if event == RIGHT:
            w[0] += pressed * w[1]
            w[4] += pressed * (w[5] - w[2])
        else:
            w[0] += pressed * w[2]
            w[3] -= pressed * (w[5] + w[1])
    press_area(after.mode, w)


@kernel
def press_area(mode: int, w: Vector) -> None:
    """A pressed bumper's disturbance is that of the displacement."""
    if mode & RIGHT:
        w[1], w[3], w[5] = 0.0, -w[0], w[2]
    if mode & LEFT:
        w[2], w[4], w[5] = 0.0, -w[0], -w[1]
    if mode == BOTH:
        w[5] = 0.0


@kernel
def carry(plan: Vector, stretch: Stretch, q: Vector, rows: int) -> float:
    """Carry disturbances (rows of q) through a stretch; return what is lost of (u, u̇) by it."""
    before, _, event, step, arrival, after = stretch
    disturb(plan, before.mode, event, arrival, after, step, q, rows)
    lost: float = damping(plan, before.mode) * step + contraction(plan, event, after)
    return lost
