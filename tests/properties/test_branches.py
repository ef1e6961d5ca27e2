"""Branches of random rigs: made of orbits, and with an end that is told."""

from __future__ import annotations

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

import vibroimpact as vi
from properties.strategies import Motion, examples, motions

ENDS = (
    "the range ends at",
    "it is closed",
    "it meets the orbits",
    "no orbit could be found",
    "400 points",
    "orbits are not isolated",
    "the motion grows",
)


@examples(25)
@given(motions(least_damping=0.03, most_damping=0.4), st.floats(0.0, 6.28))
def test_every_point_comes_back_to_itself(motion: Motion, phase: float) -> None:
    rig = motion.oscillator
    shaken = motion.excitation.replace(phase=phase)
    low, high = 0.6 * shaken.frequency, 1.5 * shaken.frequency
    try:
        data = vi.branch(vi.Rig(rig, shaken), vary={"frequency": (low, high)}, most_points=400)
    except vi.InputError:  # the motion from rest does not settle
        assume(False)
    for name in ("ended_low", "ended_high"):
        assert data.attrs[name].startswith(ENDS)
    assert "unexplained_changes" not in data.attrs  # nor a warning, which would be an error
    assert np.isfinite(data["displacement_excursion"]).all()
    assert float(data["frequency"].min()) >= low * (1 - 1e-12)
    assert float(data["frequency"].max()) <= high * (1 + 1e-12)
    for i in np.linspace(0, data.sizes["point"] - 1, 5).astype(int):
        state = data["section"].isel(point=i)
        here = vi.Harmonic(shaken.amplitude, float(data["frequency"][i]), float(state[4]))
        moved = vi.simulate(vi.Rig(rig, here), int(data["period"][i]), state, 0)["final_state"]
        largest = np.hypot(*(data[f"multiplier_{part}"][i] for part in ("real", "imag"))).max()
        size = float(data["displacement_excursion"][i])
        scale = np.array([size, size * here.angular_frequency])
        error = np.abs((moved - state).values[:2]) / scale
        assert error.max() < 1e-9 * max(1.0, float(largest))
