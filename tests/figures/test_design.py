"""Figures of design charts."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

import vibroimpact as vi
from seismic.rigs import RIGS, noise
from vibroimpact.figures import design_chart, pareto_front
from vibroimpact.model import GRAVITY

GAPS, STIFFNESSES = np.linspace(0.01, 0.3, 5), np.geomspace(100.0, 2000.0, 4)


@pytest.fixture(scope="module")
def data():
    vary = {"gap": GAPS, "bumper_stiffness": STIFFNESSES}
    return vi.design(RIGS["bumpers"], noise(8, count=120), vary)


def test_contours_over_two_parameters(data) -> None:
    left, right = design_chart(data, title="made")
    assert left.get_title() == "largest displacement $|u|$ (mm)"
    assert right.get_title() == "largest absolute acceleration $|\\ddot u + A_t|$ (g)"
    assert left.get_xlabel() == "gap of each side (mm)"
    assert left.get_ylabel() == "stiffness of both bumpers (kN/m)"
    assert left.get_yscale() == "log"
    dots = left.lines[-1]
    at = np.argwhere(data["pareto"].transpose("bumper_stiffness", "gap").values)
    np.testing.assert_allclose(dots.get_xdata(), 1e3 * GAPS[at[:, 1]])
    np.testing.assert_allclose(dots.get_ydata(), 1e-3 * STIFFNESSES[at[:, 0]])


def test_numbers_of_contours_stand_on_their_lines_apart_and_inside(data) -> None:
    panels = design_chart(data)
    panels[0].figure.draw_without_rendering()  # which moves them to where they stay
    for ax in panels:
        boxes = [text.get_window_extent() for text in ax.texts]
        assert len(boxes) > 5
        assert not any(a.overlaps(b) for a, b in combinations(boxes, 2))
        assert all(ax.bbox.x0 < box.x0 and box.x1 < ax.bbox.x1 for box in boxes)
        (lines,) = (one for one in ax.collections if len(one.get_array()) > 1 and not one.filled)
        for text, box in zip(ax.texts, boxes, strict=True):
            level = np.abs(lines.levels - float(text.get_text())).argmin()
            path = ax.transData.transform_path(lines.get_paths()[level]).interpolated(200)
            assert np.hypot(*(path.vertices - (box.p0 + box.p1) / 2.0).T).min() < 2.0  # pixels


def test_the_line_where_nothing_is_hit_is_on_the_safe_side(data) -> None:
    """What lies beyond it is designs that hit nothing, never half-way to one that hits."""
    left, _ = design_chart(data)
    at = [p.vertices for one in left.collections if _red(one) for p in one.get_paths()]
    assert at
    safe = data["hitting"].transpose("gap", "bumper_stiffness").values == 0.0
    first = 1e3 * GAPS[safe.argmax(axis=0)].min()
    assert min(points[:, 0].min() for points in at if len(points)) > first - 0.01 * first


def _red(drawn) -> bool:
    colours = np.atleast_2d(drawn.get_edgecolor())
    return bool(len(colours)) and np.allclose(colours[0][:3], np.array([0xC8, 0x10, 0x2E]) / 255)


def test_curves_over_one(data) -> None:
    one = data.isel(bumper_stiffness=1)
    (ax,) = design_chart(one, quantities=("peak_force",))
    np.testing.assert_allclose(ax.lines[0].get_ydata(), 1e-3 * one["peak_force"])


def test_the_front(data) -> None:
    ax = pareto_front(data)
    front = next(line for line in ax.lines if line.get_label() == "beaten by no other")
    best = data["pareto"].values
    u, a = (np.sort(data[f"peak_{what}"].values[best]) for what in ("displacement", "acceleration"))
    np.testing.assert_allclose(front.get_xdata(), 1e3 * u)
    np.testing.assert_allclose(front.get_ydata(), a[::-1] / GRAVITY)
    told = " ".join(ax.texts[-1].get_text().split("\n"))
    assert told.startswith("gap of each side, ")
    assert "1  " in told
    assert " mm, " in told
    assert " N/m" in told or " kN/m" in told


def test_of_a_long_front_some_are_numbered() -> None:
    long = vi.design(RIGS["bumpers"], noise(8, count=120), {"gap": np.linspace(0.01, 0.3, 25)})
    count = int(long["pareto"].sum())
    assert count > 5
    told = " ".join(pareto_front(long).texts[-1].get_text().split("\n"))
    assert told.startswith(f"5 of the {count} that are beaten by no other: gap of each side 1 ")


def test_what_exceeds_a_limit_is_marked(data) -> None:
    limited = vi.design(
        RIGS["bumpers"],
        noise(8, count=120),
        {"gap": GAPS, "bumper_stiffness": STIFFNESSES},
        limits={"peak_displacement": float(data["peak_displacement"].median())},
    )
    beyond = ~limited["within_limits"].values
    ax = pareto_front(limited)
    (crosses,) = (line for line in ax.lines if line.get_label() == "exceeds a limit")
    np.testing.assert_allclose(
        np.sort(crosses.get_xdata()), np.sort(1e3 * limited["peak_displacement"].values[beyond])
    )
    for panel in design_chart(limited):
        assert "exceeds a limit" in [text.get_text() for text in panel.get_legend().get_texts()]
    one = limited.isel(bumper_stiffness=1)
    (ax,) = design_chart(one, quantities=("peak_force",))
    (crosses,) = (line for line in ax.lines if line.get_label() == "exceeds a limit")
    assert len(crosses.get_xdata()) == (~one["within_limits"].values).sum()
    none = limited.assign(
        within_limits=limited["within_limits"] & False, pareto=limited["pareto"] & False
    )
    assert len(pareto_front(none).lines) == 1


def test_a_fractile_over_the_records_is_named() -> None:
    vary = {"gap": GAPS}
    records = [noise(8, count=120), noise(9, count=120)]
    some = vi.design(RIGS["bumpers"], records, vary, fractile=0.84)
    words = "\n84 % fractile over the records"
    (ax,) = design_chart(some, quantities=("peak_force",))
    assert ax.get_ylabel() == "largest contact force (kN)" + words
    front = pareto_front(some)
    assert front.get_xlabel().endswith(words)
    assert front.get_ylabel().endswith(words)
    both = vi.design(
        RIGS["bumpers"], records, {**vary, "bumper_stiffness": STIFFNESSES}, fractile=0
    )
    assert design_chart(both)[0].get_title().endswith("\n0 % fractile over the records")
    for one in (
        vi.design(RIGS["bumpers"], records, vary),
        vi.design(RIGS["bumpers"], records[0], vary, fractile=0.5),
    ):
        assert "fractile" not in pareto_front(one).get_xlabel()


def test_refused(data) -> None:
    with pytest.raises(vi.InputError, match=r"^data: this is no design"):
        pareto_front(data.drop_vars("pareto"))
    with pytest.raises(vi.InputError, match=r"^quantities: 'speed'"):
        design_chart(data, quantities=("speed",))
    with pytest.raises(vi.InputError, match=r"^data: over .*; one or two parameters"):
        design_chart(data.isel(gap=[0]))
