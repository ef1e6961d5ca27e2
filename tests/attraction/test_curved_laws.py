"""Basins of laws that no closed form follows, against following each state to its end."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample

BUMPER = vi.Bumper(40.0, 0.4, 1.0)
CONTACT = vi.PowerBumper(stiffness=60.0, gap=0.5, exponent=1.5, dissipation=0.2)
# The larger motion presses it at the section, with the speed at which it was met to remember.
RESTITUTING = vi.PowerBumper(stiffness=60.0, gap=0.5, exponent=1.5, restitution=0.7)
DAMPED = vi.Isolator(1.0, 0.06)
LAWS = {
    # Isolator, stops, amplitude, angular frequency, and the periods of the motions.
    "hardening": (vi.PolynomialIsolator(1.0, 0.08, 0.5), None, None, 0.5, 1.6, [1, 1]),
    "friction": (vi.FrictionIsolator(1.0, 0.05, 0.1), BUMPER, None, 1.5, 2.8, [2, 1]),
    "power": (DAMPED, CONTACT, CONTACT, 1.0, 2.8, [1, 1]),
    "restitution": (DAMPED, RESTITUTING, RESTITUTING, 1.0, 2.8, [1, 1]),
    "bouc-wen": (vi.BoucWenIsolator(2.0, 0.5, 0.1, 0.05), BUMPER, None, 1.5, 1.4, [3, 1]),
}


@pytest.mark.parametrize("law", sample([*LAWS], [*LAWS][:4:2]))
def test_as_each_state_followed_to_the_end_by_steady(law):
    isolator, right, left, amplitude, omega, periods = LAWS[law]
    rig = vi.Oscillator(1.0, isolator, right, left)
    shaking = vi.Harmonic(amplitude, omega / (2.0 * np.pi))
    data = vi.basins(vi.Rig(rig, shaking), (-3.0, 3.0), (-3.0, 3.0), nodes=sample(10, 6))
    assert list(data["period"].values) == periods
    assert (data["share"] > 0.0).all()
    for v in data["velocity"].values:
        for u in data["displacement"].values:
            number = int(data["basin"].sel(displacement=u, velocity=v))
            alone = vi.steady(vi.Rig(rig, shaking), vi.State(u, v), 1)
            size = float(data["displacement_excursion"][number])
            assert float(alone["displacement_excursion"]) == pytest.approx(size, rel=1e-6)
