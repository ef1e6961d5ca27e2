"""Labels name the stop whose quantity is drawn."""

from __future__ import annotations

import pytest
import xarray as xr

from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.figures.axis_labels import axis_label


@pytest.mark.parametrize(
    ("quantity", "label"),
    [
        ("impacts", "contacts with any stop per forcing cycle (–)"),
        ("impacts.left", "contacts with the left stop per forcing cycle (–)"),
        ("impacts.wall", "contacts with stop wall per forcing cycle (–)"),
        ("peak_impulse.right", "largest impulse of an impact on the right rigid stop (N s)"),
        ("peak_acceleration.roof", "roof: largest absolute acceleration (g)"),
    ],
)
def test_of_one_stop_and_of_all(quantity: str, label: str) -> None:
    about = VARIABLES[quantity.partition(".")[0]]
    values = xr.DataArray(1.0, attrs={"units": about.units, "long_name": about.long_name})
    assert axis_label(values, quantity)[1] == label
    of_each = values.expand_dims(stop=["right", "left"])
    assert "any stop" not in axis_label(of_each, quantity)[1]
