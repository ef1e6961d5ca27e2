"""A contact force that dips to zero: the mass leaves if it gets there, and stays if it does not.

Within one contact the motion is linear, so that a dip of the force to a chosen depth at a chosen
time can be made: the state there follows from the force and from its slope, zero; and the start
from that state by going back in time.
"""

from __future__ import annotations

import math

from hypothesis import assume, given
from hypothesis import strategies as st
from mpmath import matrix, mp, mpf

import vibroimpact as vi
from properties.strategies import decades, examples

AMPLITUDE, FREQUENCY, ISOLATOR_DAMPING = 1.0, 0.1, 0.06  # with M = K = 1
ROUNDING = 200 * 2.0**-52
OMEGA = math.tau * FREQUENCY


class Contact:
    """A contact as z′ = `flow` z and force = `force` z, z = (deformation, rate, sin, cos, 1).

    The base acts towards the bumper at sin θ > 0.
    """

    def __init__(self, bumper: vi.Bumper) -> None:
        k, c = 1 + mpf(bumper.stiffness), mpf(ISOLATOR_DAMPING) + mpf(bumper.damping)
        self.flow = matrix(5, 5)
        self.flow[0, 1] = 1
        self.flow[1, 0], self.flow[1, 1], self.flow[1, 2] = -k, -c, AMPLITUDE
        self.flow[1, 4] = -mpf(bumper.gap)
        self.flow[2, 3], self.flow[3, 2] = OMEGA, -OMEGA
        self.force = matrix([[bumper.stiffness, bumper.damping, 0, 0, 0]])

    def bottom(self, value: mpf, angle: float) -> matrix:
        """The state in which the force is `value` and its slope zero."""
        slope = self.force * self.flow
        base = matrix([0, 0, mp.sin(angle), mp.cos(angle), 1])
        both = matrix([[self.force[0], self.force[1]], [slope[0], slope[1]]])
        x, v = mp.lu_solve(both, matrix([value, -(slope * base)[0]]))
        return base + matrix([x, v, 0, 0, 0])

    def walk(self, z: matrix, t: float, steps: int = 20) -> list[matrix]:
        """The states at the beginning and after each of some equal steps of the time t."""
        step = mp.expm(self.flow * (mpf(t) / steps))
        states = [z]
        for _ in range(steps):
            states.append(step * states[-1])
        return states

    def pressing(self, z: matrix) -> float:
        return float((self.force * z)[0])


@examples(100)
@given(
    stiffness=decades(-1, 4),
    damping_ratio=st.just(0.0) | decades(-3, -0.5),
    gap=st.floats(0.0, 0.5),
    depth=decades(-13, -2),
    turns=st.floats(0.1, 3.0),
    angle=st.floats(0.6 * math.pi, 0.9 * math.pi),
    side=st.sampled_from([1, -1]),
)
def test_the_force_dips_to_zero(
    stiffness: float,
    damping_ratio: float,
    gap: float,
    depth: float,
    turns: float,
    angle: float,
    side: int,
) -> None:
    """After `turns` of the contact's own vibration, when the base is at `angle`."""
    quick = math.sqrt(1.0 + stiffness)
    bumper = vi.Bumper(stiffness, 2.0 * damping_ratio * quick, gap)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, ISOLATOR_DAMPING), bumper, bumper)
    fall = turns * math.tau / quick
    with mp.workdps(40):
        contact = Contact(bumper)
        bend = contact.force * contact.flow * contact.flow
        assume(float((bend * contact.bottom(mpf(0), angle))[0]) > 0.0)
        # Fine enough that no second dip hides between two states: 1/2 (2π 3/400/2)² < 1e-3.
        back = contact.walk(contact.bottom(mpf(0), angle), -fall, 400)
        forces = [contact.pressing(z) for z in back]
        scale = max(forces)
        assume(scale > 0.0)
        assume(min(forces[20:]) > 1e-3 * scale)
        for value in (depth * scale, -depth * scale):
            begin = contact.walk(contact.bottom(mpf(value), angle), -fall)[-1]
            x, v, sine, cosine, _ = (float(number) for number in begin)
            assume(x >= 0.0)  # a bumper is never longer than at rest
            # Towards the right the base acts where its acceleration is negative.
            phase = math.atan2(-side * sine, -side * cosine)
            faces = {"deformation": {"right" if side == 1 else "left": x}}
            start = vi.State(side * (gap + x), side * v, contact=side, phase=phase, **faces)
            shaken = vi.Harmonic(AMPLITUDE, FREQUENCY)
            data = vi.simulate(vi.Rig(rig, shaken), fall * FREQUENCY, start, samples=1)
            if value > 0.0:
                assert not data.sizes["event"]
                continue
            assert data.sizes["event"]
            assert data["event_contact"].values[0] == 0
            left = float(data["event_time"][0])
            forces = [contact.pressing(z) for z in contact.walk(begin, left)]
            assert abs(forces[-1]) < ROUNDING * scale
            assert min(forces[:-1]) > 0.0
