"""Figures of scenarios: what is drawn where, and what is told without colour."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.patches import Patch

import vibroimpact as vi
from vibroimpact.figures import Mark, feature_map, scenario_cases, scenario_map
from vibroimpact.figures.style import BUMPERS, SCENARIOS
from vibroimpact.scenarios.scenario import Scenario

N = 25


@cache
def made() -> xr.Dataset:
    """A map in four quarters, S2, S4, S6 and nodes that are not known yet."""
    data = vi.scenario_map(
        None,
        {"stiffness_ratio": np.geomspace(1.0, 4.0, 3), "gap_ratio": [0.6, 0.7, 0.8]},
        step=0.05,
    )
    kinds = np.full((N, N), -1, dtype=np.int8)
    kinds[: N // 2, : N // 2] = Scenario.S6
    kinds[: N // 2, N // 2 :] = Scenario.S4
    kinds[N // 2 :, : N // 2] = Scenario.S2
    big = xr.Dataset(
        {
            "scenario": (("gap_ratio", "stiffness_ratio"), kinds),
            "level": (("gap_ratio", "stiffness_ratio"), np.where(kinds < 0, -1, 0)),
            "chaotic_count": (("gap_ratio", "stiffness_ratio"), (kinds == Scenario.S4) * 3),
        },
        coords={
            "stiffness_ratio": np.geomspace(1.0, 100.0, N),
            "gap_ratio": np.linspace(0.0, 1.0, N),
        },
        attrs=data.attrs,
    )
    for name in big.variables:
        big[name].attrs = data[name].attrs
    return big


def legend(ax) -> dict[str, object]:
    box = ax.get_legend()
    return dict(zip([t.get_text() for t in box.get_texts()], box.legend_handles, strict=True))


def test_areas_have_a_colour_a_pattern_and_a_label():
    ax = scenario_map(made())
    shown = legend(ax)
    assert list(shown) == [
        *(f"{s.label}: {s.meaning}" for s in (Scenario.S2, Scenario.S4, Scenario.S6)),
        "not computed yet",
    ]
    assert isinstance(shown["not computed yet"], Patch)
    labels = {t.get_text(): t.get_position() for t in ax.texts}
    assert set(labels) == {"S2", "S4", "S6"}
    x, y = labels["S4"]
    assert x > 10.0 * 1.05  # within its own quarter
    assert y < 0.5
    assert ax.get_xscale() == "log"
    assert ax.get_xlabel() == "stiffness ratio of the bumpers $\\lambda$ (–)"
    assert ax.get_ylabel() == "gap ratio of each side $\\delta_0$ (–)"
    # Looks differ in pattern wherever they do not differ in place, too.
    patterns = [look.hatch for look in SCENARIOS.values()]
    assert len(set(patterns)) == len(patterns) - 1  # S0 and S2 are plain: never neighbours


def test_border_marks_and_lines():
    border = xr.Dataset(
        {
            "stiffness_ratio": ("border_point", [2.0, 3.0]),
            "gap_ratio": ("border_point", [0.7, 0.3]),
        }
    )
    marks = [Mark(f"tests with {b}", m, [10.0], [0.4]) for b, m in BUMPERS.items()]
    ax = scenario_map(
        made(), border=border, marks=marks, lines={"section": ([5.0, 5.0], [0.0, 1.0])}
    )
    shown = legend(ax)
    cusps = shown["cusps of the folds, where jumps begin (exact)"]
    assert cusps.get_marker() == "."
    (line,) = [one for one in ax.lines if one.get_label().startswith("cusps")]
    np.testing.assert_array_equal(line.get_ydata(), [0.3, 0.7])  # in order, or it would zigzag
    np.testing.assert_array_equal(line.get_xdata(), [3.0, 2.0])
    assert {"section", "tests with B1", "tests with B4"} <= set(shown)
    assert len({shown[f"tests with {b}"].get_marker() for b in BUMPERS}) == 4


def test_physical_axes_have_units():
    data = made().rename(stiffness_ratio="stops.stiffness", gap_ratio="gap")
    other = vi.scenario_map(None, {"stops.stiffness": [1.0, 2.0], "gap": [0.5, 1.0]}, step=0.05)
    for name in ("stops.stiffness", "gap"):
        data[name].attrs = other[name].attrs
    ax = scenario_map(data)
    assert ax.get_ylabel() == "gap of each side (mm)"
    assert ax.get_ylim() == (0.0, 1000.0)
    assert ax.get_xlabel() == "stiffness of both bumpers (N/m)"


def test_features():
    ax = feature_map(made(), "chaotic_count")
    (mesh,) = [c for c in ax.collections if c.get_array() is not None]
    shown = np.ma.asarray(mesh.get_array()).reshape(N, N)
    np.testing.assert_array_equal(np.ma.getmaskarray(shown), made()["level"].values < 0)
    assert shown.max() == 3
    bar = ax.figure.axes[1]
    label = " ".join(bar.get_ylabel().split())
    assert label == "number of ranges with chaotic motions (–)"
    assert [t.get_text() for t in bar.get_yticklabels()] == ["0", "1", "2", "3"]


def test_what_cannot_be_drawn_is_refused():
    with pytest.raises(vi.InputError, match="data: this is not a map of scenarios; pass"):
        scenario_map(xr.Dataset())
    with pytest.raises(vi.InputError, match="border: its parameters are not stiffness_ratio and"):
        scenario_map(made(), border=xr.Dataset())
    with pytest.raises(vi.InputError, match="name: 'nothing' is unknown; use chaotic_count"):
        feature_map(made(), "nothing")
    with pytest.raises(vi.InputError, match="scenarios: 'B5-G1-A1' is not a laboratory test"):
        scenario_cases({"B5-G1-A1": "S2"})
    with pytest.raises(
        vi.InputError, match=r"scenarios\[B1-G1-A1\]: 'S9' is not a scenario; use one of S0"
    ):
        scenario_cases({"B1-G1-A1": "S9"})


def test_laboratory_tests():
    axes = scenario_cases({"B1-G1-A1": "S2", "B4-G4-A3": "S3"}, title="tests")
    assert [ax.get_title() for ax in axes] == [f"A{k}: {k + 2} % of gravity" for k in (1, 2, 3)]
    placed = [(k, t.get_text(), t.get_position()) for k, ax in enumerate(axes) for t in ax.texts]
    assert placed == [(0, "S2", (0.5, 0.5)), (2, "S3", (3.5, 3.5))]
    assert axes[0].get_xlabel() == "total gap $G$ (mm)"
    texts = [t.get_text() for t in axes[0].figure.legends[0].get_texts()]
    assert texts == [f"{s.label}: {s.meaning}" for s in (Scenario.S2, Scenario.S3)]


@pytest.mark.full
def test_the_words_beside_a_colour_bar_are_whole():
    small = vi.scenario_map(
        None,
        {"stiffness_ratio": np.geomspace(1.0, 4.0, 3), "gap_ratio": [0.6, 0.7, 0.8]},
        step=0.05,
    )
    figure = Figure(figsize=(6.0, 5.0), layout="constrained")
    names = [str(n) for n in small.data_vars if n not in ("scenario", "level")]
    longest = sorted(names, key=lambda name: -len(small[name].attrs["long_name"]))
    axes = list(figure.subplots(2, 2).flat)
    for name, ax in zip(longest, axes, strict=False):
        feature_map(small, name, ax)
    alone = [feature_map(small, name) for name in longest[:4]]
    for ax in (*axes, *alone):
        drawn = ax.figure
        drawn.draw_without_rendering()
        bar = ax.collections[0].colorbar.ax
        words = bar.yaxis.label.get_window_extent()
        assert words.y0 >= 0.0
        assert words.x1 <= drawn.bbox.x1
        assert words.height <= 1.1 * bar.get_window_extent().height
