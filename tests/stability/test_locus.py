"""Curves of bifurcations: round once, and an end that is told."""

from __future__ import annotations

import numpy as np

import vibroimpact as vi

CASE = vi.laboratory.case("B2-G1-A3")


def beside_the_cusp(other: str, low: float, high: float):
    """The fold of B2-G1-A3 near 0.56 Hz over the frequency and another parameter."""
    data = vi.resonance_diagram(CASE.oscillator, CASE.amplitude, 0.4, 1.0)
    folds = np.flatnonzero(data["bifurcation_kind"].values == "fold")
    row = folds[np.argmin(np.abs(data["bifurcation_value"].values[folds] - 0.56038578))]
    return vi.bifurcation_curve(
        CASE.oscillator,
        vi.Harmonic(CASE.amplitude, 2.0),
        data.isel(bifurcation=int(row)),
        parameters=("frequency", other),
        low=(0.3, low),
        high=(6.0, high),
    )


def test_a_closed_curve_is_gone_round_once():
    """Its section moves on the way, and it begins beside a cusp."""
    found = beside_the_cusp("gap", 1e-4, 3e-2)
    assert found.attrs["ended_low"] == found.attrs["ended_high"] == "it is closed"
    assert found.sizes["point"] < 300
    assert found.sizes["cusp_number"] == 2


def test_a_curve_that_creeps_ends_with_a_reason():
    """The fold comes so close to a grazing that no step leads on."""
    found = beside_the_cusp("stiffness_ratio", 0.1, 500.0)
    ends = [found.attrs["ended_low"], found.attrs["ended_high"]]
    assert "the range of stiffness_ratio ends at 500" in ends
    assert any("no fold could be found beyond" in end and "grazes" in end for end in ends)
    assert found.sizes["point"] < 800
