"""Differences of settled motions are the derivatives of orbits."""

import numpy as np
import pytest

import vibroimpact as vi
from identification.twins import FREE, curves
from vibroimpact.engine import hold, orbit
from vibroimpact.identification.curves import CurveTest
from vibroimpact.identification.free import frees
from vibroimpact.identification.held import Rig
from vibroimpact.identification.problem import Problem
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.stability.family import family
from vibroimpact.stability.first import first_orbit
from vibroimpact.stability.fixed_points import MAX_EVENTS


def measured(found, point):
    """Excursions of displacement and acceleration of an orbit."""
    row = np.empty(hold.RESULTS)
    section = found.section
    system = section.family.system(float(point[-1]))
    orbit.measure_orbit(
        system, section.family.phase, point, found.facts.copy(), section.period, MAX_EVENTS, row
    )
    return np.array([row[hold.U_MOST] - row[hold.U_LEAST], row[hold.A_MOST] - row[hold.A_LEAST]])


@pytest.mark.parametrize(
    ("frequency", "name"),
    [
        (2.0, "stiffness"),
        (2.0, "bumper_damping"),
        (2.65, "bumper_stiffness"),  # the forward fold is at 2.67
        (2.65, "gap"),
        (1.69, "damping"),
    ],
)
def test_differences_agree_with_the_implicit_function_theorem(frequency, name):
    case = vi.laboratory.case("B2-G1-A3", "identified")
    grid = np.arange(1.0, frequency + 0.001, 0.01)
    rig = Rig((case.oscillator, vi.Harmonic(case.amplitude, 1.0)))
    _, states = rig.sweep(grid)
    start = vi.State(states[-1][2], states[-1][3])
    shaken = vi.Harmonic(case.amplitude, float(grid[-1]))
    fam = family(case.oscillator, shaken, name)
    now = PARAMETERS[name].read(case.oscillator, shaken)
    found = first_orbit(fam, (0.5 * now, 1.5 * now), start, 1, symmetric=False)
    states_count = len(found.own)
    # P(z; p) = z, so that dz = (1 - P_z)^-1 P_p dp with P_z from the tangent map.
    moved = np.linalg.solve(np.eye(states_count) - found.own, found.slope[:states_count])
    step = 1e-5 * now
    ends = []
    for sign in (1.0, -1.0):
        point = found.point.copy()
        point[:states_count] += sign * step * moved
        point[-1] += sign * step
        ends.append(measured(found, point))
    exact = (ends[0] - ends[1]) / (2.0 * step)
    swept = []
    for sign in (1.0, -1.0):
        setting = PARAMETERS[name].write(case.oscillator, shaken, now * (1.0 + sign * 1e-4))
        (row,), _ = Rig(setting).sweep(grid[-1:], states[-1])
        swept.append([row[hold.U_MOST] - row[hold.U_LEAST], row[hold.A_MOST] - row[hold.A_LEAST]])
    differences = (np.array(swept[0]) - np.array(swept[1])) / (2e-4 * now)
    assert differences == pytest.approx(exact, rel=2e-4)


def test_residuals_are_continuous_where_a_fold_passes_a_measured_frequency():
    case = vi.laboratory.case("B2-G1-A3", "identified")
    data = curves(case.oscillator, case.amplitude, 0.02, seed=2)
    shaken = vi.Harmonic(case.amplitude, 1.0)
    settings = {"one": (case.oscillator, shaken)}
    test = CurveTest("one", data, settings["one"], None)
    problem = Problem([test], frees(FREE, settings, (), {}), {}, [0.02], np.inf)
    for column in (2, 3):  # the bumper's stiffness and damping move the forward fold
        costs = []
        for factor in np.linspace(0.85, 1.3, 91):
            x = problem.start
            x[column] *= factor
            costs.append(problem.cost(x))
        # A point that leaps to the other branch is 100 standard deviations off.
        assert np.abs(np.diff(costs)).max() < 0.1 * np.ptp(costs) + 1.0


def test_what_has_not_settled_has_no_derivative_and_spoils_none():
    case = vi.laboratory.case("B3-10mm-A3")
    grid = np.array([0.9, 1.0, 1.1, 3.0])  # chaotic at 1 Hz
    data = curves(case.oscillator, case.amplitude, frequencies=grid)
    settings = {"one": (case.oscillator, vi.Harmonic(case.amplitude, 1.0))}
    test = CurveTest("one", data, settings["one"], 0.02)
    problem = Problem([test], frees("bumper_stiffness", settings, (), {}), {}, [0.02], np.inf)
    here = problem.values(problem.start)
    slopes = problem.jacobian(problem.start, fine=True)[:, 0]
    assert not here.smooth[: test.points_count].all()
    assert (slopes[~here.smooth] == 0.0).all()
    assert np.abs(slopes).max() < 1e3
