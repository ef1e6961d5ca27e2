"""The tables of an isolator that yields or slides: one for each branch of its law and each mode."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import count, plane, wave
from vibroimpact.engine.forcing.wave import Wave
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.layout import (
    COLUMNS,
    COSINE,
    FINE,
    FINE_NODE,
    LATE,
    NODE,
    NODES,
    ORDER,
    RATE,
    SCALED_A,
    SCALED_C,
    SCALED_D,
    SCALED_K,
    SCALED_W,
    SINE,
    SIZE,
    STEEPEST,
    TAYLOR,
    WAVE_C,
    WAVE_S,
    WIDTH,
    H,
)
from vibroimpact.engine.linear.table_rows import (
    coefficients,
    compose,
    expanded_at,
    oscillate,
    power_series,
)
from vibroimpact.engine.linear.tables import spacing
from vibroimpact.engine.motion import LEFT
from vibroimpact.engine.taylor import plan as taylor
from vibroimpact.engine.yielding.layout import (
    BEND_0,
    BRANCHES,
    ELASTIC,
    MODES,
    MOVES_LEFT,
    PUSH_0,
    PUSH_E,
    ROOT,
    TABLES,
    TURN_0,
    TURN_E,
)


@inlined
def table_of(branch: int, mode: int) -> int:
    """Where the table of a branch and a mode begins."""
    return TABLES + SIZE * (MODES * branch + mode)


@kernel
def build(plan: Vector, amplitude: float, omega: float) -> None:
    """Make the tables for one forcing: its size (m/s², m or N) and ω (rad/s)."""
    taylor.build(plan, amplitude, omega)
    held = plan[par.FRICTION]
    elastic = plan[par.HYSTERETIC]
    if elastic != 0.0:
        held += elastic * plan[par.YIELD]
    for branch in range(BRANCHES):
        if branch == ELASTIC and elastic == 0.0:
            break
        k = plan[par.STIFFNESS]
        load = plan[par.LOAD]
        if branch == ELASTIC:
            k += elastic
        else:
            load += held if branch == MOVES_LEFT else -held
        for mode in range(MODES):
            if not mode:
                _table(plan, table_of(branch, mode), k, plan[par.DAMPING], load, 0.0, 0.0, False)
                continue
            at = par.stop_at(mode - 1)
            if plan[at + par.KIND] != par.KELVIN_VOIGT:
                continue
            mirrored = mode == LEFT
            d = (-load if mirrored else load) - k * plan[at + par.GAP]
            stiffness, damping = plan[at + par.BUMPER_STIFFNESS], plan[at + par.BUMPER_DAMPING]
            _table(
                plan,
                table_of(branch, mode),
                k + stiffness,
                plan[par.DAMPING] + damping,
                d,
                stiffness,
                damping,
                mirrored,
            )


@kernel
def _table(
    plan: Vector,
    table: int,
    k: float,
    c: float,
    d: float,
    stiffness: float,
    damping: float,
    mirrored: bool,
) -> None:
    """Lay out the table of x″ = −c x′ − k x + d − A_t.

    The bounds follow from x′ alone, which obeys the same equation without a constant: its energy
    norm e² = k x′² + x″² grows by no more than sup |A_t′| a second, |x‴| ≤ (c + √k) e + |A_t′|.
    """
    series = coefficients()
    root = math.sqrt(k)
    square = 0.25 * c * c - k
    h = spacing(plan, 0.5 * c + math.sqrt(square) if square > 0.0 else root)
    squared = h * h
    steepest = plan[STEEPEST]
    grown = steepest * h * (NODES + 1)
    bend = stiffness + damping * (c + root)
    plan[table + ROOT] = root
    plan[table + BEND_0] = grown
    plan[table + TURN_E] = (c + root) * squared
    plan[table + TURN_0] = ((c + root) * grown + steepest) * squared
    plan[table + PUSH_E] = bend * squared
    plan[table + PUSH_0] = (bend * grown + damping * steepest) * squared
    for n in range(1, count(plan) + 1):
        part = wave(plan, n, mirrored)
        there = table + plane(plan, n)
        plan[there + LATE] = 0.0
        plan[there + H], plan[there + RATE] = h, 1.0 / h
        plan[there + SCALED_C], plan[there + SCALED_K] = c * h, k * squared
        plan[there + SCALED_D], plan[there + SCALED_W] = d * squared, part.rate * h
        plan[there + SCALED_A] = part.amplitude * squared
        plan[there + WAVE_S] = plan[there + SCALED_A] * part.sine
        plan[there + WAVE_C] = plan[there + SCALED_A] * part.cosine
        power_series(h, c, k, d, part, series)
        _lay(plan, there, series, part, c, k)


@kernel
def _lay(plan: Vector, table: int, series: Vector, wave: Wave, c: float, k: float) -> None:
    """Write nodes, fine points and long series of one table.

    Each row is made of two half as far, and turns the clock without making it grow: a leg is
    shorter than a flight, and roundings that always went the same way would add up over many.
    """
    h = plan[table + H]
    for fine in range(2):
        origin = table + (FINE_NODE if fine else NODE - WIDTH)
        step = h / FINE if fine else h
        if fine:
            expanded_at(series, 0.0, h, wave, plan, origin)
        for n in range(1, FINE if fine else NODES + 1):
            at = origin + n * WIDTH
            if n == 1:
                expanded_at(series, 1.0 / FINE if fine else 1.0, h, wave, plan, at)
            else:
                half = origin + n // 2 * WIDTH
                compose(plan, half, half + n % 2 * WIDTH, at, wave.closes)
            if wave.closes != 0.0:
                cosine, sine = plan[at + COSINE], plan[at + SINE]
                shrunk = 1.5 - 0.5 * (cosine * cosine + sine * sine)
                plan[at + COSINE], plan[at + SINE] = shrunk * cosine, shrunk * sine
            if k > 0.25 * c * c:
                oscillate(plan, at, n * step, c, k)
    for column in range(COLUMNS):
        for n in range(ORDER):
            plan[table + TAYLOR + column * ORDER + n] = series[n * COLUMNS + column]
