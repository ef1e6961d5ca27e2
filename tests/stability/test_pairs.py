"""Complex pairs of multipliers that pass the unit circle just before they become real."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi


def test_a_pair_that_passes_the_circle_and_becomes_real_within_a_step():
    """A stiff elastic stop on one side, a soft one with much damping on the other.

    The pair is complex, of modulus 0.93, at one point of the branch, and real, 1.06 and 1.43, at
    the next one.
    """
    rig = vi.Oscillator(
        1.0, vi.Isolator(1.0, 0.8), vi.Bumper(1000.0, 0.0, 0.0), vi.Bumper(0.01, 20.1, 0.0)
    )
    shaken = vi.Harmonic(1.0, 0.5 / np.pi)
    data = vi.branch(vi.Rig(rig, shaken), vary={"frequency": (0.12, 0.16)}, most_points=400)
    assert "unexplained_changes" not in data.attrs
    kinds = data["bifurcation_kind"].values
    first = data.isel(bifurcation=int((kinds == "Neimark-Sacker").argmax()))
    assert first["bifurcation_value"].item() == pytest.approx(0.122423, abs=1e-6)
    moduli = np.hypot(first["bifurcation_multiplier_real"], first["bifurcation_multiplier_imag"])
    np.testing.assert_allclose(moduli[:2], 1.0, rtol=1e-6)
    # Modulus 1 is where stability changes: the orbits beside it, by their own multipliers.
    arclength = data["arclength"].values - first["bifurcation_arclength"].item()
    before, after = (
        data["stable"].values[side][at] for side, at in ((arclength < 0, -1), (arclength > 0, 0))
    )
    assert (before, after) == (1, 0)
