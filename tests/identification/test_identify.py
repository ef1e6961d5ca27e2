"""Twins of the published sets are found again."""

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from identification.twins import FREE, PEAKS, curves, off, truth
from samples import sample
from vibroimpact.identification.repeated_dwells import stray_values

CASES = ("B2-G1-A3", "B2-G2-A2")


def errors(result, rig):
    return result.fitted_value.values / truth(rig) - 1.0


@pytest.mark.parametrize("code", sample(CASES, CASES[:1]))
def test_without_noise_to_rounding_from_half_as_much_again(code):
    case = vi.laboratory.case(code, "identified")
    start = off(case.oscillator, (1.5, 0.5, 1.5, 0.5, 1.5))
    fit = vi.identify(
        start,
        curves(case.oscillator, case.amplitude),
        FREE,
        profiles=False,
        tried=sample(16, 4),
        starts=sample(3, 1),
        threads=2,
    )
    assert np.abs(errors(fit, case.oscillator)).max() < 1e-6
    assert fit.attrs["starts_alike"] >= 1


@pytest.mark.parametrize("code", sample(CASES, CASES[1:]))
def test_with_noise_within_its_own_errors(code):
    case = vi.laboratory.case(code, "identified")
    start = off(case.oscillator, (0.5, 1.5, 0.5, 1.5, 1.2))
    data = curves(case.oscillator, case.amplitude, 0.02, seed=4)
    fit = vi.identify(
        start, data, FREE, profiles=False, tried=sample(8, 3), starts=sample(2, 1), threads=2
    )
    away = (fit.fitted_value.values - truth(case.oscillator)) / fit.standard_error.values
    assert np.abs(away).max() < 3.0
    assert float(fit.noise[0]) == pytest.approx(0.02, rel=0.25)
    # Two of the bound of Cramér and Rao; of the bumper's damping that is 15 %.
    assert (np.abs(errors(fit, case.oscillator)) < [0.011, 0.019, 0.038, 0.3, 0.009]).all()
    rig = vi.fitted_rig(fit)
    assert rig.oscillator.right.gap == pytest.approx(fit.fitted_value.values[4])
    assert rig.amplitude == case.amplitude


@pytest.mark.full
@pytest.mark.parametrize("code", sample(CASES, CASES[:1]))
def test_what_a_test_records_of_each_hold_tells_a_bumper_to_a_hundredth(code):
    """Maxima and minima of both quantities in ten cycles, 2 % of noise, a guess half off."""
    case = vi.laboratory.case(code, "identified")
    kept = []
    for seed in range(sample(20, 1)):
        data = curves(case.oscillator, case.amplitude, 0.02, seed, PEAKS, cycles=10)
        start = off(case.oscillator, np.random.default_rng(seed).choice([0.5, 1.5], 5))
        fit = vi.identify(start, data, FREE, profiles=False, tried=8, starts=2, threads=2)
        away = errors(fit, case.oscillator)
        kept.append((np.abs(away[:4]) < [0.01, 0.01, 0.01, 0.1]).all())
        deviation = fit.standard_error.values / truth(case.oscillator)
        assert (np.abs(away) < 4.0 * deviation).all()
        assert (deviation < [0.002, 0.003, 0.005, 0.04, 0.002]).all()
        assert "times the noise" not in fit.attrs["findings"]
    assert np.mean(kept) >= 0.95


@pytest.mark.full
def test_profiles_and_bootstrap_agree_with_the_covariance_where_it_is_normal(tmp_path):
    case = vi.laboratory.case("B2-G2-A2", "identified")
    data = curves(case.oscillator, case.amplitude, 0.02, seed=5)
    fit = vi.identify(case.oscillator, data, FREE[:3], draws=60, tried=0, starts=1, threads=2)
    half = 0.5 * np.diff(fit.interval.values, axis=1)[:, 0]
    assert half == pytest.approx(1.97 * fit.standard_error.values, rel=0.1)
    drawn = fit.bootstrap_value.std("bootstrap_draw").values
    assert drawn == pytest.approx(fit.standard_error.values, rel=0.35)
    vi.save(fit, tmp_path / "fit.nc")
    assert vi.fitted_rig(vi.load(tmp_path / "fit.nc")) == vi.fitted_rig(fit)


def test_two_tests_share_a_bumper_and_have_their_own_isolator():
    one = vi.laboratory.case("B2-G1-A3", "identified")
    other = vi.laboratory.case("B2-G2-A2", "identified")
    tests = {
        "A3": curves(one.oscillator, one.amplitude, 0.01, seed=1),
        "A2": curves(other.oscillator, other.amplitude, 0.01, seed=2),
    }
    free = {"isolator.stiffness": "29 kN/m", "stops.stiffness": "450 kN/m"}
    rigs = {"A3": one.oscillator, "A2": other.oscillator}
    fit = vi.identify(
        rigs, tests, free, each=["isolator.stiffness"], tried=0, starts=1, profiles=False
    )
    assert fit.parameter.values.tolist() == [
        "isolator.stiffness[A3]",
        "isolator.stiffness[A2]",
        "stops.stiffness",
    ]
    assert fit.fitted_value.values == pytest.approx([26800.0, 31900.0, 510000.0], rel=0.02)
    assert vi.fitted_rig(fit, "A2").oscillator.isolator.stiffness == fit.fitted_value.values[1]
    with pytest.raises(vi.InputError, match="test: missing"):
        vi.fitted_rig(fit)


def test_an_outlier_does_little():
    case = vi.laboratory.case("B2-G2-A2", "identified")
    data = curves(case.oscillator, case.amplitude, 0.01, seed=6)
    data.displacement_excursion[0, 30] *= 1.6
    data.acceleration_excursion[1, 5] *= 0.5
    shift = []
    for robust in (True, False):
        fit = vi.identify(
            case.oscillator,
            data,
            "isolator.stiffness,isolator.damping,gap",
            robust=robust,
            tried=0,
            starts=1,
            profiles=False,
        )
        true = truth(case.oscillator)[[0, 1, 4]]
        shift.append(np.abs(fit.fitted_value.values / true - 1.0).max())
    assert shift[0] < 0.01 < 0.02 < shift[1] + 0.012


def test_priors_ties_and_bounds():
    case = vi.laboratory.case("B2-G2-A2", "identified")
    data = curves(case.oscillator, case.amplitude, 0.02, seed=7)
    wide = vi.identify(case.oscillator, data, "stops.damping", tried=0, starts=1)
    tight = vi.identify(
        case.oscillator,
        data,
        "stops.damping",
        tried=0,
        starts=1,
        priors={"stops.damping": ("0.9 kN s/m", 20.0)},
    )
    assert float(tight.standard_error[0]) < 20.0 < float(wide.standard_error[0])
    tied = vi.identify(
        case.oscillator,
        data,
        "stops.right.gap",
        ties={"stops.left.gap": "stops.right.gap"},
        tried=0,
        starts=1,
        profiles=False,
    )
    rig = vi.fitted_rig(tied).oscillator
    assert rig.left.gap == rig.right.gap == tied.fitted_value.values[0]
    held = vi.identify(case.oscillator, data, {"stops.damping": (0, 800)}, tried=0, starts=1)
    low, high = held.interval.values[0]
    assert 0.0 <= low < high <= 800.0
    assert held.interval_open.values[0].any()
    assert "stops.damping (damping of both bumpers)" in held.attrs["findings"]


def test_maxima_minima_and_eta_with_a_sensor_that_is_off():
    stiff = vi.Bumper("510 kN/m", "0.9 kN s/m", "9 mm")
    soft = vi.Bumper("300 kN/m", "0.6 kN s/m", "12 mm")
    rig = vi.Oscillator("550 kg", vi.Isolator("31.9 kN/m", "1.1 kN s/m"), stiff, soft)
    data = curves(rig, "0.04 g", names=("displacement_max", "displacement_min", "eta_a"))
    data["displacement_max"] = 1.03 * data.displacement_max + 4e-4
    data["displacement_min"] = 1.03 * data.displacement_min + 4e-4
    start = rig.replace(right=stiff.replace(gap="10 mm"), left=soft.replace(gap="10 mm"))
    free = ["stops.right.gap", "stops.left.gap", "displacement_scale", "displacement_offset"]
    fit = vi.identify(start, data, free, tried=0, starts=1, profiles=False)
    assert fit.fitted_value.values == pytest.approx([0.009, 0.012, 1.03, 4e-4], rel=1e-6)


def test_a_motion_and_its_mirror_image_are_one_to_a_symmetric_rig():
    """Near 0.9 Hz it goes further to one side; to which one hangs on the last digits."""
    case = vi.laboratory.case("B2-G2-A2", "identified")
    data = curves(case.oscillator, "0.03 g", names=PEAKS)
    turned = data.copy(deep=True)
    at = {"frequency": 0.9, "direction": "forward"}
    for kind in ("displacement", "acceleration"):
        most, least = (float(data[f"{kind}_{end}"].sel(at)) for end in ("max", "min"))
        assert abs(most + least) > 0.01 * most
        turned[f"{kind}_max"].loc[at], turned[f"{kind}_min"].loc[at] = -least, -most
    start = off(case.oscillator, (1.02, 1.0, 0.97, 1.0, 1.01))
    for one in (data, turned):
        fit = vi.identify(
            start, one, "isolator.stiffness,stops.stiffness,gap", tried=0, starts=1, profiles=False
        )
        away = fit.fitted_value.values / truth(case.oscillator)[[0, 2, 4]] - 1.0
        assert np.abs(away).max() < 1e-6


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"free": "stifness"}, "free: 'stifness'"),
        ({"free": ""}, "free: ''"),
        ({"free": {"gap": (0.02, 0.01)}}, "low, 0.02 m, is not below high, 0.01 m"),
        ({"free": {"gap": "3 kg"}}, "is a mass"),
        ({"each": ["isolator.damping"]}, "each: 'isolator.damping' is not free"),
        ({"priors": {"isolator.damping": (1, 2)}}, "priors: 'isolator.damping' is not free"),
        ({"ties": {"stops.left.gap": "nothing"}}, "ties: 'nothing'"),
        ({"noise": -1}, "noise"),
        ({"data": {}}, "data: missing"),
        ({"data": 3}, "int is not a measurement"),
    ],
)
def test_what_cannot_be_fitted_is_refused(change, message):
    case = vi.laboratory.case("B2-G2-A2", "identified")
    asked = {"data": curves(case.oscillator, case.amplitude), "free": "gap", **change}
    with pytest.raises(vi.InputError) as error:
        vi.identify(case.oscillator, asked.pop("data"), asked.pop("free"), **asked)
    assert message in str(error.value)


def test_millimetres_taken_as_metres_are_noticed():
    case = vi.laboratory.case("B2-G2-A2", "identified")
    data = curves(case.oscillator, case.amplitude)
    data["displacement_excursion"] = 1e3 * data.displacement_excursion
    with pytest.raises(vi.InputError, match="correct the unit or the rig"):
        vi.identify(case.oscillator, data, "gap")


def test_too_few_points_and_no_amplitude():
    case = vi.laboratory.case("B2-G2-A2", "identified")
    data = curves(case.oscillator, case.amplitude).isel(frequency=[3], direction=[0])
    with pytest.raises(vi.InputError, match="5 unknowns"):
        vi.identify(case.oscillator, data, FREE)
    fit = vi.identify(case.oscillator, data, "gap", tried=0, starts=1, profiles=False)
    assert fit.fitted_value.values[0] == pytest.approx(0.01, rel=1e-5)
    del data.attrs["amplitude"]
    with pytest.raises(vi.InputError, match="rig: this is an Oscillator alone"):
        vi.identify(case.oscillator, data, "gap")


@pytest.mark.parametrize(
    ("low", "beginning"),
    [
        (1, "twice: forward, 3 Hz: 1 of 4 values lies far from the others, as if from another"),
        (2, "twice: forward, 3 Hz: its 4 values lie far apart, as if from two motions"),
    ],
)
def test_a_value_of_another_motion_is_named(low, beginning):
    draw = np.random.default_rng(2)
    values = draw.normal(1.0, 0.02, size=(1, 5, 4))
    values[0, 4, :low] = 0.1
    data = xr.Dataset(
        {"displacement_excursion": (("direction", "frequency", "repeat"), values)},
        {"direction": ["forward"], "frequency": [1.0, 1.5, 2.0, 2.5, 3.0]},
    )
    (line,) = stray_values("twice", data)
    assert line.startswith(beginning)
    assert stray_values("once", data.isel(repeat=3, drop=True)) == []


def test_a_column_that_was_not_understood_is_named(tmp_path):
    rig = vi.laboratory.case("B2-G2-A2", "identified")
    swept = vi.sweep(rig, [1.0, 1.2, 1.4, 1.6])
    rows = [
        f"{f},{1e3 * float(swept.displacement_excursion.sel(direction='forward', frequency=f))},1"
        for f in swept.frequency.values
    ]
    path = tmp_path / "own.csv"
    path.write_text("\n".join(["f (Hz),Ed (mm),Kanal 7", *rows]), encoding="utf-8")
    with pytest.warns(
        vi.InputWarning, match="columns were not understood and were left out: Kanal 7"
    ):
        fit = vi.identify(rig, path, "isolator.stiffness", tried=0, starts=1, profiles=False)
    note = "own: columns of the file were not understood and were left out: 'Kanal 7'"
    assert note in fit.attrs["findings"]
