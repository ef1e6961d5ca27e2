"""What one channel tells by itself."""

from __future__ import annotations

import numpy as np
import pytest

from vibroimpact.identification.sensor_channel import doubt, integrated, noise_of_channel

TIME = np.arange(2000) / 200.0


def test_the_noise_is_told_whatever_the_signal() -> None:
    random = np.random.default_rng(3)
    noise = 0.01 * random.standard_normal(len(TIME))
    for signal in (0.0 * TIME, np.sin(2.0 * np.pi * TIME), TIME**2):
        assert noise_of_channel(signal + noise) == pytest.approx(0.01, rel=0.1)
    assert noise_of_channel(TIME[:7]) == 0.0


def test_an_integral_has_neither_mean_nor_drift() -> None:
    wanted = np.sin(2.0 * np.pi * TIME) / (2.0 * np.pi)
    wanted -= np.polyval(np.polyfit(TIME, wanted, 2), TIME)
    integral = integrated(TIME, np.cos(2.0 * np.pi * TIME) + 0.3)
    np.testing.assert_allclose(integral, wanted, atol=1e-4)


def test_samples_beside_a_jump_count_less():
    values = np.sin(np.arange(60) / 8.0)
    smooth = doubt(values, 1e-3)
    assert (smooth == 1.0).all()
    values[30:] -= 0.4
    jumped = doubt(values, 1e-3)
    assert np.flatnonzero(jumped > 1.0).tolist() == [29, 30]
    assert jumped[29] == pytest.approx(200.0, rel=0.2)  # half the jump
