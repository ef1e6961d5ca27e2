"""Figures of rigs without units: no unit at any axis, and angular frequencies."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact import figures
from vibroimpact.figures.finish import without_unit
from vibroimpact.response.resonance import features

RIG = vi.Rig(vi.Oscillator(1, vi.Isolator(1, 0.1), vi.Bumper(20, 0, 2)), 0.5)
FREQUENCIES = np.linspace(0.12, 0.24, 13)


@pytest.fixture(scope="module")
def swept():
    return vi.sweep(RIG, FREQUENCIES)


@pytest.fixture(scope="module")
def motion():
    return vi.steady(RIG, frequency=0.2)


def labels(drawn):
    axes = np.ravel(drawn)
    every = [*axes, *(child for ax in axes for child in ax.child_axes)]
    return [text for ax in every for text in (ax.get_xlabel(), ax.get_ylabel()) if text]


def legends(drawn):
    boxes = [ax.get_legend() for ax in np.ravel(drawn) if ax.get_legend()]
    return " ".join(text.get_text() for legend in boxes for text in legend.texts)


def test_resonance_curves_over_omega(swept):
    drawn = figures.resonance_curves(swept, curve_features=features(swept), physical=False)
    assert drawn[1].get_xlabel() == "excitation frequency $\\omega$"
    assert not any("(" in text for text in labels(drawn))
    low, high = drawn[0].get_xlim()
    assert low < math.tau * 0.12 < math.tau * 0.24 < high
    assert swept["frequency"].values.tolist() == FREQUENCIES.tolist()  # unchanged
    jumps = features(swept).jumps
    places = [patch.get_path().vertices[:, 0].mean() for patch in drawn[0].patches[-len(jumps) :]]
    assert jumps
    assert all(low < place < high for place in places)


def test_physical_curves_in_the_numbers_of_the_rig(swept):
    drawn = figures.resonance_curves(swept, physical=True)
    assert labels(drawn)[:2] == [
        "largest absolute\nacceleration",
        "largest relative\ndisplacement",
    ]
    top = max(np.nanmax(line.get_ydata()) for line in drawn[1].lines if len(line.get_xdata()) > 12)
    assert top == pytest.approx(float(swept["free_displacement_excursion"].max()) / 2, rel=0.5)
    assert "right gap, 2" in legends(drawn)
    assert "mm" not in legends(drawn)


def test_motions(motion):
    for draw in (figures.phase_portrait, figures.hysteresis_cycle):
        ax = draw(motion)
        assert not any("(" in text for text in labels(ax))
        reach = max(np.nanmax(np.abs(line.get_xdata())) for line in ax.lines)
        assert reach == pytest.approx(max(2.0, float(abs(motion["displacement"]).max())), rel=1e-3)
    drawn = figures.time_history(motion)
    assert labels(drawn)[0] == "relative\ndisplacement $u$"
    page = figures.motion_page({"one": motion})
    assert not [text for text in labels(page) if "Hz" in text or "mm" in text]
    assert "frequency $\\omega$" in labels(page)


def test_branches_and_their_sweep_agree():
    data = vi.resonance_diagram(RIG, {"frequency": (0.12, 0.24)})
    ax = figures.branch_diagram(data)
    assert ax.get_xlabel() == "excitation frequency $\\omega$"
    assert ax.get_xlim() == pytest.approx((math.tau * 0.12, math.tau * 0.24))
    folds = data["bifurcation_value"].values[data["bifurcation_kind"].values == "fold"]
    marks = [line for line in ax.lines if line.get_label() == "fold"]
    assert marks[0].get_xdata() == pytest.approx(math.tau * folds)


def test_other_rigs_keep_their_units():
    rig = vi.Rig(RIG.oscillator.replace(units="SI"), 0.5)
    ax = figures.phase_portrait(vi.steady(rig, frequency=0.2))
    assert ax.get_xlabel() == "relative displacement $u$ (mm)"


@pytest.mark.parametrize(
    ("label", "without"),
    [
        ("excitation frequency $f$ (Hz)", "excitation frequency $\\omega$"),
        ("excitation frequency\n$f$ (Hz)", "excitation frequency\n$\\omega$"),
        ("frequency\n(Hz)", "frequency\n$\\omega$"),
        ("clearance (mm),\nmagnified", "clearance,\nmagnified"),
        ("largest contact\nforce ()", "largest contact\nforce"),
        ("phase (rad)", "phase (rad)"),
        ("period\n(cycles)", "period\n(cycles)"),
    ],
)
def test_a_label_without_its_unit(label, without):
    assert without_unit(label) == without
