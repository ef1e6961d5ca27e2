"""The rig as the kernels see it: one vector of plain numbers, everything per unit mass."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.compiler import register_jitable
from vibroimpact.engine.jit import CHOSEN
from vibroimpact.engine.stops import memory_laws, rebound
from vibroimpact.law_numbers import (
    OWN_NUMBERS,
    WORDS,
    IsolatorNumbers,
    MemoryStop,
    OwnStop,
    PowerLaw,
    StopNumbers,
    Wall,
)

# Positions in the vector; the numbers of each stop start at `stop_at`.
STIFFNESS = 0  # K/M, 1/s²
DAMPING = 1  # C/M, 1/s
BUMPER = 2
WIDTH = 12
KIND = 0  # ABSENT, KELVIN_VOIGT, RIGID, POWER_LAW, JANKOWSKI, FORMULA or MEMORY
BUMPER_STIFFNESS = 1  # K_j/M, 1/s²
BUMPER_DAMPING = 2  # C_j/M, 1/s
GAP = 3  # G0_j, m; infinite where there is no bumper
RATE = 4  # K_j/C_j, 1/s: how fast the free bumper relaxes; infinite where C_j = 0
EXPONENT = 5  # n of a force k δⁿ, with BUMPER_STIFFNESS in 1/(s² mⁿ⁻¹)
DISSIPATION = 6  # χ, s/m, or below 0 minus the number d of χ = d / closing speed
REBOUND = 7  # of a rigid stop, or one with a memory: its law, and the numbers of that
RESTITUTION = 8  # the first of these
LOAD = BUMPER + 2 * WIDTH  # constant force on the mass, F/M, m/s²
BASE = LOAD + 1  # 1 if the base moves; 0 if it stands still and a force shakes the mass
SCALE = LOAD + 2  # A_t has the amplitude: what is given · SCALE · ω^POWER
POWER = LOAD + 3
FORCING = LOAD + 4  # HARMONIC, SEVERAL or RAMP
HARMONICS = LOAD + 5  # how many
INTERVAL = LOAD + 6  # between the samples of a record, s; infinite if there is none
# What the isolator does besides: STIFFNESS u + CUBIC u³ + QUINTIC u⁵ + 2 SINH sinh(SINH_RATE u)
# + HYSTERETIC z, with z′ = u′ (SLOPE − (KNEE + TURNING s_v s_z) |z|ⁿ), s_v and s_z the signs of
# u′ and of z; with a LIMIT z′ = u′ as long as |z| stays below it. DAMPING |u′|^POWER_OF_V.
CUBIC = LOAD + 7
QUINTIC = LOAD + 8
SINH = LOAD + 9
SINH_RATE = LOAD + 10
HYSTERETIC = LOAD + 11
SLOPE = LOAD + 12
TURNING = LOAD + 13
KNEE = LOAD + 14
SHARPNESS = LOAD + 15  # n
YIELD = LOAD + 16  # of |z|, m; infinite if there is none
FRICTION = LOAD + 17  # F_c/M, m/s²
DRAG = LOAD + 18  # exponent of the velocity
CURVED = LOAD + 19  # 1 if a law is not linear
OWN = LOAD + 20
"""Formulae of a user: that of the isolator and of each stop, `law_numbers.pack`."""
OWN_FLAGS = WORDS
OWN_FIRST = OWN_FLAGS + 1
OWN_PER_MASS = OWN_FIRST + OWN_NUMBERS  # 1/M
OWN_STIFFNESS = OWN_PER_MASS + 1  # at rest, per unit mass
OWN_WIDTH = OWN_STIFFNESS + 1
SIZE = OWN + 3 * OWN_WIDTH
WEIGHTS = SIZE + 2
"""Where a vector goes on if there are several harmonics: behind the amplitude and the frequency
of a system vector come the weights of sin nθ and cos nθ, two for each n from 1 on."""

HARMONIC, SEVERAL, RAMP = 0.0, 1.0, 2.0
MASSES = 3.0
"""In the place of FORCING: the vector is that of several masses (`assembly.layout`)."""

ABSENT, KELVIN_VOIGT, RIGID, POWER_LAW, JANKOWSKI, FORMULA = 0.0, 1.0, 2.0, 3.0, 4.0, 5.0
MEMORY = 6.0
"""Only assemblies have such stops."""
CURVED_STOPS = (POWER_LAW, JANKOWSKI, FORMULA)


@register_jitable(**CHOSEN)
def stop_at(stop: int) -> int:
    """Where in the vector the numbers of a stop start: 0 is the right stop, 1 the left one."""
    return BUMPER + WIDTH * stop


class Drive(NamedTuple):
    """What shakes the mass, but for its size and frequency.

    Attributes
    ----------
    base
        1 if the base moves, 0 if a force acts on the mass.
    scale, power
        A_t has the amplitude: the given size · scale · ω^power. The base acceleration itself has
        1 and 0; a displacement of the base has −1 and 2, a force −1/M and 0, and an unbalance −1/M
        and 2.
    weights
        Of sin nθ and cos nθ, n from 1 on, if there are several harmonics.
    interval
        Between the samples of a record (s); None if there is none.
    """

    base: float = 1.0
    scale: float = 1.0
    power: float = 0.0
    weights: tuple[tuple[float, float], ...] = ()
    interval: float | None = None


_PER_MASS = (CUBIC, QUINTIC, SINH, HYSTERETIC, FRICTION)


def rig_vector(
    mass: float,
    stiffness: float,
    damping: float,
    right: StopNumbers | None,
    left: StopNumbers | None,
    load: float = 0.0,
    drive: Drive = Drive(),  # noqa: B008 (it is immutable)
    law: IsolatorNumbers = IsolatorNumbers(),  # noqa: B008
) -> NDArray[np.float64]:
    """Pack a rig for the kernels.

    Parameters
    ----------
    mass, stiffness, damping : float
        M (kg), K (N/m) and C (N s/m) of the mass and its isolator.
    right, left : tuple of float or None
        Each stop; None where there is none.
    load : float
        Constant force on the mass (N).
    drive : Drive
        What shakes it.
    law : IsolatorNumbers
        What the isolator does besides.

    Returns
    -------
    ndarray of float, shape (SIZE,), or longer if there are several harmonics
    """
    vector = np.zeros(WEIGHTS + 2 * len(drive.weights) if drive.weights else SIZE)
    vector[LOAD] = load / mass
    *numbers, own = law
    vector[CUBIC : DRAG + 1] = numbers
    curved = any(isinstance(stop, PowerLaw | OwnStop) for stop in (right, left))
    vector[CURVED] = curved or law != IsolatorNumbers()
    vector[OWN : OWN + len(own)] = own
    vector[OWN + OWN_STIFFNESS] /= mass
    for at in _PER_MASS:
        vector[at] /= mass
    vector[BASE], vector[SCALE], vector[POWER] = drive.base, drive.scale, drive.power
    vector[HARMONICS], vector[INTERVAL] = max(len(drive.weights), 1), np.inf
    if drive.weights:
        vector[FORCING], vector[WEIGHTS:] = SEVERAL, np.ravel(drive.weights)
    if drive.interval is not None:
        vector[FORCING], vector[INTERVAL] = RAMP, drive.interval
    vector[STIFFNESS] = stiffness / mass
    vector[DAMPING] = damping / mass
    for i, stop in enumerate((right, left)):
        at = stop_at(i)
        vector[at + GAP] = stop[-1] if stop else np.inf
        vector[at + RATE] = np.inf
        if stop is None:
            continue
        if isinstance(stop, OwnStop):
            block = OWN + OWN_WIDTH * (i + 1)
            vector[at + KIND], vector[block : block + OWN_WIDTH] = FORMULA, stop.own
            vector[block + OWN_STIFFNESS] /= mass
            continue
        if isinstance(stop, Wall) or len(stop) == 2:
            place = at + REBOUND
            vector[at + KIND], vector[place : place + rebound.WIDTH] = RIGID, rebound.written(stop)
            continue
        if isinstance(stop, MemoryStop):
            place = at + REBOUND
            vector[at + KIND], vector[place : place + 1 + memory_laws.NUMBERS] = (
                MEMORY,
                memory_laws.written(stop),
            )
            continue
        if isinstance(stop, PowerLaw):
            vector[at + KIND] = JANKOWSKI if stop.viscous else POWER_LAW
            vector[at + BUMPER_STIFFNESS] = stop.stiffness / mass
            vector[at + BUMPER_DAMPING] = stop.viscous / mass
            vector[at + EXPONENT], vector[at + DISSIPATION] = stop.exponent, stop.dissipation
            continue
        bumper_stiffness, bumper_damping, _ = stop
        vector[at + KIND] = KELVIN_VOIGT
        vector[at + BUMPER_STIFFNESS] = bumper_stiffness / mass
        vector[at + BUMPER_DAMPING] = bumper_damping / mass
        if bumper_damping:
            vector[at + RATE] = bumper_stiffness / bumper_damping
    vector[[OWN + OWN_WIDTH * i + OWN_PER_MASS for i in range(3)]] = 1.0 / mass
    return vector


def free_rig() -> NDArray[np.float64]:
    """A rig without stops, of unit mass and stiffness."""
    return rig_vector(1.0, 1.0, 0.0, None, None)


LINEAR, BENT, YIELDING = range(3)
"""What the laws of a rig are: all linear; curved; linear but where an isolator yields or slides."""


def laws(rig: NDArray[np.float64]) -> int:
    """Return the laws of a rig by its vector; where stops overlap, yielding laws count as bent."""
    if not rig[CURVED]:
        return LINEAR
    right, left = stop_at(0), stop_at(1)
    if rig[right + KIND] in CURVED_STOPS or rig[left + KIND] in CURVED_STOPS:
        return BENT
    if rig[right + GAP] + rig[left + GAP] < 0.0 or rig[DRAG] != 1.0:
        return BENT
    if rig[CUBIC] or rig[QUINTIC] or rig[SINH] or rig[OWN]:
        return BENT
    yields = rig[HYSTERETIC] != 0.0 and rig[YIELD] < np.inf
    slides = rig[FRICTION] != 0.0
    return YIELDING if (yields and not slides) or (slides and not rig[HYSTERETIC]) else BENT
