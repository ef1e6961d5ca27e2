"""Curves of several rigs in one panel, and frequencies marked in them."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from matplotlib.colors import same_color
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch

import vibroimpact as vi
from vibroimpact.figures import (
    family_legend,
    frequency_marks,
    resonance_family,
)
from vibroimpact.figures.style import SWEEPS

CODES = ("B2-G1-A3", "B2-G3-A3", "B2-Ginf-A3")


@cache
def swept(codes=CODES, directions=("forward", "backward")):
    return vi.sweeps([vi.laboratory.case(c) for c in codes], np.arange(5, 51) / 10, directions)


def of(ax, name: str, direction: str):
    data = [line for line in ax.lines if line.get_gid() == direction]
    return data[CODES.index(name)]


class TestFamily:
    def test_values_and_units(self):
        for quantity, unit, factor in (
            ("eta_a", "(–)", 1.0),
            ("eta_d", "(–)", 1.0),
            ("acceleration_excursion", "(m/s²)", 1.0),
            ("displacement_excursion", "(mm)", 1e3),
        ):
            ax = resonance_family(swept(), quantity=quantity)
            assert unit in ax.get_ylabel()
            assert "(Hz)" in ax.get_xlabel()
            for name in CODES:
                for direction in SWEEPS:
                    y = of(ax, name, direction).get_ydata()
                    expected = swept()[quantity].sel(rig=name, direction=direction)
                    np.testing.assert_array_equal(y[np.isfinite(y)], factor * expected)

    def test_legend_in_the_order_of_the_rigs(self):
        labels = dict(zip(CODES, ("15 mm", "25 mm", "none"), strict=True))
        ax = resonance_family(swept(), labels=labels)
        texts = [text.get_text() for text in ax.get_legend().get_texts()]
        assert texts == [*labels.values(), "forward sweep", "backward sweep", "free flight"]
        assert [h.get_label() for h in family_legend(ax)] == texts
        assert resonance_family(swept(), legend=False).get_legend() is None

    def test_colours_by_name(self):
        ax = resonance_family(swept(), colours={"B2-G3-A3": "#123456"})
        assert same_color(of(ax, "B2-G3-A3", "backward").get_color(), "#123456")
        assert not same_color(of(ax, "B2-G1-A3", "backward").get_color(), "#123456")

    def test_markers_by_name(self):
        part = swept().sel(rig=list(CODES[:2]))
        one = resonance_family(part)
        other = resonance_family(part, markers={CODES[0]: 1, CODES[1]: 0})
        first, second = (of(one, code, "forward").get_marker() for code in CODES[:2])
        assert [of(other, code, "forward").get_marker() for code in CODES[:2]] == [second, first]
        with pytest.raises(vi.InputError, match=r"^markers: 'B9' is not a rig of data"):
            resonance_family(part, markers={"B9": 0})

    def test_parted_at_jumps_with_arrows(self):
        ax = resonance_family(swept(), quantity="eta_a")
        assert np.isnan(of(ax, "B2-G1-A3", "forward").get_ydata()).sum() == 1
        assert not np.isnan(of(ax, "B2-Ginf-A3", "forward").get_ydata()).any()
        arrows = [p for p in ax.patches if isinstance(p, FancyArrowPatch)]
        assert len(arrows) == 4  # both directions of two rigs
        assert 2.65 in [pytest.approx(arrow._posA_posB[0][0]) for arrow in arrows]

    def test_free_flight_only_if_it_is_one(self):
        def free(data, **options):
            lines = resonance_family(data, **options).lines
            return [line for line in lines if line.get_label() == "free flight"]

        assert len(free(swept())) == 1
        assert not free(swept(), free=False)
        assert not free(swept(("B2-G1-A1", "B2-G1-A3")))

    def test_one_direction(self):
        data = swept(CODES, ("backward",))
        texts = [t.get_text() for t in resonance_family(data).get_legend().get_texts()]
        assert texts == [*CODES, "backward sweep", "free flight"]

    @pytest.mark.parametrize(
        ("options", "message"),
        [
            ({"quantity": "eta"}, "quantity: 'eta' is unknown; use eta_a, eta_d"),
            (
                {"labels": {"B1": "x"}},
                "labels: 'B1' is not a rig of data; use B2-G1-A3, B2-G3-A3",
            ),
            ({"colours": {"B1": "red"}}, "colours: 'B1' is not a rig of data"),
        ],
    )
    def test_refusals(self, options, message):
        with pytest.raises(vi.InputError) as caught:
            resonance_family(swept(), **options)
        assert message in str(caught.value)

    def test_refuses_one_rig(self):
        with pytest.raises(vi.InputError, match="data: these are not sweeps of rigs"):
            resonance_family(swept().isel(rig=0))


class TestMarks:
    def test_lines_and_names_in_every_panel(self):
        axes = Figure().subplots(2, 1)
        for ax in axes:
            ax.set_xlim(0.5, 5.0)
        frequency_marks(axes, {"I": 0.57, "II": "2.65 Hz"})
        for ax in axes:
            assert [line.get_xdata()[0] for line in ax.lines] == [0.57, 2.65]
            assert [text.get_text() for text in ax.texts] == ["I", "II"]
            assert ax.get_ylim()[1] > 1.0

    @pytest.mark.parametrize("value", [0.4, 5.1])
    def test_refuses_what_is_not_on_the_axis(self, value):
        ax = Figure().subplots()
        ax.set_xlim(0.5, 5.0)
        with pytest.raises(
            vi.InputError, match=r"frequencies\['I'\]: .*; use a frequency from 0.5 to 5 Hz"
        ):
            frequency_marks(ax, {"I": value})
        assert not ax.lines
