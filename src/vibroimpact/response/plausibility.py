"""Values that a rig's motion shows to be absurd: gaps in metres that were meant in millimetres."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact.errors import warn_of_input
from vibroimpact.model import Harmonic
from vibroimpact.model.quantities import FREQUENCY, LENGTH
from vibroimpact.model.rig import Rig
from vibroimpact.model.unbounded import has_no_bound, undamped_frequency
from vibroimpact.model.units import pretty
from vibroimpact.response.analytic_free_response import reference_excursions

_FACTOR = 1000.0
"""Between a metre and a millimetre."""
_LEAST = 1.0
"""Gaps below are not doubted (m)."""
_FAR, _FARTHEST = 100.0, 10_000.0
"""Gaps between so many times the largest displacement are doubted.

In millimetres they are then from a tenth to ten times as large as it.
"""


UNBOUNDED = "free flight has no bound"
"""How a note begins that says what η is taken over instead."""


def doubt_gaps(
    rig: Rig,
    displacement: ArrayLike | None = None,
) -> list[str]:
    """Issue a warning if a gap is given in metres and has the motion's size in millimetres.

    It is compared with the largest displacement of free flight if that is known in closed form.

    Parameters
    ----------
    oscillator
        The rig.
    shaking
        What shakes it.
    displacement
        Where it was seen (m), if it was; what is infinite or unknown shows nothing.

    Returns
    -------
    list of str
        What is doubted, for the notes of a dataset.
    """
    oscillator = rig.oscillator
    gaps = sorted({stop.gap for stop in oscillator.stops if stop.gap >= _LEAST})
    if not gaps:
        return []
    reach, whose = _free(rig), "of free flight"
    if math.isnan(reach) and displacement is not None and np.size(displacement):
        reach, whose = float(np.abs(displacement).max()), "that was found"
    notes = [
        f"{pretty(gap, LENGTH)} is {gap / reach:.3g} times the largest displacement {whose}, "
        f"{pretty(float(f'{reach:.4g}'), LENGTH)}; is {pretty(gap / _FACTOR, LENGTH)} meant?"
        for gap in gaps
        if _FAR * reach < gap <= _FARTHEST * reach
    ]
    warn_of_input("gap", notes, stacklevel=5)
    return notes


def note_unbounded(rig: Rig) -> list[str]:
    """What η is taken over where the largest free flight has no bound, for the notes of a dataset.

    Without a spring there is no η at all.
    """
    oscillator = rig.oscillator
    if not has_no_bound(rig):
        return []
    natural = undamped_frequency(oscillator)
    size = 0.5 * reference_excursions(rig)[0]
    return [
        f"{UNBOUNDED}: it grows without end at {pretty(natural, FREQUENCY)}, for "
        "nothing damps the isolator enough; η is taken over "
        f"{pretty(float(f'{size:.4g}'), LENGTH)}, which a slowly changing excitation of this size "
        "gives"
    ]


def _free(rig: Rig) -> float:
    """The largest displacement of free flight at any frequency, if it has a closed form; or NaN."""
    oscillator, shaking = rig.oscillator, rig.shaking
    isolator = oscillator.isolator
    if not isinstance(shaking, Harmonic) or not isolator.linear or oscillator.force:
        return math.nan
    if isolator.damping == 0.0:
        return math.nan  # there is no peak
    return 0.5 * reference_excursions(rig)[0]
