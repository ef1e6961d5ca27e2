"""States at the start: deduced from their rig, or refused if they contradict it."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.response.engine_input import as_state, components, engine_state

CASE = vi.laboratory.case("B2-G1-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 1.1, 0.4)


def test_a_contact_that_would_pull_is_refused() -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.3), vi.Bumper(20.0, 4.0, 0.0))
    start = vi.State(0.1, -0.9, contact=1)
    message = r"start\.contact: 1 \(right stop\), but the right bumper would pull"
    with pytest.raises(vi.InputError, match=message):
        vi.simulate(vi.Rig(rig, vi.Harmonic(50.0, 0.2)), 1, start)


def test_an_elastic_bumper_cannot_lag_behind() -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.3), vi.Bumper(20.0, 0.0, 1.0))
    message = r"start\.contact: 0 \(no contact\), but the mass compresses"
    with pytest.raises(vi.InputError, match=message):
        vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 0.2)), 1, vi.State(1.5, 0.1, contact=0))


@pytest.mark.parametrize(
    ("start", "message"),
    [
        (
            vi.State(0.02, deformation={"right": 0.001}),
            "start.deformation.right: 0.001 m, but a displacement of 0.02 m compresses",
        ),
        (
            vi.State(-0.02, deformation={"left": 0.001}),
            "start.deformation.left: 0.001 m, but a displacement of -0.02 m compresses",
        ),
        (
            vi.State(0.0, contact=1),
            "start.contact: 1 (right stop), but the right bumper is 0.0075 m away",
        ),
        ({"displacement": 0.0}, "start: {'displacement': 0.0} is not a state"),
        (xr.DataArray([0.0, 1.0]), "start: <xarray.DataArray (dim_0: 2)> Size: 16B array([0., 1."),
    ],
)
def test_bad_starts(start: object, message: str) -> None:
    with pytest.raises(vi.InputError) as caught:
        vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 1, start)
    assert str(caught.value).startswith(message)
    assert "; pass " in str(caught.value)
    assert "\n" not in str(caught.value)


def test_starts_on_absent_bumpers() -> None:
    rig = CASE.oscillator.replace(right=None)
    message = r"^start.deformation.right: 0.001 m, but .* has no right bumper"
    with pytest.raises(vi.InputError, match=message):
        vi.simulate(vi.Rig(rig, SHAKEN), 1, vi.State(deformation={"right": 0.001}))
    message = r"^start.contact: 1 \(right stop\), but .* has no right stop"
    with pytest.raises(vi.InputError, match=message):
        vi.simulate(vi.Rig(rig, SHAKEN), 1, vi.State(contact=1))
    vi.simulate(vi.Rig(rig, SHAKEN), 1, vi.State(deformation={"right": 0.0}))


@pytest.mark.parametrize(("pressed", "force"), [("left", -2.0), ("right", 2.0)])
def test_the_state_of_a_dataset_is_that_of_its_last_sample(pressed: str, force: float) -> None:
    """Of each stop by its name: how far it is compressed, and whether it is touched."""
    rig = vi.Rig(
        vi.Oscillator(
            1.0, vi.Isolator(1.0, 0.1), vi.Bumper(9.0, 2.0, 0.1), vi.Bumper(8.0, 2.0, 0.2), force
        ),
        vi.Harmonic(0.5, 0.3),
    )
    deepest = 0.0
    for cycles in (3.2, 3.4, 3.7, 5.9):
        motion = vi.simulate(rig, cycles, samples=10)
        for stop in ("right", "left"):
            for name in ("deformation", "touching"):
                last = motion[name].sel(stop=stop).values[-1]
                state = motion["final_state"].sel(component=f"{name}.{stop}")
                assert float(state) == last >= 0.0
        deepest = max(deepest, float(motion["deformation"].sel(stop=pressed).values[-1]))
        again = as_state(motion["final_state"])
        vector = engine_state(rig.system, again)
        phase = float(motion["final_state"].sel(component="phase"))
        np.testing.assert_array_equal(components(vector, phase), motion["final_state"])
    assert deepest > 0.01
