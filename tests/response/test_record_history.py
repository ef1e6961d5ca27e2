"""Motions under a record: what the straight lines mean, and what the dataset holds."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from reference.paper_signs import in_paper_signs, signed_parts
from reference.public_motion import events

RIGS = {
    "bumpers": vi.Oscillator(
        2.0, vi.Isolator(5.0, 0.3), vi.Bumper(60.0, 0.9, 0.1), vi.Bumper(40.0, 0.5, 0.15)
    ),
    "walls": vi.Oscillator(
        2.0, vi.Isolator(5.0, 0.3), vi.RigidStop(0.5, 0.2), vi.RigidStop(0.3, 0.1), force=0.2
    ),
    "no spring": vi.Oscillator(
        2.0, vi.Isolator(0.0, 0.3), vi.RigidStop(0.5, 0.2), vi.Bumper(40.0, 0.5, 0.15)
    ),
}
STEP = 0.125
ROUGH = vi.Record(np.random.default_rng(5).uniform(-4.0, 4.0, 65), STEP)
PAPER = ("displacement", "velocity", "right_bumper", "left_bumper")
STATE = ("displacement", "velocity", "deformation")


def finer(record: vi.Record, parts: int) -> vi.Record:
    """The same straight lines, in parts."""
    time = np.arange((len(record.acceleration) - 1) * parts + 1) * (record.step / parts)
    return vi.Record(record.at(time), record.step / parts)


@pytest.mark.parametrize("parts", [2, 7, 64])
@pytest.mark.parametrize("name", RIGS)
def test_the_same_lines_in_parts_are_the_same_motion(name: str, parts: int) -> None:
    rig = RIGS[name]
    whole = vi.simulate(vi.Rig(rig, ROUGH), samples=parts, tail=1.0)
    cut = vi.simulate(vi.Rig(rig, finer(ROUGH, parts)), tail=1.0)
    np.testing.assert_allclose(cut["time"], whole["time"], rtol=1e-14)
    for one in (*STATE, "base_acceleration"):
        size = float(np.abs(whole[one]).max())
        assert float(np.abs(whole[one].values - cut[one].values).max()) <= 1e-12 * size, one
    fast = [
        [e for e in events(data) if "impact" not in e.kind or abs(e.v) > 1e-3]
        for data in (whole, cut)
    ]
    assert len(fast[0]) >= 8
    assert [e.kind for e in fast[0]] == [e.kind for e in fast[1]]
    np.testing.assert_allclose(
        [e.time for e in fast[0]], [e.time for e in fast[1]], rtol=0.0, atol=1e-11
    )


@pytest.mark.parametrize("name", RIGS)
def test_a_sine_sampled_ever_finer_becomes_a_harmonic(name: str) -> None:
    """The error of a straight line is of the second order of its length."""
    rig, shaken = RIGS[name], vi.Harmonic(2.0, 0.3, 0.4)
    cycles = 2
    exact = vi.simulate(vi.Rig(rig, shaken), cycles, samples=0)["final_state"].values[:2]
    errors = []
    for count in (100, 200, 400, 800):
        step = cycles / shaken.frequency / count
        angles = shaken.angular_frequency * step * np.arange(count + 1) + shaken.phase
        end = vi.simulate(vi.Rig(rig, vi.Record(shaken.at(angles), step)), samples=0)["final_state"]
        errors.append(math.hypot(*(end.values[:2] - exact)))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[0] > 1e-7
    assert abs(orders[-1] - 2.0) < 0.1
    assert errors[-1] < 1e-3


def test_what_the_dataset_holds() -> None:
    rig = RIGS["bumpers"]
    data = vi.simulate(vi.Rig(rig, ROUGH), tail="0.3 s")
    end = ROUGH.duration + 0.3
    np.testing.assert_array_equal(data["time"][:65], STEP * np.arange(65))
    np.testing.assert_allclose(data["time"][65:], [8.125, 8.25, end])
    np.testing.assert_array_equal(data["base_acceleration"][:65], ROUGH.acceleration)
    np.testing.assert_array_equal(data["base_acceleration"][65:], 0.0)
    assert "cycle" not in data.variables
    signed = in_paper_signs(data)
    last = [signed[name].values[-1] for name in PAPER]
    np.testing.assert_array_equal(signed_parts(data["final_state"].values), last)
    # What happens between the samples is what is seen at many of them.
    often = vi.simulate(vi.Rig(rig, ROUGH), samples=50, tail="0.3 s")
    for one in data.data_vars:
        if str(one).startswith("event"):
            np.testing.assert_array_equal(data[one], often[one])
        elif "time" in data[one].dims:
            few, same = slice(65), slice(0, 64 * 50 + 1, 50)
            np.testing.assert_allclose(
                data[one].isel(time=few), often[one].isel(time=same), atol=1e-13
            )
    assert float(data["event_time"].max()) > 1.0
    np.testing.assert_array_equal(data["final_state"], often["final_state"])


def test_a_sample_at_one_of_the_record_is_that_one() -> None:
    """Three thirds of a step may be more than one by rounding: the base is not at rest there."""
    record = vi.Record([0.0, 1.0, -2.0, 3.0], 0.01)
    data = vi.simulate(vi.Rig(RIGS["bumpers"], record), samples=3, tail=0.02)
    assert data["time"][9] > record.duration
    np.testing.assert_array_equal(data["base_acceleration"][:10:3], record.acceleration)
    np.testing.assert_array_equal(data["base_acceleration"][10:], 0.0)
    log, whole = (
        vi.totals(vi.simulate(vi.Rig(RIGS["bumpers"], record), samples=n, tail=0.02))
        for n in (3, 1)
    )
    assert log.identical(whole)


def test_an_event_lies_between_its_samples() -> None:
    """At its time the mass is where it meets the face of the bumper."""
    data = vi.simulate(vi.Rig(RIGS["walls"], ROUGH), samples=200)
    time = data["time"].values
    for e in events(data):
        if e.kind.startswith("impact"):
            side = "right" if e.kind.endswith("right") else "left"
            assert e.u == pytest.approx({"right": 0.2, "left": -0.1}[side], rel=1e-15)
            near = np.abs(time - e.time) < STEP / 100
            assert data["clearance"].sel(stop=side).values[near].min() < 0.02
    # Behind the record the events go on being told, in the same time.
    tail = vi.simulate(vi.Rig(RIGS["walls"], vi.Record([0.0, 30.0, 0.0], 0.1)), tail=5.0, samples=0)
    assert tail["final_state"].values[1] == pytest.approx(0.0, abs=1.0)
    behind = vi.simulate(vi.Rig(RIGS["walls"], vi.Record([0.0, 30.0, 0.0], 0.1)), tail=5.0)
    assert behind["event_time"].values.max() > 0.2
    assert (np.diff(behind["event_time"].values) >= 0.0).all()


def test_behind_the_record_it_vibrates_freely() -> None:
    """As from its last state with the base at rest."""
    rig = RIGS["bumpers"]
    through = vi.simulate(vi.Rig(rig, ROUGH), samples=0)
    tail = vi.simulate(vi.Rig(rig, ROUGH), samples=0, tail=2.9)["final_state"].values
    still = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 1 / 2.9)), 1, through, samples=0)[
        "final_state"
    ].values
    np.testing.assert_allclose(tail[:4], still[:4], atol=1e-13)
    long = vi.simulate(vi.Rig(rig, ROUGH), samples=0, tail=400.0)["final_state"].values
    assert np.abs(long[:4]).max() < 1e-12


def test_a_final_state_goes_on_with_the_next_record() -> None:
    rig = RIGS["bumpers"]
    values = ROUGH.acceleration
    for at in (1, 17, 40, 63):
        first = vi.simulate(vi.Rig(rig, vi.Record(values[: at + 1], STEP)), samples=0)
        end = vi.simulate(vi.Rig(rig, vi.Record(values[at:], STEP)), start=first, samples=0)
        whole = vi.simulate(vi.Rig(rig, ROUGH), samples=0)
        np.testing.assert_allclose(
            end["final_state"].values[:4], whole["final_state"].values[:4], atol=1e-12
        )


def test_a_pressed_bumper_goes_on_pressed() -> None:
    """Cut where a bumper presses, and where a mass rests on a wall."""
    for name in ("bumpers", "walls"):
        rig = RIGS[name]
        pushed = vi.Record([3.0, -6.0, -6.0, -6.0, -6.0, 3.0, 6.0, 0.0], 1.0)
        data = vi.simulate(vi.Rig(rig, pushed))
        contact = in_paper_signs(data)["contact"].values
        touched = np.flatnonzero(contact[1:-1]) + 1
        assert len(touched) >= 2
        for at in touched.tolist():
            first = vi.simulate(vi.Rig(rig, vi.Record(pushed.acceleration[: at + 1], 1.0)))
            touched = first["final_state"].values[5:7].tolist()
            assert touched == [float(contact[at] in (side, 2)) for side in (1, -1)]
            rest = vi.Record(pushed.acceleration[at:], 1.0)
            end = vi.simulate(vi.Rig(rig, rest), start=first, samples=0)["final_state"].values
            np.testing.assert_allclose(end, data["final_state"].values, atol=1e-12)


def test_one_line_in_flight_is_its_closed_form() -> None:
    """Without spring and dashpot a line of acceleration is a cubic of displacement."""
    rig = vi.Oscillator(3.0, vi.Isolator(0.0, 0.0), vi.RigidStop(0.5, 1e3), vi.RigidStop(0.5, 1e3))
    data = vi.simulate(
        vi.Rig(rig, vi.Record([1.0, 4.0], 2.0)), start=vi.State(0.3, 0.7), samples=10
    )
    t = data["time"].values
    np.testing.assert_allclose(data["displacement"], 0.3 + 0.7 * t - t**2 / 2 - t**3 / 4)
    np.testing.assert_allclose(data["velocity"], 0.7 - t - 0.75 * t**2, atol=1e-14)
    np.testing.assert_allclose(data["acceleration"], 0.0, atol=1e-14)


def test_a_record_without_motion_leaves_the_mass_at_rest() -> None:
    data = vi.simulate(vi.Rig(RIGS["walls"], vi.Record([0.0, 0.0, 0.0], 0.5)), tail=1.0)
    np.testing.assert_allclose(data["displacement"], 0.2 / 5.0, rtol=1e-15)
    np.testing.assert_allclose(data["velocity"], 0.0, atol=1e-16)


def test_a_motion_given_up_keeps_what_was_found() -> None:
    with pytest.warns(RuntimeWarning, match="simulate stopped .* s into the record: "):
        data = vi.simulate(vi.Rig(RIGS["walls"], ROUGH), max_events=1)
    assert data["status"] != 0
    assert 0 < data.sizes["time"] < 65
    assert np.isfinite(data["displacement"]).all()


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ({"cycles": 5}, "cycles: 5, but a record has no cycles; "),
        ({"tail": -1.0}, "tail: -1"),
        ({"tail": "5 m"}, "tail: .*5 m"),
        ({"samples": -1}, "samples: -1"),
    ],
)
def test_what_makes_no_sense_with_a_record_is_refused(arguments: dict, line: str) -> None:
    with pytest.raises(vi.InputError, match=f"^{line}"):
        vi.simulate(vi.Rig(RIGS["bumpers"], ROUGH), **arguments)


def test_a_tail_is_for_records() -> None:
    with pytest.raises(
        vi.InputError, match=r"^tail: 2.0, but no Record shakes this rig; remove tail"
    ):
        vi.simulate(vi.Rig(RIGS["bumpers"], vi.Harmonic(1.0, 1.0)), 3, tail=2.0)
    with pytest.raises(vi.InputError, match=r"^cycles: missing; pass the number of forcing cycles"):
        vi.simulate(vi.Rig(RIGS["bumpers"], vi.Harmonic(1.0, 1.0)))


@pytest.mark.parametrize(
    "ask",
    [
        lambda rig, record: vi.orbit(vi.Rig(rig, record)),
        lambda rig, record: vi.steady(vi.Rig(rig, record)),
        lambda rig, record: vi.branch(vi.Rig(rig, record), vary={"frequency": (1.0, 2.0)}),
        lambda rig, record: vi.lyapunov_exponents([vi.Rig(rig, record)], [1.0]),
        lambda rig, record: vi.sweeps([vi.Rig(rig, record)], [1.0]),
        lambda rig, record: vi.sweep(vi.Rig(rig, record), [1.0]),
        lambda rig, record: vi.coexisting_motions(vi.Rig(rig, record)),
        lambda rig, record: vi.classify_scenario(vi.Rig(rig, record)),
        lambda rig, record: vi.resonance_diagram(vi.Rig(rig, record), {"frequency": [1.0, 2.0]}),
    ],
)
def test_where_a_period_is_asked_a_record_is_refused(ask) -> None:
    with pytest.raises(vi.InputError, match=r"^\w+: a Record has no period, ") as refused:
        ask(RIGS["bumpers"], ROUGH)
    assert "\n" not in str(refused.value)
