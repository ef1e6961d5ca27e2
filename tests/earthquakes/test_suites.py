"""Fractiles and shares of suites whose distribution is known."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.made import lognormal, suite
from earthquakes.rigs import RIGS, noise

SCALES = np.linspace(0.1, 3.0, 15)


def test_fractiles_of_a_known_distribution() -> None:
    """Of 4,000 records: the p-quantile of scale · exp(βN) is scale · exp(β Φ⁻¹(p))."""
    data = lognormal(np.random.default_rng(1), 4000, SCALES, 0.5)
    fractiles = vi.fractiles(data, shares=(0.16, 0.5, 0.84))["peak_displacement"]
    assert fractiles.dims == ("fractile", "scale")
    for share, normal in ((0.16, -0.99446), (0.5, 0.0), (0.84, 0.99446)):
        ratio = fractiles.sel(fractile=share).values / (SCALES * math.exp(0.5 * normal))
        # The standard error of a quantile, with the density of N at it.
        density = math.exp(-0.5 * normal**2) / math.sqrt(math.tau)
        error = 0.5 * math.sqrt(share * (1.0 - share) / 4000) / density
        assert np.abs(np.log(ratio)).max() < 4.0 * error
    assert fractiles.attrs["units"] == "m"


def test_fractiles_of_a_few_are_between_them() -> None:
    data = suite(np.array([[1.0], [2.0], [4.0]]), np.array([1.0]))
    fractiles = vi.fractiles(data, shares=(0.0, 0.25, 0.5, 1.0))["peak_displacement"].values[:, 0]
    np.testing.assert_allclose(fractiles, [1.0, 1.5, 2.0, 4.0])


def test_what_went_beyond_all_limits_is_infinite_and_others_are_refused() -> None:
    data = suite(np.array([[1.0], [2.0], [np.nan]]), np.array([1.0]))
    data["status"].values[2] = 6
    fractiles = vi.fractiles(data, shares=(0.5, 0.9))["peak_displacement"].values[:, 0]
    assert fractiles.tolist() == [2.0, np.inf]
    assert float(vi.exceedance(data, "peak_displacement", 1.5)["probability"][0]) == 2.0 / 3.0
    data["status"].values[2] = 2
    with pytest.raises(
        vi.InputError, match=r"^demands: 1 of .* runs could not be computed: .*max_events"
    ):
        vi.fractiles(data)


def test_the_probability_of_impact() -> None:
    records = [noise(seed, count=120) for seed in range(8, 13)]
    data = vi.demands(RIGS["bumpers"], records, [0.1, 0.3, 1.0], vary={"gap": [0.02, 0.1]})
    impact = vi.exceedance(data, "impact_count")
    assert impact["probability"].dims == ("scale", "gap")
    hits = (data["displacement_max"] > data["gap"]) | ((-data["displacement_min"]) > data["gap"])
    np.testing.assert_array_equal(impact["exceeding"], hits.sum("record").transpose("scale", "gap"))
    assert impact["probability"].values[-1, 0] == 1.0
    assert 0 < int(impact["exceeding"].sum()) < 30
    assert impact["gap"].attrs["units"] == "m"
    assert impact["scale"].attrs["long_name"] == "factor of the record"


def test_wrong_input() -> None:
    data = lognormal(np.random.default_rng(1), 5, SCALES, 0.5)
    for ask, line in (
        (lambda: vi.fractiles(3), "demands: 3; pass the result of the function demands"),
        (lambda: vi.fractiles(data, "peak"), "quantity: 'peak' is unknown; use peak_displacement"),
        (lambda: vi.fractiles(data, shares=(1.2,)), r"shares\[0\]: 1.2"),
        (lambda: vi.fractiles(data, shares=()), "shares: the list is empty"),
        (lambda: vi.exceedance(data, "peak_displacement", "3 kg"), "limit: '3 kg'"),
        (
            lambda: vi.exceedance(data, "peak_displacement"),
            "limit: missing; pass the limit of peak_disp",
        ),
    ):
        with pytest.raises(vi.InputError, match=f"^{line}"):
            ask()
