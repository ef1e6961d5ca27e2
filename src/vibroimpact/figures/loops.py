"""Force of one law over displacement, for a prescribed motion.

These functions integrate the laws step by step in plain numpy, independently of the engine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike, NDArray

from vibroimpact.errors import InputError, shown
from vibroimpact.figures.legends import fit_labels
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.figures.own_units import without_unit
from vibroimpact.figures.style import MOTIONS
from vibroimpact.model import (
    AnyIsolator,
    BilinearIsolator,
    BoucWenIsolator,
    Bumper,
    ExponentialIsolator,
    FrictionIsolator,
    JankowskiBumper,
    Law,
    PowerBumper,
    to_si,
)
from vibroimpact.model.oscillator import Units
from vibroimpact.model.quantities import FREQUENCY, LENGTH
from vibroimpact.model.stated_units import has_unit
from vibroimpact.model.written_units import NONE, SI

_Array = NDArray[np.float64]

_SAMPLES = 2000
"""Number of points in one cycle."""
_STEPS = 8
"""Number of Runge-Kutta steps between two points."""


def force_loop(
    law: AnyIsolator | Bumper | PowerBumper | JankowskiBumper,
    amplitude: float | str,
    frequency: float | str = 0.0,
    ax: Axes | None = None,
    *,
    title: str | None = None,
    units: Units = SI,
) -> Axes:
    """Draw the force of an isolator or of a stop over its displacement.

    An isolator is moved from rest to the amplitude, and then through one cycle of a sine. A stop is
    compressed and released along half a sine, up to the amplitude.

    Parameters
    ----------
    law
        The isolator or the stop. A rigid stop is not accepted, because it has no displacement.
    amplitude
        Largest displacement of the isolator or deformation of the stop, in m, greater than 0; or
        text with units.
    frequency
        Frequency of the sine (Hz). At the frequency 0 the motion is so slow that dashpots have no
        force. If a stop has a coefficient of restitution, its impact speed is the velocity of the
        sine at the start of the contact.
    ax
        Axes to draw on. Default: a new figure.
    title
        Title of the figure, if a new one is made.
    units
        ``"none"`` if the numbers of the law are dimensionless, because a law does not state this.
        The axes then have no units. Default: ``"SI"``.

    Raises
    ------
    InputError
        If the law, the amplitude or the frequency is invalid, or if the amplitude has a unit
        although ``units`` is ``"none"``.
    """
    if units not in (SI, NONE):
        raise InputError(f"units: {shown(units)} is unknown; 'SI' or 'none' is accepted")
    if units == NONE and has_unit(amplitude):
        raise InputError(
            f'amplitude: {shown(amplitude)} has a unit, but units is "none"; pass a number without '
            "a unit, or remove units"
        )
    size = to_si(amplitude, LENGTH, "amplitude", above=0.0)
    omega = math.tau * to_si(frequency, FREQUENCY, "frequency", minimum=0.0)
    ax = axes_or_new(ax, (5.2, 4.0), title)
    if isinstance(law, Bumper | PowerBumper | JankowskiBumper) or (
        isinstance(law, Law) and law.is_stop
    ):
        u, v, _ = _sine(size, omega, 0.5)
        force, what = contact_force(law, u, v), "deformation (mm)"
    else:
        u, v, direction = _sine(size, omega, 1.25)
        force, what = isolator_force(law, u, direction, v), "displacement $u$ (mm)"
    mm, kilonewtons = (1.0, 1.0) if units == NONE else (1e3, 1e-3)
    ax.plot(mm * u, kilonewtons * force, color=MOTIONS[0].colour, linewidth=1.3)
    for zero in (ax.axhline, ax.axvline):
        zero(0.0, color="0.7", linewidth=0.6, zorder=0)
    force_label = "force (kN)"
    ax.set_xlabel(without_unit(what) if units == NONE else what)
    ax.set_ylabel(without_unit(force_label) if units == NONE else force_label)
    fit_labels(ax)
    return ax


def _sine(size: float, omega: float, turns: float) -> tuple[_Array, _Array, _Array]:
    """Return displacement, velocity and direction of a sine. At frequency 0 the velocity is 0."""
    phase = np.linspace(0.0, turns, _SAMPLES + 1) * math.tau
    return size * np.sin(phase), size * omega * np.cos(phase), np.cos(phase)


def isolator_force(
    law: AnyIsolator, displacement: ArrayLike, direction: ArrayLike, velocity: ArrayLike = 0.0
) -> _Array:
    """Return the force of an isolator along a path that starts at rest.

    Parameters
    ----------
    law
        The isolator.
    displacement
        Displacements along the path in m, starting with 0. They must be so dense that the motion
        reverses only at samples.
    direction
        Direction of the motion at each sample, of which only the sign is used.
    velocity
        Velocity in m/s, which determines the force of the dashpot.

    Returns
    -------
    numpy.ndarray
        Force in N at each sample.
    """
    u = np.asarray(displacement, dtype=np.float64)
    v = np.broadcast_to(np.asarray(velocity, dtype=np.float64), u.shape)
    if isinstance(law, Law):
        return np.array([law.read.value(*one) for one in zip(u.tolist(), v.tolist(), strict=True)])
    viscous = law.damping * np.abs(v) ** law.damping_exponent * np.sign(v)
    return np.fromiter(_restoring(law, u, np.sign(direction)), np.float64, len(u)) + viscous


def _restoring(law: AnyIsolator, u: _Array, direction: _Array) -> Iterator[float]:
    """Return the force without the dashpot at each sample."""
    z = last = 0.0
    for here, way in zip(u.tolist(), np.asarray(direction).tolist(), strict=True):
        step, last = here - last, here
        if isinstance(law, FrictionIsolator):
            yield law.stiffness * here + way * law.friction
        elif isinstance(law, BilinearIsolator):
            limit = law.yield_displacement
            z = max(-limit, min(limit, z + step))
            plastic = law.elastic_stiffness - law.post_yield_stiffness
            yield law.post_yield_stiffness * here + plastic * z
        elif isinstance(law, BoucWenIsolator):
            z = _moved_on(law, z, step)
            plastic = law.elastic_stiffness - law.post_yield_stiffness
            yield law.post_yield_stiffness * here + plastic * z
        elif isinstance(law, ExponentialIsolator):
            bound = math.copysign(law.hysteretic_force, step)
            z = bound + (z - bound) * math.exp(-law.decay * abs(step))
            yield law.elastic_force(here) + z
        else:
            yield law.static_force(here)


def _moved_on(law: BoucWenIsolator, z: float, step: float) -> float:
    """Return the hysteretic displacement after a step of u, by the classical Runge-Kutta method."""
    limit, n = law.yield_displacement, law.exponent
    h = step / _STEPS

    def slope(z: float) -> float:
        turned = law.beta if z * step > 0.0 else -law.beta
        return 1.0 - abs(z / limit) ** n * (law.gamma + turned)

    for _ in range(_STEPS):
        a = slope(z)
        b = slope(z + 0.5 * h * a)
        c = slope(z + 0.5 * h * b)
        z += h / 6.0 * (a + 2.0 * b + 2.0 * c + slope(z + h * c))
    return z


def contact_force(
    law: Bumper | PowerBumper | JankowskiBumper | Law, deformation: ArrayLike, velocity: ArrayLike
) -> _Array:
    """Return the force of a stop during a contact, which starts at the first sample.

    Parameters
    ----------
    law
        The stop.
    deformation
        Deformation in m.
    velocity
        Velocity of the deformation in m/s.

    Returns
    -------
    numpy.ndarray
        Force in N at each sample, at least 0.
    """
    d = np.maximum(np.asarray(deformation, dtype=np.float64), 0.0)
    v = np.asarray(velocity, dtype=np.float64)
    if isinstance(law, Bumper):
        return np.maximum(law.stiffness * d + law.damping * v, 0.0)
    if isinstance(law, Law):
        values = [law.read.value(*one) for one in zip(d.tolist(), v.tolist(), strict=True)]
        return np.maximum(values, 0.0)
    if isinstance(law, PowerBumper):
        number, closing = law.dissipation_number, float(v[0])
        chi = law.dissipation if number is None else number / closing if closing else 0.0
        return np.maximum(law.stiffness * d**law.exponent * (1.0 + (chi or 0.0) * v), 0.0)
    assert law.mass is not None  # which an oscillator requires
    damping = 2.0 * law.damping_ratio * np.sqrt(law.mass * law.stiffness * np.sqrt(d))
    return np.asarray(law.stiffness * d**1.5 + damping * np.maximum(v, 0.0))
