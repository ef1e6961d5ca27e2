"""How two disturbances grow under curved laws: carried on, and made orthogonal at each event."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.dispatch import stiff_rate
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.motion import LEFT, RIGHT, Stretch
from vibroimpact.engine.observers.growth import BOTH, DISSIPATION, FIRST
from vibroimpact.engine.observers.tangent import DISTURBANCE, MEMORY
from vibroimpact.engine.taylor.carry import carry


@kernel
def _weigh(plan: Vector, weight: float, mode: int, i: int) -> float:
    """Square of a component's weight in the norm; what only follows others counts nothing."""
    if i == 1:
        return 1.0
    if i in (2, 3):
        at = par.BUMPER + par.WIDTH * (i - 2)
        tied = mode & (RIGHT if i == 2 else LEFT) and plan[at + par.KIND] <= par.RIGID
        return 0.0 if tied else weight * weight
    if i == MEMORY and plan[par.HYSTERETIC] == 0.0:
        return 0.0
    return weight * weight


@kernel
def _product(plan: Vector, a: Vector, b: Vector, weight: float, mode: int) -> float:
    total = 0.0
    for i in range(DISTURBANCE):
        total += _weigh(plan, weight, mode, i) * a[i] * b[i]
    return total


@kernel
def start_growth(plan: Vector, q: Vector, w: Vector, weight: float, mode: int) -> None:
    """A disturbance of the displacement and one of the velocity, of unit size."""
    for i in range(DISTURBANCE):
        q[i], w[i] = 0.0, 0.0
    q[0], w[1] = 1.0 / weight, 1.0
    for side in range(1, 3):
        tied = plan[par.BUMPER + par.WIDTH * (side - 1) + par.KIND] <= par.RIGID
        if mode & side and tied:
            q[1 + side] = q[0]


@kernel
def _start_second(w: Vector, weight: float) -> None:
    """Start the second disturbance again; the first one goes on."""
    for i in range(DISTURBANCE):
        w[i] = 0.0
    w[0], w[1] = 1.0 / weight, 1.0


@kernel
def _unit(plan: Vector, a: Vector, weight: float, mode: int) -> float:
    """Bring a disturbance to unit size; return the logarithm of its size."""
    size = math.sqrt(_product(plan, a, a, weight, mode))
    if not size > 0.0:
        return -math.inf
    for i in range(DISTURBANCE):
        a[i] /= size
    return math.log(size)


@kernel
def grow(plan: Vector, notes: Vector, q: Vector, w: Vector, stretch: Stretch) -> None:
    """Carry both through one stretch."""
    weight = stiff_rate(plan)
    mode = stretch.after.mode
    lost = carry(plan, stretch, q, 1)
    carry(plan, stretch, w, 1)
    one = _unit(plan, q, weight, mode)
    common = _product(plan, q, w, weight, mode)
    for i in range(DISTURBANCE):
        w[i] -= common * q[i]
    two = _unit(plan, w, weight, mode)
    notes[FIRST] += one
    notes[BOTH] += one + two
    notes[DISSIPATION] += lost
    if one == -math.inf:  # a rest leaves nothing of either
        start_growth(plan, q, w, weight, mode)
    elif two == -math.inf:  # of one at most, such as what the isolator remembers
        _start_second(w, weight)
