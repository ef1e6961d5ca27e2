"""Figures of designs, records and fits of rigs without units: no unit at any axis."""

from __future__ import annotations

import re

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.earthquakes.earthquake_response import earthquake_response
from vibroimpact.model.written_units import has_no_units

OSCILLATOR = vi.Oscillator(1, vi.Isolator(1, 0.1), vi.Bumper(20, 0, 2), vi.Bumper(20, 0, 2))
RIG = vi.Rig(OSCILLATOR, 0.5)
SI = OSCILLATOR.replace(units="SI")
UNIT = re.compile(r"\((?:mm|m|g|kN|N|m/s²|m/s|s|Hz|–|)\)|\d (?:mm|m|g|kN|N|m/s²|s|Hz)\b")


def texts(drawn):
    axes = list(np.ravel(drawn))
    every = [*axes, *(child for ax in axes for child in ax.child_axes)]
    labels = [text for ax in every for text in (ax.get_xlabel(), ax.get_ylabel())]
    labels += [ax.get_title() for ax in axes]
    for ax in every:
        labels += [text.get_text() for text in ax.texts]
        labels += [text.get_text() for text in ax.get_legend().texts] if ax.get_legend() else []
    return [text for text in labels if text]


def record():
    t = np.arange(0.0, 40.0, 0.05)
    return vi.Record(0.8 * np.sin(1.1 * t) * np.exp(-0.05 * t), 0.05)


@pytest.fixture(scope="module")
def chart():
    return vi.design_chart(RIG, {"gap": [1.0, 2.0, 3.0], "damping_ratio": [0.05, 0.1, 0.2]})


@pytest.fixture(scope="module")
def demanded():
    return vi.demands(
        OSCILLATOR, [record().scaled(size) for size in (1.0, 1.2, 1.5)], np.geomspace(0.4, 3.0, 25)
    )


def test_design_charts(chart):
    assert has_no_units(chart)
    drawn = figures.design_chart(chart)
    assert not [text for text in texts(drawn) if UNIT.search(text)]
    assert drawn[0].get_xlim() == pytest.approx((1.0, 3.0))
    assert not UNIT.search(" ".join(texts(figures.design_chart(chart.isel(damping_ratio=1)))))


def test_pareto_front(chart):
    ax = figures.pareto_front(chart)
    assert not [text for text in texts(ax) if UNIT.search(text)]
    drawn = np.concatenate([line.get_xdata() for line in ax.lines])
    assert drawn.max() == pytest.approx(float(chart["peak_displacement"].max()))


def test_incremental_and_fragility_curves(demanded):
    assert has_no_units(demanded)
    ax = figures.incremental_curves(demanded, limit=2.0)
    assert not [text for text in texts(ax) if UNIT.search(text)]
    top = max(np.nanmax(line.get_ydata()) for line in ax.lines)
    assert top == pytest.approx(float(demanded["peak_displacement"].max()))
    curve = vi.fragility(demanded, "peak_displacement", 1.5)
    assert has_no_units(curve)
    ax = figures.fragility_curves(curve)
    assert not [text for text in texts(ax) if UNIT.search(text)]
    assert "> 1.5" in ax.get_ylabel()


def test_levels_in_an_acceleration_are_numbers():
    data = vi.demands(OSCILLATOR, record(), [0.2, 0.4], intensity="PGA")
    ax = figures.incremental_curves(data)
    assert data["scale"].attrs["units"] == "1"
    assert ax.get_xlabel() == "peak ground acceleration"
    assert ax.get_xlim() == pytest.approx((0.2, 0.4))


@pytest.mark.parametrize("oscillator", [OSCILLATOR, SI], ids=["none", "SI"])
def test_earthquake_page(oscillator):
    groups = earthquake_response(vi.Rig(oscillator, record()))
    none = oscillator is OSCILLATOR
    assert all(has_no_units(one) == none for one in groups.values())
    spectra = {"ground": groups["ground"], "mass": groups["floor"]}
    page = figures.earthquake_page(groups["motion"], spectra)
    assert bool([text for text in texts(page) if UNIT.search(text)]) != none
    reach = max(np.nanmax(np.abs(line.get_ydata())) for line in page[1].lines[1:2])
    factor = 1.0 if none else 1e3
    assert reach == pytest.approx(
        factor * float(abs(groups["motion"]["displacement"]).max()), rel=1e-3
    )
    drawn = figures.response_spectra(groups["floor"])
    assert bool([text for text in texts(drawn) if UNIT.search(text)]) != none


def test_accelerogram_of_a_spectrum_without_units():
    groups = earthquake_response(vi.Rig(OSCILLATOR, record()))
    drawn = figures.accelerogram(record(), groups["ground"])
    assert not [text for text in texts(drawn) if UNIT.search(text)]


def test_fit():
    measured = vi.sweep(RIG, np.linspace(0.12, 0.24, 13))[["displacement_excursion"]]
    fit = vi.identify(RIG, measured, {"isolator.stiffness": (0.8, 1.2)}, profiles=True)
    assert has_no_units(fit)
    drawn = figures.fit_residuals(fit)
    assert drawn[0].get_xlabel() == "excitation frequency $\\omega$"
    assert not [text for text in texts(drawn) if UNIT.search(text)]
    places = drawn[0].lines[-1].get_xdata()
    assert places.max() == pytest.approx(2.0 * np.pi * 0.24)
    profiles = figures.fit_profiles(fit)
    assert not [text for text in texts(profiles) if UNIT.search(text)]


def test_force_loop():
    for law, size in ((OSCILLATOR.isolator, 3.0), (OSCILLATOR.right, 2.0)):
        ax = figures.force_loop(law, size, units="none")
        assert not [text for text in texts(ax) if "(" in text]
        assert ax.lines[0].get_xdata().max() == pytest.approx(size)
    with pytest.raises(vi.InputError, match=r"^amplitude: '5 mm' has a unit, but units is"):
        figures.force_loop(OSCILLATOR.isolator, "5 mm", units="none")
    with pytest.raises(vi.InputError, match=r"^units: 'cgs' is unknown; use SI"):
        figures.force_loop(OSCILLATOR.isolator, 3.0, units="cgs")
