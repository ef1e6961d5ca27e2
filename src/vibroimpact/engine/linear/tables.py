"""Closed-form motion of one phase, kept as small matrices (docs/theory.md, section 2).

Within a phase (flight, pressed on the right, on the left or on both sides) the motion obeys

    x″ = −c x′ − k x + d − A_t,

with A_t linear in the forcing's clock (s, c), so that the motion at any later time is a fixed
linear function of the *state row* (x, x′, s, c, 1). A phase's table holds these functions at
equidistant nodes, and the Taylor series from any point. In flight x is the relative displacement
u; in contact it is the bumper's deformation, measured towards the bumper (a left contact is the
mirror image of a right one), so that a deformation of a millionth of the gap keeps all its digits.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import begin, count, pace, plane, wave
from vibroimpact.engine.forcing.wave import without_amplitude
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import (
    BAND_0,
    BAND_V,
    BAND_X,
    FORCE_0,
    FORCE_V,
    FORCE_X,
    FORGOTTEN,
    FOURTH,
    FOURTH_0,
    LATE,
    LATE_TABLES,
    MOST,
    NODES,
    OMEGA,
    RATE,
    REST,
    RESTING,
    SCALED_A,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SCALED_W,
    SIZE,
    SLOTS,
    STEEPEST,
    STEP,
    TABLES,
    THIRD_0,
    THIRD_V,
    THIRD_X,
    VALID_FROM,
    WAVE_C,
    WAVE_S,
    H,
)
from vibroimpact.engine.linear.table_rows import (
    coefficients,
    fill,
    late_series,
    power_series,
    swing_of,
)
from vibroimpact.engine.motion import BOTH, LEFT, RIGHT, SEEN_LEFT, facing
from vibroimpact.engine.stops.places import overlapping
from vibroimpact.engine.stops.rigid import resting


@kernel
def stiff_rate(plan: Vector) -> float:
    """What makes a velocity of a displacement: ω0, or ω where there is no spring."""
    k = plan[par.STIFFNESS]
    return math.sqrt(k) if k > 0.0 else plan[OMEGA]


@kernel
def build(plan: Vector, amplitude: float, omega: float) -> None:
    """Make the tables of all modes for one forcing.

    Parameters
    ----------
    plan : ndarray, shape (PLAN,)
        Starts with the rig's numbers; the tables are written.
    amplitude, omega : float
        Of the forcing, as passed to `parameters.rig_vector`: its size (m/s², m or N), and ω
        (rad/s).
    """
    begin(plan, amplitude, omega)
    for slot in range(2 * SLOTS):
        plan[TABLES + SIZE * slot + H] = 0.0  # not there
    for slot in range(SLOTS):
        mode = min(slot, BOTH)
        if mode == BOTH and not overlapping(plan):
            break
        stop = 1 if slot in (LEFT, SEEN_LEFT) else 0
        at = par.stop_at(stop)
        other = par.stop_at(1 - stop)
        if mode and (
            plan[at + par.KIND] == par.ABSENT
            or (mode == BOTH and plan[other + par.KIND] == par.ABSENT)
        ):
            continue
        if slot in (LEFT, SEEN_LEFT) and symmetric(plan):
            _copy(plan, TABLES + SIZE * slot, RIGHT if slot == LEFT else BOTH)
            continue
        stiffness = plan[at + par.BUMPER_STIFFNESS] if mode else 0.0
        damping = plan[at + par.BUMPER_DAMPING] if mode else 0.0
        k = plan[par.STIFFNESS] + stiffness
        c = plan[par.DAMPING] + damping
        d = facing(stop) * plan[par.LOAD]
        if mode:
            d -= plan[par.STIFFNESS] * plan[at + par.GAP]
        if mode == BOTH:
            k += plan[other + par.BUMPER_STIFFNESS]
            c += plan[other + par.BUMPER_DAMPING]
            d -= plan[other + par.BUMPER_STIFFNESS] * (plan[at + par.GAP] + plan[other + par.GAP])
        _table(plan, TABLES + SIZE * slot, k, c, d, stiffness, damping, slot)


@kernel
def symmetric(plan: Vector) -> bool:
    """Whether the left side is the right one in the mirror, the forcing's mirror image with it."""
    if count(plan) != 1 or plan[par.LOAD] != 0.0:
        return False
    for i in range(par.WIDTH):
        if plan[par.BUMPER + i] != plan[par.BUMPER + par.WIDTH + i]:
            return False
    one, other = wave(plan, 1, False), wave(plan, 1, True)
    return bool(one.sine == other.sine and one.cosine == other.cosine)


@kernel
def _copy(plan: Vector, table: int, slot: int) -> None:
    """Take over the early and the late table of another mode."""
    for late in range(2):
        to = table + late * LATE_TABLES
        source = TABLES + SIZE * slot + late * LATE_TABLES
        plan[to + VALID_FROM] = plan[source + VALID_FROM]
        if plan[source + VALID_FROM] < math.inf:
            for i in range(SIZE):
                plan[to + i] = plan[source + i]


@kernel
def spacing(plan: Vector, rate: float) -> float:
    """A table's step where the motion goes at this rate; a record's samples are nodes."""
    interval: float = plan[par.INTERVAL]
    rate = max(rate, pace(plan))
    if interval < math.inf:
        return interval / max(math.ceil(interval * rate / STEP), 1.0)
    return STEP / rate


@kernel
def _table(
    plan: Vector,
    table: int,
    k: float,
    c: float,
    d: float,
    stiffness: float,
    damping: float,
    slot: int,
) -> None:
    """Lay out the early and the late table of x″ = −c x′ − k x + d − A_t."""
    series = coefficients()
    mode = min(slot, BOTH)
    mirrored = slot in (LEFT, SEEN_LEFT)
    held = resting(plan, mode)
    if held:
        # Nothing moves; what is left of the forcing is what the mass feels of the base.
        k, c, d = 0.0, 0.0, 0.0
    most, steepest = (0.0, 0.0) if held else (plan[MOST], plan[STEEPEST])
    root = math.sqrt(k)
    square = 0.25 * c * c - k
    fast = 0.5 * c + math.sqrt(square) if square > 0.0 else root
    slow = k / fast if square > 0.0 else 0.0
    decay = fast if square > 0.0 else 0.5 * c
    parts = count(plan)
    for late in range(2):
        at = table + late * LATE_TABLES
        h = spacing(plan, slow if late else fast)
        if wave(plan, 1, False).closes == 0.0 and not held:
            # The last step of a line may reach beyond its end.
            most = plan[MOST] + steepest * h
        plan[at + VALID_FROM] = 0.0
        if late:
            # Worth a table of its own only where steps become much longer.
            gone = FORGOTTEN / decay if decay > 0.0 else math.inf
            if k == 0.0 or h < 5.0 * plan[table + H] or gone >= plan[par.INTERVAL]:
                plan[at + VALID_FROM] = math.inf
                continue
            plan[at + VALID_FROM] = gone
            # How far, how fast and so on the forcing alone moves the mass.
            swing, swing1, swing2, swing3 = 0.0, 0.0, 0.0, 0.0
            for n in range(1, parts + 1):
                part = wave(plan, n, mirrored)
                p, q = swing_of(c, k, part)
                size = math.hypot(p, q) * math.hypot(part.sine, part.cosine)
                rate = part.closes * part.rate
                swing += size
                swing1 += rate * size
                swing2 += rate * rate * size
                swing3 += rate * rate * rate * size
                if part.closes == 0.0:
                    swing, swing1 = most / k + c * steepest / (k * k), steepest / k
            # |z| ≤ (|v| + |x_p′| + fast (|x − x_s| + |x_p|)) / (fast − slow)
            zx = fast / (fast - slow) if slow > 0.0 else 0.0
            zv = 1.0 / (fast - slow) if slow > 0.0 else 0.0
            z0 = (swing1 + fast * swing) * zv
            second_x, second_v = slow * slow * zx, slow * slow * zv
            second_0 = slow * slow * z0 + swing2
            third_x, third_v = slow * second_x, slow * second_v
            third_0 = slow**3 * z0 + swing3
        else:
            # E = √k |x − x_s| + |x′| bounds the energy norm, which the forcing can
            # raise by no more than A t; |x″| ≤ (c + √k) E + A and so on follow.
            # Without a spring nothing holds against a constant force.
            push = most + abs(d) if k == 0.0 else most
            grown = push * h * (NODES + 1)
            second_x, second_v = (c + root) * root, c + root
            second_0 = (c + root) * grown + push
            third_x = c * second_x + k * root
            third_v = c * second_v + k
            third_0 = c * second_0 + k * grown + steepest
        eighth = h * h / 8.0
        plan[at + REST] = d / k if k > 0.0 else 0.0
        plan[at + BAND_X], plan[at + BAND_V] = second_x * eighth, second_v * eighth
        plan[at + BAND_0] = second_0 * eighth
        plan[at + FORCE_X] = (stiffness * second_x + damping * third_x) * eighth
        plan[at + FORCE_V] = (stiffness * second_v + damping * third_v) * eighth
        plan[at + FORCE_0] = (stiffness * second_0 + damping * third_0) * eighth
        cube = h * h * h
        plan[at + THIRD_X], plan[at + THIRD_V] = third_x * cube, third_v * cube
        plan[at + THIRD_0] = third_0 * cube
        # |x‴| ≤ (c + √k) b + |A′| and |x⁗| ≤ c |x‴| + k b + |A″| of early tables, as √k |x′| ≤ b.
        plan[at + FOURTH] = (c * (c + root) + k) * h * h
        plan[at + FOURTH_0] = c * steepest * h**4
        for n in range(1, parts + 1):
            part = wave(plan, n, mirrored)
            there = at + plane(plan, n)
            plan[there + LATE] = late
            plan[there + RESTING] = 1.0 if held else 0.0
            plan[there + H], plan[there + RATE] = h, 1.0 / h
            plan[there + SCALED_C], plan[there + SCALED_K] = c * h, k * h * h
            plan[there + SCALED_D], plan[there + SCALED_W] = d * h * h, part.rate * h
            plan[there + SCALED_A] = part.amplitude * h * h
            swings = part.closes * plan[there + SCALED_W] * plan[there + SCALED_W]
            plan[at + FOURTH_0] += (
                swings * abs(plan[there + SCALED_A]) * math.hypot(part.sine, part.cosine)
            )
            plan[there + WAVE_S] = plan[there + SCALED_A] * part.sine
            plan[there + WAVE_C] = plan[there + SCALED_A] * part.cosine
            if held:
                part = without_amplitude(part)
            if late:
                late_series(h, c, k, d, part, fast, slow, series)
            else:
                power_series(h, c, k, d, part, series)
            fill(plan, there, series, part, stiffness, damping, mode > 0, c, k)
