"""Siconos's bar and beads, and the averaging of an energy sink: what differs, and who is right."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from literature.comparisons import assemblies as known


def test_ten_touching_beads_of_siconos() -> None:
    """They rebound as one, in its event-driven solver and by impacts one after the other."""
    positions, velocities = known.beads()
    q, v = map(float, known.LOWEST_BEAD)
    assert positions == pytest.approx(q, rel=1e-12)
    assert velocities == pytest.approx(v, rel=1e-12)


def stepped(consistent: bool, step: float) -> NDArray[np.float64]:
    """Time and reaction of each step with contact, after Moreau and Jean with θ = 1/2."""
    mass, stiffness = known.bar_matrices(consistent)
    ease = np.linalg.inv(mass + 0.25 * step**2 * stiffness)
    spring, kick = ease @ stiffness, ease[:, 0]
    q, v = (np.full(known.NODES, x) for x in (known.BAR_GAP, -known.BAR_SPEED))
    contacts, begin = [], 1e-8
    for i in range(1, int((0.0015 - begin) / step)):
        after = v - step * (spring @ (q + 0.5 * step * v))
        impulse = 0.0
        if q[0] <= -1e-14 and after[0] < 0.0:
            impulse = -after[0] / kick[0]
            after = after + kick * impulse
            contacts.append((begin + i * step, impulse / step))
        q, v = q + 0.5 * step * (v + after), after
    return np.array(contacts)


def test_the_bar_of_siconos() -> None:
    """Its time step makes the contact late and long: with smaller ones it is ours.

    Its file has reactions from 5.0401e-4 s on, the first row without one at 8.8801e-4 s, some
    1270.8 N in between, and an impulse of 0.481427422 N s. The bar has 99 elements of a hundredth
    of a metre, so that the continuum's 1270.83 N last 2 · 0.99 m/c and not 2 m/c.
    """
    theirs = stepped(True, known.BAR_STEP)
    assert theirs[0, 0] == pytest.approx(5.0401e-4, rel=1e-9)
    assert theirs[-1, 0] + known.BAR_STEP == pytest.approx(8.8801e-4, rel=1e-9)
    assert theirs[:, 1].sum() * known.BAR_STEP == pytest.approx(0.48142742207, rel=1e-9)
    assert np.median(theirs[:, 1]) == pytest.approx(1270.789242708, rel=1e-7)
    wave = np.sqrt(known.MODULUS / known.DENSITY)
    force = known.SECTION * known.BAR_SPEED * known.MODULUS / wave
    assert np.median(theirs[:, 1]) == pytest.approx(force, rel=5e-5)
    for consistent in (True, False):
        first, last, impulse = known.bar(consistent)
        assert first == pytest.approx(known.BAR_GAP / known.BAR_SPEED, rel=1e-7)
        # The front of the wave is smeared over some elements.
        assert last - first == pytest.approx(2 * 0.99 / wave, rel=0.01)
        step = known.BAR_STEP / 16
        finer = stepped(consistent, step)
        assert finer[0, 0] == pytest.approx(first, abs=3 * step)
        assert finer[-1, 0] == pytest.approx(last, abs=3 * step)
        assert finer[:, 1].sum() * step == pytest.approx(impulse, rel=1e-4)


def test_averaging_an_energy_sink_is_off_by_the_ratio_of_masses() -> None:
    """By 0.9 % of the amplitude at the ratio of 0.02 of Weidemann, Bergman, Vakakis and Krack."""
    shares = [
        abs(known.averaged_sink(1.0 - 0.75 * ratio, ratio))
        / known.exact_sink(1.0 - 0.75 * ratio, ratio)
        - 1.0
        for ratio in (0.02, 0.01, 0.005)
    ]
    assert shares[0] == pytest.approx(0.0090, abs=0.0002)
    assert np.array(shares[:-1]) / shares[1:] == pytest.approx(2.0, rel=0.1)


@pytest.mark.filterwarnings("ignore:simulate stopped")
def test_the_bar_of_siconos_without_a_push() -> None:
    assert known.bar(pushed=0.0)[1] == pytest.approx(known.bar()[1], rel=1e-6)
