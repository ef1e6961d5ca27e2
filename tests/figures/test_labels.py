"""Names beside curves."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib import pyplot as plt

from vibroimpact.figures.labels import Names


@pytest.mark.parametrize(
    ("shape", "power"), [("valley", 2.0), ("hill", 2.0), ("elbow", 8.0), ("steep", 0.2)]
)
def test_a_curve_does_not_cross_its_name(shape, power) -> None:
    figure, ax = plt.subplots(figsize=(6.4, 4.8))
    x = np.linspace(-1.0, 1.0, 401)
    y = {"valley": x**2, "hill": -(x**2)}.get(shape, np.abs(0.5 * (1.0 + x)) ** power)
    ax.plot(x, y)
    Names(ax).write(x, y, "frequency 2.43236 Hz", "black", once=False)
    (text,) = ax.texts
    figure.draw_without_rendering()
    box = text.get_window_extent()
    inside = box.padded(-1.0).get_points()
    at = ax.transData.transform(np.column_stack([x, y]))
    assert not ((at > inside[0]) & (at < inside[1])).all(axis=1).any()
    assert ax.bbox.containsx(box.x0)
    assert ax.bbox.containsx(box.x1)
    plt.close(figure)
