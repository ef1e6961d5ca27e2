"""From the model to the engine: rigs as vectors, states checked against their rig."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.engine import motion as layout
from vibroimpact.engine.motion import FLIGHT, LEFT, RIGHT
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.errors import InputError
from vibroimpact.model import Bumper, Oscillator, RigidStop, State
from vibroimpact.model.units import LENGTH, pretty
from vibroimpact.response.variables import COMPONENTS

TOUCHING = 1e-12
"""A mass this close to a bumper touches it, as a share of the gap and of the motion's size."""


def followed(oscillator: Oscillator) -> tuple[Bumper | None, Bumper | None]:
    """The right and the left bumper, if the engine can follow the rig.

    Raises
    ------
    InputError
        If a stop is rigid, or a bumper preloaded.
    """
    sides = []
    for side, stop in (("right", oscillator.right), ("left", oscillator.left)):
        if isinstance(stop, RigidStop):
            raise InputError(
                f"{side}: {stop} cannot be followed by this version; a Bumper is accepted"
            )
        if stop is not None and stop.gap < 0.0:
            raise InputError(
                f"{side}.gap: {pretty(stop.gap, LENGTH)} is a preload, which cannot be followed by "
                "this version; a length of at least 0 is accepted"
            )
        sides.append(stop)
    right, left = sides
    return right, left


def engine_rig(oscillator: Oscillator) -> NDArray[np.float64]:
    """The oscillator as the vector that the engine reads.

    Raises
    ------
    InputError
        If the engine cannot follow it.
    """
    right, left = followed(oscillator)

    def numbers(bumper: Bumper | None) -> tuple[float, float, float] | None:
        return None if bumper is None else (bumper.stiffness, bumper.damping, bumper.gap)

    return rig_vector(
        oscillator.mass,
        oscillator.isolator.stiffness,
        oscillator.isolator.damping,
        numbers(right),
        numbers(left),
    )


def as_state(start: State | xr.DataArray | xr.Dataset) -> State:
    """Accept a `State`, a dataset of `simulate`, or its `final_state`."""
    if isinstance(start, State):
        return start
    if isinstance(start, xr.Dataset) and "final_state" in start:
        start = start["final_state"]
    if isinstance(start, xr.DataArray) and start.dims == ("component",):
        values: dict[str, Any] = {
            str(k): float(start.sel(component=k)) for k in start["component"].values
        }
        if "contact" in values:
            values["contact"] = int(values["contact"])
        return State(**values)
    raise InputError(
        f"start: {type(start).__name__} is not a state; a State, a dataset of simulate or its "
        "final_state is accepted"
    )


def engine_state(oscillator: Oscillator, state: State) -> NDArray[np.float64]:
    """The state as the engine's vector, absent values deduced.

    Raises
    ------
    InputError
        If the mass lies inside a bumper, or is said to touch one that it does not touch.
    """
    u, v = state.displacement, state.velocity
    right, left = followed(oscillator)
    deformations = [0.0, 0.0]
    contact = FLIGHT
    # Seen from each side in turn: s = +1 towards the right bumper, −1 towards the left one.
    for i, (name, bumper, given, sign) in enumerate(
        (
            ("right_bumper", right, state.right_bumper, 1),
            ("left_bumper", left, state.left_bumper, -1),
        )
    ):
        if bumper is None:
            if given:
                raise InputError(
                    f"start.{name}: {given:g} m, but the oscillator has no such bumper; "
                    "0 or nothing is accepted"
                )
            if state.contact == sign:
                raise InputError(
                    f"start.contact: {sign}, but the oscillator has no bumper there; 0 is accepted"
                )
            continue
        reach = sign * u - bumper.gap
        slack = TOUCHING * max(bumper.gap, abs(u), abs(v) / oscillator.angular_frequency)
        deformation = max(reach, 0.0) if given is None else sign * given
        if reach > deformation + slack:
            raise InputError(
                f"start.{name}: {sign * deformation:g} m puts the mass at {u:g} m inside the "
                f"bumper; {sign * reach:g} m or more is accepted"
            )
        touches = deformation - reach <= slack
        if state.contact == sign and not touches:
            raise InputError(
                f"start.contact: {sign}, but the bumper is {deformation - reach:g} m away; "
                "0 is accepted"
            )
        force = bumper.stiffness * deformation + bumper.damping * sign * v
        if bumper.damping == 0.0 and not touches:
            deformation = 0.0  # without a dashpot a free bumper is at rest at once
        rounding = TOUCHING * (bumper.stiffness * deformation + bumper.damping * abs(v))
        if state.contact == sign and force < -rounding:
            raise InputError(
                f"start.contact: {sign}, but the bumper would pull with {-force:g} N; "
                "0 is accepted, or a velocity at which it presses"
            )
        if state.contact == 0 and touches and bumper.damping == 0.0 and deformation > slack:
            raise InputError(
                f"start.contact: 0, but the mass presses the {name} by {deformation:g} m, which "
                f"has no dashpot to lag behind; {sign} is accepted"
            )
        presses = force > 0.0 or (deformation == 0.0 and bumper.damping == 0.0 and sign * v > 0.0)
        if state.contact == sign or (state.contact is None and touches and presses):
            contact = RIGHT if sign == 1 else LEFT
        deformations[i] = deformation
    vector = np.zeros(layout.STATE)
    vector[layout.MODE] = contact
    vector[layout.FRESH] = 1.0 if contact != FLIGHT else 0.0
    vector[layout.U], vector[layout.V] = u, v
    vector[layout.RIGHT_BUMPER], vector[layout.LEFT_BUMPER] = deformations
    return vector


def components(vector: NDArray[np.float64], phase: float) -> NDArray[np.float64]:
    """Engine states (last axis) as the components of a dataset's state."""
    mode = vector[..., layout.MODE]
    # At the end of a contact without a dashpot, rounding may leave a deformation below zero.
    deformations = np.maximum(vector[..., layout.RIGHT_BUMPER : layout.LEFT_BUMPER + 1], 0.0)
    stacked = np.stack(
        [
            vector[..., layout.U],
            vector[..., layout.V],
            deformations[..., 0],
            -deformations[..., 1],
            np.broadcast_to(phase % (2.0 * math.pi), mode.shape),
            np.where(mode == RIGHT, 1.0, np.where(mode == LEFT, -1.0, 0.0)),
        ],
        axis=-1,
    )
    return stacked + 0.0  # no negative zeros


def state_from(vector: NDArray[np.float64], phase: float) -> State:
    """An engine's state at a forcing phase as a `State`."""
    values: dict[str, Any] = dict(zip(COMPONENTS, components(vector, phase), strict=True))
    return State(**{**values, "contact": int(values["contact"])})
