"""From a state to the next one: what the knobs and choices of the page do."""

from __future__ import annotations

import math
from collections.abc import Mapping

from vibroimpact.errors import InputError, shown
from vibroimpact.explorer.laws import isolator_of, stop_of
from vibroimpact.explorer.state import ON_DEMAND, State
from vibroimpact.model import Oscillator, to_si
from vibroimpact.model.excitation import sized
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.model.quantities import FREQUENCY
from vibroimpact.model.rig import Rig

SIDES = ("right", "left")
DIMENSIONLESS = ("stiffness_ratio", "gap_ratio", "relaxation_time")
"""Of a stop; those of the whole rig are parameters without a side."""
OF_RIG = ("isolator_period", "damping_ratio")


def moved(state: State, path: str, value: float | str) -> State:
    """Return the state with one knob at another value.

    Parameters
    ----------
    state
        What is shown.
    path
        As `controls` names the knob: ``"mass"``, ``"isolator.stiffness"``, ``"right.gap"``,
        ``"stops.gap"`` of both sides, ``"amplitude"``; ``"damping_ratio"``,
        ``"stops.gap_ratio"``.
    value
        In SI units, or a text with units.

    Raises
    ------
    InputError
        If there is no such knob, or the value cannot be used.
    """
    rig = state.oscillator
    part, _, name = path.rpartition(".")
    if path == "amplitude":
        size, _ = sized(value, state.shaking.of, "amplitude", positive=True)
        return state._replace(shaking=state.shaking.replace(amplitude=size))
    if path in OF_RIG:
        number = to_si(value, PARAMETERS[path].quantity, path, above=0.0)
        moved = PARAMETERS[path].vary(state.rig, number)
        return state._replace(oscillator=moved.oscillator)
    if path in ("mass", "force"):
        return state._replace(oscillator=rig.replace(**{path: value}))
    if part == "isolator" and name in type(rig.isolator).model_fields:
        return state._replace(
            oscillator=rig.replace(isolator=rig.isolator.replace(**{name: value}))
        )
    sides = SIDES if part == "stops" else (part,)
    present = [side for side in sides if side in SIDES and getattr(rig, side) is not None]
    if not present:
        raise InputError(f"knob: {shown(path)} is unknown; a name that the page offers is accepted")
    for side in present:
        rig = _stop_moved(state, rig, side, name, value)
    return state._replace(oscillator=rig)


def _stop_moved(
    state: State, rig: Oscillator, side: str, name: str, value: float | str
) -> Oscillator:
    """The rig with one number of one stop at another value."""
    stop = getattr(rig, side)
    if name in DIMENSIONLESS:
        number = to_si(value, PARAMETERS[name].quantity, name, minimum=0.0)
        alone = PARAMETERS[name].vary(Rig(one_sided(rig, side), state.shaking), number)
        return rig.replace(**{side: getattr(alone.oscillator, side)})
    if name not in type(stop).model_fields:
        raise InputError(f"knob: {shown(name)} is unknown; a name that the page offers is accepted")
    return rig.replace(**{side: stop.replace(**{name: value})})


def one_sided(rig: Oscillator, side: str) -> Oscillator:
    """The rig with the stop of one side only, by which parameters of both are those of one."""
    other = "left" if side == "right" else "right"
    return rig.replace(**{other: None})


def with_law(state: State, part: str, kind: str) -> State:
    """Return the state with another law of the isolator or of a stop, as strong as the last one.

    Raises
    ------
    InputError
        If there is no such part or law.
    """
    rig = state.oscillator
    if part == "isolator":
        return state._replace(oscillator=rig.replace(isolator=isolator_of(kind, state)))
    sides = SIDES if part == "stops" else (part,)
    if not set(sides) <= set(SIDES):
        raise InputError(
            f"part: {shown(part)} is unknown; isolator, stops, right and left are accepted"
        )
    changed = {side: stop_of(kind, state, side) for side in sides}
    return state._replace(oscillator=rig.replace(**changed))


def joined(state: State, together: bool) -> State:
    """Return the state with one knob for both stops, the left one then as the right one."""
    if not together:
        return state._replace(together=False)
    rig = state.oscillator
    one = rig.right if rig.right is not None else rig.left
    return state._replace(oscillator=rig.replace(right=one, left=one), together=True)


def chosen(state: State, direction: str, frequency: float | str) -> State:
    """Return the state with another selected motion.

    Raises
    ------
    InputError
        If the direction is unknown, or the frequency lies outside the sweeps.
    """
    if direction not in ("forward", "backward"):
        raise InputError(
            f"direction: {shown(direction)} is unknown; 'forward' and 'backward' are accepted"
        )
    low, high = state.span
    hertz = to_si(frequency, FREQUENCY, "frequency", minimum=low, maximum=high)
    return state._replace(
        direction=direction,  # type: ignore[arg-type]
        shaking=state.shaking.replace(frequency=hertz),
    )


def looked(state: State, how: Mapping[str, bool]) -> State:
    """Return the state with pictures shown or hidden, and curves in η or physical.

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
                f"picture: {shown(name)} is unknown; a name that the page offers is accepted"
            )
    return state._replace(shown=frozenset(shown_now))


def placed(state: State, stiffness_ratio: float, gap_ratio: float) -> State:
    """Return the state at another point of the (λ, δ0) map.

    Raises
    ------
    InputError
        If the rig has no such ratios.
    """
    if not (math.isfinite(stiffness_ratio) and math.isfinite(gap_ratio)):
        raise InputError("point: the ratios are not finite numbers; a point of the map is accepted")
    there = moved(state, "stops.stiffness_ratio", stiffness_ratio)
    return moved(there, "stops.gap_ratio", gap_ratio)
