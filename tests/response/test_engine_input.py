"""States at the start: deduced from their rig, or refused if they contradict it."""

from __future__ import annotations

import pytest
import xarray as xr

import vibroimpact as vi

CASE = vi.laboratory.case("B2-G1-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 1.1, 0.4)


def test_a_contact_that_would_pull_is_refused() -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.3), vi.Bumper(20.0, 4.0, 0.0))
    start = vi.State(0.1, -0.9, contact=1)
    told = r"start\.contact: 1 \(right stop\), but the right bumper would pull"
    with pytest.raises(vi.InputError, match=told):
        vi.simulate(vi.Rig(rig, vi.Harmonic(50.0, 0.2)), 1, start)


def test_an_elastic_bumper_cannot_lag_behind() -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.3), vi.Bumper(20.0, 0.0, 1.0))
    told = r"start\.contact: 0 \(no contact\), but the mass compresses"
    with pytest.raises(vi.InputError, match=told):
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
    told = r"^start.deformation.right: 0.001 m, but .* has no right bumper"
    with pytest.raises(vi.InputError, match=told):
        vi.simulate(vi.Rig(rig, SHAKEN), 1, vi.State(deformation={"right": 0.001}))
    told = r"^start.contact: 1 \(right stop\), but .* has no right stop"
    with pytest.raises(vi.InputError, match=told):
        vi.simulate(vi.Rig(rig, SHAKEN), 1, vi.State(contact=1))
    vi.simulate(vi.Rig(rig, SHAKEN), 1, vi.State(deformation={"right": 0.0}))
