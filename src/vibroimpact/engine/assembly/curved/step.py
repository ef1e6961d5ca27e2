"""One step: the series of all masses, its length, and the certificate at its end."""

from __future__ import annotations

import math

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved.emitted import OFF
from vibroimpact.engine.assembly.curved.terms import (
    accelerations_of_all,
    coded,
    expand_all,
    node,
    remembers,
    row_of,
    run_code,
    share_of_unit,
)
from vibroimpact.engine.assembly.series import travel_by_series
from vibroimpact.engine.assembly.vectors import binary_logarithm, binary_power, slopes
from vibroimpact.engine.jit import Vector, apart, kernel
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.series.layout import NAMES
from vibroimpact.engine.series.step import BALANCED, TOLERANCE

_OWN_WEIGHT = of.NAMES + NAMES.index("own_weight")
_MORE = 4.0
"""How many times `TOLERANCE` the last terms of order 27 may be. Those that follow are a third."""
_CUT = 100
"""How often a step is shortened at most. Far sooner it is so short that any is right."""
_LEAST_SHARE = 2.0**-10
"""To which a step is shortened at once at most."""
_LARGEST = 1e290
"""Coefficient of which multiples and sums are finite."""


@kernel
def travel(plan: Vector, y: Vector, deformation: Vector, tau: float) -> None:
    """Carry the state, of which the series was made, on in place; what is free stays."""
    travel_by_series(plan, y, deformation, tau)
    order, base = int(plan[at.ORDER]), int(plan[at.NODES])
    for f in range(int(plan[at.STOPS])):
        law = row_of(plan, f)
        if remembers(plan, law):
            z, gained = node(plan, law, of.Z_NODE, base), 0.0
            for j in range(order, 0, -1):
                gained = (gained + plan[z + j]) * tau
            deformation[f] += gained


@kernel
def _idle(plan: Vector, law: int) -> bool:
    """Whether a stop of a formula is touched and would pull."""
    touched = int(plan[law + of.BEHAVIOUR]) == of.OWN_STOP and plan[law + of.ACTIVE] != 0.0
    return bool(touched and plan[law + _OWN_WEIGHT] == 0.0)


@kernel
def _last(plan: Vector, m: int, rate: float) -> float:
    """The largest coefficient of this order, as a velocity."""
    n = int(plan[at.MASSES])
    row, most = int(plan[at.SERIES]) + m * int(plan[at.ROW]), 0.0
    for i in range(n):
        one = abs(plan[row + n + 1 + i]) + rate * abs(plan[row + i])
        if not one <= most and most == most:  # what is not a number shows
            most = one
    if coded(plan):
        return most
    count = int(plan[at.STOPS])
    for f in range(count):
        law = row_of(plan, f)
        if remembers(plan, law):
            one = rate * abs(plan[node(plan, law, of.Z_NODE, int(plan[at.NODES])) + m])
        elif _idle(plan, law):
            # Its force is watched: as exact as if it acted.
            meets = plan[int(plan[at.COUPLING]) + f * count + f] * plan[at.PIECE_LENGTH] / m
            one = meets * abs(plan[node(plan, law, of.RAW_NODE, int(plan[at.NODES])) + m])
        else:
            continue
        if not one <= most and most == most:
            most = one
    return most


@kernel
def _kept_memory(plan: Vector) -> int:
    width = 2 * int(plan[at.MASSES]) + int(plan[at.WAVES]) + 1
    return int(plan[at.KEPT_Y]) + width + int(plan[at.STOPS]) + 8


@kernel
def take_end(plan: Vector, y: Vector, deformation: Vector) -> None:
    """Make the state at the end of a whole step, with which it was certified, the present one."""
    kept, memory = int(plan[at.KEPT_Y]), _kept_memory(plan)
    for i in range(2 * int(plan[at.MASSES]) + int(plan[at.WAVES]) + 1):
        y[i] = plan[kept + i]
    for f in range(int(plan[at.STOPS])):
        deformation[f] = plan[memory + f]


@kernel
def _excess_by_code(plan: Vector, deformation: Vector, tau: float, size: float) -> float:
    run_code(plan, 1, beyond(plan, int(plan[at.Y])), plan[at.PIECE_LENGTH], tau)
    found, memory = beyond(plan, int(plan[at.OUTPUTS])), beyond(plan, _kept_memory(plan))
    most = 0.0
    for i in range(int(plan[at.MASSES])):
        off = found[OFF + i]
        if not off <= most and most == most:
            most = off
    for f in range(int(plan[at.STOPS])):
        memory[f] = deformation[f]
    stops, listed = int(plan[at.STOP]), int(plan[at.PRESSED_LIST])
    for p in range(int(plan[at.PRESSED])):
        f = int(plan[listed + p])
        one = stops + f * at.STOP_WIDTH
        memory[f] += found[int(plan[one + at.LEFT])] - found[int(plan[one + at.RIGHT])]
    return most / (BALANCED * size + 1e-300)


@kernel
def excess(plan: Vector, y: Vector, deformation: Vector, tau: float, size: float) -> float:
    """By how much a step is too long, if above 1: what is missing from the equations at its end."""
    if coded(plan):
        return _excess_by_code(plan, deformation, tau, size)
    n, count, order = int(plan[at.MASSES]), int(plan[at.STOPS]), int(plan[at.ORDER])
    width = 2 * n + int(plan[at.WAVES]) + 1
    kept, memory = beyond(plan, int(plan[at.KEPT_Y])), beyond(plan, _kept_memory(plan))
    for i in range(width):
        kept[i] = y[i]
    for f in range(count):
        memory[f] = deformation[f]
    travel(plan, kept, memory, tau)
    place = int(plan[at.ROOM])
    accelerations_of_all(plan, kept, memory, place)
    h, row = plan[at.PIECE_LENGTH] * tau, int(plan[at.ROW])
    rate, most = plan[at.STIFF_RATE], 0.0
    grown = beyond(plan, int(plan[at.OUTPUTS]))
    velocities = beyond(plan, int(plan[at.SERIES]) + n + 1)
    for i in range(0, n, 8):
        slopes(beyond(velocities, i), row, order, tau, beyond(grown, i))
    for i in range(n):
        off = abs(grown[i] - plan[place + i] * h)
        if not off <= most and most == most:
            most = off
    for f in range(count):
        law = row_of(plan, f)
        if remembers(plan, law):
            z, found = node(plan, law, of.Z_NODE, int(plan[at.NODES])), 0.0
            for j in range(order, 0, -1):
                found = found * tau + j * plan[z + j]
            flow = plan[node(plan, law, of.FLOW_NODE, int(plan[at.POINT]))]
            off = rate * abs(found * tau - flow * h)
            if not off <= most and most == most:
                most = off
    return most / (BALANCED * size + 1e-300)


@apart
def take_step(
    plan: Vector, y: Vector, deformation: Vector, left: float, longest: float, size: float
) -> float:
    """Write the series of a step from a state; return its length, on which they are certified.

    Their unit is a power of two, so that it changes no digit; the step is `SHARE` of it.
    """
    rate, unit = plan[at.STIFF_RATE], plan[at.UNIT]
    before, last, order = 0.0, 0.0, 0
    for _ in range(40):
        expand_all(plan, y, deformation, unit, of.ORDER)
        order = int(plan[at.ORDER])
        before, last = _last(plan, order - 1, rate), _last(plan, order, rate)
        if before + last < _LARGEST:
            break
        unit *= 2.0**-16
    bound = TOLERANCE * (1.0 if order == of.ORDER else _MORE) * (size + 1e-300)
    whole, share = binary_logarithm(bound), 1000.0
    if before > 0.0:
        share = min(share, (whole - binary_logarithm(before)) / (order - 1))
    if last > 0.0:
        share = min(share, (whole - binary_logarithm(last)) / order)
    h = min(binary_power(share) * unit, longest)
    if not h > 0.0 or not before + last < math.inf:
        return 0.0
    h = left if left <= h else min(h, 0.5 * left)
    for _ in range(_CUT):
        off = excess(plan, y, deformation, h / unit, size)
        if off <= 1.0:
            share_of_unit(plan, h / unit)
            return h
        cut = _LEAST_SHARE
        if off < math.inf:
            cut = max(0.9 * off ** (-1.0 / (order - 1)), cut)
        h *= cut
    return 0.0
