"""The loop flight → contact → flight, one segment at a time.

A state is (mode, fresh, u, v, right, left): the mode of `phase`; in flight the side that has
just been left (0 if none), in contact whether it begins here; displacement and velocity; and
the deformation of each bumper away from the mass (≥ 0). In contact the pressed bumper's
deformation is the primary quantity, u follows from it.
"""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.contact import contact
from vibroimpact.engine.evaluate import relaxed
from vibroimpact.engine.flight import flight
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.phase import DETACHED, FLIGHT, LIMIT, RIGHT, SIZE, TABLES, VALID_FROM, H

WORK_LIMIT = 3e7
"""Table steps that one forcing cycle may take, about a second of computing."""


@kernel
def advance(
    plan: Vector,
    mode: int,
    fresh: int,
    u: float,
    v: float,
    s: float,
    c: float,
    right: float,
    left: float,
    limit: float,
    age: float,
) -> tuple[int, float, int, int, float, float, float, float, float, float, float]:
    """Go on to the next contact or detachment, or for the time `limit` if that comes first.

    Returns
    -------
    event, t, mode, fresh, u, v, s, c, right, left, age
        What ended the segment (see `phase`), its length (s), and the state behind it.
    """
    if mode == FLIGHT:
        event, t, u, v, s, c, right, left = flight(plan, u, v, s, c, right, left, fresh, limit, age)
        if event == LIMIT:
            return event, t, mode, 0, u, v, s, c, right, left, age + t
        return event, t, event, 1, u, v, s, c, right, left, 0.0
    at = par.BUMPER + par.WIDTH * (mode - 1)
    gap = plan[at + par.GAP]
    # A left contact is the mirror image of a right one.
    sign = 1.0 if mode == RIGHT else -1.0
    event, t, x, v, s, c = contact(
        plan,
        mode,
        right if mode == RIGHT else left,
        sign * v,
        sign * s,
        sign * c,
        fresh == 1,
        limit,
        age,
    )
    if mode == RIGHT:
        right = x
        left = relaxed(left, plan[par.BUMPER + par.WIDTH + par.RATE], t)
    else:
        left = x
        right = relaxed(right, plan[par.BUMPER + par.RATE], t)
    u, v, s, c = sign * (gap + x), sign * v, sign * s, sign * c
    if event == DETACHED:
        return event, t, FLIGHT, mode, u, v, s, c, right, left, 0.0
    return event, t, mode, 0, u, v, s, c, right, left, age + t


@kernel
def cycle(
    plan: Vector,
    mode: int,
    fresh: int,
    u: float,
    v: float,
    right: float,
    left: float,
    age: float,
    s: float,
    c: float,
    period: float,
    max_events: int,
) -> tuple[int, int, int, float, float, float, float, float, int, int]:
    """One forcing cycle, from one stroboscopic section to the next.

    The phase at the section is (s, c) exactly, each time: angles do not accumulate.

    Returns
    -------
    events, mode, fresh, u, v, right, left, age, hits_right, hits_left
        `events` is the number of contacts and detachments, or more than `max_events` if the
        cycle was not finished.
    """
    t = 0.0
    events = 0
    hits_r = 0
    hits_l = 0
    while True:
        event, step, mode, fresh, u, v, s, c, right, left, age = advance(
            plan, mode, fresh, u, v, s, c, right, left, period - t, age
        )
        if event == LIMIT:
            break
        t += step
        events += 1
        if event != DETACHED:
            if event == RIGHT:
                hits_r += 1
            else:
                hits_l += 1
        if events > max_events:
            break
        if t >= period:
            break
    return events, mode, fresh, u, v, right, left, age, hits_r, hits_l


@kernel
def too_much_work(plan: Vector, period: float) -> bool:
    """Whether one cycle could take more than WORK_LIMIT table steps."""
    for mode in range(3):
        early = TABLES + SIZE * mode
        late = early + 3 * SIZE
        if plan[early + H] > 0.0:
            steps = min(period, plan[late + VALID_FROM]) / plan[early + H]
            if plan[late + VALID_FROM] < period:
                steps += period / plan[late + H]
            if not steps < WORK_LIMIT:
                return True
    return False
