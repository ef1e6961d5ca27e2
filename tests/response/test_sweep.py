"""``sweep``: what the dataset holds, exact extremes, published landmarks, and wrong input."""

from __future__ import annotations

import json
import math
import re
from functools import cache

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.datasets.stops import has_stops


def grid(start: float, stop: float, step: float) -> list[float]:
    return [round(start + k * step, 9) for k in range(round((stop - start) / step) + 1)]


@cache
def swept(code: str, parameters: str, start: float, stop: float, step: float) -> xr.Dataset:
    case = vi.laboratory.case(code, parameters)
    return vi.sweep(vi.Rig(case.oscillator, case.amplitude), grid(start, stop, step))


def identified() -> xr.Dataset:
    return swept("B2-G1-A3", "identified", 0.5, 3.0, 0.01)


class TestDataset:
    def test_dims_and_values(self) -> None:
        data = identified()
        assert list(data["direction"].values) == ["forward", "backward"]
        assert data["frequency"].values.tolist() == grid(0.5, 3.0, 0.01)
        more = {"section": ("component",)}
        for name, one in data.data_vars.items():
            if "free_" not in name:
                dims = ("direction", "frequency", *(["stop"] if has_stops(name) else []))
                assert one.dims == dims + more.get(name, ())
            assert not one.isnull().any()

    def test_it_says_how_it_was_made(self) -> None:
        attrs = identified().attrs
        assert attrs["created_by"] == "vibroimpact.sweep"
        assert attrs["vibroimpact_version"] == vi.__version__
        (rig,) = json.loads(attrs["parameters"])["rigs"]
        case = vi.laboratory.case("B2-G1-A3", "identified")
        assert vi.Oscillator(**rig["oscillator"]) == case.oscillator
        assert rig["amplitude"] == case.amplitude

    def test_values_belong_together(self) -> None:
        data = identified()
        high, low = data["displacement_max"], data["displacement_min"]
        xr.testing.assert_equal(data["displacement_excursion"], high - low)
        xr.testing.assert_equal(data["eccentricity"], (high + low) / 2)
        above, below = data["acceleration_max"], data["acceleration_min"]
        xr.testing.assert_equal(data["acceleration_excursion"], above - below)
        for kind, eta in (("displacement", "eta_d"), ("acceleration", "eta_a")):
            free, largest = (data[f"{name}_{kind}_excursion"] for name in ("free", "largest_free"))
            assert free.dims == ("frequency",)
            assert 0.999 * float(largest) < float(free.max()) <= float(largest)
            np.testing.assert_allclose(data[eta], data[f"{kind}_excursion"] / largest, rtol=1e-15)
        assert (data["motion"] == "periodic").all()
        assert (data["status"] == 0).all()
        assert data["status"].attrs["flag_meanings"].split()[0] == "done"
        assert (data["period"] >= 1).all()
        assert (data["cycles"].where(data["impacts"].sel(stop="right") > 0) != 0).all()
        assert data["impacts"].dims == ("direction", "frequency", "stop")
        per_period = data["impacts"] * data["period"]
        np.testing.assert_array_equal(per_period, per_period.round())

    @pytest.mark.parametrize("damping", [1100.0, 0.0, 30e3])
    def test_eta_does_not_depend_on_the_range(self, damping: float) -> None:
        """It is that of the branch, over the largest free flight at any frequency."""
        case = vi.laboratory.case("B2-G1-A3")
        isolator = case.oscillator.isolator.replace(damping=damping)
        rig = case.oscillator.replace(isolator=isolator)
        wide = vi.sweep(vi.Rig(rig, case.amplitude), grid(0.5, 2.5, 0.1), "forward", max_cycles=20)
        narrow = vi.sweep(
            vi.Rig(rig, case.amplitude), grid(1.9, 2.5, 0.1), "forward", max_cycles=20
        )
        for name, size in (("eta_d", "displacement"), ("eta_a", "acceleration")):
            scales = [(data[name] / data[f"{size}_excursion"]).values for data in (wide, narrow)]
            np.testing.assert_allclose(np.concatenate(scales, axis=1), scales[0][0, 0], rtol=1e-14)
        if damping == 1100.0:
            orbit = vi.branch(
                vi.Rig(rig, vi.Harmonic(case.amplitude, 2.2)), vary={"frequency": (2.1, 2.3)}
            )
            i = int(np.argmin(np.abs(orbit["frequency"].values - 2.2)))
            scale = float(orbit["eta_d"][i] / orbit["displacement_excursion"][i])
            assert scale == pytest.approx(
                float((wide["eta_d"] / wide["displacement_excursion"])[0, 0]), rel=1e-14
            )

    def test_many_rigs_share_one_dataset(self) -> None:
        pair = (vi.laboratory.case("B1-G1-A1"), vi.laboratory.case("B2-G1-A3"))
        data = vi.sweeps(pair, [1.0, 2.0])
        assert data["eta_a"].dims == ("rig", "direction", "frequency")
        assert data["rig"].values.tolist() == ["B1-G1-A1", "B2-G1-A3"]
        named = vi.sweeps({"left": pair[0], "right": pair[1]}, [1.0, 2.0])
        assert named["rig"].values.tolist() == ["left", "right"]
        np.testing.assert_array_equal(named["eta_a"], data["eta_a"])

    @pytest.mark.parametrize("directions", [("backward",), "backward", ("backward", "forward")])
    def test_directions_are_as_asked(self, directions: str | tuple[str, ...]) -> None:
        case = vi.laboratory.case("B2-G1-A3")
        data = vi.sweep(vi.Rig(case.oscillator, case.amplitude), [1.0, 2.0, 3.0], directions)
        both = vi.sweep(vi.Rig(case.oscillator, case.amplitude), [1.0, 2.0, 3.0])
        asked = [directions] if isinstance(directions, str) else list(directions)
        assert data["direction"].values.tolist() == asked
        xr.testing.assert_equal(data, both.sel(direction=asked))

    def test_text_and_progress(self) -> None:
        case = vi.laboratory.case("B2-G1-A3")
        counts: list[tuple[int, int]] = []
        data = vi.sweep(
            vi.Rig(case.oscillator, "0.05 g"),
            ["500 mHz", "2.5 Hz"],
            progress=lambda done, total: counts.append((done, total)),
        )
        plain = vi.sweep(vi.Rig(case.oscillator, 0.05 * 9.80665), [0.5, 2.5])
        xr.testing.assert_equal(data, plain)
        assert counts[-1] == (4, 4)
        assert sorted(counts) == counts


class TestStepping:
    @pytest.mark.parametrize("direction", ["forward", "backward"])
    def test_each_hold_goes_on_from_the_last(self, direction: str) -> None:
        case = vi.laboratory.case("B2-G1-A3")
        data = vi.sweep(
            vi.Rig(case.oscillator, case.amplitude), [1.2, 1.7, 2.4], direction, phase=0.7
        )
        data = data.isel(direction=0)
        if direction == "backward":
            data = data.isel(frequency=slice(None, None, -1))
        start = vi.State()
        for i in range(3):
            held = data.isel(frequency=i)
            shaken = vi.Harmonic(case.amplitude, float(held["frequency"]), 0.7)
            end = vi.simulate(vi.Rig(case.oscillator, shaken), 400, start, samples=0)["final_state"]
            np.testing.assert_allclose(held["section"], end, rtol=1e-9, atol=1e-14)
            start = held["section"]

    def test_a_start_chooses_the_branch(self) -> None:
        case = vi.laboratory.case("B2-G1-A3", "identified")
        low, high = (
            identified()["section"].sel(frequency=2.2, direction=direction)
            for direction in ("backward", "forward")
        )
        for start, direction in ((low, "backward"), (high, "forward")):
            again = vi.sweep(vi.Rig(case.oscillator, case.amplitude), [2.2], "forward", start=start)
            excursion = again["acceleration_excursion"].item()
            expected = identified()["acceleration_excursion"].sel(frequency=2.2)
            assert excursion == pytest.approx(expected.sel(direction=direction).item(), rel=1e-10)


class TestExtremes:
    @pytest.mark.parametrize("frequency", [0.55, 0.8, 1.3, 2.0, 2.6])
    def test_no_sample_exceeds_them_and_dense_samples_reach_them(self, frequency: float) -> None:
        data = identified().sel(frequency=frequency, direction="forward")
        case = vi.laboratory.case("B2-G1-A3", "identified")
        shaken = vi.Harmonic(case.amplitude, frequency)
        period = int(data["period"])
        again = vi.simulate(vi.Rig(case.oscillator, shaken), period, data["section"], 20_000)
        a = [
            again[name].values
            for name in ("acceleration", "event_acceleration_before", "event_acceleration_after")
        ]
        for kind, seen in (
            ("displacement", again["displacement"].values),
            ("acceleration", np.concatenate(a)),
        ):
            excursion = float(data[f"{kind}_excursion"])
            # The samples repeat the cycle to the tolerance of the sweep.
            over = seen.max() - data[f"{kind}_max"], data[f"{kind}_min"] - seen.min()
            assert max(over) <= 1e-11 * excursion
            assert min(over) >= -1e-6 * excursion

    def test_the_jump_where_a_contact_begins_counts(self) -> None:
        """In a heavily damped contact the force is largest at once, and falls from there."""
        made = vi.from_dimensionless(20.0, 0.5, 0.5, 0.15)
        oscillator, amplitude = made.oscillator, made.amplitude
        frequency = 1.2 * oscillator.natural_frequency
        data = vi.sweep(vi.Rig(oscillator, amplitude), [frequency], "forward").isel(
            direction=0, frequency=0
        )
        assert data["period"] == 1
        shaken = vi.Harmonic(amplitude, frequency)
        again = vi.simulate(vi.Rig(oscillator, shaken), 1, data["section"], 20_000)
        jumps = again["event_acceleration_after"].values[again["event_contact"].values == 1]
        assert data["acceleration_max"].item() == pytest.approx(jumps.max(), rel=1e-11)
        assert data["acceleration_min"].item() == pytest.approx(jumps.min(), rel=1e-11)
        assert again["acceleration"].max() < (1.0 - 1e-7) * jumps.max()

    def test_a_measured_window_is_that_of_its_states(self) -> None:
        case = vi.laboratory.case("B3-10mm-A3")
        data = vi.sweep(
            vi.Rig(case.oscillator, case.amplitude), [1.06], "forward", max_cycles=200, window=50
        ).isel(direction=0, frequency=0)
        assert data["motion"] == "undecided"
        assert data["status"] == 1
        assert data["period"] == 0
        assert data["cycles"] == 250
        before = vi.simulate(
            vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.06)), 200, samples=0
        )
        window = vi.simulate(
            vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.06)), 50, before, samples=2000
        )
        np.testing.assert_allclose(window["final_state"][:4], data["section"][:4], rtol=1e-6)
        seen = np.ptp(window["displacement"].values)
        assert seen == pytest.approx(float(data["displacement_excursion"]), rel=1e-4)
        hits = (window["event_contact"] == 1) & (window["event_stop"] == "right")
        assert int(hits.sum()) == float(data["impacts"].sel(stop="right")) * 50


class TestPublishedLandmarks:
    def test_b2_g1_a3_identified(self) -> None:
        """Secondary resonance near 0.6 Hz; jumps down near 2.66 Hz and up near 1.67 Hz."""
        data = identified()
        f = data["frequency"].values
        up = data["eta_a"].sel(direction="forward").values
        down = data["eta_a"].sel(direction="backward").values
        falls = -np.diff(up)
        assert f[np.argmax(falls)] == pytest.approx(2.65)
        rises = -np.diff(down)  # towards lower frequencies
        assert f[np.argmax(rises)] == pytest.approx(1.67)
        for steps in (falls, rises):
            second, first = np.sort(steps)[-2:]
            assert first > 1.3
            assert second < 0.15
        # Apart between the jumps only.
        apart = f[up - down > 0.15]
        np.testing.assert_array_equal(apart, f[(f > 1.675) & (f < 2.655)])
        low = f < 0.75
        assert 0.55 <= f[low][np.argmax(up[low])] <= 0.6

    def test_b3_10mm_a3_does_not_settle_from_1_02_to_1_10(self) -> None:
        data = swept("B3-10mm-A3", "table", 0.95, 1.2, 0.01)
        unsettled = data["motion"] == "undecided"
        assert unsettled.sel(frequency=slice(1.015, 1.105)).all()
        # A little outside, where motions settle slowly, the cycle limit may be reached.
        assert not unsettled.sel(frequency=slice(0.985)).any()
        assert not unsettled.sel(frequency=slice(1.125, None)).any()
        np.testing.assert_array_equal(unsettled, data["period"] == 0)
        np.testing.assert_array_equal(unsettled, data["status"] == 1)
        assert (data["cycles"].values[unsettled.values] >= 2500).all()
        assert not data["eta_a"].isnull().any()


class TestWrongInput:
    @pytest.mark.parametrize(
        ("frequencies", "message"),
        [
            ([], "frequencies: the list is empty"),
            ("1 Hz", "frequencies: '1 Hz' is not a list; pass a list of values"),
            (2.0, "frequencies: 2.0 is not a list"),
            ([1.0, 3.0, 2.0], "frequencies[2]: 2 Hz follows 3 Hz"),
            ([1.0, 1.0], "frequencies[1]: 1 Hz follows 1 Hz"),
            ([0.0, 1.0], "frequencies[0]: 0"),
            ([-1.0], "frequencies[0]: -1"),
            ([1.0, math.nan], "frequencies[1]: nan"),
            ([1.0, math.inf], "frequencies[1]: inf"),
            ([1.0, "2 kg"], "frequencies[1]: "),
            ([1.0, "quick"], "frequencies[1]: "),
            ([1.0, None], "frequencies[1]: "),
            ([[1.0, 2.0]], "frequencies[0]: "),
        ],
    )
    def test_frequencies(self, frequencies: object, message: str) -> None:
        self.refused(message, frequencies=frequencies)

    @pytest.mark.parametrize("directions", ["up", ("forward", "up"), ("forward", "forward"), ()])
    def test_directions(self, directions: object) -> None:
        self.refused("directions: ", directions=directions)

    @pytest.mark.parametrize(
        ("field", "value"),
        [
            ("shaking", 0.0),
            ("shaking", -1.0),
            ("shaking", math.nan),
            ("shaking", "0.05 gram"),
            ("phase", math.inf),
            ("phase", "1 m"),
            ("tolerance", 0.0),
            ("tolerance", 1.0),
            ("tolerance", math.nan),
            ("max_cycles", 0),
            ("max_cycles", 10.5),
            ("window", -1),
            ("max_events", 0),
            ("threads", 0),
            ("threads", 1.5),
        ],
    )
    def test_numbers(self, field: str, value: object) -> None:
        self.refused(f"{field}: ", **{field: value})

    def test_starts(self) -> None:
        self.refused("start.deformation.right: ", start=vi.State(0.02, deformation={"right": 0.0}))
        self.refused("start: ", start=3.0)

    def test_rigs(self) -> None:
        with pytest.raises(
            vi.InputError, match=r"^rigs: the list is empty; pass at least one rig$"
        ):
            vi.sweeps([], [1.0])
        case = vi.laboratory.case("B2-G1-A3")
        with pytest.raises(vi.InputError, match=r"^rigs\[1\]\.shaking: 0"):
            vi.sweeps([case, vi.Rig(case.oscillator, vi.Harmonic(0.0, 1.0))], [1.0])
        for wrong in ([case.oscillator], [(case.oscillator,)], [3.0], [(1.0, 2.0)]):
            with pytest.raises(vi.InputError, match=r"^rigs\[0\]: .*; (use|pass)"):
                vi.sweeps(wrong, [1.0])
        for wrong in (case.oscillator, "B9", 3.0):
            with pytest.raises(vi.InputError, match=r"^rigs(\[0\])?: .*; (use|pass)"):
                vi.sweeps(wrong, [1.0])

    @staticmethod
    def refused(message: str, **arguments: object) -> None:
        case = vi.laboratory.case("B2-G1-A3")
        options = {"frequencies": [1.0, 2.0], **arguments}
        with pytest.raises(vi.InputError) as caught:
            vi.sweep(vi.Rig(case.oscillator, options.pop("shaking", case.amplitude)), **options)
        text = str(caught.value)
        assert text.startswith(message)
        assert re.search(r"; .*(use|pass|sort) ?", text)
        assert "\n" not in text


class TestGivenUp:
    def test_too_many_events(self) -> None:
        case = vi.laboratory.case("B2-G1-A3")
        data = vi.sweep(
            vi.Rig(case.oscillator, case.amplitude), [0.3, 2.0], "forward", max_events=8
        ).isel(direction=0)
        assert data["status"].values.tolist() == [2, 0]
        assert data["motion"].values.tolist() == ["undecided", "periodic"]
        assert np.isnan(data["eta_a"].values).tolist() == [True, False]
        assert data["status"].attrs["flag_meanings"].split()[2] == "too_many_events"

    def test_too_much_work(self) -> None:
        rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.Bumper(1e30, 0.0, 0.5))
        data = vi.sweep(vi.Rig(rig, 1.0), [0.1])
        assert (data["status"] == 3).all()
        assert data["eta_d"].isnull().all()


@pytest.mark.parametrize(
    "left", [vi.RigidStop(0.6, "-20 mm"), vi.Bumper("510 kN/m", 0.0, "-20 mm")]
)
def test_behind_a_hold_that_was_given_up_a_preloaded_rig_goes_on_from_its_start(left):
    """u = 0 would be inside its stop."""
    rig = vi.Oscillator("550 kg", vi.Isolator("26.8 kN/m", "1.1 kN s/m"), None, left)
    options = {"directions": "forward", "max_events": 1}
    both = vi.sweep(vi.Rig(rig, [5.0, 0.5]), [0.5, 1.6], **options)
    alone = vi.sweep(vi.Rig(rig, 0.5), [1.6], **options)
    assert both["status"].values.ravel().tolist() == [2, 0]
    assert both["displacement_max"].values[0, 1] == alone["displacement_max"].values[0, 0]
