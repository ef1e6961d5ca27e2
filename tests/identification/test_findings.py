"""What excursions cannot tell, what ends at a bound, what is never touched: said, not guessed."""

import numpy as np
import pytest

import vibroimpact as vi
from identification.twins import EXCURSIONS, PEAKS, curves
from vibroimpact.identification.comparison import asked_of, hertzian, softening
from vibroimpact.identification.free_parameters import SENSORS, frees, size_of
from vibroimpact.model.parameters import PARAMETERS

CASE = vi.laboratory.case("B2-G2-A2", "identified")
NEAR = vi.Bumper("400 kN/m", "0.9 kN s/m", "9 mm")
FAR = vi.Bumper("400 kN/m", "0.9 kN s/m", "12 mm")
UNEVEN = vi.Oscillator("550 kg", vi.Isolator("31.9 kN/m", "1.1 kN s/m"), NEAR, FAR)
QUICK = {"tried": 0, "starts": 1, "profiles": False}
GRID = np.arange(0.8, 3.0, 0.1)


def test_right_and_left_exchanged_fit_excursions_as_well_and_are_reported():
    data = curves(UNEVEN, "0.04 g", 0.01, frequencies=GRID)
    start = UNEVEN.replace(right=FAR, left=NEAR)
    fit = vi.identify(start, data, "stops.right.gap,stops.left.gap", **QUICK)
    # The fit keeps to the sides of the start: the truth lies outside both intervals.
    low, high = fit.interval.values.T
    assert ((np.array([0.009, 0.012]) < low) | (np.array([0.009, 0.012]) > high)).all()
    (other,) = fit.alternative_value.values
    assert other == pytest.approx(fit.fitted_value.values[::-1], rel=1e-9)
    assert float(fit.alternative_rise[0]) < 0.01
    note = "with right and left exchanged, the rig fits equally well: stops.right.gap 9."
    assert note in fit.findings
    assert "stops.left.gap 12." in fit.findings or "stops.left.gap 11.9" in fit.findings


def test_maxima_and_minima_tell_the_sides():
    data = curves(UNEVEN, "0.04 g", 0.01, names=PEAKS, frequencies=GRID)
    fit = vi.identify(UNEVEN, data, "stops.right.gap,stops.left.gap", **QUICK)
    assert "exchanged" not in fit.findings
    assert "alternative_value" not in fit


def test_sides_that_only_the_given_values_tell_are_reported():
    data = curves(UNEVEN, "0.04 g", 0.01, frequencies=GRID)
    fit = vi.identify(UNEVEN, data, "stops.right.gap", **QUICK)
    assert "only the values that you passed determine which side is the right one" in fit.findings


@pytest.fixture(scope="module")
def undamped():
    bumper = CASE.oscillator.right.replace(damping=60.0)
    return curves(CASE.oscillator.replace(right=bumper, left=bumper), "0.04 g", 0.02, seed=3)


@pytest.mark.parametrize("start", [900.0, 0.0, 3.4e-26])
def test_a_damping_at_its_bound_is_zero_and_as_uncertain_from_there(undamped, start):
    bumper = CASE.oscillator.right.replace(damping=start)
    rig = CASE.oscillator.replace(right=bumper, left=bumper)
    fit = vi.identify(rig, undamped, "stops.damping", tried=0, starts=1)
    assert fit.fitted_value.values[0] == 0.0
    assert vi.fitted_rig(fit).oscillator.right.damping == 0.0
    assert 100.0 < fit.standard_error.values[0] < 300.0
    low, high = fit.interval.values[0]
    assert (low, list(fit.interval_open.values[0])) == (0.0, [1, 0])
    assert 60.0 < high < 600.0


def test_a_contact_of_hertz_inherits_no_certainty(undamped):
    bumper = CASE.oscillator.right.replace(damping=3.4e-26)
    contact = hertzian(CASE.oscillator.replace(right=bumper, left=bumper), 2e-3)
    few = undamped.sel(frequency=[1.5, 1.7, 1.9], method="nearest")
    fit = vi.identify(contact, few, "stops.dissipation", **QUICK)
    # That of the dashpot, over the force of the spring at that depth.
    assert 0.01 < fit.standard_error.values[0] < 10.0


@pytest.mark.parametrize("name", [n for n in PARAMETERS if n not in ("frequency", "amplitude")])
def test_every_kind_has_a_size(name):
    setting = vi.Rig(CASE.oscillator, vi.Harmonic("0.04 g", 1.0))
    rig = CASE.oscillator
    omega = rig.angular_frequency
    swing = 0.04 * 9.80665 / omega**2
    sizes = {
        "N/m": rig.isolator.stiffness,
        "N s/m": rig.mass * omega,
        "N": rig.mass * omega**2 * swing,
        "m": swing,
        "kg": rig.mass,
        "s": 1.0 / omega,
        "s/m": 1.0 / (omega * swing),
        "1/m": 1.0 / swing,
        "": 1.0,
        "N/m³": rig.isolator.stiffness / swing**2,
        "N/m^5": rig.isolator.stiffness / swing**4,
    }
    quantity = PARAMETERS[name].quantity
    assert size_of(quantity, setting) == pytest.approx(sizes[quantity.symbol], rel=1e-9)
    at_rest = vi.Rig(rig, vi.Harmonic(1e-12, 1.0))  # the base of a free vibration
    assert size_of(quantity, at_rest, swing) == pytest.approx(sizes[quantity.symbol], rel=1e-9)


@pytest.mark.full
def test_of_a_bumper_that_is_never_touched_only_the_least_gap_is_known():
    grid = np.arange(0.8, 2.0, 0.1)
    wide = CASE.oscillator.right.replace(gap="45 mm")
    rig = CASE.oscillator.replace(right=wide, left=wide)
    data = curves(rig, "0.04 g", 0.02, frequencies=grid)
    farthest = 0.5 * float(vi.sweep(vi.Rig(rig, "0.04 g"), grid).displacement_excursion.max())
    free = "isolator.stiffness,stops.stiffness,stops.damping,gap"
    fit = vi.identify(rig, data, free, tried=0, starts=1)
    low = float(fit.interval.sel(parameter="gap", bound="low"))
    assert 0.9 * farthest < low < farthest
    assert fit.interval_open.sel(parameter="gap").values.tolist() == [0, 1]
    for name in ("stops.stiffness", "stops.damping"):
        assert fit.interval_open.sel(parameter=name).values.all()
    known = (
        "gap (gap of each side) has only a lower limit: in these tests the mass does not touch "
        f"the stop, and all values from {1e3 * low:.3g} mm upward fit equally well"
    )
    lines = fit.findings.splitlines()
    assert any(line.startswith(known) for line in lines)
    untold = "is not determined: in these tests the mass does not touch the stop"
    assert sum(untold in line for line in lines) == 2
    quick = vi.identify(rig, data, free, **QUICK)
    assert quick.interval.sel(parameter="gap", bound="low") == pytest.approx(farthest, rel=0.02)
    assert np.isinf(quick.interval.sel(parameter="gap", bound="high"))


def test_the_cost_tells_a_right_fit_from_a_wrong_one():
    data = curves(CASE.oscillator, "0.04 g", 0.01, frequencies=GRID)
    right = vi.identify(CASE.oscillator, data, "isolator.stiffness", **QUICK)
    harder = data.assign_attrs(amplitude=0.06 * 9.80665)
    wrong = vi.identify(CASE.oscillator, harder, "isolator.stiffness", **QUICK)
    assert wrong.attrs["cost"] > 100.0 * right.attrs["cost"]
    assert right.attrs["cost"] == pytest.approx(0.5 * 0.01**2 * data[EXCURSIONS[0]].size * 2, 0.5)


@pytest.mark.parametrize("shaking", ["0.06 g", "5 mm", ["0.04 g"] * len(GRID)])
def test_a_shaking_of_the_rig_that_the_data_replace_is_reported(shaking):
    data = curves(CASE.oscillator, "0.04 g", 0.01, frequencies=GRID)
    with pytest.warns(
        vi.InputWarning, match=r"the amplitude is 0\.04 g, from the data; .* not used"
    ):
        fit = vi.identify(vi.Rig(CASE.oscillator, shaking), data, "isolator.stiffness", **QUICK)
    assert "test 1: the amplitude is 0.04 g, from the data; " in fit.findings
    assert fit.fitted_value.values[0] == pytest.approx(31900.0, rel=0.01)
    rounded = data.assign_attrs(amplitude=0.3923)
    same = vi.identify(vi.Rig(CASE.oscillator, "0.04 g"), rounded, "isolator.stiffness", **QUICK)
    assert "not used" not in same.findings


def test_the_amplitude_of_a_computed_sweep_is_its_own():
    data = vi.sweep(vi.Rig(CASE.oscillator, "0.04 g"), GRID)
    message = r"the amplitude is 0\.04 g, from the data; the amplitude of"
    with pytest.warns(vi.InputWarning, match=message):
        fit = vi.identify(vi.Rig(CASE.oscillator, "0.05 g"), data, "isolator.stiffness", **QUICK)
    assert fit.fitted_value.values[0] == pytest.approx(31900.0, rel=1e-6)
    assert vi.fitted_rig(fit).amplitude == pytest.approx(0.04 * 9.80665)


def test_a_measured_base_and_its_frequency_replace_those_of_the_rig():
    data = vi.simulate(vi.Rig(CASE.oscillator, vi.Harmonic("0.04 g", 1.5)), 6, samples=40)
    rig = vi.Rig(CASE.oscillator, vi.Harmonic("0.06 g", 1.7))
    message = "the frequency is 1.5 Hz, from the data; the frequency of the"
    with pytest.warns(vi.InputWarning, match=message):
        fit = vi.identify(rig, data, "isolator.stiffness", **QUICK)
    assert "the amplitude is 0.04 g, from the measured base; the amplitude of the rig, 0.06 g" in (
        fit.findings
    )
    same = vi.identify(vi.Rig(CASE.oscillator, "0.04 g"), data, "isolator.stiffness", **QUICK)
    assert "not used" not in same.findings


def test_the_table_of_a_fit_has_its_intervals(tmp_path):
    data = curves(CASE.oscillator, "0.04 g", 0.01, frequencies=GRID)
    fit = vi.identify(CASE.oscillator, data, "isolator.stiffness,gap", tried=0, starts=1)
    table = vi.to_table(fit)
    assert list(table["interval.low"]) == fit.interval.sel(bound="low").values.tolist()
    assert list(table["interval.high"]) == fit.interval.sel(bound="high").values.tolist()
    vi.save(fit, tmp_path / "fit.csv")
    assert "interval.low" in (tmp_path / "fit.csv").read_text().splitlines()[0]


@pytest.mark.parametrize("nonsense", [3, None, 1.5, object(), b"gap", [3], [["gap"]], {3: 1}, True])
@pytest.mark.parametrize("field", ["free", "each", "priors", "ties", "window"])
def test_nonsense_is_refused_in_one_line(field, nonsense):
    if nonsense is None and field != "free":
        return
    if field == "window" and nonsense == 3:
        return
    data = curves(CASE.oscillator, "0.04 g", frequencies=GRID[:3])
    with pytest.raises(vi.InputError) as error:
        vi.identify(CASE.oscillator, data, **{"free": "gap", **QUICK, field: nonsense})
    assert str(error.value).startswith(field)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"free": {"gap": {"begin": 1}}}, "free['gap']: the key 'begin' is unknown"),
        ({"free": {"gap": [1, 2, 3]}}, "a range (low, high)"),
        ({"free": {"gap": b"1"}}, "free['gap'].start"),
        ({"free": {"stops.stiffness": 0.0}}, "is not greater than 0"),
        ({"priors": {"gap": 3}}, "priors['gap']: 3; pass a pair (mean, standard deviation)"),
        ({"priors": {"gap": "10 mm"}}, "(mean, standard deviation)"),
        ({"priors": {"gap": ("10 mm", 0)}}, "is not greater than 0"),
        ({"each": "isolator.damping"}, "each: 'isolator.damping' is not free"),
        ({"each": ["nothing"]}, "each: 'nothing'"),
        ({"ties": {"stops.left.gap": 3}}, "ties: 3"),
        ({"window": 0}, "window: 0"),
    ],
)
def test_what_is_nearly_right_is_refused_with_what_is_accepted(asked, message):
    data = curves(CASE.oscillator, "0.04 g", frequencies=GRID[:3])
    with pytest.raises(vi.InputError) as error:
        vi.identify(CASE.oscillator, data, **{"free": "gap", **QUICK, **asked})
    assert message in str(error.value)


def test_names_of_each_may_be_a_text_with_commas():
    settings = {name: vi.Rig(CASE.oscillator, vi.Harmonic(0.4, 1.0)) for name in ("A", "B")}
    parameters = frees("gap, isolator.stiffness", settings, "gap", None)
    assert [one.key for one in parameters] == ["gap[A]", "gap[B]", "isolator.stiffness"]
    assert set(SENSORS) & set(PARAMETERS) == set()


def test_what_is_asked_of_another_model_keeps_its_bounds_where_it_means_the_same():
    asked = {
        "free": {"gap": ("5 mm", "9 mm"), "stops.stiffness": (1e5, 1e6), "stops.damping": None},
        "each": ["stops.damping"],
        "ties": {"left.damping": "stops.right.damping"},
        "priors": {"gap": (7e-3, 1e-3), "stops.damping": (1.0, 1.0)},
        "seed": 3,
    }
    assert asked_of("hertz", asked) == {
        "free": {"gap": ("5 mm", "9 mm"), "stops.stiffness": None, "stops.dissipation": None},
        "each": ["stops.dissipation"],
        "ties": {"stops.left.dissipation": "stops.right.dissipation"},
        "priors": {"gap": (7e-3, 1e-3)},
        "seed": 3,
    }
    assert asked_of("softening", asked)["free"] == {**asked["free"], "isolator.cubic": None}
    assert asked_of("softening", asked)["priors"].keys() == asked["priors"].keys()


def test_the_softening_model_replaces_no_dashpot_with_a_power():
    """It would drop the exponent of the velocity."""
    isolator = vi.Isolator("31.9 kN/m", 100.0, damping_exponent=0.5)
    assert softening(UNEVEN).isolator.cubic == 0.0
    with pytest.raises(vi.InputError, match="'softening' replaces a linear one"):
        softening(UNEVEN.replace(isolator=isolator))
