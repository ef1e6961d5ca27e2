"""Motions under curved laws measured: extremes, energies, contacts and lines, by a second way."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from reference.stored_energy import stored
from samples import sample

ISOLATORS: dict[str, vi.Isolator] = {
    "linear": vi.Isolator(60.0, 0.8),
    "drag": vi.Isolator(60.0, 0.8, damping_exponent=0.5),
    "friction": vi.FrictionIsolator(60.0, 0.3, 0.4),
    "bilinear": vi.BilinearIsolator(200.0, 40.0, 3.0, 0.3),
    "polynomial": vi.PolynomialIsolator(60.0, 0.8, 900.0, 4e4),
    "bouc-wen": vi.BoucWenIsolator(200.0, 40.0, 3.0, 0.3, exponent=3),
    "exponential": vi.ExponentialIsolator(300.0, 50.0, 60.0, 0.3, 9.0, 0.2),
}
STOPS: dict[str, tuple[object, object]] = {
    "bumpers": (vi.Bumper(900.0, 3.0, 0.05), vi.Bumper(600.0, 2.0, 0.04)),
    "powers": (vi.PowerBumper(9e3, 0.05, restitution=0.6), vi.PowerBumper(2e3, 0.04, 1.2, 0.3)),
    "jankowski": (vi.JankowskiBumper(9e3, 0.05, 0.6, 2.0), vi.RigidStop(0.7, 0.06)),
    "overlapping": (vi.PowerBumper(5e3, -0.01, 1.5, 0.2), vi.PowerBumper(2e3, 0.005, 1.5, 0.3)),
}
CASES = [(one, "powers") for one in ISOLATORS] + [("bouc-wen", one) for one in STOPS]
SHAKEN = vi.Harmonic(4.0, 1.1, 0.3)


def rig(isolator: str, stops: str) -> vi.Oscillator:
    right, left = STOPS[stops]
    return vi.Oscillator(2.0, ISOLATORS[isolator], right, left, force=0.3)


def followed(oscillator: vi.Oscillator, shaken: object, samples: int | None = None) -> xr.Dataset:
    start = vi.State(0.0, 0.4)
    if isinstance(shaken, vi.Record):
        return vi.simulate(vi.Rig(oscillator, shaken), start=start, tail=0.7, samples=samples)
    return vi.simulate(vi.Rig(oscillator, shaken), 6.3, start, samples=samples)


ROUGH = vi.Record(np.random.default_rng(7).uniform(-6.0, 6.0, 41), 0.125)


@pytest.mark.parametrize(("isolator", "stops"), sample(CASES, CASES[::4]))
@pytest.mark.parametrize("shaken", [SHAKEN, ROUGH], ids=["sine", "record"])
def test_no_energy_is_lost_count_of(isolator: str, stops: str, shaken: object) -> None:
    oscillator = rig(isolator, stops)
    data = followed(oscillator, shaken)
    totals = vi.totals(data)
    change = stored(oscillator, data, -1) - stored(oscillator, data, 0)
    balance = totals["total_supplied"] - totals["total_isolator"] - totals["total_bumpers"]
    scale = float(totals["total_isolator"] + totals["total_bumpers"])
    assert float(totals["total_isolator"]) > 0.01
    assert float(totals["total_bumpers"]) > 0.01
    assert float(balance) == pytest.approx(change, abs=1e-11 * scale)


@pytest.mark.parametrize(("isolator", "stops"), sample(CASES, CASES[1::2]))
def test_the_extremes_are_those_of_many_samples(isolator: str, stops: str) -> None:
    oscillator = rig(isolator, stops)
    data = followed(oscillator, SHAKEN, 4000)
    exact = vi.totals(data)
    # A sample may miss the impact on a wall by a step's way.
    for one, near in (
        ("displacement", 2e-4 if stops == "jankowski" else 1e-6),
        ("acceleration", 1e-4),
    ):
        values = [data[one].values]
        if one == "acceleration":
            values += [data[f"event_acceleration_{side}"].values for side in ("before", "after")]
        seen = np.concatenate(values)
        high, low = (float(exact[f"{one}_{end}"]) for end in ("max", "min"))
        size = high - low
        assert high - near * size <= seen.max() <= high + 1e-12 * size
        assert low - 1e-12 * size <= seen.min() <= low + near * size


@pytest.mark.parametrize(("isolator", "stops"), sample(CASES, CASES[1::2]))
def test_contacts_are_those_of_many_samples(isolator: str, stops: str) -> None:
    """Impulses by the trapezoidal rule; deformations and forces at their largest."""
    oscillator = rig(isolator, stops)
    data = followed(oscillator, SHAKEN, 20_000)
    log = vi.contacts(data)
    t, u, v = (data[name].values for name in ("time", "displacement", "velocity"))
    assert log.sizes["contact_number"] > 3
    for i in range(log.sizes["contact_number"]):
        side, begin, end = (
            int(np.where(log["contact_stop"] == "right", 1, -1)[i]),
            *tuple(float(log[f"contact_{name}"][i]) for name in ("start", "end")),
        )
        stop = oscillator.right if side == 1 else oscillator.left
        if isinstance(stop, vi.RigidStop):
            assert float(log["contact_restitution"][i]) == pytest.approx(stop.restitution)
            continue
        inside = (t >= begin) & (t <= end)
        if isinstance(stop, vi.Bumper):
            name = "right" if side == 1 else "left"
            depth = data["deformation"].sel(stop=name).values[inside]
        else:
            depth = np.maximum(side * u[inside] - stop.gap, 0.0)
        force = pushes(stop, depth, side * v[inside], abs(float(log["contact_start_velocity"][i])))
        assert float(log["contact_penetration"][i]) == pytest.approx(depth.max(), rel=1e-4)
        assert float(log["contact_peak_force"][i]) == pytest.approx(force.max(), rel=1e-3)
        impulse = np.trapezoid(force, t[inside])
        assert float(log["contact_impulse"][i]) == pytest.approx(impulse, rel=2e-3)


def pushes(stop: object, depth: np.ndarray, closing: np.ndarray, speed: float) -> np.ndarray:
    """The force of a stop (N)."""
    if isinstance(stop, vi.Bumper):
        return stop.stiffness * depth + stop.damping * closing
    if isinstance(stop, vi.JankowskiBumper):
        viscous = 2.0 * stop.damping_ratio * np.sqrt(stop.mass * stop.stiffness * np.sqrt(depth))
        return stop.stiffness * depth**1.5 + np.where(closing > 0.0, viscous * closing, 0.0)
    number = stop.dissipation_number
    chi = stop.dissipation if number is None else number / speed
    return np.maximum(stop.stiffness * depth**stop.exponent * (1.0 + chi * closing), 0.0)


@pytest.mark.parametrize(("isolator", "stops"), [("bouc-wen", "powers"), ("polynomial", "bumpers")])
def test_a_steady_motion_has_its_lines_and_its_balance(isolator: str, stops: str) -> None:
    oscillator = rig(isolator, stops)
    motion = vi.steady(vi.Rig(oscillator, SHAKEN))
    assert motion["motion"] == "periodic"
    n = int(motion["period"])
    supplied, isolated, bumpers = (
        float(motion[f"energy_{one}"]) for one in ("supplied", "isolator", "bumpers")
    )
    assert supplied == pytest.approx(isolated + bumpers, rel=1e-8)
    spectrum = vi.fourier_spectrum(motion, 6)
    dense = vi.simulate(vi.Rig(oscillator, SHAKEN), n, motion["final_state"], samples=8192)
    for name, near in (("displacement", 1e-6), ("velocity", 1e-5), ("acceleration", 1e-3)):
        values = dense[name].values[:-1]
        lines = 2.0 * np.fft.rfft(values)[: 6 * n + 1] / len(values)
        lines[0] /= 2.0
        amplitudes = spectrum[f"{name}_amplitude"].values * np.exp(
            1j * spectrum[f"{name}_phase"].values
        )
        assert np.abs(amplitudes - lines).max() < near * np.abs(lines).max()
    assert math.isfinite(float(motion["exponents"][0]))
