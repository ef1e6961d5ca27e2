"""Figures of ensembles and of Sobol's indices: what is drawn is what the datasets hold."""

from __future__ import annotations

from functools import cache, partial

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.figures import resonance_bands, sensitivity_bars

CASE = vi.laboratory.case("B2-G1-A3")
GRID = [1.0, 2.0, 2.4]
SPREAD = {"gap": "normal:5%", "isolator.damping": "lognormal:0.2"}


@cache
def drawn() -> xr.Dataset:
    return vi.ensemble(CASE, SPREAD, partial(vi.sweeps, frequencies=GRID), 8)


@cache
def indices(resamples: int = 0) -> xr.Dataset:
    response = partial(vi.sweeps, frequencies=GRID)
    return vi.sensitivity(CASE, SPREAD, response, "peak_displacement", 8, resamples=resamples).isel(
        direction=0
    )


def test_bands_hold_the_fractiles():
    nominal = vi.sweep(CASE, GRID)
    axes = resonance_bands(
        drawn(), quantities=("eta_d", "peak_displacement"), shares=(0.1, 0.9), nominal=nominal
    )
    for ax, name, factor in zip(axes, ("eta_d", "peak_displacement"), (1.0, 1e3), strict=True):
        known = factor * vi.fractiles(drawn(), name, (0.1, 0.5, 0.9))[name]
        for k in range(2):
            np.testing.assert_allclose(ax.lines[2 * k].get_ydata(), known[1, k])
            np.testing.assert_allclose(ax.lines[2 * k + 1].get_ydata(), factor * nominal[name][k])
            outline = ax.collections[k].get_paths()[0].vertices
            for row in (0, 2):
                for frequency, value in zip(GRID, known[row, k].values, strict=True):
                    away = np.abs(outline - [frequency, value]).max(axis=1)
                    assert away.min() < 1e-12
    labels = [text.get_text() for text in axes[0].get_legend().get_texts()]
    assert {"10 to 90 %", "nominal rig"} <= {*labels}
    assert "(mm)" in axes[1].get_ylabel()


def test_a_single_frequency_is_drawn_as_points():
    """Without a warning of matplotlib about an axis whose ends are one."""
    data = vi.ensemble(CASE, SPREAD, partial(vi.sweeps, frequencies=[2.0]), 8)
    axes = resonance_bands(data, shares=(0.1, 0.9))
    for ax, name in zip(axes, ("eta_a", "eta_d"), strict=True):
        low, high = ax.get_xlim()
        assert low < 2.0 < high
        assert {line.get_marker() for line in ax.lines} <= {"o", "_"}
        known = vi.fractiles(data, name, (0.1, 0.9))[name]
        ends = [one.vertices[:, 1] for bar in ax.collections for one in bar.get_paths()]
        np.testing.assert_allclose(np.ravel(ends), np.ravel(known.values.squeeze(-1).T))
    curve = indices().isel(frequency=[0])
    assert all(line.get_marker() for line in sensitivity_bars(curve).lines)


def test_bars_of_one_number():
    data = indices(10).isel(frequency=0)
    ax = sensitivity_bars(data)
    heights = [bar.get_height() for bar in ax.patches]
    np.testing.assert_allclose(heights, [*data["first_order"], *data["total_order"]])
    names = [" ".join(text.get_text().split()) for text in ax.get_xticklabels()]
    assert names == ["gap of each side", "damping of the isolator"]
    assert "largest displacement" in ax.get_ylabel()


def test_lines_of_a_curve():
    ax = sensitivity_bars(indices())
    for i, line in enumerate(ax.lines):
        np.testing.assert_allclose(line.get_ydata(), indices()["total_order"][:, i])
    assert ax.get_xlabel() == "excitation frequency (Hz)"


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda: resonance_bands(vi.sweep(CASE, GRID)), "data: .* not an ensemble of sweeps"),
        (lambda: resonance_bands(drawn(), quantities=["colour"]), "quantity: 'colour'"),
        (lambda: resonance_bands(drawn(), shares=(0.6, 0.9)), "shares: "),
        (lambda: sensitivity_bars(drawn()), "data: it has no sensitivity indices"),
        (lambda: sensitivity_bars(indices().expand_dims("rig")), "data: the indices depend on"),
    ],
)
def test_refused(draw, message):
    with pytest.raises(vi.InputError, match=message):
        draw()
