"""Every kind of rig against the independent integration to fifty digits.

Over `CYCLES` cycles from a start far from the steady motion, the state at each stroboscopic
section and at every event agrees within 1e-12 of the largest displacement (or velocity), and so do
the times of the events, in forcing periods. Measured over 20: 4e-14 at worst, below 1e-14 for most
rigs.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import pytest
from mpmath import mp, mpf
from numpy.typing import NDArray

import vibroimpact as vi
from reference import fifty_digits
from reference.paper_signs import in_paper_signs, signed_parts
from reference.rig import Rig, Stop
from samples import sample

CYCLES = sample(20, 3)
TOLERANCE = 1e-12

MASS, STIFFNESS, AMPLITUDE = 550.0, 26.29e3, 0.49  # the published rig in test A3
OMEGA = math.sqrt(STIFFNESS / MASS)


class Setup(NamedTuple):
    """A bumper is (stiffness ratio, relaxation time × ω0, gap in m)."""

    right: tuple[float, float, float] | None
    left: tuple[float, float, float] | None
    frequency: float
    start: vi.State = vi.State()
    damping_ratio: float = 0.15
    phase: float = 0.0


def symmetric(ratio: float, relaxation: float, gap: float, frequency: float, **rest: Any) -> Setup:
    return Setup((ratio, relaxation, gap), (ratio, relaxation, gap), frequency, **rest)


SETUPS = {
    "symmetric": symmetric(19.4, 0.01, 7.5e-3, 2.5, start=vi.State(0.004, 0.3)),
    "asymmetric": Setup((19.4, 0.01, 6e-3), (40.0, 0.02, 9e-3), 1.7),
    "one-sided": Setup(None, (25.9, 0.01, 5e-3), 1.3, phase=2.0),
    "no gap": symmetric(25.9, 0.01, 0.0, 5.0),
    "no gap on one side": Setup((19.4, 0.05, 0.0), (19.4, 0.01, 7.5e-3), 2.2),
    "no gap, soft": symmetric(0.25, 0.5, 0.0, 1.4, start=vi.State(0.0, -0.1)),
    "undamped isolator": symmetric(25.9, 0.01, 7.5e-3, 1.9, damping_ratio=0.0),
    "overdamped isolator": symmetric(10.0, 0.01, 1e-4, 1.0, damping_ratio=5.25),
    "nearly critical contact": symmetric(24.0, 9.7 / 24 * (1 + 1e-9), 6e-3, 1.5),
    "overdamped contact": symmetric(3.0, 2.0, 7.5e-3, 1.2),
    "heavily overdamped contact": symmetric(50.0, 5.0, 5e-3, 1.0),
    "elastic": symmetric(19.4, 0.0, 7.5e-3, 2.0),
    "elastic, one-sided, no gap": Setup((19.4, 0.0, 0.0), None, 1.9, start=vi.State(-0.01)),
    "stiff": symmetric(1e5, 0.001, 7.5e-3, 1.5),
    "soft": symmetric(0.25, 0.1, 3e-3, 1.1),
    "soft with long memory": symmetric(0.25, 8.0, 3e-3, 1.1, phase=-1.0),
    "low frequency": Setup((19.4, 0.01, 4e-3), None, 0.3),
    "high frequency": symmetric(19.4, 0.3, 1e-4, 12.0, phase=0.7),
    "pressing start": symmetric(19.4, 0.01, 7.5e-3, 2.2, start=vi.State(9e-3, 0.05)),
    "start before relaxing bumpers": symmetric(
        10.0, 1.0, 5e-3, 1.6, start=vi.State(1e-3, -0.02, {"right": 3e-3, "left": 6e-3}), phase=0.4
    ),
}


def oscillator_and_reference_rig(setup: Setup) -> tuple[vi.Oscillator, Rig]:
    damping = 2.0 * setup.damping_ratio * OMEGA * MASS
    numbers = [
        side and (side[0] * STIFFNESS, side[1] * side[0] * STIFFNESS / OMEGA, side[2])
        for side in (setup.right, setup.left)
    ]
    right, left = (side and vi.Bumper(*side) for side in numbers)
    stops = (side and Stop(*side) for side in numbers)
    return (
        vi.Oscillator(MASS, vi.Isolator(STIFFNESS, damping), right, left),
        Rig(MASS, STIFFNESS, damping, *stops),
    )


def reference_start(setup: Setup) -> tuple[float, float, float, float]:
    u, v, deformations = setup.start.displacement, setup.start.velocity, setup.start.deformation
    right = deformations.get("right", max(u - setup.right[2], 0.0) if setup.right else 0.0)
    left = deformations.get("left", max(-u - setup.left[2], 0.0) if setup.left else 0.0)
    return u, v, right, 0.0 - left


def follow(setup: Setup) -> tuple[NDArray[np.float64], list[str], NDArray[np.float64]]:
    """Sections (u, v, u_R, u_L); kinds of the events; their (time in cycles, u, v, u_R, u_L)."""
    oscillator, _ = oscillator_and_reference_rig(setup)
    shaken = vi.Harmonic(AMPLITUDE, setup.frequency, setup.phase)
    data = vi.simulate(vi.Rig(oscillator, shaken), CYCLES, setup.start, samples=1)
    last = vi.simulate(vi.Rig(oscillator, shaken), CYCLES, setup.start, samples=0)["final_state"]
    data = in_paper_signs(data)
    sampled = ("displacement", "velocity", "right_bumper", "left_bumper")
    sections = np.stack([data[name].values for name in sampled], axis=-1)
    np.testing.assert_array_equal(sections[-1], signed_parts(last.values))
    rows = np.stack(
        [data["event_time"] * setup.frequency, *(data[f"event_{name}"] for name in sampled)],
        axis=-1,
    )
    kinds = [
        ("contact" if begins else "detach") + ("_right" if side == 1 else "_left")
        for begins, side in zip(
            data["event_contact"].values, data["event_side"].values, strict=True
        )
    ]
    # To the reference, a contact at once (to rounding) is part of the start.
    at_once = 1 if len(rows) and rows[0, 0] < 1e-15 else 0
    return sections, kinds[at_once:], rows[at_once:]


def largest(
    rows: NDArray[np.float64], exact: list[tuple[mpf, ...]], scale: tuple[float, ...]
) -> float:
    """Largest difference, each column over its scale; subtracted in fifty digits."""
    with mp.workdps(50):
        return max(
            float(abs(a - b)) / unit
            for row, other in zip(rows.tolist(), exact, strict=True)
            for a, b, unit in zip(row, other, scale, strict=True)
        )


@pytest.mark.parametrize("name", sample([*SETUPS], [*SETUPS][::2]))
def test_sections_and_events_agree_with_fifty_digits(name: str) -> None:
    setup = SETUPS[name]
    _, rig = oscillator_and_reference_rig(setup)
    run = fifty_digits.integrate(
        rig, AMPLITUDE, setup.frequency, setup.phase, reference_start(setup), CYCLES
    )
    sections, kinds, rows = follow(setup)
    assert len(kinds) >= 5
    assert kinds == [event.kind for event in run.events]
    size, speed = (max(abs(float(state[i])) for state in run.states) for i in (0, 1))
    scale = (size, speed, size, size)
    assert largest(sections, run.states, scale) <= TOLERANCE
    with mp.workdps(50):
        times = [(event.time * setup.frequency,) for event in run.events]
    assert largest(rows[:, :1], times, (1.0,)) <= TOLERANCE
    assert largest(rows[:, 1:], [event[2:] for event in run.events], scale) <= TOLERANCE
