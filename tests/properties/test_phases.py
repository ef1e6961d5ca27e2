"""Every phase of random motions is what it claims to be, by matrix exponentials.

From the beginning of each phase the exponential leads to its end; where the mass does not touch a
stop it is never beyond it, relaxing bumpers included; where it does, the stop never pulls; and
each event comes where the clearance or the force has come down to zero.
"""

from __future__ import annotations

import numpy as np
from hypothesis import given
from numpy.typing import NDArray

import vibroimpact as vi
from properties.strategies import Motion, examples, motions, simulated
from reference.linear_phases import Mechanics, Phase, chatters, phases

Array = NDArray[np.float64]

TOLERANCE = 1e-11


def margin(rig: vi.Oscillator, side: int, phase: Phase, state: Mechanics, base: Array) -> Array:
    """What may not be negative on a side: its clearance, or the force that presses it."""
    stop, face = (rig.right, state.right) if side == 1 else (rig.left, state.left)
    assert stop is not None
    if side not in phase.touched:
        return stop.gap + side * (face - state.u)
    if isinstance(stop, vi.Bumper):
        return side * (stop.stiffness * face + stop.damping * state.v)
    other, opposite = (rig.left, state.left) if side == 1 else (rig.right, state.right)
    pushed = rig.isolator.stiffness * state.u + rig.mass * base
    if isinstance(other, vi.Bumper) and -side in phase.touched:
        pushed = pushed + other.stiffness * opposite
    return -side * pushed


@examples(100)
@given(motions())
def test_phases_lead_on_and_keep_their_sign(motion: Motion) -> None:
    check(motion)


def check(motion: Motion) -> None:
    rig, shaken = motion.oscillator, motion.excitation
    walk = list(phases(rig, shaken, simulated(motion, 4)))
    size, speed = (max(float(np.abs(phase.motion[i]).max()) for phase in walk) for i in (0, 1))
    omega = rig.angular_frequency
    size = max(size, speed / omega, 1e-3 * shaken.amplitude / omega**2)  # where all is rest
    speed = max(speed, size * omega)
    angle = shaken.phase
    for phase in walk:
        angle += shaken.angular_frequency * phase.length
        # Of a chatter into rest, the last impacts are not listed.
        if chatters(rig, phase):
            continue
        scales = (size, speed, size, size)
        for arrived, end, scale in zip(phase.arrived, phase.end, scales, strict=True):
            assert abs(arrived - end) <= TOLERANCE * scale
        for side, stop in ((1, rig.right), (-1, rig.left)):
            if stop is None:
                continue
            scale = max(size, abs(stop.gap))
            if side in phase.touched:
                scale *= rig.isolator.stiffness
                scale += rig.mass * shaken.amplitude
                if isinstance(stop, vi.Bumper):
                    scale = stop.stiffness * size + stop.damping * speed
            assert margin(rig, side, phase, phase.motion, phase.base).min() >= -TOLERANCE * scale
            if phase.then and phase.then[1] == side:
                base = np.array(shaken.amplitude * np.sin(angle))
                assert abs(margin(rig, side, phase, phase.arrived, base)) <= TOLERANCE * scale
