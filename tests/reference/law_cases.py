"""Rigs of every law, whose state after 20 cycles from rest `law_states` knows to 25 digits.

Each touches both of its stops, and none is chaotic: a disturbance of 1e-12 grows by less than 1e2.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import vibroimpact as vi

CYCLES = 20
MASS, STIFFNESS, DAMPING = 550.0, 26.29e3, 1140.75
G = 9.80665


class Case(NamedTuple):
    """A rig, and what shakes it; from rest."""

    rig: vi.Oscillator
    shaken: vi.Harmonic | vi.Periodic | vi.Record


def case(
    isolator: Any, right: Any, left: Any, g: float, frequency: float, phase: float = 0.0
) -> Case:
    """With the published mass and one sine of a base acceleration in g."""
    return Case(vi.Oscillator(MASS, isolator, right, left), vi.Harmonic(g * G, frequency, phase))


def bumper(gap: float, stiffness: float = 510e3, damping: float = 900.0) -> vi.Bumper:
    """One of Kelvin and Voigt."""
    return vi.Bumper(stiffness, damping, gap)


def hertz(gap: float, stiffness: float = 2e7, **rest: Any) -> vi.PowerBumper:
    """A curved stop."""
    return vi.PowerBumper(stiffness, gap, **rest)


def pounding(gap: float, restitution: float = 0.6, stiffness: float = 2e7) -> vi.JankowskiBumper:
    """One of Jankowski's."""
    return vi.JankowskiBumper(stiffness, gap, restitution, MASS)


def wall(gap: float, restitution: float = 0.6) -> vi.RigidStop:
    """A rigid stop."""
    return vi.RigidStop(restitution, gap)


PLAIN = vi.Isolator(STIFFNESS, DAMPING)

LINEAR = {
    "linear, bumpers": case(PLAIN, bumper(7.5e-3), bumper(6e-3), 0.05, 1.3),
    "linear, power with dissipation": case(
        PLAIN, hertz(7.5e-3, dissipation=0.4), hertz(6e-3, 5e6, dissipation=1.5), 0.05, 1.3
    ),
    "linear, power by restitution": case(
        PLAIN, hertz(7e-3, restitution=0.7), hertz(6e-3, restitution=0.5), 0.05, 1.4
    ),
    "linear, flores and gonthier": case(
        PLAIN,
        hertz(7e-3, restitution=0.7, relation="flores"),
        hertz(6e-3, restitution=0.6, relation="gonthier"),
        0.05,
        1.2,
    ),
    "linear, hunt-crossley and lankarani-nikravesh": case(
        PLAIN,
        hertz(7e-3, restitution=0.7, relation="hunt-crossley"),
        hertz(6e-3, restitution=0.6, relation="lankarani-nikravesh"),
        0.05,
        1.2,
    ),
    "linear, elastic hertz and a spring": case(
        PLAIN, hertz(7e-3), vi.PowerBumper(3e5, 6e-3, 1.0), 0.05, 1.1
    ),
    "linear, powers 2.5 and 1.25": case(
        PLAIN,
        vi.PowerBumper(3e9, 7e-3, 2.5, restitution=0.6),
        vi.PowerBumper(3e6, 6e-3, 1.25, dissipation=0.5),
        0.05,
        1.3,
    ),
    "linear, power 2 that lets go": case(
        PLAIN,
        vi.PowerBumper(3e7, 7e-3, 2.0, dissipation=9.0),
        hertz(6e-3, dissipation=12.0),
        0.05,
        1.2,
    ),
    "linear, jankowski": case(PLAIN, pounding(7e-3), pounding(6e-3, 0.4), 0.05, 1.3),
    "linear, jankowski and a bumper": case(
        PLAIN, pounding(7e-3, 0.8, 5e7), bumper(6e-3), 0.05, 1.5
    ),
    "linear, jankowski and a wall": case(PLAIN, pounding(8e-3, 0.3, 4e6), wall(6e-3), 0.05, 1.1),
}
FRICTION = {
    "friction, bumpers": case(
        vi.FrictionIsolator(STIFFNESS, DAMPING, 60.0), bumper(7.5e-3), bumper(6e-3), 0.07, 1.3
    ),
    "friction, sticking": case(
        vi.FrictionIsolator(STIFFNESS, 0.0, 150.0),
        bumper(5e-3),
        bumper(4e-3, 3e5, 400.0),
        0.07,
        0.8,
    ),
    "friction, walls": case(
        vi.FrictionIsolator(STIFFNESS, DAMPING, 60.0), wall(6e-3, 0.7), wall(5e-3, 0.5), 0.07, 1.3
    ),
    "friction, power": case(
        vi.FrictionIsolator(STIFFNESS, 300.0, 120.0),
        hertz(6e-3, restitution=0.7),
        hertz(5e-3, dissipation=0.5),
        0.07,
        1.0,
        0.7,
    ),
    "friction, pendulum and jankowski": case(
        vi.FrictionIsolator.from_pendulum(MASS, 0.3, 0.02),
        pounding(7e-3),
        pounding(6e-3, 0.5),
        0.06,
        1.0,
    ),
    "friction, several harmonics": Case(
        vi.Oscillator(
            MASS,
            vi.FrictionIsolator(STIFFNESS, 200.0, 100.0),
            bumper(5e-3),
            hertz(5e-3, restitution=0.6),
        ),
        vi.Periodic(1.0, [0.5, 0.2, 0.15], [0.3, 0.0, -1.0]),
    ),
}
BILINEAR = {
    "bilinear, bumpers": case(
        vi.BilinearIsolator(60e3, 20e3, 150.0, 600.0), bumper(7.5e-3), bumper(6e-3), 0.06, 1.3
    ),
    "bilinear, walls": case(
        vi.BilinearIsolator(100e3, 15e3, 200.0, 900.0), wall(7e-3, 0.7), wall(6e-3, 0.5), 0.07, 1.2
    ),
    "bilinear, power": case(
        vi.BilinearIsolator(200e3, 20e3, 120.0, 0.0),
        hertz(7e-3, restitution=0.7),
        hertz(6e-3, dissipation=0.5),
        0.06,
        1.4,
        -0.5,
    ),
    "bilinear, jankowski": case(
        vi.BilinearIsolator(80e3, 0.0, 200.0, 500.0), pounding(7e-3), pounding(6e-3, 0.4), 0.07, 1.0
    ),
}
POLYNOMIAL = {
    "polynomial, hardening, bumpers": case(
        vi.PolynomialIsolator(20e3, DAMPING, 8e7), bumper(7.5e-3), bumper(6e-3), 0.06, 1.4
    ),
    "polynomial, softening, bumpers": case(
        vi.PolynomialIsolator(30e3, DAMPING, -4e7, 5e10), bumper(7.5e-3), bumper(6e-3), 0.05, 1.1
    ),
    "polynomial, power": case(
        vi.PolynomialIsolator(10e3, 900.0, 2e8, 1e11),
        hertz(7e-3, restitution=0.7),
        hertz(6e-3, dissipation=0.5),
        0.07,
        1.3,
    ),
    "polynomial, walls": case(
        vi.PolynomialIsolator(25e3, DAMPING, 5e7), wall(7e-3, 0.7), wall(6e-3, 0.5), 0.06, 1.3
    ),
    "polynomial, jankowski": case(
        vi.PolynomialIsolator(0.0, 800.0, 4e8), pounding(9e-3), pounding(8e-3, 0.5), 0.05, 1.1
    ),
}
BOUC_WEN = {
    "bouc-wen, bumpers": case(
        vi.BoucWenIsolator(60e3, 20e3, 150.0, 600.0), bumper(7.5e-3), bumper(6e-3), 0.06, 1.3
    ),
    "bouc-wen, n = 2, power": case(
        vi.BoucWenIsolator(80e3, 18e3, 150.0, 600.0, 2),
        hertz(7e-3, restitution=0.7),
        hertz(6e-3, dissipation=0.5),
        0.06,
        1.3,
    ),
    "bouc-wen, n = 3, walls": case(
        vi.BoucWenIsolator(80e3, 18e3, 150.0, 900.0, 3, 0.9, -0.2),
        wall(7e-3, 0.7),
        wall(6e-3, 0.5),
        0.06,
        1.2,
    ),
    "bouc-wen, n = 5, jankowski": case(
        vi.BoucWenIsolator(80e3, 10e3, 200.0, 400.0, 5, 0.3, 0.7),
        pounding(7e-3),
        pounding(6e-3, 0.5),
        0.07,
        1.1,
    ),
    "bouc-wen, n = 10, power": case(
        vi.BoucWenIsolator(80e3, 18e3, 200.0, 600.0, 10, 0.8, 0.2),
        hertz(7e-3, restitution=0.7),
        hertz(6e-3, dissipation=0.5),
        0.06,
        1.3,
    ),
    "bouc-wen, n = 50, bumpers": case(
        vi.BoucWenIsolator(80e3, 18e3, 300.0, 600.0, 50), bumper(7e-3), bumper(6e-3), 0.07, 1.3
    ),
    "bouc-wen, n = 100, walls": case(
        vi.BoucWenIsolator(80e3, 18e3, 300.0, 600.0, 100, 0.7, 0.3),
        wall(7e-3, 0.7),
        wall(6e-3, 0.5),
        0.07,
        1.2,
    ),
}
EXPONENTIAL = {
    "exponential, hardening, bumpers": case(
        vi.ExponentialIsolator(100e3, 18e3, 300.0, 500.0, 150.0, 20.0),
        bumper(7.5e-3),
        bumper(6e-3),
        0.06,
        1.3,
    ),
    "exponential, softening, power": case(
        vi.ExponentialIsolator(80e3, 25e3, 250.0, 800.0, -100.0, 5.0),
        hertz(7e-3, restitution=0.7),
        hertz(6e-3, dissipation=0.5),
        0.06,
        1.2,
    ),
    "exponential, walls": case(
        vi.ExponentialIsolator(90e3, 20e3, 400.0, 700.0),
        wall(7e-3, 0.7),
        wall(6e-3, 0.5),
        0.06,
        1.3,
    ),
    "exponential, jankowski": case(
        vi.ExponentialIsolator(120e3, 15e3, 200.0, 300.0, 100.0, 30.0),
        pounding(7e-3),
        pounding(6e-3, 0.5),
        0.07,
        1.2,
    ),
}
DRAG = {
    "drag 2, bumpers": case(
        vi.Isolator(STIFFNESS, 15e3, 2.0), bumper(7.5e-3), bumper(6e-3), 0.05, 1.3
    ),
    "drag 2, power": case(
        vi.Isolator(STIFFNESS, 12e3, 2.0),
        hertz(7e-3, restitution=0.7),
        hertz(6e-3, dissipation=0.5),
        0.05,
        1.2,
    ),
    "drag 0.5, bumpers": case(
        vi.Isolator(STIFFNESS, 250.0, 0.5), bumper(7.5e-3), bumper(6e-3), 0.06, 1.3
    ),
    "drag 0.5, power": case(
        vi.Isolator(STIFFNESS, 200.0, 0.5),
        hertz(7e-3, restitution=0.7),
        pounding(6e-3, 0.5),
        0.06,
        1.2,
        0.4,
    ),
    "drag 0.5, walls": case(
        vi.Isolator(STIFFNESS, 250.0, 0.5), wall(7e-3, 0.7), wall(6e-3, 0.5), 0.06, 1.2, 0.4
    ),
    "drag 0.25, bumpers": case(
        vi.Isolator(STIFFNESS, 120.0, 0.25), bumper(7.5e-3), bumper(6e-3), 0.06, 1.3, 1.0
    ),
    "drag 1.5, a wall and a bumper": case(
        vi.Isolator(STIFFNESS, 4e3, 1.5), wall(7e-3, 0.7), bumper(6e-3), 0.05, 1.2
    ),
    "drag 0.5 and friction": case(
        vi.FrictionIsolator(STIFFNESS, 150.0, 60.0, 0.5), bumper(6e-3), bumper(5e-3), 0.07, 1.2
    ),
    "drag 0.5 and bouc-wen": case(
        vi.BoucWenIsolator(60e3, 20e3, 150.0, 120.0, damping_exponent=0.5),
        bumper(7e-3),
        hertz(6e-3, restitution=0.6),
        0.06,
        1.3,
    ),
    "drag 2 and bilinear": case(
        vi.BilinearIsolator(60e3, 20e3, 150.0, 8e3, 2.0), bumper(7e-3), pounding(6e-3), 0.06, 1.2
    ),
}
CASES = {**LINEAR, **FRICTION, **BILINEAR, **POLYNOMIAL, **BOUC_WEN, **EXPONENTIAL, **DRAG}
