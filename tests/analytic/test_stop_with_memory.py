"""A stop that remembers: a light pad on links, against the equations of a pad without mass."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import vibroimpact as vi

K, C, GAP = 100.0, 1.0, 0.02
DRIVE = vi.Harmonic(3.0, 2.0)
CYCLES = 6
STIFF, RELAXING, DASHPOT = 1500.0, 800.0, 40.0
"""A standard linear solid: a spring beside a spring and a dashpot in series."""


def padded(mass: float, links: dict, pads: dict) -> float:
    """Displacement after some cycles with a light pad of this mass behind a rigid stop."""
    system = vi.Assembly(
        masses={"body": 1.0, **pads},
        links={"spring": vi.Link("ground", "body", vi.Isolator(K, C)), **links},
        stops={"face": vi.Link("body", "pad", vi.RigidStop(0.0, GAP))},
    )
    motion = vi.simulate(vi.Rig(system, DRIVE), CYCLES)
    return float(motion["displacement"].sel(mass="body")[-1])


def with_bumper(mass: float) -> float:
    return padded(
        mass, {"rubber": vi.Link("ground", "pad", vi.Isolator(2000.0, 5.0))}, {"pad": mass}
    )


def with_solid(mass: float) -> float:
    links = {
        "spring_of_pad": vi.Link("ground", "pad", vi.Isolator(STIFF, 0.0)),
        "series": vi.Link("inner", "pad", vi.Isolator(RELAXING, 0.0)),
        "dashpot": vi.Link("ground", "inner", vi.Isolator(0.0, DASHPOT)),
    }
    return padded(mass, links, {"pad": mass, "inner": mass})


def solid_without_mass() -> float:
    """The same by DOP853 from event to event; y is the dashpot's end."""
    amplitude, omega = DRIVE.amplitude, 2.0 * np.pi * DRIVE.frequency

    def push(u: float, y: float) -> float:
        return STIFF * (u - GAP) + RELAXING * (u - GAP - y)

    def clearance(t, state, touching):
        u, _, y = state
        return GAP + RELAXING * y / (STIFF + RELAXING) - u

    def pushed(t, state, touching):
        return push(state[0], state[2])

    for event in (clearance, pushed):
        event.terminal, event.direction = True, -1.0

    def rates(t, state, touching):
        u, v, y = state
        force = push(u, y) if touching else 0.0
        depth = u - GAP if touching else RELAXING * y / (STIFF + RELAXING)
        acceleration = -amplitude * np.sin(omega * t) - K * u - C * v - force
        return v, acceleration, RELAXING * (depth - y) / DASHPOT

    t, state, touching = 0.0, np.zeros(3), False
    end = CYCLES / DRIVE.frequency
    while t < end:
        done = solve_ivp(
            rates, (t, end), state, "DOP853", args=(touching,), rtol=1e-12, atol=1e-14,
            events=pushed if touching else clearance,
        )  # fmt: skip
        t, state, touching = done.t[-1], done.y[:, -1], not touching
    return float(state[0])


def bumper_without_mass() -> float:
    system = vi.Oscillator(1.0, vi.Isolator(K, C), right=vi.Bumper(2000.0, 5.0, GAP))
    return float(vi.simulate(vi.Rig(system, DRIVE), CYCLES)["displacement"][-1])


@pytest.mark.parametrize("mass", [1e-3, 1e-4, 1e-5])
@pytest.mark.parametrize(
    ("light", "massless"), [(with_bumper, bumper_without_mass), (with_solid, solid_without_mass)]
)
def test_the_difference_is_proportional_to_the_mass_of_the_pad(light, massless, mass) -> None:
    assert 0.02 * mass < light(mass) - massless() < 0.04 * mass


def test_a_memory_of_its_own_is_that_of_a_pad_without_mass() -> None:
    stop = vi.ZenerBumper(STIFF, RELAXING, DASHPOT, GAP)
    system = vi.Assembly(
        masses={"body": 1.0},
        links={"spring": vi.Link("ground", "body", vi.Isolator(K, C))},
        stops={"face": vi.Link("body", "ground", stop)},
    )
    motion = vi.simulate(vi.Rig(system, DRIVE), CYCLES)
    assert float(motion["displacement"].sel(mass="body")[-1]) == pytest.approx(
        solid_without_mass(), rel=0.0, abs=1e-12
    )
