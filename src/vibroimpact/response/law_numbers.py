"""From the laws of the model to the numbers by which the engine follows them."""

from __future__ import annotations

import math

from vibroimpact.engine.parameters import Law, PowerLaw
from vibroimpact.engine.parameters import Stop as Numbers
from vibroimpact.model import (
    BilinearIsolator,
    BoucWenIsolator,
    ExponentialIsolator,
    FrictionIsolator,
    JankowskiBumper,
    PolynomialIsolator,
    PowerBumper,
    RigidStop,
    Stop,
)
from vibroimpact.model.isolators import AnyIsolator


def isolator_numbers(isolator: AnyIsolator) -> tuple[float, float, Law]:
    """K (N/m), C (N s/m) and the law of what the isolator does besides.

    What is hysteretic is a spring in series with what yields: z (m) is its deformation. That of
    the exponential model is its force over k_a − k_b, with z′ = u′/2 − α |u′| z.
    """
    damping, drag = isolator.damping, isolator.damping_exponent
    match isolator:
        case FrictionIsolator():
            return isolator.stiffness, damping, Law(friction=isolator.friction, drag=drag)
        case PolynomialIsolator():
            law = Law(cubic=isolator.cubic, quintic=isolator.quintic, drag=drag)
            return isolator.stiffness, damping, law
        case BilinearIsolator():
            law = Law(
                hysteretic=isolator.hysteretic_stiffness,
                limit=isolator.yield_displacement,
                drag=drag,
            )
            return isolator.post_yield_stiffness, damping, law
        case BoucWenIsolator():
            scale = isolator.yield_displacement**-isolator.exponent
            law = Law(
                hysteretic=isolator.hysteretic_stiffness,
                turning=isolator.beta * scale,
                knee=isolator.gamma * scale,
                sharpness=isolator.exponent,
                drag=drag,
            )
            return isolator.post_yield_stiffness, damping, law
        case ExponentialIsolator():
            force, rate = isolator.hardening_force, isolator.hardening
            law = Law(
                sinh=force if rate else 0.0,
                sinh_rate=rate,
                hysteretic=isolator.reversal_stiffness - isolator.final_stiffness,
                slope=0.5,
                turning=isolator.decay,
                drag=drag,
            )
            return isolator.final_stiffness - 2.0 * force * rate, damping, law
        case _:
            return isolator.stiffness, damping, Law(drag=drag)


def stop_numbers(stop: Stop | None) -> Numbers | None:
    """What a stop does, as `parameters.rig_vector` takes it."""
    match stop:
        case None:
            return None
        case RigidStop():
            return stop.restitution, stop.gap
        case PowerBumper():
            number = stop.dissipation_number
            chi = stop.dissipation if number is None else -number
            return PowerLaw(stop.stiffness, stop.exponent, chi or 0.0, 0.0, stop.gap)
        case JankowskiBumper():
            viscous = 2.0 * stop.damping_ratio * math.sqrt(stop.mass * stop.stiffness)
            return PowerLaw(stop.stiffness, 1.5, 0.0, viscous, stop.gap)
        case _:
            return stop.stiffness, stop.damping, stop.gap
