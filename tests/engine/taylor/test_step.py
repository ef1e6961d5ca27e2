"""The series of one Taylor step against exact coefficients, and how far it says it reaches."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from scipy.optimize import brentq

from vibroimpact.engine import parameters as par
from vibroimpact.engine.flow_dispatch import flow_of, planned
from vibroimpact.engine.motion import BOTH, Motion
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.engine.series.layout import DEGREE, X
from vibroimpact.engine.state import FLIGHT
from vibroimpact.engine.taylor.pieces import begun, motion_at
from vibroimpact.engine.taylor.plan import build
from vibroimpact.law_numbers import IsolatorNumbers, PowerLaw

LAWS = {
    "cubic": IsolatorNumbers(cubic=3.0),
    "both": IsolatorNumbers(cubic=-0.4, quintic=0.7),
    "linear": IsolatorNumbers(drag=1.0),
}


def exact(
    law: IsolatorNumbers, damping: float, u: float, v: float, clock, degree: int
) -> list[mpmath.mpf]:
    """Coefficients of u in time (s), of mass and stiffness 1, −sin θ shaking at ω = 1.3."""
    with mpmath.workdps(40):
        x = [mpmath.mpf(u), mpmath.mpf(v)]
        sine = [mpmath.mpf(clock[0]), mpmath.mpf("1.3") * mpmath.mpf(clock[1])]

        def times(a, b):
            return [sum(a[j] * b[n - j] for j in range(n + 1)) for n in range(len(a))]

        for n in range(degree - 1):
            cube = times(times(x, x), x)
            fifth = times(times(cube, x), x)
            force = (
                x[n] + damping * (n + 1) * x[n + 1] + law.cubic * cube[n] + law.quintic * fifth[n]
            )
            x.append((-0.6 * sine[n] - force) / ((n + 1) * (n + 2)))
            sine.append(-(mpmath.mpf("1.3") ** 2) * sine[n] / ((n + 1) * (n + 2)))
        return x


@pytest.mark.parametrize("name", LAWS)
def test_coefficients(name: str) -> None:
    law, clock = LAWS[name], (0.6, 0.8)
    rig = rig_vector(1.0, 1.0, 0.1, None, None, law=law)
    rig[par.CURVED] = 1.0
    plan = planned(flow_of(rig), rig)
    build(plan, 0.6, 1.3)
    motion = Motion(FLIGHT, 0, 0.4, -0.7, (0.0, 0.0), 0.0, 0.0, clock)
    frame, length = begun(plan, motion, math.inf)
    assert 0.1 < length < 6.0
    expected = exact(law, 0.1, 0.4, -0.7, clock, DEGREE + 20)
    terms = [float(c * mpmath.mpf(length) ** n) for n, c in enumerate(expected)]
    np.testing.assert_allclose(
        plan[X : X + DEGREE + 1], terms[: DEGREE + 1], atol=1e-16, rtol=1e-12
    )
    assert abs(math.fsum(terms[DEGREE + 1 :])) < 2e-16
    end = motion_at(plan, motion, frame, 1.0)
    assert end.u == pytest.approx(math.fsum(terms), abs=1e-15)


def test_a_weak_drag_does_not_shorten_the_steps_of_a_mass_that_creeps() -> None:
    """Held by two stops it never turns, however slow it is beside what the forces could do."""
    right, left = PowerLaw(1.4e4, 1.5, 0.0, 0.0, -5e-4), PowerLaw(2.5e12, 1.5, 0.0, 0.0, -8e-3)
    held = brentq(
        lambda u: 2.5e12 * (8e-3 - u) ** 1.5 - 1.4e4 * (u + 5e-4) ** 1.5 - 1.8e4 * u,
        0.0,
        8e-3,
        xtol=1e-300,
        rtol=1e-15,
    )
    lengths = []
    for damping in (0.0, 0.07):
        rig = rig_vector(1.0, 1.8e4, damping, right, left, law=IsolatorNumbers(drag=1.5))
        plan = planned(flow_of(rig), rig)
        build(plan, 18.0, 21.0)
        creeping = Motion(BOTH, 0, held, 2.6e-7, (0.0, 0.0), 0.0, 0.0, (0.0, 1.0))
        lengths.append(begun(plan, creeping, 0.3)[1])
    assert lengths[1] > 0.5 * lengths[0]
