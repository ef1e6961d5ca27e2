"""Scenarios are those of bumpers: a rig with a rigid stop has none."""

from __future__ import annotations

import pytest

import vibroimpact as vi

RIG = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.Bumper(20.0, 0.4, 0.1), vi.RigidStop(0.5, 0.1))


def test_no_scenario_with_a_rigid_stop() -> None:
    with pytest.raises(vi.InputError, match=r"^oscillator.left: RigidStop\(.* a Bumper is accep"):
        vi.classify(RIG, 1.0, [0.1 * k for k in range(1, 30)], max_cycles=10)


def test_no_map_with_a_rigid_stop(tmp_path) -> None:
    axes = ("gap", [0.1, 0.2]), ("amplitude", [0.5, 1.0])
    with pytest.raises(vi.InputError, match=r"^base.left: RigidStop\(.* a Bumper is accepted"):
        vi.scenario_map(*axes, (RIG, 1.0), store=tmp_path / "map.zarr")
