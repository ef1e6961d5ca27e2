"""What a user should know of a rig before its results: absurd gaps, no bound, stops that ring."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact.engine import parameters as par
from vibroimpact.errors import InputError, warn_of_input
from vibroimpact.model import Harmonic, equilibrium
from vibroimpact.model.quantities import FREQUENCY, LENGTH
from vibroimpact.model.rig import Rig
from vibroimpact.model.unbounded import has_no_bound, undamped_frequency
from vibroimpact.model.units import plain, pretty
from vibroimpact.model.written_units import NONE, written_for
from vibroimpact.response.analytic_free_response import reference_excursions
from vibroimpact.response.engine_system import engine_rig, engine_system

_FACTOR = 1000.0
"""Between a metre and a millimetre."""
_LEAST = 1.0
"""Gaps below are not doubted (m)."""
_FAR, _FARTHEST = 100.0, 10_000.0
"""Gaps between so many times the largest displacement are doubted.

In millimetres they are then from a tenth to ten times as large as it.
"""
_MILLI, _MEGA = 1e-3, 1e6
_SOFTEST, _HARDEST = 0.01, 1000.0
"""Stiffnesses of usual stops, as multiples of that of the isolator."""
_FAST = 50.0
"""Forcing frequencies above so many times the natural one are doubted."""

_STIFF = 1000.0
"""Vibrations of a pressed stop in one forcing cycle from which a computation is slow."""
_NUDGE = 1e-6
"""Change of a stop's deformation that gives its stiffness, as a share of the deformation."""

UNBOUNDED = "free flight is unbounded"
"""How a note begins that says what η is taken over instead."""
STIFF = "slow to compute"
"""How a note begins that names a stop that vibrates much faster than the rig is shaken."""


def doubt_stops(rig: Rig, displacement: ArrayLike | None = None) -> list[str]:
    """Issue a warning if a gap in metres was probably millimetres, or a stiffness in mN/m MN/m.

    A gap is compared with the largest displacement of free flight if that is known in closed form,
    and a stiffness with that of the isolator.

    Parameters
    ----------
    displacement
        Displacements of its motion (m), if they are known. Values that are not finite are ignored.

    Returns
    -------
    list of str
        What is doubted, for the notes of a dataset.
    """
    if rig.system.by_mass or rig.system.units == NONE:
        return []  # a factor of 1000 is a mix-up of units
    return [*_doubt_stiffnesses(rig), *_doubt_gaps(rig, displacement)]


def _doubt_stiffnesses(rig: Rig) -> list[str]:
    """Doubt stops that the isolator outweighs by far, and that are usual in MN/m."""
    spring = rig.oscillator.isolator.initial_stiffness
    pairs = [stop.spring_and_dashpot for stop in rig.oscillator.stops.values()]
    notes = [
        f"{plain(stiffness / _MILLI, 4)} mN/m is {stiffness / spring:.3g} times the stiffness of "
        f"the isolator; is {plain(stiffness / _MILLI, 4)} MN/m meant?"
        for stiffness in sorted({pair[0] for pair in pairs if pair})
        if _SOFTEST * spring <= _MEGA / _MILLI * stiffness <= _HARDEST * spring
    ]
    warn_of_input("stiffness of a stop", notes)
    return notes


def _doubt_gaps(rig: Rig, displacement: ArrayLike | None) -> list[str]:
    oscillator = rig.oscillator
    gaps = sorted({stop.gap for stop in oscillator.stops.values() if stop.gap >= _LEAST})
    if not gaps:
        return []
    reach, whose = _free(rig), "of free flight"
    if math.isnan(reach) and displacement is not None:
        known = np.abs(np.asarray(displacement, dtype=float))
        known = known[np.isfinite(known)]
        if len(known):
            reach, whose = float(known.max()), "that was computed"
    notes = [
        f"{pretty(gap, LENGTH)} is {gap / reach:.3g} times the largest displacement {whose}, "
        f"{pretty(float(f'{reach:.4g}'), LENGTH)}; is {pretty(gap / _FACTOR, LENGTH)} meant?"
        for gap in gaps
        if _FAR * reach < gap <= _FARTHEST * reach
    ]
    warn_of_input("gap", notes)
    return notes


def doubt_frequency(rig: Rig, field: str) -> None:
    """Issue a warning if a forcing frequency in Hz was probably in revolutions per minute.

    `field` is the name of the frequency in the warning.
    """
    system, forced = rig.system, rig.periodic.frequency
    # Of several masses, the highest natural frequency is compared.
    highest = "highest " if system.by_mass else ""
    natural = engine_system(system).highest_frequency
    if system.units == NONE or not natural > 0.0:
        return
    if forced <= _FAST * natural:
        return
    message = (
        f"{pretty(forced, FREQUENCY)} is {forced / natural:.3g} times the {highest}natural "
        f"frequency of {pretty(float(f'{natural:.4g}'), FREQUENCY)}; is {plain(forced, 6)} rpm, "
        f"{pretty(float(f'{forced / 60.0:.6g}'), FREQUENCY)}, meant?"
    )
    warn_of_input(field, [message])


def note_unbounded(rig: Rig) -> list[str]:
    """What η is taken over where the largest free flight has no bound, for the notes of a dataset.

    Without a spring there is no η at all.
    """
    if rig.system.by_mass or not has_no_bound(rig):
        return []
    natural = undamped_frequency(rig.oscillator)
    size = 0.5 * reference_excursions(rig)[0]
    with written_for(rig):
        return [
            f"{UNBOUNDED} at {pretty(natural, FREQUENCY)}, because the isolator has almost no "
            f"damping; η is divided by {pretty(float(f'{size:.4g}'), LENGTH)}, the value for a "
            "slow excitation of this size"
        ]


def note_stiff_stops(rig: Rig, frequency: float) -> list[str]:
    """Say why a computation is slow: pressed stops vibrate thousands of times in a forcing cycle.

    Only where a law of the rig is not linear: elsewhere the motion is known in closed form, however
    fast it is.

    `frequency` is the lowest forcing frequency (Hz).

    Returns
    -------
    list of str
        One line for each such stop, for the notes of a dataset.
    """
    if rig.system.by_mass:
        return []
    oscillator = rig.oscillator
    preloaded = oscillator.force or any(stop.gap < 0.0 for stop in oscillator.stops.values())
    if not preloaded or par.laws(engine_rig(rig)) == par.LINEAR:
        return []
    try:
        u = equilibrium(oscillator).displacement
    except InputError:
        return []  # nothing holds the mass
    notes = []
    for name, stop, side in (("right", oscillator.right, 1.0), ("left", oscillator.left, -1.0)):
        if stop is None or stop.rigid or side * u <= stop.gap:
            continue
        deep, step = side * u - stop.gap, _NUDGE * (side * u - stop.gap)
        rise = stop.static_force(deep + step) - stop.static_force(deep - step)
        own = math.sqrt(rise / (2.0 * step) / oscillator.mass) / (2.0 * math.pi)
        if own >= _STIFF * frequency:
            with written_for(rig):
                high, low = pretty(float(f"{own:.3g}"), FREQUENCY), pretty(frequency, FREQUENCY)
            notes.append(
                f"{STIFF}: the {name} stop is pressed at rest and vibrates at {high}, "
                f"{own / frequency:.3g} times the forcing frequency of {low}, and every vibration "
                "must be computed; a smaller stiffness of this stop makes the computation faster"
            )
    return notes


def _free(rig: Rig) -> float:
    """The largest displacement of free flight at any frequency, if it has a closed form; or NaN."""
    oscillator, shaking = rig.oscillator, rig.shaking
    isolator = oscillator.isolator
    if not isinstance(shaking, Harmonic) or not isolator.linear or oscillator.force:
        return math.nan
    if isolator.damping == 0.0:
        return math.nan  # there is no peak
    return 0.5 * reference_excursions(rig)[0]
