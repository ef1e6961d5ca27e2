"""A wrong model is noticed, and what the data do not tell is said."""

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from identification.twins import EXCURSIONS, FREE, curves
from samples import sample
from vibroimpact.identification.comparison import hertzian
from vibroimpact.measurements.read import as_measured

CASE = vi.laboratory.case("B2-G1-A3", "identified")


@pytest.mark.full
def test_a_hertzian_bumper_fitted_by_a_linear_one_is_noticed():
    rig = hertzian(CASE.oscillator, 3e-3)
    data = curves(rig, CASE.amplitude, 0.02, seed=0, frequencies=np.arange(1.0, 4.01, 0.1))
    start = CASE.oscillator
    linear = vi.identify(start, data, FREE, profiles=False, tried=0, starts=1)
    assert "the residuals are not noise" in linear.attrs["findings"]
    right = CASE.oscillator.replace(right=rig.right, left=rig.left)
    again = vi.identify(
        right,
        data,
        "isolator.stiffness,isolator.damping,stops.stiffness,stops.dissipation,gap",
        profiles=False,
        tried=0,
        starts=1,
    )
    assert "the residuals are not noise" not in again.attrs["findings"]
    comparison = vi.compare_fits({"linear": linear, "Hertz": again})
    assert comparison.model.values.tolist() == ["Hertz", "linear"]
    assert "the data do not support this model" in comparison.attrs["findings"]


def test_a_bumper_that_is_never_touched_is_not_determined():
    grid = np.arange(3.0, 5.0, 0.1)
    data = curves(CASE.oscillator, CASE.amplitude, 0.02, frequencies=grid)
    fit = vi.identify(CASE.oscillator, data, "isolator.stiffness,stops.damping", tried=0, starts=1)
    assert "stops.damping (damping of both bumpers) is" in fit.attrs["findings"]
    assert fit.interval_open.sel(parameter="stops.damping").values.any()
    assert not fit.interval_open.sel(parameter="isolator.stiffness").values.any()


@pytest.mark.full
def test_the_posterior_is_as_wide_as_the_covariance():
    pytest.importorskip("emcee")
    case = vi.laboratory.case("B2-G2-A2", "identified")
    data = curves(case.oscillator, case.amplitude, 0.02, seed=1)
    fit = vi.identify(
        case.oscillator,
        data,
        "isolator.stiffness,gap",
        tried=0,
        starts=1,
        posterior=600,
        profiles=False,
    )
    drawn = fit.posterior_value.std("posterior_draw").values
    assert drawn == pytest.approx(fit.standard_error.values, rel=0.3)


def test_intervals_hold_the_truth_as_often_as_they_say():
    case = vi.laboratory.case("B2-G2-A2", "identified")
    clean = vi.sweep(case, np.round(np.arange(0.5, 5.01, 0.1), 10))
    true = [31900.0, 1100.0, 510e3, 0.01]
    held = []
    for seed in range(sample(200, 4)):
        draw = np.random.default_rng(seed)
        noisy = {n: clean[n] * (1.0 + 0.02 * draw.normal(size=(2, 46))) for n in EXCURSIONS}
        data = as_measured(xr.Dataset(noisy).assign_attrs(amplitude=case.amplitude))
        fit = vi.identify(
            case.oscillator,
            data,
            "isolator.stiffness,isolator.damping,stops.stiffness,gap",
            tried=0,
            starts=1,
            profiles=False,
        )
        low, high = fit.interval.values.T
        held.append((low <= true) & (true <= high))
    share = np.mean(held)
    assert sample(0.91, 0.7) <= share <= sample(0.98, 1.0)
