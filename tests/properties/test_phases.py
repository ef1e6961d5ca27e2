"""Every phase of random motions is what it claims to be, by matrix exponentials.

From the beginning of each phase the exponential leads to its end; in flight the mass never
crosses a bumper, relaxing ones included; in contact the bumper never pulls; and each event comes
where the clearance or the force has come down to zero.
"""

from __future__ import annotations

import numpy as np
from hypothesis import given
from numpy.typing import NDArray

import vibroimpact as vi
from properties.strategies import Motion, examples, motions, simulated
from reference.linear_phases import Mechanics, phases

Array = NDArray[np.float64]

TOLERANCE = 1e-11


def clearance(rig: vi.Oscillator, side: int, state: Mechanics) -> Array:
    if side == 1:
        return rig.right.gap + state.right - state.u if rig.right else np.array(np.inf)
    return rig.left.gap + state.u - state.left if rig.left else np.array(np.inf)


def force(rig: vi.Oscillator, side: int, state: Mechanics) -> Array:
    """Contact force, pressing counted positive."""
    bumper, deformation = (rig.right, state.right) if side == 1 else (rig.left, state.left)
    assert bumper
    return side * (bumper.stiffness * deformation + bumper.damping * state.v)


@examples(100)
@given(motions())
def test_phases_lead_on_and_keep_their_sign(motion: Motion) -> None:
    rig = motion.oscillator
    walk = list(phases(rig, motion.excitation, simulated(motion, 4)))
    size, speed = (max(float(np.abs(phase.motion[i]).max()) for phase in walk) for i in (0, 1))
    for phase, after in zip(walk, [*walk[1:], None], strict=True):
        scales = (size, speed, size, size)
        for arrived, end, scale in zip(phase.arrived, phase.end, scales, strict=True):
            assert abs(arrived - end) <= TOLERANCE * scale
        if phase.contact:
            bumper = rig.right if phase.contact == 1 else rig.left
            scale = bumper.stiffness * size + bumper.damping * speed
            assert force(rig, phase.contact, phase.motion).min() >= -TOLERANCE * scale
            if after:
                assert after.contact == 0
                assert abs(force(rig, phase.contact, phase.arrived)) <= TOLERANCE * scale
        else:
            for side in (1, -1):
                assert clearance(rig, side, phase.motion).min() >= -TOLERANCE * size
            if after:
                assert abs(clearance(rig, after.contact, phase.arrived)) <= TOLERANCE * size
