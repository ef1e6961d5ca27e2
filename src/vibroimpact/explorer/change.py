"""Functions that return the next state of a page after an action of the user."""

from __future__ import annotations

import math
from collections.abc import Mapping

from vibroimpact.errors import InputError, shown
from vibroimpact.explorer.laws import isolator_of, stop_of
from vibroimpact.explorer.state import ON_DEMAND, PageState
from vibroimpact.model import Harmonic, Oscillator, to_si
from vibroimpact.model.excitation import sized
from vibroimpact.model.frequency_text import forcing, forcings
from vibroimpact.model.oscillator import SIDES
from vibroimpact.model.parameters import set_values
from vibroimpact.model.quantities import DIMENSIONLESS as NUMBER
from vibroimpact.model.quantities import FREQUENCY
from vibroimpact.model.rig import Rig
from vibroimpact.model.stated_units import has_unit
from vibroimpact.model.written_units import unitless

DIMENSIONLESS = ("stiffness_ratio", "gap_ratio", "relaxation_time")
"""Dimensionless parameters of a stop."""
OF_RIG = ("isolator_period", "damping_ratio")
ROUNDED = 1e-6
"""Relative error of a frequency that the page has rounded."""


def moved(state: PageState, path: str, value: float | str) -> PageState:
    """Return the state with another value of one knob.

    Parameters
    ----------
    state
        The state of the page.
    path
        Name of the knob, as in `controls`. Examples are ``"mass"``, ``"isolator.stiffness"``,
        ``"right.gap"``, ``"stops.gap"`` (both sides), ``"amplitude"``, ``"damping_ratio"`` and
        ``"stops.gap_ratio"``.
    value
        The new value, in SI units or as text with a unit. The unit of an amplitude selects the
        excitation: ``"0.05 g"``, ``"5 mm"``, ``"120 N"`` or ``"0.4 kg m"``.

    Raises
    ------
    InputError
        If there is no such knob, or if the value is invalid.
    """
    part, _, name = path.rpartition(".")
    if path == "amplitude":
        return state._replace(shaking=_shaken(state.shaking, value))
    if name not in DIMENSIONLESS:
        return state._replace(oscillator=set_values(state.rig, {path: value}).oscillator)
    rig = state.oscillator
    for side in SIDES if part == "stops" else (part,):
        if getattr(rig, side, None) is not None:
            alone = Rig(one_sided(rig, side), state.shaking)
            rig = rig.replace(**{side: getattr(set_values(alone, {name: value}).oscillator, side)})
    return state._replace(oscillator=rig)


def _shaken(shaking: Harmonic, value: float | str) -> Harmonic:
    """The shaking with another amplitude, of another quantity if a text has its unit."""
    of = shaking.of
    try:
        size, of = sized(value, of, "amplitude", positive=True)
    except InputError:
        if not isinstance(value, str):
            raise
        size, of = sized(value, None, "amplitude", positive=True)
    return Harmonic(size, shaking.frequency, shaking.phase, of)


def one_sided(rig: Oscillator, side: str) -> Oscillator:
    """Return the oscillator with the stop of one side only.

    A parameter that is defined for both stops then applies to this stop alone.
    """
    other = "left" if side == "right" else "right"
    return rig.replace(**{other: None})


def with_law(state: PageState, part: str, kind: str) -> PageState:
    """Return the state with another law of the isolator or of a stop, about as strong as before.

    Raises
    ------
    InputError
        If there is no such part, or if there is no such law.
    """
    rig = state.oscillator
    if part == "isolator":
        return state._replace(oscillator=rig.replace(isolator=isolator_of(kind, state)))
    sides = SIDES if part == "stops" else (part,)
    if not set(sides) <= set(SIDES):
        raise InputError(f"part: {shown(part)} is unknown; use isolator, stops, right or left")
    changed = {side: stop_of(kind, state, side) for side in sides}
    return state._replace(oscillator=rig.replace(**changed))


def joined(state: PageState, together: bool) -> PageState:
    """Return the state with one knob for both stops, or with a knob for each stop.

    With one knob, the left stop becomes equal to the right stop. If there is no right stop, the
    right stop becomes equal to the left stop.
    """
    if not together:
        return state._replace(together=False)
    rig = state.oscillator
    one = rig.right if rig.right is not None else rig.left
    return state._replace(oscillator=rig.replace(right=one, left=one), together=True)


def chosen(state: PageState, direction: str, frequency: float | str) -> PageState:
    """Return the state with another selected motion.

    Raises
    ------
    InputError
        If the direction is unknown, or if the frequency is outside the range of the sweeps.
    """
    if direction not in ("forward", "backward"):
        raise InputError(f"direction: {shown(direction)} is unknown; use 'forward' or 'backward'")
    low, high = state.span
    if unitless() and not has_unit(frequency):
        hertz = to_si(frequency, NUMBER, "frequency", above=0.0) / math.tau
    else:
        hertz = to_si(frequency, FREQUENCY, "frequency", above=0.0)
    # The page has frequencies with some digits only, also those of both ends.
    hertz = next((end for end in state.span if math.isclose(hertz, end, rel_tol=ROUNDED)), hertz)
    if not low <= hertz <= high:
        raise InputError(
            f"frequency: {forcing(hertz)} is outside the range of the sweeps; use a frequency from "
            f"{forcings(low, high)}"
        )
    return state._replace(
        direction=direction,  # type: ignore[arg-type]
        shaking=state.shaking.replace(frequency=hertz),
    )


def looked(state: PageState, how: Mapping[str, bool]) -> PageState:
    """Return the state with pictures shown or hidden, or with curves in other units.

    The key ``"physical"`` selects curves in mm and g (true) or the normalised curves η (false).

    Raises
    ------
    InputError
        If a picture is unknown.
    """
    shown_now = set(state.shown)
    for name, wanted in how.items():
        if name == "physical":
            state = state._replace(physical=bool(wanted))
        elif name in ON_DEMAND:
            (shown_now.add if wanted else shown_now.discard)(name)
        else:
            raise InputError(
                f"picture: {shown(name)} is unknown; use one of {', '.join(ON_DEMAND)}"
            )
    return state._replace(shown=frozenset(shown_now))


def with_ratios(state: PageState, stiffness_ratio: float, gap_ratio: float) -> PageState:
    """Return the state at another point of the (λ, δ0) map.

    Raises
    ------
    InputError
        If the rig has no stiffness ratio λ or no gap ratio δ0, or if a ratio is not finite.
    """
    if not (math.isfinite(stiffness_ratio) and math.isfinite(gap_ratio)):
        raise InputError(
            f"point: the stiffness ratio {stiffness_ratio:g} or the gap ratio {gap_ratio:g} is not "
            "finite; click a point of the map"
        )
    there = moved(state, "stops.stiffness_ratio", stiffness_ratio)
    return moved(there, "stops.gap_ratio", gap_ratio)
