"""Several masses: closed forms, other programs, and what averaging makes of an energy sink."""

from __future__ import annotations

import cmath
import itertools
import math
import warnings
from functools import cache

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.optimize import brentq

import vibroimpact as vi
from literature.comparisons.comparison import Comparison


def limits(branch: xr.Dataset, kind: str) -> list[float]:
    """The values of the bifurcations of a kind, ascending."""
    return sorted(branch["bifurcation_value"].values[branch["bifurcation_kind"].values == kind])


# --- a ball in a cavity whose walls at ±1 move by A sin t


@cache
def cavity() -> xr.Dataset:
    """Its branch over A."""
    wall = vi.RigidStop(0.6, 1.0)
    ball = vi.Assembly(
        {"ball": 0.3},
        stops={"right": vi.Link("ball", "ground", wall), "left": vi.Link("ground", "ball", wall)},
        units="none",
    )
    rig = vi.Rig(ball, vi.Harmonic(0.4, 1.0 / math.tau, of="displacement"))
    start = vi.State(displacement={"ball": 0.9}, velocity={"ball": 0.6})
    settled = vi.simulate(rig, 300, start, samples=0)
    return vi.branch(rig, vi.orbit(rig, settled), vary={"amplitude": (0.12, 0.9)})


# --- an oscillator with a loose ball


def damper_speed() -> float:
    """V of its ball at ζ = 0.01, μ = 0.05, e = 0.75, d = 30."""
    wall = vi.RigidStop(0.75, 15.0)
    system = vi.Assembly(
        {"host": 1.0, "ball": 0.05},
        links={"spring": vi.Link("ground", "host", vi.Isolator(1.0, 0.02))},
        stops={"right": vi.Link("ball", "host", wall), "left": vi.Link("host", "ball", wall)},
        units="none",
    )
    orbit = vi.orbit(vi.Rig(system, vi.Harmonic(1.0, 1.0 / math.tau, of="force", on="host")))
    right = orbit["event_stop"].values == "right"
    return float(orbit["event_velocity"].sel(mass="ball").values[right][0])


# --- PWSDDE-cont, `impduff_def.m` without its cubic terms


def absorber() -> xr.Dataset:
    """The orbit at ω = 1.5 of a host of unit mass, and a smaller one between stops of it at ±1."""
    mu, r, zeta, xi, phi = 0.05, 0.9, 0.02, 0.127, 0.952
    stop = vi.RigidStop(r, 1.0)
    system = vi.Assembly(
        {"one": 1.0, "two": mu},
        links={
            "base": vi.Link("ground", "one", vi.Isolator(1.0, 2.0 * zeta)),
            "hung": vi.Link("one", "two", vi.Isolator(mu * phi**2, 2.0 * mu * xi)),
        },
        stops={"up": vi.Link("two", "one", stop), "down": vi.Link("one", "two", stop)},
        units="none",
    )
    force = vi.Harmonic(1.0, 1.5 / math.tau, math.pi / 2, of="force", on="one")
    rig = vi.Rig(system, force)
    return vi.orbit(rig, vi.simulate(rig, 600, samples=0))


def absorber_place() -> float:
    """x₁ at the impact at +1."""
    orbit = absorber()
    up = orbit["event_stop"].values == "up"
    return float(orbit["event_displacement"].sel(mass="one").values[up][0])


# --- NLvib's example 03


def rig_at_one_sided_spring() -> vi.Rig:
    """Two masses, the first one at a one-sided spring, the second one driven at Ω = 0.8."""
    link = vi.Isolator(1.0, 0.03)
    system = vi.Assembly(
        {"one": 1.0, "two": 1.0},
        links={"between": vi.Link("one", "two", link), "base": vi.Link("ground", "two", link)},
        stops={"spring": vi.Link("one", "ground", vi.Bumper(100.0, 0.0, 1.0))},
        units="none",
    )
    return vi.Rig(system, vi.Harmonic(0.1, 0.8 / math.tau, math.pi / 2, of="force", on="two"))


@cache
def one_sided_spring() -> xr.Dataset:
    """The branch over Ω from 0.6 to 0.8."""
    return vi.branch(
        rig_at_one_sided_spring(), vary={"frequency": (0.6 / math.tau, 0.8 / math.tau)}
    )


# --- three equal masses that touch, hit with the speed 1


def last_of_three() -> float:
    """The speed of the last one, with a one-sided linear spring between each two."""
    law = vi.PowerBumper(1e7, 0.0, exponent=1.0)
    system = vi.Assembly(
        {"a": 1.0, "b": 1.0, "c": 1.0},
        stops={"ab": vi.Link("a", "b", law), "bc": vi.Link("b", "c", law)},
    )
    rig = vi.Rig(system, vi.Harmonic(1e-300, 1.0))
    start = vi.State(velocity={"a": 1.0})
    return float(vi.simulate(rig, 1, start)["velocity"].sel(mass="c")[-1])


# --- Siconos: ten beads that fall, touching, and rebound without loss

BEADS_END, RADIUS, HEIGHT, GRAVITY = 0.493, 0.005, 0.05, 9.81
LOWEST_BEAD = ("0.01602081295401625", "-0.8745122353873587")
"""q₁ (m) and v₁ (m/s) at the end."""


@cache
def beads() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The positions of all beads less those in the column at rest, and their velocities."""
    names = [f"bead_{i}" for i in range(1, 11)]
    mass = 4.0 / 3.0 * math.pi * RADIUS**3 * 7780.0
    touching = vi.RigidStop(1.0, 0.0)
    stops = {"floor": vi.Link("ground", names[0], vi.RigidStop(1.0, HEIGHT))} | {
        f"above_{left}": vi.Link(left, right, touching) for left, right in itertools.pairwise(names)
    }
    weights = dict.fromkeys(names, -mass * GRAVITY)
    column = vi.Assembly(dict.fromkeys(names, mass), stops=stops, forces=weights)
    still = vi.State(displacement=dict.fromkeys(names, 0.0))
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", ".*at the same instant", RuntimeWarning)
        end = vi.simulate(vi.Rig(column, vi.Harmonic(0.0, 1.0 / BEADS_END)), 1, still)
    u, v = (end[name].isel(time=-1).values for name in ("displacement", "velocity"))
    return HEIGHT + RADIUS + u, v


# --- Siconos: a bar that hits a wall

NODES, BAR_SPEED, BAR_GAP, BAR_STEP = 100, 0.1, 5e-5, 2e-6
MODULUS, SECTION, DENSITY = 210e9, 3.14e-4, 7800.0


def bar_matrices(consistent: bool = True) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Mass and stiffness as its source has them: 99 elements, each of a hundredth of a metre."""
    part = 1.0 / NODES
    mass, stiffness = np.zeros((NODES, NODES)), np.zeros((NODES, NODES))
    element = np.array([[2.0, 1.0], [1.0, 2.0]]) / 6.0 if consistent else np.eye(2) / 2.0
    for i in range(NODES - 1):
        mass[i : i + 2, i : i + 2] += element
        stiffness[i : i + 2, i : i + 2] += np.array([[1.0, -1.0], [-1.0, 1.0]])
    return mass * DENSITY * SECTION * part, stiffness * MODULUS * SECTION / part


@cache
def bar(consistent: bool = True, pushed: float = 1e-7) -> tuple[float, float, float]:
    """First and last time (s) of contact, and the impulse (N s).

    The force of 0.1 µN on its end decides what rounding would: the reaction begins at 0.
    """
    mass, stiffness = bar_matrices(consistent)
    system = vi.Assembly.from_matrices(
        mass,
        None,
        stiffness,
        stops={"wall": vi.Link("ground", "dof_1", vi.RigidStop(0.0, BAR_GAP))},
        forces={"dof_1": -pushed} if pushed else None,
    )
    start = vi.State(velocity=dict.fromkeys(system.names, -BAR_SPEED))
    motion = vi.simulate(vi.Rig(system, vi.Harmonic(0.0, 1.0 / 0.0015)), 1, start)
    times = motion["event_time"].values
    speeds = motion["velocity"].isel(time=-1).values
    return float(times[0]), float(times[-1]), float((mass @ (speeds + BAR_SPEED)).sum())


# --- an energy sink, one sector of a chain that moves in unison

SINK_RATIO, SINK_RESTITUTION, SINK_DAMPING = 0.02, 0.8, 1e-3
SINK_SCALE = 0.25
"""Half the clearance over the amplitude of the host at resonance, with the ball held fast."""


def averaged_sink(frequency: float, ratio: float = SINK_RATIO) -> complex:
    """The larger amplitude of the host over half the clearance, with its phase: by averaging.

    The damping ratio is in proportion to that of the masses.
    """
    damping = SINK_DAMPING * ratio / SINK_RATIO
    loss = 2.0 / math.pi * (1.0 - SINK_RESTITUTION) / (1.0 + SINK_RESTITUTION)
    stiffness = 1.0 - (1.0 - ratio) * frequency**2 + 2j * damping * frequency

    def force(size: float) -> complex:
        """Over half the clearance, of a phase in which the host is at the real `size`."""
        swing = (1.0 + math.sqrt((1.0 + loss**2) * size**2 - loss**2)) / (1.0 + loss**2)
        late = (swing - 1.0 - 1j * loss * swing) / size
        return stiffness * size - 8.0 * ratio * frequency**2 * swing * late / math.pi**2

    def off(size: float) -> float:
        return 2.0 * damping / abs(force(size)) - SINK_SCALE

    sizes = np.linspace(0.4, 5.0, 1000)
    low = max(i for i in range(len(sizes) - 1) if off(sizes[i]) > 0.0 >= off(sizes[i + 1]))
    size = float(brentq(off, sizes[low], sizes[low + 1], xtol=1e-14))
    return cmath.rect(size, -cmath.phase(force(size)))


def exact_sink(frequency: float, ratio: float = SINK_RATIO) -> float:
    """The amplitude of the host's first harmonic over half the clearance, and it is stable."""
    damping = SINK_DAMPING * ratio / SINK_RATIO
    gap = SINK_SCALE / (2.0 * damping)
    wall = vi.RigidStop(SINK_RESTITUTION, gap)
    system = vi.Assembly(
        {"host": 1.0 - ratio, "ball": ratio},
        links={"spring": vi.Link("ground", "host", vi.Isolator(1.0, 2.0 * damping))},
        stops={"right": vi.Link("ball", "host", wall), "left": vi.Link("host", "ball", wall)},
        units="none",
    )
    force = vi.Harmonic(1.0, frequency / math.tau, math.pi / 2, of="force", on="host")
    rig, guess = vi.Rig(system, force), averaged_sink(frequency, ratio) * gap
    loss = 2.0 / math.pi * (1.0 - SINK_RESTITUTION) / (1.0 + SINK_RESTITUTION)
    size = abs(guess) / gap
    swing = (1.0 + math.sqrt((1.0 + loss**2) * size**2 - loss**2)) / (1.0 + loss**2)
    ball = cmath.phase(guess) + cmath.phase((swing - 1.0 - 1j * loss * swing) / size)
    start = vi.State(
        displacement={
            "host": guess.real,
            "ball": 2.0 * swing * gap * math.asin(math.cos(ball)) / math.pi,
        },
        velocity={
            "host": (1j * frequency * guess).real,
            "ball": -math.copysign(2.0 * frequency * swing * gap / math.pi, math.sin(ball)),
        },
    )
    orbit = vi.orbit(rig, start)
    assert int(orbit["stable"]) == 1
    assert orbit.sizes["event"] == 2
    motion = vi.simulate(rig, 1, orbit["initial_state"], samples=1024)
    host = motion["displacement"].sel(mass="host").values[:1024]
    return float(2.0 * abs(np.fft.rfft(host)[1]) / len(host) / gap)


SINK_FREQUENCY = 0.985
FORMULA = "closed form"
COMPARISONS = [
    Comparison(
        FORMULA,
        "ball in a shaken cavity: A of the fold",
        "0.157177",
        lambda: limits(cavity(), "fold")[0],
    ),
    Comparison(
        FORMULA,
        "its symmetry breaking: A",
        "0.732140",
        lambda: limits(cavity(), "symmetry breaking")[0],
    ),
    Comparison(FORMULA, "impact damper: V", "14.78340654", damper_speed),
    Comparison(
        FORMULA,
        "three touching masses: v₃",
        "0.9800321",
        last_of_three,
    ),
    Comparison("PWSDDE-cont", "absorber: x₁ at impact", "0.63811168", absorber_place),
    Comparison(
        "NLvib",
        "one-sided spring: Ω of Neimark–Sacker",
        "0.62",
        lambda: math.tau * limits(one_sided_spring(), "Neimark-Sacker")[0],
    ),
    Comparison(
        "NLvib",
        "its period doubling: Ω",
        "0.74",
        lambda: math.tau * limits(one_sided_spring(), "period doubling")[0],
    ),
    Comparison("Siconos", "beads: q₁ (m)", LOWEST_BEAD[0], lambda: float(beads()[0][0]), 1e-12),
    Comparison(
        "Siconos",
        "bar: end of contact (s)",
        "8.8801e-4",
        lambda: bar()[1],
        differs="theirs converges to ours with smaller steps",
    ),
    Comparison(
        "Weidemann et al. 2025",
        "energy sink: amplitude",
        lambda: abs(averaged_sink(SINK_FREQUENCY)),
        lambda: exact_sink(SINK_FREQUENCY),
        1e-9,
        differs="averaging; proportional to ε",
    ),
]
