"""Several harmonics: sums of single ones, derivatives of their map, and when the mirror holds."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from reference.paper_signs import start as start_at
from vibroimpact.response import analytic_free_response

ISOLATORS = {"spring": vi.Isolator(8.0, 0.8), "undamped": vi.Isolator(8.0, 0.0)}
FREQUENCY, SIZES, ANGLES = 0.41, (1.0, 0.5, 0.0, 0.8), (0.3, 1.0, 0.0, -2.0)


@pytest.mark.parametrize("of", ["acceleration", "displacement", "force", "unbalance"])
@pytest.mark.parametrize("isolator", ISOLATORS)
def test_free_flight_is_the_sum_of_the_single_ones(of: str, isolator: str) -> None:
    rig = vi.Oscillator(2.0, ISOLATORS[isolator])
    whole = vi.simulate(
        vi.Rig(rig, vi.Periodic(FREQUENCY, SIZES, ANGLES, 0.7, of=of)),
        5,
        vi.State(0.1, -0.2),
        samples=12,
    )
    single = vi.Harmonic(0.0, FREQUENCY, of=of)
    parts = [vi.simulate(vi.Rig(rig, single), 5, vi.State(0.1, -0.2), samples=12)]
    for n, (size, angle) in enumerate(zip(SIZES, ANGLES, strict=True), start=1):
        shaken = vi.Harmonic(size, n * FREQUENCY, n * 0.7 + angle, of=of)
        parts.append(vi.simulate(vi.Rig(rig, shaken), 5 * n, samples=12 // n))
    shaking = "applied_force" if of in ("force", "unbalance") else "base_acceleration"
    for name in ("displacement", "velocity", "acceleration", shaking):
        total = sum(part[name].values for part in parts)
        size = float(np.abs(total).max())
        np.testing.assert_allclose(whole[name], total, rtol=0.0, atol=1e-12 * size, err_msg=name)


def test_one_harmonic_is_a_harmonic() -> None:
    """Between stops too; and the second of two is one of twice the frequency."""
    rig = vi.Oscillator(
        2.0, ISOLATORS["spring"], vi.Bumper(160.0, 3.0, 0.1), vi.RigidStop(0.5, 0.1)
    )
    plain = vi.simulate(vi.Rig(rig, vi.Harmonic(1.5, 0.6, 0.4)), 8, samples=4)
    for shaken, cycles, samples in (
        (vi.Periodic(0.6, (1.5,), phase=0.4), 8, 4),
        (vi.Periodic(0.3, (0.0, 1.5), (0.0, 0.4)), 4, 8),
        (vi.Periodic(0.3, (0.0, 1.5), phase=0.2), 4, 8),
    ):
        other = vi.simulate(vi.Rig(rig, shaken), cycles, samples=samples)
        np.testing.assert_allclose(other["displacement"], plain["displacement"], atol=1e-13)
        np.testing.assert_allclose(other["velocity"], plain["velocity"], atol=1e-12)
        np.testing.assert_allclose(other["event_time"], plain["event_time"], atol=1e-12)
    assert plain.sizes["event"] > 8


BUMPER, DULL, WALL = (
    vi.Bumper(160.0, 8.0, 0.1),
    vi.Bumper(160.0, 30.0, 0.1),
    vi.RigidStop(0.7, 0.12),
)
GUESS = vi.State(0.0888, -0.1)
"""At the phase 0.25, near an orbit with either stop, which with the walls is unstable."""
ODD = {"amplitudes": (1.5, 0.0, 0.9), "phases": (0.0, 0.0, 1.0)}
EVEN = {"amplitudes": (1.5, 0.6, 0.9), "phases": (0.0, 0.5, 1.0)}


def between(right, left=None, **more) -> vi.Oscillator:
    return vi.Oscillator(2.0, vi.Isolator(8.0, 0.8), right, right if left is None else left, **more)


def differences(rig: vi.Oscillator, shaken, state: np.ndarray, steps: float) -> np.ndarray:
    """Derivative of the state after a cycle with respect to displacement and velocity."""

    def after(change: np.ndarray) -> np.ndarray:
        start = start_at([*(state[:4] + change), state[4]])
        return vi.simulate(vi.Rig(rig, shaken), 1, start, samples=0)["final_state"].values[:4]

    columns = []
    for i in (0, 1):
        change = np.zeros(4)
        change[i] = steps
        columns.append((after(change) - after(-change)) / (2 * steps))
    return np.array(columns).T


@pytest.mark.parametrize("stop", [BUMPER, WALL])
@pytest.mark.parametrize("kind", [ODD, EVEN])
@pytest.mark.parametrize("of", ["acceleration", "displacement", "force", "unbalance"])
def test_multipliers_are_those_of_central_differences(stop, kind: dict, of: str) -> None:
    whole = vi.Periodic(0.45, kind["amplitudes"], kind["phases"], 0.25)
    omega = whole.angular_frequency
    sizes = [
        {
            "acceleration": a,
            "displacement": a / (n * omega) ** 2,
            "force": 2.0 * a,
            "unbalance": 2.0 * a / (n * omega) ** 2,
        }[of]
        for n, a in enumerate(kind["amplitudes"], start=1)
    ]
    shaken = vi.Periodic(
        0.45, sizes, kind["phases"], 0.25 + (of != "acceleration") * math.pi, of=of
    )
    rig = between(stop)
    orbit = vi.orbit(vi.Rig(rig, shaken), GUESS, 1, samples=16)
    assert len(orbit.attrs["contacts"]) >= 2
    state = orbit["final_state"].values
    assert not state[5:7].any()
    expected = differences(rig, shaken, state, 1e-7)
    np.testing.assert_allclose(
        orbit["monodromy"].values[:, :2], expected, atol=1e-6 * np.abs(expected).max()
    )
    shown = orbit["multiplier_real"].values + 1j * orbit["multiplier_imag"].values
    own = np.linalg.eigvals(orbit["monodromy"].values)
    np.testing.assert_allclose(np.sort(abs(own)), np.sort(abs(shown)), atol=1e-9 * abs(shown).max())
    assert abs(shown).max() > 1e-3


@pytest.mark.parametrize("stop", [DULL, WALL])
def test_the_mirror_holds_without_even_harmonics_only(stop) -> None:
    def half_a_period_later(shaken, rig) -> tuple[bool, float]:
        orbit = vi.orbit(vi.Rig(rig, shaken), GUESS, 1, samples=64)
        u = orbit["displacement"].values[:64]
        return bool(orbit["antisymmetric"]), float(np.abs(u + np.roll(u, 32)).max())

    odd, even = (vi.Periodic(0.45, **kind, phase=0.25) for kind in (ODD, EVEN))
    assert (odd.half_wave, even.half_wave) == (True, False)
    is_mirrored, miss = half_a_period_later(odd, between(stop))
    assert is_mirrored
    assert miss < 1e-12
    for shaken, rig in (
        (even, between(stop)),
        (odd, between(stop, stop.replace(gap=0.14))),
        (odd, between(stop, force=0.3)),
    ):
        is_mirrored, miss = half_a_period_later(shaken, rig)
        assert not is_mirrored
        assert miss > 1e-3


@pytest.mark.parametrize("kind", [ODD, EVEN])
def test_a_branch_of_orbits(kind: dict) -> None:
    """Each closes, and its multipliers are those of central differences."""
    rig, shaken = between(WALL), vi.Periodic(0.45, **kind, phase=0.25)
    data = vi.branch(vi.Rig(rig, shaken), GUESS, vary={"frequency": (0.43, 0.48)})
    assert (data["antisymmetric"].values == (kind is ODD)).all()
    assert data["frequency"].values.min() == pytest.approx(0.43)
    assert data["frequency"].values.max() == pytest.approx(0.48)
    checked = 0
    for i in range(0, data.sizes["point"], max(1, data.sizes["point"] // 12)):
        section = data["section"].values[i]
        here = shaken.replace(frequency=float(data["frequency"][i]))
        start = start_at(section)
        motion = vi.simulate(vi.Rig(rig, here), 1, start, samples=400)
        np.testing.assert_allclose(motion["final_state"].values[:4], section[:4], atol=1e-10)
        seen = np.ptp(motion["displacement"].values)
        assert float(data["displacement_excursion"][i]) == pytest.approx(seen, rel=5e-2)
        if not section[5:7].any():
            own = np.linalg.eigvals(differences(rig, here, section, 1e-7)[:2])
            multipliers = data["multiplier_real"].values[i] + 1j * data["multiplier_imag"].values[i]
            assert abs(max(abs(own)) - max(abs(multipliers))) < 1e-5 * max(abs(own))
            checked += 1
    assert checked >= 5


def test_the_reference_is_found_once_along_a_branch(monkeypatch) -> None:
    """Frequency, amplitude and stops do not matter to the largest free flight's shape."""
    asked = []
    harmonics = analytic_free_response.harmonics
    monkeypatch.setattr(
        analytic_free_response,
        "harmonics",
        lambda *arguments: asked.append(len(arguments[1])) or harmonics(*arguments),
    )
    rig, shaken = between(DULL), vi.Periodic(0.45, (1.5, 0.61, 0.9))
    analytic_free_response.reference_excursions(vi.Rig(rig, shaken))
    once = len(asked)
    assert once > 10
    one = analytic_free_response.reference_excursions(vi.Rig(rig, shaken))
    twice = analytic_free_response.reference_excursions(
        vi.Rig(
            rig.replace(right=None, force=1.0),
            shaken.replace(amplitude=3.0, frequency=1.0, phase=0.3),
        )
    )
    np.testing.assert_allclose(twice, 2.0 * np.array(one), rtol=1e-14)
    assert len(asked) == once
