"""Random rigs for the property tests: everything between soft and stiff, free and heavily damped.

The rigs are drawn in dimensionless form and given a random mass, natural frequency and
amplitude, so that no test can rely on numbers near one.
"""

from __future__ import annotations

import math
import warnings
from typing import NamedTuple

import numpy as np
import xarray as xr
from hypothesis import Phase, assume, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import vibroimpact as vi
from reference.paper_signs import in_paper_signs
from samples import sample

SAMPLES = 8
"""A cycle, of `tame` motions."""


def examples(count: int) -> settings:
    """Always the same `count` examples, however slow the machine; a third in the daily run."""
    return settings(
        max_examples=sample(count, count // 3),
        derandomize=True,
        database=None,
        phases=(Phase.explicit, Phase.generate, Phase.shrink),  # explaining takes minutes
    )


class Motion(NamedTuple):
    """A rig, what shakes it, and where it starts."""

    oscillator: vi.Oscillator
    excitation: vi.Harmonic | vi.Periodic
    start: vi.State


def decades(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers spread evenly over powers of ten."""
    return st.floats(low, high).map(lambda x: 10.0**x)


def ratios(low: float, high: float) -> st.SearchStrategy[float]:
    """Damping ratios: exactly zero, or spread over decades."""
    return decades(low, high) | decades(low, high) | st.just(0.0)


@st.composite
def motions(
    draw: st.DrawFn,
    least_damping: float = 0.0,
    most_damping: float = math.inf,
    all_stops: bool = False,
    any_shaking: bool = False,
) -> Motion:
    """A random motion; the limits are of the isolator's damping ratio.

    With `all_stops`, preloaded bumpers and rigid stops are among the stops. With `any_shaking`,
    too, the base may be moved by a displacement, a force may act on the mass, either in several
    harmonics, a constant force, and the spring may be missing.
    """
    mass, omega = draw(decades(-2, 4)), draw(decades(-1, 2))
    ratio = draw(decades(-0.7, 0.7))
    damping = min(max(draw(ratios(-3, 0.5)), least_damping), most_damping)
    acceleration = draw(decades(-2, 2))
    stiffness = mass * omega**2
    swing = acceleration / omega**2 / math.hypot(1 - ratio**2, 2 * max(damping, 0.05) * ratio)

    def bumper() -> vi.Bumper:
        contact_stiffness = draw(decades(-2, 4))
        critical = 2.0 * math.sqrt(1.0 + contact_stiffness) * mass * omega
        gap = draw(st.floats(0.01, 1.2) | st.floats(0.01, 1.2) | st.just(0.0)) * swing
        return vi.Bumper(contact_stiffness * stiffness, draw(ratios(-3, 1)) * critical, gap)

    def stop() -> vi.Bumper | vi.RigidStop:
        kind = draw(st.sampled_from(["open", "preloaded", "rigid", "rigid"]))
        if kind == "open":
            return bumper()
        gap = draw(st.floats(-0.6, -0.01)) * swing
        if kind == "preloaded":
            return bumper().replace(gap=gap)
        gap = draw(st.floats(0.01, 1.2) | st.just(0.0) | st.just(gap / swing)) * swing
        e = draw(st.floats(0.05, 0.95) | st.floats(0.05, 0.95) | st.sampled_from([0.0, 1.0]))
        return vi.RigidStop(e, gap)

    make = stop if all_stops or any_shaking else bumper
    slack = any_shaking and draw(st.integers(0, 3)) == 0
    sides = "both" if slack else draw(st.sampled_from(["both", "both", "both", "right", "left"]))
    right = make() if sides != "left" else None
    left = make() if sides != "right" else None
    if isinstance(right, vi.RigidStop) and isinstance(left, vi.RigidStop):
        buffer = max(right.gap + left.gap, draw(st.floats(0.05, 1.0)) * swing)
        left = left.replace(gap=buffer - right.gap)
    force = draw(st.floats(-0.5, 0.5) | st.just(0.0)) * stiffness * swing if any_shaking else 0.0
    isolator = vi.Isolator(0.0 if slack else stiffness, 2.0 * damping * mass * omega)
    oscillator = vi.Oscillator(mass, isolator, right, left, force)
    # Within the gaps, or pressing a bumper.
    reach = draw(st.floats(-1.1, 1.1))
    side = right if reach > 0 else left
    u = reach * (swing if all_stops or any_shaking else side.gap if side else swing)
    if isinstance(right, vi.RigidStop):
        u = min(u, right.gap)
    if isinstance(left, vi.RigidStop):
        u = max(u, -left.gap)
    v = draw(st.floats(-1.0, 1.0)) * swing * omega * ratio
    phase = draw(st.floats(0.0, math.tau))
    excitation = vi.Harmonic(acceleration, ratio * omega / math.tau, phase)
    if any_shaking:
        excitation = draw(shakings(excitation, mass))
    return Motion(oscillator, excitation, vi.State(u, v))


@st.composite
def shakings(draw: st.DrawFn, plain: vi.Harmonic, mass: float) -> vi.Harmonic | vi.Periodic:
    """Another shaking of about the same size and frequency."""
    of = draw(st.sampled_from(["acceleration", "displacement", "force"]))
    unit = {"acceleration": 1.0, "displacement": plain.angular_frequency**-2, "force": mass}[of]
    size = plain.amplitude * unit
    if draw(st.booleans()):
        return vi.Harmonic(size, plain.frequency, plain.phase, of=of)
    shares = draw(st.lists(st.floats(0.1, 1.0) | st.just(0.0), min_size=1, max_size=4))
    sizes = [size, *(share * size / (n + 2) for n, share in enumerate(shares))]
    angles = [draw(st.floats(0.0, math.tau)) for _ in sizes]
    return vi.Periodic(plain.frequency, sizes, angles, plain.phase, of=of)


@st.composite
def recorded(draw: st.DrawFn) -> tuple[vi.Oscillator, vi.Record, vi.State]:
    """A rig as of `motions`, a rough record of about the same size, and a start."""
    rig, shaken, start = draw(motions(any_shaking=True))
    size = float(np.max(shaken.acceleration(rig.mass, shaken.angular_frequency)))
    count = draw(st.integers(2, 30))
    values = draw(st.lists(st.floats(-1.0, 1.0), min_size=count, max_size=count))
    step = draw(st.floats(0.05, 0.7)) * shaken.period
    return rig, vi.Record(3.0 * size * np.array(values), step), start


def simulated(motion: Motion, cycles: float, samples: int = 1) -> xr.Dataset:
    """The simulation, of those motions only that are not given up for chattering."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        data = vi.simulate(vi.Rig(*motion[:2]), cycles, motion.start, samples, max_events=1000)
    assume(data["status"] == 0)
    return data


def states(data: xr.Dataset) -> NDArray[np.float64]:
    """Samples of displacement, velocity, right and left deformation, as rows."""
    names = ("displacement", "velocity", "right_bumper", "left_bumper")
    signed = in_paper_signs(data)
    return np.stack([signed[name].values for name in names])


def distance(data: xr.Dataset, other: NDArray[np.float64]) -> float:
    """Largest difference of states, as a share of the largest length or velocity.

    `other` has as many samples as the simulation, or is one state: then it is its end.
    """
    rows = states(data)
    # A preloaded bumper may be pressed where the mass does not move.
    size, speed = np.abs(rows[[0, 2, 3]]).max(), np.abs(rows[1]).max()
    rows = rows if other.ndim == 2 else rows[:, -1]
    # A motion that is all rest has no speed, and a velocity of exactly 0 at any time.
    scale = np.maximum([size, speed, size, size], np.finfo(float).tiny)
    return float(np.max(np.abs(rows - other).T / scale))


def tame(motion: Motion, cycles: float) -> xr.Dataset:
    """The simulation, of those motions only that do not blow up small disturbances.

    Another start, amplitude or phase by a share of 1e-9 may change the motion by no more than
    1e-6: no grazing, no chaos. Rounding is then below 1e-12.
    """
    data = simulated(motion, cycles, SAMPLES)
    speed = float(np.abs(data["velocity"]).max())
    shaken, start = motion.excitation, motion.start
    for sign in (1e-9, -1e-9):
        other = Motion(
            motion.oscillator,
            shaken.replace(amplitude=shaken.amplitude * (1 + sign), phase=shaken.phase + sign),
            start.replace(velocity=start.velocity - sign * speed),
        )
        assume(distance(data, states(simulated(other, cycles, SAMPLES))) < 1e-6)
    return data
