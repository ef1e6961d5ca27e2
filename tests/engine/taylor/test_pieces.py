"""A stretch of Taylor steps in pieces: extremes and samples are those of the motion itself."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from engine.taylor.rigs import ISOLATORS, SHAKEN, between, followed, pairs, started
from samples import sample

FREQUENCY = 0.9 / math.tau
SAMPLES = 4096


@pytest.mark.full
@pytest.mark.parametrize(("isolator", "stop"), pairs("pounding"))
def test_extremes_are_just_above_those_of_dense_samples(isolator: str, stop: str) -> None:
    rig = between(isolator, stop)
    held = vi.sweep(vi.Rig(rig, 0.6), [FREQUENCY]).isel(direction=0, frequency=0)
    period = int(held["period"])
    assert period > 0
    shaken = vi.Harmonic(0.6, FREQUENCY)
    data = vi.simulate(vi.Rig(rig, shaken), period, held["section"], SAMPLES)
    for name in ("displacement", "acceleration"):
        seen = float(np.ptp(data[name].values))
        # An impact is missed by up to a step's way or change.
        loose = 5e-3 if stop == "rigid" or name == "acceleration" else 1e-4
        assert 1.0 - loose <= seen / float(held[f"{name}_excursion"]) <= 1.0 + 1e-9


@pytest.mark.parametrize(("isolator", "stop"), pairs("pounding"))
def test_samples_lie_on_the_motion(isolator: str, stop: str) -> None:
    rig = between(isolator, stop)
    data = vi.simulate(vi.Rig(rig, SHAKEN), 2, vi.State(0.1, 0.3), 37)
    for k in (1, 11, 30, 52, 74):
        end = followed(rig, SHAKEN, k / 37, started(rig, 0.1, 0.3))
        now = data.isel(time=k)
        point = [float(now["displacement"]), float(now["velocity"])]
        np.testing.assert_allclose(point, end[2:4], atol=1e-12)


@pytest.mark.parametrize("isolator", sample([*ISOLATORS], [*ISOLATORS][::3]))
def test_the_acceleration_is_that_of_the_velocity(isolator: str) -> None:
    """u′ sampled densely, its differences plus the shaking: the absolute acceleration."""
    data = vi.simulate(
        vi.Rig(between(isolator, "hunt-crossley"), SHAKEN), 1, vi.State(0.1, 0.3), SAMPLES
    )
    t, v = data["time"].values, data["velocity"].values
    relative = (v[2:] - v[:-2]) / (t[2:] - t[:-2])
    expected = relative + 0.6 * np.sin(0.9 * t[1:-1] + 0.4)
    errors = np.abs(expected - data["acceleration"].values[1:-1])
    assert np.quantile(errors, 0.95) < 1e-4  # friction and contacts make jumps
