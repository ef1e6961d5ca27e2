"""From node to node of a table until a leg ends.

While the mass moves one way its displacement is monotone: a stop or a yield lies between two nodes
if and only if it lies between the displacements there. Only the velocity, which must not vanish
between, and the force of a bumper that may part need a bound on what they bend over an interval
(docs/theory.md, section 16).
"""

from __future__ import annotations

import math

from vibroimpact.engine.event import CONTACT, DETACHMENT, LIMIT, TURN, YIELD, event_of
from vibroimpact.engine.forcing.dispatch import product
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.crossing import crossing_guess, quick_root
from vibroimpact.engine.linear.evaluate import node, scaled_acceleration, travel
from vibroimpact.engine.linear.flight import parted
from vibroimpact.engine.linear.layout import NODE, NODES, RATE, ROW_V, WIDTH, H, Row
from vibroimpact.engine.linear.roots import NONE
from vibroimpact.engine.linear.table_search import ended, next_window
from vibroimpact.engine.stops.kelvin_voigt import relaxed
from vibroimpact.engine.yielding.certified_search import careful
from vibroimpact.engine.yielding.layout import BEND_0, PUSH_0, PUSH_E, ROOT, TURN_0, TURN_E
from vibroimpact.engine.yielding.monotone_motion import (
    AHEAD,
    BEGUN,
    FROM_BEHIND,
    PLAIN,
    MotionLimits,
)


@kernel
def follow_leg(
    plan: Vector, table: int, leg: MotionLimits, row: Row, start: int, limit: float
) -> tuple[int, float, Row]:
    """Follow a leg to its end or for the time `limit`.

    Returns
    -------
    end, t, row
        What ended it (see `monotone_motion`), the elapsed time (s), and the state there.
    """
    way, stop, yields, memory, rate, behind, behind_memory, behind_rate, push_x, push_v, push_0 = (
        leg
    )
    h, per_second = plan[table + H], plan[table + RATE]
    top = min(stop, yields)
    t = 0.0
    while True:
        x, v, _, _ = row
        xs, vs = way * x, way * v
        if xs >= stop and v != 0.0 and xs >= stop + relaxed(memory, rate, t):
            return event_of(CONTACT, AHEAD), t, row
        if xs >= yields and yields != stop:
            return YIELD, t, row
        gain = scaled_acceleration(plan, table, row)
        size = plan[table + ROOT] * abs(v) + abs(gain) * (per_second * per_second)
        bend = plan[table + TURN_E] * size + plan[table + TURN_0]  # of the velocity, per step²
        floor = 0.125 * bend
        force, least, bend_force = 1.0, 0.0, 0.0
        pressed = push_x != 0.0
        if pressed:
            force = push_x * xs + push_v * vs + push_0
            bend_force = plan[table + PUSH_E] * size + plan[table + PUSH_0]
            least = 0.125 * bend_force
        # From rest on, v ≥ x″ t − bend t²/2.
        clear = 2.0 * way * gain * per_second / bend
        bottom, clear_behind = -math.inf, 0.0
        if behind_memory > 0.0 and xs < behind:
            bottom = behind
            if start & FROM_BEHIND:
                second = (size + plan[table + BEND_0]) * (h * h)
                clear_behind = parted(behind_memory, behind_rate * h, 0.0, second)
        span = (limit - t) * per_second
        earlier_x = before_x = xs
        earlier_v = before_v = vs
        earlier_force = before_force = force
        j = 0
        done = 0  # examined up to this node
        while True:
            flagged = (
                xs >= top
                or (vs <= floor and j + 1.0 > clear)
                or force <= least
                or (xs < bottom and j + 1.0 > clear_behind)
            )
            if not flagged or done == j:
                # The next node; next to one that is flagged an end cannot be excluded.
                if j >= span or j == NODES:
                    break
                at = table + NODE + j * WIDTH
                earlier_x, before_x, xs = before_x, xs, way * product(plan, at, row)
                earlier_v, before_v, vs = before_v, vs, way * product(plan, at + ROW_V, row)
                if pressed:
                    earlier_force, before_force = before_force, force
                    force = push_x * xs + push_v * vs + push_0
                j += 1
                if not flagged:
                    done = j - 1
                    continue
            i = j - 1
            done = j
            near = node(plan, table, i, row)
            event, y, end = LIMIT, NONE, near
            cleared = False
            if before_x >= bottom or j <= clear_behind:
                # The usual case: one end, clean.
                moves = (vs > floor and before_v > floor) or j <= clear
                presses = force > least and before_force > least
                inside = xs < top
                weight_x, weight_v, level, most = way, 0.0, top, 0.0
                earlier, before, now = earlier_x, before_x, xs
                if moves and presses and before_x < top:
                    cleared = inside
                    if yields < stop:
                        event = YIELD
                    elif stop + relaxed(memory, rate, t + i * h) == stop:
                        event = event_of(CONTACT, AHEAD)
                elif presses and vs < 0.0 and before_v > 0.0:
                    event, weight_x, weight_v, level, most = (
                        TURN,
                        0.0,
                        -way * per_second,
                        0.0,
                        bend,
                    )
                    earlier, before, now = -earlier_v, -before_v, -vs
                elif inside and moves and force < 0.0 and before_force > 0.0:
                    event, level, most = DETACHMENT, push_0, bend_force
                    weight_x, weight_v = -way * push_x, -way * push_v * per_second
                    earlier = push_0 - earlier_force
                    before, now = push_0 - before_force, push_0 - force
                elif inside and vs > 0.0 and force > 0.0:
                    # Still falling at the node, it has been no lower before.
                    slope = way * scaled_acceleration(plan, table, node(plan, table, j, row))
                    cleared = moves or -2.0 * slope * per_second >= bend
                    if cleared and not presses:
                        slope = push_x * (vs * h) + push_v * slope * per_second
                        cleared = -2.0 * slope >= bend_force
                if event != LIMIT and not cleared:
                    guess = crossing_guess(earlier, before, now, level, j)
                    y, steep, end = quick_root(plan, table, weight_x, weight_v, level, guess, near)
                    if not 2.0 * steep > most * y:
                        y = NONE
                    if event == TURN and way * end.x >= top:
                        y = NONE
                    elif y != NONE and i + y > span:
                        break
            if y == NONE and not cleared:
                left = relaxed(memory, rate, t + i * h)
                left_behind = relaxed(behind_memory, behind_rate, t + i * h)
                low, high = 0.0, min(1.0, span - i)
                event = LIMIT
                if i == 0 and start & BEGUN:
                    low = min(0.5, high)
                    event, y = careful(plan, table, leg, near, start, left, left_behind, 0.0, low)
                    left = relaxed(left, rate, low * h)
                    left_behind = relaxed(left_behind, behind_rate, low * h)
                if event == LIMIT and low < high:
                    event, y = careful(plan, table, leg, near, PLAIN, left, left_behind, low, high)
                if event != LIMIT:
                    end = travel(plan, table, y, near)
            if y != NONE:
                return event, t + (i + y) * h, end
        if span <= NODES:
            return LIMIT, limit, ended(plan, table, row, span)
        row = next_window(plan, table, row)
        start = PLAIN
        t += NODES * h
