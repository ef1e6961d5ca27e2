"""What happens where a watched function falls to zero."""

from __future__ import annotations

import math
from typing import Any

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.acceleration import drive, places, restrain, take_off
from vibroimpact.engine.assembly.mode import enter_mode, hold, move_alike
from vibroimpact.engine.event import CONTACT, DETACHMENT, IMPACT, REST_ENDS
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.stops.rebound import rebound

_CHATTERED = 1e-6
"""A chatter is completed where what is left of it lasts for less than this share of the times in
which the state and the force that presses the bodies may change. The bodies then rest at once: the
impulse of the rest during this time, less that which stops them, is that of the impacts, so that
what is lost is of second order, 1e-12."""

_NOISE = 1e-15
"""A closing speed below this share of the bodies' speeds is rounding."""

JUMPED = 3
"""In place of the zeros of a force that another event has put below zero, and that ends at once."""

KEPT = 6
"""Zeros by construction that fit into a state."""
LEVELS = 16
"""Of how far to leap, which stands below them; the bit of `state.SETTLING` is never set."""


@kernel
def closing(plan: Vector, f: int, values: Vector) -> float:
    """Left minus right at a stop, of a number for each mass."""
    n = int(plan[at.MASSES])
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    left, right = int(plan[one + at.LEFT]), int(plan[one + at.RIGHT])
    total = 0.0
    if left < n:
        total += values[left]
    if right < n:
        total -= values[right]
    return total


@kernel
def speeds(plan: Vector, f: int, values: Vector) -> float:
    """As `closing`, the sum of both magnitudes."""
    n = int(plan[at.MASSES])
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    left, right = int(plan[one + at.LEFT]), int(plan[one + at.RIGHT])
    total = 0.0
    if left < n:
        total += abs(values[left])
    if right < n:
        total += abs(values[right])
    return total


@kernel
def accelerations(
    plan: Vector, u: Vector, v: Vector, w: Vector, deformation: Vector, constant: float, place: int
) -> None:
    """Write the accelerations of a state in the mode that was entered at a place of the plan.

    After them follow the forces of those pressed and of those resting. The place has room for
    n + 1 accelerations; constant forces act `constant` times.
    """
    of = places(plan)
    n = of.masses
    here = beyond(plan, int(plan[at.SCRATCH]))
    for i in range(n):
        here[i], here[n + 1 + i] = u[i], v[i]
    here[n], here[2 * n + 1] = 0.0, 0.0
    forces = beyond(plan, place + n + 1)
    for p in range(of.pressed):
        forces[p] = deformation[int(plan[of.pressed_list + p])]
    drive(plan, of, here, w, forces, constant, place)
    restrain(plan, of, beyond(forces, of.pressed), place)


@kernel
def push_and_jerk(plan: Vector, f: int, y: Vector, deformation: Vector) -> tuple[float, float]:
    """Closing acceleration at a stop in the present mode, and its rate."""
    n, count, w = int(plan[at.MASSES]), int(plan[at.STOPS]), int(plan[at.WAVES])
    row = 2 * (n + 1)
    place = int(plan[at.SCRATCH]) + row
    buffer = place + n + 1 + count
    accelerations(plan, y, beyond(y, n), beyond(y, 2 * n), deformation, 1.0, place)
    push = closing(plan, f, beyond(plan, place))
    # The same map of the state's derivative.
    waves, rates, second = buffer, buffer + w, buffer + w + count
    for i in range(n):
        plan[second + i] = plan[place + i]
    for g in range(count):
        plan[rates + g] = closing(plan, g, beyond(y, n))
    if plan[at.RECORD] != 0.0:
        plan[waves], plan[waves + 1] = y[2 * n + 1], 0.0
    else:
        for q in range(w // 2):
            turn = plan[at.OMEGA] * (q + 1)
            plan[waves + 2 * q] = turn * y[2 * n + 2 * q + 1]
            plan[waves + 2 * q + 1] = -turn * y[2 * n + 2 * q]
    velocities = beyond(y, n)
    accelerations(
        plan,
        velocities,
        beyond(plan, second),
        beyond(plan, waves),
        beyond(plan, rates),
        0.0,
        place,
    )
    return push, closing(plan, f, beyond(plan, place))


@not_inlined
def settles(
    plan: Vector, f: int, returned: float, e: float, y: Vector, deformation: Vector
) -> bool:
    """Whether the impacts after a return with this speed are completed at once, by rest."""
    if e >= 1.0:
        return False
    push, jerk = push_and_jerk(plan, f, y, deformation)
    if not push > 0.0:
        return False
    lasts = 2.0 * returned / (push * (1.0 - e))
    return lasts * plan[at.RATE] <= _CHATTERED and lasts * abs(jerk) <= _CHATTERED * push


@kernel
def halt(plan: Vector, y: Vector) -> None:
    """Take the closing speeds from all resting stops, by the least change in energy."""
    n = int(plan[at.MASSES])
    r, listed = int(plan[at.RESTING]), int(plan[at.RESTING_LIST])
    impulses = beyond(plan, int(plan[at.SCRATCH]))
    for j in range(r):
        impulses[j] = closing(plan, int(plan[listed + j]), beyond(y, n))
    hold(plan, impulses)
    take_off(plan, places(plan), impulses, beyond(y, n))
    move_alike(plan, beyond(y, n))


@kernel
def zero_after_impact(plan: Vector, mode: int, g: int, order: float, jumps: bool) -> float:
    """What of a zero by construction is left where a body of this stop is hit: its speed jumps."""
    one = int(plan[at.STOP]) + g * at.STOP_WIDTH
    kind, pressed = plan[one + at.KIND], mode >> g & 1 == 1
    if kind == at.PUSHING and pressed:  # a depth stays zero, but not a rate or a force
        return 0.0 if jumps and order != 1.0 else order
    if kind == at.KELVIN_VOIGT and pressed and jumps and plan[one + at.RELAXATION] < math.inf:
        return 0.0
    return min(order, 1.0)


@kernel
def let_part(plan: Vector, mode: int, f: int) -> None:
    """Let the stops beside one whose force jumps leave what they touch with an acceleration.

    Those that share no body with it are moved by bodies that rest on each other.
    """
    stops, zeros = int(plan[at.STOP]), beyond(plan, int(plan[at.ZEROS]))
    for g in range(int(plan[at.STOPS])):
        kind = plan[stops + g * at.STOP_WIDTH + at.KIND]
        curved = kind == at.LINK or (kind == at.PUSHING and mode >> g & 1 == 1)
        if g != f and not curved:
            zeros[g] = min(zeros[g], 2.0)


def impacts(settle: Any) -> Any:
    """Make the impact on a rigid stop, with `settles` of a flow."""

    def impact(plan: Vector, mode: int, f: int, y: Vector, deformation: Vector) -> int:
        """Let a rigid stop return its bodies by its law of rebound; returns the mode."""
        n, count = int(plan[at.MASSES]), int(plan[at.STOPS])
        one = int(plan[at.STOP]) + f * at.STOP_WIDTH
        zeros = beyond(plan, int(plan[at.ZEROS]))
        coupling = beyond(plan, int(plan[at.COUPLING]) + f * count)
        v = beyond(y, n)
        speed = closing(plan, f, v)
        jumps = speed > _NOISE * speeds(plan, f, v)
        e, onward = 0.0, 0.0
        if jumps:
            e = rebound(plan, one + at.REBOUND, speed).restitution
            onward = rebound(plan, one + at.REBOUND, max(e * speed, 0.0)).onward
        decided = False
        let_part(plan, mode, f)
        for g in range(count):
            if g != f and coupling[g] != 0.0:
                rigid = plan[int(plan[at.STOP]) + g * at.STOP_WIDTH + at.KIND] == at.RIGID
                decided |= rigid and (zeros[g] > 0.0 or mode >> g & 1 == 1)
                zeros[g] = zero_after_impact(plan, mode, g, zeros[g], jumps)
        if decided:
            plan[at.ORDERED] += 1.0
        # Left without speed, and pressed before anything could part them: the force is only
        # beginning.
        pressed = zeros[f] >= 2.0
        if pressed or settle(plan, f, max(e * speed, 0.0), onward, y, deformation):
            mode |= 1 << f
            zeros[f] = 0.0
            enter_mode(plan, mode)
            halt(plan, y)
            return mode
        kick = (1.0 + e) * speed / coupling[f]
        response = beyond(plan, int(plan[at.RESPONSE]) + f * n)
        for i in range(int(plan[one + at.FIRST]), int(plan[one + at.BEHIND])):
            v[i] -= response[i] * kick
        zeros[f] = 1.0 if e * speed > 0.0 else 2.0
        # Who rested on a body that was hit is hit in turn, or left.
        for j in range(int(plan[at.RESTING])):
            g = int(plan[int(plan[at.RESTING_LIST]) + j])
            if coupling[g] != 0.0 and abs(closing(plan, g, v)) > _NOISE * speeds(plan, g, v):
                mode &= ~(1 << g)
                zeros[g] = 1.0
        return mode

    return kernel(impact)


impact = impacts(settles)


@not_inlined
def switch_mode(plan: Vector, mode: int, f: int, y: Vector, deformation: Vector) -> tuple[int, int]:
    """Go through the event of a stop whose watched function is zero; the mode and what it was."""
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    zeros = beyond(plan, int(plan[at.ZEROS]))
    rigid = plan[one + at.KIND] == at.RIGID
    dashpot = plan[one + at.RELAXATION] < math.inf
    bit = 1 << f
    if mode >> f & 1:
        # The bodies part with a jerk, or with an acceleration where the force has jumped.
        jumped = zeros[f] == JUMPED
        if jumped:
            let_part(plan, mode, f)
        zeros[f] = 2.0 if jumped else 3.0
        kind = REST_ENDS
        if not rigid:
            kind = DETACHMENT
            if not dashpot or deformation[f] < 0.0:
                deformation[f] = 0.0
            # A dashpot pulled: its body parts with a speed.
            zeros[f] = 2.0 if deformation[f] > 0.0 and not jumped else 1.0
        return mode & ~bit, kind
    if rigid:
        return impact(plan, mode, f, y, deformation), IMPACT
    # A dashpot's force begins with a jump, a spring's with zero.
    late = 1.0 if zeros[f] >= 2.0 else 0.0
    zeros[f] = late if dashpot else 1.0 + late
    if not dashpot:
        deformation[f] = 0.0
    else:
        let_part(plan, mode, f)
    return mode | bit, CONTACT


@kernel
def pack_fresh(plan: Vector) -> float:
    """The zeros by construction as one number: 4 (stop + 1) + order, at most six of them.

    Below them stands by how many levels a leap begins below the longest, so that a motion is the
    same wherever it is taken up.
    """
    zeros = beyond(plan, int(plan[at.ZEROS]))
    packed, kept = 0, 0
    for f in range(int(plan[at.STOPS])):
        if zeros[f] > 0.0 and kept < KEPT:
            packed = packed * 256 + 4 * (f + 1) + int(zeros[f])
            kept += 1
    return float(LEVELS * packed + int(plan[at.LEVEL]))


@kernel
def unpack_fresh(plan: Vector, packed: float) -> None:
    """The reverse of `pack_fresh`."""
    zeros, count = beyond(plan, int(plan[at.ZEROS])), int(plan[at.STOPS])
    for f in range(count):
        zeros[f] = 0.0
    rest = int(packed)
    plan[at.LEVEL] = float(rest % LEVELS)
    rest //= LEVELS
    while rest > 0:
        f = rest % 256 // 4 - 1
        if f < count:
            zeros[f] = float(rest % 4)
        rest //= 256
