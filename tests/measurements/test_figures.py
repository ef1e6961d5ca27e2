"""Figures, features and spectra take measured data."""

import numpy as np
import pytest
import xarray as xr
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from samples import sample
from vibroimpact import figures
from vibroimpact.measurements.features import in_words, measured_features, noise_of, outliers
from vibroimpact.measurements.read import as_measured
from vibroimpact.response.curve_pair import judged

FREQUENCIES = np.round(np.arange(0.5, 5.01, 0.1), 10)


@pytest.fixture(scope="module")
def computed():
    return vi.sweep(vi.laboratory.case("B2-G1-A3", "identified"), FREQUENCIES)


@pytest.fixture(scope="module")
def curves(computed):
    """2 % of noise on both excursions."""
    draw = np.random.default_rng(3)
    names = ["displacement_excursion", "acceleration_excursion"]
    noisy = xr.Dataset({n: computed[n] * (1.0 + 0.02 * draw.normal(size=(2, 46))) for n in names})
    return as_measured(noisy)


@pytest.fixture(scope="module")
def history():
    rig = vi.laboratory.case("B2-G1-A3", "identified")
    motion = vi.simulate(rig, 40, frequency="2 Hz", samples=64)
    time = np.arange(15.0, 19.97, 0.004)
    names = ("displacement", "acceleration", "base_acceleration")
    known = {n: ("time", np.interp(time, motion.time, motion[n])) for n in names}
    return as_measured(xr.Dataset(known, {"time": time})), motion


def test_noise_is_that_of_repeated_values():
    """A mean of four would show half of it, a few frequencies of one way hardly anything."""
    values = np.linspace(1.0, 3.0, 10)[:, None]
    values = values * np.random.default_rng(1).normal(1.0, 0.02, size=(2, 1, 10, 4))
    dims = ("direction", "frequency", "repeat")
    for names, sign in (
        (("displacement_excursion", "acceleration_excursion"), 1.0),
        (("displacement_max", "displacement_min"), [[[[1.0]]], [[[-1.0]]]]),
    ):
        again = {n: (dims, v) for n, v in zip(names, values * sign, strict=True)}
        assert noise_of(xr.Dataset(again)) == pytest.approx(0.02, rel=0.2)


def test_features_are_told_with_the_step(curves):
    assert noise_of(curves) == pytest.approx(0.02, rel=0.4)
    jumps = measured_features(curves).jumps
    assert [(j.direction, j.before, j.after) for j in jumps] == [
        ("forward", 2.6, 2.7),
        ("backward", 1.8, 1.7),
    ]
    words = "\n".join(in_words(curves))
    assert "in steps of 0.1 Hz" in words
    assert "forward: jump down between 2.6 and 2.7 Hz" in words
    assert "hysteresis, forward curve above backward curve: 1.8 to 2.6 Hz" in words


def test_curves_alone_and_over_computed_ones(curves, computed):
    upper, lower = figures.resonance_curves(curves)
    assert upper.get_ylabel().endswith("$E_a$ (g)")
    drawn = next(line for line in lower.lines if line.get_label() == "forward sweep, measured")
    values = drawn.get_ydata()
    expected = 1e3 * curves.displacement_excursion.sel(direction="forward").values
    assert values[np.isfinite(values)] == pytest.approx(expected)
    for physical in (False, True):
        panels = figures.resonance_curves(computed, measured=curves, physical=physical)
        labels = [line.get_label() for line in panels[0].lines]
        assert "measured, forward sweep" in labels
    points = figures.resonance_curves(computed, measured=curves)[1].lines[-1]
    ratio = curves.displacement_excursion.sel(direction="backward") / float(
        computed.largest_free_displacement_excursion
    )
    assert points.get_ydata() == pytest.approx(ratio.values)


def test_histories_and_portraits_lie_over_computed_ones(history):
    data, motion = history
    panels = figures.time_history({"measured": data, "model": motion}, cycles=3)
    curves = [line for line in panels[0].lines if len(line.get_xdata()) > 20]
    at, u = curves[0].get_data()
    x, y = curves[1].get_data()
    assert np.interp(at, x, y) == pytest.approx(u, abs=0.15)
    assert at[0] == pytest.approx(x[0], abs=0.02)
    ax = figures.phase_portrait({"measured": data, "model": motion})
    assert len(ax.lines) >= 2


def test_the_velocity_is_the_slope_of_the_displacement(history):
    data, motion = history
    ax = figures.phase_portrait(data)
    fastest = np.max(np.abs(ax.lines[0].get_ydata()))
    assert fastest == pytest.approx(float(abs(motion.velocity[-640:]).max()), rel=0.03)


def test_the_spectrum_of_a_history(history):
    data, motion = history
    lines = vi.fourier_spectrum(data, 5)
    exact = vi.fourier_spectrum(
        vi.steady(vi.laboratory.case("B2-G1-A3", "identified"), frequency="2 Hz", start=motion), 5
    )
    for order in (1, 3):
        amplitude = float(lines.displacement_amplitude.sel(order=order, method="nearest"))
        assert amplitude == pytest.approx(
            float(exact.displacement_amplitude.sel(order=order)), rel=0.01
        )
    assert "velocity_amplitude" not in lines


def test_maxima_and_minima_lie_over_computed_curves(computed):
    names = ["displacement_max", "displacement_min", "acceleration_max", "acceleration_min"]
    measured = as_measured(computed[names])
    for ax, name in zip(
        figures.resonance_curves(computed, measured=measured), ("eta_a", "eta_d"), strict=True
    ):
        (line,) = [one for one in ax.lines if str(one.get_label()).startswith("measured, forward")]
        assert line.get_ydata() == pytest.approx(computed[name].sel(direction="forward").values)


def test_excursions_lie_over_half_excursions():
    """At 0.8 Hz this symmetric rig goes further to one side than to the other."""
    bumper = vi.Bumper("510 kN/m", "0.9 kN s/m", gap="10 mm")
    rig = vi.Oscillator("550 kg", vi.Isolator("31.9 kN/m", "1.1 kN s/m"), bumper, bumper)
    computed = vi.sweep(vi.Rig(rig, "0.04 g"), np.round(np.arange(0.5, 2.01, 0.1), 10))
    names = ["displacement_excursion", "acceleration_excursion"]
    one = {"direction": "forward", "frequency": 0.8}
    half = 0.5 * float(computed[names[1]].sel(one))
    assert float(computed["peak_acceleration"].sel(one)) > 1.2 * half
    panels = figures.resonance_curves(
        computed, measured=as_measured(computed[names]), physical=True
    )
    words = ["half the excursion of absolute acceleration (g)",
             "half the excursion of relative displacement (mm)"]  # fmt: skip
    assert [ax.get_ylabel().replace("\n", " ") for ax in panels[:2]] == words
    for ax in panels[:2]:
        drawn = {str(line.get_label()): np.asarray(line.get_ydata()) for line in ax.lines}
        for way in ("forward", "backward"):
            curve = drawn[f"{way} sweep"]
            assert drawn[f"measured, {way} sweep"] == pytest.approx(curve[np.isfinite(curve)])
    assert any("gap" in str(line.get_label()) for line in panels[1].lines)
    ends = ["displacement_max", "displacement_min", names[1]]
    panels = figures.resonance_curves(computed, measured=as_measured(computed[ends]), physical=True)
    assert panels[1].get_ylabel() == "largest relative\ndisplacement (mm)"


def test_values_of_another_motion_are_found_and_are_no_noise():
    draw = np.random.default_rng(5)
    values = np.linspace(1.0, 3.0, 10)[:, None] * draw.normal(1.0, 0.02, size=(2, 1, 10, 4))
    dims = ("direction", "frequency", "repeat")
    at = {"direction": ["forward"], "frequency": np.arange(1.0, 11.0)}
    names = ("displacement_excursion", "acceleration_excursion")
    data = xr.Dataset({n: (dims, v) for n, v in zip(names, values, strict=True)}, at)
    assert not any(one.any() for one in outliers(data).values())
    quiet = noise_of(data)
    data[names[1]][0, 9, 2] *= 0.1
    assert [int(one.sum()) for one in outliers(data).values()] == [0, 1]
    assert noise_of(data) == pytest.approx(quiet, rel=0.1)


EXTREMES = ("displacement_max", "displacement_min", "acceleration_max", "acceleration_min")


def of_one_sided_rig(seed=7):
    """A rig that goes further to one side, measured three times, 2 % of noise on every value."""
    right, left = (vi.Bumper("300 kN/m", "0.6 kN s/m", gap) for gap in ("8 mm", "11 mm"))
    rig = vi.Oscillator("420 kg", vi.Isolator("20 kN/m", "0.9 kN s/m"), right, left)
    computed = vi.sweep(vi.Rig(rig, "0.05 g"), np.round(np.arange(0.5, 4.01, 0.1), 10))
    draw = np.random.default_rng(seed)
    noise = draw.normal(1.0, 0.02, size=(len(EXTREMES), *computed.eta_a.shape, 3))
    dims = ("direction", "frequency", "repeat")
    return as_measured(
        xr.Dataset(
            {
                n: (dims, computed[n].transpose(*dims[:2]).values[..., None] * e)
                for n, e in zip(EXTREMES, noise, strict=True)
            },
            {d: computed[d].values for d in dims[:2]},
        )
    )


def mirrored(data):
    """What a sensor shows that points the other way."""
    ends = {"max": "min", "min": "max"}
    return data.assign(
        {f"{kind}_{ends[end]}": -data[f"{kind}_{end}"]
         for kind in ("displacement", "acceleration") for end in ends
         if f"{kind}_{end}" in data}
    )  # fmt: skip


def pictured(data):
    """All that is drawn of measured curves."""
    panels = figures.resonance_curves(data)
    lines = [(line.get_label(), *line.get_data()) for ax in panels for line in ax.lines]
    spans = [patch.get_xy() for ax in panels for patch in ax.patches]
    return [ax.get_ylabel() for ax in panels], lines, spans


@st.composite
def measured_sides(draw):
    """Whatever maxima and minima, of one direction or two, some missing."""
    ways = draw(st.sampled_from([["forward"], ["backward"], ["forward", "backward"]]))
    count, repeats = draw(st.integers(4, 30)), draw(st.integers(1, 3))
    some = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    lost = draw(st.sampled_from([0.0, 0.1]))
    kinds = draw(st.sampled_from([["displacement"], ["displacement", "acceleration"]]))
    known = {}
    for kind in kinds:
        for end, sign in (("max", 1.0), ("min", -1.0)):
            values = sign * some.uniform(0.1, 3.0, size=(len(ways), count, repeats))
            values[some.uniform(size=values.shape) < lost] = np.nan
            known[f"{kind}_{end}"] = (("direction", "frequency", "repeat"), values)
    at = {"direction": ways, "frequency": np.arange(1.0, count + 1.0)}
    return as_measured(xr.Dataset(known, at))


def test_noise_is_the_same_to_the_last_bit_when_a_sensor_is_turned_round():
    some, at = np.random.default_rng(0), {"frequency": np.arange(1.0, 13.0)}
    for _ in range(60):
        known = {
            f"{kind}_{end}": (
                ("direction", "frequency", "repeat"),
                sign * some.uniform(0.1, 3.0, size=(1, 12, 2)),
            )
            for kind in ("displacement", "acceleration")
            for end, sign in (("max", 1.0), ("min", -1.0))
        }
        data = as_measured(xr.Dataset(known, {"direction": ["forward"], **at}))
        assert noise_of(mirrored(data)) == noise_of(data)


@pytest.mark.full
@settings(max_examples=sample(100, 15), deadline=None)
@given(measured_sides())
def test_a_sensor_turned_round_tells_the_same(data):
    for kind in {name.split("_")[0] for name in data.data_vars}:
        assume(judged(data, kind) == f"{kind}_excursion")
    other = mirrored(data)
    assert in_words(other) == in_words(data)
    assert measured_features(other) == measured_features(data)
    assert noise_of(other) == noise_of(data)
    labels, lines, spans = pictured(data)
    turned_labels, turned_lines, turned_spans = pictured(other)
    assert turned_labels == labels
    assert np.array_equal(turned_spans, spans)
    for (label, x, y), (turned_label, turned_x, turned_y) in zip(lines, turned_lines, strict=True):
        assert turned_label.startswith("_") == label.startswith("_")
        np.testing.assert_array_equal(turned_x, x)
        np.testing.assert_array_equal(turned_y, y)


def test_maxima_with_minima_are_judged_by_their_excursions():
    """The maxima alone step at 0.8 Hz as at a jump, which excursions do not."""
    data = of_one_sided_rig()
    excursions = data.assign(
        {f"{kind}_excursion": data[f"{kind}_max"] - data[f"{kind}_min"]
         for kind in ("displacement", "acceleration")}
    ).drop_vars(EXTREMES)  # fmt: skip
    assert in_words(data)[2:] == in_words(excursions)[2:]
    assert [j.direction for j in measured_features(data).jumps] == ["forward", "backward"]


def test_the_larger_side_is_drawn():
    data = of_one_sided_rig()
    (upper, lower) = figures.resonance_curves(data)
    for ax, kind, factor in ((upper, "acceleration", 1 / 9.80665), (lower, "displacement", 1e3)):
        assert ax.get_ylabel().startswith("largest ")
        drawn = next(x for x in ax.lines if x.get_label() == "backward sweep, measured").get_ydata()
        sides = abs(data[[f"{kind}_max", f"{kind}_min"]]).to_array().max("variable")
        expected = factor * sides.sel(direction="backward").values.ravel()
        assert drawn[np.isfinite(drawn)] == pytest.approx(expected)


@pytest.mark.parametrize(("end", "side"), [("max", "maximum"), ("min", "minimum")])
def test_one_side_alone_is_told(end, side):
    data = of_one_sided_rig()[[f"displacement_{end}", f"acceleration_{end}"]]
    text = "\n".join(in_words(as_measured(data)))
    assert f"peak of the acceleration's {side} at" in text
    assert "E_a" not in text
    words = {"max": "maxima", "min": "minima"}[end]
    assert f"displacement: only {words} were measured" in text
    upper, lower = figures.resonance_curves(as_measured(data))
    assert upper.get_ylabel() == f"{side} of absolute\nacceleration (g)"
    assert (lower.lines[0].get_ydata()[0] > 0.0) == (end == "max")


@pytest.mark.parametrize("kept", [np.s_[:0], np.s_[:1], np.s_[:, -5:]], ids=["no", "up", "some"])
def test_a_side_with_holes_hides_nothing_of_the_other(kept):
    """Minima of no hold, of one direction, of some frequencies only."""
    data = of_one_sided_rig()
    alone = as_measured(data[["displacement_max", "acceleration_max"]])
    holed = data.copy(deep=True)
    for name in ("displacement_min", "acceleration_min"):
        order = holed[name].transpose("direction", "frequency", ...)
        values = np.full_like(order.values, np.nan)
        values[kept] = order.values[kept]
        holed[name] = order.copy(data=values).transpose(*holed[name].dims)
    assert measured_features(holed) == measured_features(alone)
    assert figures.resonance_curves(holed)[0].get_ylabel().startswith("maximum of")
    for ax, of_alone in zip(
        figures.resonance_curves(holed), figures.resonance_curves(alone), strict=True
    ):
        for line, expected in zip(ax.lines, of_alone.lines, strict=True):
            np.testing.assert_array_equal(line.get_ydata(), expected.get_ydata())


def test_what_was_not_measured_has_no_peak():
    words = "\n".join(in_words(as_measured(of_one_sided_rig()[["displacement_max",
                                                               "displacement_min"]])))  # fmt: skip
    assert "peak of E_d" in words
    assert "E_a" not in words
