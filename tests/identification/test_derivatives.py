"""Differences of settled motions are the derivatives of orbits."""

import numpy as np
import pytest

import vibroimpact as vi
from identification.twins import FREE, curves
from vibroimpact.engine import orbit, steady_response
from vibroimpact.engine.section_map import MODE
from vibroimpact.identification.branch_response import SteppedRig
from vibroimpact.identification.curve_residuals import CurveTest
from vibroimpact.identification.free_parameters import frees
from vibroimpact.identification.least_squares import Problem
from vibroimpact.stability.fixed_points import MAX_EVENTS, evaluated
from vibroimpact.stability.initial_orbit import first_orbit
from vibroimpact.stability.parameter_family import family

FOLDED = vi.laboratory.case("B2-G1-A3", "identified")
GRAZED = vi.laboratory.case("B2-G2-A2", "identified")


def shaken(case, frequency=1.0):
    return vi.Harmonic(case.amplitude, frequency)


def measured(solution, point):
    """Excursions of displacement and acceleration of an orbit."""
    row = np.empty(steady_response.RESULTS)
    section = solution.section
    system = section.family.system(float(point[-1]))
    orbit.measure_orbit(
        system, section.family.phase, point, solution.facts.copy(), section.count, MAX_EVENTS, row
    )
    return np.array(
        [
            row[steady_response.U_MOST] - row[steady_response.U_LEAST],
            row[steady_response.A_MOST] - row[steady_response.A_LEAST],
        ]
    )


def by_the_implicit_function_theorem(case, frequency, name, state):
    """Logarithmic derivatives of both excursions: P(z; p) = z, so dz = (1 - P_z)^-1 P_p dp.

    P_z comes from the tangent map; P_p and what is measured over one cycle are differences at a
    fixed state, which nothing has to settle for.
    """
    fam = family(vi.Rig(case.oscillator, shaken(case, frequency)), name)
    now = fam.value
    solution = first_orbit(fam, (0.5 * now, 1.5 * now), vi.State(*state), 1, symmetric=False)
    states = len(solution.map_derivative)
    step = 1e-6 * now

    def moved(by):
        point = solution.point.copy()
        point[:states] += by[:states]
        point[-1] += by[-1]
        return point

    along = np.zeros(states + 1)
    along[-1] = step
    images = [
        evaluated(solution.section, moved(s * along), solution.facts[MODE])[2] for s in (1, -1)
    ]
    of_parameter = (images[0] - images[1])[:states] / 2.0
    along[:states] = np.linalg.solve(np.eye(states) - solution.map_derivative, of_parameter)
    ends = [measured(solution, moved(s * along)) for s in (1, -1)]
    return (ends[0] - ends[1]) / (2e-6 * measured(solution, solution.point))


def by_the_fit(case, grid, name):
    """The same, as a fit finds them at the last of its frequencies."""
    data = curves(case.oscillator, case.amplitude, frequencies=grid).sel(direction=["forward"])
    settings = {"one": vi.Rig(case.oscillator, shaken(case))}
    test = CurveTest("one", data, settings["one"], 1.0)
    problem = Problem([test], frees(name, settings, (), {}), {}, [1.0], np.inf)
    slopes = problem.jacobian(problem.start, fine=True)[: test.points_count, 0]
    # Of asinh(y/floor), whose derivative is that of the logarithm where y is large.
    value = test.points.value
    slopes = slopes * np.sqrt(1.0 + (test.floor / value) ** 2)
    return slopes[test.points.hold == len(grid) - 1]


@pytest.mark.parametrize(
    ("frequency", "name"),
    [
        (2.0, "isolator.stiffness"),
        (2.0, "stops.damping"),
        (2.65, "stops.stiffness"),  # the forward fold is at 2.66
        (2.65, "gap"),
        (1.69, "isolator.damping"),
    ],
)
def test_differences_agree_with_the_implicit_function_theorem(frequency, name):
    grid = np.round(np.arange(1.0, frequency + 0.001, 0.01), 10)
    _, states = SteppedRig(vi.Rig(FOLDED.oscillator, shaken(FOLDED))).sweep(grid)
    exact = by_the_implicit_function_theorem(FOLDED, frequency, name, states[-1][2:4])
    assert by_the_fit(FOLDED, grid, name) == pytest.approx(exact, rel=5e-6)


def grazing():
    """The frequency (Hz) above which the mass that comes from below touches its bumpers."""
    low, high = 0.5, 0.8
    rig = SteppedRig(vi.Rig(GRAZED.oscillator, shaken(GRAZED)))
    gap = GRAZED.oscillator.right.gap
    while high - low > 1e-12:
        middle = 0.5 * (low + high)
        touches = rig.sweep(np.array([middle]))[0][0, steady_response.U_MOST] > gap
        low, high = (low, middle) if touches else (middle, high)
    return low


@pytest.mark.parametrize("share", [1e-4, 1e-2])
@pytest.mark.parametrize("name", ["isolator.stiffness", "stops.stiffness", "stops.damping", "gap"])
def test_differences_behind_a_grazing(share, name):
    frequency = grazing() * (1.0 + share)
    rig = SteppedRig(vi.Rig(GRAZED.oscillator, shaken(GRAZED)))
    (row,), (state,) = rig.sweep(np.array([frequency]))
    assert (
        0.0
        < row[steady_response.U_MOST] - GRAZED.oscillator.right.gap
        < 0.1 * row[steady_response.U_MOST]
    )
    exact = by_the_implicit_function_theorem(GRAZED, frequency, name, state[2:4])
    slopes = by_the_fit(GRAZED, np.array([frequency]), name)
    assert slopes == pytest.approx(exact, rel=5e-6, abs=1e-8)


def test_differences_before_a_grazing_are_those_of_free_flight():
    frequency = grazing() * (1.0 - 1e-4)
    rig, omega = GRAZED.oscillator, 2.0 * np.pi * frequency
    k, c = rig.isolator.stiffness, rig.isolator.damping
    real, imaginary = k - rig.mass * omega**2, c * omega
    size = real**2 + imaginary**2
    # |u| = m a/|k - m w² + i c w|, and |ü + a| = |u| |k + i c w| / m.
    displacement = np.array([-k * real, -c * omega * imaginary]) / size
    force = np.array([k * k, (c * omega) ** 2]) / (k * k + imaginary**2)
    for i, name in enumerate(("isolator.stiffness", "isolator.damping")):
        slopes = by_the_fit(GRAZED, np.array([frequency]), name)
        exact = [displacement[i], displacement[i] + force[i]]
        assert slopes == pytest.approx(exact, rel=1e-6)
    for name in ("stops.stiffness", "stops.damping", "gap"):
        assert (by_the_fit(GRAZED, np.array([frequency]), name) == 0.0).all()


@pytest.mark.full
def test_residuals_are_continuous_where_a_fold_passes_a_measured_frequency():
    case = FOLDED
    data = curves(case.oscillator, case.amplitude, 0.02, seed=2)
    settings = {"one": vi.Rig(case.oscillator, shaken(case))}
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
    settings = {"one": vi.Rig(case.oscillator, shaken(case))}
    test = CurveTest("one", data, settings["one"], 0.02)
    problem = Problem([test], frees("stops.stiffness", settings, (), {}), {}, [0.02], np.inf)
    here = problem.values(problem.start)
    slopes = problem.jacobian(problem.start, fine=True)[:, 0]
    assert not here.smooth[: test.points_count].all()
    assert (slopes[~here.smooth] == 0.0).all()
    assert np.abs(slopes).max() < 1e3
