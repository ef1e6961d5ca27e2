"""Tables of a mode: its watched functions and its state at any time as products with the state.

x is y and the deformations of the pressed stops, N numbers. A table has rows of eight: eight
results, for each number of x (`vectors.combine`). Propagators are kept less the identity, so that
no digits are lost. Each column is made from the Taylor series of a unit vector.

- leaps of 1, 2, 4, 8 steps; propagators of j/32 and j/1024 of a step; four derivatives of v: any
  time is three products;
- of each watched function on a step, the 16 Bernstein coefficients;
- in flight, of each observed channel on a step, 16 Bernstein coefficients (`SEEN`);
- of each on a leap, 8 coefficients of an approximation of degree 7, and a row of bounds: on each
  step of the leap, approximation less function has coefficients of at most Σ bound_i |x_i|. If all
  8 are above that, there is no root.
"""

from __future__ import annotations

import math
from math import comb
from typing import Any

import numpy as np

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.channels import observed
from vibroimpact.engine.assembly.series import expand_state, gain_all, to_bernstein, watched_series
from vibroimpact.engine.assembly.vectors import combine, combine_sixteen
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond

LEVELS = 4
_FRACTIONS = 32
_JETS = 4
_LOW = 7
_NODES = 8
_RULE = 2 * 8 * 16
RULES = ((1 << LEVELS) - 1) * _RULE
"""How many numbers there are in `rules`."""
# Of a table.
STEP_LENGTH, WIDTH, LEAPS, FRACTION, FINE, JETS, FULL, LOW, BOUND = range(9)
_HEAD = 16


def table_size(n: int, stops: int, waves: int) -> int:
    """Numbers in the tables of one mode."""
    width = 2 * n + waves + 1 + stops
    square = -(-width // 8) * 8 * width
    rows = (LEVELS + 2 * _FRACTIONS) * square + -(-_JETS * n // 8) * 8 * width
    return _HEAD + rows + stops * width * (16 + LEVELS * (8 + 1)) + 8


def rules() -> Any:
    """Numbers with which approximations of degree 7 are made and compared, for each step of a leap.

    What its 16 coefficients add to the eight of the approximation, which meets the function at
    Chebyshev's nodes; then what each of the eight adds to the 16 of the approximation there.
    """

    def basis(d: int, x: float) -> list[float]:
        return [comb(d, j) * x**j * (1.0 - x) ** (d - j) for j in range(d + 1)]

    def restricted(left: float, right: float) -> Any:
        """Of a part of the interval, by blossoms."""
        rows = []
        for j in range(_LOW + 1):
            row = np.eye(_LOW + 1)
            for k in range(_LOW):
                t = right if k < j else left
                row = (1.0 - t) * row[:-1] + t * row[1:]
            rows.append(row[0])
        return np.array(rows)

    nodes = 0.5 - 0.5 * np.cos(np.pi * (np.arange(_NODES) + 0.5) / _NODES)
    fit = np.linalg.inv(np.array([basis(_LOW, x) for x in nodes]))
    d = at.DEGREE
    lift = np.array(
        [
            [
                comb(_LOW, i) * comb(d - _LOW, j - i) / comb(d, j)
                if 0 <= j - i <= d - _LOW
                else 0.0
                for i in range(_LOW + 1)
            ]
            for j in range(d + 1)
        ]
    )
    matrices = []
    for level in range(LEVELS):
        pieces = 1 << level
        for q in range(pieces):
            here = [
                basis(d, x * pieces - q) if int(x * pieces) == q else [0.0] * (d + 1) for x in nodes
            ]
            matrices += [(fit @ here).T, (lift @ restricted(q / pieces, (q + 1) / pieces)).T]
    return np.concatenate([np.ravel(one) for one in matrices])


@not_inlined
def table_of_mode(plan: Vector) -> int:
    """Where the tables of the present mode begin, made if need be; 0 if it has none."""
    known = int(plan[at.TABLE_NOW])
    if known >= 0:
        return known
    mode = int(plan[at.MODE])
    bits, rest = 0, mode
    while rest > 0:
        rest &= rest - 1
        bits += 1
    place = 0
    if bits <= int(plan[at.MOST_PRESSED]):
        size = 2 * int(plan[at.SLOTS])
        keys, slots = int(plan[at.KEYS]), int(plan[at.SLOT_OF])
        k = (mode * 40503 + (mode >> 16) * 2531) % size
        while plan[keys + k] >= 0.0 and int(plan[keys + k]) != mode:
            k = (k + 1) % size
        if plan[keys + k] < 0.0:
            plan[keys + k], plan[slots + k] = float(mode), plan[at.USED]
            plan[at.USED] += 1.0
            place = int(plan[at.TABLE]) + int(plan[slots + k]) * int(plan[at.TABLE_SIZE])
            make_tables(plan, place)
        place = int(plan[at.TABLE]) + int(plan[slots + k]) * int(plan[at.TABLE_SIZE])
    plan[at.TABLE_NOW] = float(place)
    return place


@kernel
def table_of_flight(plan: Vector) -> int:
    """Where the tables of flight begin, which were made."""
    mode, known = plan[at.MODE], plan[at.TABLE_NOW]
    plan[at.MODE], plan[at.TABLE_NOW] = 0.0, -1.0
    start: int = table_of_mode(plan)
    plan[at.MODE], plan[at.TABLE_NOW] = mode, known
    return start


@kernel
def gather(plan: Vector, x: Vector) -> None:
    """Write x, and after it the magnitudes."""
    base = 2 * int(plan[at.MASSES]) + int(plan[at.WAVES]) + 1
    y, p = int(plan[at.Y]), int(plan[at.PRESSED])
    for i in range(base):
        x[i] = plan[y + i]
    deformation, listed = int(plan[at.DEFORMATION]), int(plan[at.PRESSED_LIST])
    for j in range(p):
        x[base + j] = plan[deformation + int(plan[listed + j])]


@not_inlined
def make_tables(plan: Vector, place: int) -> None:
    """Write the tables of the present mode."""
    n, w, count = int(plan[at.MASSES]), int(plan[at.WAVES]), int(plan[at.STOPS])
    mode, p = int(plan[at.MODE]), int(plan[at.PRESSED])
    base = 2 * n + w + 1
    width = base + p
    blocks = (width + 7) // 8
    square = blocks * width * 8
    h = at.STEP / max(plan[at.RATE], 1e-200)
    if plan[at.RECORD] != 0.0:
        h = plan[at.INTERVAL] / math.ceil(plan[at.INTERVAL] / h)
    table = beyond(plan, place)
    table[STEP_LENGTH], table[WIDTH] = h, float(width)
    leaps = place + _HEAD
    fraction = leaps + LEVELS * square
    fine = fraction + _FRACTIONS * square
    jets = fine + _FRACTIONS * square
    full = jets + (_JETS * n + 7) // 8 * 8 * width
    low = full + count * 16 * width
    bound = low + LEVELS * count * 8 * width
    table[LEAPS], table[FRACTION], table[FINE] = float(leaps), float(fraction), float(fine)
    table[JETS], table[FULL], table[LOW], table[BOUND] = (
        float(jets),
        float(full),
        float(low),
        float(bound),
    )
    for i in range(leaps, bound + LEVELS * count * width):
        plan[i] = 0.0
    unit = int(plan[at.TABLE_ROOM])
    pressed = unit + width + 8
    row, series = int(plan[at.ROW]), int(plan[at.SERIES])
    gained = beyond(plan, int(plan[at.OUTPUTS]))
    change = beyond(plan, pressed + count)
    a, b = beyond(plan, int(plan[at.COEFFICIENTS])), beyond(plan, int(plan[at.BERNSTEIN]))
    for column in range(width):
        for i in range(width):
            plan[unit + i] = 1.0 if i == column else 0.0
        for j in range(p):
            f = int(plan[int(plan[at.PRESSED_LIST]) + j])
            plan[pressed + f] = plan[unit + base + j]
        expand_state(plan, beyond(plan, unit), beyond(plan, pressed), h)
        for k in range(2 * _FRACTIONS + 1):
            tau, start = 1.0, leaps
            if k < _FRACTIONS:
                tau, start = k / _FRACTIONS, fraction + k * square
            elif k < 2 * _FRACTIONS:
                tau = (k - _FRACTIONS) / _FRACTIONS**2
                start = fine + (k - _FRACTIONS) * square
            gain_all(plan, tau, gained)
            for i in range(base - 1):
                change[i] = gained[i if i < n else (i + 1 if i < 2 * n else i + 2)]
            change[base - 1] = 0.0
            for j in range(p):
                one = int(plan[at.STOP]) + int(plan[int(plan[at.PRESSED_LIST]) + j]) * at.STOP_WIDTH
                change[base + j] = (
                    gained[int(plan[one + at.LEFT])] - gained[int(plan[one + at.RIGHT])]
                )
            for i in range(width, 8 * blocks):
                change[i] = 0.0
            for block in range(blocks):
                cell = start + (block * width + column) * 8
                for r in range(8):
                    plan[cell + r] = change[8 * block + r]
        for j in range(_JETS):
            for i in range(n):
                r = j * n + i
                value = plan[series + (j + 1) * row + n + 1 + i]
                plan[jets + (r // 8 * width + column) * 8 + r % 8] = value
        for f in range(count):
            watched_series(plan, f, mode, a)
            to_bernstein(plan, a, b)
            for r in range(16):
                plan[full + ((2 * f + r // 8) * width + column) * 8 + r % 8] = b[r]
        for c in range(2 * n + 1 + int(plan[at.DRIFTS]) if mode == 0 else 0):
            order = observed(plan, c, beyond(plan, int(plan[at.ROOM])), a)
            for j in range(order + 1, int(plan[at.ORDER]) + 1):
                a[j] = 0.0
            to_bernstein(plan, a, b)
            for r in range(16):
                seen = int(plan[at.SEEN]) + (2 * c + r // 8) * width * 8
                plan[seen + column * 8 + r % 8] = b[r]
    for level in range(1, LEVELS):
        _compose(plan, leaps + (level - 1) * square, leaps + level * square, width, unit)
    _screen(plan, place)


@kernel
def _compose(plan: Vector, source: int, target: int, width: int, buffer: int) -> None:
    """Twice a propagator, both less the identity: 2 E + E E."""
    x, out = beyond(plan, buffer), beyond(plan, buffer + (width + 7) // 8 * 8)
    for column in range(width):
        for i in range(width):
            x[i] = plan[source + (i // 8 * width + column) * 8 + i % 8]
        for block in range((width + 7) // 8):
            combine(beyond(plan, source + block * width * 8), x, width, out)
            cell = (block * width + column) * 8
            for r in range(8):
                plan[target + cell + r] = out[r] + 2.0 * plan[source + cell + r]


@kernel
def _screen(plan: Vector, place: int) -> None:
    """Write the approximations of degree 7 on the leaps, with the bounds of their errors."""
    count = int(plan[at.STOPS])
    width = int(plan[place + WIDTH])
    rules = int(plan[at.RULES])
    full, low, bound = int(plan[place + FULL]), int(plan[place + LOW]), int(plan[place + BOUND])
    leaps = int(plan[place + LEAPS])
    # The exact coefficients on each step of the longest leap: 16 for each number of x.
    exact = int(plan[at.TABLE_ROOM]) + 2 * (width + count + 8)
    steps = 1 << (LEVELS - 1)
    part = exact + steps * 16 * width
    moved = part + 16
    for f in range(count):
        for c in range(width):
            for r in range(16):
                plan[exact + 16 * c + r] = plan[full + ((2 * f + r // 8) * width + c) * 8 + r % 8]
        for q in range(1, steps):
            before = exact + (q - 1) * 16 * width
            for c in range(width):
                here = before + 16 * (width + c)
                for k in range(width):
                    plan[moved + k] = plan[leaps + (k // 8 * width + c) * 8 + k % 8]
                combine_sixteen(
                    beyond(plan, before), beyond(plan, moved), width, beyond(plan, here)
                )
                for r in range(16):
                    plan[here + r] += plan[before + 16 * c + r]
        for level in range(LEVELS):
            number, pieces = level * count + f, 1 << level
            first = rules + (pieces - 1) * _RULE
            for c in range(width):
                here = low + (number * width + c) * 8
                for i in range(8):
                    plan[here + i] = 0.0
                for q in range(pieces):
                    rule, of = first + q * _RULE, exact + (q * width + c) * 16
                    combine(beyond(plan, rule), beyond(plan, of), 16, beyond(plan, part))
                    for i in range(8):
                        plan[here + i] += plan[part + i]
                most = 0.0
                for q in range(pieces):
                    rule, of = first + q * _RULE + 128, exact + (q * width + c) * 16
                    combine_sixteen(beyond(plan, rule), beyond(plan, here), 8, beyond(plan, part))
                    for r in range(16):
                        most = max(most, abs(plan[of + r] - plan[part + r]))
                plan[bound + number * width + c] = most


@kernel
def is_clear(plan: Vector, place: int, level: int, f: int, x: Vector, buffer: Vector) -> bool:
    """Whether a watched function is proved positive on a leap."""
    width = int(plan[place + WIDTH])
    number = level * int(plan[at.STOPS]) + f
    combine(beyond(plan, int(plan[place + LOW]) + number * width * 8), x, width, buffer)
    least = min(
        min(min(buffer[0], buffer[1]), min(buffer[2], buffer[3])),
        min(min(buffer[4], buffer[5]), min(buffer[6], buffer[7])),
    )
    if not least > 0.0:
        return False
    bounds = beyond(plan, int(plan[place + BOUND]) + number * width)
    error = 0.0
    for i in range(width):
        error += bounds[i] * abs(x[i])
    is_proved: bool = least > error
    return is_proved


@kernel
def exact_rows(plan: Vector, place: int, f: int, x: Vector, b: Vector) -> None:
    """Write the Bernstein coefficients of a watched function on a step."""
    width = int(plan[place + WIDTH])
    full = int(plan[place + FULL]) + 2 * f * width * 8
    combine(beyond(plan, full), x, width, b)
    combine(beyond(plan, full + width * 8), x, width, beyond(b, 8))


@kernel
def propagate(plan: Vector, matrix: int, width: int, x: Vector, buffer: Vector) -> None:
    """X += E x."""
    blocks = (width + 7) // 8
    for k in range(blocks):
        combine(beyond(plan, matrix + k * width * 8), x, width, beyond(buffer, 8 * k))
    for i in range(width):
        x[i] += buffer[i]


@kernel
def travel_by_tables(plan: Vector, place: int, time: float, x: Vector, buffer: Vector) -> None:
    """Carry x on over any time up to the longest leap."""
    n, w = int(plan[at.MASSES]), int(plan[at.WAVES])
    width = int(plan[place + WIDTH])
    square = (width + 7) // 8 * width * 8
    h = plan[place + STEP_LENGTH]
    left = time
    for level in range(LEVELS - 1, -1, -1):
        if left >= h * (1 << level):
            propagate(plan, int(plan[place + LEAPS]) + level * square, width, x, buffer)
            left -= h * (1 << level)
    if left <= 0.0:
        return
    j = int(left / h * _FRACTIONS**2 + 0.5)
    coarse, fine = j // _FRACTIONS, j % _FRACTIONS
    if coarse == _FRACTIONS:
        propagate(plan, int(plan[place + LEAPS]), width, x, buffer)
    elif coarse > 0:
        propagate(plan, int(plan[place + FRACTION]) + coarse * square, width, x, buffer)
    if fine > 0:
        propagate(plan, int(plan[place + FINE]) + fine * square, width, x, buffer)
    t = left - h * j * (1.0 / _FRACTIONS**2)
    if t == 0.0:
        return
    for k in range((_JETS * n + 7) // 8):
        jets = int(plan[place + JETS]) + k * width * 8
        combine(beyond(plan, jets), x, width, beyond(buffer, 8 * k))
    tau = t / h
    base = 2 * n + w + 1
    gains = beyond(buffer, (_JETS * n + 7) // 8 * 8)
    for i in range(n):
        a, b, c, d = buffer[i], buffer[n + i], buffer[2 * n + i], buffer[3 * n + i]
        gains[i] = t * (x[n + i] + tau * (a / 2 + tau * (b / 3 + tau * (c / 4 + tau * (d / 5)))))
        x[i] += gains[i]
        x[n + i] += tau * (a + tau * (b + tau * (c + tau * d)))
    gains[n] = 0.0
    for p in range(int(plan[at.PRESSED])):
        f = int(plan[int(plan[at.PRESSED_LIST]) + p])
        one = int(plan[at.STOP]) + f * at.STOP_WIDTH
        x[base + p] += gains[int(plan[one + at.LEFT])] - gains[int(plan[one + at.RIGHT])]
    if plan[at.RECORD] != 0.0:
        x[2 * n] += t * x[2 * n + 1]
        return
    for q in range(w // 2):
        k = 2 * n + 2 * q
        angle = plan[at.OMEGA] * (q + 1) * t
        square_ = angle * angle
        sine = angle * (1.0 - square_ * (1 / 6 - square_ * (1 / 120)))
        less = -square_ * (0.5 - square_ * (1 / 24))
        s, c = x[k], x[k + 1]
        x[k] += s * less + c * sine
        x[k + 1] += c * less - s * sine
