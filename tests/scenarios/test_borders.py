"""The exact border where jumps begin."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from scenarios.small_map import rig_of
from vibroimpact.scenarios.borders import jump_border
from vibroimpact.scenarios.scenario import Scenario


def test_the_border_of_jumps_is_the_cusp_of_the_folds():
    """At B2-G1-A3's gap, found over two parameters from either fold: λ = 1.6276962."""
    case = vi.laboratory.case("B2-G1-A3")
    delta = vi.to_dimensionless(rig_of(case)).right.gap
    data = vi.scenario_map(
        rig_of(case),
        {"stiffness_ratio": np.geomspace(1.0, 4.0, 9), "gap_ratio": [delta, delta + 0.2]},
        step=0.02,
    )
    counts = []
    border = jump_border(data, threads=1, progress=lambda *done: counts.append(done))
    assert counts[-1] == (2, 2)
    for others in ({"threads": 2}, {"where": "processes", "threads": 2}):
        xr.testing.assert_identical(jump_border(data, **others), border)
    with pytest.raises(vi.InputError, match=r"^where: 'nowhere'"):
        jump_border(data, where="nowhere")
    assert border.sizes["border_point"] == 2
    assert float(border["gap_ratio"][0]) == delta
    assert float(border["stiffness_ratio"][0]) == pytest.approx(1.6276962, abs=1e-6)
    # It lies between the nodes that it parts.
    for k in range(2):
        jumping = np.isin(data["scenario"].values[k], [Scenario.S2, Scenario.S3])
        first = int(np.argmax(jumping))
        low, high = data["stiffness_ratio"].values[[first - 1, first]]
        assert low < float(border["stiffness_ratio"][k]) < high
    with pytest.raises(vi.InputError, match="data: this is not a map"):
        jump_border(xr.Dataset())


def test_a_map_without_such_a_border():
    data = vi.scenario_map(None, {"damping_ratio": [0.1, 0.2], "relaxation_time": [0.01, 0.02]})
    assert jump_border(data).sizes["border_point"] == 0
