"""What the base works is dissipated or stored, over random rigs.

In the frame of the base, its work is that of the inertia force -M A_t. It goes into the isolator's
dashpot, into the dashpot of a pressed bumper, into that of a relaxing one - which from a
deformation r burns K_j r²/2 (1 - exp(-2 K_j t / C_j)) in the time t - into impacts on rigid stops,
each M (1 - e²) v²/2, and into motion, springs and the height in a constant force.
The integrals are Gauss-Legendre sums, exact to rounding, over each phase by itself.
"""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given

import vibroimpact as vi
from properties.strategies import Motion, examples, motions, simulated
from reference.linear_phases import Mechanics, Phase, chatters, phases

CYCLES = 4


def stored(rig: vi.Oscillator, state: Mechanics) -> float:
    energy = rig.mass * state.v**2 + rig.isolator.stiffness * state.u**2
    for stop, deformation in ((rig.right, state.right), (rig.left, state.left)):
        energy += stop.stiffness * deformation**2 if isinstance(stop, vi.Bumper) else 0.0
    return float(energy) / 2 - rig.force * float(state.u)


def dissipated(rig: vi.Oscillator, phase: Phase) -> float:
    squares = float(phase.weights @ phase.motion.v**2)
    lost = rig.isolator.damping * squares
    sides = ((1, rig.right, phase.begin.right), (-1, rig.left, phase.begin.left))
    for side, stop, deformation in sides:
        if phase.then == ("impact", side):
            assert isinstance(stop, vi.RigidStop)
            lost += rig.mass * (1.0 - stop.restitution**2) * float(phase.end.v) ** 2 / 2
        if not isinstance(stop, vi.Bumper):
            continue
        if side in phase.touched:
            lost += stop.damping * squares
        elif stop.damping:
            decay = -2.0 * stop.stiffness * phase.length / stop.damping
            lost -= stop.stiffness * float(deformation) ** 2 / 2 * math.expm1(decay)
    return lost


def dashpots(rig: vi.Oscillator, phase: Phase) -> float:
    """All that the mass moves."""
    stops = {1: rig.right, -1: rig.left}
    pressed = (stops[side] for side in phase.touched)
    return rig.isolator.damping + sum(s.damping for s in pressed if isinstance(s, vi.Bumper))


def imbalance(motion: Motion) -> float:
    """Of the energy, as a share of what was stored and of all that the base gave and took."""
    data = simulated(motion, CYCLES)
    walk = list(phases(motion.oscillator, motion.excitation, data))
    return unbalanced(motion.oscillator, walk)


def unbalanced(rig: vi.Oscillator, walk: list[Phase]) -> float:
    """The same of a motion's phases."""
    work = turnover = lost = unknown = height = 0.0
    for phase in walk:
        if chatters(rig, phase):
            # What is left after the last impact listed goes into the others. Meanwhile the mass is
            # no farther from the stop than v t, and its work is that of the change of force.
            v, t = abs(float(phase.begin.v)), phase.length
            still = phase._replace(motion=phase.motion._replace(v=np.zeros_like(phase.base)))
            lost += rig.mass * v**2 / 2 + dissipated(rig, still)
            unknown += (
                rig.mass * float(np.ptp(phase.base)) * v * t + dashpots(rig, phase) * v**2 * t
            )
            continue
        power = -rig.mass * phase.base * phase.motion.v
        work += float(phase.weights @ power)
        turnover += float(phase.weights @ np.abs(power))
        height += abs(rig.force) * float(phase.weights @ np.abs(phase.motion.v))
        lost += dissipated(rig, phase)
    gained = stored(rig, walk[-1].end) - stored(rig, walk[0].begin)
    # A preload may store ten thousand times what is turned over: its rounding is that large.
    size = turnover + height + abs(stored(rig, walk[0].begin))
    return max(0.0, abs(work - lost - gained) - unknown) / size if size else 0.0


@examples(100)
@given(motions())
def test_work_is_dissipated_or_stored(motion: Motion) -> None:
    assert imbalance(motion) < 1e-12
