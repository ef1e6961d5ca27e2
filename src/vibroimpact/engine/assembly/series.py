"""The Taylor series of the whole state in a mode, about any state."""

from __future__ import annotations

from typing import Any, NamedTuple

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.mode import hold, move_alike
from vibroimpact.engine.assembly.vectors import combine
from vibroimpact.engine.jit import Vector, apart, inlined, kernel
from vibroimpact.engine.memory import beyond

_ROUNDING = 1e-18


@kernel
def terms(angle: float) -> int:
    """The order whose remainder is lost in rounding, on a step of ρ times this angle."""
    term, order = 1.0, 0
    while order < at.TERMS - 1 and (term > _ROUNDING or order < 2):
        order += 1
        term *= angle / order
    return order


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


@inlined
def accelerate(
    plan: Vector,
    of: Places,
    y: Vector,
    waves: Vector,
    deformation: Vector,
    constant: float,
    row: int,
) -> None:
    """As `drive`; then the resting stops' forces follow those of the pressed ones."""
    drive(plan, of, y, waves, deformation, constant, row)
    restrain(plan, of, beyond(deformation, of.pressed), row)


def expanding(begin: Any = None, push: Any = None, grow: Any = None) -> Any:
    """Make what writes the series of a state, with what curved laws add to it, or None.

    That is `begin(plan, deformation)`, for their memories; `push(plan, of, here, j, after)`, which
    takes what they do off the accelerations of order j; and `grow(plan, factor, j)`, which writes
    coefficient j + 1 of the memories.
    """

    def expand_masses(
        plan: Vector, y: Vector, deformation: Vector, length: float, order: int
    ) -> None:
        of = places(plan)
        n, w = of.masses, of.waves
        plan[at.MOVED] = y[2 * n + w]
        row, v = 2 * (n + 1), n + 1
        plan[at.ORDER], plan[at.PIECE_LENGTH] = float(order), length
        series, waves = int(plan[at.SERIES]), int(plan[at.WAVE_SERIES])
        forces, count = int(plan[at.FORCE_SERIES]), int(plan[at.STOPS])
        for i in range(n):
            plan[series + i], plan[series + v + i] = y[i], y[n + i]
        plan[series + n], plan[series + v + n] = 0.0, 0.0
        for q in range(w):
            plan[waves + q] = y[2 * n + q]
        if begin is not None:
            begin(plan, deformation)
        for j in range(order + 1):
            a, now = series + j * row, waves + j * w
            # Beyond the order a row is used as room; it is never read.
            after = int(plan[at.SCRATCH]) if j == order else a + row + v
            here, held = beyond(plan, a), beyond(plan, forces + j * count)
            for p in range(of.pressed):
                f = int(plan[of.pressed_list + p])
                if j == 0:
                    held[p] = deformation[f]
                else:
                    one = of.stops + f * at.STOP_WIDTH
                    held[p] = here[int(plan[one + at.LEFT])] - here[int(plan[one + at.RIGHT])]
            constant = plan[at.MOVED] if j == 0 else 0.0
            drive(plan, of, here, beyond(plan, now), held, constant, after)
            if push is not None:
                push(plan, of, here, j, after)
            restrain(plan, of, beyond(held, of.pressed), after)
            move_alike(plan, beyond(plan, after))
            if j == order:
                break
            factor = length / (j + 1)
            for i in range(n):
                plan[a + row + i] = factor * here[v + i]
                plan[after + i] *= factor
            plan[a + row + n], plan[after + n] = 0.0, 0.0
            if grow is not None:
                grow(plan, factor, j)
            if plan[at.RECORD] != 0.0:
                plan[now + w] = factor * plan[now + 1]
                plan[now + w + 1] = 0.0
            else:
                for q in range(w // 2):
                    turn = factor * plan[at.OMEGA] * (q + 1)
                    plan[now + w + 2 * q] = turn * plan[now + 2 * q + 1]
                    plan[now + w + 2 * q + 1] = -turn * plan[now + 2 * q]

    expand_masses.__doc__ = """Write the series of u, v, w and of all forces in t / length.

    y is u, v, w, 1; for a disturbance, its w and its last number are 0.
    """
    return apart(expand_masses)


_expand = expanding()


@kernel
def expand_state(plan: Vector, y: Vector, deformation: Vector, length: float) -> None:
    """Write the series of a state with linear laws, of an order that suffices."""
    _expand(plan, y, deformation, length, terms(plan[at.RATE] * length))


@kernel
def gain(plan: Vector, block: int, row: int, i: int, tau: float) -> float:
    """What a coefficient's series has gained at tau, its first term left out."""
    total = 0.0
    for j in range(int(plan[at.ORDER]), 0, -1):
        total = (total + plan[block + j * row + i]) * tau
    return total


@apart
def travel_by_series(plan: Vector, y: Vector, deformation: Vector, tau: float) -> None:
    """Carry the state, of which the series was made, on in place; free deformations stay."""
    n, w = int(plan[at.MASSES]), int(plan[at.WAVES])
    row = 2 * (n + 1)
    series, waves = int(plan[at.SERIES]), int(plan[at.WAVE_SERIES])
    gains = beyond(plan, int(plan[at.SCRATCH]))
    order = int(plan[at.ORDER])
    for i in range(row):
        gains[i] = 0.0
    for j in range(order, 0, -1):
        here = beyond(plan, series + j * row)
        for i in range(row):
            gains[i] = (gains[i] + here[i]) * tau
    for i in range(n):
        y[i] += gains[i]
        y[n + i] += gains[n + 1 + i]
    for q in range(w):
        y[2 * n + q] += gain(plan, waves, w, q, tau)
    stops, listed = int(plan[at.STOP]), int(plan[at.PRESSED_LIST])
    for p in range(int(plan[at.PRESSED])):
        f = int(plan[listed + p])
        one = stops + f * at.STOP_WIDTH
        deformation[f] += gains[int(plan[one + at.LEFT])] - gains[int(plan[one + at.RIGHT])]


@kernel
def watched_series(plan: Vector, f: int, mode: int, a: Vector) -> None:
    """Write the coefficients of what is watched at a stop: clearance without memory, or force."""
    n, count, order = int(plan[at.MASSES]), int(plan[at.STOPS]), int(plan[at.ORDER])
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
    row = 2 * (n + 1)
    right = beyond(plan, int(plan[at.SERIES]) + int(plan[one + at.RIGHT]))
    left = beyond(plan, int(plan[at.SERIES]) + int(plan[one + at.LEFT]))
    for j in range(order + 1):
        a[j] = right[j * row] - left[j * row]
    a[0] += plan[one + at.GAP] * plan[at.MOVED]


@kernel
def to_bernstein(plan: Vector, a: Vector, b: Vector) -> None:
    """Make Bernstein coefficients of those of a power series."""
    economy, count = int(plan[at.ECONOMY]), int(plan[at.ORDER]) + 1
    combine(beyond(plan, economy), 16, a, count, b)
    combine(beyond(plan, economy + 8), 16, a, count, beyond(b, 8))
