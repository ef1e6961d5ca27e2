"""Saltation: how an event makes a disturbance jump, one function per kind of event.

An event comes where a function g of the state reaches zero. A disturbed motion comes to it late, by
δt = −δg/ġ. For that time it still moves at the rates before the event, and the reference motion
already at those after it. So each component of a disturbance jumps by (ẏ⁻ − ẏ⁺) δt, which is an
update of rank one: I + (f⁺ − f⁻) nᵀ / (nᵀ f⁻), n the gradient of g (P. C. Müller, Chaos, Solitons &
Fractals 5 (1995) 1671). An impact besides maps the velocity, u̇⁺ = −r(u̇⁻).

A disturbance is a row of q that begins at a place `at`, see `one_mass.disturbed_events`.
"""

from __future__ import annotations

from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.stops.rebound import Rebound


@kernel
def jump(q: Vector, i: int, late: float, before: float, after: float) -> None:
    """Let a component whose rate changes from `before` to `after` come late to the event (s)."""
    q[i] += (before - after) * late


@kernel
def impact(
    q: Vector, at: int, rebound: Rebound, arrival: float, before: float, after: float
) -> None:
    """An impact on a rigid stop, from its arrival (m/s) and the accelerations at both sides of it.

    Of g = u − G it is R (δy + f⁻ δt) − f⁺ δt with δt = −δu/u̇⁻, R = diag(1, −r′). Where the mass
    stays at the stop, nothing is left: see `rest`.
    """
    u, v = q[at], q[at + 1]
    slope = rebound.restitution * rebound.order
    q[at] = -rebound.restitution * u
    q[at + 1] = -slope * v + (after + slope * before) / arrival * u


@kernel
def rest(q: Vector, at: int) -> None:
    """Coming to rest on a rigid stop: where and when it begins leaves no trace in (u, u̇)."""
    q[at], q[at + 1] = 0.0, 0.0


@kernel
def contact(q: Vector, at: int, deformation: int, damping: float) -> None:
    """Contact with a spring and dashpot; `damping` is the dashpot's, per unit mass.

    The force begins with a jump by the damping times the closing speed, ġ, which cancels: grazing
    needs no special case. The pressed deformation then is that of the mass.
    """
    q[at + 1] -= damping * (q[at] - q[deformation])
    q[deformation] = q[at]


@kernel
def force_jump(q: Vector, at: int, arrival: float, force: float) -> None:
    """Contact with a force that begins with a jump; `force` away from the stop, per unit mass."""
    jump(q, at + 1, -q[at] / abs(arrival), force, 0.0)


@kernel
def turn(q: Vector, at: int, before: float, after: float) -> None:
    """The velocity reaches zero, where a force that depends on its sign changes.

    From the accelerations at both sides: g = u̇, so that what is left is their ratio. Where the mass
    sticks, `after` is 0 and nothing is.
    """
    q[at + 1] *= after / before


@kernel
def yielding(q: Vector, i: int) -> None:
    """A deformation reaches its limit and stays there: g is the component itself."""
    q[i] = 0.0


@kernel
def detachment(q: Vector, i: int) -> None:
    """A stop is left: no rate jumps. What it remembered of the contact is forgotten."""
    q[i] = 0.0
