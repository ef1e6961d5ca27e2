"""Numbers as people write them."""

from __future__ import annotations

import io
import math

import numpy as np
import pytest
import xarray as xr
from rich.console import Console

from vibroimpact.datasets.vocabulary import VARIABLES
from vibroimpact.facts import motions as verdict
from vibroimpact.facts.number_format import shown_in, written
from vibroimpact.model.units import plain


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (79200.0, 3, "79200"),
        (123456.0, 4, "123500"),
        (1e6, 6, "1000000"),
        (2.7362, 4, "2.736"),
        (0.000012345, 3, "0.0000123"),
        (-0.00001, 4, "-0.00001"),
        (0.0000012345, 3, "1.23e-06"),
        (0.0, 4, "0"),
        (7.5, 4, "7.5"),
        (1.5e12, 4, "1.5e+12"),
        (math.nan, 4, "nan"),
    ],
)
def test_without_powers(value, digits, text):
    assert plain(value, digits) == text


def test_units_of_fitting_size():
    for name, values, symbol in (
        ("peak_force", [1.0, -79.2e6], "MN"),
        ("peak_force", [1470.0, 71.0], "kN"),
        ("peak_force", [3.0, math.nan], "N"),
        ("displacement", [0.0], "m"),
        ("displacement", [], "m"),
        ("energy_supplied", [0.0], "J"),
        ("energy_supplied", [0.237, 1e-3], "J"),
    ):
        assert shown_in(VARIABLES[name].units, values).symbol == symbol


def test_values_of_a_variable_in_one_unit():
    assert written("displacement", -0.00123, 0.0045) == "-1.23 to 4.5 mm"
    assert written("displacement", 2.0, like=[0.00123]) == "2000 mm"
    assert written("displacement", 1e-18, like=[-0.00123]) == "0 mm"  # rounding
    assert written("peak_force", 999_999.9) == "1 MN"
    assert written("peak_force", math.inf) == "infinite"
    assert written("peak_force", math.inf, 5.0) == "infinite to 5 N"
    assert written("transmissibility", 1.23456) == "1.235"


def test_a_heavy_building_in_meganewtons():
    row = {name: [1.0] for name in ("contact_duration_share", "contact_start_phase")}
    row |= {"contact_start_velocity": [0.35], "contact_end_velocity": [-0.21]}
    row |= {"contact_peak_force": [79.2e6], "contact_impulse": [4.1e6]}
    row |= {"contact_penetration": [0.031], "contact_dissipated": [8.1e5]}
    row |= {"contact_restitution": [0.6], "contact_stop": [1], "contact_grazing": [False]}
    data = xr.Dataset({name: ("contact_number", np.array(v)) for name, v in row.items()})
    console = Console(record=True, width=100, file=io.StringIO())
    console.print(verdict.contact_table(data))
    text = console.export_text()
    assert "force (MN)" in text
    assert "79.2" in text
    assert "e+" not in text
