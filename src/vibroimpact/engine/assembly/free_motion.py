"""The steady motion in flight, in closed form, and whether a motion ends there untouched.

The energy E of what a motion differs by from the steady one never grows in flight, so that its
closing displacement at a stop stays within √(2 E w K⁻¹ wᵀ). Where that and the steady motion leave
a clearance at each stop, none is touched any more.
"""

from __future__ import annotations

import math

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.events import closing
from vibroimpact.engine.assembly.mode import enter_mode
from vibroimpact.engine.assembly.series import expand_state, travel_by_series
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.matrix import radius, solve
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.state import FIRST, FRESH, LARGEST, MODE, parts_buffer, square_buffer


@not_inlined
def _solved(a: Vector, b: Vector, n: int) -> bool:
    is_solved: bool = solve(a, b, n)
    return is_solved


@kernel
def _response(plan: Vector, omega: float, sine: Vector, cosine: Vector) -> bool:
    """Replace accelerations by the displacements that they force at ω; False if unbounded."""
    n = int(plan[at.MASSES])
    k, c = int(plan[at.STIFFNESS]), int(plan[at.DAMPING])
    a, b = square_buffer(), parts_buffer()
    m = 2 * n
    for i in range(n):
        for j in range(n):
            stiff = plan[k + i * n + j] - (omega * omega if i == j else 0.0)
            turn = omega * plan[c + i * n + j]
            a[i * m + j], a[i * m + n + j] = stiff, -turn
            a[(n + i) * m + j], a[(n + i) * m + n + j] = turn, stiff
        b[i], b[n + i] = sine[i], cosine[i]
    if not _solved(a, b, m):
        return False
    for i in range(n):
        sine[i], cosine[i] = b[i], b[n + i]
    return True


@kernel
def _statics(plan: Vector, load: Vector) -> bool:
    """Replace accelerations by the displacements at which the links balance them."""
    n, k = int(plan[at.MASSES]), int(plan[at.STIFFNESS])
    a = square_buffer()
    for i in range(n * n):
        a[i] = plan[k + i]
    return _solved(a, load, n)


@not_inlined
def _dies_out(plan: Vector, period: float, dying: float) -> bool:
    """Whether free motions become less in a period."""
    n, w = int(plan[at.MASSES]), int(plan[at.WAVES])
    q, other, y, none = square_buffer(), square_buffer(), parts_buffer(), parts_buffer()
    m = 2 * n
    steps = math.ceil(plan[at.RATE] * period / at.STEP)
    for i in range(int(plan[at.STOPS])):
        none[i] = 0.0
    for j in range(m):
        for i in range(m + w + 1):
            y[i] = 1.0 if i == j else 0.0
        for _ in range(steps):
            expand_state(plan, y, none, period / steps)
            travel_by_series(plan, y, none, 1.0)
        for i in range(m):
            q[i * m + j] = y[i]
    return radius(q, other, m) < dying


@not_inlined
def stays_free(plan: Vector, state: Vector, dying: float, result: Vector) -> int:
    """See `flow.undisturbed`: 2 if so, for its extremes are not written."""
    n, w, count = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.STOPS])
    if plan[at.RECORD] != 0.0 or state[MODE] != 0.0 or 2 * n + w + 1 > LARGEST:
        return 0
    enter_mode(plan, 0)
    push, clock = int(plan[at.PUSH]), FIRST + 2 * n + count + 1
    steady, sine, cosine, swing = parts_buffer(), parts_buffer(), parts_buffer(), parts_buffer()
    for i in range(n):
        steady[i], steady[n + i] = plan[int(plan[at.CONSTANT]) + i], 0.0
    if not _statics(plan, steady):
        return 0
    for f in range(count):
        swing[f] = closing(plan, f, steady)
    s, c = state[clock], state[clock + 1]
    now_s, now_c = s, c
    for q in range(w // 2):
        omega = plan[at.OMEGA] * (q + 1)
        for i in range(n):
            sine[i], cosine[i] = plan[push + i * w + 2 * q], plan[push + i * w + 2 * q + 1]
        if not _response(plan, omega, sine, cosine):
            return 0
        for f in range(count):
            swing[f] += math.hypot(closing(plan, f, sine), closing(plan, f, cosine))
        for i in range(n):
            steady[i] += sine[i] * now_s + cosine[i] * now_c
            steady[n + i] += omega * (sine[i] * now_c - cosine[i] * now_s)
        now_s, now_c = now_s * c + now_c * s, now_c * c - now_s * s
    energy = 0.0  # twice that of the difference
    for i in range(n):
        sine[i] = state[FIRST + i] - steady[i]
        cosine[i] = state[FIRST + n + i] - steady[n + i]
    for i in range(n):
        force, momentum = 0.0, 0.0
        for j in range(n):
            restored = 0.0
            for k in range(n):
                restored += plan[int(plan[at.STIFFNESS]) + j * n + k] * sine[k]
            mass = plan[int(plan[at.MASS]) + i * n + j]
            force += mass * restored
            momentum += mass * cosine[j]
        energy += sine[i] * force + cosine[i] * momentum
    for f in range(count):
        for i in range(n):
            sine[i] = plan[int(plan[at.RESPONSE]) + f * n + i]
        if not _statics(plan, sine):
            return 0
        reach = swing[f] + math.sqrt(max(energy * closing(plan, f, sine), 0.0))
        if not reach < plan[int(plan[at.STOP]) + f * at.STOP_WIDTH + at.GAP]:
            return 0
    if not _dies_out(plan, 2.0 * math.pi / plan[at.OMEGA], dying):
        return 0
    parts = beyond(state, FIRST)
    for i in range(2 * n):
        parts[i] = steady[i]
    for f in range(count + 1):  # the deformations have relaxed; the mode begins
        parts[2 * n + f] = 0.0
    state[FRESH] = 0.0
    return 2
