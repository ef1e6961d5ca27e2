"""What a step from a motion is made with: the forces that act, its unit of time and its size."""

from __future__ import annotations

import math
from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import pace
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.layout import MOST
from vibroimpact.engine.motion import LEFT, RIGHT, Motion, main_stop
from vibroimpact.engine.series.kernels import drags_any_power
from vibroimpact.engine.series.layout import SLOT, UNIT
from vibroimpact.engine.series.step_control import StepClock, certified_step, number, slot_of
from vibroimpact.engine.series.values import NO_PUSH, Branch, Frame, Laws, Push
from vibroimpact.engine.state import Clock
from vibroimpact.engine.stops.curved import curved_stop, own_push
from vibroimpact.engine.taylor.laws import laws_of
from vibroimpact.engine.taylor.mode_forces import branch_of, stiffness_at


class Ahead(NamedTuple):
    """What a step is made with.

    The frame's sign and offset; the way of the velocity; the kernel that has the forces that are
    not linear; the unit of time and the time in which the motion changes (s), both in the other as
    well; for how long the forces are these at most (s); and, if above 1, by how much less than the
    motion's size a step may be off.
    """

    sign: float
    offset: float
    way: float
    slot: int
    unit: float
    per_unit: float
    natural: float
    shaken: float
    longest: float
    fine: float


NOT_YET = Ahead(1.0, 0.0, 0.0, 0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0)


@inlined
def stiffness_of(plan: Vector, stop: int, push: Push, depth: float) -> float:
    """A bound on the tangent stiffness of a stop (1/s²)."""
    if push.stiffness == 0.0:
        return 0.0
    if plan[par.stop_at(stop) + par.KIND] == par.FORMULA:
        return abs(own_push(plan, stop, depth, 0.0)[1])
    return push.stiffness * push.exponent * depth ** (push.exponent - 1.0)  # type: ignore[no-any-return]


@kernel
def branched(plan: Vector, motion: Motion) -> bool:
    """Whether the sign of the velocity, or of the displacement, matters to a law."""
    mode = motion.mode
    return bool(
        plan[par.HYSTERETIC] != 0.0
        or plan[par.DRAG] != 1.0
        or plan[par.FRICTION] != 0.0
        or plan[par.OWN + par.OWN_FLAGS] != 0.0
        or (mode & RIGHT and _branches(plan, 0))
        or (mode & LEFT and _branches(plan, 1))
    )


@inlined
def _branches(plan: Vector, stop: int) -> bool:
    kind = plan[par.stop_at(stop) + par.KIND]
    flags = plan[par.OWN + par.OWN_WIDTH * (stop + 1) + par.OWN_FLAGS]
    return bool(kind == par.JANKOWSKI or flags != 0.0)


@kernel
def varies(plan: Vector, mode: int) -> bool:
    """Whether which forces act may change within a stretch: powers begin where they matter."""
    if drags_any_power(plan):
        return True
    return bool(mode & RIGHT and curved_stop(plan, 0)) or bool(mode & LEFT and curved_stop(plan, 1))


@inlined
def ahead_of(
    plan: Vector,
    motion: Motion,
    frame: Frame,
    x: float,
    longest: float,
    branches: bool,
    anew: bool,
) -> Ahead:
    """Find the forces of this moment, and write their numbers.

    `branches` and `anew` are what `branched` and `varies` say.
    """
    most, turning = longest, math.inf
    branch = Branch(0.0, 0.0, 1.0, 1.0)
    if branches and not anew:
        branch = branch_of(plan, motion, frame.sign)
    laws = Laws(branch, NO_PUSH, NO_PUSH, 0.0, plan[par.DAMPING] if plan[par.DRAG] != 1.0 else 0.0)
    if anew:
        laws, most, turning = laws_of(plan, motion, frame, x, longest)
    unit: float = plan[UNIT]
    if turning < unit:
        # Beside a singularity the coefficients would overflow in a longer unit.
        unit = 2.0 ** math.floor(math.log2(max(turning, 1e-290)))
    number(plan, frame, laws, unit)
    stiff = frame.stiffness - plan[par.STIFFNESS]
    stiff += stiffness_of(plan, main_stop(motion.mode), laws.push, x)
    stiff += stiffness_of(plan, 1, laws.other, laws.apart - x)
    slow = frame.damping + pace(plan) + 1e-300
    u = abs(x + frame.offset)
    natural = 1.0 / (math.sqrt(stiffness_at(plan, u) + stiff) + slow)
    farther = abs(motion.v) * natural
    curved = plan[par.CUBIC] != 0.0 or plan[par.QUINTIC] != 0.0 or plan[par.OWN] != 0.0
    if farther > u and curved:
        natural = 1.0 / (math.sqrt(stiffness_at(plan, farther) + stiff) + slow)
    # A motion that nothing but a record's line moves changes while that lasts.
    natural = min(natural, 8.0 * plan[par.INTERVAL])
    fine = 0.0
    if laws.drag != 0.0 and drags_any_power(plan):
        # Where the mass turns a step is much shorter than the motion's time: the velocity must be
        # right there, too.
        fine = natural / unit
    slot = slot_of(plan, laws, motion.mode == LEFT)
    plan[SLOT] = slot
    return Ahead(
        frame.sign,
        frame.offset,
        laws.branch.way,
        slot,
        unit,
        1.0 / unit,
        natural / unit,
        plan[MOST] * natural * natural,
        most,
        fine,
    )


@inlined
def stepped_on(
    plan: Vector, clock: Clock, x: float, v: float, z: float, ahead: Ahead, longest: float
) -> tuple[float, Clock]:
    """Write the series of a step and what is at its end; return its length and the clock there.

    The state is in the mode's own coordinates, velocity and length in units of time.
    """
    size = max(max(abs(x + ahead.offset), abs(x)), max(abs(v) * ahead.natural, ahead.shaken))
    by = StepClock(ahead.sign, clock, ahead.unit, ahead.per_unit)
    most = min(longest, ahead.longest * ahead.per_unit)
    return certified_step(plan, ahead.slot, x, v, z, by, size, ahead.fine, most)
