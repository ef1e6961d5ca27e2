"""Scenarios of rigid stops: what their sweeps show, as of bumpers with λ → ∞."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.facts.scenario_map import constants
from vibroimpact.scenarios.axes import rig_at
from vibroimpact.scenarios.classify import classify
from vibroimpact.scenarios.sweep_frequencies import MOST_HIGH, highest

SINE = vi.Harmonic(1.0, 1.0)
FREE = vi.Oscillator(1.0, vi.Isolator(1.0, 0.3))
PEAK = 1.0 / (0.3 * (1.0 - 0.15**2) ** 0.5)
"""Of free flight (m), shaken with 1 m/s²."""


def between(ratio: float, restitution: float = 0.6) -> vi.Oscillator:
    wall = vi.RigidStop(restitution, ratio * PEAK)
    return FREE.replace(right=wall, left=wall)


@pytest.mark.parametrize(("ratio", "named"), [(1.2, "S0"), (0.97, "S1"), (0.6, "S2")])
def test_a_rigid_stop_has_the_scenario_of_very_stiff_bumpers(ratio: float, named: str) -> None:
    held = np.arange(0.4, 2.5, 0.02) / (2.0 * np.pi)
    rig = between(ratio)
    bumper = vi.Bumper.from_restitution(1.0, 1e5, 0.6, ratio * PEAK)
    stiff = rig.replace(right=bumper, left=bumper)
    verdict = classify(vi.Rig(rig, 1.0), held)
    assert verdict.scenario == named == classify(vi.Rig(stiff, 1.0), held).scenario


def test_the_range_of_a_rigid_stop_is_bounded_by_energy_or_at_last() -> None:
    assert highest(vi.Rig(between(0.6), SINE)) < 4.0
    assert highest(vi.Rig(FREE.replace(right=vi.RigidStop(0.6, 0.0)), SINE)) >= MOST_HIGH


def test_a_map_over_what_a_rigid_stop_has() -> None:
    data = vi.scenario_map(
        vi.Rig(between(0.5), 1.0), {"gap_ratio": [0.7, 1.2], "restitution": [0.4, 0.8]}, step=0.05
    )
    assert data["scenario"].sel(gap_ratio=1.2).values.tolist() == [0, 0]
    assert (data["scenario"].sel(gap_ratio=0.7).values > 0).all()
    assert data["stops.restitution"].attrs["units"] == "1"


def test_nodes_change_what_each_stop_has() -> None:
    both = between(0.5).replace(left=vi.Bumper(20.0, 0.4, 0.5))
    rig = rig_at(vi.Rig(both, SINE), {"stops.restitution": 0.2, "stiffness_ratio": 30.0}).oscillator
    assert rig.right == vi.RigidStop(0.2, rig.right.gap)
    assert rig.right.gap == pytest.approx(0.5 * PEAK)
    assert rig.left.stiffness == pytest.approx(30.0)
    assert rig.left.gap == pytest.approx(0.5)
    rig = rig_at(vi.Rig(both, SINE), {"gap": 0.1, "proportional_stiffness": 30.0}).oscillator
    assert (rig.right, rig.left) == (vi.RigidStop(0.6, 0.1), vi.Bumper(30.0, 0.6, 0.1))


@pytest.mark.parametrize("name", ["stops.stiffness", "proportional_stiffness", "relaxation_time"])
def test_a_rigid_stop_has_no_stiffness_to_map_over(name: str) -> None:
    axes = {name: [1.0, 2.0], "gap_ratio": [0.5, 1.0]}
    with pytest.raises(
        vi.InputError, match=f"^rig: '{name}' applies to bumpers, but this rig has none"
    ):
        vi.scenario_map(vi.Rig(between(0.5), 1.0), axes)


def test_a_bumper_has_no_restitution_to_map_over() -> None:
    rig = FREE.replace(right=vi.Bumper(20.0, 0.4, 0.5))
    axes = {"restitution": [0.1, 0.2], "gap_ratio": [0.5, 1.0]}
    with pytest.raises(
        vi.InputError, match=r"^rig: .stops\.restitution. applies to rigid stops and other laws"
    ):
        vi.scenario_map(vi.Rig(rig, 1.0), axes)
    with pytest.raises(vi.InputError, match=r"^vary\['restitution'\]\[1\]: 1\.2"):
        vi.scenario_map(vi.Rig(rig, 1.0), {**axes, "restitution": [0.1, 1.2]})


def test_other_laws_with_a_restitution_are_mapped_over_it() -> None:
    rig = vi.Rig(FREE.replace(right=vi.JankowskiBumper(2000.0, 0.5, 0.5, 1.0)), 1.0)
    mapped = vi.scenario_map(rig, {"restitution": [0.2, 0.8], "amplitude": [1.0, 2.0]}, step=0.2)
    assert (mapped["penetration_ratio"] > 0.0).all()
    assert "e =" not in constants(rig, "stops.restitution", "amplitude")
    assert "e = 0.5" in constants(rig, "gap", "amplitude")
