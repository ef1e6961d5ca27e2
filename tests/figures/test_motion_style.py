"""Figures of motions: what is drawn is what the datasets hold, and at its place."""

from __future__ import annotations

import json
import re
from functools import cache

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

import vibroimpact as vi
from reference.paper_signs import in_paper_signs
from samples import sample
from vibroimpact.figures import (
    clearances,
    hysteresis_cycle,
    motion_page,
    phase_portrait,
    save_figure,
    spectrum_lines,
    time_history,
)
from vibroimpact.figures.style import MOTIONS, SWEEPS

CASE = vi.laboratory.case("B2-G1-A3")
SHAKEN = vi.Harmonic(CASE.amplitude, 2.0)
GAP = 7.5  # mm, on both sides


@cache
def hitting() -> xr.Dataset:
    """One contact a side in each cycle."""
    return vi.steady(vi.Rig(CASE.oscillator, SHAKEN), samples=64)


@cache
def free() -> xr.Dataset:
    """The motion without contact that coexists with it."""
    return vi.steady(vi.Rig(CASE.oscillator, SHAKEN), vi.State(0.001, 0.053), samples=64)


@cache
def across() -> xr.Dataset:
    """The same orbit as `hitting`, cut where the mass presses the right bumper."""
    begin = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 0.83, hitting(), samples=0)
    data = vi.steady(vi.Rig(CASE.oscillator, SHAKEN), begin, samples=64)
    assert data["touching"].sel(stop="right").values[[0, -1]].all()
    return data


@cache
def bare() -> xr.Dataset:
    return vi.steady(vi.Rig(CASE.oscillator.without_bumpers(), SHAKEN), samples=64)


@cache
def chatter() -> xr.Dataset:
    """Five contacts a side, the flights between them ever shorter."""
    case = vi.laboratory.case("B3-10mm-A3")
    data = vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 0.3)), samples=64)
    assert data.sizes["event"] == 20
    return data


@cache
def doubled() -> xr.Dataset:
    """Period two, of a rig with the right bumper alone."""
    right = CASE.oscillator.right.replace(gap=0.0)
    rig = CASE.oscillator.replace(left=None, right=right)
    data = vi.steady(vi.Rig(rig, vi.Harmonic(CASE.amplitude, 2.8)), samples=64)
    assert int(data["period"]) == 2
    return data


@cache
def chaotic() -> xr.Dataset:
    case = vi.laboratory.case("B3-10mm-A3")
    shaken = vi.Harmonic(case.amplitude, 1.06)
    data = vi.steady(vi.Rig(case.oscillator, shaken), samples=16, window=30, exponent_cycles=500)
    assert data["motion"].item() == "chaotic"
    return data


@cache
def transient() -> xr.Dataset:
    return vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 5.3, samples=64)


def both() -> dict[str, xr.Dataset]:
    return {"forward branch": hitting(), "backward branch": free()}


def curves(ax):
    return [line for line in ax.lines if len(line.get_xdata()) > 2 and line.get_linestyle() != ""]


def points(line) -> np.ndarray:
    return np.column_stack([line.get_xdata(), line.get_ydata()])


def gaps(ax, axis: int) -> list[float]:
    """Where the dashed straight lines are."""
    straight = [line for line in ax.lines if len(line.get_xdata()) == 2]
    dashed = [line for line in straight if line.get_linestyle() == "--"]
    return sorted(line.get_data()[axis][0] for line in dashed)


def at_events(motion: xr.Dataset) -> np.ndarray:
    """Times of the events in forcing cycles, from their times in seconds."""
    return motion["event_time"].values * parameter(motion, "frequency")


def parameter(motion: xr.Dataset, name: str) -> float:
    return json.loads(motion.attrs["parameters"])[name]


def follows(points: np.ndarray, wanted: np.ndarray) -> bool:
    """Whether the wanted points come one directly behind the other among the points."""
    count = len(wanted)
    windows = (points[i : i + count] for i in range(len(points) - count + 1))
    return any(np.array_equal(window, wanted) for window in windows)


# Labels, gaps, looks


def test_labels_with_units():
    for draw, down in (
        (phase_portrait, "relative velocity $\\dot u$ (m/s)"),
        (hysteresis_cycle, "absolute acceleration $\\ddot u + A_t$ (m/s²)"),
    ):
        ax = draw(hitting(), title="a title")
        assert ax.get_xlabel() == "relative displacement $u$ (mm)"
        assert ax.get_ylabel() == down
        assert ax.figure.get_suptitle() == "a title"
        assert ax.get_legend() is None  # of one motion there is nothing to tell apart
    whole, near = clearances(hitting(), title="a title")
    assert "(mm)" in whole.get_ylabel()
    assert "(mm)" in near.get_ylabel()
    assert "magnified" in near.get_ylabel()
    assert "t/T" in near.get_xlabel()
    assert whole.figure.get_suptitle() == "a title"
    lines = vi.fourier_spectrum(hitting())
    for quantity, unit in (
        ("displacement", "$u$ (mm)"),
        ("velocity", "(m/s)"),
        ("acceleration", "(m/s²)"),
    ):
        ax = spectrum_lines(lines, quantity=quantity)
        assert "amplitude" in ax.get_ylabel()
        assert unit in ax.get_ylabel()
        assert "f_{exc}" in ax.get_xlabel()
        assert [above.get_xlabel() for above in ax.child_axes] == ["frequency (Hz)"]


@pytest.mark.parametrize("draw", [phase_portrait, hysteresis_cycle])
def test_gaps_are_lines_at_their_place(draw):
    assert gaps(draw(hitting()), 0) == pytest.approx([-GAP, GAP])
    assert gaps(draw(doubled()), 0) == [0.0]
    assert gaps(draw(bare()), 0) == []
    uneven = CASE.oscillator.replace(left=CASE.oscillator.left.replace(gap="9 mm"))
    data = vi.simulate(vi.Rig(uneven, SHAKEN), 2, samples=16)
    assert gaps(draw(data), 0) == pytest.approx([-9.0, 7.5])
    # Those of several rigs together, each once.
    assert gaps(draw({"a": data, "b": hitting()}), 0) == pytest.approx([-9.0, -7.5, 7.5])


def test_other_motions_are_neither_red_nor_blue_and_differ():
    names = ["motion 1", "forward and backward branch", "motion 3", "forward branch"]
    ax = phase_portrait(dict(zip(names, [hitting(), free(), bare(), across()], strict=True)))
    looks = [(line.get_color(), line.get_linestyle()) for line in curves(ax)]
    assert looks[:3] == [(look.colour, look.dashes) for look in MOTIONS[:3]]
    assert looks[3] == (SWEEPS["forward"].colour, "-")
    assert len(set(looks)) == 4
    many = phase_portrait({f"motion {i}": free() for i in range(11)})
    assert len(curves(many)) == 11


# The curves


def test_portrait_and_cycle_pass_through_the_samples_and_events():
    for motion in (hitting(), across(), doubled(), chatter(), transient()):
        u = 1e3 * motion["event_displacement"].values
        before, behind = (motion[f"event_acceleration_{n}"].values for n in ("before", "after"))
        (cycle,) = curves(hysteresis_cycle(motion))
        (orbit,) = curves(phase_portrait(motion))
        for i in range(motion.sizes["event"]):
            jump = np.array([[u[i], before[i]], [u[i], behind[i]]])
            assert follows(points(cycle), jump)
            state = [u[i], motion["event_velocity"].values[i]]
            assert (points(orbit) == state).all(axis=1).any()
        assert len(points(orbit)) == motion.sizes["time"] + 2 * motion.sizes["event"]
        sampled = {tuple(row) for row in points(orbit)}
        rows = zip(1e3 * motion["displacement"].values, motion["velocity"].values, strict=True)
        assert sampled >= set(rows)


def test_the_area_of_the_cycle_is_the_energy_lost():
    """∮ F du over a period: what is taken by the isolator and the bumpers."""
    for motion in (hitting(), free()):
        fine = vi.steady(vi.Rig(CASE.oscillator, SHAKEN), motion, samples=4096)
        (line,) = curves(hysteresis_cycle(fine))
        u, a = points(line).T
        area = np.sum(0.5 * (a[1:] + a[:-1]) * np.diff(1e-3 * u))
        lost = float(fine["energy_isolator"] + fine["energy_bumpers"])
        # What a bumper loses while it relaxes, the mass has given it before.
        assert abs(CASE.oscillator.mass * area) == pytest.approx(lost, rel=1e-5)


def test_section_points():
    for motion, count in ((hitting(), 1), (across(), 1), (doubled(), 2), (chaotic(), 30)):
        (marks,) = phase_portrait(motion).collections
        section = vi.stroboscopic_section(motion, parameter(motion, "phase"), count)
        wanted = [1e3 * section["section_displacement"], section["section_velocity"]]
        assert marks.get_offsets().shape == (count, 2)
        # A chaotic motion that is followed twice, with other stops on the way, drifts apart.
        close = 5 if motion is chaotic() else count
        np.testing.assert_allclose(marks.get_offsets()[:close], np.transpose(wanted)[:close], 1e-6)
        whole = motion["cycle"].values % 1.0 == 0.0
        stored = [1e3 * motion["displacement"].values, motion["velocity"].values]
        np.testing.assert_array_equal(marks.get_offsets(), np.transpose(stored)[whole][:-1])


# Time histories of periodic motions


@pytest.mark.parametrize("name", ["hitting", "across", "doubled"])
def test_a_repeated_period_is_the_motion_going_on(name):
    motion = {"hitting": hitting, "across": across, "doubled": doubled}[name]()
    frequency, phase = parameter(motion, "frequency"), parameter(motion, "phase")
    first = motion.isel(time=0)
    start = vi.State(
        float(first["displacement"]),
        float(first["velocity"]),
        {name: float(first["deformation"].sel(stop=name)) for name in first["stop"].values},
        contact=int(in_paper_signs(motion)["contact"][0]),
        phase=phase,
    )
    rig = vi.Oscillator(**parameter(motion, "oscillator"))
    on = vi.simulate(vi.Rig(rig, vi.Harmonic(CASE.amplitude, frequency)), 5, start, samples=64)
    axes = time_history(motion, cycles=5.0)
    assert axes[0].get_xlim() == (0.0, 5.0)
    for ax, quantity, factor in zip(
        axes, ("displacement", "acceleration", "velocity"), (1e3, 1.0, 1.0), strict=True
    ):
        (line,) = curves(ax)
        x, y = points(line).T
        assert x[0] == 0.0
        assert x[-1] == 5.0
        assert (np.diff(x) >= 0.0).all()
        assert np.diff(x).max() <= 1 / 64 + 1e-12
        values = factor * on[quantity].values
        index = np.searchsorted(x, on["cycle"].values - 1e-9)
        np.testing.assert_allclose(y[index], values, atol=1e-8 * np.abs(values).max())
        # Upright only where the acceleration jumps.
        steps = np.abs(np.diff(y)[np.diff(x) == 0.0])
        if quantity != "acceleration":
            assert steps.max() <= 1e-9 * np.abs(y).max()


def test_a_contact_across_the_end_of_the_period_is_one_band():
    motion = across()
    at, side, begins = (
        at_events(motion),
        np.where(motion["event_stop"].values == "right", 1, -1),
        motion["event_contact"],
    )
    (stop,) = at[(side == 1) & (begins == 0)]
    (begin,) = at[(side == 1) & (begins == 1)]
    assert stop < begin
    for ax in time_history(motion, cycles=3.0):
        spans = bands(ax)["right contact"]
        expected = [(0, stop), (begin, stop + 1), (begin + 1, stop + 2), (begin + 2, 3)]
        np.testing.assert_allclose(spans, expected, rtol=1e-12, atol=1e-12)
    length = float(motion["contact_duration_share"][motion["contact_stop"] == "right"].item())
    assert spans[1][1] - spans[1][0] == pytest.approx(length, rel=1e-9)
    # It is the orbit of the other record, later by 0.83 cycles.
    other = bands(time_history(hitting(), cycles=3.0)[0])["left contact"]
    np.testing.assert_allclose(
        bands(ax)["left contact"][:2], np.array(other[1:]) - 0.83, rtol=0, atol=1e-7
    )


def test_stars_at_the_peaks_of_every_turn():
    """Those of a contact across the end of the record, too."""
    motion = hitting()
    peaks = motion["contact_peak_time"].values * 2.0
    heights = (
        -np.where(motion["contact_stop"].values == "right", 1, -1)
        * motion["contact_peak_acceleration"].values
    )
    np.testing.assert_allclose(
        np.sort(heights), [float(motion[f"acceleration_{end}"]) for end in ("min", "max")]
    )
    for drawn, later in ((hitting(), 0.0), (across(), 0.83)):
        ax = time_history(drawn, cycles=3.0)[1]
        marks = [collection for collection in ax.collections if collection.get_sizes().size]
        largest = max(marks, key=lambda collection: collection.get_sizes()[0])
        stars = np.asarray(largest.get_offsets())
        expected = [
            [(peak - later) % 1.0 + turn, height]
            for turn in range(3)
            for peak, height in zip(peaks, heights, strict=True)
        ]
        np.testing.assert_allclose(
            stars[np.argsort(stars[:, 0])], sorted(expected), rtol=1e-6, atol=1e-7
        )


def bands(ax) -> dict[str, list[tuple[float, float]]]:
    return {
        c.get_label(): [(p.vertices[:, 0].min(), p.vertices[:, 0].max()) for p in c.get_paths()]
        for c in ax.collections
    }


# Clearances


def test_clearances_are_the_distances_to_the_bumpers():
    for motion in (hitting(), across(), chatter()):
        gap = 1e3 * parameter(motion, "oscillator")["right"]["gap"]
        whole, near = clearances(motion, cycles=1.0)
        u = 1e3 * motion["displacement"].values
        for ax in (whole, near):
            right, left = curves(ax)
            assert [right.get_label(), left.get_label()] == ["$G_R$, right", "$G_L$, left"]
            assert [right.get_linestyle(), left.get_linestyle()] == ["-", "--"]
            for line, _, towards, bumper in (
                (right, 1, -u, "right"),
                (left, -1, u, "left"),
            ):
                x, y = points(line).T
                index = np.searchsorted(x, motion["cycle"].values - 1e-9)
                pressed = motion["touching"].sel(stop=bumper).values
                expected = gap + towards + 1e3 * motion["deformation"].sel(stop=bumper).values
                np.testing.assert_allclose(y[index][~pressed], expected[~pressed], rtol=1e-12)
                assert (y[index][pressed] == 0.0).all()
                assert y.min() == 0.0
                at = at_events(motion)[motion["event_stop"].values == bumper]
                for time in at:  # exactly zero where a contact begins or ends
                    assert (y[np.isclose(x, time, rtol=0, atol=1e-12)] == 0.0).all()
        assert whole.get_xlim() == (0.0, 1.0)


def shortest(motion: xr.Dataset) -> tuple[float, float]:
    """Begin and end of the shortest flight from one contact to the next in a period."""
    at, kind = at_events(motion), motion["event_contact"].values
    flights = [(a, b) for a, b, k in zip(at, at[1:], kind, strict=False) if k == 0 and b - a < 1.0]
    return min(flights, key=lambda flight: flight[1] - flight[0])


def test_the_magnified_part_is_about_the_shortest_flight():
    motion = chatter()
    begin, end = shortest(motion)
    assert end - begin < 0.03
    whole, near = clearances(motion, cycles=1.0)
    low, high = near.get_xlim()
    assert high - low == pytest.approx(5 * (end - begin), rel=1e-6)
    # The motion is antisymmetric: half a cycle away is a flight as short.
    middle = 0.5 * (low + high)
    apart = middle - 0.5 * (begin + end)
    assert min(abs(apart + turn) for turn in (-0.5, 0.0, 0.5)) < 1e-6
    # The flight is seen whole, down to the contact: at the right bumper in the second half.
    side = curves(near)[0 if middle > 0.5 else 1]
    x, y = points(side).T
    inside = np.abs(x - middle) <= 0.5 * (end - begin) + 1e-9
    floor, ceiling = near.get_ylim()
    assert floor < 0.0 < y[inside].max() < ceiling
    assert whole.get_ylim()[1] > 10.0
    shaded = [patch.get_extents() for patch in whole.patches]
    width = whole.transData.inverted().transform(shaded[0])[:, 0]
    np.testing.assert_allclose(width, (low, high), rtol=1e-9)


def test_clearances_of_several_motions_and_of_one_bumper():
    whole, _ = clearances(both())
    names = [f"$G_{s}$, {way} branch" for way in SWEEPS for s in "RL"]
    assert [line.get_label() for line in curves(whole)] == names
    colours = [SWEEPS[way].colour for way in SWEEPS for _ in "RL"]
    assert [line.get_color() for line in curves(whole)] == colours
    assert [text.get_text() for text in whole.get_legend().get_texts()] == names
    whole, near = clearances(doubled())
    assert [line.get_label() for line in curves(whole)] == ["$G_R$, right"]
    whole, near = clearances(free())  # no contact, and so no flight between two: all there is
    low, high = near.get_xlim()
    assert low <= 0.0 < 2.0 <= high
    assert near.get_ylim()[1] > GAP


# Spectra


def stems(ax) -> list[tuple[np.ndarray, np.ndarray]]:
    """Places and heights of the stems of each motion."""
    tips = []
    for collection in ax.collections:
        ends = np.array(collection.get_segments())
        assert (ends[:, 0, 1] == 0.0).all()
        assert (ends[:, 0, 0] == ends[:, 1, 0]).all()
        tips.append((ends[:, 1, 0], ends[:, 1, 1]))
    return tips


@pytest.mark.parametrize(
    ("quantity", "factor"), [("displacement", 1e3), ("velocity", 1.0), ("acceleration", 1.0)]
)
def test_stems_are_the_amplitudes(quantity, factor):
    for motion, per_cycle in ((hitting(), 1), (doubled(), 2)):
        lines = vi.fourier_spectrum(motion)
        ax = spectrum_lines(lines, quantity=quantity, highest=9.0)
        ((at, height),) = stems(ax)
        assert len(at) == 9 * per_cycle + 1
        np.testing.assert_allclose(at, np.arange(len(at)) / per_cycle, rtol=1e-12)
        amplitudes = lines[f"{quantity}_amplitude"].values[: len(at)]
        np.testing.assert_array_equal(height, factor * amplitudes)
        (heads,) = ax.lines
        np.testing.assert_array_equal(points(heads), np.column_stack([at, height]))
        # And they are those of the motion: a transform of its samples, one period's.
        values = motion[quantity].values[:-1]
        transform = 2.0 * np.abs(np.fft.rfft(values)) / len(values)
        tolerance = 0.02 if quantity == "acceleration" else 2e-3
        np.testing.assert_allclose(
            height[1:6], factor * transform[1:6], atol=tolerance * factor * transform.max()
        )


def test_orders_are_frequencies_above():
    ax = spectrum_lines(vi.fourier_spectrum(doubled()), highest=12.0)
    ax.figure.draw_without_rendering()
    (above,) = ax.child_axes
    assert above.get_xlim() == pytest.approx([2.8 * x for x in ax.get_xlim()])
    assert ax.get_xlim()[0] < 0.0 < 12.0 < ax.get_xlim()[1]
    mixed = {"2 Hz": vi.fourier_spectrum(hitting()), "2.8 Hz": vi.fourier_spectrum(doubled())}
    assert spectrum_lines(mixed).child_axes == []  # two frequencies, no scale for both


def test_a_dense_spectrum_is_a_line():
    case = vi.laboratory.case("B3-10mm-A3")
    long = vi.simulate(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.06)), 60, samples=32)
    lines = vi.fourier_spectrum(long)
    ax = spectrum_lines(lines, highest=5.0)
    assert list(ax.collections) == []
    (line,) = ax.lines
    assert line.get_xdata()[-1] == 5.0
    np.testing.assert_array_equal(line.get_ydata(), lines["acceleration_amplitude"].values[:301])


# The page


@cache
def page():
    """Two frequencies, two motions at the first."""
    columns = {"2 Hz": both(), "2.8 Hz": doubled()}
    return motion_page(columns, title="A3")


@pytest.mark.full
def test_page_has_a_column_a_frequency_and_a_row_a_figure():
    made = page()
    assert made.shape == (5, 2)
    assert len({ax.figure for ax in made.flat}) == 1
    assert made[0, 0].figure.get_suptitle() == "A3"
    assert [ax.get_title() for ax in made[0]] == [
        "2 Hz\nforward branch: period 1\nbackward branch: period 1",
        "2.8 Hz\nperiod 2",
    ]
    for row, ylabel in zip(
        made, ("velocity", "amplitude", "displacement", "acceleration", "velocity"), strict=True
    ):
        assert ylabel in row[0].get_ylabel()
        assert row[1].get_ylabel() == ""
        assert row[0].get_ylim() == row[1].get_ylim()
    assert all("t/T" in ax.get_xlabel() for ax in made[4])
    assert all("displacement" in ax.get_xlabel() for ax in made[0])
    assert all(ax.get_legend() is None for ax in made.flat)


def test_page_shows_what_the_single_figures_show():
    made = page()
    for column, motions in enumerate((both(), {"motion": doubled()})):
        single = phase_portrait(motions)
        for mine, its in zip(curves(made[0, column]), curves(single), strict=True):
            np.testing.assert_array_equal(points(mine), points(its))
            assert mine.get_color() == its.get_color()
        for (at, height), motion in zip(stems(made[1, column]), motions.values(), strict=True):
            exact = vi.fourier_spectrum(motion, 12.0)["acceleration_amplitude"].values
            assert len(at) == 12 * int(motion["period"]) + 1
            np.testing.assert_allclose(height, exact, rtol=1e-12, atol=1e-15)
        for ax, its in zip(made[2:, column], time_history(motions, cycles=2.0), strict=True):
            assert ax.get_xlim() == (0.0, 2.0)
            for mine, other in zip(curves(ax), curves(its), strict=True):
                np.testing.assert_array_equal(points(mine), points(other))
            assert bands(ax) == bands(its)
    assert gaps(made[2, 0], 1) == pytest.approx([-GAP, GAP])
    assert gaps(made[2, 1], 1) == [0.0]
    # Each row's scale holds all of its curves.
    low, high = made[2, 0].get_ylim()
    for motion in (hitting(), free(), doubled()):
        assert low < 1e3 * float(motion["displacement_min"])
        assert high > 1e3 * float(motion["displacement_max"])


def tripled() -> xr.Dataset:
    """Three cycles of a motion of period one, called a motion of period three."""
    data = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 3, hitting(), samples=64)
    return vi.contacts(data).merge(data.assign(period=3), combine_attrs="override")


def test_page_shows_whole_periods_and_fits_the_paper():
    made = motion_page(
        {"three": tripled(), "two": doubled(), "all": {"a": tripled(), "b": doubled()}}
    )
    assert [ax.get_xlim()[1] for ax in made[2]] == [3.0, 2.0, 6.0]
    short, long = sorted(made[0, 0].figure.get_size_inches())
    assert short <= 210 / 25.4
    assert long <= 297 / 25.4
    assert time_history(doubled())[0].get_xlim() == (0.0, 4.0)
    assert time_history(hitting())[0].get_xlim() == (0.0, 3.0)
    assert clearances(tripled())[0].get_xlim() == (0.0, 3.0)
    for count in sample((1, 2, 3, 6), ()):
        drawn = motion_page({str(i): hitting() for i in range(count)})
        short, long = sorted(drawn[0, 0].figure.get_size_inches())
        assert short <= 210 / 25.4
        assert long <= 297 / 25.4


# Files, axes, and what is left alone


# Refused


def refused(call, begins: str, *holds: str) -> None:
    with pytest.raises(vi.InputError) as caught:
        call()
    message = str(caught.value)
    assert message.startswith(begins)
    assert re.search(r"\buse\b|\bpass\b", message.partition("; ")[2])
    assert "\n" not in message
    for part in holds:
        assert part in message


@pytest.mark.parametrize("draw", [phase_portrait, hysteresis_cycle, clearances, time_history])
def test_what_is_no_recorded_motion_is_refused(draw):
    steadily = "pass the result of steady, or the result of simulate with samples"
    unsampled = vi.simulate(vi.Rig(CASE.oscillator, SHAKEN), 2, samples=0)
    swept = vi.sweep(vi.Rig(CASE.oscillator, CASE.amplitude), [1.0, 2.0])
    for wrong in (xr.Dataset(), unsampled, swept, vi.fourier_spectrum(hitting())):
        refused(lambda wrong=wrong: draw(wrong), "motion: ", steadily)
        refused(lambda wrong=wrong: draw({"a": hitting(), "b": wrong}), "motion: ", steadily)
    refused(lambda: draw({}), "motions: ", "at least one")


def test_a_rig_without_bumpers_has_no_clearance():
    refused(lambda: clearances(bare()), "motions: none of their rigs has a stop")
    assert curves(phase_portrait(bare()))  # the other figures need none
    # Beside one with bumpers it is just not drawn.
    names = [line.get_label() for line in curves(clearances({"a": bare(), "b": free()})[0])]
    assert names == ["$G_R$, b", "$G_L$, b"]


@pytest.mark.parametrize("zoom", [0.0, -0.5, float("nan")])
def test_a_magnified_part_of_no_length_is_refused(zoom):
    refused(lambda: clearances(hitting(), zoom=zoom), f"zoom: {zoom!r}; ", "greater than 0")


@pytest.mark.parametrize("cycles", [0.0, -3, float("nan")])
def test_a_history_of_no_length_is_refused(cycles):
    refused(lambda: time_history(hitting(), cycles=cycles), f"cycles: {cycles!r}; ")


def test_other_quantities_and_datasets_are_no_spectrum():
    lines = vi.fourier_spectrum(hitting())
    refused(
        lambda: spectrum_lines(lines, quantity="jerk"),
        "quantity: 'jerk' is unknown; ",
        "displacement, velocity or acceleration",
    )
    for wrong in (hitting(), xr.Dataset()):
        accepted = "the result of fourier_spectrum"
        refused(lambda wrong=wrong: spectrum_lines(wrong), "spectra: ", accepted)
        refused(lambda wrong=wrong: spectrum_lines({"a": lines, "b": wrong}), "spectra: ")


def test_wrong_numbers_of_axes_or_columns_are_refused():
    one = Figure().subplots()
    refused(lambda: clearances(hitting(), one), "axes: 1 Axes; pass 2")
    refused(lambda: time_history(hitting(), [one] * 2), "axes: 2 Axes; pass 3")
    refused(lambda: motion_page({}), "columns: ", "at least one")
    refused(lambda: motion_page({"a": {}}), "motions: ", "at least one")
    refused(lambda: motion_page({"a": xr.Dataset()}), "motion: ")
    refused(lambda: motion_page({"a": hitting()}, highest=0.0), "highest: 0")


def test_a_long_portrait_is_a_small_file(tmp_path):
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 1e-4))
    long = vi.simulate(vi.Rig(rig, vi.Harmonic(0.1, 0.3)), 300, samples=256)
    path = save_figure(phase_portrait(long), tmp_path / "long.svg")
    assert "<image" not in path.read_text(encoding="utf-8")
    assert path.stat().st_size < 1_000_000  # an image of 600 dpi has four times as many bytes
