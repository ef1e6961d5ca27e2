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
from vibroimpact.engine.forcing.wave import Wave, stilled
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import (
    BAND_0,
    BAND_V,
    BAND_X,
    COLUMNS,
    COSINE,
    FINE,
    FINE_NODE,
    FORCE,
    FORCE_0,
    FORCE_V,
    FORCE_X,
    FORGOTTEN,
    LATE,
    LATE_TABLES,
    LEFT_OUT,
    MOST,
    NODE,
    NODES,
    OMEGA,
    ORDER,
    RATE,
    REST,
    RESTING,
    ROW_V,
    SCALED_A,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SCALED_W,
    SINE,
    SIZE,
    SLOTS,
    STEEPEST,
    STEP,
    TABLES,
    TAYLOR,
    TAYLOR_F,
    VALID_FROM,
    WAVE_C,
    WAVE_S,
    WIDTH,
    H,
)
from vibroimpact.engine.linear.oscillation import oscillation
from vibroimpact.engine.memory import stack
from vibroimpact.engine.motion import BOTH, LEFT, RIGHT, SEEN_LEFT

_SERIES = ORDER + 6

coefficients = stack(_SERIES * COLUMNS)
"""Room for the series that the tables are made from, a row a term."""


@kernel
def _unit(wave: Wave, column: int) -> tuple[float, float]:
    """What the wave pulls if only this column of the state row is 1, and its quarter turn."""
    if column == 2:
        return wave.sine, -wave.cosine
    if column == 3:
        return wave.cosine, wave.sine
    return 0.0, 0.0


@kernel
def _series(h: float, c: float, k: float, d: float, wave: Wave, out: Vector) -> None:
    """Taylor coefficients (times hⁿ) of x from each unit state row: out[n COLUMNS + column]."""
    wh = wave.rate * h
    squared = wave.closes * wh * wh
    for column in range(COLUMNS):
        out[column] = 1.0 if column == 0 else 0.0
        out[COLUMNS + column] = h if column == 1 else 0.0
        constant = d if column == 4 else 0.0
        now, quarter = _unit(wave, column)
        after = wh * quarter
        for n in range(_SERIES - 2):
            force = constant - wave.amplitude * now
            constant = 0.0
            out[(n + 2) * COLUMNS + column] = (
                -c * h * (n + 1) * out[(n + 1) * COLUMNS + column]
                - k * h * h * out[n * COLUMNS + column]
                + force * h * h
            ) / ((n + 1) * (n + 2))
            now, after = after, -squared * now / ((n + 1) * (n + 2))


@kernel
def _swing(c: float, k: float, wave: Wave) -> tuple[float, float]:
    """The motion p·(what pulls) + q·(its quarter turn) that follows a wave when all else is gone.

    A line pulls x along at a distance; what is called its quarter turn is its slope.
    """
    stiff = k - wave.closes * wave.rate * wave.rate
    norm = stiff * stiff + wave.closes * c * c * wave.rate * wave.rate
    return -wave.amplitude * stiff / norm, wave.amplitude * c * wave.rate / norm


@kernel
def _late_series(
    h: float, c: float, k: float, d: float, wave: Wave, fast: float, slow: float, out: Vector
) -> None:
    """As `_series`, of what is left when the fast part has decayed.

    `fast` and `slow` are the decay rates of an overdamped phase, or `slow` is 0 for an
    oscillation that has died out altogether.
    """
    p, q = _swing(c, k, wave)
    wh = wave.rate * h
    squared = wave.closes * wh * wh
    for column in range(COLUMNS):
        # The particular solution and d/k, and the slow mode z exp(−slow t).
        x = 1.0 if column == 0 else 0.0
        v = 1.0 if column == 1 else 0.0
        s, co = _unit(wave, column)
        one = 1.0 if column == 4 else 0.0
        turned = p * co - wave.closes * q * s
        z = 0.0
        if slow > 0.0:
            z = (v - wave.rate * turned + fast * (x - p * s - q * co - one * d / k)) / (fast - slow)
        now, after = p * s + q * co, wh * turned
        for n in range(_SERIES):
            out[n * COLUMNS + column] = now + z
            if n == 0:
                out[n * COLUMNS + column] += one * d / k
            now, after = after, -squared * now / ((n + 1) * (n + 2))
            z *= -slow * h / (n + 1)


@kernel
def _at(series: Vector, y: float, h: float, wave: Wave, plan: Vector, at: int) -> None:
    """Rows at y steps from a series."""
    for column in range(COLUMNS):
        x = 0.0
        v = 0.0
        for n in range(_SERIES - 1, 0, -1):
            x = x * y + series[n * COLUMNS + column]
            v = v * y + n * series[n * COLUMNS + column]
        plan[at + column] = x * y + series[column]
        plan[at + ROW_V + column] = v / h
    angle = wave.rate * h * y
    plan[at + COSINE] = math.cos(angle) if wave.closes != 0.0 else 1.0
    plan[at + SINE] = math.sin(angle) if wave.closes != 0.0 else angle
    for i in range(LEFT_OUT, WIDTH):
        plan[at + i] = 0.0


@kernel
def _compose(plan: Vector, first: int, then: int, out: int, closes: float) -> None:
    """Rows of one stretch of time followed by another."""
    cosine, sine = plan[first + COSINE], plan[first + SINE]
    for i in range(2):
        b = then + i * ROW_V
        o = out + i * ROW_V
        for column in range(COLUMNS):
            plan[o + column] = (
                plan[b] * plan[first + column] + plan[b + 1] * plan[first + ROW_V + column]
            )
        plan[o + 2] += plan[b + 2] * cosine - closes * plan[b + 3] * sine
        plan[o + 3] += plan[b + 2] * sine + plan[b + 3] * cosine
        plan[o + 4] += plan[b + 4]
    turn_c, turn_s = plan[then + COSINE], plan[then + SINE]
    plan[out + COSINE] = cosine * turn_c - closes * sine * turn_s
    plan[out + SINE] = sine * turn_c + cosine * turn_s
    for i in range(LEFT_OUT, WIDTH):
        plan[out + i] = 0.0


@kernel
def _oscillate(plan: Vector, at: int, t: float, c: float, k: float) -> None:
    """The free oscillation in the rows of the time t, in closed form."""
    x_of_x, x_of_v, v_of_x, v_of_v, out, swing, pull = oscillation(t, c, k)
    plan[at], plan[at + 1] = x_of_x, x_of_v
    plan[at + ROW_V], plan[at + ROW_V + 1] = v_of_x, v_of_v
    plan[at + LEFT_OUT], plan[at + LEFT_OUT + 1] = out, swing
    plan[at + LEFT_OUT + 2], plan[at + LEFT_OUT + 3] = pull, out


@kernel
def _fill(
    plan: Vector,
    table: int,
    series: Vector,
    wave: Wave,
    stiffness: float,
    damping: float,
    contact: bool,
    c: float,
    k: float,
) -> None:
    """Lay out nodes, fine points and long series of one table."""
    h = plan[table + H]
    oscillates = plan[table + LATE] == 0.0 and k > 0.25 * c * c
    _at(series, 0.0, h, wave, plan, table + FINE_NODE)
    for n in range(1, FINE):
        at = table + FINE_NODE + n * WIDTH
        if n == 1:
            _at(series, 1.0 / FINE, h, wave, plan, at)
        else:
            _compose(plan, table + FINE_NODE + WIDTH, at - WIDTH, at, wave.closes)
        if oscillates:
            _oscillate(plan, at, n * h / FINE, c, k)
    for n in range(NODES):
        at = table + NODE + n * WIDTH
        if n == 0:
            _at(series, 1.0, h, wave, plan, at)
        else:
            _compose(plan, table + NODE, at - WIDTH, at, wave.closes)
        if oscillates:
            _oscillate(plan, at, (n + 1) * h, c, k)
    for column in range(5):
        for n in range(ORDER):
            plan[table + TAYLOR + column * ORDER + n] = series[n * COLUMNS + column]
    if not contact:
        return
    for n in range(NODES):
        for column in range(5):
            at = table + NODE + n * WIDTH + column
            plan[table + FORCE + n * 5 + column] = stiffness * plan[at] + damping * plan[at + ROW_V]
    for column in range(5):
        for n in range(ORDER):
            plan[table + TAYLOR_F + column * ORDER + n] = (
                stiffness * series[n * COLUMNS + column]
                + damping * (n + 1) * series[(n + 1) * COLUMNS + column] / h
            )


@kernel
def stiff_rate(plan: Vector) -> float:
    """What makes a velocity of a displacement: ω0, or ω where there is no spring."""
    k = plan[par.STIFFNESS]
    return math.sqrt(k) if k > 0.0 else plan[OMEGA]


@kernel
def overlapping(plan: Vector) -> bool:
    """Whether both stops can be touched at once."""
    return bool(plan[par.BUMPER + par.GAP] + plan[par.BUMPER + par.WIDTH + par.GAP] < 0.0)


@kernel
def resting(plan: Vector, mode: int) -> bool:
    """Whether a rigid stop holds the mass in this mode."""
    right = mode & RIGHT and plan[par.BUMPER + par.KIND] == par.RIGID
    left = mode & LEFT and plan[par.BUMPER + par.WIDTH + par.KIND] == par.RIGID
    return bool(right or left)


@kernel
def build(plan: Vector, amplitude: float, omega: float) -> None:
    """Make the tables of all modes for one forcing.

    Parameters
    ----------
    plan : ndarray, shape (PLAN,)
        Starts with the rig's numbers; the tables are written.
    amplitude, omega : float
        Of the forcing, as `parameters.rig_vector` was told: its size (m/s², m or N), and ω
        (rad/s).
    """
    begin(plan, amplitude, omega)
    for slot in range(2 * SLOTS):
        plan[TABLES + SIZE * slot + H] = 0.0  # not there
    for slot in range(SLOTS):
        mode = min(slot, BOTH)
        if mode == BOTH and not overlapping(plan):
            break
        side = LEFT if slot in (LEFT, SEEN_LEFT) else RIGHT
        at = par.BUMPER + par.WIDTH * (side - 1)
        other = par.BUMPER + par.WIDTH * (2 - side)
        if mode and (
            plan[at + par.KIND] == par.ABSENT
            or (mode == BOTH and plan[other + par.KIND] == par.ABSENT)
        ):
            continue
        stiffness = plan[at + par.BUMPER_STIFFNESS] if mode else 0.0
        damping = plan[at + par.BUMPER_DAMPING] if mode else 0.0
        k = plan[par.STIFFNESS] + stiffness
        c = plan[par.DAMPING] + damping
        d = plan[par.LOAD] if side == RIGHT else -plan[par.LOAD]
        if mode:
            d -= plan[par.STIFFNESS] * plan[at + par.GAP]
        if mode == BOTH:
            k += plan[other + par.BUMPER_STIFFNESS]
            c += plan[other + par.BUMPER_DAMPING]
            d -= plan[other + par.BUMPER_STIFFNESS] * (plan[at + par.GAP] + plan[other + par.GAP])
        _table(plan, TABLES + SIZE * slot, k, c, d, stiffness, damping, slot)


@kernel
def _step(plan: Vector, rate: float) -> float:
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
        h = _step(plan, slow if late else fast)
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
                p, q = _swing(c, k, part)
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
        for n in range(1, parts + 1):
            part = wave(plan, n, mirrored)
            there = at + plane(plan, n)
            plan[there + LATE] = late
            plan[there + RESTING] = 1.0 if held else 0.0
            plan[there + H], plan[there + RATE] = h, 1.0 / h
            plan[there + SCALED_C], plan[there + SCALED_K] = c * h, k * h * h
            plan[there + SCALED_D], plan[there + SCALED_W] = d * h * h, part.rate * h
            plan[there + SCALED_A] = part.amplitude * h * h
            plan[there + WAVE_S] = plan[there + SCALED_A] * part.sine
            plan[there + WAVE_C] = plan[there + SCALED_A] * part.cosine
            if held:
                part = stilled(part)
            if late:
                _late_series(h, c, k, d, part, fast, slow, series)
            else:
                _series(h, c, k, d, part, series)
            _fill(plan, there, series, part, stiffness, damping, mode > 0, c, k)
