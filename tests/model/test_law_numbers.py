"""The laws of the model as the engine's numbers: the same static forces, the same rates."""

from __future__ import annotations

import math

import pytest

import vibroimpact as vi
from engine.taylor.rigs import ISOLATORS, STOPS
from vibroimpact.law_numbers import IsolatorNumbers, PowerLaw


@pytest.mark.parametrize("isolator", ISOLATORS)
def test_the_stiffness_of_small_motions(isolator: str) -> None:
    """K u and the rest of the law, all memory at rest, behind a small step."""
    model = ISOLATORS[isolator]
    stiffness, damping, law = model.engine_numbers()
    u = 1e-6
    force = stiffness * u + law.cubic * u**3 + law.hysteretic * law.slope * u + law.friction
    force += 2.0 * law.sinh * math.sinh(law.sinh_rate * u)
    assert force == pytest.approx(model.static_force(u), rel=1e-4)
    assert (damping, law.drag) == (model.damping, model.damping_exponent)


@pytest.mark.parametrize("isolator", ["bilinear", "bouc-wen", "bouc-wen of 2", "exponential"])
def test_the_force_far_out(isolator: str) -> None:
    """The memory at its bound, where z′ = 0 or it yields."""
    model = ISOLATORS[isolator]
    stiffness, _, law = model.engine_numbers()
    bound = min(law.limit, math.inf)
    if math.isinf(bound):
        bound = (law.slope / (law.turning + law.knee)) ** (1.0 / law.sharpness)
    u = 20.0
    force = stiffness * u + law.hysteretic * bound
    force += 2.0 * law.sinh * math.sinh(law.sinh_rate * u)
    assert force == pytest.approx(model.static_force(u), rel=1e-9)


def test_a_linear_isolator_has_no_law() -> None:
    assert vi.Isolator(3.0, 0.2).engine_numbers() == (3.0, 0.2, IsolatorNumbers())
    assert vi.PolynomialIsolator(3.0, 0.2, 0.0).engine_numbers() == (3.0, 0.2, IsolatorNumbers())


def test_stops() -> None:
    assert STOPS["rigid"].engine_numbers() == (0.7, 0.5)
    assert STOPS["bumper"].engine_numbers() == (30.0, 0.6, 0.5)
    assert STOPS["hunt-crossley"].engine_numbers() == PowerLaw(40.0, 1.5, 0.3, 0.0, 0.5)
    d = 8.0 * 0.4 / (5.0 * 0.6)
    flores = STOPS["flores"].engine_numbers()
    assert flores[2] == pytest.approx(-d, rel=1e-14)
    pounding = STOPS["pounding"]
    viscous = pounding.engine_numbers()[3]
    assert viscous == pytest.approx(2.0 * pounding.damping_ratio * math.sqrt(40.0), rel=1e-14)
