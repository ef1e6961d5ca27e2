"""Passes that end just beyond a bumper, or just before it: every contact found, none invented.

Steady free flight, u = X cos(θ - θ_p) with θ the phase of the base, is known in closed form. With
the gap at (1 - d) X each pass touches the bumper over the phases within h = arccos(1 - d) ≈ √(2d)
of θ_p. An error of the displacement by ε X moves the touch by ε / h, which sets the tolerance: 200
times the rounding of X. Measured: 90 at low and at high frequency, 10 to 40 otherwise.
"""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray

import vibroimpact as vi
from properties.strategies import decades, examples

DEPTHS = [10.0**-n for n in range(2, 14)]
CYCLES = 100
ROUNDING = 200 * 2.0**-52

MASS, STIFFNESS, AMPLITUDE = 3.0, 12.0, 0.7  # ω0 = 2 rad/s


class Flight(NamedTuple):
    """Steady free flight, u = swing cos(θ - peak) with θ the phase of the base."""

    isolator: vi.Isolator
    frequency: float
    swing: float
    peak: float

    def state(self, phase: float) -> vi.State:
        angle = phase - self.peak
        speed = math.tau * self.frequency * self.swing
        return vi.State(self.swing * math.cos(angle), -speed * math.sin(angle))

    def between(self, depth: float, bumper: vi.Bumper, sides: str = "both") -> vi.Oscillator:
        """With bumpers that the mass passes by `depth`, as a share of the swing."""
        gap = self.swing * (1.0 - depth)
        right = bumper.replace(gap=gap) if sides != "left" else None
        left = bumper.replace(gap=gap) if sides != "right" else None
        return vi.Oscillator(MASS, self.isolator, right, left)


def steady(ratio: float, damping_ratio: float) -> Flight:
    omega_0 = math.sqrt(STIFFNESS / MASS)
    damping = 2.0 * damping_ratio * MASS * omega_0
    omega = ratio * omega_0
    turning = -AMPLITUDE / complex(STIFFNESS / MASS - omega**2, damping / MASS * omega)
    # u = Im(turning e^{iθ}) has its peak where the argument is a quarter turn.
    return Flight(
        vi.Isolator(STIFFNESS, damping),
        omega / math.tau,
        abs(turning),
        math.pi / 2 - cmath.phase(turning),
    )


FLIGHTS = {
    "undamped": steady(0.7, 0.0),
    "undamped, above resonance": steady(1.9, 0.0),
    "lightly damped, at resonance": steady(1.0, 0.05),
    "lightly damped, quick": steady(6.3, 0.1),
    "damped, slow": steady(0.05, 0.15),
    "overdamped, very slow": steady(0.01, 8.0),
    "overdamped, quick": steady(4.7, 3.0),
}

STOP = vi.Bumper(20.0 * STIFFNESS, 0.2, 0.0)

FEATHER = vi.Bumper(1e-12 * STIFFNESS, 0.0, 0.0)
"""Too soft to change the motion, so that the passes repeat."""


def touches(
    flight: Flight, oscillator: vi.Oscillator, phase: float, cycles: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Phases of the base at the events, counted on from the start's, and the events' sides."""
    data = vi.simulate(
        vi.Rig(oscillator, vi.Harmonic(AMPLITUDE, flight.frequency, phase)),
        cycles,
        flight.state(phase),
        samples=1,
    )
    turns = data["event_cycle"] + data["event_cycle_time"] * flight.frequency
    return phase + math.tau * turns.values, np.where(data["event_stop"].values == "right", 1, -1)


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("name", FLIGHTS)
def test_every_pass_is_found(name: str, depth: float) -> None:
    flight, phase = FLIGHTS[name], 0.3
    angles, sides = touches(flight, flight.between(depth, FEATHER), phase, CYCLES)
    assert len(angles) == 4 * CYCLES
    half = math.acos(1.0 - depth)
    passes = flight.peak + math.pi * np.arange(-3, 2 * CYCLES + 3)
    passes = passes[passes > phase][: 2 * CYCLES]
    expected = passes[:, None] + [-half, half]
    late = angles.reshape(-1, 2) - expected
    assert np.abs(late).max() * half < ROUNDING
    right = np.cos(passes - flight.peak) > 0.0
    np.testing.assert_array_equal(sides[::2], np.where(right, 1, -1))
    np.testing.assert_array_equal(sides[1::2], sides[::2])


@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize("name", FLIGHTS)
def test_no_contact_is_invented(name: str, depth: float) -> None:
    flight = FLIGHTS[name]
    angles, _ = touches(flight, flight.between(-depth, STOP), 0.3, CYCLES)
    assert not len(angles)


@examples(120)
@given(
    ratio=decades(-1.5, 1.5),
    damping_ratio=st.just(0.0) | decades(-3, 1),
    depth=decades(-13, -2),
    before=st.floats(0.02, 0.98),
    side=st.sampled_from(["right", "left"]),
    bumper=st.sampled_from(["stop", "feather", "elastic"]),
)
def test_the_first_pass_is_found(
    ratio: float, damping_ratio: float, depth: float, before: float, side: str, bumper: str
) -> None:
    """Wherever in the engine's steps it falls, and whatever bumper it meets."""
    assume(abs(ratio - 1.0) + damping_ratio > 0.01)  # else rounding would be magnified
    flight = steady(ratio, damping_ratio)
    met = {"stop": STOP, "feather": FEATHER, "elastic": STOP.replace(damping=0.0)}[bumper]
    half = math.acos(1.0 - depth)
    top = flight.peak + (0.0 if side == "right" else math.pi)
    phase = top - before * math.pi / 2 - half
    for sides in (side, "both"):
        rig = flight.between(depth, met, sides)
        angles, signs = touches(flight, rig, phase, (top - phase) / math.tau)
        assert len(signs)
        assert signs[0] == (1 if side == "right" else -1)
        assert abs(angles[0] - (top - half)) * half < ROUNDING
        rig = flight.between(-depth, met, sides)
        angles, _ = touches(flight, rig, phase, (top + math.pi / 2 - phase) / math.tau)
        assert not len(angles)


@examples(120)
@given(
    ratio=decades(-1, 1),
    depth=decades(-13, -2),
    phase=st.floats(0.0, math.tau),
    relaxation=decades(-2, 2),
    deformation=st.floats(0.05, 1.0),
)
def test_grazing_a_relaxing_bumper(
    ratio: float, depth: float, phase: float, relaxation: float, deformation: float
) -> None:
    """The bumper's face, still on its way back, is passed by the depth or missed by it."""
    flight = steady(ratio, 0.15)
    omega = math.tau * flight.frequency
    rate, pressed = omega * relaxation, deformation * flight.swing

    def ahead(t: NDArray[np.float64]) -> NDArray[np.float64]:
        """The face beyond the mass, if the gap were zero."""
        swing = flight.swing * np.cos(phase + omega * t - flight.peak)
        return pressed * np.exp(-rate * t) - swing

    # The least value, by ever finer grids about it; it is flat there.
    low, high = 0.0, 1.0 / flight.frequency
    for _ in range(6):
        t = np.linspace(low, high, 2001)
        i = int(np.argmin(ahead(t)))
        assume(0 < i < 2000)
        low, high = t[i - 1], t[i + 1]
    nearest = float(ahead(t).min())
    stop = vi.Bumper(20.0 * STIFFNESS, 20.0 * STIFFNESS / rate, 0.0)
    start = flight.state(phase).replace(deformation={"right": pressed}, contact=0)
    shaken = vi.Harmonic(AMPLITUDE, flight.frequency, phase)
    for share in (depth, -depth):
        gap = -nearest - share * flight.swing
        assume(gap > 0.0)
        assume(gap + ahead(np.zeros(1))[0] > 1e-3 * flight.swing)
        rig = vi.Oscillator(MASS, flight.isolator, stop.replace(gap=gap))
        data = vi.simulate(vi.Rig(rig, shaken), 1.0, start, samples=1)
        if share < 0.0:
            assert not data.sizes["event"]
            continue
        assert data.sizes["event"]
        first = float(data["event_time"][0])
        assert abs(gap + ahead(np.array(first))) < ROUNDING * flight.swing
        assert (gap + ahead(np.linspace(0.0, first, 2000)[:-1])).min() > 0.0
