"""States of assemblies with curved laws at a section; see `assembly.section`."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly import section as linear
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved.branches import (
    side_of,
    way_of_slide,
    with_side,
    with_way,
)
from vibroimpact.engine.assembly.curved.terms import remembers, row_of
from vibroimpact.engine.assembly.events import closing
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.state import FIRST, FRESH, MODE, copy

_LIMIT = of.NUMBERS + par.YIELD
_FORGOTTEN = 9.0


@kernel
def units(plan: Vector, units: Vector) -> None:
    """Write what makes a velocity of each part: a stop that pushes keeps a velocity itself."""
    linear.units(plan, units)
    n = int(plan[at.MASSES])
    for f in range(int(plan[at.STOPS])):
        kind = plan[int(plan[at.STOP]) + f * at.STOP_WIDTH + at.KIND]
        if kind == at.PUSHING and not remembers(plan, row_of(plan, f)):
            units[2 * n + f] = 1.0


@kernel
def place(plan: Vector, state: Vector) -> None:
    """Make of a state the nearest that can be; its links' branches are found when it goes on."""
    n, count, mode = int(plan[at.MASSES]), int(plan[at.STOPS]), int(state[MODE])
    u, deformation = beyond(state, FIRST), beyond(state, FIRST + 2 * n)
    touched = 0
    for f in range(count):
        one = int(plan[at.STOP]) + f * at.STOP_WIDTH
        kind = plan[one + at.KIND]
        if kind == at.PUSHING:
            reach, remembered = closing(plan, f, u) - plan[one + at.GAP], deformation[f]
            is_kept = remembers(plan, row_of(plan, f))
            if is_kept:
                reach -= remembered
            if reach > 0.0 or (mode >> f & 1 and reach >= 0.0):
                touched |= 1 << f
            else:
                deformation[f] = 0.0
            deformation[f] = remembered if is_kept else max(deformation[f], 0.0)
            if touched >> f & 1 and plan[row_of(plan, f) + of.TIED] != 0.0:
                deformation[f] += reach
        elif kind == at.LINK:
            row = row_of(plan, f)
            if not remembers(plan, row):
                deformation[f] = 0.0
            elif int(plan[row + of.BEHAVIOUR]) == of.BILINEAR:
                limit = plan[row + _LIMIT]
                deformation[f] = min(max(deformation[f], -limit), limit)
    kept = int(plan[at.SCRATCH])
    for f in range(count):
        plan[kept + f] = deformation[f]
    linear.place(plan, state)
    new_mode = int(state[MODE])
    for f in range(count):
        if plan[int(plan[at.STOP]) + f * at.STOP_WIDTH + at.KIND] >= at.PUSHING:
            new_mode &= ~(1 << f)
            deformation[f] = plan[kept + f]
    state[MODE], state[FRESH] = float(new_mode | touched), of.NEW


@kernel
def disturb(plan: Vector, state: Vector, part: int, by: float, period: float) -> float:
    """Change a part by so much; return by how much it has changed. See `flow.disturb`."""
    n, mode = int(plan[at.MASSES]), int(state[MODE])
    if part >= 2 * n:
        f = part - 2 * n
        one = int(plan[at.STOP]) + f * at.STOP_WIDTH
        kind, row = plan[one + at.KIND], row_of(plan, f)
        if kind == at.LINK:
            if not remembers(plan, row):
                return 0.0
        elif kind == at.PUSHING and not remembers(plan, row):
            if not mode >> f & 1 or not plan[row + of.NUMBERS + par.BUMPER + par.DISSIPATION] < 0.0:
                return 0.0
        elif kind != at.PUSHING and (
            mode >> f & 1 or kind == at.RIGID or not plan[one + at.RELAXATION] * period < _FORGOTTEN
        ):
            return 0.0
    before: float = state[FIRST + part]
    state[FIRST + part] = before + by
    place(plan, state)
    changed: float = state[FIRST + part] - before
    return changed


@kernel
def at_point(plan: Vector, state: Vector, point: Vector) -> None:
    """See `flow.at_point`."""
    copy(point, beyond(state, FIRST), linear.parts(plan))
    place(plan, state)


@kernel
def mirror(plan: Vector, state: Vector, q: Vector) -> None:
    """See `flow.mirror`: memories change their sign, links' branches both."""
    width, n, count = linear.parts(plan), int(plan[at.MASSES]), int(plan[at.STOPS])
    mode = int(state[MODE])
    linear.mirror(plan, state, q)
    for f in range(count):
        if plan[int(plan[at.STOP]) + f * at.STOP_WIDTH + at.KIND] != at.LINK:
            continue
        state[FIRST + 2 * n + f] = -state[FIRST + 2 * n + f]
        for i in range(width):
            q[i * width + 2 * n + f] = -q[i * width + 2 * n + f]
    new_mode = int(state[MODE])
    for f in range(count):
        row = row_of(plan, f)
        if plan[row + of.BRANCH] < 0.0:
            continue
        new_mode = with_way(plan, f, new_mode, -way_of_slide(plan, f, mode))
        side = side_of(plan, f, mode)
        if int(plan[row + of.BEHAVIOUR]) != of.BILINEAR:
            side = -side
        new_mode = with_side(plan, f, new_mode, side)
    state[MODE] = float(new_mode)


@kernel
def complete(plan: Vector) -> None:
    """See `flow.complete`: the rates that curved links have at rest are added."""
    n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
    sums = int(plan[at.ROW_SUMS])
    for f in range(count):
        row, one = row_of(plan, f), int(plan[at.STOP]) + f * at.STOP_WIDTH
        if remembers(plan, row):
            plan[one + at.RELAXATION] = 0.0  # its memory has a series
        if plan[one + at.KIND] == at.LINK:
            plan[one + at.RELAXATION] = 0.0
            law = row + of.NUMBERS
            stiff = plan[law + par.HYSTERETIC] * plan[law + par.SLOPE]
            stiff += 2.0 * plan[law + par.SINH] * plan[law + par.SINH_RATE]
            stiff += plan[law + par.OWN + par.OWN_STIFFNESS]
            ends = (plan[one + at.LEFT] < n) + (plan[one + at.RIGHT] < n)
            for i in range(n):
                response = plan[int(plan[at.RESPONSE]) + f * n + i]
                plan[sums + i] += ends * abs(response) * stiff
