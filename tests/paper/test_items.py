"""The report's figures and tables: all are there, and each draws."""

from __future__ import annotations

import random

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from paper import fig15, study, table1
from paper.curves import S3 as CODE
from paper.items import ITEMS
from paper.study import GAPS, PublishedStudy
from samples import sample
from vibroimpact.figures.style import SCENARIOS
from vibroimpact.model import laboratory

STUDY = PublishedStudy(threads=2)
DRAWN = [item for item in ITEMS if item.draw is not None]
ITEM = {item.key: item for item in DRAWN}
KEYS = [*ITEM]
LONG = {f"refined-fig{k:02}" for k in (5, 6, 11, 14)}
"""Drawn from the whole campaign again, or as others are: on full samples only."""


@pytest.fixture(scope="module", autouse=True)
def grids():
    """Coarser ones in the daily run: what is tested here is what is made of them."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(study, "STEP", sample(study.STEP, 0.02))
        patched.setattr(study, "MAP_NODES", sample(study.MAP_NODES, (5, 6)))
        yield


def outer(ax) -> tuple[bool, bool]:
    """Whether the axes stand in the lowest row and in the first column of their grid."""
    place = ax.get_subplotspec()
    return place.is_last_row(), place.is_first_col()


def test_keys_are_unique_and_in_order():
    keys = [item.key for item in ITEMS]
    assert len(set(keys)) == len(keys)
    figures = [key for key in keys if key.startswith("fig")]
    assert figures == sorted(figures)
    assert keys[-7:] == [
        "refined-isolators",
        *(f"refined-fig{k:02}" for k in (3, 5, 6, 11, 13, 14)),
    ]
    assert {f"fig{k:02}" for k in (*range(3, 14), *range(15, 21))} <= set(figures)
    assert "table1" in keys


def test_captions_stand_alone():
    for item in ITEMS:
        assert item.title.startswith(("Fig. ", "Table ", "Refined model: ")), item.key
        assert 100 < len(item.caption) < 1000 or item.key.startswith("refined-"), item.key
        assert (item.draw is None) != (item.table is None), item.key


@pytest.mark.parametrize(
    "key",
    sample(KEYS, [key for key in KEYS if key not in LONG][::7]),
)
def test_draws(key):
    figure = ITEM[key].draw(STUDY)
    assert figure.get_layout_engine() is not None
    figure.draw_without_rendering()
    assert figure.axes
    for ax in figure.axes:
        assert any(len(line.get_xdata()) > 2 for line in ax.lines) or (ax.collections or ax.patches)
        last, first = outer(ax)
        if last:
            assert "(" in ax.get_xlabel(), ax
        if first:
            assert "(" in ax.get_ylabel(), ax
        for line in ax.lines:
            values = np.asarray(line.get_ydata(), dtype=float)
            # Fig. 21 has symbols for its legend only.
            assert np.isfinite(values).any() or (key == "fig21" and not values.size)

    # Nothing is cut off.
    box = figure.get_tightbbox(FigureCanvasAgg(figure).get_renderer())
    width, height = figure.get_size_inches()
    assert min(box.x0, box.y0) >= -0.02
    assert box.x1 <= width + 0.02
    assert box.y1 <= height + 0.02


class TestTable1:
    def test_computed_as_printed(self):
        for acceleration, printed in table1.PRINTED.items():
            for name, value in printed.items():
                computed = table1.computed()[acceleration][name]
                assert table1.written(name, computed) == table1.written(name, value)

    def test_24_numbers_beside_24(self):
        table = table1.ITEM.table(STUDY)
        assert len(table.rows) == 6
        assert {len(row) for row in table.rows} == {len(table.head)} == {10}
        for computed, printed in zip(table.rows[::2], table.rows[1::2], strict=True):
            assert (computed[1], printed[1]) == ("computed", "printed")
            assert computed[2:] == printed[2:]


class TestPlaces:
    """Frequencies that are read off the curves."""

    @pytest.mark.parametrize("parameters", ["table", "identified"])
    def test_regular(self, parameters):
        peak, valley, last = STUDY.regular_places(CODE, parameters)
        curve = STUDY.curves(CODE, parameters)["eta_a"].sel(direction="forward")
        at = [int(np.abs(curve["frequency"].values - f).argmin()) for f in (peak, valley, last)]
        value = curve.values
        assert value[at[0]] > max(value[at[0] - 1], value[at[0] + 1])
        assert value[at[1]] < min(value[at[1] - 1], value[at[1] + 1])
        assert value[at[2]] > 10 * value[at[2] + 1]

    def test_other(self):
        left, wild = STUDY.other_places(fig15.CODE, fig15.LOW)
        assert left == pytest.approx(0.70, abs=0.021)
        assert wild == pytest.approx(1.06, abs=0.021)


def test_the_mirrored_pair():
    _, wild = STUDY.other_places(fig15.CODE, fig15.LOW)
    one = STUDY.motion(fig15.CODE, wild, "forward")
    other = STUDY.mirror_image(fig15.CODE, wild, "forward")
    assert one["motion"].item() == other["motion"].item() == "chaotic"
    # Chaotic motions repeat neither themselves nor each other, but their averages do.
    assert float(one["eccentricity"]) == pytest.approx(-float(other["eccentricity"]), rel=0.05)
    between = STUDY.antisymmetric_orbit(fig15.CODE, wild, *fig15.BRANCH)
    assert bool(between["antisymmetric"])
    assert int(between["stable"]) == 0
    assert float(between["displacement_excursion"]) < float(one["displacement_excursion"])


def test_the_branch_meets_the_sweeps_where_it_is_stable():
    branch = STUDY.antisymmetric_branch(fig15.CODE, *fig15.BRANCH)
    data = STUDY.curves(fig15.CODE, low=fig15.LOW).sel(direction="forward")
    for end in (0, -1):
        frequency = float(branch["frequency"][end])
        swept = data["displacement_excursion"].sel(frequency=frequency, method="nearest")
        assert float(branch["displacement_excursion"][end]) == pytest.approx(float(swept), rel=1e-6)


@pytest.fixture
def coarse(monkeypatch):
    """The study on the coarsest grid, where what a legend names is tested."""
    monkeypatch.setattr(study, "STEP", sample(study.STEP, 0.1))
    monkeypatch.setattr(study, "MAP_NODES", sample(study.MAP_NODES, (3, 4)))
    return PublishedStudy(threads=2)


def test_symbols_of_the_map_have_the_colour_of_their_own_scenario(coarse, monkeypatch):
    """Whatever the scenarios are."""
    named = random.Random(1).choices([*SCENARIOS], k=len(laboratory.campaign()))
    codes = [case.code for case in laboratory.campaign()]
    monkeypatch.setattr(coarse, "scenarios", lambda: dict(zip(codes, named, strict=True)))
    (ax,) = ITEM["fig21"].draw(coarse).axes
    filled = {}
    for line in ax.lines:
        if line.get_linestyle() == "None" and len(line.get_xdata()):
            colour = line.get_markerfacecolor()
            filled[colour] = filled.get(colour, 0) + len(line.get_xdata())
    assert filled == {SCENARIOS[s].line: named.count(s) for s in set(named)}
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert sum(text.startswith("tests with") for text in texts) == 4


def test_curves_of_the_gaps_are_named_in_order(coarse):
    figure = ITEM["fig19"].draw(coarse)
    (legend,) = figure.legends
    names = [text.get_text() for text in legend.get_texts()]
    assert names[0] == "0 mm, S5"
    assert names[len(GAPS) - 1] == "no bumpers, S0"
    markers = {line.get_marker() for line in figure.axes[0].lines} - {"", "None"}
    assert len(markers) == len(GAPS)
