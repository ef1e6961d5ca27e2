"""Jumps that a sweep in smaller steps confirms, and steps of smooth curves that it does not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from response.curves import grid, made, swept
from vibroimpact.cli import main
from vibroimpact.response.confirmed_jumps import confirm_jumps, confirmed_mass_jumps
from vibroimpact.response.mass_jumps import mass_steps
from vibroimpact.response.resonance import features


@pytest.fixture
def study(tmp_path, capsys):
    """The path of a study file as `vibroimpact init` writes it."""

    def study(kind: str) -> Path:
        path = tmp_path / f"{kind}.toml"
        assert main(["init", str(path), "--kind", kind]) == 0
        return path

    return study


class TestSeveralMasses:
    @pytest.mark.parametrize(("step", "suggested"), [(0.02, 2), (0.01, 2), (0.002, 0)])
    def test_no_jump_where_the_frequencies_do_not_resolve_a_smooth_curve(
        self, study, step, suggested
    ):
        """Extremes of the accelerations lie one step apart."""
        path = study("frame")
        data = vi.sweep(path, grid(0.2, 0.34, step))
        assert len(mass_steps(data).jumps) == suggested
        sure = confirmed_mass_jumps(path, data)
        assert sure.jumps == sure.steep == ()

    @pytest.mark.parametrize("directions", [("forward",), ("backward",), ("forward", "backward")])
    def test_jumps_remain(self, study, directions):
        path = study("neighbours")
        data = vi.sweep(path, grid(1.5, 2.7, 0.1), directions)
        sure = confirmed_mass_jumps(path, data)
        known = {"forward": (2.4, 2.5, False), "backward": (2.4, 2.3, True)}
        assert [(one.before, one.after, one.upward) for one in sure.jumps] == [
            known[direction] for direction in directions
        ]
        assert sure.steep == ()

    def test_what_does_not_settle_is_steep(self, study):
        path = study("frame")
        data = vi.sweep(path, grid(0.2, 0.8, 0.02), ["forward"])
        sure = confirmed_mass_jumps(path, data)
        assert sure.jumps == ()
        assert [(one.before, one.after, one.settled) for one in sure.steep] == [(0.74, 0.76, False)]

    def test_the_curve_that_shows_a_jump_says_whether_it_goes_up(self):
        f = np.array(grid(1.0, 2.0, 0.1))
        dims = ("direction", "frequency", "mass")
        acceleration = np.where(f < 1.45, 1.0, 1.5)
        displacement = 2.0 - 0.1 * (f - 1.0)
        data = xr.Dataset(
            {
                "peak_acceleration": (dims, acceleration[np.newaxis, :, np.newaxis]),
                "peak_displacement": (dims, displacement[np.newaxis, :, np.newaxis]),
                "peak_force": (("direction", "frequency", "stop"), np.ones((1, 11, 1))),
                "motion": (dims[:2], np.full((1, 11), "periodic")),
                "period": (dims[:2], np.ones((1, 11), dtype=int)),
            },
            coords={"direction": ["forward"], "frequency": f, "mass": ["roof"], "stop": ["wall"]},
        )
        (jump,) = mass_steps(data).jumps.values()
        assert jump.upward
        assert jump.peak_displacement[0] > jump.peak_displacement[1]


class TestOneMass:
    @pytest.mark.parametrize("direction", ["forward", "backward"])
    @pytest.mark.parametrize("step", [0.1, 0.01])
    def test_a_jump_of_one_direction_alone_remains(self, direction, step):
        data = swept("B2-G1-A3", 0.5, 5, step, "identified").sel(direction=[direction])
        curve_features = features(data)
        assert len(curve_features.jumps) == 1
        assert (
            confirm_jumps(vi.laboratory.case("B2-G1-A3", "identified"), data, curve_features)
            == curve_features
        )

    def test_hysteresis_within_a_step(self):
        """Both directions jump between the same two frequencies: 1.293 and 1.3 Hz are its ends."""
        code = "B2-G4-A1"
        data = swept(code, 1.17, 1.44, 0.03)
        curve_features = features(data)
        assert [one.frequency for one in curve_features.jumps] == pytest.approx([1.305, 1.305])
        assert curve_features.hysteresis == ()
        assert confirm_jumps(code, data, curve_features).jumps == curve_features.jumps

    def test_grazing_within_a_step_is_no_jump(self):
        """The branch rises as a square root, to three times its height within one step."""
        code = "B4-G2-A1"
        data = swept(code, 0.5, 1.3, 0.1)
        curve_features = features(data)
        assert (0.9, 1.0) in [(one.before, one.after) for one in curve_features.jumps]
        assert not features(swept(code, 0.9, 0.98, 0.001)).jumps
        sure = confirm_jumps(code, data, curve_features)
        assert (0.9, 1.0) not in [(one.before, one.after) for one in sure.jumps]
        assert set(sure.jumps + sure.steep) <= set(curve_features.jumps)

    def test_the_curve_that_shows_a_jump_says_whether_it_goes_up(self):
        f = np.array(grid(1.0, 2.0, 0.1))
        data = made(f, 2.0 - 0.1 * (f - 1.0))
        data["eta_d"] = data["eta_d"].copy(data=np.where(f < 1.45, 1.0, 1.5)[np.newaxis])
        (jump,) = features(data).jumps
        assert jump.upward
        assert jump.by == "eta_d"
