"""Fragility curves of suites whose median and dispersion are known, and how sure they are."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from samples import sample
from seismic.made import lognormal, suite
from seismic.rigs import RIGS, noise
from vibroimpact.seismic.fragility import fit

BETA = 0.4
SCALES = np.linspace(0.15, 3.0, 12)


def test_the_curve_of_a_large_suite_is_the_known_one() -> None:
    data = lognormal(np.random.default_rng(2), 3000, SCALES, BETA)
    found = vi.fragility(data, "peak_displacement", "1000 mm")
    assert float(found["median_capacity"]) == pytest.approx(1.0, abs=0.03)
    assert float(found["dispersion"]) == pytest.approx(BETA, abs=0.03)
    assert found["probability"].values == pytest.approx(found["fitted_probability"], abs=0.05)
    assert found["fitted_probability_bound"].dims == ("bound", "scale")


def test_the_likelihood_is_largest_there() -> None:
    """Of counts out of 40 records: any other curve is less likely."""
    exceeding = np.array([0, 0, 0, 4, 6, 13, 12, 16])
    logarithms = np.log([0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0])
    best = fit(exceeding, 40, logarithms)
    assert best is not None

    def likelihood(median: float, dispersion: float) -> float:
        z = (logarithms - math.log(median)) / dispersion
        p = np.array([0.5 * math.erfc(-one / math.sqrt(2.0)) for one in z])
        return float((exceeding * np.log(p) + (40 - exceeding) * np.log1p(-p)).sum())

    median, dispersion = math.exp(best.log_median), math.exp(best.log_dispersion)
    top = likelihood(median, dispersion)
    for step in (1e-3, 1e-2, 0.1):
        for a, b in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1)):
            assert likelihood(median * (1 + a * step), dispersion * (1 + b * step)) < top


def test_the_confidence_band_covers_what_is_known() -> None:
    """In nine of ten suites, within what so many replicates tell (and the jackknife's own error).

    Measured over 400 replicates with 15, 20 and 40 records: 0.88 to 0.90 for the median, 0.86 to
    0.89 for the dispersion, 0.85 to 0.94 for the curve at a scale.
    """
    replicates = sample(200, 40)
    rng = np.random.default_rng(4)
    true = np.array([0.5 * math.erfc(-math.log(s) / BETA / math.sqrt(2.0)) for s in SCALES])
    covered = np.zeros(2 + len(SCALES))
    for _ in range(replicates):
        found = vi.fragility(lognormal(rng, 20, SCALES, BETA), "peak_displacement", 1.0)
        for i, (name, value) in enumerate((("median_capacity", 1.0), ("dispersion", BETA))):
            low, high = found[f"{name}_bound"].values
            covered[i] += low <= value <= high
        low, high = found["fitted_probability_bound"].values
        covered[2:] += (low <= true) & (true <= high)
    error = 3.0 * math.sqrt(0.09 / replicates)
    assert (covered / replicates > 0.87 - error).all()
    assert (covered[2:] / replicates).mean() < 0.93 + error
    assert (covered[:2] / replicates < 0.93 + error).all()


def test_a_wider_confidence_is_wider() -> None:
    data = lognormal(np.random.default_rng(5), 20, SCALES, BETA)
    narrow, wide = (
        vi.fragility(data, "peak_displacement", 1.0, confidence=share)["median_capacity_bound"]
        for share in (0.5, 0.95)
    )
    assert float(wide[0]) < float(narrow[0]) < float(narrow[1]) < float(wide[1])


def test_without_overlap_there_is_no_curve() -> None:
    """All that exceed do so above all that do not: any steep curve between fits as well."""
    below, above = np.array([0.5, 0.6, 2.0]), np.array([0.5, 3.0, 2.0])
    scales = np.array([1.0, 2.0, 3.0])
    none = suite(np.array([below, below, below]), scales)
    finer = r"^limit: 1.0; there are no two levels .*; finer levels between 2 and 3 are accepted"
    with pytest.raises(vi.InputError, match=finer):
        vi.fragility(none, "peak_displacement", 1.0)
    one = suite(np.array([below, above, below]), scales)
    with pytest.raises(vi.InputError, match=finer.replace("2 and 3", "1 and 3")):
        vi.fragility(one, "peak_displacement", 1.0)
    with pytest.raises(vi.InputError, match=r"at no level is a record above the limit; higher"):
        vi.fragility(one, "peak_displacement", 10.0)
    with pytest.raises(vi.InputError, match=r"at every level all records are above the limit; lo"):
        vi.fragility(one, "peak_displacement", 0.1)
    counted = one.assign(impact_count=one["peak_displacement"] * 0.0)
    counted["impact_count"].attrs["units"] = "1"
    with pytest.raises(
        vi.InputError, match=r"^demands: at no level is a record above 0 in impact_"
    ):
        vi.fragility(counted, "impact_count")
    # With a scale more of each kind there is one; without the decisive record there is none.
    scales = np.array([1.0, 2.0, 3.0, 4.0])
    early, late = np.array([0.5, 2.0, 2.0, 2.0]), np.array([0.5, 0.6, 0.7, 2.0])
    decided = suite(np.array([early, late, early]), scales)
    with pytest.warns(
        RuntimeWarning, match=r"^fragility: no interval where one .* one: finer levels between 1 an"
    ):
        found = vi.fragility(decided, "peak_displacement", 1.0)
    assert found.attrs["unbounded"].endswith("finer levels between 1 and 4")
    assert 1.0 < float(found["median_capacity"]) < 4.0
    assert found["median_capacity_bound"].values.tolist() == [0.0, np.inf]
    assert found["fitted_probability_bound"].values[0].tolist() == [0.0] * 4


def test_what_would_bound_an_interval_is_told_by_curve() -> None:
    """Of three gaps: levels are too coarse, or end too early, or begin too late."""
    scales = np.array([1.0, 2.0, 3.0, 4.0])
    first, second, third = (
        np.array([[float(s >= begin) * 2.0 for s in scales] for begin in begins])
        for begins in ((2.0, 4.0, 2.0), (3.0, 5.0, 5.0), (2.0, 1.0, 1.0))
    )
    second[0, 3] = third[0, 0] = 0.5
    third[0, 2] = 0.5
    second[0] = [0.5, 0.5, 2.0, 0.5]
    data = xr.concat([suite(one, scales) for one in (first, second, third)], "gap")
    data = data.assign_coords(gap=[0.2, 0.3, 0.4]).transpose("record", "scale", "gap")
    with pytest.warns(RuntimeWarning, match="^fragility: no interval"):
        told = vi.fragility(data, "peak_displacement", 1.0).attrs["unbounded"]
    assert told == (
        "no interval where one record decides; what would give one: for gap 200 mm finer levels "
        "between 1 and 4; for gap 300 mm higher levels; for gap 400 mm lower levels"
    )
    rng = np.random.default_rng(5)
    sound = vi.fragility(lognormal(rng, 20, SCALES, BETA), "peak_displacement", 1.0)
    assert "unbounded" not in sound.attrs


def _gaps(*begins) -> xr.Dataset:
    """A gap each, and the level at which each record begins to hit it."""
    scales = np.array([1.0, 2.0, 3.0, 4.0])
    several = [
        suite(np.array([[2.0 * float(s >= begin) for s in scales] for begin in one]), scales)
        for one in begins
    ]
    data = xr.concat(several, "gap").assign_coords(gap=0.1 * np.arange(2, 2 + len(begins)))
    return data.transpose("record", "scale", "gap")


def test_which_of_several_have_no_curve_is_told() -> None:
    """As of one alone, which raises: levels too coarse, or all below or above."""
    fine = (1.0, 2.0, 3.0, 4.0, 2.0, 3.0)
    data = _gaps((2.0, 3.0, 3.0, 3.0, 3.0, 3.0), fine, (9.0,) * 6, (0.0,) * 6, (3.0,) * 6)
    with pytest.warns(RuntimeWarning, match=r"^fragility: no curve for gap 200 mm: ") as told:
        found = vi.fragility(data, "peak_displacement", 1.0)
    assert len(told) == 1
    none = "there are no two levels at which some records are above the limit and others are not; "
    reasons = {
        0.2: none + "finer levels between 1 and 3 are accepted",
        0.4: "at no level is a record above the limit; higher levels are accepted",
        0.5: "at every level all records are above the limit; lower levels are accepted",
        0.6: none + "finer levels between 2 and 3 are accepted",
    }
    assert found.attrs["undetermined"] == "; ".join(
        f"no curve for gap {1e3 * gap:g} mm: {why}" for gap, why in reasons.items()
    )
    assert str(told[0].message) == f"fragility: {found.attrs['undetermined']}"
    for i, gap in enumerate(data["gap"].values):
        lone = data.isel(gap=i, drop=True)
        if round(float(gap), 1) in reasons:
            assert np.isnan(found["median_capacity"][i])
            with pytest.raises(vi.InputError) as refused:
                vi.fragility(lone, "peak_displacement", 1.0)
            assert str(refused.value) == f"limit: 1.0; {reasons[round(float(gap), 1)]}"
        else:
            one = vi.fragility(lone, "peak_displacement", 1.0)
            assert float(one["median_capacity"]) == float(found["median_capacity"][i])
            assert "undetermined" not in one.attrs
    with pytest.warns(RuntimeWarning, match=r"; likewise 4 more curves$"):
        vi.fragility(_gaps(fine, *[(3.0,) * 6] * 9), "peak_displacement", 1.0)
    with pytest.raises(
        vi.InputError, match=r"^limit: 1.0; no curve for gap 200 mm: .*; no curve f"
    ):
        vi.fragility(data.isel(gap=[0, 2]), "peak_displacement", 1.0)


def test_a_share_that_does_not_rise_has_no_curve() -> None:
    scales = np.array([1.0, 2.0, 3.0])
    falls = suite(np.array([[2.0, 2.0, 0.5], [2.0, 0.5, 0.5], [2.0, 0.5, 2.0]]), scales)
    with pytest.raises(vi.InputError, match=r"that are above the limit does not rise with the lev"):
        vi.fragility(falls, "peak_displacement", 1.0)


def test_wrong_input() -> None:
    data = lognormal(np.random.default_rng(1), 5, SCALES, BETA)
    with pytest.raises(vi.InputError, match=r"^demands: 2 records; at least 3"):
        vi.fragility(data.isel(record=[0, 1]), "peak_displacement", 1.0)
    with pytest.raises(vi.InputError, match=r"^confidence: 1.5"):
        vi.fragility(data, "peak_displacement", 1.0, confidence=1.5)


def test_of_impact_itself_no_limit_is_asked() -> None:
    rig = RIGS["bumpers"]
    records = {str(seed): noise(seed, count=60) for seed in range(6)}
    data = vi.demands(rig, records, np.linspace(0.1, 1.5, 8))
    curve = vi.fragility(data, "impact_count")
    assert curve.identical(vi.fragility(data, "impact_count", 0))
    np.testing.assert_array_equal(curve["exceeding"], (data["impact_count"] > 0).sum("record"))
    with pytest.raises(vi.InputError, match=r"^limit: missing; a limit of peak_acceleration"):
        vi.fragility(data, "peak_acceleration")
