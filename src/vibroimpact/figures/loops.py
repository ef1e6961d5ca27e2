"""Force of one law over displacement, for a prescribed motion."""

from __future__ import annotations

import math
from typing import cast

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from vibroimpact.errors import InputError, shown
from vibroimpact.figures.finish import without_unit
from vibroimpact.figures.legends import fit_labels
from vibroimpact.figures.motion_style import axes_or_new
from vibroimpact.figures.style import MOTIONS
from vibroimpact.model import AnyIsolator, Stop, to_si
from vibroimpact.model.argument_types import String
from vibroimpact.model.built_in_laws import Deformable
from vibroimpact.model.public import public
from vibroimpact.model.quantities import FREQUENCY, LENGTH
from vibroimpact.model.stated_units import has_unit
from vibroimpact.model.system import Units
from vibroimpact.model.written_units import NONE, SI

_Array = NDArray[np.float64]

_SAMPLES = 2000
"""Number of points in one cycle."""


@public
def force_loop(
    law: Deformable,
    amplitude: float | str,
    frequency: float | str = 0.0,
    ax: Axes | None = None,
    *,
    title: String | None = None,
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
    if units == NONE and has_unit(amplitude):
        raise InputError(
            f'amplitude: {shown(amplitude)} has a unit, but units is "none"; pass a number without '
            "a unit, or remove units"
        )
    size = to_si(amplitude, LENGTH, "amplitude", above=0.0)
    omega = math.tau * to_si(frequency, FREQUENCY, "frequency", minimum=0.0)
    ax = axes_or_new(ax, (5.2, 4.0), title)
    if law.is_stop:
        u, v, _ = _sine(size, omega, 0.5)
        force, what = cast("Stop", law).force(np.maximum(u, 0.0), v), "deformation (mm)"
    else:
        u, v, direction = _sine(size, omega, 1.25)
        force, what = cast("AnyIsolator", law).force(u, direction, v), "displacement $u$ (mm)"
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
