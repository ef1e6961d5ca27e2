"""The Taylor series of the whole state in a mode, about any state."""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.acceleration import places
from vibroimpact.engine.assembly.rates import apply_rates, rates_of_mode
from vibroimpact.engine.assembly.vectors import combine_sixteen, gains, scale
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond

_ROUNDING = 1e-18


_ANGLES = tuple((_ROUNDING * math.factorial(k)) ** (1.0 / k) for k in range(1, at.TERMS))
"""Up to which angle x each order k is enough: xᵏ / k! is lost in rounding."""


@kernel
def terms(angle: float) -> int:
    """The order whose remainder is lost in rounding, on a step of ρ times this angle."""
    order = at.TERMS - 1
    while order > 2 and angle <= _ANGLES[order - 2]:
        order -= 1
    return order


def expanding(begin: Any = None, push: Any = None, grow: Any = None) -> Any:
    """Make what writes the series of a state, with what curved laws add to it, or None.

    That is `begin(plan, deformation)`, for their memories; `push(plan, of, here, j, base, forces)`,
    which writes their forces of order j (the displacements of order j + 1 are known, too); and
    `grow(plan, factor, j)`, which writes coefficient j + 1 of the memories.
    """

    def expand_masses(
        plan: Vector, y: Vector, deformation: Vector, length: float, order: int
    ) -> None:
        of = places(plan)
        rates = rates_of_mode(plan, of)
        n, w = of.masses, of.waves
        plan[at.MOVED] = y[2 * n + w]
        row, v = int(plan[at.ROW]), n + 1
        plan[at.ORDER], plan[at.PIECE_LENGTH] = float(order), length
        series, count = int(plan[at.SERIES]), int(plan[at.STOPS])
        forces, acting = int(plan[at.FORCE_SERIES]), of.pressed + of.resting
        inputs = beyond(plan, int(plan[at.INPUTS]))
        outputs = beyond(plan, int(plan[at.OUTPUTS]))
        recorded, omega = plan[at.RECORD] != 0.0, plan[at.OMEGA]
        here = beyond(plan, series)
        for i in range(n):
            here[i], here[v + i] = y[i], y[n + i]
        here[n], here[v + n] = 0.0, 0.0
        for q in range(w):
            here[2 * v + q] = y[2 * n + q]
        if begin is not None:
            begin(plan, deformation)
        inputs[0] = plan[at.MOVED]
        for p in range(of.pressed):
            inputs[1 + p] = deformation[int(plan[of.pressed_list + p])]
        for j in range(order + 1):
            here = beyond(plan, series + j * row)
            if j > 0:
                for p in range(of.pressed):
                    one = of.stops + int(plan[of.pressed_list + p]) * at.STOP_WIDTH
                    inputs[1 + p] = here[int(plan[one + at.LEFT])] - here[int(plan[one + at.RIGHT])]
            # Each of these writes beyond its end what the next one writes.
            factor, after = length / (j + 1), beyond(here, row)
            if j < order:
                scale(beyond(here, v), factor, after, v)
            if push is not None:
                push(plan, of, here, j, int(plan[at.NODES]), beyond(inputs, 1 + of.pressed))
            apply_rates(plan, rates, here, inputs, min(j, 1), outputs)
            for p in range(acting):
                plan[forces + j * count + p] = outputs[n + p]
            if j == order:
                break
            scale(outputs, factor, beyond(after, v), n)
            after[v + n] = 0.0
            if grow is not None:
                grow(plan, factor, j)
            if recorded:
                after[2 * v], after[2 * v + 1] = factor * here[2 * v + 1], 0.0
            else:
                turn = factor * omega
                for q in range(0, w, 2):
                    faster = turn * (q // 2 + 1)
                    after[2 * v + q] = faster * here[2 * v + q + 1]
                    after[2 * v + q + 1] = -faster * here[2 * v + q]

    expand_masses.__doc__ = """Write the series of u, v, w and of all forces in t / length.

    y is u, v, w, 1; for a disturbance, its w and its last number are 0.
    """
    return not_inlined(expand_masses)


_expand = expanding()


@kernel
def expand_state(plan: Vector, y: Vector, deformation: Vector, length: float) -> None:
    """Write the series of a state with linear laws, of an order that suffices."""
    _expand(plan, y, deformation, length, terms(plan[at.RATE] * length))


@kernel
def expand_start(plan: Vector, y: Vector, deformation: Vector, length: float) -> None:
    """Write as many of their terms as the state's first derivative needs."""
    _expand(plan, y, deformation, length, 1)


@kernel
def gain_all(plan: Vector, tau: float, out: Vector) -> None:
    """Write what all series have gained at tau, in the order of their rows."""
    row, series, order = int(plan[at.ROW]), int(plan[at.SERIES]), int(plan[at.ORDER])
    for i in range(0, row, 8):
        gains(beyond(plan, series + i), row, order, tau, beyond(out, i))


@not_inlined
def travel_by_series(plan: Vector, y: Vector, deformation: Vector, tau: float) -> None:
    """Carry the state, of which the series was made, on in place; free deformations stay."""
    n, w = int(plan[at.MASSES]), int(plan[at.WAVES])
    gained = beyond(plan, int(plan[at.OUTPUTS]))
    gain_all(plan, tau, gained)
    for i in range(n):
        y[i] += gained[i]
        y[n + i] += gained[n + 1 + i]
    for q in range(w):
        y[2 * n + q] += gained[2 * (n + 1) + q]
    stops, listed = int(plan[at.STOP]), int(plan[at.PRESSED_LIST])
    for p in range(int(plan[at.PRESSED])):
        f = int(plan[listed + p])
        one = stops + f * at.STOP_WIDTH
        deformation[f] += gained[int(plan[one + at.LEFT])] - gained[int(plan[one + at.RIGHT])]


@kernel
def watched_series(plan: Vector, f: int, mode: int, a: Vector) -> None:
    """Write the coefficients of what is watched at a stop: clearance without memory, or force."""
    count, order = int(plan[at.STOPS]), int(plan[at.ORDER])
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    if mode >> f & 1:
        place = 0
        rigid = plan[one + at.KIND] == at.RIGID
        listed = int(plan[at.RESTING_LIST]) if rigid else int(plan[at.PRESSED_LIST])
        while int(plan[listed + place]) != f:
            place += 1
        if rigid:
            place += int(plan[at.PRESSED])
        forces = beyond(plan, int(plan[at.FORCE_SERIES]) + place)
        for j in range(order + 1):
            a[j] = forces[j * count]
        return
    row = int(plan[at.ROW])
    right = beyond(plan, int(plan[at.SERIES]) + int(plan[one + at.RIGHT]))
    left = beyond(plan, int(plan[at.SERIES]) + int(plan[one + at.LEFT]))
    for j in range(order + 1):
        a[j] = right[j * row] - left[j * row]
    a[0] += plan[one + at.GAP] * plan[at.MOVED]


@kernel
def to_bernstein(plan: Vector, a: Vector, b: Vector) -> None:
    """Make Bernstein coefficients of those of a power series."""
    combine_sixteen(beyond(plan, int(plan[at.ECONOMY])), a, int(plan[at.ORDER]) + 1, b)
