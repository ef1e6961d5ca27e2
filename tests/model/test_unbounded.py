"""Resonance without bound: where 4 Q/π of an isolator's bounded force no longer holds it."""

from __future__ import annotations

import math

import pytest

import vibroimpact as vi
from vibroimpact.model.unbounded import grows, has_no_bound

MASS = 2.0
SPRING, HELD = 3.0, 0.4
"""K in N/m and Q in N of all isolators here."""
NATURAL = math.sqrt(SPRING / MASS) / math.tau
BOUND = 4.0 * HELD / (math.pi * MASS)
"""Amplitude (m/s²) of a sine above which there is no bound."""

LAWS = {
    "friction": vi.FrictionIsolator(SPRING, 0.0, HELD),
    "bilinear": vi.BilinearIsolator(
        elastic_stiffness=4.0 * SPRING,
        post_yield_stiffness=SPRING,
        yield_force=HELD / 0.75,
        damping=0.0,
    ),
    "Bouc-Wen": vi.BoucWenIsolator(
        elastic_stiffness=4.0 * SPRING,
        post_yield_stiffness=SPRING,
        yield_force=HELD / 0.75,
        damping=0.0,
    ),
    "exponential": vi.ExponentialIsolator(
        reversal_stiffness=SPRING + 8.0, final_stiffness=SPRING, decay=10.0, damping=0.0
    ),
}


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_the_bound_of_one_sine(law):
    rig = vi.Oscillator(MASS, law)
    for share, beyond in ((0.999, False), (1.001, True)):
        assert has_no_bound(vi.Rig(rig, vi.Harmonic(share * BOUND, 1.0))) is beyond
        assert grows(vi.Rig(rig, vi.Harmonic(share * BOUND, 1.0)), NATURAL, 1e-12) == int(beyond)
    assert grows(vi.Rig(rig, vi.Harmonic(10.0 * BOUND, 1.0)), 1.01 * NATURAL, 1e-12) == 0


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_a_swing_beyond_it_grows_and_one_below_does_not(law):
    """Followed, with no formula: by how much the swing grows over as many cycles again."""
    rig = vi.Oscillator(MASS, law)
    swings = {}
    for share in (0.8, 1.3):
        data = vi.simulate(vi.Rig(rig, vi.Harmonic(share * BOUND, NATURAL)), cycles=400)
        u = abs(data["displacement"].values)
        swings[share] = u[len(u) // 2 :].max() / u[: len(u) // 2].max()
    assert swings[0.8] < 1.01
    assert swings[1.3] > 1.9


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_steady_refuses_it_and_gives_the_one_below(law):
    rig = vi.Oscillator(MASS, law)
    with pytest.raises(vi.InputError, match="bounded force is too small to hold the mass"):
        vi.steady(vi.Rig(rig, vi.Harmonic(1.01 * BOUND, NATURAL)))
    assert vi.steady(vi.Rig(rig, vi.Harmonic(0.9 * BOUND, NATURAL)))["motion"].item() == "periodic"


def test_each_harmonic_counts_by_its_own_size():
    rig = vi.Oscillator(MASS, LAWS["friction"])
    shaken = vi.Periodic(1.0, [0.5 * BOUND, 0.0, 1.5 * BOUND])
    assert grows(vi.Rig(rig, shaken), NATURAL, 1e-12) == 0
    assert grows(vi.Rig(rig, shaken), NATURAL / 3.0, 1e-12) == 3
    assert has_no_bound(vi.Rig(rig, shaken))


def test_a_dashpot_a_hardening_spring_and_a_stop_hold_it():
    shaken = vi.Harmonic(10.0 * BOUND, NATURAL)
    assert not has_no_bound(
        vi.Rig(vi.Oscillator(MASS, vi.FrictionIsolator(SPRING, 1e-3, HELD)), shaken)
    )
    assert not has_no_bound(
        vi.Rig(vi.Oscillator(MASS, vi.PolynomialIsolator(SPRING, 0.0, 1e-3)), shaken)
    )
    assert has_no_bound(
        vi.Rig(vi.Oscillator(MASS, vi.PolynomialIsolator(SPRING, 0.0, 0.0)), shaken)
    )
    held = vi.Oscillator(MASS, LAWS["friction"], vi.Bumper(30.0, 0.5, 0.2))
    assert vi.steady(vi.Rig(held, shaken))["displacement_max"] < 10.0
