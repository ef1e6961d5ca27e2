"""The tangent flow of curved laws against differences of the flow itself, through all events."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import vibroimpact as vi
from engine.taylor.rigs import HYSTERETIC, SHAKEN, between, followed, pairs, started
from vibroimpact.engine import lyapunov
from vibroimpact.engine.motion import FACES, ISOLATOR, U, V
from vibroimpact.engine.one_mass.disturbed_events import DISTURBANCE, MEMORY
from vibroimpact.engine.state import MODE
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_system import engine_rig

ORDER = [U, V, FACES, FACES + 1, ISOLATOR]
SIGNS = np.array([1.0, 1.0, 1.0, -1.0, 1.0])
STEP = 1e-5


def carried(rig, state, cycles, shaken=SHAKEN):
    """Unit disturbances behind so many cycles, the damping's integral, and the end."""
    rows, damping, end = np.empty((DISTURBANCE, DISTURBANCE)), np.empty(1), state.copy()
    outcome = lyapunov.monodromy(
        engine_rig(Rig(rig, shaken)), shaken.amplitude, shaken.frequency, shaken.phase, end, cycles,
        10_000, rows, damping,
    )  # fmt: skip
    assert outcome == 0
    return rows, float(damping[0]), end


@pytest.mark.parametrize(("isolator", "stop"), pairs("pounding"))
def test_derivative_agrees_with_central_differences(isolator: str, stop: str) -> None:
    """Over a cycle with contacts, turns and yields; in flight at its start."""
    rig = between(isolator, stop)
    start = started(rig, 0.1, 0.9)
    start[ISOLATOR] = 0.05 if isolator in HYSTERETIC else 0.0
    rows, _, end = carried(rig, start, 1)
    np.testing.assert_allclose(end, followed(rig, SHAKEN, 1, start), atol=1e-13)
    components = [(U, 0), (V, 1)] + [(ISOLATOR, MEMORY)] * (isolator in HYSTERETIC)
    for at, row in components:
        differences = []
        for size in (STEP, 0.5 * STEP):
            ends = []
            for step in (size, -size):
                moved = start.copy()
                moved[at] += step
                ends.append(followed(rig, SHAKEN, 1, moved))
                assert ends[-1][MODE] == end[MODE]
            differences.append(SIGNS * (ends[0] - ends[1])[ORDER] / (2.0 * size))
        difference = (4.0 * differences[1] - differences[0]) / 3.0
        scale = max(np.abs(rows[row]).max(), 1e-3)
        assert np.abs(difference - rows[row]).max() < 1e-6 * scale


@pytest.mark.parametrize("exponent", [1.0, 2.0])
def test_a_spring_that_has_all_but_yielded_forgets(exponent: float) -> None:
    """A swing of 80 yield displacements: z stands still, a disturbance dies out by e^−80."""
    shaken = vi.Harmonic(0.3, 0.16)
    rig = vi.Oscillator(1.0, vi.BoucWenIsolator(5.0, 1.0, 0.1, 0.1, exponent, 0.5, 0.5))
    start = started(rig, 1.7, 0.9)
    start[ISOLATOR] = 0.005  # not 0, at which |z| has a corner
    rows, damping, _ = carried(rig, start, 1, shaken)
    for at, row in ((U, 0), (V, 1), (ISOLATOR, MEMORY)):
        ends = []
        for step in (STEP, -STEP):
            moved = start.copy()
            moved[at] += step
            ends.append(followed(rig, shaken, 1, moved))
        difference = SIGNS * (ends[0] - ends[1])[ORDER] / (2.0 * STEP)
        np.testing.assert_allclose(rows[row], difference, atol=1e-7)
    assert abs(rows[MEMORY][MEMORY]) < 1e-15
    assert damping > 50.0


def differentiated(exponent: float, drag: float) -> np.ndarray:
    """The monodromy matrix of a dashpot drag |v|^α, by its equation from turn to turn: DOP853."""

    def rates(t: float, y: np.ndarray) -> list[float]:
        u, v, one, slope_one, two, slope_two = y
        force = u + drag * np.copysign(abs(v) ** exponent, v)
        by_v = drag * exponent * abs(v) ** (exponent - 1.0)
        base = SHAKEN.amplitude * np.sin(SHAKEN.angular_frequency * t + SHAKEN.phase)
        return [v, -force - base, slope_one, -one - by_v * slope_one,
                slope_two, -two - by_v * slope_two]  # fmt: skip

    def turns(t: float, y: np.ndarray) -> float:
        return float(y[1])

    turns.terminal = True
    t, y, way = 0.0, np.array([0.1, 0.9, 1.0, 0.0, 0.0, 1.0]), 1.0
    while t < SHAKEN.period:
        turns.direction = -way
        solution = solve_ivp(
            rates, (t, SHAKEN.period), y, "DOP853", events=turns, rtol=1e-13, atol=1e-15
        )
        t, y, way = solution.t[-1], solution.y[:, -1].copy(), -way
        y[1] *= solution.status == 0
    return y[2:].reshape(2, 2)


KNOWN = {
    1.1: ((0.4013481727197414, -0.3041292460712887), (0.2935468482568414, 0.3666147169859871)),
    1.3: ((0.3608855037586698, -0.2966305509328317), (0.2671934546108436, 0.3758065788570191)),
    1.5: ((0.3234475186893913, -0.2887894075326145), (0.2433679391528359, 0.3835000033848026)),
    1.9: ((0.2566326581957434, -0.2718633598054753), (0.2020719904128375, 0.3956867472984311)),
    2.2: ((0.21307489597896767, -0.25821969277934875), (0.17583459911284438, 0.40274368868287574)),
    2.8: ((0.14176502149268638, -0.22979469730313734), (0.13340371564044087, 0.41278999150753176)),
    3.3: ((0.09717493508158769, -0.2066378996326118), (0.10644559134653592, 0.4176648262306484)),
}  # fmt: skip
"""Monodromy matrices of u'' + u + |u'|^α sgn u' / 5 under `SHAKEN` over one cycle, from (0.1, 0.9),
for a disturbance of u and for one of u'. From 24 terms of Taylor series with 26 digits, in steps
that fall geometrically to |u'| = 1e-19; those above 2 from 34 terms with 40 digits, to 1e-24."""


@pytest.mark.parametrize("exponent", [1.1, 1.3, 1.5, 1.9, 2.2, 2.5, 2.8, 3.3])
def test_derivative_through_a_power_of_the_velocity(exponent: float) -> None:
    """As exact as the motion: the power's slope is not analytic where the mass turns."""
    for drag in (0.2, 2.0):
        rig = vi.Oscillator(1.0, vi.Isolator(1.0, drag, damping_exponent=exponent))
        rows, damping, _ = carried(rig, started(rig, 0.1, 0.9), 1)
        matrix = rows[:2, :2]
        known = differentiated(exponent, drag)
        np.testing.assert_allclose(matrix, known, atol=1e-10 * np.abs(known).max(), rtol=0.0)
        assert np.log(np.linalg.det(matrix)) + damping == pytest.approx(0.0, abs=1e-12)
        if drag == 0.2 and exponent in KNOWN:
            np.testing.assert_allclose(matrix, KNOWN[exponent], atol=2e-14, rtol=0.0)


@pytest.mark.parametrize("damping", [0.2, 3.0, 20.0])
@pytest.mark.parametrize("ratio", [0.03, 0.2])
def test_a_slow_motion_carries_a_fast_disturbance(ratio: float, damping: float) -> None:
    """The steps are as short as the disturbance wants, which has a rate of its own."""
    shaken = vi.Harmonic(1e-3, ratio / np.pi / 2.0)
    rig = vi.Oscillator(1.0, vi.PolynomialIsolator(1.0, damping, 1e-9))
    _, _, steady = carried(rig, started(rig, 0.0, 0.0), 20, shaken)
    rows, _, _ = carried(rig, steady, 1, shaken)
    known = expm(shaken.period * np.array([[0.0, 1.0], [-1.0, -damping]])).T
    np.testing.assert_allclose(rows[:2, :2], known, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("isolator", ["linear", "duffing", "drag", "exponential"])
def test_without_events_volume_shrinks_by_the_divergence(isolator: str) -> None:
    """det = exp(−∫ damping) of displacement, velocity and what is remembered."""
    rig = between(isolator, None)
    rows, damping, _ = carried(rig, started(rig, 0.1, 0.9), 1)
    own = [0, 1] + [MEMORY] * (isolator in HYSTERETIC)
    assert np.linalg.det(rows[np.ix_(own, own)]) == pytest.approx(np.exp(-damping), rel=1e-9)
