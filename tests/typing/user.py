"""What a user writes, as a type checker sees it (`make lint`, and `make dist` with the wheel)."""

from __future__ import annotations

from pathlib import Path
from typing import assert_type

import numpy as np
import xarray as xr

import vibroimpact as vi
from vibroimpact.figures import basin_portrait, resonance_curves, save_figure

case = vi.laboratory.case("B2-G1-A3")
bumper = vi.Bumper(stiffness="510 kN/m", damping=900.0, gap="7.5 mm")
wall = vi.RigidStop(restitution=0.6, gap=0.005)
rig = vi.Oscillator(
    mass=550.0, isolator=vi.Isolator("26.8 kN/m", damping=1100.0), right=bumper, left=wall
)
shaking = vi.Harmonic(amplitude="0.05 g", frequency=2.6)
record = vi.Record(np.zeros(100), 0.01)
grid = np.linspace(1.0, 3.0, 5)


def swept() -> xr.Dataset:
    assert_type(vi.sweep(vi.Rig(rig, 0.5), grid), xr.Dataset)
    assert_type(vi.sweep(vi.Rig(rig, "0.05 g"), ["1 Hz", 2.0], ("forward",)), xr.Dataset)
    assert_type(vi.sweep(vi.Rig(rig, shaking), frequencies=grid, tolerance=1e-8), xr.Dataset)
    assert_type(vi.sweep("B2-G1-A3", grid), xr.Dataset)
    assert_type(vi.sweep(Path("rig.toml"), grid), xr.Dataset)
    assert_type(vi.sweeps(["rig.toml", Path("rig.toml")], grid), xr.Dataset)
    assert_type(vi.sweep(vi.Rig(rig, 0.5), frequencies=grid), xr.Dataset)
    assert_type(vi.sweeps(["B2-G1-A3", vi.Rig(rig, 0.5)], grid, threads=2), xr.Dataset)
    return vi.sweep(case, case.frequencies)


def moved() -> xr.Dataset:
    motion = vi.simulate(vi.Rig(rig, shaking), 10, start=vi.State(displacement=0.001))
    assert_type(vi.simulate(case, frequency="2 Hz", cycles=10), xr.Dataset)
    assert_type(vi.simulate(vi.Rig(rig, record)), xr.Dataset)
    assert_type(vi.steady(vi.Rig(rig, shaking)), xr.Dataset)
    assert_type(vi.coexisting_motions(case, frequency=2.6, random=4), xr.Dataset)
    assert_type(vi.contacts(motion), xr.Dataset)
    assert_type(vi.seismic_response(vi.Rig(rig, record), tail="5 s"), xr.Dataset)
    return motion


def explored() -> None:
    assert_type(vi.orbit(vi.Rig(rig, shaking), vi.State(0.001, 0.0), period=1), xr.Dataset)
    assert_type(vi.branch(case, frequency="2 Hz", vary={"frequency": (1.0, 3.0)}), xr.Dataset)
    diagram = vi.bifurcation_diagram(
        vi.Rig(rig, shaking), {"gap": ("3 mm", "7 mm")}, 9, where="threads"
    )
    assert_type(diagram, xr.Dataset)
    basins = vi.basins(case, (-0.02, 0.02), ("-1 m/s", "1 m/s"), frequency=2.6, nodes=(20, 30))
    curves = vi.manifolds(vi.Rig(rig, shaking), longest=1.0)
    save_figure(basin_portrait(basins, manifolds=curves), "basins.png")
    assert_type(vi.resonance_diagram(case, {"frequency": (1.0, 3.0)}, basins=[basins]), xr.Dataset)
    assert_type(
        vi.resonance_diagram(vi.Rig(rig, 0.5), {"frequency": (1.0, 3.0)}, random=2), xr.Dataset
    )
    shares = vi.basin_stability(case, frequency=2.0, vary={"frequency": [2.0, 2.6]})
    assert_type(shares, xr.Dataset)


def named() -> None:
    assert_type(vi.classify_scenario(vi.Rig(rig, 0.5)), xr.Dataset)
    assert_type(vi.to_dimensionless(vi.Rig(rig, "0.05 g")), vi.Dimensionless)
    assert_type(vi.to_dimensionless(case), vi.Dimensionless)
    assert_type(vi.from_dimensionless(20.0, 0.3, 0.01, 0.15), vi.Rig)
    save_figure(resonance_curves(swept()), "curves.png")


def designed() -> None:
    chart = vi.design_chart(vi.Rig(rig, "0.05 g"), {"gap": ["5 mm", "8 mm"]})
    assert_type(chart, xr.Dataset)
    assert_type(vi.required_gap(rig, records=[record]), xr.Dataset)
    frame = vi.chain(["250 t"] * 3, ["200 MN/m"] * 3, damping_ratio=0.02)
    assert_type(vi.required_gap(frame, records=record), xr.Dataset)
    assert_type(vi.demands([frame, rig], record, vary={"gap": [0.1]}), xr.Dataset)
    drawn = vi.ensemble("B2-G1-A3", {"gap": "normal:5%"}, lambda rigs: vi.sweeps(rigs, grid))
    assert_type(drawn, xr.Dataset)
    try:
        vi.Bumper(stiffness=-1.0, damping=0.0, gap=0.0)
    except vi.InputError as error:
        print(error)


def refused() -> None:
    """Each comment is needed: the type checker refuses the line."""
    vi.sweep(rig, grid)  # type: ignore[arg-type]
    vi.sweep(case)  # type: ignore[call-arg]
    vi.Rig(3.0, 0.5)  # type: ignore[arg-type]
    vi.simulate(vi.Rig(rig, shaking), cylces=10)  # type: ignore[call-arg]
    vi.simulate("B2-G1-A3", 10, frequency=[2.0])  # type: ignore[arg-type]
