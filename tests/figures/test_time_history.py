"""The figure of a time history: curves through the events, bands between them."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.figures import save_figure, time_history


@cache
def motion(code="B2-G1-A3", frequency=0.58, cycles=20.0, samples=64) -> xr.Dataset:
    case = vi.laboratory.case(code)
    excitation = vi.Harmonic(case.amplitude, frequency)
    return vi.simulate(case.oscillator, excitation, cycles, samples=samples)


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
    assert texts == ["motion", "gaps", "right contact", "left contact"]


def test_last_cycles_are_shown():
    for ax in time_history(motion()):
        assert ax.get_xlim() == (17.0, 20.0)
        assert curve(ax)[0].min() >= 17.0
    assert time_history(motion(), cycles=100.0)[0].get_xlim() == (0.0, 20.0)


def test_bands_between_the_exact_events():
    data = motion()
    at = data["event_cycle"].values + data["event_cycle_time"].values * 0.58
    for side, name in ((1, "right contact"), (-1, "left contact")):
        mine = data["event_side"].values == side
        begins = at[mine & (data["event_contact"].values == 1)]
        stops = at[mine & (data["event_contact"].values == 0)]
        expected = [(a, b) for a, b in zip(begins, stops, strict=True) if b >= 17.0]
        assert len(expected) == 3
        for ax in time_history(data):
            np.testing.assert_allclose(bands(ax)[name], expected, rtol=1e-14)


def test_band_of_a_contact_that_was_there_from_the_start_or_is_there_at_the_end():
    case = vi.laboratory.case("B2-G1-A3")
    data = vi.simulate(
        case.oscillator, vi.Harmonic(case.amplitude, 1.0), 0.05, vi.State(0.009, 0.1)
    )
    assert data["contact"].values[0] == 1
    (band,) = bands(time_history(data)[0])["right contact"]
    assert band[0] == 0.0
    inside = vi.simulate(case.oscillator, vi.Harmonic(case.amplitude, 0.58), 19.7)
    assert inside["contact"].values[-1] != 0
    name = "right contact" if inside["contact"].values[-1] == 1 else "left contact"
    assert bands(time_history(inside)[0])[name][-1][1] == pytest.approx(19.7)


def test_the_jump_of_acceleration_is_drawn_upright():
    data = motion()
    x, y = curve(time_history(data, cycles=20.0)[1])
    upright = np.flatnonzero(np.diff(x) == 0.0)
    before, behind = (data[f"event_acceleration_{n}"].values for n in ("before", "behind"))
    np.testing.assert_array_equal(y[upright], before)
    np.testing.assert_array_equal(y[upright + 1], behind)


def test_gaps_are_lines_at_their_place():
    case = vi.laboratory.case("B2-G1-A3")
    one_sided = case.oscillator.replace(left=None, right=case.oscillator.right.replace(gap=0.004))
    data = vi.simulate(one_sided, vi.Harmonic(case.amplitude, 0.58), 5)
    ax = time_history(data)[0]
    dashed = [line.get_ydata()[0] for line in ax.lines if line.get_linestyle() == "--"]
    assert dashed == pytest.approx([4.0])
    texts = [t.get_text() for t in ax.get_legend().get_texts()]
    assert texts == ["motion", "gaps", "right contact"]


def test_free_flight(tmp_path):
    axes = time_history(motion("B2-Ginf-A3"), title="free")
    assert [t.get_text() for t in axes[0].get_legend().get_texts()] == ["motion"]
    assert save_figure(axes[0], tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_what_is_no_time_history_is_refused():
    with pytest.raises(vi.InputError, match="no time history"):
        time_history(motion(samples=0))
    with pytest.raises(vi.InputError, match="no time history"):
        time_history(xr.Dataset())
    with pytest.raises(vi.InputError, match=r"cycles: -1"):
        time_history(motion(), cycles=-1)
