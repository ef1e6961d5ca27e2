"""Figures of design charts."""

from __future__ import annotations

import json

import numpy as np
import pytest

import vibroimpact as vi
from earthquakes.rigs import RIGS, noise
from vibroimpact.datasets.stops import quantity
from vibroimpact.figures import design_chart, pareto_front
from vibroimpact.model import GRAVITY

GAPS, STIFFNESSES = np.linspace(0.01, 0.3, 5), np.geomspace(100.0, 2000.0, 4)


@pytest.fixture(scope="module")
def data():
    vary = {"gap": GAPS, "stops.stiffness": STIFFNESSES}
    return vi.design_chart(RIGS["bumpers"], vary, records=noise(8, count=120))


def test_contours_over_two_parameters(data) -> None:
    left, right = design_chart(data, title="made")
    assert left.get_title() == "largest displacement $|u|$ (mm)"
    assert right.get_title() == "largest absolute acceleration $|\\ddot u + A_t|$ (g)"
    assert left.get_xlabel() == "gap of each side (mm)"
    assert left.get_ylabel() == "stiffness of both bumpers (kN/m)"
    assert left.get_yscale() == "log"
    dots = left.lines[-1]
    at = np.argwhere(data["pareto"].transpose("stops.stiffness", "gap").values)
    np.testing.assert_allclose(dots.get_xdata(), 1e3 * GAPS[at[:, 1]])
    np.testing.assert_allclose(dots.get_ydata(), 1e-3 * STIFFNESSES[at[:, 0]])


def test_the_line_where_nothing_is_hit_is_on_the_safe_side(data) -> None:
    """What lies beyond it is designs that hit nothing, never half-way to one that hits."""
    left, _ = design_chart(data)
    at = [p.vertices for one in left.collections if _red(one) for p in one.get_paths()]
    assert at
    safe = data["hitting"].transpose("gap", "stops.stiffness").values == 0.0
    first = 1e3 * GAPS[safe.argmax(axis=0)].min()
    assert min(points[:, 0].min() for points in at if len(points)) > first - 0.01 * first


def _red(drawn) -> bool:
    colours = np.atleast_2d(drawn.get_edgecolor())
    return bool(len(colours)) and np.allclose(colours[0][:3], np.array([0xC8, 0x10, 0x2E]) / 255)


def test_curves_over_one(data) -> None:
    one = data.isel({"stops.stiffness": 1})
    (ax,) = design_chart(one, quantities=("peak_force",))
    np.testing.assert_allclose(ax.lines[0].get_ydata(), 1e-3 * one["peak_force"].max("stop"))


def test_the_front(data) -> None:
    ax = pareto_front(data)
    front = next(line for line in ax.lines if line.get_label() == "not dominated by another")
    best = data["pareto"].values
    u, a = (np.sort(data[f"peak_{what}"].values[best]) for what in ("displacement", "acceleration"))
    np.testing.assert_allclose(front.get_xdata(), 1e3 * u)
    np.testing.assert_allclose(front.get_ydata(), a[::-1] / GRAVITY)
    note = " ".join(ax.texts[-1].get_text().split("\n"))
    assert note.startswith("gap of each side, ")
    assert "1  " in note
    assert " mm, " in note
    assert " N/m" in note or " kN/m" in note


def test_the_present_design_is_marked_where_it_was_computed() -> None:
    """By its own response; beside the designs, none is known, which the legend states."""
    stop = RIGS["bumpers"].right
    rig = RIGS["bumpers"].replace(left=stop)
    gap, stiffness = stop.gap, stop.stiffness
    own = vi.design_chart(
        rig,
        {"gap": [0.5 * gap, gap, 2.0 * gap], "stops.stiffness": [stiffness, 3.0 * stiffness]},
        records=noise(8, count=120),
    )
    ax = pareto_front(own)
    (star,) = (line for line in ax.lines if line.get_label() == "present design")
    here = own.sel({"gap": gap, "stops.stiffness": stiffness})
    assert star.get_xdata() == pytest.approx(1e3 * float(here["peak_displacement"]))
    assert star.get_ydata() == pytest.approx(float(here["peak_acceleration"]) / GRAVITY)
    assert "present design" in [text.get_text() for text in ax.get_legend().get_texts()]
    beside = own.drop_sel(gap=gap)
    legend = [text.get_text() for text in pareto_front(beside).get_legend().get_texts()]
    assert "present design: not computed" in legend
    assert "present design" not in legend


def test_of_a_long_front_some_are_numbered() -> None:
    long = vi.design_chart(
        RIGS["bumpers"], {"gap": np.linspace(0.01, 0.3, 25)}, records=noise(8, count=120)
    )
    count = int(long["pareto"].sum())
    assert count > 5
    note = " ".join(pareto_front(long).texts[-1].get_text().split("\n"))
    assert note.startswith(
        f"5 of the {count} designs that are not dominated by another: gap of each side 1 "
    )


def test_what_exceeds_a_limit_is_marked(data) -> None:
    limited = vi.design_chart(
        RIGS["bumpers"],
        {"gap": GAPS, "stops.stiffness": STIFFNESSES},
        records=noise(8, count=120),
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
    one = limited.isel({"stops.stiffness": 1})
    (ax,) = design_chart(one, quantities=("peak_force",))
    (crosses,) = (line for line in ax.lines if line.get_label() == "exceeds a limit")
    assert len(crosses.get_xdata()) == (~one["within_limits"].values).sum()
    none = limited.assign(
        within_limits=limited["within_limits"] & False, pareto=limited["pareto"] & False
    )
    assert len(pareto_front(none).lines) == 1


def limited(data, **limits):
    """The same designs under limits, as `design` writes them."""
    within = np.ones(data["pareto"].shape, dtype=bool)
    for name, limit in limits.items():
        within &= quantity(data, name).values <= limit
    about = {**json.loads(data.attrs["parameters"]), "limits": limits}
    new = data.assign(within_limits=(data["pareto"].dims, within), pareto=data["pareto"] & within)
    return new.assign_attrs(parameters=json.dumps(about))


def hatched(panel):
    """Whether a point of a panel, a gap and a stiffness of both bumpers (SI), is hatched."""
    (area,) = (one for one in panel.collections if any(getattr(one, "hatches", [None])))
    (path,) = area.get_paths()
    return lambda gap, stiffness: path.contains_point((1e3 * gap, 1e-3 * stiffness))


def crossing(values, limit):
    """Where values over the stiffnesses fall below a limit, as straight lines on the axis."""
    (k,) = np.flatnonzero(np.diff(np.sign(values - limit)))
    share = (limit - values[k]) / (values[k + 1] - values[k])
    return STIFFNESSES[k] * (STIFFNESSES[k + 1] / STIFFNESSES[k]) ** share


def test_what_is_hatched_ends_where_the_interpolated_value_is_the_limit(data) -> None:
    """As the contour lines do, and not half-way between two designs."""
    limit = 0.025
    some = limited(data, penetration=limit)
    values = data["penetration"].transpose("gap", "stops.stiffness").values
    looked_at = 0
    for panel in design_chart(some):
        inside = hatched(panel)
        (edge,) = (one for one in panel.collections if list(getattr(one, "levels", [])) == [0.0])
        at = np.concatenate(edge.allsegs[0])
        for gap, over in zip(GAPS, values, strict=True):
            if over.min() < limit < over.max():
                there = crossing(over, limit)
                np.testing.assert_allclose(
                    1e-3 * there, at[np.abs(at[:, 0] - 1e3 * gap) < 1e-6, 1], rtol=2e-3
                )
                if gap > GAPS[0]:
                    assert inside(gap, 0.98 * there)
                    assert not inside(gap, 1.02 * there)
                looked_at += 1
    assert looked_at >= 4


@pytest.mark.full
def test_what_is_hatched_ends_on_the_contour_line_of_the_limit(data) -> None:
    levels = next(iter(design_chart(data)[0].collections)).levels
    some = limited(data, peak_displacement=1e-3 * levels[len(levels) // 2])
    panel = design_chart(some)[0]
    lines = next(one for one in panel.collections if not one.filled and len(one.levels) > 1)
    (line,) = (part for part in lines.allsegs[len(levels) // 2] if len(part))
    (edge,) = (one for one in panel.collections if list(getattr(one, "levels", [])) == [0.0])
    (end,) = edge.allsegs[0]
    scale = np.array([1.0, 1.0]) / np.ptp(line, axis=0)
    apart = np.hypot(*np.moveaxis(scale * (line[:, None] - end[None]), -1, 0))
    assert apart.min(axis=0).max() < 1e-3


@pytest.mark.full
def test_what_exceeds_any_of_several_limits_is_hatched_up_to_its_own_edge(data) -> None:
    limits = {
        "penetration": 0.025,
        "peak_force": float(data["peak_force"].max("stop").quantile(0.8)),
    }
    both = hatched(design_chart(limited(data, **limits))[0])
    each = [hatched(design_chart(limited(data, **{n: v}))[0]) for n, v in limits.items()]
    combinations = set()
    for gap in np.linspace(0.02, 0.29, 23):
        for stiffness in np.geomspace(120.0, 1900.0, 23):
            alone = [one(gap, stiffness) for one in each]
            combinations.add(tuple(alone))
            assert both(gap, stiffness) == any(alone)
    assert {(True, False), (False, True), (False, False)} <= combinations


def test_where_no_design_was_done_all_is_hatched(data) -> None:
    names = ("peak_displacement", "peak_acceleration", "peak_force", "penetration", "hitting")
    nothing = data.assign({name: data[name] * np.nan for name in names})
    for panel in design_chart(limited(nothing, penetration=0.025)):
        inside = hatched(panel)
        assert all(inside(g, k) for g in (0.02, 0.29) for k in (110.0, 1900.0))


@pytest.mark.full
def test_limits_that_all_or_none_exceed(data) -> None:
    all_of_them, none = limited(data, peak_displacement=1e-3), limited(data, peak_displacement=9.0)
    for panel in design_chart(all_of_them):
        inside = hatched(panel)
        assert all(inside(g, k) for g in (0.02, 0.29) for k in (110.0, 1900.0))
        words = [text.get_text() for text in panel.get_legend().get_texts()]
        assert words == ["first of these designs to hit no stop", "exceeds a limit"]
        panel.figure.draw_without_rendering()
        assert panel.bbox.width > 300.0  # pixels; a mark of no design must not push it aside
    for panel in design_chart(none):
        assert not any(any(getattr(one, "hatches", [None])) for one in panel.collections)
    # Only what hits nothing presses no bumper: such designs are not hatched, and end it.
    inside = hatched(design_chart(limited(data, penetration=0.0))[0])
    first = GAPS[(data["hitting"] == 0.0).all("stops.stiffness").values.argmax()]
    for stiffness in (110.0, 500.0, 1900.0):
        assert inside(first - 1e-3, stiffness)
        assert not inside(first + 1e-3, stiffness)


@pytest.mark.full
def test_a_fractile_over_the_records_is_named() -> None:
    vary = {"gap": GAPS}
    records = [noise(8, count=120), noise(9, count=120)]
    some = vi.design_chart(RIGS["bumpers"], vary, records=records, fractile=0.84)
    words = "\n84 % fractile over the records"
    (ax,) = design_chart(some, quantities=("peak_force",))
    assert ax.get_ylabel() == "largest contact force (kN)" + words
    front = pareto_front(some)
    assert front.get_xlabel().endswith(words)
    assert front.get_ylabel().endswith(words)
    both = vi.design_chart(
        RIGS["bumpers"], {**vary, "stops.stiffness": STIFFNESSES}, records=records, fractile=0
    )
    assert design_chart(both)[0].get_title().endswith("\n0 % fractile over the records")
    for one in (
        vi.design_chart(RIGS["bumpers"], vary, records=records),
        vi.design_chart(RIGS["bumpers"], vary, records=records[0], fractile=0.5),
    ):
        assert "fractile" not in pareto_front(one).get_xlabel()


def test_refused(data) -> None:
    with pytest.raises(vi.InputError, match=r"^data: this is not a dataset of designs"):
        pareto_front(data.drop_vars("pareto"))
    with pytest.raises(vi.InputError, match=r"^quantities: 'speed'"):
        design_chart(data, quantities=("speed",))
    with pytest.raises(
        vi.InputError, match=r"^data: its dimensions are .*, but the chart requires one or two"
    ):
        design_chart(data.isel(gap=[0]))


@pytest.mark.full
def test_the_present_design_is_marked() -> None:
    """The rig has gaps of 80 mm and bumpers of 400 N/m: a star in the plane, a line over one."""
    wall = vi.Bumper(400.0, 1.0, 0.08)
    rig = RIGS["bumpers"].replace(right=wall, left=wall)
    vary = {"gap": [0.02, 0.05, 0.1], "stops.stiffness": [300.0, 500.0, 900.0]}
    chart = vi.design_chart(rig, vary, records=noise(8, count=60))
    for ax in design_chart(chart):
        (star,) = [line for line in ax.lines if line.get_marker() == "*"]
        assert star.get_xydata().tolist() == [[80.0, 400.0]]
        assert "present design" in [text.get_text() for text in ax.get_legend().get_texts()]
    for ax in design_chart(chart.isel({"stops.stiffness": 0}).drop_vars("stops.stiffness")):
        (line,) = [line for line in ax.lines if line.get_label() == "present design"]
        assert line.get_xdata() == [80.0, 80.0]
    beyond = design_chart(chart.isel(gap=[0, 1]))[0]
    assert not [line for line in beyond.lines if line.get_marker() == "*"]


def test_a_chart_over_one_parameter_has_one_legend_and_room_for_its_ends(data) -> None:
    line = data.isel({"stops.stiffness": 1}).drop_vars("stops.stiffness")
    axes = design_chart(line)
    assert [ax.get_legend() for ax in axes] == [None, None]
    (legend,) = axes[0].figure.legends
    words = [text.get_text() for text in legend.get_texts()]
    assert len(words) == len(set(words)) > 0
    for ax in axes:
        low, high = ax.get_xlim()
        ends = 1e3 * line["gap"].values.min(), 1e3 * line["gap"].values.max()
        assert ends[0] - low == pytest.approx(0.03 * (ends[1] - ends[0]))
        assert high - ends[1] == pytest.approx(0.03 * (ends[1] - ends[0]))
        curve = ax.lines[0].get_ydata()
        assert np.nanmax(curve) < 0.98 * ax.get_ylim()[1]
    (alone,) = design_chart(line, quantities=("peak_force",))
    assert alone.get_legend() is not None
