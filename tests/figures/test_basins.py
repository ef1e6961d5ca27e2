"""Figures of basins: what is drawn where, and what is told without colour."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_rgb

import vibroimpact as vi
from figures import test_assembly_figures as masses
from vibroimpact.figures import basin_portrait
from vibroimpact.figures.basins import COLOURS


@cache
def made() -> xr.Dataset:
    return vi.basins("B3-10mm-A3", (-0.012, 0.012), (-0.1, 0.1), frequency=0.7, nodes=40)


def brightness(colour: object) -> float:
    return float(np.array([0.2126, 0.7152, 0.0722]) @ np.array(to_rgb(colour)))


def test_each_state_has_the_colour_of_its_motion():
    ax = basin_portrait(made(), shade=False)
    image = ax.images[0].get_array()
    assert image.shape == (40, 40, 3)
    for number in (0, 1):
        mine = image[made()["basin"].values == number]
        np.testing.assert_allclose(mine, np.tile(to_rgb(COLOURS[number]), (len(mine), 1)))
    left, right, low, _ = ax.images[0].get_extent()
    u, v = made()["displacement"].values, made()["velocity"].values
    # Nodes are the middles of their pixels.
    assert (right - left) == pytest.approx(1e3 * 40 * (u[1] - u[0]))
    assert left == pytest.approx(1e3 * (u[0] - 0.5 * (u[1] - u[0])))
    assert low == pytest.approx(v[0] - 0.5 * (v[1] - v[0]))
    assert ax.get_xlim() == pytest.approx((-12.0, 12.0))
    assert (ax.get_xlabel(), ax.get_ylabel()) == (
        "relative displacement $u$ (mm)",
        "relative velocity $\\dot u$ (m/s)",
    )


def test_states_that_are_caught_late_are_darker():
    plain = basin_portrait(made(), shade=False).images[0].get_array()
    shaded = basin_portrait(made()).images[0].get_array()
    assert (shaded <= plain).all()
    cycles = made()["capture_cycles"].values
    darker = (plain - shaded).sum(axis=2)
    assert darker[cycles == cycles.max()].min() > darker[cycles == 1].max()


def test_motions_are_told_without_colour():
    ax = basin_portrait(made())
    assert {text.get_text() for text in ax.texts} == {"1", "2"}
    legend = [text.get_text() for text in ax.get_legend().get_texts()]
    assert legend[0].startswith("1: period 1, excursion 13.8 mm, ")
    assert legend[2:] == ["darker: settles later"]
    plain = basin_portrait(made(), shade=False).get_legend()
    assert len(plain.get_texts()) == 2  # what is not drawn is not named
    bright = [brightness(colour) for colour in COLOURS]
    assert min(abs(a - b) for a, b in pairwise(bright)) > 0.12


def test_what_is_no_basin_is_told():
    data = made().copy(deep=True)
    data["basin"][:5] = -1
    data["basin"][5:10] = -2
    legend = basin_portrait(data).get_legend()
    assert [text.get_text() for text in legend.get_texts()][2:] == [
        "darker: settles later",
        "computation stopped",
        "beyond a stop",
    ]
    with pytest.raises(vi.InputError, match="no basins"):
        basin_portrait(data.drop_vars("basin"))


@pytest.mark.full
def test_curves_of_saddles_are_drawn_over_basins():
    curves = vi.manifolds(
        "B3-10mm-A3", None, (-0.012, 0.012), (-0.1, 0.1), frequency=0.7, longest=2.0
    )
    ax = basin_portrait(made(), manifolds=curves)
    legend = [text.get_text() for text in ax.get_legend().get_texts()]
    assert legend[2] == "darker: settles later"
    stable, *others = legend[3:]
    assert stable == "stable manifolds of saddles (2 of 2 continue)"
    assert others == ["unstable manifolds of saddles", "saddles"]
    drawn = [line for line in ax.lines if line.get_label() == stable]
    assert [line.get_linestyle() for line in drawn] == ["-", "-"]
    mine = curves["curve_number"].values == 0
    np.testing.assert_allclose(drawn[0].get_ydata(), curves["curve_velocity"].values[mine])
    with pytest.raises(vi.InputError, match="no curves"):
        basin_portrait(made(), manifolds=made())


def test_motions_of_several_masses_are_named_inside_their_basins():
    data = masses.plane()
    ax = basin_portrait(data)
    assert ax.get_xlabel() == "relative displacement of north (mm)"
    assert ax.get_ylabel() == "relative velocity of north (m/s)"
    assert ax.get_xlim() == pytest.approx(1e3 * data["displacement.north"].values[[0, -1]])
    numbers = {int(text.get_text()) - 1: text.get_position() for text in ax.texts}
    assert set(numbers) == {*data["attractor"].values} == {0, 1}
    for number, (u, v) in numbers.items():
        here = data["basin"].sel({"displacement.north": 1e-3 * u, "velocity.north": v}, "nearest")
        assert int(here) == number
    largest = 1e3 * data["displacement_excursion"].max("mass").values
    legend = [text.get_text() for text in ax.get_legend().get_texts()]
    for text, size in zip(legend, largest, strict=False):
        assert f"largest excursion {size:.3g} mm" in text
