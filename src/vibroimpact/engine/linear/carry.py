"""What becomes of small disturbances between linear laws: in closed form, phase by phase."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.event import begins_contact
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import Stretch
from vibroimpact.engine.one_mass.disturbed_events import DISTURBANCE, contraction, meet, tie
from vibroimpact.engine.stops.rigid import resting


@kernel
def transition(c: float, k: float, t: float) -> tuple[float, float, float, float]:
    """The solution of x″ + c x′ + k x = 0 after the time t, as the matrix of (x, x′), row by row.

    Critical damping needs no special case: the sine over the frequency is taken in its limit.
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
    for stop in range(2):
        if mode >> stop & 1:
            here += plan[par.stop_at(stop) + par.BUMPER_DAMPING]
    return here


@kernel
def phase_transition(plan: Vector, mode: int, t: float) -> tuple[float, float, float, float]:
    """`transition` of the mode; at rest nothing is left of a disturbance."""
    if resting(plan, mode):
        return 0.0, 0.0, 0.0, 0.0
    k = plan[par.STIFFNESS]
    for stop in range(2):
        if mode >> stop & 1:
            k += plan[par.stop_at(stop) + par.BUMPER_STIFFNESS]
    return transition(damping(plan, mode), k, t)


@kernel
def carry(plan: Vector, stretch: Stretch, q: Vector, rows: int) -> float:
    """See `motions.carry`."""
    before, _, event, step, arrival, after = stretch
    mode = before.mode
    uu, uv, vu, vv = phase_transition(plan, mode, step)
    for stop in range(2):
        rate = plan[par.stop_at(stop) + par.RATE]
        fading = math.exp(-rate * step) if rate < math.inf else 0.0
        for i in range(rows):
            q[i * DISTURBANCE + 2 + stop] *= fading
    for i in range(rows):
        at = i * DISTURBANCE
        u, v = q[at], q[at + 1]
        q[at] = uu * u + uv * v
        q[at + 1] = vu * u + vv * v
        tie(mode, q, at)
    if begins_contact(event):
        meet(plan, event, arrival, after, q, rows)
    lost: float = damping(plan, mode) * step + contraction(plan, event, arrival, after)
    return lost
