"""Figures of shares along a parameter."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.collections import PolyCollection

import vibroimpact as vi
from vibroimpact.datasets.description import describe
from vibroimpact.figures import basin_shares


def made() -> xr.Dataset:
    share = np.array([[1.0, 0.0], [0.7, 0.3], [0.2, 0.8], [0.0, 1.0]])
    dims = ("frequency", "attractor")
    data = xr.Dataset(
        {
            "share": (dims, share),
            "share_low": (dims, np.clip(share - 0.05, 0.0, 1.0)),
            "share_high": (dims, np.clip(share + 0.05, 0.0, 1.0)),
        },
        {"frequency": [1.0, 1.5, 2.0, 2.5], "attractor": [0, 1]},
    )
    return describe(data, "test")


def test_shares_lie_on_top_of_each_other():
    ax = basin_shares(made())
    areas = [one for one in ax.collections if isinstance(one, PolyCollection)]
    first, second = (area.get_paths()[0].get_extents() for area in areas)
    assert (first.y0, first.y1) == pytest.approx((0.0, 100.0))
    assert (second.y0, second.y1) == pytest.approx((0.0, 100.0))
    assert ax.get_xlim() == (1.0, 2.5)
    assert ax.get_xlabel().endswith("(Hz)")
    assert {text.get_text() for text in ax.texts} == {"1", "2"}
    assert [t.get_text() for t in ax.get_legend().get_texts()] == ["motion 1", "motion 2"]


def test_intervals_are_drawn_where_there_are_two():
    (bars,) = basin_shares(made()).containers
    np.testing.assert_allclose(
        [segment[:, 1] for segment in bars.lines[2][0].get_segments()],
        [[65.0, 75.0], [15.0, 25.0]],
    )


def test_above_all_there_is_no_interval():
    none = made().isel(attractor=[1]) * 0.0
    data = describe(xr.concat([made(), none.assign_coords(attractor=[2])], "attractor"), "test")
    first, second = basin_shares(data).containers
    assert len(first.lines[2][0].get_segments()) == 2
    assert not second.lines[2][0].get_segments()


def test_what_has_no_shares_is_told():
    with pytest.raises(vi.InputError, match="the shares do not depend on a parameter"):
        basin_shares(made().isel(frequency=0))
