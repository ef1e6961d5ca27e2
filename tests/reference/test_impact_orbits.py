"""Impact orbits in closed form against the integration to fifty digits."""

import pytest
from mpmath import mp, mpf

from reference.fifty_digits import integrate
from reference.impact_orbits import Orbit, Oscillator, doubling, orbits, possible_orbits
from reference.rig import Rig, State, Wall
from samples import sample

CASES = {
    "resonant": Oscillator(0.16, 0.1, 0.8, 1.0),
    "no gap": Oscillator(0.318, 0.1, 0.65, 0.0),
    "one of two": Oscillator(0.3, 0.1, 0.65, 0.43),
    "every second cycle": Oscillator(0.669, 0.1, 0.65, 0.012, 2),
    "every third cycle": Oscillator(0.955, 0.1, 0.65, 0.0, 3),
    "undamped, unstable": Oscillator(0.4456, 0.0, 0.8, 0.0),
    "mass held away": Oscillator(0.35, 0.1, 0.65, -0.2),
    "plastic": Oscillator(0.318, 0.1, 0.0, 0.05),
}
ROUNDING = mpf(10) ** -40


def moved(orbit: Orbit, du: mpf, dv: mpf) -> State:
    """A start a third of the period after an impact, n forcing cycles later."""
    one = orbit.oscillator
    u, v, phase = orbit.after(one.span / 3)
    rig = Rig(1.0, 1.0, one.damping, Wall(one.restitution, one.gap))
    start = (u + du, v + dv, 0, 0)
    return integrate(rig, 1.0, one.frequency, phase, start, one.cycles).states[-1]


@pytest.mark.parametrize("name", sample([*CASES], [*CASES][::3]))
def test_it_comes_back_with_its_multipliers(name: str) -> None:
    with mp.workdps(80):
        orbit_list = possible_orbits(CASES[name])
        assert orbit_list
        for orbit in orbit_list:
            u, v, _ = orbit.after(orbit.oscillator.span / 3)
            end = moved(orbit, mpf(0), mpf(0))
            assert abs(end[0] - u) + abs(end[1] - v) < ROUNDING
            h = mpf(10) ** -15
            rows = []
            for step in ((h, mpf(0)), (mpf(0), h)):
                ahead, behind = moved(orbit, *step), moved(orbit, -step[0], -step[1])
                rows.append([(ahead[i] - behind[i]) / (2 * h) for i in (0, 1)])
            (a, c), (b, d) = rows
            assert abs(a + d - orbit.trace) < mpf(10) ** -25
            assert abs(a * d - b * c - orbit.determinant) < mpf(10) ** -25
            assert abs(sum(orbit.multipliers) - orbit.trace) < ROUNDING


def test_two_orbits_meet_at_the_fold() -> None:
    with mp.workdps(60):
        one = CASES["one of two"]
        near = [
            orbit.multipliers for orbit in orbits(one._replace(gap=one.fold * (1 - mpf(10) ** -20)))
        ]
        assert len(near) == 2
        assert all(min(abs(m - 1) for m in pair) < mpf(10) ** -8 for pair in near)
        assert orbits(one._replace(gap=one.fold * (1 + mpf(10) ** -20))) == []


def test_a_multiplier_is_minus_one_where_the_period_doubles() -> None:
    one = Oscillator(0.4, 0.0, 0.8, 0.0)
    with mp.workdps(30):
        frequency = doubling(one, 0.3, 0.44)
        stable = [o for o in orbits(one._replace(frequency=frequency)) if o.velocity > 0]
        assert any(min(abs(m + 1) for m in orbit.multipliers) < mpf(10) ** -20 for orbit in stable)
        assert all(orbit.possible for orbit in stable)
