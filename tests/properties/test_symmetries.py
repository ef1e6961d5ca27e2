"""Left or right, and the units, do not matter: random motions and their images."""

from __future__ import annotations

import math

import pytest
from hypothesis import given

import vibroimpact as vi
from properties.strategies import (
    SAMPLES,
    Motion,
    decades,
    distance,
    examples,
    motions,
    simulated,
    states,
    tame,
)

ROUNDING = 1e-11

CYCLES = 3


@examples(60)
@given(motions())
def test_the_mirrored_rig_moves_mirrored(motion: Motion) -> None:
    data = tame(motion, CYCLES)
    shaken, start = motion.excitation, motion.start
    mirror = Motion(
        motion.oscillator.mirrored(),
        shaken.replace(phase=shaken.phase + math.pi),
        vi.State(-start.displacement, -start.velocity),
    )
    image = states(simulated(mirror, CYCLES, SAMPLES))
    assert distance(data, -image[[0, 1, 3, 2]]) < ROUNDING


@examples(60)
@given(
    motions(least_damping=1e-3, most_damping=0.7), decades(-3, 3), decades(-3, 3), decades(-3, 3)
)
def test_the_dimensionless_motion_has_no_units(
    motion: Motion, mass: float, stiffness: float, amplitude: float
) -> None:
    data = tame(motion, CYCLES)
    rig, shaken = motion.oscillator, motion.excitation
    plain = vi.to_dimensionless(vi.Rig(rig, shaken.amplitude))
    made = plain.to_physical(mass=mass, stiffness=stiffness, amplitude=amplitude)
    other, acceleration = made.oscillator, made.amplitude
    quicker = other.angular_frequency / rig.angular_frequency
    longer = acceleration / shaken.amplitude / quicker**2
    u, v = motion.start.displacement * longer, motion.start.velocity * longer * quicker
    scaled = Motion(
        other,
        vi.Harmonic(acceleration, shaken.frequency * quicker, shaken.phase),
        vi.State(u, v),
    )
    image = states(simulated(scaled, CYCLES, SAMPLES)) / longer
    image[1] /= quicker
    assert distance(data, image) < ROUNDING


@examples(10)
@given(decades(-3, 3), decades(-3, 3), decades(-3, 3))
def test_resonance_curves_have_no_units(mass: float, stiffness: float, amplitude: float) -> None:
    case = vi.laboratory.case("B2-G1-A3")
    plain = vi.to_dimensionless(vi.Rig(case.oscillator, case.amplitude))
    other = plain.to_physical(mass=mass, stiffness=stiffness, amplitude=amplitude)
    quicker = other.oscillator.natural_frequency / case.oscillator.natural_frequency
    grid = [0.6, 1.0, 1.7, 2.5, 3.5]
    curves = vi.sweep(vi.Rig(case.oscillator, case.amplitude), grid)
    image = vi.sweep(other, [f * quicker for f in grid])
    for name in ("eta_d", "eta_a", "impacts", "period"):
        assert image[name].values == pytest.approx(curves[name].values, rel=1e-9, abs=1e-9)
