"""A leap: the motion over a time some four times as long as a step's, known at sixteen nodes.

At each node the acceleration follows from the state there, and the states from the integrals of
the accelerations: begun with a parabola and put in one another, some eight times, they agree to
rounding. Nothing but the forces themselves is asked for, so that all nodes are computed at once.
Between the nodes the motion is the polynomial through them, whose last terms say whether it is
right; if not, or if what ends the leap is not plain to see (`crossing`), steps do it.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import count, wave
from vibroimpact.engine.forcing.several import raised
from vibroimpact.engine.jit import Vector, inlined, kernel
from vibroimpact.engine.linear.layout import MOST
from vibroimpact.engine.motion import Clock
from vibroimpact.engine.taylor.frame import Branch, Frame
from vibroimpact.engine.taylor.layout import (
    NODES,
    NODES_A,
    NODES_P,
    NODES_R,
    NODES_SHAKEN,
    NODES_V,
    NODES_Z,
    SPECTRA,
)
from vibroimpact.engine.taylor.nodes import (
    COSINES,
    COUNT,
    END_OF_ONE,
    END_OF_TWO,
    FADING,
    PLACES,
    SINES,
    integral,
    nodewise,
    spectrum,
    twice,
)

ROUNDS = 24
"""Most often that states and accelerations are put in one another."""

AGREED = 2.0**-51
"""A change of the motion, as a share of its size, behind which the next is below rounding."""

_RESOLVED = 2.0**-52
"""The last term of the velocity, as a share of its size, whose next is below rounding."""

_NEAR, _FAR = 4, 8

FADES = 2.0

SPECTRUM_A = SPECTRA + 3 * COUNT
SPECTRUM_R = SPECTRA + 4 * COUNT


class Forces(NamedTuple):
    """What acts on the mass in a mode and on a branch: all but the shaking."""

    offset: float
    stiffness: float
    damping: float
    cubic: float
    quintic: float
    hysteretic: float
    drag: float
    slope: float
    bend: float


@kernel
def forces_of(plan: Vector, frame: Frame, branch: Branch) -> Forces:
    """The forces of a mode's own coordinate."""
    drag = plan[par.DAMPING] * branch.way if plan[par.DRAG] == 2.0 else 0.0
    return Forces(
        frame.offset,
        frame.stiffness,
        frame.damping,
        plan[par.CUBIC],
        plan[par.QUINTIC],
        plan[par.HYSTERETIC],
        drag,
        branch.slope,
        branch.bend,
    )


def pull(
    x: Any,
    v: Any,
    z: Any,
    offset: Any,
    stiffness: Any,
    damping: Any,
    cubic: Any,
    quintic: Any,
    hysteretic: Any,
    drag: Any,
) -> Any:
    """What the forces pull back with, as a formula."""
    u = x + offset
    squared = u * u
    along = stiffness * x + v * (damping + drag * v) + hysteretic * z
    return along + (u * squared) * (cubic + quintic * squared)


@inlined
def own(forces: Forces) -> tuple[float, float, float, float, float, float, float]:
    """The numbers of the forces, as the formulae take them."""
    return (
        forces.offset,
        forces.stiffness,
        forces.damping,
        forces.cubic,
        forces.quintic,
        forces.hysteretic,
        forces.drag,
    )


_one_pull = inlined(pull)


@inlined
def pulled(forces: Forces, x: float, v: float, z: float) -> float:
    """What the forces pull back with."""
    return _one_pull(x, v, z, *own(forces))  # type: ignore[no-any-return]


def _accelerated(shaken: Any, x: Any, v: Any, z: Any, *numbers: Any) -> Any:
    return shaken - pull(x, v, z, *numbers)


_accelerate = nodewise(_accelerated, (NODES_SHAKEN, NODES, NODES_V, NODES_Z), NODES_A)
steadied = nodewise(lambda place, steady: place * 0.0 + steady, (PLACES,), NODES_SHAKEN)
_line = nodewise(
    lambda shaken, place, now, after: shaken + (now + after * place),
    (NODES_SHAKEN, PLACES),
    NODES_SHAKEN,
)
_angle = nodewise(lambda place, angle: angle * (place - 0.5), (PLACES,), NODES_P)


def _waved(shaken: Any, angle: Any, now: Any, after: Any) -> Any:
    square = angle * angle
    return shaken + (now * COSINES(square) + after * (angle * SINES(square)))


waves = nodewise(_waved, (NODES_SHAKEN, NODES_P), NODES_SHAKEN)
"""Add now cos + after sin of the angles at NODES_P, up to 1 rad, to the shaking."""


def _ahead(place: Any, h: Any, x: Any, v: Any, a: Any, first: Any, second: Any) -> Any:
    t = place * h
    return x + t * (v + t * (0.5 * a + t * (first * (1 / 6) + t * (second * (1 / 24)))))


def _ahead_v(place: Any, h: Any, v: Any, a: Any, first: Any, second: Any) -> Any:
    t = place * h
    return v + t * (a + t * (0.5 * first + t * (second * (1 / 6))))


_guess = nodewise(_ahead, (PLACES,), NODES)
_guess_v = nodewise(_ahead_v, (PLACES,), NODES_V)
_guess_z = nodewise(lambda x, z, rate, start: z + rate * (x - start), (NODES,), NODES_Z)


def saturated(x: Any, z: Any, rate: Any, half_bend: Any, start: Any) -> Any:
    """Z where the mass is at x, from where it was at `start`, as a formula."""
    gone = x - start
    y = half_bend * gone
    half = FADING(y)
    return z + (rate * gone) * (half * (1.0 - 0.5 * (y * half)))


_saturate = nodewise(saturated, (NODES,), NODES_Z)
_flow = nodewise(lambda z, v, slope, bend: v * (slope - bend * z), (NODES_Z, NODES_V), NODES_R)


@kernel
def shake_nodes(plan: Vector, frame: Frame, steady: float, clock: Clock, h: float) -> None:
    """Write `steady` − sign A_t at the nodes."""
    steadied(plan, (steady,))
    sn, cn = clock
    for part in range(1, count(plan) + 1):
        amplitude, rate, closes, sine, cosine = wave(plan, part, False)
        amplitude *= -frame.sign
        angle = rate * h
        now = amplitude * (sine * sn + cosine * cn)
        after = amplitude * (sine * cn - closes * cosine * sn)
        if closes == 0.0:
            _line(plan, (now, after * angle))
        else:
            s, c = math.sin(0.5 * angle), math.cos(0.5 * angle)
            now, after = now * c + after * s, after * c - now * s
            _angle(plan, (angle,))
            waves(plan, (now, after))
        sn, cn = raised(clock[0], clock[1], sn, cn)


@kernel
def begun(
    plan: Vector,
    forces: Forces,
    x: float,
    v: float,
    z: float,
    a: float,
    h: float,
    rate: float,
) -> None:
    """Write a first guess at the nodes: a parabola of the acceleration, from the slopes here.

    Those of the shaking are told by its values at three places: it is a guess.
    """
    now = a + pulled(forces, x, v, z)
    near, far = h * PLACES[_NEAR], h * PLACES[_FAR]
    shaking = (plan[NODES_SHAKEN + _NEAR] - now) / near
    bend = 2.0 * ((plan[NODES_SHAKEN + _FAR] - now) / far - shaking) / (far - near)
    shaking -= 0.5 * bend * near
    u = x + forces.offset
    k = forces.stiffness + forces.hysteretic * rate
    k += u * u * (3.0 * forces.cubic + 5.0 * forces.quintic * u * u)
    bent = u * (6.0 * forces.cubic + 20.0 * forces.quintic * u * u)
    c = forces.damping + 2.0 * forces.drag * v
    first = shaking - k * v - c * a
    second = bend - k * a - bent * v * v - c * first
    _guess(plan, (h, x, v, a, first, second))
    _guess_v(plan, (h, v, a, first, second))
    _guess_z(plan, (z, rate, x))


@inlined
def bent_by(forces: Forces, z: float) -> float:
    """z′/x′."""
    return forces.slope - forces.bend * z


@inlined
def flowing(plan: Vector, forces: Forces) -> None:
    """Write z′ at the nodes."""
    _flow(plan, (forces.slope, forces.bend))


@inlined
def extent(plan: Vector, z: float) -> float:
    """How large z is on this leap."""
    ahead = max(abs(plan[NODES_Z + 3]), abs(plan[NODES_Z + 8]), abs(plan[NODES_Z + COUNT - 1]))
    most: float = max(abs(z), ahead) + 1e-300
    return most


@kernel
def remembered(plan: Vector, forces: Forces, x: float, z: float) -> float:
    """Write z at the nodes; return how much it has changed, as a share of its size.

    It follows from x: z = z0 + r d φ(b d), d = x − x0, r = s − b z0 and φ(y) = (1 − exp(−y))/y.
    """
    before = seen(plan)
    _saturate(plan, (z, bent_by(forces, z), 0.5 * forces.bend, x))
    return changed(plan, before, z)


@inlined
def seen(plan: Vector) -> tuple[float, float, float]:
    """Z at three nodes: it saturates, so that its end says nothing of how it got there."""
    return plan[NODES_Z + COUNT - 1], plan[NODES_Z + 8], plan[NODES_Z + 3]


@inlined
def changed(plan: Vector, before: tuple[float, float, float], z: float) -> float:
    """How much z has changed at these, as a share of its size."""
    now = seen(plan)
    change = abs(now[0] - before[0]) + abs(now[1] - before[1]) + abs(now[2] - before[2])
    return change / extent(plan, z)


@kernel
def leapt(
    plan: Vector, forces: Forces, x: float, v: float, z: float, a: float, h: float, unit: float
) -> float:
    """Find the motion at the nodes of the next h seconds, from this state.

    `a` is the acceleration now, `unit` a time in which the motion changes (s).

    Returns
    -------
    float
        Above 1 if the leap was too long: the last term of its polynomial over what is allowed.
    """
    hysteretic = forces.hysteretic != 0.0
    size = max(abs(x + forces.offset), abs(v) * unit, plan[MOST] * unit * unit) + 1e-300
    rate = bent_by(forces, z)
    begun(plan, forces, x, v, z, a, h, rate)
    middle = COUNT // 2
    before = 1e-300
    for _ in range(ROUNDS):
        _accelerate(plan, own(forces))
        last, half = plan[NODES + COUNT - 1], plan[NODES + middle]
        integral(plan, NODES_A, NODES_V, h, v, 0.0)
        twice(plan, NODES_A, NODES, h * h, x, v * h)
        change = abs(plan[NODES + COUNT - 1] - last) + abs(plan[NODES + middle] - half)
        if hysteretic:
            change += size * remembered(plan, forces, x, z)
        # Changes shrink ever faster: the next one is below this one's share of the last one.
        if not change * min(change / before, 0.25) > 0.25 * AGREED * size:
            break
        before = change
    else:
        return 4.0
    _accelerate(plan, own(forces))
    integral(plan, NODES_A, NODES_V, h, v, 0.0)
    if hysteretic:
        # `FADING` is right up to there.
        if not abs(forces.bend * (plan[NODES + COUNT - 1] - x)) < FADES:
            return 4.0
        flowing(plan, forces)
    return excess_of(plan, h * unit / size, hysteretic, z, h)


@kernel
def excess_of(plan: Vector, weight: float, hysteretic: bool, z: float, h: float) -> float:
    """Write the spectra of the rates; return their last terms over what is allowed."""
    spectrum(plan, NODES_A, SPECTRUM_A, 1.0, 0.0, 0.0)
    tail = abs(plan[SPECTRUM_A + COUNT - 1]) + 0.125 * abs(plan[SPECTRUM_A + COUNT - 2])
    tail *= weight
    if hysteretic:
        spectrum(plan, NODES_R, SPECTRUM_R, 1.0, 0.0, 0.0)
        last = abs(plan[SPECTRUM_R + COUNT - 1]) + 0.125 * abs(plan[SPECTRUM_R + COUNT - 2])
        tail += last * h / extent(plan, z)
    excess: float = tail / (4.0 * COUNT * _RESOLVED)
    return excess if excess == excess else 4.0


@kernel
def landed(
    plan: Vector, forces: Forces, x: float, v: float, z: float, h: float
) -> tuple[float, float, float]:
    """The state at the end of the leap."""
    one, two, three = 0.0, 0.0, 0.0
    for i in range(COUNT):
        one += END_OF_ONE[i] * plan[NODES_A + i]
        two += END_OF_TWO[i] * plan[NODES_A + i]
    if forces.hysteretic != 0.0:
        for i in range(COUNT):
            three += END_OF_ONE[i] * plan[NODES_R + i]
    return x + h * (v + h * two), v + h * one, z + h * three
