"""A bumper of a spring and a dashpot: its force, in all forms in which it is used."""

from __future__ import annotations

import math

import numpy as np
import pytest

from vibroimpact.engine import parameters as par
from vibroimpact.engine.stops import kelvin_voigt

STIFFNESS, DAMPING, GAP = 24.0, 2.0, 0.5
PLAN = par.rig_vector(1.0, 1.0, 0.1, (STIFFNESS, DAMPING, GAP), (STIFFNESS, 0.0, GAP))


@pytest.mark.parametrize("stop", [0, 1])
def test_it_slows_the_mass_by_what_it_pushes_with(stop: int) -> None:
    way = 1.0 - 2.0 * stop
    push = kelvin_voigt.push(PLAN, stop, 0.1, way * 0.3)
    assert push == pytest.approx(2.4 + (0.6 if stop == 0 else -0.0), rel=1e-14)
    assert kelvin_voigt.slowed(PLAN, stop, 1.0, 0.1, 0.3) == pytest.approx(1.0 - way * push)


def test_of_its_force_the_dashpot_takes_the_power() -> None:
    spring = kelvin_voigt.push(PLAN, 0, 0.1, 0.0)
    lost = (kelvin_voigt.push(PLAN, 0, 0.1, 0.3) - spring) * 0.3
    assert kelvin_voigt.power(PLAN, 0, 0.3) == pytest.approx(lost, rel=1e-13)


def test_free_it_loses_the_energy_of_its_spring() -> None:
    """∫ c x′² dt of x = 0.1 e^−rt."""
    rate, t = kelvin_voigt.rate_of(PLAN, 0), 0.05
    after = kelvin_voigt.relaxed(0.1, rate, t)
    lost = DAMPING * (0.1 * rate) ** 2 * (1.0 - math.exp(-2.0 * rate * t)) / (2.0 * rate)
    assert kelvin_voigt.relaxed_loss(PLAN, 0, 0.1, after) == pytest.approx(lost, rel=1e-13)


def test_it_comes_back_when_it_has_relaxed_so_far() -> None:
    rate = STIFFNESS / DAMPING
    t = kelvin_voigt.comes_back(0.1, 0.03, rate)
    assert kelvin_voigt.relaxed(0.1, rate, t) == pytest.approx(0.03, rel=1e-13)


@pytest.mark.parametrize(("stop", "mode", "u", "v", "expected"), [
    (0, 0, 0.6, 0.0, (0.1, True)),
    (0, 0, 0.45, 0.0, (0.02, False)),  # beyond its face
    (0, 1, 0.6, -10.0, (0.1, False)),  # it would pull
    (0, 1, 0.45, 9.0, (0.0, False)),  # nor does it follow the mass beyond its place at rest
    (1, 0, -0.6, 0.0, (0.1, True)),
    (1, 0, 0.6, 0.0, (0.0, False)),
])  # fmt: skip
def test_beside_a_mass_it_is_pressed_or_free(
    stop: int, mode: int, u: float, v: float, expected: tuple[float, bool]
) -> None:
    deformation, pressed = kelvin_voigt.nearest_possible(PLAN, stop, mode, u, v, 0.02)
    assert pressed == expected[1]
    assert deformation == pytest.approx(expected[0], abs=1e-15)


def test_its_rate_follows_what_is_varied() -> None:
    plan = np.array(PLAN)
    plan[par.stop_at(0) + par.BUMPER_STIFFNESS] *= 2.0
    kelvin_voigt.complete(plan, 0)
    assert kelvin_voigt.rate_of(plan, 0) == 2.0 * STIFFNESS / DAMPING
    kelvin_voigt.complete(plan, 1)
    assert kelvin_voigt.rate_of(plan, 1) == math.inf
