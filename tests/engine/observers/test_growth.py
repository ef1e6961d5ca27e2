"""Growth of any number of disturbances: against closed forms, multipliers and the sum rule."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine import flow, lyapunov, native
from vibroimpact.engine.entry import entry
from vibroimpact.engine.event import LIMIT, TURN
from vibroimpact.engine.flow_dispatch import flow_of, planned
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.observers import growth
from vibroimpact.engine.observers.growth import LEAST, NOTHING, Disturbances, orthonormalise
from vibroimpact.engine.one_mass.disturbed_events import DISTURBANCE, MEMORY
from vibroimpact.engine.state import (
    EVENT,
    ONE_MASS,
    T,
    load,
    notes_buffer,
    parts_buffer,
    state_buffer,
    stretch_buffer,
)
from vibroimpact.response.prepared_rig import prepare

TAU = 2.0 * math.pi


def followed(oscillator, shaken, count, cycles, discard=0, transient=0, start=None):
    """Logarithms of the growth of so many disturbances, cycle by cycle; and the damping."""
    engine = prepare(vi.Rig(oscillator, shaken))
    out = np.empty((cycles, count + 1 + DISTURBANCE))
    state, q = engine.state(start), np.zeros((DISTURBANCE, DISTURBANCE))
    outcome, done = lyapunov.growth(
        engine.vector, shaken.amplitude, shaken.frequency, shaken.phase, state, q, True,
        -transient - discard, cycles, discard, 1000, out,
    )  # fmt: skip
    assert (outcome, done) == (0, cycles)
    return out[:, :count], out[:, count]


def free(damping=0.3, right=None, left=None, **options):
    return vi.Oscillator(1.0, vi.Isolator(1.0, damping, **options), right, left)


def made_orthonormal(q, weights, shares, count):
    none = np.empty(0)
    rows = Disturbances(q.ravel(), none, shares.ravel(), weights, none, count, DISTURBANCE)
    return orthonormalise(rows, LEAST, NOTHING)


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_rows_become_orthonormal_and_span_what_they_did(count):
    matrix = np.random.default_rng(count).normal(size=(DISTURBANCE, DISTURBANCE))
    weights = np.array([2.0, 1.0, 0.5, 3.0, 0.0])
    q, shares = matrix.copy(), np.zeros((DISTURBANCE, DISTURBANCE))
    assert made_orthonormal(q, weights, shares, count) == 0
    rows = q[:count]
    np.testing.assert_allclose((rows * weights) @ rows.T, np.eye(count), atol=1e-14)
    np.testing.assert_allclose(shares[:count, :count] @ rows, matrix[:count], rtol=1e-12)
    sizes = np.abs(np.diag(np.linalg.qr((matrix[:count] * np.sqrt(weights)).T)[1]))
    np.testing.assert_allclose(np.diag(shares)[:count], sizes, rtol=1e-12)


@pytest.mark.parametrize(
    ("apart", "left"), [(1e-3, 1e-3), (1e-6, -1e-6), (1e-15, -math.inf), (0.0, -math.inf)]
)
def test_how_little_is_left_of_a_row_is_marked(apart, left):
    q = np.zeros((DISTURBANCE, DISTURBANCE))
    q[0, :2], q[1, :2] = (3.0, 4.0), (0.6 - 0.8 * apart, 0.8 + 0.6 * apart)
    shares = np.zeros((DISTURBANCE, DISTURBANCE))
    unsure = made_orthonormal(q, np.ones(DISTURBANCE), shares, 2)
    assert unsure == int(left < 0.0)
    assert shares[1, 1] == pytest.approx(left, rel=1e-9)
    assert bool(q[1].any()) == (left > -math.inf)


def test_a_row_without_bound_is_not_one_that_vanished():
    q, shares = np.zeros((2, DISTURBANCE)), np.zeros((2, DISTURBANCE))
    q[0, 0], q[1, 1] = math.inf, math.nan
    with np.errstate(invalid="ignore"):
        unsure = made_orthonormal(q, np.ones(DISTURBANCE), shares, 2)
    assert unsure == 2
    assert shares[0, 0] == shares[1, 1] == math.inf
    assert not q.any()


@pytest.mark.parametrize("damping", [2.5, 8.0, 40.0])
@pytest.mark.parametrize("cubic", [0.0, 1e-9])
def test_overdamped_flight_has_its_two_real_exponents(damping, cubic):
    """(−c ± √(c² − 4k))/2, by tables and by Taylor series; a cycle leaves e^−760 of the second."""
    isolator = vi.PolynomialIsolator(1.0, damping, cubic) if cubic else vi.Isolator(1.0, damping)
    oscillator, shaken = vi.Oscillator(1.0, isolator), vi.Harmonic(1e-3, 0.05)
    rows, lost = followed(oscillator, shaken, 2, 3, discard=2, transient=2)
    slow = 2.0 / (damping + math.sqrt(damping**2 - 4.0))
    exact = np.array([-slow, slow - damping]) / shaken.frequency
    np.testing.assert_allclose(rows, np.tile(exact, (3, 1)), rtol=1e-9 if cubic else 1e-12)
    np.testing.assert_allclose(rows.sum(axis=1), -lost, rtol=1e-12)


def test_underdamped_flight_has_twice_minus_zeta_omega():
    """A complex pair turns: the sum is exact in each cycle, each on average."""
    rows, _ = followed(free(), vi.Harmonic(1.0, 0.7 / TAU), 2, 4000)
    period = TAU / 0.7
    np.testing.assert_allclose(rows.sum(axis=1), -0.3 * period, rtol=1e-12)
    np.testing.assert_allclose(rows.mean(axis=0), -0.15 * period, rtol=1e-3)


def test_a_bumper_that_is_not_touched_relaxes_by_itself():
    """Four of the five parts have an exponent; a linear isolator remembers nothing."""
    oscillator = free(0.3, vi.Bumper(3.0, 4.0, 50.0), vi.Bumper(1.0, 5.0, 50.0))
    shaken = vi.Harmonic(1.0, 0.7 / TAU)
    rows, lost = followed(oscillator, shaken, DISTURBANCE, 50)
    rates = rows * shaken.frequency
    np.testing.assert_allclose(rates[:, :2].sum(axis=1), -0.3, rtol=1e-12)
    np.testing.assert_allclose(rates[:, 2:4], np.tile([-0.75, -0.2], (50, 1)), rtol=1e-12)
    assert (rates[:, 4] == -math.inf).all()
    np.testing.assert_allclose(rows[:, :2].sum(axis=1), -lost, rtol=1e-12)


STRUCK = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.Bumper(4.0, 6.0, 0.3))


@pytest.mark.parametrize("cubic", [0.0, 0.3])
def test_all_exponents_of_an_orbit_are_those_of_its_matrix(cubic):
    """Of a bumper that remembers: two multipliers, and a contact leaves nothing of the third."""
    isolator = vi.PolynomialIsolator(1.0, 0.1, cubic) if cubic else STRUCK.isolator
    oscillator, shaken = STRUCK.replace(isolator=isolator), vi.Harmonic(1.0, 0.9 / TAU)
    rows, lost = followed(oscillator, shaken, DISTURBANCE, 2000, discard=100, transient=300)
    engine = prepare(vi.Rig(oscillator, shaken))
    state = engine.state(None)
    carried, damping = np.empty((DISTURBANCE, DISTURBANCE)), np.empty(1)
    for cycles in (400, 1):
        assert lyapunov.monodromy(
            engine.vector, shaken.amplitude, shaken.frequency, shaken.phase, state, cycles, 1000,
            carried, damping,
        ) == 0  # fmt: skip
    moduli = np.sort(np.abs(np.linalg.eigvals(carried[:3, :3])))[::-1]
    assert moduli[2] < 1e-12 * moduli[1]
    assert abs(np.log(moduli[:2]).sum() + lost[-1]) > 1e-2  # the sum rule wants forgetful bumpers
    tolerance = 1e-9 if moduli[0] > moduli[1] * (1.0 + 1e-6) else 2e-3
    np.testing.assert_allclose(rows[:, :2].sum(axis=1), np.log(moduli[:2]).sum(), atol=1e-9)
    np.testing.assert_allclose(rows[:, :2].mean(axis=0), np.log(moduli[:2]), atol=tolerance)
    assert (rows[:, 2:] == -math.inf).all()
    assert not carried[MEMORY].any()


@pytest.mark.parametrize("cubic", [0.0, 0.2])
@pytest.mark.parametrize("e", [0.9, 0.1, 1e-3, 1e-6, 1e-9, 1e-12])
def test_impacts_take_twice_the_logarithm_of_their_restitution(e, cubic):
    """An impact leaves e² of the area, however parallel it makes two disturbances."""
    isolator = vi.PolynomialIsolator(1.0, 0.2, cubic) if cubic else vi.Isolator(1.0, 0.2)
    oscillator = vi.Oscillator(1.0, isolator, vi.RigidStop(e, 0.6))
    shaken = vi.Harmonic(0.6, 0.6 / TAU)
    rows, lost = followed(oscillator, shaken, 2, 40, discard=5, transient=20)
    impacts = np.round((lost - 0.2 * shaken.period) / (-2.0 * math.log(e)))
    assert impacts.max() > 0.0
    np.testing.assert_allclose(lost, 0.2 * shaken.period - 2.0 * math.log(e) * impacts, rtol=1e-12)
    np.testing.assert_allclose(rows.sum(axis=1), -lost, rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize("exponent", [1.1, 1.5, 1.9])
def test_a_power_of_the_velocity(exponent):
    """The slope of a drag |u̇|^α is not analytic where the mass turns, in each cycle."""
    oscillator = free(0.2, vi.Bumper(30.0, 0.6, 0.5), damping_exponent=exponent)
    rows, lost = followed(oscillator, vi.Harmonic(0.6, 0.9 / TAU), 2, 40, discard=5)
    assert np.ptp(lost) > 0.0
    np.testing.assert_allclose(rows.sum(axis=1), -lost, rtol=1e-9)


def test_what_grows_on_a_hilltop_does_not_hide_what_shrinks():
    """Within a cycle without events, e^49 between two disturbances."""
    cubic, quintic = -2.0, 1.0
    top = math.sqrt(1.0 - math.sqrt(0.8))  # of 0.2 u − 2 u³ + u⁵
    slope = 0.2 + 3.0 * cubic * top**2 + 5.0 * quintic * top**4
    oscillator = vi.Oscillator(1.0, vi.PolynomialIsolator(0.2, 0.1, cubic, quintic))
    shaken = vi.Harmonic(1e-14, 0.025)
    rows, lost = followed(oscillator, shaken, 2, 1, start=vi.State(top))
    rates = -0.05 + math.sqrt(0.0025 - slope) * np.array([1.0, -1.0])
    np.testing.assert_allclose(rows[0], rates * shaken.period, atol=2.0)
    assert rates[0] > 0.5
    np.testing.assert_allclose(rows.sum(axis=1), -lost, rtol=1e-9)


@entry("void(f8[::1], f8, i8, f8[:, ::1], f8[::1])", "disturbed")
def grown_over(memory, rig, length, event, q, logarithms):
    """The growth over a stretch of flight, as if this event had ended it."""
    plan = planned(memory, rig)
    flow.build(plan, 0.0, 1.0)
    before, after, ended, weights = state_buffer(), state_buffer(), stretch_buffer(), parts_buffer()
    load(plan, pointer(np.zeros(ONE_MASS.width)), before, 0.0, 1.0)
    flow.advance(plan, before, length, ended, after)
    ended[EVENT], ended[T] = event, 0.0
    growth.weigh(plan, weights)
    rows = growth.rows_of(
        plan, pointer(q), growth.work_buffer(), weights, pointer(logarithms), len(logarithms)
    )
    growth.begin_rows(plan, before, rows, 0, len(logarithms))
    growth.grow(plan, before, ended, after, notes_buffer(), rows)


def test_pieces_that_end_otherwise_than_their_stretch_leave_the_growth_unknown():
    damping, length = 40.0, 0.5  # of the second row, e^−20 is left
    rig = prepare(vi.Rig(free(damping), vi.Harmonic(1.0, 1.0))).vector
    # As Python, if it would be compiled for this call alone.
    grow = (
        partial(grown_over.function, flow_of(rig).memory) if native.find_library() else grown_over
    )
    q, logarithms = np.zeros((DISTURBANCE, DISTURBANCE)), np.zeros(2)
    grow(rig, length, LIMIT, q, logarithms)
    assert logarithms.sum() == pytest.approx(-damping * length, rel=1e-9)
    q, logarithms = np.zeros((DISTURBANCE, DISTURBANCE)), np.zeros(2)
    grow(rig, length, TURN, q, logarithms)  # which no piece meets
    assert np.isfinite(logarithms[0])
    assert np.isnan(logarithms[1])
    assert np.isfinite(q).all()
