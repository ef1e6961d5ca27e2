"""What a mode makes of a state: accelerations, and forces of stops, as a matrix.

Each column is what `drive` and `restrain` make of a unit. Columns: a row of the series (u, 0, v, 0,
w), then the inputs: 1, the deformation of each pressed stop, the force of each curved row. Results:
the acceleration of each mass, the force of each pressed and of each resting stop. They stand in
blocks of eight; a block begins with the ranges of u and of v on which it depends. The matrices of
some modes are kept: which, changes no digit.
"""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.acceleration import Places, drive, places, restrain
from vibroimpact.engine.assembly.mode import move_alike
from vibroimpact.engine.assembly.vectors import combine_ranges
from vibroimpact.engine.jit import Vector, inlined, kernel, not_inlined
from vibroimpact.engine.memory import beyond

HEAD = 8


class Rates(NamedTuple):
    """Where the matrix of a mode stands, and its sizes."""

    place: int
    block: int
    blocks: int
    waves: int
    width: int
    inputs: int


def rates_size(n: int, stops: int, waves: int) -> int:
    """Numbers in the matrix of one mode."""
    blocks = -(-(n + stops) // 8)
    return blocks * (HEAD + 8 * (2 * (n + 1) + waves + 1 + stops)) + _closed_size(n)


def _closed_size(n: int) -> int:
    return 16 * n if n <= 8 else 0


@inlined
def _sizes(plan: Vector, of: Places, place: int) -> Rates:
    width, inputs = 2 * (of.masses + 1) + of.waves, 1 + of.pressed + int(plan[at.CURVED])
    return Rates(
        place,
        HEAD + 8 * (width + inputs),
        (of.masses + of.pressed + of.resting + 7) // 8,
        width - of.waves,
        width,
        inputs,
    )


@inlined
def rates_of_mode(plan: Vector, of: Places) -> Rates:
    """Return the matrix of the present mode, which is made if need be."""
    if plan[at.RATES_NOW] < 0.0:
        _find(plan)
    return _sizes(plan, of, int(plan[at.RATES_NOW]))


@inlined
def apply_rates(
    plan: Vector, rates: Rates, here: Vector, inputs: Vector, first: int, out: Vector
) -> None:
    """Write accelerations and forces of a row and of its inputs from the first on."""
    for b in range(rates.blocks):
        head = rates.place + b * rates.block
        combine_ranges(
            beyond(plan, head + HEAD),
            here,
            int(plan[head]),
            int(plan[head + 1]),
            int(plan[head + 2]),
            int(plan[head + 3]),
            rates.waves,
            rates.width,
            inputs,
            first,
            rates.inputs,
            beyond(out, 8 * b),
        )


@not_inlined
def _find(plan: Vector) -> None:
    """Look for the matrix of the present mode; it is the same on all branches of laws."""
    mode = int(plan[at.MODE]) & ((1 << int(plan[at.STOPS])) - 1)
    k = (mode ^ mode >> 6 ^ mode >> 12 ^ mode >> 24) & (int(plan[at.RATES_SLOTS]) - 1)
    place = int(plan[at.RATES]) + k * int(plan[at.RATES_SIZE])
    plan[at.RATES_NOW] = float(place)
    keys = int(plan[at.RATES_MODE])
    if int(plan[keys + k]) != mode:
        _make(plan, place)
        plan[keys + k] = float(mode)


@inlined
def closed_place(plan: Vector, place: int, n: int) -> int:
    """Where it stands how coefficients after the first depend on u, then on v; up to eight masses.

    What they make of the deformations of pressed stops is part of it. Of eight numbers of a row,
    number i is what mass i feels of the mass that is so many rows further, in a circle.
    """
    return place + int(plan[at.RATES_SIZE]) - 16 * n


@kernel
def _close(plan: Vector, of: Places, rates: Rates) -> None:
    n = of.masses
    if n > 8:
        return
    columns, matrix = closed_place(plan, rates.place, n), rates.place + HEAD
    for i in range(n):
        for by in range(n):
            q = (i + by) % n
            plan[columns + 8 * by + i] = plan[matrix + 8 * q + i]
            plan[columns + 8 * (n + by) + i] = plan[matrix + 8 * (n + 1 + q) + i]
        for p in range(of.pressed):
            one = of.stops + int(plan[of.pressed_list + p]) * at.STOP_WIDTH
            change = plan[matrix + 8 * (rates.width + 1 + p) + i]
            for end in (at.LEFT, at.RIGHT):
                q = int(plan[one + end])
                if q < n:
                    plan[columns + 8 * ((q - i) % n) + i] += change
                change = -change
    for by in range(2 * n):
        for i in range(n, 8):
            plan[columns + 8 * by + i] = 0.0


@kernel
def _make(plan: Vector, place: int) -> None:
    of = places(plan)
    rates = _sizes(plan, of, place)
    n, v = of.masses, of.masses + 1
    results, columns = n + of.pressed + of.resting, rates.width + rates.inputs
    unit = int(plan[at.OUTPUTS])
    forces = unit + columns
    accelerations = forces + of.pressed + of.resting
    curved = -1
    for column in range(columns):
        for i in range(columns + of.pressed + of.resting):
            plan[unit + i] = 0.0
        plan[unit + column] = 0.0 if column in (n, n + v) else 1.0
        one, pressed = column - rates.width, beyond(plan, forces)
        for p in range(of.pressed):
            pressed[p] = plan[unit + rates.width + 1 + p]
        if one <= of.pressed:
            waves, constant = beyond(plan, unit + 2 * v), plan[unit + rates.width]
            drive(plan, of, beyond(plan, unit), waves, pressed, constant, accelerations)
        else:
            curved += 1
            while plan[of.stops + curved * at.STOP_WIDTH + at.KIND] < at.PUSHING:
                curved += 1
            for i in range(n):
                plan[accelerations + i] = -plan[of.response + curved * n + i]
        restrain(plan, of, beyond(pressed, of.pressed), accelerations)
        move_alike(plan, beyond(plan, accelerations))
        for b in range(rates.blocks):
            cell = place + b * rates.block + HEAD + 8 * column
            for i in range(8):
                r = 8 * b + i
                plan[cell + i] = 0.0
                if r < n:
                    plan[cell + i] = plan[accelerations + r]
                elif r < results:
                    plan[cell + i] = plan[forces + r - n]
    _close(plan, of, rates)
    for b in range(rates.blocks):
        head = place + b * rates.block
        for part in range(2):
            first, end = v, 0
            for i in range(v):
                for k in range(8):
                    if plan[head + HEAD + 8 * (part * v + i) + k] != 0.0:
                        first, end = min(first, i), i + 1
            plan[head + 2 * part] = float(part * v + min(first, end))
            plan[head + 2 * part + 1] = float(part * v + end)
