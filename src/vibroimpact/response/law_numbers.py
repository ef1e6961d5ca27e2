"""From the laws of the model to the numbers by which the engine follows them."""

from __future__ import annotations

import math

from vibroimpact.engine.parameters import Law, OwnStop, PowerLaw
from vibroimpact.engine.parameters import Stop as Numbers
from vibroimpact.engine.series.program import SYMBOLS, Program, pack
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
from vibroimpact.model import (
    Law as OwnLaw,
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
        case OwnLaw():
            parts = isolator.parts
            law = Law(cubic=parts.cubic, quintic=parts.quintic, drag=2.0 if parts.square else 1.0)
            return parts.stiffness, parts.square or parts.damping, law
        case _:
            return isolator.stiffness, damping, Law(drag=drag)


def own_numbers(isolator: AnyIsolator) -> list[float]:
    """The formula that an isolator follows beside those laws, packed for the engine."""
    if not isinstance(isolator, OwnLaw):
        return []
    return _packed(isolator, isolator.initial_stiffness - isolator.parts.stiffness)


def _packed(law: OwnLaw, stiffness: float) -> list[float]:
    names, numbers = law.operations
    symbols = [one if isinstance(one, int) else SYMBOLS.index(one) for one in names]
    return pack(Program(tuple(symbols), tuple(numbers)), stiffness)


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
            assert stop.mass is not None  # which an oscillator requires
            viscous = 2.0 * stop.damping_ratio * math.sqrt(stop.mass * stop.stiffness)
            return PowerLaw(stop.stiffness, 1.5, 0.0, viscous, stop.gap)
        case OwnLaw():
            assert stop.gap is not None
            return OwnStop(tuple(_packed(stop, stop.initial_stiffness)), stop.gap)
        case _:
            return stop.stiffness, stop.damping, stop.gap
