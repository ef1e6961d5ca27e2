"""When a hold counts as steady, on rigs that have fooled a simpler rule."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi


def unit(damping: float, right=None, left=None) -> vi.Oscillator:
    bumpers = [None if b is None else vi.Bumper(*b) for b in (right, left)]
    return vi.Oscillator(1.0, vi.Isolator(1.0, damping), *bumpers)


def test_a_frequency_step_is_a_new_transient() -> None:
    """Each hold goes on as a hold that starts afresh from the section would."""
    rig = unit(0.04, (66.04104915189899, 0.01 * math.sqrt(66.04104915189899), 1.0239943438389205))
    frequencies = [0.0033756601469152278, 0.023500082207386364]
    both = vi.sweep(vi.Rig(rig, 1.0), frequencies, "forward", phase=4.0).isel(direction=0)
    start = both["section"].isel(frequency=0)
    alone = vi.sweep(vi.Rig(rig, 1.0), frequencies[1:], "forward", start=start).isel(direction=0)
    for name in ("displacement_max", "impacts", "cycles"):
        assert both[name].values[1] == pytest.approx(alone[name].values[0], rel=1e-9), name


@pytest.mark.parametrize(
    ("rig", "frequency", "phase"),
    [
        (unit(0.04, (838.8482987796126, 2.9832787577702145, 0.0)), 1.2177279465593267, 2.3059),
        (
            unit(0.04, (7.582930866992834, 0.009275054457324182, 0.0)),
            0.4848120053633436 / 6.2832,
            0,
        ),
        (unit(0.04), 0.4 / (2 * math.pi), 0.0),
    ],
)
def test_what_is_called_steady_is_where_it_says(
    rig: vi.Oscillator, frequency: float, phase: float
) -> None:
    """Many periods later the motion has not moved."""
    held = vi.sweep(vi.Rig(rig, 1.0), [frequency], "forward", phase=phase).isel(
        direction=0, frequency=0
    )
    assert held["motion"] == "periodic"
    later = vi.simulate(
        vi.Rig(rig, vi.Harmonic(1.0, frequency)),
        400 * int(held["period"]),
        held["section"],
        samples=0,
    )["final_state"]
    size = abs(held["section"].values[:2]).max()
    np.testing.assert_allclose(later[:2], held["section"][:2], atol=1e-11 * size, rtol=0.0)


def test_the_size_of_a_transient_is_forgotten() -> None:
    rig, frequency = unit(0.04), 0.4 / (2 * math.pi)
    held = vi.sweep(vi.Rig(rig, 1.0), [frequency], "forward", start=vi.State(1e6)).isel(direction=0)
    free = held["free_displacement_excursion"].item()
    assert held["displacement_excursion"].item() == pytest.approx(free, rel=1e-11)


def test_a_small_limit_is_kept() -> None:
    case = vi.laboratory.case("B2-G1-A3")
    held = vi.sweep(
        vi.Rig(case.oscillator, case.amplitude), [2.0], "forward", max_cycles=1, window=1
    )
    assert held["cycles"].item() == 2
    assert held["motion"].item() == "undecided"
