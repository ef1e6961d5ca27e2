"""A rig as numbers: per unit mass, each side in its place."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par


def test_each_number_has_its_place() -> None:
    rig = par.rig_vector(2.0, 6.0, 0.5, (8.0, 4.0, 0.3), (0.7, 0.1))
    right, left = rig[par.BUMPER :][: par.WIDTH], rig[par.BUMPER + par.WIDTH : par.LOAD]
    assert (rig[par.STIFFNESS], rig[par.DAMPING]) == (3.0, 0.25)
    assert right[par.KIND] == par.KELVIN_VOIGT
    assert (right[par.BUMPER_STIFFNESS], right[par.BUMPER_DAMPING]) == (4.0, 2.0)
    assert (right[par.GAP], right[par.RATE]) == (0.3, 2.0)
    assert left[par.KIND] == par.RIGID
    assert (left[par.RESTITUTION], left[par.GAP]) == (0.7, 0.1)
    assert left[par.BUMPER_STIFFNESS] == left[par.BUMPER_DAMPING] == 0.0
    assert len(left) == par.WIDTH


def test_what_is_absent_is_out_of_reach() -> None:
    rig = par.rig_vector(2.0, 6.0, 0.5, None, (8.0, 0.0, 0.3))
    assert rig[par.BUMPER + par.KIND] == par.ABSENT
    assert rig[par.BUMPER + par.GAP] == math.inf
    assert rig[par.BUMPER + par.WIDTH + par.RATE] == math.inf
