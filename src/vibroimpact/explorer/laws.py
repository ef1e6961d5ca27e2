"""Replace the law of an isolator or of a stop by another law that is about as strong.

A user who selects another law wants to see the effect of the law alone. Therefore the new law has
the gap of the old law, and about the same force. The forces are compared at the largest
displacement without stops, or for stops at a share of it.
"""

from __future__ import annotations

from collections.abc import Callable

from vibroimpact.errors import InputError, shown
from vibroimpact.explorer.state import State
from vibroimpact.model import (
    AnyIsolator,
    BilinearIsolator,
    BoucWenIsolator,
    Bumper,
    ExponentialIsolator,
    FrictionIsolator,
    Isolator,
    JankowskiBumper,
    Law,
    PolynomialIsolator,
    PowerBumper,
    RigidStop,
    Stop,
)
from vibroimpact.model.isolators import ISOLATORS
from vibroimpact.model.largest_free_response import largest_free_flight
from vibroimpact.model.stops import STOPS

NONE = "none"
"""Kind that removes a stop."""
_RESTITUTION, _RELAXATION, _STIFFER = 0.6, 0.01, 20.0
"""Values of a new stop. τ and λ are close to those of the published rig."""
_PRESSED = 0.2
"""Penetration at which two stops have equal forces, divided by the displacement without stops."""


def isolator_laws() -> list[str]:
    """Return the kinds of isolators that can be selected, as they are named in study files."""
    return [kind for kind in ISOLATORS.classes if kind != Law.kind]


def stop_laws() -> list[str]:
    """Return the kinds of stops that can be selected, as they are named in study files."""
    return [NONE, *(kind for kind in STOPS.classes if kind != Law.kind)]


def free_displacement(state: State) -> float:
    """Return the displacement (m) at which laws are compared: the largest one without stops."""
    rig = state.oscillator
    omega = rig.angular_frequency
    isolator = rig.isolator
    ratio = isolator.damping / (2.0 * rig.mass * omega) if isolator.damping_exponent == 1.0 else 0.1
    acceleration = float(state.shaking.acceleration(rig.mass, omega))
    swing, _ = largest_free_flight(omega, min(max(ratio, 0.05), 0.7), acceleration)
    return swing


def isolator_of(kind: str, state: State) -> AnyIsolator:
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
    made: dict[str, Callable[[], AnyIsolator]] = {
        "linear": lambda: Isolator(k, c),
        "friction": lambda: FrictionIsolator(k, c, 0.1 * k * u),
        "bilinear": lambda: BilinearIsolator(1.6 * k, 0.9 * k, 0.18 * k * u, 0.5 * c),
        "polynomial": lambda: PolynomialIsolator(k, c, 0.3 * k / u**2, 0.0),
        "bouc-wen": lambda: BoucWenIsolator(1.8 * k, 0.9 * k, 0.18 * k * u, 0.5 * c),
        "exponential": lambda: ExponentialIsolator(2.4 * k, 0.83 * k, 3.5 / u, 0.3 * c),
    }
    if kind not in made:
        raise InputError(f"isolator.kind: {shown(kind)} is unknown; use one of {', '.join(made)}")
    return made[kind]()


def stop_of(kind: str, state: State, side: str) -> Stop | None:
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
    depth = _PRESSED * u
    force = _STIFFER * rig.isolator.initial_stiffness * depth
    if old is not None and not isinstance(old, RigidStop):
        force = old.static_force(depth)
    restitution = getattr(old, "restitution", None) or _RESTITUTION
    k = force / depth
    made: dict[str, Callable[[], Stop]] = {
        "kelvin-voigt": lambda: Bumper(k, _RELAXATION * k / rig.angular_frequency, gap),
        "rigid": lambda: RigidStop(restitution, gap),
        "power": lambda: PowerBumper(force / depth**1.5, gap, restitution=restitution),
        "jankowski": lambda: JankowskiBumper(force / depth**1.5, gap, restitution, rig.mass),
    }
    if kind not in made:
        raise InputError(
            f"{side}.kind: {shown(kind)} is unknown; use one of {', '.join((NONE, *made))}"
        )
    return made[kind]()
