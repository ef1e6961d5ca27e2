"""What becomes of a small disturbance of a motion: the exact tangent flow.

A disturbance is (δu, δu̇, δu_R, δu_L) at a fixed forcing phase. Within a phase it obeys the
homogeneous equation of motion. At a contact with side j the saltation matrix
I + (f⁺ − f⁻) nᵀ / (nᵀ f⁻) of the clearance reduces to

    δu̇⁺ = δu̇ − (C_j/M) (δu − δu_j),    δu_j⁺ = δu:

the closing speed cancels, so that grazing is no special case. At a detachment the contact force
is zero and the bumper's own rate is that of the mass: both vector fields agree and nothing
happens. A free bumper's δu_j fades as the bumper relaxes, at once without a dashpot. In contact
δu_j = δu, so that every contact loses the bumper's own direction (docs/theory.md, section 6).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import FLIGHT, LEFT, LIMIT, RIGHT, Motion
from vibroimpact.engine.observe import observer

DISTURBANCE = 4
"""Components: displacement, velocity, right and left bumper, signed as in the paper (eq. 3)."""


@kernel
def transition(c: float, k: float, t: float) -> tuple[float, float, float, float]:
    """The solution of x″ + c x′ + k x = 0 after the time t, as the matrix of (x, x′), row by row.

    Critical damping is no special case: the sine over the frequency is taken in its limit.
    """
    beta = 0.5 * c
    square = beta * beta - k
    w = math.sqrt(abs(square))
    if square < 0.0:
        decay = math.exp(-beta * t)
        cosine = decay * math.cos(w * t)
        sine = decay * math.sin(w * t)
    else:
        slow, fast = math.exp(-k / (beta + w) * t), math.exp(-(beta + w) * t)
        cosine = 0.5 * (slow + fast)
        sine = 0.5 * (slow - fast)
    ratio = sine / w if w * t > 1e-8 else math.exp(-beta * t) * t
    return cosine + beta * ratio, ratio, -k * ratio, cosine - beta * ratio


@kernel
def disturb(plan: Vector, mode: int, event: int, behind: int, t: float, q: Vector) -> None:
    """Carry disturbances (rows of q) through one phase and the event that ends it.

    Parameters
    ----------
    mode : int
        The phase.
    event : int
        What ended it, as in `linear.advance`.
    behind : int
        The phase that follows.
    t : float
        How long it lasted (s).
    """
    c, k = plan[par.DAMPING], plan[par.STIFFNESS]
    if mode != FLIGHT:
        at = par.BUMPER + par.WIDTH * (mode - 1)
        c += plan[at + par.BUMPER_DAMPING]
        k += plan[at + par.BUMPER_STIFFNESS]
    uu, uv, vu, vv = transition(c, k, t)
    for side in range(1, 3):
        rate = plan[par.BUMPER + par.WIDTH * (side - 1) + par.RATE]
        fading = math.exp(-rate * t) if rate < math.inf else 0.0
        for i in range(len(q)):
            q[i, 1 + side] *= fading
    for i in range(len(q)):
        u, v = q[i, 0], q[i, 1]
        q[i, 0] = uu * u + uv * v
        q[i, 1] = vu * u + vv * v
        if mode != FLIGHT:
            q[i, 1 + mode] = q[i, 0]
    if event != LIMIT and behind != FLIGHT:
        damping = plan[par.BUMPER + par.WIDTH * (behind - 1) + par.BUMPER_DAMPING]
        for i in range(len(q)):
            q[i, 1] -= damping * (q[i, 0] - q[i, 1 + behind])
            q[i, 1 + behind] = q[i, 0]


@kernel
def disturb_area(plan: Vector, mode: int, event: int, behind: int, t: float, w: Vector) -> None:
    """Carry the area that two disturbances span, as `disturb` carries each.

    The components are the 2 × 2 minors u∧v, u∧R, u∧L, v∧R, v∧L, R∧L of the two. Where one
    disturbance dies out much faster than the other, the area keeps the digits that their
    difference loses: in flight u∧v only shrinks by exp(−c t).
    """
    c, k = plan[par.DAMPING], plan[par.STIFFNESS]
    if mode != FLIGHT:
        at = par.BUMPER + par.WIDTH * (mode - 1)
        c += plan[at + par.BUMPER_DAMPING]
        k += plan[at + par.BUMPER_STIFFNESS]
    uu, uv, vu, vv = transition(c, k, t)
    rate_r = plan[par.BUMPER + par.RATE]
    rate_l = plan[par.BUMPER + par.WIDTH + par.RATE]
    right = math.exp(-rate_r * t) if rate_r < math.inf else 0.0
    left = math.exp(-rate_l * t) if rate_l < math.inf else 0.0
    w[0] *= math.exp(-c * t)
    w[1], w[3] = right * (uu * w[1] + uv * w[3]), right * (vu * w[1] + vv * w[3])
    w[2], w[4] = left * (uu * w[2] + uv * w[4]), left * (vu * w[2] + vv * w[4])
    w[5] *= right * left
    pressed = mode
    if event != LIMIT and behind != FLIGHT:
        damping = plan[par.BUMPER + par.WIDTH * (behind - 1) + par.BUMPER_DAMPING]
        if behind == RIGHT:
            w[0] += damping * w[1]
            w[4] += damping * (w[5] - w[2])
        else:
            w[0] += damping * w[2]
            w[3] -= damping * (w[5] + w[1])
        pressed = behind
    press_area(pressed, w)


@kernel
def press_area(mode: int, w: Vector) -> None:
    """A pressed bumper's disturbance is that of the displacement."""
    if mode == RIGHT:
        w[1], w[3], w[5] = 0.0, -w[0], w[2]
    elif mode == LEFT:
        w[2], w[4], w[5] = 0.0, -w[0], -w[1]


@kernel
def damping(plan: Vector, mode: int) -> float:
    """Damping per unit mass in a mode, that of a pressed bumper included (1/s)."""
    here: float = plan[par.DAMPING]
    if mode != FLIGHT:
        here += plan[par.BUMPER + par.WIDTH * (mode - 1) + par.BUMPER_DAMPING]
    return here


class Tangent(NamedTuple):
    """Disturbances carried along, the integral of the damping, contacts begun on each side."""

    disturbances: Vector
    damping: float
    hits_right: int
    hits_left: int


@observer(Tangent)
def tangent(
    plan: Vector, notes: Tangent, before: Motion, t: float, event: int, step: float, after: Motion
) -> Tangent:
    """Carry the disturbances through one stretch."""
    q, integral, hits_right, hits_left = notes
    disturb(plan, before.mode, event, after.mode, step, q)
    return Tangent(
        q,
        integral + damping(plan, before.mode) * step,
        hits_right + (event == RIGHT),
        hits_left + (event == LEFT),
    )
