"""A stop that follows a power of its deformation, or a formula; it pushes only.

It remembers nothing but how fast it was met, which stands where a bumper has its deformation.
"""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.jit import Vector, inlined, kernel, not_inlined
from vibroimpact.engine.linear.layout import MOST
from vibroimpact.engine.motion import Motion, facing
from vibroimpact.engine.series.kernels import STRIDE, Slot, run
from vibroimpact.engine.series.layout import OWN_FORCE
from vibroimpact.engine.series.values import NO_PUSH, Push
from vibroimpact.engine.taylor.plan import motion_rate

_OWN = int(Slot.OWN)

_UNMET = 1e-12
"""Share of the rig's typical speed. A stop that is met no faster, or is pressed from the start, has
not been met: there is no impact from which it could take energy."""

NO_TRACE = 2.0**-60
"""A share of the motion's energy or force that leaves no trace in it."""

_LEFT_OUT = 16.0
"""How many times its bound a force may grow while it is left out."""

EVEN = 1e-14
"""1 + χ δ′ where a stop begins or ceases to push: its own rounding."""


@kernel
def curved_stop(plan: Vector, stop: int) -> bool:
    """Whether a stop follows a power of its deformation, or a formula."""
    kind = plan[par.stop_at(stop) + par.KIND]
    return bool(kind in par.CURVED_STOPS)


@kernel
def depth_of(plan: Vector, motion: Motion, stop: int) -> float:
    """How far it is deformed (m): to where the mass is."""
    if not motion.mode >> stop & 1:
        return 0.0
    gap = plan[par.stop_at(stop) + par.GAP]
    return max(facing(stop) * motion.u - gap, 0.0)  # type: ignore[no-any-return]


@kernel
def nearest_possible(
    plan: Vector, stop: int, mode: int, u: float, memory: float
) -> tuple[float, bool]:
    """How fast it was met, of a mass that presses it, and whether one does."""
    reach = facing(stop) * u - plan[par.stop_at(stop) + par.GAP]
    if reach > 0.0 or (reach == 0.0 and mode >> stop & 1):
        return memory, True
    return 0.0, False


@kernel
def push_of(plan: Vector, stop: int, closing: float, speed: float) -> Push:
    """The law of a pressed power-law stop.

    `closing` is the rate of its deformation, whose sign may matter, `speed` that at which it
    was met, which a law of restitution divides by.
    """
    at = par.stop_at(stop)
    if plan[at + par.KIND] == par.FORMULA:
        return Push(1.0, 1.0, 0.0, 0.0)  # which says that it pushes; how much, the formula says
    dissipation = plan[at + par.DISSIPATION]
    if dissipation < 0.0:
        met = speed > _UNMET * (plan[MOST] + abs(plan[par.LOAD])) / motion_rate(plan)
        dissipation = -dissipation / speed if met else 0.0
    viscous = plan[at + par.BUMPER_DAMPING] if closing > 0.0 else 0.0
    return Push(plan[at + par.BUMPER_STIFFNESS], plan[at + par.EXPONENT], dissipation, viscous)


@kernel
def pushing(push: Push, deformation: float, closing: float) -> float:
    """Its force per unit mass, never below 0."""
    if not deformation > 0.0:
        return 0.0
    force = push.stiffness * deformation**push.exponent * (1.0 + push.dissipation * closing)
    force += push.viscous * math.sqrt(math.sqrt(deformation)) * closing
    return max(force, 0.0)  # type: ignore[no-any-return]


@kernel
def stop_force(plan: Vector, stop: int, push: Push, deformation: float, closing: float) -> float:
    """The force of a pressed stop by its law, per unit mass, never below 0."""
    if plan[par.stop_at(stop) + par.KIND] != par.FORMULA:
        return pushing(push, deformation, closing)
    return max(own_push(plan, stop, deformation, closing)[0], 0.0)


@not_inlined
def own_push(
    plan: Vector, stop: int, deformation: float, closing: float
) -> tuple[float, float, float]:
    """What a stop's own formula gives, and its slopes, per unit mass; below 0 it does not push."""
    way = math.copysign(1.0, closing)
    run(plan, _OWN + STRIDE * (stop + 1), deformation, closing, 0.0, 1.0, way, 0.0, 0.0)
    return plan[OWN_FORCE], plan[OWN_FORCE + 1], plan[OWN_FORCE + 2]


@kernel
def spring(plan: Vector, stop: int, depth: float) -> float:
    """What it would push with if the mass stood there: the part of its force that it gives back."""
    at = par.stop_at(stop)
    if plan[at + par.KIND] == par.FORMULA:
        return own_push(plan, stop, depth, 0.0)[0]
    return plan[at + par.BUMPER_STIFFNESS] * depth ** plan[at + par.EXPONENT]  # type: ignore[no-any-return]


@inlined
def beyond(power: float) -> float:
    """How many times its bound a deformation or velocity may reach while its power is left out."""
    return 2.0 if power <= 4.0 else _LEFT_OUT ** (1.0 / power)


@kernel
def shallow(
    push: Push,
    deformation: float,
    closing: float,
    gains: float,
    jerk: float,
    grain: float,
    longest: float,
) -> tuple[Push, float]:
    """A stop that is pressed so little that nothing comes of it is left out, while it is.

    The work that its force has done is then a share ε of the motion's, or the deformation is no
    more than the rounding of a displacement, `grain`. The power of the deformation has a
    singularity where it begins, which no series passes. From rest it is δ″, `gains`, or the change
    of what shakes the mass, `jerk`, that ends this, not the speed.
    """
    if push.stiffness == 0.0:
        return push, longest
    # What it does up to a depth δ is beside a speed that is there from the start, or comes by δ″ or
    # δ‴: δ′ = √(2 δ″ δ) or (9/2 δ‴ δ²)^⅓.
    power, gained, quickened = push.exponent + 1.0, max(gains, 0.0), (4.5 * jerk) ** (1.0 / 3.0)
    share = NO_TRACE * power / push.stiffness
    little = max(
        (0.5 * share * closing * closing) ** (1.0 / power),
        (share * gained) ** (1.0 / (power - 1.0)),
        (0.5 * share * quickened * quickened) ** (1.0 / (power - 4.0 / 3.0)),
    )
    if push.viscous > 0.0:
        share = NO_TRACE / push.viscous
        beside = max(
            (share * max(closing, 0.0)) ** 0.8,
            (share * math.sqrt(2.0 * gained)) ** (4.0 / 3.0),
            (share * quickened) ** (12.0 / 7.0),
        )
        little = min(little, beside)
    little = max(little, grain)
    if deformation > little:
        # The series of its slope ends where it begins to be pressed.
        return push, min(longest, 0.5 * deformation / abs(closing)) if closing else longest
    way = beyond(power) * little - deformation
    soon = max(closing, 0.0) + math.sqrt(max(closing, 0.0) ** 2 + 2.0 * max(gains, 0.0) * way)
    if soon > 0.0:
        longest = min(longest, 2.0 * way / soon)
    if jerk > 0.0:
        longest = min(longest, (6.0 * way / jerk) ** (1.0 / 3.0))
    return NO_PUSH, longest


@kernel
def pressing(push: Push, closing: float, gains: float) -> Push:
    """The push of a stop, unless it would pull: 1 + χ δ′ below 0, or on the way there.

    `gains` is δ″ where it does not push.
    """
    stays = 1.0 + push.dissipation * closing
    if stays > EVEN or (stays > -EVEN and gains > 0.0):
        return push
    return NO_PUSH


@kernel
def own_pressing(
    plan: Vector, stop: int, depth: float, closing: float, gains: float, grain: float
) -> Push:
    """As `pressing`, of a stop that follows a formula: it pushes where that is above 0.

    `grain` is some rounding of a displacement.
    """
    force, by_depth, by_rate = own_push(plan, stop, max(depth, 0.0), closing)
    even = EVEN * (abs(by_depth * depth) + abs(by_rate * closing)) + abs(by_depth) * grain
    rises = by_depth * closing + by_rate * gains
    if force > even or (force >= -even and rises > 0.0):
        return Push(1.0, 1.0, 0.0, 0.0)
    return NO_PUSH
