"""Sweeps of an assembly: modes superposed where nothing touches, and the oscillator of one mass."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi

FREQUENCIES = [0.3, 0.9, 1.6, 2.7, 4.0]


def frame(gap: float = 1.0) -> vi.Assembly:
    return vi.Assembly(
        masses={"base": 300.0, "roof": 250.0},
        links={
            "isolator": vi.Link("ground", "base", vi.Isolator(2.0e4, 900.0)),
            "storey": vi.Link("base", "roof", vi.Isolator(6.0e4, 400.0)),
        },
        stops={
            "right": vi.Link("base", "ground", vi.Bumper(6e5, 9e3, gap)),
            "left": vi.Link("ground", "base", vi.Bumper(6e5, 9e3, gap)),
        },
    )


@pytest.mark.parametrize("kind", ["acceleration", "displacement", "force", "harmonics"])
def test_modes_are_superposed_where_nothing_touches(kind: str) -> None:
    assembly = frame()
    shaking = {
        "acceleration": vi.Harmonic("0.3 m/s2", 1.0),
        "displacement": vi.Harmonic("2 mm", 1.0),
        "force": vi.Harmonic("50 N", 1.0, on="roof"),
        "harmonics": vi.Harmonic("0.3 m/s2", 1.0),
    }[kind]
    if kind == "harmonics":
        shaking = vi.Periodic(FREQUENCIES[0], [0.2, 0.1], [0.0, 0.4])
    sweep = vi.sweep(vi.Rig(assembly, shaking), FREQUENCIES, "forward")
    assert (sweep["status"] == 0).all()
    assert (sweep["impacts"] == 0).all()
    angles = np.linspace(0, 2 * np.pi, 20_001)
    m, c, k = assembly.mass_matrix, assembly.damping_matrix, assembly.stiffness_matrix
    for i, f in enumerate(FREQUENCIES):
        omega = 2 * np.pi * f
        sizes = [(0.3, 0.0)]
        if kind == "harmonics":
            sizes = [(0.2, 0.0), (0.1, 0.4)]
        motion, felt = np.zeros((2, len(angles))), np.zeros((2, len(angles)))
        for order, (size, turn) in enumerate(sizes, 1):
            w = order * omega
            if kind == "force":
                push, base = np.array([0.0, 50.0]), 0.0
            else:
                base = -(0.002 * w**2) if kind == "displacement" else size
                push = -m @ np.ones(2) * base
            u = np.linalg.solve(k - w**2 * m + 1j * w * c, push)
            wave = np.exp(1j * (order * angles + turn))
            motion += np.imag(np.outer(u, wave))
            felt += np.imag(np.outer(-(w**2) * u + base, wave))
        here = sweep.isel(frequency=i, direction=0)
        for name, rows in (("displacement", motion), ("acceleration", felt)):
            got = here[f"{name}_max"].values
            if kind == "harmonics":  # beside the sampled extremes, to the sampling
                np.testing.assert_allclose(got, rows.max(1), rtol=1e-6)
                assert (got >= rows.max(1) * (1 - 1e-12)).all()
            else:
                np.testing.assert_allclose(got, np.abs(rows).max(1), rtol=1e-7)
        if kind != "harmonics":
            amplitude = np.abs(u)
            np.testing.assert_allclose(here["displacement_max"], amplitude, rtol=1e-12)
            np.testing.assert_allclose(here["displacement_min"], -amplitude, rtol=1e-12)
            np.testing.assert_allclose(
                here["peak_acceleration"], np.abs(-(w**2) * u + base), rtol=1e-12
            )
            carried = push.sum() - (np.ones(2) @ m @ (-(w**2) * u)) if kind == "force" else None
            if carried is not None:
                np.testing.assert_allclose(here["peak_transmitted_force"], abs(carried), rtol=1e-12)


@pytest.mark.parametrize("rigid", [False, True])
def test_one_mass_is_the_oscillator(rigid: bool) -> None:
    stop = vi.RigidStop(0.6, "8 mm") if rigid else vi.Bumper(2e5, 3e3, "8 mm")
    isolator = vi.Isolator(1.5e4, 600.0)
    shaking = vi.Harmonic("1 m/s2", 1.0)
    frequencies = [0.9, 1.1, 1.3, 2.0]
    one = vi.sweep(vi.Rig(vi.Oscillator(300.0, isolator, stop, stop), shaking), frequencies)
    several = vi.Assembly(
        masses={"m": 300.0},
        links={"isolator": vi.Link("ground", "m", isolator)},
        stops={"right": vi.Link("m", "ground", stop), "left": vi.Link("ground", "m", stop)},
    )
    sweep = vi.sweep(vi.Rig(several, shaking), frequencies)
    settled = (one["period"] > 0).values
    assert settled.sum() >= 6
    assert (sweep["period"].values == one["period"].values).all()
    for name in ("displacement_max", "acceleration_min", "transmitted_force_max"):
        mine = sweep[name].values.reshape(one[name].shape)
        scale = np.abs(one[name].values[settled]).max()
        np.testing.assert_allclose(
            mine[settled], one[name].values[settled], rtol=0, atol=1e-12 * scale
        )
    for side in ("right", "left"):
        for name in ("impacts", "peak_force", "peak_impulse"):
            mine = sweep[name].sel(stop=side).values
            theirs = one[name].sel(stop=side).values
            np.testing.assert_allclose(mine[settled], theirs[settled], rtol=1e-11, atol=1e-12)
    assert (sweep["impacts"].values[settled] > 0).any()


def test_a_sweep_goes_on_from_a_section() -> None:
    rig = vi.Rig(frame(0.01), vi.Harmonic("1 m/s2", 1.0))
    sweep = vi.sweep(rig, [0.8, 0.9], "forward")
    assert sweep["displacement_max"].dims == ("direction", "frequency", "mass")
    assert sweep["peak_force"].sel(stop="right").dims == ("direction", "frequency")
    start = sweep["section"].isel(direction=0, frequency=1)
    again = vi.sweep(rig, [0.9], "forward", start=start)
    assert int(again["cycles"].sum()) < int(sweep["cycles"].sel(frequency=0.9).sum())
    np.testing.assert_allclose(
        again["displacement_max"].values[0, 0], sweep["displacement_max"].values[0, 1], rtol=1e-11
    )


def test_what_is_not_computed_is_refused() -> None:
    many = vi.chain([1.0] * 40, [100.0] * 40)
    with pytest.raises(vi.InputError, match="twice the number of masses"):
        vi.sweep(vi.Rig(many, vi.Harmonic("1 m/s2", 1.0)), [1.0])


def test_many_assemblies_are_swept_as_one_at_a_time() -> None:
    frequencies = [0.7, 0.9, 1.1]
    rigs = {
        name: vi.Rig(frame(gap=gap), "1 m/s2") for name, gap in (("near", 0.008), ("far", 0.016))
    }
    sweeps = vi.sweeps(rigs, frequencies)
    assert sweeps["displacement_max"].dims == ("rig", "direction", "frequency", "mass")
    for name, rig in rigs.items():
        alone = vi.sweep(rig, frequencies)
        for variable in alone.data_vars:
            np.testing.assert_array_equal(sweeps[variable].sel(rig=name), alone[variable])
    other = vi.Rig(vi.chain([1.0], [30.0], 0.05), "1 m/s2")
    with pytest.raises(vi.InputError, match=r"^rigs\['1'\]: its mass names are floor_1, not"):
        vi.sweeps([rigs["near"], other], frequencies)
    with pytest.raises(vi.InputError, match=r"^rigs\[.*\]: an Oscillator beside an Assembly"):
        vi.sweeps([rigs["near"], "B2-G1-A3"], frequencies)
