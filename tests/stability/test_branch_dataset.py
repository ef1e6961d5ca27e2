"""What a dataset of branches says of its orbits."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from stability.followed import diagram


def test_an_orbit_without_extremes_is_told(monkeypatch):
    case = vi.laboratory.case("B2-G1-A3")
    monkeypatch.setattr("vibroimpact.stability.branch_dataset.MAX_EVENTS", 1)
    with pytest.warns(
        RuntimeWarning, match="largest values of the orbit at .* are unknown: .*max_events"
    ):
        data = vi.branch(
            vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 2.0)),
            vary={"frequency": (1.95, 2.05)},
        )
    assert data["eta_d"].isnull().any()


def test_every_point_is_an_orbit():
    """Simulated from its section for a period it comes back, stable or not."""
    case = vi.laboratory.case("B3-10mm-A3")
    data = diagram("B3-10mm-A3")
    for i in np.linspace(0, data.sizes["point"] - 1, 40).astype(int):
        state = data["section"].isel(point=i)
        shaken = vi.Harmonic(case.amplitude, float(data["frequency"][i]))
        period = int(data["period"][i])
        moved = vi.simulate(vi.Rig(case.oscillator, shaken), period, state, 0)["final_state"]
        growth = max(
            1.0,
            float(
                np.hypot(
                    *data.isel(point=i)[["multiplier_real", "multiplier_imag"]].to_array().values
                ).max()
            ),
        )
        np.testing.assert_allclose(moved[:2], state[:2], rtol=0, atol=1e-11 * growth)
