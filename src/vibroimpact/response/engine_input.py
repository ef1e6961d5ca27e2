"""From the model to the engine: rigs as vectors, states checked against their rig."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.datasets.description import COMPONENTS
from vibroimpact.engine import section_map
from vibroimpact.engine.parameters import Drive, rig_vector
from vibroimpact.engine.state import FLIGHT, FRESH, MODE, ONE_MASS
from vibroimpact.errors import InputError, shown
from vibroimpact.model import (
    AssemblyState,
    Oscillator,
    Periodic,
    Record,
    Repeated,
    State,
    Stop,
)

TOUCHING = 1e-12
"""A mass this close to a bumper touches it, as a share of the gap and of the motion's size."""

_COLUMNS = np.array(
    [
        ONE_MASS.displacement(),
        ONE_MASS.velocity(),
        *(ONE_MASS.deformation(stop) for stop in range(ONE_MASS.stops)),
        MODE,
        *(MODE for _ in range(ONE_MASS.stops)),
        ONE_MASS.memory(),
    ]
)
"""Where an engine's state holds each of `COMPONENTS`; it has no phase, and the mode states the
contacts."""
CONTACTS = (0, 1, -1, 2)
"""`State.contact` by the engine's mode: none, right, left, both."""
_SIGNS = {"right": 1, "left": -1}
_SIDES = {sign: side for side, sign in _SIGNS.items()}
_IN_WORDS = {-1: "left stop", 0: "no contact", 1: "right stop", 2: "both stops"}
"""A contact in words."""


def oscillator_numbers(oscillator: Oscillator, shaking: Repeated | Record) -> NDArray[np.float64]:
    """Return an oscillator that is shaken as the engine's vector."""
    stiffness, damping, law = oscillator.isolator.engine_numbers()
    right, left = (
        None if stop is None else stop.engine_numbers()
        for stop in (oscillator.right, oscillator.left)
    )
    return rig_vector(
        oscillator.mass,
        stiffness,
        damping,
        right,
        left,
        oscillator.force,
        _drive(oscillator.mass, shaking),
        law,
    )


def section_numbers(oscillator: Oscillator, shaking: Repeated) -> NDArray[np.float64]:
    """Return the same with the size and the frequency of the shaking, for the section map."""
    numbers = oscillator_numbers(oscillator, shaking)
    vector = np.resize(numbers, max(section_map.SYSTEM, len(numbers)))
    vector[section_map.AMPLITUDE] = shaking.amplitude
    vector[section_map.FREQUENCY] = shaking.frequency
    return vector


def _drive(mass: float, shaken: Repeated | Record) -> Drive:
    """What shakes the mass, as the base acceleration that does the same.

    A displacement X sin θ of the base is the acceleration −X ω² sin θ, a force F sin θ on the
    mass −F/M sin θ, and an unbalance m e is the force m e ω² sin θ.
    """
    if isinstance(shaken, Record):
        return Drive(interval=shaken.step)
    scale, power = {
        "acceleration": (1.0, 0.0),
        "displacement": (-1.0, 2.0),
        "force": (-1.0 / mass, 0.0),
        "unbalance": (-1.0 / mass, 2.0),
    }[shaken.of]
    weights: tuple[tuple[float, float], ...] = ()
    if isinstance(shaken, Periodic):
        sizes = [one / shaken.amplitude for one in shaken.amplitudes]
        weights = tuple(
            (size * math.cos(angle), size * math.sin(angle))
            for size, angle in zip(sizes, shaken.phases, strict=True)
        )
    return Drive(1.0 if shaken.moves_base else 0.0, scale, power, weights)


def as_state(start: State | AssemblyState | xr.DataArray | xr.Dataset) -> State:
    """Accept a `State`, a dataset of `simulate`, or its `final_state`."""
    if isinstance(start, State):
        return start
    if isinstance(start, xr.Dataset) and "final_state" in start:
        start = start["final_state"]
    if (
        isinstance(start, xr.DataArray)
        and start.dims == ("component",)
        and "displacement" in start["component"]
    ):
        return _state_of([str(k) for k in start["component"].values], start.values.tolist())
    raise InputError(
        f"start: {shown(start)} is not a state; pass a State, such as State(0.01, 0.0), the result "
        "of simulate, or its final_state"
    )


def engine_state(oscillator: Oscillator, state: State) -> NDArray[np.float64]:
    """The state as the engine's vector, absent values deduced.

    Raises
    ------
    InputError
        If the mass lies inside a bumper, or the state claims a contact that does not exist.
    """
    u, v = state.displacement, state.velocity
    deformations = [0.0, 0.0]
    mode = parted = FLIGHT
    # Seen from each side in turn: s = +1 towards the right stop, −1 towards the left one.
    for i, (side, sign) in enumerate(_SIGNS.items()):
        stop, value = getattr(oscillator, side), state.deformation.get(side)
        said = None if state.contact is None else state.contact in (sign, 2)
        if stop is None:
            if value:
                raise InputError(
                    f"start.deformation.{side}: {value:g} m, but the oscillator has no {side} "
                    "bumper; pass 0 or None"
                )
            if said:
                raise InputError(
                    f"{_claim(state)}, but the oscillator has no {side} stop; pass 0 or None"
                )
            continue
        slack = TOUCHING * max(
            abs(stop.gap), abs(u), abs(v) / (oscillator.angular_frequency or np.inf)
        )
        reach = sign * u - stop.gap
        if stop.rigid:
            touches, deformation = _on_wall(stop, sign, state, reach, slack, said)
            if touches:
                u = sign * stop.gap
        elif (law := stop.spring_and_dashpot) is None:
            slack = TOUCHING * max(abs(stop.gap), abs(u))
            touches, deformation = _on_power_law(sign, state, reach, slack, said, sign * v)
        else:
            touches, deformation = _on_bumper(law, sign, state, reach, slack, said, sign * v)
        bit = 1 << i
        if touches:
            mode |= bit
        elif abs(reach - deformation) <= slack and _parts(stop, deformation, sign * v):
            parted |= bit
        deformations[i] = deformation
    if mode.bit_count() > 1 and not _overlap(oscillator):
        mode = _deeper(oscillator, u, v)
    vector = np.zeros(ONE_MASS.width)
    vector[MODE] = mode
    # What touches begins to. A stop that the mass leaves is not met again by rounding.
    vector[FRESH] = parted if parted.bit_count() == 1 else mode
    vector[ONE_MASS.displacement()], vector[ONE_MASS.velocity()] = u, v
    for stop, deformation in enumerate(deformations):
        vector[ONE_MASS.deformation(stop)] = deformation
    vector[ONE_MASS.memory()] = state.isolator
    return vector


def _claim(state: State) -> str:
    """Return the contact of a state, with which a message begins."""
    return f"start.contact: {state.contact} ({_IN_WORDS[state.contact or 0]})"


def _overlap(oscillator: Oscillator) -> bool:
    """Whether the mass can press both stops at once."""
    return sum(stop.gap for stop in oscillator.stops.values()) < 0.0


def _deeper(oscillator: Oscillator, u: float, v: float) -> int:
    """Return the mode in which the stop is pressed that is deeper where both begin at one place.

    Both are touched to within rounding there, and the engine has no motion that presses both.
    """
    assert oscillator.right is not None
    assert oscillator.left is not None
    right, left = u - oscillator.right.gap, -u - oscillator.left.gap
    return 1 << (0 if (right, v) >= (left, -v) else 1)


def _parts(stop: Stop, deformation: float, closing: float) -> bool:
    """Whether a mass at the face of a stop that it does not touch has just left it.

    It leaves the face of a relaxing bumper as fast as that relaxes, any other one at its own speed.
    """
    if stop.spring_and_dashpot is not None and deformation > 0.0:
        stiffness, damping = stop.spring_and_dashpot
        spring, dashpot = stiffness * deformation, damping * closing
        return abs(spring + dashpot) <= TOUCHING * spring
    return closing <= 0.0


def _on_power_law(
    sign: int, state: State, reach: float, slack: float, said: bool | None, closing: float
) -> tuple[bool, float]:
    """Whether the mass presses a stop without memory, and the speed at which it met it (m/s).

    At its face a mass that moves into it is about to meet it, unless the state says that it has.
    """
    stated_speed = state.deformation.get(_SIDES[sign])
    touches = reach > slack or (bool(said) and reach >= -slack)
    if said is not None and said != touches and abs(reach) > slack:
        where = "inside" if touches else "away from"
        raise InputError(
            f"{_claim(state)}, but the mass is {abs(reach):g} m {where} the {_SIDES[sign]} stop; "
            f"pass {sign if touches else 0} or None"
        )
    met = stated_speed if stated_speed is not None else closing if abs(reach) <= slack else 0.0
    return touches, max(met, 0.0) if touches else 0.0


def _on_wall(
    stop: Stop,
    sign: int,
    state: State,
    reach: float,
    slack: float,
    said: bool | None,
) -> tuple[bool, float]:
    """Whether the mass rests on a rigid stop, and its deformation, 0.

    A mass at rest there that nothing presses is let go by the engine at once.
    """
    value = state.deformation.get(_SIDES[sign])
    if value:
        raise InputError(
            f"start.deformation.{_SIDES[sign]}: {value:g} m, but a rigid stop does not deform; "
            "pass 0 or None"
        )
    if reach > slack:
        most = "at most" if sign == 1 else "at least"
        raise InputError(
            f"start.displacement: {state.displacement:g} m is {reach:g} m inside the rigid "
            f"{_SIDES[sign]} stop; pass {most} {sign * stop.gap:g} m"
        )
    rests = reach >= -slack and state.velocity == 0.0
    if said and not rests:
        raise InputError(
            f"{_claim(state)}, but the mass does not rest on the rigid {_SIDES[sign]} stop "
            f"(distance {-reach:g} m, velocity {state.velocity:g} m/s); pass 0 or None"
        )
    return rests and said is not False, 0.0


def _on_bumper(
    law: tuple[float, float],
    sign: int,
    state: State,
    reach: float,
    slack: float,
    said: bool | None,
    closing: float,
) -> tuple[bool, float]:
    """Whether the mass presses a bumper, and the bumper's deformation away from the mass (m).

    The law is the stiffness and the damping of the bumper. An undeformed bumper is not pressed yet
    by a mass at its face, unless the state says so.
    """
    stiffness, damping = law
    stated_depth = state.deformation.get(_SIDES[sign])
    deformation = max(reach, 0.0) if stated_depth is None else stated_depth
    if reach > deformation + slack:
        raise InputError(
            f"start.deformation.{_SIDES[sign]}: {deformation:g} m, but a displacement of "
            f"{state.displacement:g} m compresses this bumper by {reach:g} m; pass at least "
            f"{reach:g} m, or None"
        )
    touches = deformation - reach <= slack
    if said and not touches:
        raise InputError(
            f"{_claim(state)}, but the {_SIDES[sign]} bumper is {deformation - reach:g} m away "
            "from the mass; pass 0 or None"
        )
    force = stiffness * deformation + damping * closing
    if damping == 0.0 and not touches:
        deformation = 0.0  # without a dashpot a free bumper is at rest at once
    rounding = TOUCHING * (stiffness * deformation + damping * abs(closing))
    if said and force < -rounding:
        raise InputError(
            f"{_claim(state)}, but the {_SIDES[sign]} bumper would pull the mass with {-force:g} "
            "N; pass 0 or None, or a higher velocity towards the bumper"
        )
    if said is False and touches and damping == 0.0 and deformation > slack:
        raise InputError(
            f"{_claim(state)}, but the mass compresses the {_SIDES[sign]} bumper by "
            f"{deformation:g} m, and a bumper without a dashpot stays in contact; pass {sign} or "
            "None"
        )
    begins = deformation <= slack and closing > 0.0
    presses = said is None and touches and force > 0.0 and not begins
    return bool(said) or presses, deformation


def components(vector: NDArray[np.float64], phase: float) -> NDArray[np.float64]:
    """Engine states (last axis) as the components of a dataset's state."""
    values: NDArray[np.float64] = vector.take(_COLUMNS, axis=-1)
    deformations, angle, touching = values[..., 2:4], values[..., 4], values[..., 5:7]
    # At the end of a contact without a dashpot, rounding may leave a deformation below zero.
    np.maximum(deformations, 0.0, out=deformations)
    angle[...] = phase % (2.0 * math.pi)
    touching[...] = touching.astype(np.int64) >> np.arange(ONE_MASS.stops) & 1
    values += 0.0  # no negative zeros
    return values


def state_from(vector: NDArray[np.float64], phase: float) -> State:
    """An engine's state at a forcing phase as a `State`."""
    return state_of(components(vector, phase).tolist())


def state_of(values: Sequence[float]) -> State:
    """Return values of `COMPONENTS` as a `State`."""
    return _state_of(COMPONENTS, values)


def _state_of(names: Sequence[str], values: Sequence[float]) -> State:
    parts: dict[str, Any] = dict(zip(names, values, strict=True))
    deformation = {
        side: parts.pop(name) for side in _SIGNS if (name := f"deformation.{side}") in parts
    }
    touching = [parts.pop(name) for side in _SIGNS if (name := f"touching.{side}") in parts]
    if len(touching) == len(_SIGNS):  # else the contact is deduced
        right, left = touching
        parts["contact"] = CONTACTS[bool(right) + 2 * bool(left)]
    return State(**parts, deformation=deformation)
