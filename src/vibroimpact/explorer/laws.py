"""Replace the law of an isolator or of a stop by another law that is about as strong.

A user who selects another law wants to see the effect of the law alone. Therefore the new law has
the gap of the old law, and about the same force. The forces are compared at the largest
displacement without stops, or for stops at a share of it.
"""

from __future__ import annotations

from vibroimpact.errors import InputError, shown
from vibroimpact.explorer.state import PageState
from vibroimpact.model import AnyIsolator, Stop
from vibroimpact.model.isolators import ISOLATORS
from vibroimpact.model.largest_free_response import largest_free_flight
from vibroimpact.model.stops import STOPS

NONE = "none"
"""Kind that removes a stop."""
RESTITUTION, STIFFER = 0.6, 20.0
"""Restitution and stiffness ratio of a new stop. λ is close to that of the published rig."""
PRESSED = 0.2
"""Penetration at which two stops have equal forces, divided by the displacement without stops."""


def isolator_laws() -> list[str]:
    """Return the kinds of isolators that can be selected, as they are named in study files."""
    return [kind for kind, law in ISOLATORS.classes.items() if law.like(*[1.0] * 3)]


def stop_laws() -> list[str]:
    """Return the kinds of stops that can be selected, as they are named in study files."""
    return [NONE, *(kind for kind, law in STOPS.classes.items() if law.like(*[0.5] * 6))]


def words_of_stops() -> dict[str, str]:
    """Return the names of stops that are not their kinds."""
    return {kind: law.words for kind, law in STOPS.classes.items() if law.words}


def free_displacement(state: PageState) -> float:
    """Return the displacement (m) at which laws are compared: the largest one without stops."""
    rig = state.oscillator
    omega = rig.angular_frequency
    isolator = rig.isolator
    ratio = isolator.damping / (2.0 * rig.mass * omega) if isolator.damping_exponent == 1.0 else 0.1
    acceleration = float(state.shaking.acceleration(rig.mass, omega))
    swing, _ = largest_free_flight(omega, min(max(ratio, 0.05), 0.7), acceleration)
    return swing


def isolator_of(kind: str, state: PageState) -> AnyIsolator:
    """Return an isolator of a kind, with the stiffness and damping of the present isolator.

    Raises
    ------
    InputError
        If the kind is unknown.
    """
    old = state.oscillator.isolator
    if kind == old.kind:
        return old
    u = free_displacement(state)
    k, c = old.static_force(u) / u, old.damping
    if old.damping_exponent != 1.0:
        c = 0.3 * (k * state.oscillator.mass) ** 0.5
    law = ISOLATORS.classes.get(kind)
    made: AnyIsolator | None = law.like(k, c, u) if law is not None else None
    if made is None:
        known = ", ".join(isolator_laws())
        raise InputError(f"isolator.kind: {shown(kind)} is unknown; use one of {known}")
    return made


def stop_of(kind: str, state: PageState, side: str) -> Stop | None:
    """Return a stop of a kind, with the gap of the present stop and about the same force.

    Raises
    ------
    InputError
        If the kind is unknown.
    """
    rig = state.oscillator
    old: Stop | None = getattr(rig, side)
    if old is not None and kind == old.kind:
        return old
    if kind == NONE:
        return None
    u = free_displacement(state)
    gap = 0.5 * u if old is None else old.gap
    depth = PRESSED * u
    force = STIFFER * rig.isolator.initial_stiffness * depth
    if old is not None and not old.rigid:
        force = old.static_force(depth)
    restitution = getattr(old, "restitution", None) or RESTITUTION
    law = STOPS.classes.get(kind)
    made: Stop | None = (
        law.like(force, depth, gap, restitution, rig.angular_frequency, rig.mass)
        if law is not None
        else None
    )
    if made is None:
        known = ", ".join(stop_laws())
        raise InputError(f"{side}.kind: {shown(kind)} is unknown; use one of {known}")
    return made
