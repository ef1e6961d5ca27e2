"""Fragility curves of suites whose median and dispersion are known, and how sure they are."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr
from scipy import stats

import vibroimpact as vi
from earthquakes.made import lognormal, suite
from earthquakes.rigs import RIGS, noise
from samples import sample
from vibroimpact.earthquakes.credible_curves import begin_to_exceed, credible_curves
from vibroimpact.earthquakes.fragility import fit

BETA = 0.4
SCALES = np.linspace(0.15, 3.0, 12)


def test_the_curve_of_a_large_suite_is_the_known_one() -> None:
    data = lognormal(np.random.default_rng(2), 3000, SCALES, BETA)
    fragility = vi.fragility(data, "peak_displacement", "1000 mm")
    assert float(fragility["median_capacity"]) == pytest.approx(1.0, abs=0.03)
    assert float(fragility["dispersion"]) == pytest.approx(BETA, abs=0.03)
    assert fragility["probability"].values == pytest.approx(
        fragility["fitted_probability"], abs=0.05
    )
    assert fragility["fitted_probability_bound"].dims == ("bound", "scale")


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


@pytest.mark.parametrize(("records", "levels"), [(5, 12), (7, 8), (20, 12)])
def test_the_confidence_band_covers_what_is_known(records: int, levels: int) -> None:
    """In nine of ten suites, within what so many replicates tell.

    Measured over 600 replicates: 0.90 to 0.95 with 5 and 7 records, 0.89 to 0.92 with 20 and 40.
    """
    replicates = sample(200, 12)
    rng = np.random.default_rng(records)
    scales = np.linspace(0.15, 3.0, levels)
    true = np.array([0.5 * math.erfc(-math.log(s) / BETA / math.sqrt(2.0)) for s in scales])
    covered = np.zeros((replicates, 2 + levels))
    done = 0
    while done < replicates:
        capacities = np.exp(BETA * rng.standard_normal(records))
        exceeding = (capacities[:, np.newaxis] < scales).sum(axis=0)
        curves = credible_curves(exceeding, records, np.log(scales))
        if fit(exceeding, records, np.log(scales)) is None or curves is None:
            continue
        for i, (ends, value) in enumerate(
            ((curves.median_range(0.9), 1.0), (curves.dispersion_range(0.9), BETA))
        ):
            covered[done, i] = ends[0] <= value <= ends[1]
        low, high = curves.probability_range(np.log(scales), 0.9)
        covered[done, 2:] = (low <= true) & (true <= high)
        done += 1
    error = 3.0 * math.sqrt(0.09 / replicates)
    assert (covered.mean(axis=0) > 0.89 - error).all()
    assert (covered.mean(axis=0) < 0.95 + error).all()


def test_of_capacities_known_exactly_the_intervals_are_the_classical_ones() -> None:
    """Student's of the median, χ² of the dispersion, the non-central t of the curve.

    Levels are so fine that they tell the capacities to a thousandth of their dispersion.
    """
    logarithms = np.linspace(-3.0, 3.0, sample(6001, 1201))
    capacities = np.array([-0.63, -0.37, -0.21, 0.02, 0.11, 0.48, 0.93])
    count = len(capacities)
    exceeding = (capacities[:, np.newaxis] < logarithms).sum(axis=0)
    curves = credible_curves(exceeding, count, logarithms)
    assert curves is not None
    mean, spread = capacities.mean(), capacities.std(ddof=1)
    for confidence in (0.5, 0.9, 0.99):
        shares = np.array([0.5 - 0.5 * confidence, 0.5 + 0.5 * confidence])
        student = mean + spread / math.sqrt(count) * stats.t.ppf(shares, count - 1)
        bounds = np.log(curves.median_range(confidence))
        assert bounds == pytest.approx(student, abs=0.01 * np.ptp(student))
        chi = spread * np.sqrt((count - 1) / stats.chi2.ppf(shares[::-1], count - 1))
        assert curves.dispersion_range(confidence) == pytest.approx(chi, rel=0.01)
    for x in (-1.5, -0.4, 0.2, 1.0):
        low, high = curves.probability_range(np.array([x]), 0.9)[:, 0]
        # The share below x is p if (mean − x)/spread √n is non-central about −z_p √n.
        seen = (mean - x) / spread * math.sqrt(count)
        for p, share in ((low, 0.05), (high, 0.95)):
            about = -stats.norm.ppf(p) * math.sqrt(count)
            assert stats.nct.sf(seen, count - 1, about) == pytest.approx(1.0 - share, abs=5e-3)


def test_a_band_rises_with_the_level_and_is_narrow_where_no_record_exceeds() -> None:
    """Seven records had 0.96 for an upper end at a level at which none exceeds, and it fell."""
    rng = np.random.default_rng(0)
    scales = np.linspace(0.15, 2.2, 15)
    for records in (5, 7, 7, 7, 12):
        fragility = vi.fragility(lognormal(rng, records, scales, BETA), "peak_displacement", 1.0)
        low, high = fragility["fitted_probability_bound"].values
        assert (np.diff(low) >= 0.0).all()
        assert (np.diff(high) >= 0.0).all()
        assert (low <= fragility["fitted_probability"]).all()
        assert (fragility["fitted_probability"] <= high).all()
        # Without any curve: so large a share shows in none of the records once in twenty times.
        none = fragility["exceeding"].values == 0
        assert none.any()
        assert (high[none] < 1.0 - 0.05 ** (1.0 / records)).all()


def test_records_that_cease_to_exceed_count_by_the_nearest_share_that_rises() -> None:
    begin = begin_to_exceed(np.array([0, 3, 2, 5, 7]), 8)
    assert begin.tolist() == [0.0, 2.5, 0.0, 2.5, 2.0, 1.0]


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
    finer = "so pass finer scales between 2 and 3 to demands"
    with pytest.raises(vi.InputError, match=f"^limit: 1.0; at fewer than two scales, .*, {finer}"):
        vi.fragility(none, "peak_displacement", 1.0)
    one = suite(np.array([below, above, below]), scales)
    with pytest.raises(vi.InputError, match=finer.replace("2 and 3", "1 and 3")):
        vi.fragility(one, "peak_displacement", 1.0)
    with pytest.raises(
        vi.InputError, match=r"no record is above the limit at any scale, so pass higher"
    ):
        vi.fragility(one, "peak_displacement", 10.0)
    with pytest.raises(
        vi.InputError, match=r"all records are above the limit at every scale, so pass lo"
    ):
        vi.fragility(one, "peak_displacement", 0.1)
    counted = one.assign(impact_count=one["peak_displacement"] * 0.0)
    counted["impact_count"].attrs["units"] = "1"
    with pytest.raises(vi.InputError, match=r"^demands: no record is above 0 in impact_"):
        vi.fragility(counted, "impact_count")
    # Records that begin to exceed between the same two levels, beside others, are enough.
    scales = np.array([1.0, 2.0, 3.0, 4.0])
    early, late = np.array([0.5, 2.0, 2.0, 2.0]), np.array([0.5, 0.6, 0.7, 2.0])
    decided = vi.fragility(suite(np.array([early, late, early]), scales), "peak_displacement", 1.0)
    assert 1.0 < float(decided["median_capacity"]) < 4.0
    low, high = decided["median_capacity_bound"].values
    assert 0.0 < low < 2.0 < high < np.inf
    assert "unbounded" not in decided.attrs
    # Of one alone nothing is known of the dispersion, however many others lie beyond the levels.
    first, last = np.full(4, 2.0), np.full(4, 0.5)
    lone = suite(np.array([first, early, last, last]), scales)
    with pytest.warns(
        RuntimeWarning,
        match=r"^fragility: there is no interval, because .*: lower and higher s",
    ):
        fragility = vi.fragility(lone, "peak_displacement", 1.0)
    assert fragility.attrs["unbounded"].endswith(
        "to get an interval, pass to demands: lower and higher scales"
    )
    assert fragility["median_capacity_bound"].values.tolist() == [0.0, np.inf]
    assert fragility["dispersion_bound"].values.tolist() == [0.0, np.inf]
    assert fragility["fitted_probability_bound"].values.tolist() == [[0.0] * 4, [1.0] * 4]


def test_what_would_bound_an_interval_is_told_by_curve() -> None:
    """Of three gaps: levels end too early, or begin too late, or both."""
    data = _gaps((2.0, *(9.0,) * 4), (*(0.0,) * 4, 3.0), (0.0, 0.0, 3.0, 9.0, 9.0))
    with pytest.warns(RuntimeWarning, match="^fragility: there is no interval"):
        note = vi.fragility(data, "peak_displacement", 1.0).attrs["unbounded"]
    assert note == (
        "there is no interval, because fewer than two records begin to exceed the limit within "
        "the scales; to get an interval, pass to demands: higher scales for gap 200 mm; lower "
        "scales for gap 300 mm; lower and higher scales for gap 400 mm"
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
    with pytest.warns(RuntimeWarning, match=r"^fragility: no curve for gap 200 mm: ") as notes:
        fragility = vi.fragility(data, "peak_displacement", 1.0)
    assert len(notes) == 1
    none = "at fewer than two scales, some records are above the limit and others are not, "
    reasons = {
        0.2: none + "so pass finer scales between 1 and 3 to demands",
        0.4: "no record is above the limit at any scale, so pass higher scales to demands",
        0.5: "all records are above the limit at every scale, so pass lower scales to demands",
        0.6: none + "so pass finer scales between 2 and 3 to demands",
    }
    assert fragility.attrs["undetermined"] == "; ".join(
        f"no curve for gap {1e3 * gap:g} mm: {why}" for gap, why in reasons.items()
    )
    assert str(notes[0].message) == f"fragility: {fragility.attrs['undetermined']}"
    for i, gap in enumerate(data["gap"].values):
        lone = data.isel(gap=i, drop=True)
        if round(float(gap), 1) in reasons:
            assert np.isnan(fragility["median_capacity"][i])
            with pytest.raises(vi.InputError) as refused:
                vi.fragility(lone, "peak_displacement", 1.0)
            assert str(refused.value) == f"limit: 1.0; {reasons[round(float(gap), 1)]}"
        else:
            one = vi.fragility(lone, "peak_displacement", 1.0)
            assert float(one["median_capacity"]) == float(fragility["median_capacity"][i])
            assert "undetermined" not in one.attrs
    with pytest.warns(RuntimeWarning, match=r"; and 4 more curves$"):
        vi.fragility(_gaps(fine, *[(3.0,) * 6] * 9), "peak_displacement", 1.0)
    with pytest.raises(
        vi.InputError, match=r"^limit: 1.0; no curve for gap 200 mm: .*; no curve f"
    ):
        vi.fragility(data.isel(gap=[0, 2]), "peak_displacement", 1.0)


def test_a_share_that_does_not_rise_has_no_curve() -> None:
    scales = np.array([1.0, 2.0, 3.0])
    falls = suite(np.array([[2.0, 2.0, 0.5], [2.0, 0.5, 0.5], [2.0, 0.5, 2.0]]), scales)
    with pytest.raises(vi.InputError, match=r"that are above the limit does not rise with the sca"):
        vi.fragility(falls, "peak_displacement", 1.0)


def test_wrong_input() -> None:
    data = lognormal(np.random.default_rng(1), 5, SCALES, BETA)
    with pytest.raises(
        vi.InputError, match=r"^demands: a fragility curve requires at least 3 records, not 2"
    ):
        vi.fragility(data.isel(record=[0, 1]), "peak_displacement", 1.0)
    with pytest.raises(vi.InputError, match=r"^confidence: 1.5"):
        vi.fragility(data, "peak_displacement", 1.0, confidence=1.5)


def test_of_impact_itself_no_limit_is_asked() -> None:
    rig = RIGS["bumpers"]
    records = {str(seed): noise(seed, count=60) for seed in range(6)}
    data = vi.demands(rig, records, np.linspace(0.1, 1.5, 8))
    curve = vi.fragility(data, "impact_count")
    assert curve.identical(vi.fragility(data, "impact_count", 0))
    np.testing.assert_array_equal(
        curve["exceeding"], (data["impact_count"] > 0).any("stop").sum("record")
    )
    with pytest.raises(
        vi.InputError, match=r"^limit: missing; pass the limit of peak_acceleration"
    ):
        vi.fragility(data, "peak_acceleration")
