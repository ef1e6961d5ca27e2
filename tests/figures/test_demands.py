"""Curves of incremental dynamic analysis and of fragility."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from earthquakes.made import lognormal, suite
from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.figures import fragility_curves, incremental_curves

SCALES = np.linspace(0.2, 3.0, 10)


def test_incremental_curves() -> None:
    data = lognormal(np.random.default_rng(1), 12, SCALES, 0.4)
    ax = incremental_curves(data, limit=1.5)
    grey = [line for line in ax.lines if line.get_color() == "0.75"]
    assert len(grey) == 12
    assert "single records" in [text.get_text() for text in ax.get_legend().get_texts()]
    np.testing.assert_allclose(grey[3].get_ydata(), 1e3 * data["peak_displacement"][3])
    fractiles = vi.fractiles(data)["peak_displacement"]
    black = [line for line in ax.lines if line.get_color() == "black"]
    for line, share in zip(black, fractiles["fractile"].values, strict=True):
        np.testing.assert_allclose(line.get_ydata(), 1e3 * fractiles.sel(fractile=share))
        assert line.get_label() == f"{100 * share:g} % fractile"
    assert ax.lines[-1].get_ydata()[0] == 1500.0
    with pytest.raises(vi.InputError, match=r"^demands: it has one scale"):
        incremental_curves(data.isel(scale=[0]))
    several = data.expand_dims(gap=[0.01, 0.02]).transpose("record", "scale", "gap")
    with pytest.raises(
        vi.InputError, match=r"^demands: the dataset has several rigs, over gap; .*isel\(gap=0\)"
    ):
        incremental_curves(several)


def test_fragility_curves() -> None:
    data = lognormal(np.random.default_rng(1), 12, SCALES, 0.4)
    fragility = vi.fragility(data, "peak_displacement", 1.0)
    ax = fragility_curves(fragility)
    curve, marks = ax.lines
    at = np.interp(float(fragility["median_capacity"]), *curve.get_data())
    assert at == pytest.approx(0.5, abs=1e-3)
    np.testing.assert_array_equal(marks.get_ydata(), fragility["probability"])
    assert len(ax.collections) == 1
    label = ax.get_ylabel().replace("\n", " ")
    assert label == "probability of largest displacement $|u|$ > 1000 mm (–)"
    _, band, share = (text.get_text() for text in ax.get_legend().get_texts())
    assert (band, share) == ("its 90 % band", "share of the records")
    with pytest.raises(vi.InputError, match=r"^fragility: this dataset has no fragility curve"):
        fragility_curves(data)


@pytest.mark.parametrize(
    ("quantity", "words"),
    [
        ("impact_count", "number of contacts with any stop"),
        ("impact_count.right", "number of contacts with the right stop"),
        ("peak_force.right", "largest force of the right stop"),
    ],
)
def test_labels_name_the_stop(quantity: str, words: str) -> None:
    data = lognormal(np.random.default_rng(1), 12, SCALES, 0.4)
    contacts = (data["peak_displacement"] > 1.0).expand_dims(stop=["right", "left"], axis=-1)
    for name, unit in (("impact_count", "1"), ("peak_force", "N")):
        data[name] = contacts.astype(float).assign_attrs(
            units=unit, long_name=VARIABLES[name].long_name
        )
    assert incremental_curves(data, quantity=quantity).get_ylabel().startswith(words)
    ax = fragility_curves(vi.fragility(data, quantity, 0.5))
    assert f"probability of {words} > 0" in ax.get_ylabel().replace("\n", " ")


def test_accelerations_are_drawn_in_g() -> None:
    data = lognormal(np.random.default_rng(1), 12, SCALES, 0.4)
    data["scale"].attrs["units"] = "m/s^2"
    fragility = vi.fragility(data, "peak_displacement", 1.0)
    ax = fragility_curves(fragility)
    assert ax.get_xlabel().endswith("(g)")
    np.testing.assert_allclose(ax.lines[1].get_xdata(), SCALES / 9.80665)
    median = float(fragility["median_capacity"]) / 9.80665
    assert f"= {median:.3g} g" in ax.get_legend().get_texts()[0].get_text()
    np.testing.assert_allclose(incremental_curves(data).lines[0].get_xdata(), SCALES / 9.80665)


def test_the_band_is_that_of_the_levels_and_holds_the_curve_between_them() -> None:
    fragility = vi.fragility(
        lognormal(np.random.default_rng(1), 12, SCALES[::2], 0.4), "peak_displacement", 1.0
    )
    ax = fragility_curves(fragility)
    (outline,) = ax.collections[0].get_paths()
    at, curve = ax.lines[0].get_data()
    for x, p in zip(at[1:-1], curve[1:-1], strict=True):
        column = outline.vertices[np.isclose(outline.vertices[:, 0], x), 1]
        assert column.min() - 1e-12 <= p <= column.max() + 1e-12
        assert column.max() - column.min() < 0.75
    low, high = fragility["fitted_probability_bound"].values
    for x, *ends in zip(SCALES[::2][1:-1], low[1:-1], high[1:-1], strict=True):
        near = outline.vertices[np.abs(outline.vertices[:, 0] / x - 1.0) < 4e-3, 1]
        assert near.min() == pytest.approx(ends[0], abs=0.02)
        assert near.max() == pytest.approx(ends[1], abs=0.02)


def test_a_curve_of_too_few_records_within_the_levels_has_no_band() -> None:
    scales = np.array([1.0, 2.0, 3.0, 4.0])
    first, early, last = (np.where(scales >= begin, 2.0, 0.5) for begin in (0.0, 2.0, 9.0))
    data = suite(np.array([first, early, last, last]), scales)
    with pytest.warns(RuntimeWarning, match="fewer than two records begin"):
        fragility = vi.fragility(data, "peak_displacement", 1.0)
    ax = fragility_curves(fragility)
    assert len(ax.collections) == 0
    words = [text.get_text() for text in ax.get_legend().get_texts()]
    assert words[0].endswith("(no band: too few records reach the limit within the scales)")
    assert words[1:] == ["share of the records"]
    many = lognormal(np.random.default_rng(1), 20, scales, 0.9)
    sound = vi.fragility(many, "peak_displacement", 2.0)
    both = xr.concat([fragility, sound], "gap").assign_coords(gap=[0.1, 0.2])
    both.attrs = fragility.attrs
    ax = fragility_curves(both)
    assert len(ax.collections) == 1
    words = [text.get_text() for text in ax.get_legend().get_texts()]
    assert [text.endswith("within the scales)") for text in words] == [True, False]


def test_what_has_no_curve_says_which_levels_would_give_one() -> None:
    scales = np.array([1.0, 2.0, 3.0, 4.0])
    sound = lognormal(np.random.default_rng(1), 20, scales, 0.9)
    coarse, below, above = (
        suite(np.repeat([row], 20, axis=0), scales)
        for row in ([0.5, 0.5, 3.0, 3.0], [0.5] * 4, [3.0] * 4)
    )
    data = xr.concat([coarse, sound, below, above], "gap").assign_coords(gap=[0.1, 0.2, 0.3, 0.4])
    data["gap"].attrs["units"] = "m"
    with pytest.warns(RuntimeWarning, match="no curve for gap 100 mm: "):
        fragility = vi.fragility(data.transpose("record", "scale", "gap"), "peak_displacement", 2.0)
    ax = fragility_curves(fragility)
    words = [text.get_text() for text in ax.get_legend().get_texts()]
    assert words[0] == "gap 100 mm: no curve, finer scales needed"
    assert words[1].startswith("gap 200 mm: $\\theta$ = ")
    assert words[2:] == [
        "gap 300 mm: no curve, higher scales needed",
        "gap 400 mm: no curve, lower scales needed",
    ]
    # A line and a band of one, and the shares of all.
    assert len(ax.collections) == 1
    assert sum(len(line.get_xdata()) == 400 for line in ax.lines) == 1
    assert sum(len(line.get_xdata()) == 4 for line in ax.lines) == 4
    (text,) = fragility_curves(fragility.isel(gap=0)).get_legend().get_texts()
    assert text.get_text() == "share of the records: no curve, finer scales needed"


def test_what_are_no_axes_is_refused() -> None:
    data = lognormal(np.random.default_rng(1), 12, SCALES, 0.4)
    with pytest.raises(
        vi.InputError, match=r"^ax: 'peak_force' .* another peak, pass quantity='peak_f"
    ):
        incremental_curves(data, "peak_force")
    fragility = vi.fragility(data, "peak_displacement", 1.0)
    with pytest.raises(
        vi.InputError, match=r"^ax: 3 is not an Axes of matplotlib; pass an Axes or None"
    ):
        fragility_curves(fragility, 3)
