"""Profiles are those of the best refits, also where a fit has two valleys."""

from types import SimpleNamespace

import numpy as np
import pytest

from vibroimpact.identification.least_squares import Problem
from vibroimpact.identification.profile_likelihood import profile


class Valleys(Problem):
    """Two unknowns, a and b: from b = 0, where the fit is, to b = 1 leads a gate at one |a| alone.

    At b = 0 the rise is 1.3 a²; in the valley at b = 1 it is less by 2 from |a| = 1 on.
    """

    def __init__(self, gate):
        self.gate, self.tail, self.scale = gate, np.inf, np.ones(2)
        self.low, self.high = np.array([-9.0, -1.0]), np.array([9.0, 2.0])

    def residuals(self, x):
        a, b = x
        across = np.clip(b, 0.0, 1.0)
        gain = 2.0 * across * min(abs(a), 1.0)
        ridge = 40.0 * max(abs(abs(a) - self.gate) - 0.1, 0.0) * across * (1.0 - across)
        out = 30.0 * (b - across) ** 2
        return np.sqrt([1.3 * a * a + 4.0 - gain + ridge + out])

    def values(self, x):
        return SimpleNamespace(residuals=self.residuals(x))

    def jacobian(self, x, *, only=None, **_):
        steps = 1e-6 * np.eye(2)
        slopes = [(self.residuals(x + s) - self.residuals(x - s)) / 2e-6 for s in steps]
        matrix = np.array(slopes).T
        return matrix if only is None else matrix[:, only]


def least(problem, a):
    """The rise in the better valley."""
    costs = [np.sum(problem.residuals(np.array([a, b])) ** 2) for b in np.linspace(0, 1, 401)]
    return min(costs) - 4.0


@pytest.mark.parametrize("gate", [1.6, 1.7, 1.8, 2.0])
def test_a_refit_that_stays_in_the_wrong_valley_is_mended_from_its_neighbours(gate):
    problem = Valleys(gate)
    around = SimpleNamespace(freedom=10**6, error=np.array([1.0]))
    curve = profile(problem, np.zeros(2), 0, around)
    for value, rise in zip(curve.value, curve.rise, strict=True):
        if abs(value) > gate:
            assert rise == pytest.approx(least(problem, value), abs=0.05)
    for end in (curve.low, curve.high):
        assert least(problem, end) == pytest.approx(1.959964**2, rel=0.02)
    assert (curve.open_low, curve.open_high) == (False, False)


class Rounded(Problem):
    """One unknown: a rise of 1.3 a², jumping by 3 at a = 1.4; each cost with rounding errors."""

    def __init__(self, seed):
        self.draw, self.tail, self.scale = np.random.default_rng(seed), np.inf, np.ones(1)
        self.low, self.high = np.array([-9.0]), np.array([9.0])

    def cost(self, x):
        rise = 1.3 * x[0] ** 2 + (3.0 if x[0] > 1.4 else 0.0)
        return 0.5 * (4.0 + rise) * (1.0 + 1e-12 * self.draw.normal())


def test_ends_do_not_depend_on_rounding():
    """Processors differ in it: no value that is tried may move by more than the fit itself."""
    ends = set()
    for seed in range(20):
        around = SimpleNamespace(freedom=10**6, error=np.array([0.7 + 1e-12 * seed]))
        one = profile(Rounded(seed), np.zeros(1), 0, around)
        ends.add((one.low, one.high))
    ((low, high),) = ends
    assert low == pytest.approx(-1.959964 / np.sqrt(1.3), rel=0.01)
    assert 1.4 < high < 1.4 * 1.01
