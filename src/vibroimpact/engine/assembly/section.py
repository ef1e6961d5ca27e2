"""States at a section: what they are made of, disturbed and put in order (see `engine.flow`)."""

from __future__ import annotations

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.events import closing, pack_fresh, unpack_fresh
from vibroimpact.engine.assembly.mode import enter_mode
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.state import FIRST, FRESH, MODE, copy

_FORGOTTEN = 9.0
"""What relaxes by more powers of e in a cycle is another's memory no more."""
_WORK_LIMIT = 1e7
"""Steps that one cycle may take."""


@kernel
def too_much_work(plan: Vector, period: float) -> int:
    """Whether one cycle may take too long: by the rate with all bumpers pressed."""
    mode = 0
    for f in range(int(plan[at.STOPS])):
        if plan[int(plan[at.STOP]) + f * at.STOP_WIDTH + at.KIND] == at.KELVIN_VOIGT:
            mode |= 1 << f
    enter_mode(plan, mode)
    return 1 if not plan[at.RATE] * period < at.STEP * _WORK_LIMIT else 0


@kernel
def stiff_rate(plan: Vector) -> float:
    """What makes a velocity of a displacement (1/s): the rate in flight."""
    rate: float = plan[at.STIFF_RATE]
    return rate


@kernel
def parts(plan: Vector) -> int:
    """u, v and a deformation of each stop."""
    return 2 * int(plan[at.MASSES]) + int(plan[at.STOPS])


@kernel
def units(plan: Vector, units: Vector) -> None:
    """Write what makes a velocity of each part."""
    n, rate = int(plan[at.MASSES]), stiff_rate(plan)
    for i in range(parts(plan)):
        units[i] = 1.0 if n <= i < 2 * n else rate


@kernel
def size(plan: Vector, state: Vector) -> float:
    """The size of a motion, as a velocity (m/s)."""
    n, rate, most = int(plan[at.MASSES]), stiff_rate(plan), 0.0
    for i in range(n):
        most = max(most, rate * abs(state[FIRST + i]), abs(state[FIRST + n + i]))
    return most


@kernel
def place(plan: Vector, state: Vector) -> None:
    """Make of a state the nearest that can be, and its mode of its parts.

    A rigid stop that is passed moves its bodies apart, in the ratio of their inertias; rest stays
    where the bodies touch without closing speed.
    """
    n, count, mode = int(plan[at.MASSES]), int(plan[at.STOPS]), int(state[MODE])
    u, v = beyond(state, FIRST), beyond(state, FIRST + n)
    deformation = beyond(state, FIRST + 2 * n)
    new_mode = 0
    for f in range(count):
        one = int(plan[at.STOP]) + f * at.STOP_WIDTH
        reach = closing(plan, f, u) - plan[one + at.GAP]
        d = max(deformation[f], 0.0)
        if plan[one + at.KIND] == at.RIGID:
            d = 0.0
            if reach > 0.0:
                push = reach / plan[int(plan[at.COUPLING]) + f * count + f]
                for i in range(int(plan[one + at.FIRST]), int(plan[one + at.BEHIND])):
                    u[i] -= plan[int(plan[at.RESPONSE]) + f * n + i] * push
            if mode >> f & 1 and reach >= 0.0 and closing(plan, f, v) == 0.0:
                new_mode |= 1 << f
        else:
            dashpot = plan[one + at.STOP_DAMPING]
            if mode >> f & 1 or reach > d:
                force = plan[one + at.STOP_STIFFNESS] * reach + dashpot * closing(plan, f, v)
                d = max(reach, 0.0)
                if reach >= 0.0 and force >= 0.0:
                    new_mode |= 1 << f
            if dashpot == 0.0 and not new_mode >> f & 1:
                d = 0.0
        deformation[f] = d
    state[MODE], state[FRESH] = float(new_mode), 0.0
    state[FIRST + 2 * n + count] = 0.0


@kernel
def disturb(plan: Vector, state: Vector, part: int, by: float, period: float) -> float:
    """Change a part by so much; return by how much it has changed.

    0 where the part does not outlive a period by itself.
    """
    n, mode = int(plan[at.MASSES]), int(state[MODE])
    if part >= 2 * n:
        f = part - 2 * n
        one = int(plan[at.STOP]) + f * at.STOP_WIDTH
        if mode >> f & 1 or plan[one + at.KIND] == at.RIGID:
            return 0.0
        if not plan[one + at.RELAXATION] * period < _FORGOTTEN:
            return 0.0
    before: float = state[FIRST + part]
    state[FIRST + part] = before + by
    place(plan, state)
    changed: float = state[FIRST + part] - before
    return changed


@kernel
def point(plan: Vector, state: Vector, point: Vector) -> None:
    """See `flow.point`; deformations are those away from the bodies."""
    copy(beyond(state, FIRST), point, parts(plan))


@kernel
def at_point(plan: Vector, state: Vector, point: Vector) -> None:
    """See `flow.at_point`."""
    copy(point, beyond(state, FIRST), parts(plan))
    place(plan, state)


@kernel
def _partner(plan: Vector, f: int) -> int:
    return int(plan[int(plan[at.STOP]) + f * at.STOP_WIDTH + at.PARTNER])


@kernel
def _mirror_parts(plan: Vector, values: Vector) -> None:
    """Turn displacements, velocities and deformations into their mirror image."""
    n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
    for i in range(2 * n):
        values[i] = -values[i]
    deformation = beyond(values, 2 * n)
    for f in range(count):
        other = _partner(plan, f)
        if f < other:
            deformation[f], deformation[other] = deformation[other], deformation[f]


@kernel
def mirror(plan: Vector, state: Vector, q: Vector) -> None:
    """See `flow.mirror`; each stop has a partner."""
    width, count = parts(plan), int(plan[at.STOPS])
    _mirror_parts(plan, beyond(state, FIRST))
    for i in range(width):
        _mirror_parts(plan, beyond(q, i * width))
    unpack_fresh(plan, state[FRESH])
    zeros = beyond(plan, int(plan[at.ZEROS]))
    mode, new_mode = int(state[MODE]), 0
    for f in range(count):
        other = _partner(plan, f)
        if mode >> f & 1:
            new_mode |= 1 << other
        if f < other:
            zeros[f], zeros[other] = zeros[other], zeros[f]
    state[MODE], state[FRESH] = float(new_mode), pack_fresh(plan)
