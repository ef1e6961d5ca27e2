"""The numbers of the laws in a mode, and for how long the forces are these."""

from __future__ import annotations

import math

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.acceleration import places
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved.branches import side_of, way_of_slide
from vibroimpact.engine.assembly.curved.terms import (
    accelerations_of_all,
    expand_all,
    first,
    node,
    row_of,
)
from vibroimpact.engine.assembly.events import closing, speeds
from vibroimpact.engine.assembly.rates import HEAD, rates_of_mode
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.series.layout import NAMES
from vibroimpact.engine.series.values import Push
from vibroimpact.engine.stops.curved import EVEN, pressing, shallow
from vibroimpact.engine.taylor.laws import slowness

_UNMET = 1e-12
"""Share of the motion's speed. A stop that is met no faster has not been met: the dissipation that
its restitution makes of that speed is 0."""

_GRAIN = 2.0**-49

(
    _K, _C, _OFFSET, _CUBIC, _QUINTIC, _SINH, _STEEP, _HYSTERETIC, _SLOPE, _BEND, _DRAG, _POWER,
    _PUSH, _PUSH_N, _PUSH_CHI, _PUSH_C, _OTHER_K, _OTHER_N, _OTHER_CHI, _OTHER_C, _APART, _LOAD,
    _RATE, _WAY, _CLOSING, _SIDE, _PER_UNIT, _OWN_WEIGHT,
) = range(of.NAMES, of.NAMES + len(NAMES))  # fmt: skip
_LAW = of.NUMBERS
_STOP = of.NUMBERS + par.BUMPER


@kernel
def size_of(plan: Vector, y: Vector) -> float:
    """The size of a motion, as a velocity (m/s): what its parts and what drives it make."""
    n, w, rate = int(plan[at.MASSES]), int(plan[at.WAVES]), plan[at.STIFF_RATE]
    most = 0.0
    for i in range(n):
        driven = abs(plan[int(plan[at.CONSTANT]) + i])
        for q in range(w):
            driven += abs(plan[int(plan[at.PUSH]) + i * w + q] * y[2 * n + q])
        most = max(most, abs(y[n + i]), rate * abs(y[i]), driven / rate)
    if most == 0.0:  # at rest, where nothing but a stop is about to move them
        for f in range(int(plan[at.STOPS])):
            one = int(plan[at.STOP]) + f * at.STOP_WIDTH
            if int(plan[at.MODE]) >> f & 1 and plan[one + at.KIND] != at.LINK:
                most = max(most, rate * (closing(plan, f, y) - plan[one + at.GAP]))
    return most


@kernel
def _quickest(plan: Vector, f: int) -> float:
    """A bound on how fast what drives the masses changes a closing acceleration (m/s³)."""
    n, w = int(plan[at.MASSES]), int(plan[at.WAVES])
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    total = 0.0
    for end in (at.LEFT, at.RIGHT):
        i = int(plan[one + end])
        if i < n:
            for q in range(w):
                turn = 1.0 if plan[at.RECORD] != 0.0 else plan[at.OMEGA] * (q // 2 + 1)
                total += abs(plan[int(plan[at.PUSH]) + i * w + q]) * turn
    if plan[at.RECORD] != 0.0:
        total *= abs(plan[int(plan[at.Y]) + 2 * n + 1])
    return total


@kernel
def _link_numbers(plan: Vector, f: int, row: int, mode: int, z: float) -> None:
    behaviour = int(plan[row + of.BEHAVIOUR])
    way, side = 1.0, 1.0
    if plan[row + of.BRANCH] >= 0.0:
        way, side = way_of_slide(plan, f, mode), side_of(plan, f, mode)
    plan[row + _WAY], plan[row + _SIDE] = way, side
    if behaviour == of.SMOOTH:
        plan[row + _CUBIC], plan[row + _QUINTIC] = plan[row + _LAW + par.CUBIC], 0.0
        plan[row + _QUINTIC] = plan[row + _LAW + par.QUINTIC]
        plan[row + _SINH], plan[row + _STEEP] = (
            plan[row + _LAW + par.SINH],
            plan[row + _LAW + par.SINH_RATE],
        )
    elif behaviour == of.BILINEAR:
        plan[row + _HYSTERETIC] = plan[row + _LAW + par.HYSTERETIC]
        plan[row + _SLOPE] = 0.0 if side < 0.0 else plan[row + _LAW + par.SLOPE]
    elif behaviour == of.HYSTERETIC:
        plan[row + _HYSTERETIC] = plan[row + _LAW + par.HYSTERETIC]
        plan[row + _SLOPE] = plan[row + _LAW + par.SLOPE]
        knee, turning = plan[row + _LAW + par.KNEE], plan[row + _LAW + par.TURNING]
        if int(plan[row + _LAW + par.SHARPNESS]) % 2 == 1:
            plan[row + _BEND] = knee * side + turning * way
        else:
            plan[row + _BEND] = knee + turning * way * side
    elif behaviour == of.DRAG:
        plan[row + _DRAG] = way * plan[row + _LAW + par.DAMPING]
        plan[row + _POWER] = plan[row + _LAW + par.DRAG]


@kernel
def dissipation(plan: Vector, row: int, met: float, size: float) -> float:
    """χ of a stop that was met at a speed."""
    chi = plan[row + _STOP + par.DISSIPATION]
    if chi < 0.0:
        chi = -chi / met if met > _UNMET * size else 0.0
    coefficient: float = chi
    return coefficient


@kernel
def _is_held(plan: Vector, f: int) -> bool:
    """Whether friction or stops hold the two ends of a row: its own force does not part them."""
    if plan[at.RESTING] == 0.0:
        return False
    of_ = places(plan)
    rates, n = rates_of_mode(plan, of_), of_.masses
    column = rates.width + 1 + of_.pressed
    for g in range(f):
        if int(plan[row_of(plan, g) + of.BEHAVIOUR]) != 0:
            column += 1
    one, parts = of_.stops + f * at.STOP_WIDTH, 0.0
    sign = 1.0
    for end in (at.LEFT, at.RIGHT):
        i = int(plan[one + end])
        if i < n:
            parts += sign * plan[rates.place + i // 8 * rates.block + HEAD + 8 * column + i % 8]
        sign = -1.0
    return bool(parts == 0.0)


@not_inlined
def enter(plan: Vector, y: Vector, deformation: Vector, size: float) -> float:
    """Write the numbers of all laws for a step from a state; how long it may be by them (s)."""
    n, count, mode = int(plan[at.MASSES]), int(plan[at.STOPS]), int(plan[at.MODE])
    v = beyond(y, n)
    powers = False
    for f in range(count):
        row = row_of(plan, f)
        behaviour = int(plan[row + of.BEHAVIOUR])
        if behaviour == 0:
            continue
        plan[row + of.ACTIVE] = 1.0
        plan[row + _PER_UNIT], plan[row + _OWN_WEIGHT] = 1.0, 1.0
        if behaviour == of.MEMORY_STOP:
            plan[row + _OWN_WEIGHT] = 1.0 if mode >> f & 1 else 0.0
            continue
        if behaviour in (of.POWER, of.OWN_STOP):
            touched = mode >> f & 1 == 1
            plan[row + of.ACTIVE] = 1.0 if touched else 0.0
            powers |= touched
            rate = closing(plan, f, v)
            plan[row + _WAY] = -1.0 if rate < 0.0 else 1.0
            plan[row + _PUSH] = plan[row + _STOP + par.BUMPER_STIFFNESS]
            plan[row + _PUSH_N] = plan[row + _STOP + par.EXPONENT]
            plan[row + _PUSH_CHI] = dissipation(plan, row, deformation[f], size)
            plan[row + _PUSH_C] = plan[row + _STOP + par.BUMPER_DAMPING] if rate > 0.0 else 0.0
            continue
        _link_numbers(plan, f, row, mode, deformation[f])
        powers |= behaviour == of.DRAG and plan[row + _POWER] != 2.0
    if not powers:
        return math.inf
    place = int(plan[at.ROOM])
    accelerations_of_all(plan, y, deformation, place)
    longest = math.inf
    for f in range(count):
        row = row_of(plan, f)
        behaviour = int(plan[row + of.BEHAVIOUR])
        gains = closing(plan, f, beyond(plan, place))
        if behaviour == of.DRAG and plan[row + _POWER] != 2.0:
            if _is_held(plan, f):  # there is no velocity, nor will be while they are held
                plan[row + of.ACTIVE] = 0.0
                continue
            longest = min(longest, _drag(plan, f, row, -closing(plan, f, v), -gains))
        elif behaviour == of.POWER and plan[row + of.ACTIVE] != 0.0:
            longest = _power(plan, f, row, y, gains, longest)
    for f in range(count):
        row = row_of(plan, f)
        if int(plan[row + of.BEHAVIOUR]) == of.OWN_STOP and plan[row + of.ACTIVE] != 0.0:
            _number_formula(plan, f, row, y, deformation, closing(plan, f, beyond(plan, place)))
    return longest


@kernel
def _drag(plan: Vector, f: int, row: int, rate: float, gains: float) -> float:
    """Leave a drag out where it is nothing beside the others; how long that holds (s)."""
    n, w, i = int(plan[at.MASSES]), int(plan[at.WAVES]), 0
    meets = plan[int(plan[at.COUPLING]) + f * int(plan[at.STOPS]) + f]
    most = 0.0
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    for end in (at.LEFT, at.RIGHT):
        i = int(plan[one + end])
        if i < n:
            for q in range(w):
                most += abs(plan[int(plan[at.PUSH]) + i * w + q])
    unit = 1.0 / (plan[at.STIFF_RATE] + plan[at.HIGHEST] + 1e-300)
    drag = plan[row + _LAW + par.DAMPING] * meets
    grain = _GRAIN * speeds(plan, f, beyond(plan, int(plan[at.Y]) + n))
    little, longest, turning = slowness(
        abs(rate), abs(gains), most, unit, drag, plan[row + _POWER], grain
    )
    if abs(rate) <= little:
        plan[row + of.ACTIVE] = 0.0
    duration: float = min(longest, turning)
    return duration


@kernel
def _power(plan: Vector, f: int, row: int, y: Vector, gains: float, longest: float) -> float:
    """Leave a stop out that pulls, or is hardly pressed; how long that holds (s)."""
    n = int(plan[at.MASSES])
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    meets = plan[int(plan[at.COUPLING]) + f * int(plan[at.STOPS]) + f]
    rate, depth = closing(plan, f, beyond(y, n)), closing(plan, f, y) - plan[one + at.GAP]
    fresh = int(plan[int(plan[at.ZEROS]) + f])
    if fresh == of.RATE_FRESH:  # it turns: what is left of the rate, or of 1 + χ δ′, is rounding
        if plan[row + _STOP + par.BUMPER_DAMPING] != 0.0:
            rate = 0.0
            plan[row + _PUSH_C] = plan[row + _STOP + par.BUMPER_DAMPING] if gains > 0.0 else 0.0
        elif plan[row + _PUSH_CHI] > 0.0:
            rate = -1.0 / plan[row + _PUSH_CHI]
    push = Push(
        plan[row + _PUSH] * meets,
        plan[row + _PUSH_N],
        plan[row + _PUSH_CHI],
        plan[row + _PUSH_C] * meets,
    )
    grain = _GRAIN * (speeds(plan, f, y) + abs(plan[one + at.GAP]))
    left = pressing(push, rate, gains)
    left, longest = shallow(left, depth, rate, gains, _quickest(plan, f), grain, longest)
    if left.stiffness == 0.0:
        plan[row + of.ACTIVE] = 0.0
    duration: float = longest
    return duration


@kernel
def _number_formula(
    plan: Vector, f: int, row: int, y: Vector, deformation: Vector, gains: float
) -> None:
    """Whether a stop of a formula pushes: where that is above 0, or about to be."""
    n = int(plan[at.MASSES])
    one = int(plan[at.STOP]) + f * at.STOP_WIDTH
    rate = closing(plan, f, beyond(y, n))
    fresh = int(plan[int(plan[at.ZEROS]) + f])
    if fresh == of.RATE_FRESH:  # what is left of the rate is rounding
        plan[row + _WAY] = -1.0 if gains < 0.0 else 1.0
    point = int(plan[at.POINT])
    first(plan, row, int(plan[row + of.LAST_OP]), int(plan[row + of.LAST_SLOPE]), point)
    by_s, by_v = plan[node(plan, row, of.BY_S, point)], plan[node(plan, row, of.BY_V, point)]
    force, depth = (
        plan[node(plan, row, of.RAW_NODE, point)],
        plan[node(plan, row, of.S_NODE, point)],
    )
    # Where it is zero its terms are not, and by these it is rounded.
    grain = _GRAIN * (speeds(plan, f, y) + abs(plan[one + at.GAP]))
    even = EVEN * (abs(by_s * depth) + abs(by_v * rate)) + abs(by_s) * grain
    pushes = force > even
    # A root was found to the rounding of the step that led to it.
    if fresh == of.FORCE_FRESH or (not pushes and force >= -even):
        length = 1.0 / plan[at.STIFF_RATE]
        expand_all(plan, y, deformation, length, of.ORDER)
        raw, k = node(plan, row, of.RAW_NODE, int(plan[at.NODES])), 1
        while k < of.ORDER and plan[raw + k] == 0.0:
            k += 1
        pushes = plan[raw + k] > 0.0
    plan[row + _OWN_WEIGHT] = 1.0 if pushes else 0.0
