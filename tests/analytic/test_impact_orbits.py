"""Orbits with one impact in n cycles, their multipliers, folds and period doublings."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import findroot, mp, mpf

import vibroimpact as vi
from reference.impact_orbits import Orbit, Oscillator, orbits, possible_orbits
from reference.public_motion import events
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


def rig(one: Oscillator, side: str = "right") -> vi.Oscillator:
    wall = vi.RigidStop(one.restitution, one.gap)
    return vi.Oscillator(1.0, vi.Isolator(1.0, one.damping), **{side: wall})


def section(orbit: Orbit) -> tuple[vi.Harmonic, vi.State]:
    """A third of the period behind the impact."""
    u, v, phase = (float(x) for x in orbit.after(orbit.oscillator.span / 3))
    return vi.Harmonic(1.0, orbit.oscillator.frequency, phase), vi.State(u, v)


def largest(data, count: int = 2) -> list[complex]:
    real, imaginary = data["multiplier_real"].values, data["multiplier_imag"].values
    multipliers = sorted((complex(a, b) for a, b in zip(real, imaginary, strict=True)), key=abs)
    return multipliers[::-1][:count]


@pytest.mark.parametrize("name", sample([*CASES], [*CASES][::2]))
def test_orbit_and_multipliers(name: str) -> None:
    one = CASES[name]
    with mp.workdps(30):
        candidates = possible_orbits(one)
        assert candidates
        for orbit in candidates:
            shaken, start = section(orbit)
            near = start.replace(velocity=start.velocity * (1 + 1e-4))
            data = vi.orbit(vi.Rig(rig(one), shaken), near, one.cycles)
            state = data["final_state"]
            assert float(state[0]) == pytest.approx(start.displacement, abs=1e-11)
            assert float(state[1]) == pytest.approx(start.velocity, abs=1e-11)
            impact, *more = events(data)
            assert (impact.kind, more) == ("impact_right", [])
            assert impact.u == one.gap
            assert impact.v == pytest.approx(float(orbit.velocity), rel=1e-11)
            assert int(data["stable"]) == int(max(map(abs, orbit.multipliers)) < 1)
            exact = sorted((complex(m) for m in orbit.multipliers), key=lambda m: (abs(m), m.imag))
            shown = sorted(largest(data), key=lambda m: (abs(m), m.imag))
            if abs(exact[0] - exact[1]) > 1e-3:
                np.testing.assert_allclose(shown, exact, atol=1e-9 * max(1.0, abs(exact[1])))
            assert sum(shown) == pytest.approx(complex(orbit.trace), abs=1e-9)
            assert math.prod(shown) == pytest.approx(complex(orbit.determinant), abs=1e-9)


@pytest.mark.parametrize("name", ["resonant", "no gap", "every second cycle", "mass held away"])
@pytest.mark.parametrize("side", sample(["right", "left"], ["left"]))
def test_a_stable_orbit_is_settled_on(name: str, side: str) -> None:
    one = CASES[name]
    with mp.workdps(30):
        (orbit,) = [o for o in possible_orbits(one) if max(map(abs, o.multipliers)) < 1]
        shaken, start = section(orbit)
    sign = 1 if side == "right" else -1
    shaken = shaken.replace(phase=shaken.phase + (0.0 if sign == 1 else math.pi))
    near = vi.State(sign * start.displacement, sign * start.velocity * 1.001)
    data = vi.steady(vi.Rig(rig(one, side), shaken), near)
    assert int(data["period"]) == one.cycles
    assert str(data["motion"].values) == "periodic"
    assert float(data["final_state"][1]) == pytest.approx(sign * start.velocity, abs=1e-9)
    # The exponents are the logarithms of the multipliers.
    moduli = sorted((float(abs(m)) for m in orbit.multipliers), reverse=True)
    rate = np.log(moduli) / float(one.span)
    np.testing.assert_allclose(np.sort(data["exponents"].values)[::-1], rate, atol=1e-8)


def test_exponents_sum_to_damping_and_impacts() -> None:
    """Each impact takes the area times e², the isolator exp(-C/M t)."""
    one = CASES["resonant"]
    data = vi.lyapunov_exponents([vi.Rig(rig(one), 1.0)], [one.frequency], 3000)
    total = float(data["exponents"].sum())
    assert total == pytest.approx(2 * math.log(one.restitution) * one.frequency - 0.1, abs=1e-6)


def test_a_branch_turns_back_at_the_fold() -> None:
    one = CASES["one of two"]
    with mp.workdps(30):
        (orbit,) = [o for o in possible_orbits(one) if max(map(abs, o.multipliers)) < 1]
        shaken, start = section(orbit)
        fold = float(one.fold)
    data = vi.branch(vi.Rig(rig(one), shaken), start, vary={"gap": (0.1, 0.6)})
    kinds = data["bifurcation_kind"].values
    at = data["bifurcation_value"].values[kinds == "fold"]
    assert np.abs(at - fold).min() < 1e-10
    # All along it agrees with the closed form, the unstable half included.
    with mp.workdps(30):
        unstable = 0
        for i in range(0, data.sizes["point"], 5):
            gap = float(data["gap"][i])
            if not (0.15 < gap < fold - 1e-6) or float(data["impacts"].sel(stop="right")[i]) != 1.0:
                continue
            exact = [complex(o.trace) for o in orbits(one._replace(gap=gap)) if o.velocity > 0]
            shown = sum(largest(data.isel(point=i)))
            assert min(abs(shown - trace) for trace in exact) < 1e-7 * max(1.0, abs(shown))
            unstable += int(data["stable"][i]) == 0
    assert unstable > 0


def test_the_period_doubles_where_a_multiplier_is_minus_one() -> None:
    one = Oscillator(0.35, 0.1, 0.65, 0.1)
    with mp.workdps(30):

        def margin(gap: mpf) -> mpf:
            (orbit,) = [o for o in orbits(one._replace(gap=gap)) if o.velocity > 0]
            return 1 + orbit.trace + orbit.determinant

        doubling = float(findroot(margin, (mpf("0.2"), mpf("0.25")), solver="anderson"))
        (orbit,) = possible_orbits(one)
        shaken, start = section(orbit)
    data = vi.branch(vi.Rig(rig(one), shaken), start, vary={"gap": (0.05, 0.25)})
    kinds = data["bifurcation_kind"].values
    at = data["bifurcation_value"].values[kinds == "period doubling"]
    assert np.abs(at - doubling).min() < 1e-10
    for gap, stable in ((doubling - 1e-3, 1), (doubling + 1e-3, 0)):
        with mp.workdps(30):
            (orbit,) = possible_orbits(one._replace(gap=gap))
            shaken, start = section(orbit)
        beside = vi.orbit(vi.Rig(rig(one._replace(gap=gap)), shaken), start)
        assert int(beside["stable"]) == stable
