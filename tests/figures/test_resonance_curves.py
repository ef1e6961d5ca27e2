"""The figure of resonance curves: what is on it, and that it is written."""

from __future__ import annotations

import subprocess
import sys
from functools import cache

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import same_color, to_rgb
from matplotlib.patches import FancyArrowPatch

import vibroimpact as vi
from vibroimpact.figures import resonance_curves, save_figure
from vibroimpact.figures.style import SWEEPS
from vibroimpact.response.resonance import features


@cache
def swept(code: str, start=0.5, stop=5.0, step=0.1, parameters="table") -> xr.Dataset:
    case = vi.laboratory.case(code, parameters)
    grid = [round(start + k * step, 9) for k in range(round((stop - start) / step) + 1)]
    return vi.sweep(case, grid)


def arrows(ax) -> dict[str, FancyArrowPatch]:
    return {p.get_label(): p for p in ax.patches if isinstance(p, FancyArrowPatch)}


def ends(arrow: FancyArrowPatch) -> tuple[tuple[float, float], tuple[float, float]]:
    start, end = arrow._posA_posB
    return tuple(start), tuple(end)


def lines(ax):
    return {line.get_label(): line for line in ax.lines}


def shades(ax) -> list[tuple[float, float, bool]]:
    return [
        (p.get_x(), p.get_x() + p.get_width(), bool(p.get_hatch()))
        for p in ax.patches
        if not isinstance(p, FancyArrowPatch)
    ]


def legend_texts(ax) -> list[str]:
    return [text.get_text() for text in ax.get_legend().get_texts()]


class TestPrimaryResonance:
    axes = property(lambda self: resonance_curves(swept("B2-G1-A3", parameters="identified")))

    def test_labels_with_units(self):
        upper, lower = self.axes
        assert "\\eta_a" in upper.get_ylabel()
        assert "\\eta_d" in lower.get_ylabel()
        assert "frequency" in lower.get_xlabel()
        assert "(Hz)" in lower.get_xlabel()

    def test_forward_red_backward_blue_free_black(self):
        for ax in self.axes:
            curves = lines(ax)
            red, _, blue = to_rgb(curves["forward sweep"].get_color())
            assert red > 0.6 > 0.3 > blue
            red, _, blue = to_rgb(curves["backward sweep"].get_color())
            assert blue > 0.6 > 0.3 > red
            assert same_color(curves["free flight"].get_color(), "black")

    def test_values(self):
        data = swept("B2-G1-A3", parameters="identified")
        for ax, curve in zip(self.axes, ("eta_a", "eta_d"), strict=True):
            for direction, look in SWEEPS.items():
                line = lines(ax)[look.label]
                known = np.isfinite(line.get_ydata())
                np.testing.assert_array_equal(line.get_xdata()[known], data["frequency"])
                np.testing.assert_array_equal(
                    line.get_ydata()[known], data[curve].sel(direction=direction)
                )
            assert 0.99 < lines(ax)["free flight"].get_ydata().max() <= 1.0

    def test_arrows_where_the_sweeps_jump(self):
        data = swept("B2-G1-A3", parameters="identified")
        for ax, curve in zip(self.axes, ("eta_a", "eta_d"), strict=True):
            jumps = arrows(ax)
            assert set(jumps) == {"forward jump down", "backward jump up"}
            down, up = jumps["forward jump down"], jumps["backward jump up"]
            forward, backward = (data[curve].sel(direction=d) for d in ("forward", "backward"))
            at = lambda one, f: float(one.sel(frequency=f, method="nearest"))  # noqa: E731
            assert ends(down) == (
                pytest.approx((2.65, at(forward, 2.6))),
                pytest.approx((2.65, at(forward, 2.7))),
            )
            assert ends(up) == (
                pytest.approx((1.75, at(backward, 1.8))),
                pytest.approx((1.75, at(backward, 1.7))),
            )
            assert same_color(down.get_edgecolor(), SWEEPS["forward"].colour)
            assert same_color(up.get_edgecolor(), SWEEPS["backward"].colour)

    @pytest.mark.parametrize(("low", "high", "kept"), [(0.5, 1.5, 0), (1.0, 2.0, 1), (3.0, 5.0, 0)])
    def test_a_part_of_a_sweep_shows_its_own_jumps(self, low, high, kept):
        data = swept("B2-G1-A3", parameters="identified")
        part = data.sel(frequency=slice(low, high))
        for ax in resonance_curves(part, curve_features=features(data)):
            assert len(arrows(ax)) == kept

    def test_no_line_across_a_jump(self):
        ax, _ = self.axes
        line = lines(ax)["forward sweep"]
        (cut,) = np.flatnonzero(np.isnan(line.get_ydata()))
        assert line.get_xdata()[cut - 1 : cut + 2 : 2] == pytest.approx([2.6, 2.7])

    def test_hysteresis_is_shaded_between_the_arrows(self):
        for ax in self.axes:
            ((low, high, hatched),) = shades(ax)
            assert (low, high) == pytest.approx((1.75, 2.65))
            assert not hatched

    def test_legend_names_what_is_there(self):
        upper, lower = self.axes
        assert legend_texts(upper) == [
            "forward sweep",
            "backward sweep",
            "free flight",
            "right hysteresis (forward above backward)",
        ]
        assert lower.get_legend() is None


class TestOtherSweeps:
    def test_left_hysteresis_is_told_from_right(self):
        upper, _ = resonance_curves(swept("B3-10mm-A3", 0.5, 4, 0.01))
        areas = shades(upper)
        assert [hatched for _, _, hatched in areas] == [True, False]
        assert areas[0][:2] == pytest.approx((0.675, 0.725))
        assert "left hysteresis (backward above forward)" in legend_texts(upper)
        assert {"forward jump up", "backward jump down"} < set(arrows(upper))

    def test_each_panel_shows_which_sweep_is_above_in_it(self):
        """Larger accelerations may come with smaller displacements."""
        data = swept("B3-10mm-A3", 0.5, 1.0, 0.01)
        turned = data.assign(eta_d=(data["eta_d"].dims, data["eta_d"].values[::-1]))
        for dataset, hatched in ((data, [True, True]), (turned, [True, False])):
            axes = resonance_curves(dataset)
            assert [shades(ax)[0][2] for ax in axes] == hatched
        assert {
            "left hysteresis (backward above forward)",
            "right hysteresis (forward above backward)",
        } < set(legend_texts(axes[0]))

    def test_unsettled_motions_are_marked(self):
        data = swept("B3-10mm-A3", 0.5, 4, 0.01)
        upper, lower = resonance_curves(data)
        for ax in (upper, lower):
            marks = lines(ax)["forward sweep, not settled"]
            assert marks.get_linestyle() == "None"
            assert marks.get_marker() == "x"
            assert marks.get_markersize() > 1.5 * SWEEPS["forward"].size
            x = marks.get_xdata()
            curve = lines(ax)["forward sweep"]
            usual = curve.get_xdata()[list(curve.get_markevery())]
            assert len(usual) > 20
            assert not set(usual) & set(x)  # what is not settled has no usual mark
            assert (x >= 1.0).all()
            assert (x <= 1.12).all()
            assert np.diff(x).min() >= 0.01
        assert "backward sweep, not settled" in legend_texts(upper)

    def test_arrows_of_a_narrow_hysteresis_stand_apart(self):
        upper, _ = resonance_curves(swept("B2-G4-A1", 0.5, 5, 0.01))
        upper.figure.draw_without_rendering()
        down, up = (arrows(upper)[n] for n in ("forward jump down", "backward jump up"))
        points = 72 / upper.figure.dpi
        places = [a.get_transform().transform(ends(a)[0])[0] * points for a in (up, down)]
        assert places[1] - places[0] > 4.0

    def test_free_flight_has_no_arrow_and_no_shade(self):
        upper, _ = resonance_curves(swept("B2-Ginf-A3"))
        assert list(upper.patches) == []
        assert legend_texts(upper) == ["forward sweep", "backward sweep", "free flight"]

    @pytest.mark.parametrize("direction", ["forward", "backward"])
    def test_one_direction(self, direction):
        upper, _ = resonance_curves(swept("B2-G1-A3").sel(direction=[direction]))
        assert legend_texts(upper) == [SWEEPS[direction].label, "free flight"]
        assert len(arrows(upper)) == 1
        assert shades(upper) == []

    def test_absent_values(self, tmp_path):
        data = swept("B2-G1-A3").copy(deep=True)
        data["eta_a"][0, 3:6] = np.nan
        data["eta_d"][:] = np.nan
        axes = resonance_curves(data)
        save_figure(axes[0], tmp_path / "a.png")

    def test_one_frequency(self, tmp_path):
        axes = resonance_curves(swept("B2-G1-A3").isel(frequency=[7]))
        save_figure(axes[0], tmp_path / "a.png")

    def test_several_rigs_are_refused(self):
        data = vi.sweeps([vi.laboratory.case("B2-G1-A3")], [1.0, 2.0])
        with pytest.raises(vi.InputError, match="one rig"):
            resonance_curves(data)


class TestFiles:
    def test_unknown_format(self, tmp_path):
        axes = resonance_curves(swept("B2-G1-A3"))
        with pytest.raises(
            vi.InputError, match=r"does not end in .png, .pdf, .svg; use one of these endings"
        ):
            save_figure(axes[0], tmp_path / "a.xyz")
        assert list(tmp_path.iterdir()) == []


def test_the_package_does_not_import_matplotlib_and_figures_not_pyplot():
    code = (
        "import sys, vibroimpact as vi; vi.sweep, vi.simulate, vi.laboratory\n"
        "assert 'matplotlib' not in sys.modules\n"
        "import vibroimpact.figures\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
