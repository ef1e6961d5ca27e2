"""The accelerations of a state in a mode, and the forces of the stops."""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.mode import hold
from vibroimpact.engine.jit import Vector, inlined
from vibroimpact.engine.memory import beyond


class Places(NamedTuple):
    """Sizes and places of the plan, read once for many terms."""

    masses: int
    waves: int
    pressed: int
    resting: int
    rows: int
    stiffness: int
    damping: int
    push: int
    constant: int
    response: int
    stops: int
    pressed_list: int
    resting_list: int


@inlined
def places(plan: Vector) -> Places:
    """Read them."""
    return Places(
        int(plan[at.MASSES]),
        int(plan[at.WAVES]),
        int(plan[at.PRESSED]),
        int(plan[at.RESTING]),
        int(plan[at.ROWS]),
        int(plan[at.STIFFNESS]),
        int(plan[at.DAMPING]),
        int(plan[at.PUSH]),
        int(plan[at.CONSTANT]),
        int(plan[at.RESPONSE]),
        int(plan[at.STOP]),
        int(plan[at.PRESSED_LIST]),
        int(plan[at.RESTING_LIST]),
    )


@inlined
def take_off(plan: Vector, of: Places, held: Vector, values: Vector) -> None:
    """Take what the resting stops' forces (or impulses) do off a number for each mass."""
    for j in range(of.resting):
        f = int(plan[of.resting_list + j])
        one = of.stops + f * at.STOP_WIDTH
        for i in range(int(plan[one + at.FIRST]), int(plan[one + at.BEHIND])):
            values[i] -= plan[of.response + f * of.masses + i] * held[j]


@inlined
def drive(
    plan: Vector,
    of: Places,
    y: Vector,
    waves: Vector,
    deformation: Vector,
    constant: float,
    row: int,
) -> None:
    """Write the accelerations of a row of the series; y is u, 0, v, 0 (the ground stands still).

    `deformation`: of the pressed stops, in the order of their list, then written by their forces.
    Nothing rests.
    """
    n, w, response, stops = of.masses, of.waves, of.response, of.stops
    v = n + 1
    for i in range(n):
        a = constant * plan[of.constant + i]
        for q in range(w):
            a += plan[of.push + i * w + q] * waves[q]
        k, c = of.stiffness + i * n, of.damping + i * n
        for q in range(int(plan[of.rows + 2 * i]), int(plan[of.rows + 2 * i + 1])):
            a -= plan[k + q] * y[q] + plan[c + q] * y[v + q]
        plan[row + i] = a
    p, listed = of.pressed, of.pressed_list
    for j in range(p):
        f = int(plan[listed + j])
        one = stops + f * at.STOP_WIDTH
        left, right = int(plan[one + at.LEFT]), int(plan[one + at.RIGHT])
        closing = y[v + left] - y[v + right]
        force = plan[one + at.STOP_STIFFNESS] * deformation[j]
        force += plan[one + at.STOP_DAMPING] * closing
        deformation[j] = force
        for i in range(int(plan[one + at.FIRST]), int(plan[one + at.BEHIND])):
            plan[row + i] -= plan[response + f * n + i] * force


@inlined
def restrain(plan: Vector, of: Places, held: Vector, row: int) -> None:
    """Take what closes resting stops off the accelerations of a row; `held` are their forces."""
    r, listed = of.resting, of.resting_list
    if r == 0:
        return
    plan[row + of.masses] = 0.0
    for j in range(r):
        one = of.stops + int(plan[listed + j]) * at.STOP_WIDTH
        held[j] = plan[row + int(plan[one + at.LEFT])] - plan[row + int(plan[one + at.RIGHT])]
    hold(plan, held)
    take_off(plan, of, held, beyond(plan, row))
