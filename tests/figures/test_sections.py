"""Figures of bifurcation diagrams: what is drawn is what the dataset holds."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from figures import test_assembly_figures as masses
from vibroimpact.figures import section_diagram

CASE = vi.laboratory.case("B3-10mm-A3")


@cache
def diagram(section: str = "stroboscopic") -> xr.Dataset:
    return vi.bifurcation_diagram(
        CASE, {"gap": (4.7e-3, 5e-3)}, 7, frequency=1.12, random=1, section=section
    )


@cache
def branch() -> xr.Dataset:
    return vi.branch(CASE, frequency=1.12, vary={"gap": (4.7e-3, 5.1e-3)})


def points(ax) -> np.ndarray:
    """All points of the panel but those of lines across it, sorted."""
    drawn = [np.column_stack(line.get_data()) for line in ax.lines if len(line.get_xdata()) != 2]
    every = np.concatenate(drawn)
    every = every[np.isfinite(every).all(axis=1)]
    return every[np.lexsort(every.T)]


@pytest.mark.parametrize(
    ("section", "quantity", "factor"),
    [
        ("stroboscopic", "section_displacement", 1e3),
        ("stroboscopic", "section_velocity", 1e3),
        ("impacts", "contact_start_velocity", 1e3),
        ("impacts", "contact_start_phase", 1.0),
    ],
)
def test_points_are_those_of_the_data(section, quantity, factor):
    data = diagram(section)
    top, middle, bottom = section_diagram(data, quantity=quantity)
    x = 1e3 * data["gap"].broadcast_like(data[quantity]).transpose(*data[quantity].dims).values
    known = np.column_stack([x.ravel(), factor * data[quantity].values.ravel()])
    known = known[np.isfinite(known).all(axis=1)]
    np.testing.assert_allclose(points(top), known[np.lexsort(known.T)])
    periods = points(middle)[:, 1]
    assert {*periods[periods >= 1.0]} == {*map(float, data["period"].values[data["period"] > 0])}
    largest = points(bottom)[:, 1]
    np.testing.assert_allclose(
        np.sort(largest), np.sort(data["exponents"].values[..., 0], axis=None)
    )
    assert "(mm)" in bottom.get_xlabel()
    labels = [text.get_text() for text in top.get_legend().get_texts()]
    assert labels == ["up", "down", "from other initial states"]


def test_what_has_no_period_is_told_apart():
    kinds = ["periodic", "chaotic", "undecided", "chaotic", "periodic", "periodic", "periodic"]
    data = diagram().isel(start=[0])
    data = data.assign(
        motion=(data["motion"].dims, np.array([kinds])),
        period=(data["period"].dims, np.array([[1, 0, 0, 0, 2, 4, 4]])),
    )
    _, middle, _ = section_diagram(data)
    rows = dict(
        zip([t.get_text() for t in middle.get_yticklabels()], middle.get_yticks(), strict=True)
    )
    assert list(rows) == ["undecided", "chaotic", "1", "2", "4"]
    (line,) = middle.lines
    assert list(line.get_ydata()) == [
        rows.get(kind, p) for kind, p in zip(kinds, [1, 0, 0, 0, 2, 4, 4], strict=True)
    ]


def test_bifurcations_of_branches_are_marked():
    top, _, _ = section_diagram(diagram(), branches=branch(), title="B3-10mm-A3")
    kinds = branch()["bifurcation_kind"].values
    lines = [line.get_xdata()[0] for line in top.lines if line.get_linestyle() == ":"]
    doublings = 1e3 * branch()["bifurcation_value"].values[kinds == "period doubling"]
    assert len(doublings)
    assert {*doublings} <= {*lines}
    assert "period doubling" in [t.get_text() for t in top.get_legend().get_texts()]


def test_branches_are_drawn_with_their_bifurcations_on_them():
    orbits = branch()
    top, middle, _ = section_diagram(diagram(), branches=orbits)
    assert {"stable branch", "unstable branch"} <= {
        t.get_text() for t in top.get_legend().get_texts()
    }
    section = orbits["section"]
    mine = section.sel(component="phase").values == 0.0
    known = 1e3 * section.sel(component="displacement").values[mine]
    thin = [line for line in top.lines if line.get_linewidth() == 0.7]
    drawn = np.concatenate([line.get_ydata() for line in thin])
    assert set(known) == set(drawn[np.isfinite(drawn)])
    marks = [line for line in top.lines if line.get_marker() == "^" and len(line.get_xdata())]
    (at,) = {float(y) for line in marks for y in line.get_ydata() if np.isfinite(y)} & set(
        1e3 * orbits["bifurcation_section"].sel(component="displacement").values
    )
    low, high = top.get_ylim()
    assert low < at < high
    assert not any(
        line.get_linewidth() == 0.7 for line in middle.lines if len(line.get_xdata()) > 2
    )


def test_in_another_phase_or_at_impacts_no_branch_is_drawn():
    turned = branch().copy(deep=True)
    turned["section"].loc[{"component": "phase"}] = 1.0
    turned["bifurcation_section"].loc[{"component": "phase"}] = 1.0
    top, *_ = section_diagram(diagram(), branches=turned)
    assert not any(line.get_linewidth() == 0.7 for line in top.lines)
    impacts = vi.bifurcation_diagram(
        CASE, {"gap": (4.8e-3, 5e-3)}, 2, frequency=1.12, section="impacts", directions="up"
    )
    top, *_ = section_diagram(impacts, branches=branch())
    assert "period doubling of a branch" in [t.get_text() for t in top.get_legend().get_texts()]


def test_a_logarithmic_axis():
    data = vi.bifurcation_diagram(
        CASE, {"stops.stiffness": (1e4, 1e6)}, 5, frequency=3.5, log=True, directions="up"
    )
    top, _, _ = section_diagram(data)
    assert top.get_xscale() == "log"


@pytest.mark.parametrize(
    ("data", "options", "message"),
    [
        (lambda: branch(), {}, "data: this is a dataset of branches; draw it with figures.br"),
        (lambda: xr.Dataset(), {}, "data: this is not a bifurcation diagram"),
        (lambda: diagram(), {"quantity": "contact_start_phase"}, "quantity: "),
        (lambda: diagram(), {"branches": diagram().assign_attrs(parameter="mass")}, "branches: "),
        (lambda: diagram(), {"axes": [None]}, "axes: 1 Axes; pass 3"),
    ],
)
def test_refused(data, options, message):
    with pytest.raises(vi.InputError, match=message):
        section_diagram(data(), **options)


def test_each_mass_has_a_panel_of_its_section():
    data = masses.diagram()
    panels = section_diagram(data)
    assert len(panels) == 4
    for ax, mass in zip(panels, ("north", "south"), strict=False):
        assert ax.get_ylabel().startswith(f"{mass}: displacement")
        values = 1e3 * data["section_displacement"].sel(mass=mass).values
        known = np.sort(values[np.isfinite(values)])
        np.testing.assert_allclose(np.sort(points(ax)[:, 1]), known)
    south, *_ = section_diagram(data, quantity="section_velocity", names=["south"])
    velocity = data["section_velocity"].sel(mass="south").values
    np.testing.assert_allclose(
        np.sort(points(south)[:, 1]), np.sort(1e3 * velocity[np.isfinite(velocity)])
    )
    with pytest.raises(vi.InputError, match=r"^names: 'east' is not"):
        section_diagram(data, names=["east"])
    with pytest.raises(vi.InputError, match=r"^names: .* but the points are not by mass"):
        section_diagram(diagram(), names=["south"])
