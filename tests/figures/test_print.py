"""Figures in print and in notebooks: nothing is cut off or overlaps, and fonts are TrueType."""

from __future__ import annotations

import shutil
import subprocess
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure

import vibroimpact as vi
from figures.every_figure import EVERY, Drawn
from figures.printed_text import pieces, problems
from samples import sample
from vibroimpact import figures
from vibroimpact.figures import figure_size, save_figure
from vibroimpact.figures.legends import add_legend, break_lines

COLUMN = 86.0 / 25.4
"""Width of a column in inches."""
OTHERS = {
    "family_legend",
    "frequency_marks",
    "figure_size",
    "save_figure",
    "save_animation",
    "Mark",
}
"""Names that draw no figure."""
SAVED = sample([*EVERY], [*EVERY][::24])
"""Figures whose files are looked at; of the others only what is drawn."""
OWN = [name for name, one in EVERY.items() if one.axes]
"""Figures that are drawn on axes of the user."""


def figure_of(made: Any) -> Figure:
    return np.ravel(made)[0].get_figure(root=True)


def on_own_axes(one: Drawn) -> Figure:
    """Draw on axes of the width of a column, in a figure as pyplot makes it."""
    size = (COLUMN, 3.0 if one.axes == 1 else 1.6 + 1.7 * one.axes)
    figure, made = plt.subplots(one.axes, 1, figsize=size, squeeze=False)
    plt.close(figure)
    axes = list(made.ravel())
    drawn = one.draw(**({"ax": axes[0]} if one.axes == 1 else {"axes": axes}))
    assert list(np.ravel(drawn)) == axes
    assert plt.get_fignums() == []
    return figure


def places(figure: Figure) -> np.ndarray:
    return np.array([ax.get_position().bounds for ax in figure.axes])


def test_every_figure_is_drawn_here() -> None:
    assert {name.partition(",")[0] for name in EVERY} == set(figures.__all__) - OTHERS


@pytest.mark.parametrize("name", sample([*EVERY], [*EVERY][::8]))
def test_at_the_width_of_a_column(name, tmp_path) -> None:
    with figure_size("86 mm"):
        figure = figure_of(EVERY[name].draw())
    assert figure.get_figwidth() == pytest.approx(COLUMN)
    assert problems(figure) == []
    if name not in SAVED:
        return
    path = save_figure(figure, tmp_path / "column.pdf")
    before = places(figure)
    save_figure(figure, tmp_path / "again.pdf")
    np.testing.assert_allclose(places(figure), before, rtol=0.0, atol=1e-3)
    content = path.read_bytes()
    assert b"/FontFile2" in content
    assert b"/Type3" not in content
    if shutil.which("pdffonts") is None:
        return
    listed = subprocess.run(["pdffonts", path], capture_output=True, text=True, check=True)
    fonts = listed.stdout.splitlines()[2:]
    assert fonts
    assert all("TrueType" in line and " yes " in line for line in fonts)


@pytest.mark.parametrize("name", sample([*EVERY], [*EVERY][1::16]))
def test_on_the_screen(name) -> None:
    assert problems(figure_of(EVERY[name].draw())) == []


@pytest.mark.parametrize("size", sample([8.0, 10.0], [8.0]))
@pytest.mark.parametrize("name", sample(OWN, OWN[::8]))
def test_on_own_axes(name, size) -> None:
    with plt.rc_context({"font.size": size}):
        settings = dict(plt.rcParams)
        figure = on_own_axes(EVERY[name])
        assert dict(plt.rcParams) == settings
        assert problems(figure) == []


@pytest.mark.parametrize("kind", sample(["png", "pdf", "svg"], ["pdf", "svg"]))
@pytest.mark.parametrize("name", sample([*EVERY], [*EVERY][11::30]))
def test_the_same_file_every_time(name, kind, tmp_path) -> None:
    first, second = (
        save_figure(figure_of(EVERY[name].draw()), tmp_path / f"{at}.{kind}").read_bytes()
        for at in "ab"
    )
    assert first == second
    assert not any(date in first for date in (b"CreationDate", b"dc:date"))  # of the same second
    if kind == "svg":
        assert b"</text>" in first  # letters, not their outlines


def test_a_legend_follows_the_size_of_its_figure() -> None:
    ax = Figure(figsize=(7.0, 3.0), layout="constrained").subplots()
    for k in range(6):
        ax.plot([0, 1], [k, k], label=f"curve number {k}")
    legend = add_legend(ax, columns=6)
    rows = []
    for wide in (7.0, 3.4, 1.6, 7.0):
        ax.figure.set_size_inches(wide, 3.0)
        assert problems(ax.figure) == []
        box = legend.get_window_extent()
        rows.append(len({round(text.get_window_extent().y0) for text in legend.get_texts()}))
        assert ax.bbox.y1 < box.y0
    assert rows == sorted(rows[:3]) + rows[:1]
    assert rows[0] < rows[1] < rows[2]


@pytest.mark.parametrize("side", ["left", "center", "right"])
def test_a_legend_is_above_a_title_that_is_set_later(side) -> None:
    ax = Figure(figsize=(COLUMN, 2.5), layout="constrained").subplots()
    ax.plot([0, 1], label="a curve")
    legend = add_legend(ax)
    ax.set_title("(a) a title", loc=side)
    assert problems(ax.figure) == []
    titles = [one for one in ax.get_children() if getattr(one, "get_text", str)() == "(a) a title"]
    assert legend.get_window_extent().y0 > titles[0].get_window_extent().y1


def test_a_legend_in_a_notebook_is_whole() -> None:
    """Notebooks cut a figure of pyplot to its contents, to which the legend belongs."""
    figure = on_own_axes(EVERY["branch_diagram"])
    figure.draw_without_rendering()
    tight = figure.get_tightbbox()
    box = figure.axes[0].get_legend().get_window_extent()
    inches = box.get_points() / figure.dpi
    assert (inches[0] >= tight.p0 - 1e-6).all()
    assert (inches[1] <= tight.p1 + 1e-6).all()


def test_a_legend_can_be_removed_and_replaced() -> None:
    motion = vi.steady("B2-G1-A3", frequency="2 Hz", samples=32)
    ax = figures.phase_portrait({"one": motion, "other": motion})
    ax.get_legend().remove()
    assert ax.get_legend() is None
    assert ax.legend(loc="upper right") is ax.get_legend()


def test_labels_are_broken_between_words_and_formulas_stay_whole() -> None:
    figure = Figure()
    text = figure.text(0.0, 0.0, "largest absolute acceleration $|\\ddot u + A_t|$ of the mass (g)")
    whole = text.get_window_extent().width
    break_lines(text, 0.5 * whole, None)
    lines = text.get_text().split("\n")
    assert 2 <= len(lines) <= 3
    assert " ".join(lines) == "largest absolute acceleration $|\\ddot u + A_t|$ of the mass (g)"
    assert lines[-1].endswith("mass (g)")
    assert any("$|\\ddot u + A_t|$" in line for line in lines)
    assert text.get_window_extent().width <= 0.5 * whole


def test_tick_labels_keep_the_size_of_the_block() -> None:
    with figure_size("86 mm", font_size=7.0):
        ax = figures.force_loop(vi.Isolator(1e4, 10.0), "20 mm", "1 Hz")
    sizes = {text.get_fontsize() for text in (*ax.get_xticklabels(), ax.xaxis.label)}
    ax.figure.draw_without_rendering()
    sizes |= {text.get_fontsize() for text in (*ax.get_yticklabels(), ax.yaxis.label)}
    assert sizes == {7.0}


def test_sizes_that_are_chosen() -> None:
    with figure_size(0.086, "5 cm"):
        ax = figures.force_loop(vi.Isolator(1e4, 10.0), "20 mm")
    assert ax.figure.get_size_inches() * 25.4 == pytest.approx([86.0, 50.0])
    usual = figures.force_loop(vi.Isolator(1e4, 10.0), "20 mm").figure.get_size_inches()
    assert usual == pytest.approx([5.2, 4.0])
    for wrong, named in ((86, "width: 86 m"), ("3 s", "width"), ("1 mm", "width: 0.001 m")):
        with pytest.raises(vi.InputError, match=f"^{named}"), figure_size(wrong):
            pass
    with pytest.raises(vi.InputError, match=r"^height: 300 m"), figure_size("86 mm", 300):
        pass
    with pytest.raises(vi.InputError, match=r"^font_size: 0"), figure_size("86 mm", font_size=0):
        pass


@pytest.mark.full
def test_pixels_are_as_fine_as_print_requires(tmp_path) -> None:
    """Areas and the many points of chaotic motions are pixels in a PDF file."""
    widths = {}
    for dpi in (None, 150.0):
        path = save_figure(EVERY["scenario_map"].draw(), tmp_path / f"{dpi}.pdf", dpi=dpi)
        widths[dpi] = max(
            int(part.split(b"/Width ")[1].split()[0])
            for part in path.read_bytes().split(b"endobj")
            if b"/Subtype /Image" in part and b"/Width " in part
        )
    assert widths[None] == pytest.approx(4.0 * widths[150.0], rel=0.02)
    with figure_size("86 mm"):
        ax = figures.force_loop(vi.Isolator(1e4, 10.0), "20 mm")
    picture = plt.imread(save_figure(ax, tmp_path / "column.png"))
    assert picture.shape[1] == pytest.approx(600 * COLUMN, abs=1)
    with pytest.raises(vi.InputError, match=r"^dpi: 0; "):
        save_figure(ax, tmp_path / "column.png", dpi=0)


def test_margins_that_a_user_set_stay() -> None:
    figure, ax = plt.subplots()
    figure.subplots_adjust(left=0.3)
    figures.force_loop(vi.Isolator(1e4, 10.0), "20 mm", ax=ax)
    plt.close(figure)
    assert figure.get_layout_engine() is None
    assert figure.subplotpars.left == 0.3


def test_the_checker_sees_what_is_wrong() -> None:
    figure = Figure(figsize=(2.0, 2.0))
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.text(0.5, 0.5, "one above")
    ax.text(0.5, 0.5, "the other")
    ax.set_xlabel("outside")
    report = problems(figure)
    assert any(line.startswith("cut: label 'outside'") for line in report)
    assert any("'one above' and note 'the other'" in line for line in report)
    assert {one.kind for one in pieces(figure)} == {"note", "label", "tick"}
