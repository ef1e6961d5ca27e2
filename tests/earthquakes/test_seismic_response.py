"""The seismic response beside what is seen of the whole motion, and beside closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.rigs import RIGS, noise
from vibroimpact.datasets.stops import by_stop
from vibroimpact.earthquakes.free_vibration import free_tail

RECORD = noise(8)
SIDES = {"right": 1, "left": -1}


@pytest.mark.parametrize("name", RIGS)
def test_every_number_is_that_of_the_whole_motion(name: str) -> None:
    """The engine's one pass against samples, events, contacts and totals of a time history."""
    rig = RIGS[name]
    response = vi.seismic_response(vi.Rig(rig, RECORD), tail=3.0)
    assert response["status"] == 0
    assert int(response["status"]) == 0
    motion = vi.simulate(vi.Rig(rig, RECORD), tail=3.0, samples=50)
    whole = vi.totals(motion)
    u, a = motion["displacement"].values, motion["acceleration"].values
    for side, sign in SIDES.items():
        peak = float(sign * response["displacement_max" if side == "right" else "displacement_min"])
        samples = float((sign * u).max())
        assert -1e-12 <= peak - samples <= 1e-3 * abs(peak)
    assert float(response["displacement_max"]) == pytest.approx(
        float(whole["displacement_max"]), rel=1e-12
    )
    assert -float(response["displacement_min"]) == pytest.approx(
        -float(whole["displacement_min"]), rel=1e-12
    )
    largest = max(float(whole["acceleration_max"]), -float(whole["acceleration_min"]))
    assert float(response["peak_acceleration"]) == pytest.approx(largest, rel=1e-12)
    assert float(response["peak_acceleration"]) >= np.abs(a).max() - 1e-12
    for key in ("total_supplied", "total_isolator", "total_bumpers"):
        size = float(whole["total_supplied"])
        assert float(response[key]) == pytest.approx(float(whole[key]), rel=1e-9, abs=1e-9 * size)
    begun = motion["event_contact"].values >= 1
    for side in response["stop"].values:
        mine = begun & (motion["event_stop"].values == side)
        assert int(response["impact_count"].sel(stop=side)) == mine.sum()
    assert int(response["impact_count"].sum()) > 4
    assert float(response["peak_displacement"]) == max(
        float(response["displacement_max"]), -float(response["displacement_min"])
    )


@pytest.mark.parametrize("name", ["bumpers", "elastic", "bilinear", "curved"])
def test_forces_and_impulses_are_those_of_the_contacts(name: str) -> None:
    rig = RIGS[name]
    response = vi.seismic_response(vi.Rig(rig, RECORD), tail=3.0)
    log = vi.contacts(vi.simulate(vi.Rig(rig, RECORD), tail=3.0))
    for side in response["stop"].values:
        mine = log["contact_stop"].values == side
        force = log["contact_peak_force"].values[mine].max(initial=0.0)
        impulse = log["contact_impulse"].values[mine].sum()
        assert float(response["peak_force"].sel(stop=side)) == pytest.approx(force, rel=1e-11)
        assert float(response["impulse"].sel(stop=side)) == pytest.approx(
            impulse, rel=1e-11, abs=1e-12
        )
    assert float(response["peak_force"].max()) > 1.0


def test_a_rigid_stop_has_an_impulse_and_an_infinite_force() -> None:
    rig = RIGS["walls"]
    response = vi.seismic_response(vi.Rig(rig, RECORD), tail=3.0)
    log = vi.contacts(vi.simulate(vi.Rig(rig, RECORD), tail=3.0))
    for side in SIDES:
        impulse = log["contact_impulse"].values[log["contact_stop"].values == side].sum()
        assert float(response["impulse"].sel(stop=side)) == pytest.approx(impulse, rel=1e-9)
        assert math.isinf(response["peak_force"].sel(stop=side))
    # What never touches it presses nothing.
    quiet = vi.seismic_response(vi.Rig(rig, RECORD.scaled(1e-3)))
    for name in ("peak_force", "impulse", "impact_count"):
        assert not quiet[name].any()


def test_a_contact_that_was_there_before_counts() -> None:
    """A preloaded stop is pressed from the beginning on, which `contacts` leaves out."""
    rig = RIGS["preloaded"]
    still = vi.seismic_response(vi.Rig(rig, vi.Record([0.0, 0.0], 0.5)), tail=0.5)
    rest = float(still["residual_displacement"])
    force = 500.0 * (rest + 0.02)
    assert force > 1.0
    assert float(still["peak_force"].sel(stop="right")) == pytest.approx(force, rel=1e-12)
    assert float(still["impulse"].sel(stop="right")) == pytest.approx(force * 1.0, rel=1e-12)
    assert not still["impact_count"].any()


@pytest.mark.parametrize("damping", [0.0, 0.02, 0.3])
@pytest.mark.parametrize("period", [0.1, 0.7, 3.0])
def test_a_linear_rig_without_stops_is_an_oscillator_of_the_response_spectrum(
    period: float, damping: float
) -> None:
    """Two engines of one equation; what follows the record's end counts in both."""
    omega = math.tau / period
    rig = vi.Oscillator(3.0, vi.Isolator(3.0 * omega**2, 6.0 * damping * omega))
    cut = RECORD.cut(0.0, 3.0)  # which ends in the middle of the strongest shaking
    response = vi.seismic_response(vi.Rig(rig, cut))
    spectrum = vi.response_spectrum(cut, period, damping)
    for key, name in (
        ("peak_displacement", "spectral_displacement"),
        ("peak_acceleration", "spectral_acceleration"),
    ):
        assert float(response[key]) == pytest.approx(float(spectrum[name]), rel=1e-11)


def test_a_scale_is_a_record_that_was_scaled() -> None:
    from vibroimpact.datasets.stops import has_stops
    from vibroimpact.earthquakes.peak_demands import ScaledRecord, peaks

    factors = np.array([0.3, 1.0, 1.7])
    for rig in RIGS.values():
        together = peaks([ScaledRecord(rig, RECORD, factors)], residuals=True)
        for k, factor in enumerate(factors.tolist()):
            alone = vi.seismic_response(vi.Rig(rig, RECORD.scaled(factor)))
            for name, values in together.items():
                value = values[0, k]
                if has_stops(name):
                    value = by_stop(rig, value)
                np.testing.assert_allclose(value, alone[name], rtol=1e-11, atol=1e-13)


def test_where_an_elastic_isolator_rests() -> None:
    rig = RIGS["walls"]
    response = vi.seismic_response(vi.Rig(rig, RECORD))
    assert float(response["residual_displacement"]) == pytest.approx(0.2 / 50.0, rel=1e-14)
    assert float(response["residual_swing"]) == 0.0


def test_where_an_undamped_bilinear_isolator_rests() -> None:
    """It swings elastically for ever, about where its yielded element and its spring agree."""
    rig = vi.Oscillator(2.0, vi.BilinearIsolator(80.0, 8.0, 1.0, 0.0))
    response = vi.seismic_response(vi.Rig(rig, RECORD))
    motion = vi.simulate(vi.Rig(rig, RECORD), tail=60.0, samples=1)
    u, z = motion["displacement"].values[-1], motion["isolator_memory"].values[-1]
    # 8 r + 72 (z + r - u) = 0: at rest both pull equally, z moving as u does.
    assert abs(u - 72.0 * (u - z) / 80.0) > 1e-4
    assert float(response["residual_displacement"]) == pytest.approx(
        72.0 * (u - z) / 80.0, rel=1e-9
    )
    assert float(response["residual_swing"]) > 1e-4


@pytest.mark.parametrize("name", ["bilinear", "friction", "curved"])
def test_where_a_damped_hysteretic_isolator_rests(name: str) -> None:
    rig = RIGS[name]
    response = vi.seismic_response(vi.Rig(rig, RECORD))
    long = vi.simulate(vi.Rig(rig, RECORD), tail=300.0, samples=0)["final_state"].values
    size = float(response["peak_displacement"])
    assert abs(long[1]) < 1e-6
    swing = float(response["residual_swing"])
    assert swing <= 1e-9 * size
    # That bounds the error, but for rounding.
    assert abs(float(response["residual_displacement"]) - long[0]) <= swing + 1e-13 * size
    assert abs(long[0]) > 1e-3 * size


@pytest.mark.parametrize("seed", range(6))
def test_where_it_rests_is_right_to_the_swing_that_is_left(seed: int) -> None:
    """Filtered random records, and 300 s of free vibration as the reference."""
    generator = np.random.default_rng(seed)
    samples = np.convolve(generator.normal(size=300), np.hanning(9), "same")
    record = vi.Record(samples * generator.uniform(0.3, 2.0), 0.02)
    stiffness, load = 10.0 ** generator.uniform(1.0, 3.0), 10.0 ** generator.uniform(-2.0, 0.5)
    damping = 0.3 * math.sqrt(stiffness)
    laws = [
        vi.BoucWenIsolator(stiffness, 0.4 * stiffness, load, damping),
        vi.BoucWenIsolator(stiffness, 0.2 * stiffness, load, damping, exponent=2),
        vi.BilinearIsolator(stiffness, 0.3 * stiffness, load, damping),
        vi.ExponentialIsolator(stiffness, 0.4 * stiffness, 1.0 / load, damping),
    ]
    for law in laws:
        rig = vi.Oscillator(1.0, law)
        response = vi.seismic_response(vi.Rig(rig, record))
        motion = vi.simulate(vi.Rig(rig, record), tail=300.0, samples=1)
        place, size = motion["displacement"].values[-1], float(response["peak_displacement"])
        assert np.ptp(motion["displacement"].values[-500:]) <= 1e-12 * size
        swing = float(response["residual_swing"])
        assert abs(float(response["residual_displacement"]) - place) <= swing + 1e-12 * size


@pytest.mark.parametrize("exponent", [1, 2, 3])
def test_free_vibration_that_has_died_out_goes_on(exponent: int) -> None:
    """The mass rests where its forces cancel, and rounding does not turn it without end."""
    law = vi.BoucWenIsolator(
        elastic_stiffness=1619.78,
        post_yield_stiffness=278.913,
        yield_force=0.00211939,
        damping=3.0,
        exponent=exponent,
    )
    record = vi.Record(np.random.default_rng(0).normal(size=300) * 0.5, 0.02)
    motion = vi.simulate(vi.Rig(vi.Oscillator(1.0, law), record), tail=200.0, samples=1)
    assert motion["status"] == 0
    u, z = motion["displacement"].values[-1], motion["isolator_memory"].values[-1]
    pulls = 278.913 * u + (1619.78 - 278.913) * z
    assert abs(pulls) <= 1e-14 * abs(278.913 * u)
    assert abs(u) > 1e-10


def test_the_tail_is_two_periods_of_the_softest_spring() -> None:
    rig = vi.Oscillator(2.0, vi.BilinearIsolator(80.0, 8.0, 1.0, 0.3))
    assert free_tail(vi.Rig(rig, RECORD)) == pytest.approx(2.0 * math.tau * math.sqrt(2.0 / 8.0))
    sliding = vi.Oscillator(2.0, vi.FrictionIsolator(0.0, 0.1, 0.6))
    assert free_tail(vi.Rig(sliding, RECORD)) == RECORD.duration
    slow = vi.Oscillator(2.0, vi.Isolator(1e-9, 0.1))
    assert free_tail(vi.Rig(slow, RECORD)) == 60.0


def test_what_is_given_up_is_told() -> None:
    with pytest.warns(
        RuntimeWarning, match="seismic_response: one forcing cycle or record step has more events"
    ):
        response = vi.seismic_response(vi.Rig(RIGS["walls"], noise(8, step=0.5)), max_events=1)
    assert int(response["status"]) != 0
    assert "max_events" in response.attrs["message"]
    assert np.isnan(response["peak_displacement"])


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (
            {"shaking": vi.Harmonic(1.0, 1.0)},
            r"shaking: .* is not a Record; pass Rig\(oscillator, record\)",
        ),
        ({"tail": -1.0}, "tail: -1"),
        ({"max_events": 0}, "max_events: 0"),
    ],
)
def test_wrong_input(arguments: dict, line: str) -> None:
    rig = vi.Rig(RIGS["bumpers"], arguments.pop("shaking", RECORD))
    with pytest.raises(vi.InputError, match=f"^{line}"):
        vi.seismic_response(rig, **arguments)
