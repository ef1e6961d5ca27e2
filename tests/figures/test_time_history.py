"""The figure of a time history: curves through the events, bands between them."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_hex

import vibroimpact as vi
from vibroimpact.figures import save_figure, time_history
from vibroimpact.figures.style import SWEEPS

MARKS = ["contact begins", "contact ends", "peak in contact"]


@cache
def motion(code="B2-G1-A3", frequency=0.58, cycles=20.0, samples=64) -> xr.Dataset:
    case = vi.laboratory.case(code)
    excitation = vi.Harmonic(case.amplitude, frequency)
    return vi.simulate(vi.Rig(case.oscillator, excitation), cycles, samples=samples)


def bands(ax) -> dict[str, list[tuple[float, float]]]:
    return {
        c.get_label(): [(p.vertices[:, 0].min(), p.vertices[:, 0].max()) for p in c.get_paths()]
        for c in ax.collections
    }


def curve(ax):
    (line,) = (line for line in ax.lines if len(line.get_xdata()) > 2)
    return line.get_xdata(), line.get_ydata()


def test_labels_with_units():
    axes = time_history(motion())
    assert [("(mm)" in a.get_ylabel(), "/s" in a.get_ylabel()) for a in axes] == [
        (True, False),
        (False, True),
        (False, True),
    ]
    assert "t/T" in axes[2].get_xlabel()
    texts = [t.get_text() for t in axes[0].get_legend().get_texts()]
    assert texts == ["motion", "gaps", "right contact", "left contact", *MARKS]


def test_last_cycles_are_shown():
    for ax in time_history(motion()):
        assert ax.get_xlim() == (17.0, 20.0)
        assert curve(ax)[0].min() >= 17.0
    assert time_history(motion(), cycles=100.0)[0].get_xlim() == (0.0, 20.0)


def test_bands_between_the_exact_events():
    data = motion()
    at = data["event_cycle"].values + data["event_cycle_time"].values * 0.58
    for side, name in (("right", "right contact"), ("left", "left contact")):
        mine = data["event_stop"].values == side
        begins = at[mine & (data["event_contact"].values == 1)]
        stops = at[mine & (data["event_contact"].values == 0)]
        expected = [(a, b) for a, b in zip(begins, stops, strict=True) if b >= 17.0]
        assert len(expected) == 3
        for ax in time_history(data):
            np.testing.assert_allclose(bands(ax)[name], expected, rtol=1e-14)


def test_band_of_a_contact_that_was_there_from_the_start_or_is_there_at_the_end():
    case = vi.laboratory.case("B2-G1-A3")
    data = vi.simulate(
        vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.0)), 0.05, vi.State(0.009, 0.1)
    )
    assert data["touching"].sel(stop="right").values[0]
    (band,) = bands(time_history(data)[0])["right contact"]
    assert band[0] == 0.0
    inside = vi.simulate(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 0.58)), 19.7)
    (name,) = inside["stop"].values[inside["touching"].isel(time=-1)]
    assert bands(time_history(inside)[0])[f"{name} contact"][-1][1] == pytest.approx(19.7)


def test_the_jump_of_acceleration_is_drawn_upright():
    data = motion()
    x, y = curve(time_history(data, cycles=20.0)[1])
    upright = np.flatnonzero(np.diff(x) == 0.0)
    before, behind = (data[f"event_acceleration_{n}"].values for n in ("before", "after"))
    np.testing.assert_array_equal(y[upright], before)
    np.testing.assert_array_equal(y[upright + 1], behind)


def test_gaps_are_lines_at_their_place():
    case = vi.laboratory.case("B2-G1-A3")
    one_sided = case.oscillator.replace(left=None, right=case.oscillator.right.replace(gap=0.004))
    data = vi.simulate(vi.Rig(one_sided, vi.Harmonic(case.amplitude, 0.58)), 5)
    ax = time_history(data)[0]
    dashed = [line.get_ydata()[0] for line in ax.lines if line.get_linestyle() == "--"]
    assert dashed == pytest.approx([4.0])
    texts = [t.get_text() for t in ax.get_legend().get_texts()]
    assert texts == ["motion", "gap", "right contact", *MARKS]


def test_free_flight(tmp_path):
    axes = time_history(motion("B2-Ginf-A3"), title="free")
    assert [t.get_text() for t in axes[0].get_legend().get_texts()] == ["motion"]
    assert save_figure(axes[0], tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_dots_at_the_events_and_stars_at_the_peaks():
    data = motion()
    at = data["event_time"].values * 0.58
    shown = at > 17.0
    begins = data["event_contact"].values == 1
    sides = np.where(data["event_stop"].values == "right", 1, -1)
    for ax, values in zip(
        time_history(data),
        (
            1e3 * data["event_displacement"].values,
            # Where the acceleration jumps, the value in contact.
            np.where(begins, *(data[f"event_acceleration_{n}"] for n in ("after", "before"))),
            data["event_velocity"].values,
        ),
        strict=True,
    ):
        dots = marks(ax)
        full, hollow = dots[:2]
        for (where, colour), filled in ((full, True), (hollow, False)):
            mine = shown & (begins == filled)
            assert mine.sum() == 6
            where = where[np.argsort(where[:, 0])]  # drawn side by side
            np.testing.assert_allclose(where, np.column_stack([at, values])[mine], rtol=1e-12)
            assert (colour == "#ffffff") is not filled
        assert len(dots) == (3 if "acceleration" in ax.get_ylabel() else 2)

    # The peaks, from the same motion looked at so often that none lies between.
    fine = motion(samples=8192)
    a = fine["acceleration"].values
    (where, _) = marks(time_history(data)[1])[2]
    assert len(where) == 6
    for (time, height), begin, stop, side in zip(
        where, at[shown & begins], at[shown & ~begins], sides[shown & begins], strict=True
    ):
        inside = (fine["cycle"].values >= begin) & (fine["cycle"].values <= stop)
        index = np.argmax(np.where(inside, np.abs(a), 0.0))
        assert height == pytest.approx(a[index], rel=1e-5)
        assert abs(time - fine["cycle"].values[index]) < 2 / 8192
        assert np.sign(height) == -side


@pytest.mark.parametrize("frequency", np.linspace(0.55, 0.8, 7))
def test_dots_have_the_values_of_their_events(frequency):
    """However the time of an event in cycles is rounded."""
    data = motion(frequency=float(frequency))
    begins = data["event_contact"].values == 1
    for ax, values in zip(
        time_history(data, cycles=20.0),
        (
            1e3 * data["event_displacement"].values,
            np.where(begins, *(data[f"event_acceleration_{n}"] for n in ("after", "before"))),
            data["event_velocity"].values,
        ),
        strict=True,
    ):
        for (where, _), mine in zip(marks(ax)[:2], (begins, ~begins), strict=True):
            drawn = where[np.argsort(where[:, 0]), 1]
            np.testing.assert_array_equal(drawn, values[mine][: len(drawn)])
            assert len(drawn) == mine.sum()


@pytest.mark.full
def test_a_peak_at_a_jump_of_the_acceleration_has_its_sign():
    """A force pushes the mass towards a dashpot, whose force at once is the peak."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.05), vi.Bumper(1.0, 30.0, 0.1))
    turned = 0
    for frequency in np.linspace(0.5, 0.9, 9):
        shaken = vi.Harmonic(15.0, float(frequency), of="force")
        data = vi.simulate(vi.Rig(rig, shaken), 12, samples=20)
        begins = data["event_contact"].values == 1
        before, after = (
            data[f"event_acceleration_{n}"].values[begins] for n in ("before", "after")
        )
        peaks = vi.contacts(data)["contact_peak_acceleration"].values
        (where, _) = marks(time_history(data, cycles=12.0)[1])[2]
        first = np.isclose(peaks, np.abs(after[: len(peaks)]), rtol=1e-12)
        np.testing.assert_allclose(where[first, 1], after[: len(peaks)][first], rtol=1e-12)
        turned += int(np.sum(first & (before[: len(peaks)] * after[: len(peaks)] < 0.0)))
    assert turned > 20


def marks(ax) -> list[tuple[np.ndarray, str]]:
    """Places and colours of the marks: beginnings, ends, and the peaks of the acceleration."""
    points = [c for c in ax.collections if len(c.get_offsets()) and not c.get_label()[0].isalpha()]
    return [(np.asarray(c.get_offsets()), to_hex(c.get_facecolor()[0])) for c in points]


def test_several_motions_have_strips_of_their_own():
    named = {
        "forward sweep at 0.58 Hz": motion(),
        "backward sweep at 0.6 Hz": motion(frequency=0.6),
        "free": motion("B2-Ginf-A3"),
    }
    axes = time_history(named, cycles=2.0)
    for ax in axes:
        lines = [line for line in ax.lines if len(line.get_xdata()) > 2]
        assert [line.get_color() for line in lines] == [
            SWEEPS["forward"].colour,
            SWEEPS["backward"].colour,
            "black",
        ]
        assert [line.get_linestyle() for line in lines] == ["-", "--", "-"]
        strips = [c for c in ax.collections if c.get_label().endswith("contact")]
        assert [c.get_label() for c in strips] == ["right contact", "left contact"] * 3
        for number, ((name, data), frequency) in enumerate(
            zip(named.items(), (0.58, 0.6, 0.58), strict=True)
        ):
            for strip, side in zip(
                strips[2 * number : 2 * number + 2], ("right", "left"), strict=True
            ):
                at = data["event_time"].values[data["event_stop"].values == side] * frequency
                expected = [pair for pair in at.reshape(-1, 2) if pair[1] >= 18.0]
                corners = [path.vertices for path in strip.get_paths()]
                assert len(corners) == len(expected) == (0 if name == "free" else 2)
                for corner, pair in zip(corners, expected, strict=True):
                    assert corner[:, 0].min() == pytest.approx(max(pair[0], 18.0))
                    assert corner[:, 0].max() == pytest.approx(pair[1])
                    # In thirds of the panel's height, the first on top.
                    assert corner[:, 1].max() == pytest.approx(1.0 - number / 3.0)
                    assert corner[:, 1].min() == pytest.approx(1.0 - (number + 1) / 3.0)
                # The left bumper's are hatched, whatever their colour.
                assert bool(strip.get_hatch()) is (side == "left")
    strips = [c for c in axes[0].collections if c.get_label() == "right contact"]
    colours = [to_hex(c.get_facecolor()[0]) for c in strips[:2]]
    assert colours == [SWEEPS["forward"].colour, SWEEPS["backward"].colour]
    texts = [t.get_text() for t in axes[0].get_legend().get_texts()]
    assert texts == [*named, "gaps", "right contact", "left contact", *MARKS]


def test_what_is_no_time_history_is_refused():
    with pytest.raises(vi.InputError, match="not a recorded motion"):
        time_history(motion(samples=0))
    with pytest.raises(vi.InputError, match="not a recorded motion"):
        time_history(xr.Dataset())
    with pytest.raises(vi.InputError, match=r"cycles: -1"):
        time_history(motion(), cycles=-1)


def texts(ax) -> list[str]:
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_a_free_vibration_is_not_forced_and_its_base_is_at_rest():
    stop = vi.Bumper("10 kN/m", 0, "1 m")
    rig = vi.Rig(vi.Oscillator("2 kg", vi.Isolator("1 kN/m", "2 N s/m"), right=stop))
    data = vi.simulate(rig, 3, vi.State(0.02, 0.0), frequency="4 Hz")
    assert data["displacement"].attrs["long_name"] == "absolute displacement"
    axes = time_history(data)
    assert axes[2].get_xlabel() == "time in cycles of 0.25 s $t/T$ (–)"
    labels = " ".join(ax.get_ylabel() for ax in axes)
    assert "relative" not in labels
    assert "A_t" not in labels
    assert texts(axes[0]) == ["motion", "gap"]  # it touches nothing
    plain = vi.Rig(vi.Oscillator(1, vi.Isolator(1, 0.1)))
    label = time_history(vi.simulate(plain, 3, vi.State(0.02, 0.0)))[2].get_xlabel()
    assert label == "time in cycles of 6.283 $t/T$"


def test_the_star_of_an_impact_on_a_rigid_stop_has_a_name():
    wall = vi.Oscillator(1, vi.Isolator(1, 0.1), right=vi.RigidStop(0.8, 1))
    axes = time_history(vi.steady(vi.Rig(wall, 1.0, "1.6 rad/s")))
    assert texts(axes[0]) == ["motion", "gap", "impact"]
