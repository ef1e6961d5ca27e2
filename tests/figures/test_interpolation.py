"""Values between the nodes of a grid."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from vibroimpact.figures.interpolation import finer, finer_axis, nearest


def test_straight_on_the_scales_of_the_axes() -> None:
    ax = Figure().add_subplot(yscale="log")
    x, y = np.array([1.0, 2.0, 5.0]), np.array([0.1, 3.0, 20.0])
    at, up = finer_axis(ax.xaxis, x), finer_axis(ax.yaxis, y)
    assert set(x) <= set(at)
    assert set(y) <= set(up)
    values = 2.0 * x - 3.0 * np.log(y)[:, None]
    np.testing.assert_allclose(finer(values), 2.0 * at - 3.0 * np.log(up)[:, None], atol=1e-12)


def test_a_node_that_is_not_known_leaves_its_cells_open() -> None:
    values = np.arange(12.0).reshape(3, 4)
    values[0, 1] = np.nan
    unknown = np.isnan(finer(values))
    step = (unknown.shape[1] - 1) // 3
    assert unknown[1:step, 1 : 2 * step].all()
    assert not unknown[step:].any()
    assert not unknown[:, 2 * step :].any()
    assert not unknown[:step, 0].any()


def test_the_nearest_changes_half_way() -> None:
    fine = nearest(np.array([[False, True], [False, True]]))
    half = fine.shape[1] // 2
    assert not fine[:, :half].any()
    assert fine[:, half:].all()
