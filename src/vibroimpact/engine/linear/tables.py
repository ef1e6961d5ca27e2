"""Closed-form motion of one phase, kept as small matrices (docs/theory.md, section 2).

Within a phase (flight, pressed on the right, on the left or on both sides) the motion obeys

    x″ = −c x′ − k x + d − A s,    s = sin θ,    θ′ = ω,

so that the motion at any later time is a fixed linear function of the *state row*
(x, x′, sin θ, cos θ, 1). A phase's table holds these functions at equidistant nodes, and
the Taylor series from any point. In flight x is the relative displacement u; in contact it
is the bumper's deformation, measured towards the bumper (a left contact is the mirror image
of a right one), so that a deformation of a millionth of the gap keeps all its digits.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.oscillation import oscillation
from vibroimpact.engine.memory import TERMS, stack
from vibroimpact.engine.motion import BOTH, LEFT, RIGHT, SEEN_LEFT

NODES = 16
"""Intervals in a table; node j is j steps after the table's start."""

STEP = 0.25
"""A step times the fastest rate of the phase: the curve is nearly a parabola over a step."""

FINE = 32
"""Points in an interval from which a short Taylor series reaches the next one to rounding:
with a radius of 1/40 step, (0.25/40)^6 / 6! = 8e-17."""

ORDER = TERMS
"""Coefficients of the long series about the middle of an interval, in y = (t − t_middle) / step.
It covers the interval to rounding: 0.125^12 / 12! = 2e-20."""

FORGOTTEN = 44.0
"""exp(−44) = 8e-20: what has decayed by this much is below the rounding of what it is added to."""

# Layout of a table: a header of single numbers, then rows.
H = 0  # step, s
BAND_X = 1  # bound on |x″| h²/8 from a state: BAND_X |x − x_s| + BAND_V |x′| + BAND_0
BAND_V = 2
BAND_0 = 3
FORCE_X = 4  # the same for the contact force per unit mass, F″ h²/8
FORCE_V = 5
FORCE_0 = 6
REST = 7  # x_s = d / k, static equilibrium
VALID_FROM = 8  # age of the phase (s) from which the table holds
SCALED_C = 9  # c h
SCALED_K = 10  # k h²
SCALED_D = 11  # d h²
SCALED_A = 12  # A h²
SCALED_W = 13  # ω h
LATE = 14  # 1 where the fast part of the motion is projected out
RATE = 15  # 1 / h
RESTING = 16  # 1 where a rigid stop holds the mass
HEADER = 17

# A node's rows: x and x′ as functions of the state row at the start, then the cosine and
# sine of the angle that the forcing turns until there, then what the rounding of the first two
# columns has left out.
ROW_V = 5
COSINE = 10
SINE = 11
LEFT_OUT = 12
WIDTH = 16
NODE = HEADER  # nodes 1..NODES
FINE_NODE = NODE + NODES * WIDTH  # points 0..FINE-1 of an interval
MIDDLE = FINE_NODE + FINE // 2 * WIDTH
FORCE = FINE_NODE + FINE * WIDTH  # contact force at nodes 1..NODES, 5 numbers each
TAYLOR = FORCE + NODES * 5  # long series of x: 5 columns of ORDER
TAYLOR_F = TAYLOR + 5 * ORDER  # long series of the contact force
SIZE = TAYLOR_F + 5 * ORDER

SLOTS = 5
"""Tables from the start of a mode: flight, pressed right, pressed left, and pressed on both sides
as seen from the right and from the left. As many again hold once a mode's fast part is gone."""

LATE_TABLES = SLOTS * SIZE
"""From a mode's early table to its late one."""

AMPLITUDE = par.SIZE  # of the base acceleration, m/s²
OMEGA = par.SIZE + 1  # rad/s
TABLES = par.SIZE + 2
"""Where the tables begin in a plan."""

PLAN = TABLES + 2 * LATE_TABLES
"""Length of a plan: the rig's numbers (`parameters`), the forcing, and the tables.

One vector holds everything that the kernels read: they pass it on as one argument, and a table
is the position where it begins.
"""

COLUMNS = 5
"""Of a state row: x, x′, sin θ, cos θ, 1."""

_SERIES = ORDER + 6

coefficients = stack(_SERIES * COLUMNS)
"""Room for the series that the tables are made from, a row a term."""


@kernel
def _series(
    h: float, c: float, k: float, d: float, amplitude: float, omega: float, out: Vector
) -> None:
    """Taylor coefficients (times hⁿ) of x from each unit state row: out[n COLUMNS + column]."""
    wh = omega * h
    for column in range(5):
        out[column] = 1.0 if column == 0 else 0.0
        out[COLUMNS + column] = h if column == 1 else 0.0
        constant = d if column == 4 else 0.0
        # Taylor coefficients of sin(θ + ωt) from the unit phasor; (sin)″ = −ω² sin.
        now = 1.0 if column == 2 else 0.0
        after = wh if column == 3 else 0.0
        for n in range(_SERIES - 2):
            force = constant - amplitude * now
            constant = 0.0
            out[(n + 2) * COLUMNS + column] = (
                -c * h * (n + 1) * out[(n + 1) * COLUMNS + column]
                - k * h * h * out[n * COLUMNS + column]
                + force * h * h
            ) / ((n + 1) * (n + 2))
            now, after = after, -wh * wh * now / ((n + 1) * (n + 2))


@kernel
def _late_series(
    h: float,
    c: float,
    k: float,
    d: float,
    amplitude: float,
    omega: float,
    fast: float,
    slow: float,
    out: Vector,
) -> None:
    """As `_series`, of what is left when the fast part has decayed.

    `fast` and `slow` are the decay rates of an overdamped phase, or `slow` is 0 for an
    oscillation that has died out altogether.
    """
    stiff = k - omega * omega
    norm = stiff * stiff + c * c * omega * omega
    p = -amplitude * stiff / norm
    q = amplitude * c * omega / norm
    wh = omega * h
    for column in range(5):
        # The particular solution p sin θ + q cos θ + d/k, and the slow mode z exp(−slow t).
        x = 1.0 if column == 0 else 0.0
        v = 1.0 if column == 1 else 0.0
        s = 1.0 if column == 2 else 0.0
        co = 1.0 if column == 3 else 0.0
        one = 1.0 if column == 4 else 0.0
        z = 0.0
        if slow > 0.0:
            z = (v - omega * (p * co - q * s) + fast * (x - p * s - q * co - one * d / k)) / (
                fast - slow
            )
        now, after = p * s + q * co, wh * (p * co - q * s)
        for n in range(_SERIES):
            out[n * COLUMNS + column] = now + z
            if n == 0:
                out[n * COLUMNS + column] += one * d / k
            now, after = after, -wh * wh * now / ((n + 1) * (n + 2))
            z *= -slow * h / (n + 1)


@kernel
def _at(series: Vector, y: float, h: float, omega: float, plan: Vector, at: int) -> None:
    """Rows at y steps from a series."""
    for column in range(5):
        x = 0.0
        v = 0.0
        for n in range(_SERIES - 1, 0, -1):
            x = x * y + series[n * COLUMNS + column]
            v = v * y + n * series[n * COLUMNS + column]
        plan[at + column] = x * y + series[column]
        plan[at + ROW_V + column] = v / h
    plan[at + COSINE] = math.cos(omega * h * y)
    plan[at + SINE] = math.sin(omega * h * y)
    for i in range(LEFT_OUT, WIDTH):
        plan[at + i] = 0.0


@kernel
def _compose(plan: Vector, first: int, then: int, out: int) -> None:
    """Rows of one stretch of time followed by another."""
    cosine, sine = plan[first + COSINE], plan[first + SINE]
    for i in range(2):
        b = then + i * ROW_V
        o = out + i * ROW_V
        for column in range(5):
            plan[o + column] = (
                plan[b] * plan[first + column] + plan[b + 1] * plan[first + ROW_V + column]
            )
        plan[o + 2] += plan[b + 2] * cosine - plan[b + 3] * sine
        plan[o + 3] += plan[b + 2] * sine + plan[b + 3] * cosine
        plan[o + 4] += plan[b + 4]
    turn_c, turn_s = plan[then + COSINE], plan[then + SINE]
    plan[out + COSINE] = cosine * turn_c - sine * turn_s
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
    omega: float,
    stiffness: float,
    damping: float,
    contact: bool,
    c: float,
    k: float,
) -> None:
    """Lay out nodes, fine points and long series of one table."""
    h = plan[table + H]
    oscillates = plan[table + LATE] == 0.0 and k > 0.25 * c * c
    _at(series, 0.0, h, omega, plan, table + FINE_NODE)
    for n in range(1, FINE):
        at = table + FINE_NODE + n * WIDTH
        if n == 1:
            _at(series, 1.0 / FINE, h, omega, plan, at)
        else:
            _compose(plan, table + FINE_NODE + WIDTH, at - WIDTH, at)
        if oscillates:
            _oscillate(plan, at, n * h / FINE, c, k)
    for n in range(NODES):
        at = table + NODE + n * WIDTH
        if n == 0:
            _at(series, 1.0, h, omega, plan, at)
        else:
            _compose(plan, table + NODE, at - WIDTH, at)
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
        A (m/s²) and ω (rad/s) of the base acceleration A sin θ.
    """
    plan[AMPLITUDE], plan[OMEGA] = amplitude, omega
    for slot in range(2 * SLOTS):
        plan[TABLES + SIZE * slot + H] = 0.0  # not there
    series = coefficients()
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
        d = -plan[par.STIFFNESS] * plan[at + par.GAP] if mode else 0.0
        if mode == BOTH:
            k += plan[other + par.BUMPER_STIFFNESS]
            c += plan[other + par.BUMPER_DAMPING]
            d -= plan[other + par.BUMPER_STIFFNESS] * (plan[at + par.GAP] + plan[other + par.GAP])
        _table(plan, TABLES + SIZE * slot, k, c, d, stiffness, damping, mode, series)


@kernel
def _table(
    plan: Vector,
    table: int,
    k: float,
    c: float,
    d: float,
    stiffness: float,
    damping: float,
    mode: int,
    series: Vector,
) -> None:
    """Lay out the early and the late table of x″ = −c x′ − k x + d − A s."""
    amplitude, omega = plan[AMPLITUDE], plan[OMEGA]
    held = resting(plan, mode)
    if held:
        # Nothing moves; what is left of the forcing is what the mass feels of the base.
        k, c, d, amplitude = 0.0, 0.0, 0.0, 0.0
    root = math.sqrt(k)
    square = 0.25 * c * c - k
    fast = 0.5 * c + math.sqrt(square) if square > 0.0 else root
    slow = k / fast if square > 0.0 else 0.0
    decay = fast if square > 0.0 else 0.5 * c
    for late in range(2):
        at = table + late * LATE_TABLES
        plan[at + REST] = d / k if k > 0.0 else 0.0
        plan[at + LATE] = late
        plan[at + RESTING] = 1.0 if held else 0.0
        if late:
            rate = max(slow, omega)
            # Worth a table of its own only where steps become much longer.
            if rate > 0.2 * fast or decay == 0.0:
                plan[at + VALID_FROM] = math.inf
                continue
            h = STEP / rate
            plan[at + VALID_FROM] = FORGOTTEN / decay
            _late_series(h, c, k, d, amplitude, omega, fast, slow, series)
            norm = (k - omega * omega) ** 2 + (c * omega) ** 2
            swing = amplitude / math.sqrt(norm)
            # |z| ≤ (|v| + ω swing + fast (|x − x_s| + swing)) / (fast − slow)
            zx = fast / (fast - slow) if slow > 0.0 else 0.0
            zv = 1.0 / (fast - slow) if slow > 0.0 else 0.0
            z0 = (omega + fast) * swing * zv
            w2 = omega * omega * swing
            second_x, second_v = slow * slow * zx, slow * slow * zv
            second_0 = slow * slow * z0 + w2
            third_x, third_v = slow * second_x, slow * second_v
            third_0 = slow**3 * z0 + omega * w2
        else:
            h = STEP / max(fast, omega)
            plan[at + VALID_FROM] = 0.0
            _series(h, c, k, d, amplitude, omega, series)
            # E = √k |x − x_s| + |x′| bounds the energy norm, which the forcing can
            # raise by no more than A t; |x″| ≤ (c + √k) E + A and so on follow.
            grown = amplitude * h * (NODES + 1)
            second_x, second_v = (c + root) * root, c + root
            second_0 = (c + root) * grown + amplitude
            third_x = c * second_x + k * root
            third_v = c * second_v + k
            third_0 = c * second_0 + k * grown + amplitude * omega
        eighth = h * h / 8.0
        plan[at + H], plan[at + RATE] = h, 1.0 / h
        plan[at + BAND_X], plan[at + BAND_V] = second_x * eighth, second_v * eighth
        plan[at + BAND_0] = second_0 * eighth
        plan[at + FORCE_X] = (stiffness * second_x + damping * third_x) * eighth
        plan[at + FORCE_V] = (stiffness * second_v + damping * third_v) * eighth
        plan[at + FORCE_0] = (stiffness * second_0 + damping * third_0) * eighth
        plan[at + SCALED_C], plan[at + SCALED_K], plan[at + SCALED_D] = c * h, k * h * h, d * h * h
        plan[at + SCALED_A], plan[at + SCALED_W] = plan[AMPLITUDE] * h * h, omega * h
        _fill(plan, at, series, omega, stiffness, damping, mode > 0, c, k)
