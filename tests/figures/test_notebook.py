"""Figures that notebooks show by themselves: what a function returns has a picture."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO

import matplotlib.image
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes

import vibroimpact as vi
from samples import sample
from vibroimpact import figures

CASE = vi.laboratory.case("B2-G1-A3")


def steady():
    return vi.steady(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 2.0)), samples=32)


def swept():
    return vi.sweep(vi.Rig(CASE.oscillator, CASE.amplitude), np.arange(1.0, 3.0, 0.1))


def rigs():
    return vi.sweeps({"B2-G1-A3": CASE}, np.arange(1.0, 3.0, 0.1))


DRAWN: dict[str, Callable[..., object]] = {
    "resonance_curves": lambda **on: figures.resonance_curves(swept(), physical=False, **on),
    "resonance_family": lambda **on: figures.resonance_family(rigs(), **on),
    "time_history": lambda **on: figures.time_history(steady(), **on),
    "clearances": lambda **on: figures.clearances(steady(), **on),
    "phase_portrait": lambda **on: figures.phase_portrait(steady(), **on),
    "hysteresis_cycle": lambda **on: figures.hysteresis_cycle(steady(), **on),
    "spectrum_lines": lambda **on: figures.spectrum_lines(vi.fourier_spectrum(steady()), **on),
    "motion_page": lambda **on: figures.motion_page({"2 Hz": steady()}, **on),
    "scenario_cases": lambda **on: figures.scenario_cases({"B2-G1-A3": "S3"}, **on),
}
PANELS = {"resonance_curves": 2, "time_history": 3, "clearances": 2, "motion_page": 5}


@pytest.mark.parametrize("name", sample([*DRAWN], [*DRAWN][::3]))
def test_a_notebook_shows_what_is_returned(name):
    drawn = DRAWN[name]()
    png = drawn._repr_png_()
    picture = matplotlib.image.imread(BytesIO(png), format="png")
    assert min(picture.shape[:2]) > 300
    assert picture[..., :3].min() < 0.5 < picture[..., :3].max()
    # So does its figure.
    first = np.ravel(drawn)[0]
    assert isinstance(first, Axes)
    assert first.get_figure(root=True)._repr_png_()[:4] == png[:4] == b"\x89PNG"


@pytest.mark.parametrize("name", sorted(set(DRAWN) - {"scenario_cases"}))
def test_axes_that_are_given_are_drawn_on_and_left_to_pyplot_to_show(name):
    count = PANELS.get(name, 1)
    figure, made = plt.subplots(count, 1)
    drawn = DRAWN[name](**({"ax": made} if count == 1 else {"axes": made}))
    plt.close(figure)
    assert list(np.ravel(drawn)) == list(np.ravel(made))
    assert all(ax.has_data() for ax in figure.axes[:count])
    picture = getattr(drawn, "_repr_png_", lambda: None)
    assert picture() is None  # or it would be shown twice
