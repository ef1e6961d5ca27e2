"""The static equilibrium: the position of the mass if nothing shakes it.

The force of a first, slow loading from u = 0 is

    isolator(u) + right(u - G_R) - left(-u - G_L),

where each stop can only push. This force rises with u as long as the force of the isolator rises,
and rigid stops limit u. Therefore it equals the constant force at only one displacement. If there
is no constant force and no gap is negative, this displacement is u = 0. If friction can hold the
mass at u = 0, the mass stays there. Without a spring, the mass can stay at any place between its
stops, and u = 0 is returned.
"""

from __future__ import annotations

import math
from itertools import product
from typing import overload

from vibroimpact.errors import InputError
from vibroimpact.model.assembly import Assembly, AssemblyState
from vibroimpact.model.assembly.equilibrium import equilibrium as of_assembly
from vibroimpact.model.isolators import FrictionIsolator, Isolator
from vibroimpact.model.oscillator import Oscillator
from vibroimpact.model.quantities import FORCE, LENGTH
from vibroimpact.model.state import State
from vibroimpact.model.stops import Bumper, WallLaw
from vibroimpact.model.system import System
from vibroimpact.model.units import pretty


@overload
def equilibrium(system: Oscillator) -> State: ...
@overload
def equilibrium(system: Assembly) -> AssemblyState: ...
@overload
def equilibrium(system: System) -> State | AssemblyState: ...
def equilibrium(system: System) -> State | AssemblyState:
    """Return the state of rest that a slow loading from u = 0 reaches.

    Parameters
    ----------
    system
        The oscillator or the assembly. Its base is at rest.

    Returns
    -------
    State or AssemblyState
        The displacement, with zero velocity. The other values follow from the rig: a bumper is
        compressed as far as the mass penetrates into it.

    Raises
    ------
    InputError
        If a softening isolator or link does not hold the mass.

    Examples
    --------
    >>> from vibroimpact.model import Bumper, Isolator, Oscillator
    >>> equilibrium(Oscillator(1.0, Isolator(1.0, 0.1), Bumper(3.0, 0.1, -0.4))).displacement
    -0.3
    """
    if isinstance(system, Assembly):
        return of_assembly(system)
    assert isinstance(system, Oscillator)
    oscillator = system
    linear = isinstance(oscillator.isolator, Isolator) and all(
        isinstance(stop, Bumper | WallLaw) for stop in oscillator.stops.values()
    )
    u = _by_stiffness(oscillator) if linear else _by_root(oscillator)
    return State(u, isolator=oscillator.isolator.remembered(u))


def _by_stiffness(oscillator: Oscillator) -> float:
    """The displacement of a linear spring between linear stops, in closed form."""
    assert isinstance(oscillator.isolator, Isolator)
    if oscillator.force == 0.0 and all(stop.gap >= 0.0 for stop in oscillator.stops.values()):
        return 0.0  # nothing pushes, as on most rigs of a map
    spring = oscillator.isolator.stiffness
    sides = [(1, oscillator.right), (-1, oscillator.left)]
    bumpers = [(side, stop) for side, stop in sides if isinstance(stop, Bumper)]

    def at_rest(pressed: tuple[bool, ...]) -> tuple[float, float]:
        """How far a bumper is from agreeing, and the displacement, if these are pressed."""
        pairs = list(zip(pressed, bumpers, strict=True))
        stiffness = sum(stop.stiffness for yes, (_, stop) in pairs if yes)
        push = sum(side * stop.stiffness * stop.gap for yes, (side, stop) in pairs if yes)
        push += oscillator.force
        stiffness += spring
        u = push / stiffness if stiffness else math.copysign(math.inf, push) if push else 0.0
        depths = [(yes, side * u - stop.gap) for yes, (side, stop) in pairs]
        return max((-depth if yes else depth for yes, depth in depths), default=0.0), u

    # Of all ways to press them one agrees; on the border of two, both give the same u.
    _, u = min(at_rest(pressed) for pressed in product((False, True), repeat=len(bumpers)))
    if isinstance(oscillator.right, WallLaw):
        u = min(u, oscillator.right.gap)
    if isinstance(oscillator.left, WallLaw):
        u = max(u, -oscillator.left.gap)
    return u


def _by_root(oscillator: Oscillator) -> float:
    """The displacement for any laws: the first root on the way out from where it is let go."""
    right, left, isolator = oscillator.right, oscillator.left, oscillator.isolator
    high = right.gap if isinstance(right, WallLaw) else math.inf
    low = -left.gap if isinstance(left, WallLaw) else -math.inf
    begin = max(low, min(high, 0.0))

    def stops(u: float) -> float:
        force = 0.0
        if right is not None and not isinstance(right, WallLaw):
            force += right.static_force(u - right.gap)
        if left is not None and not isinstance(left, WallLaw):
            force -= left.static_force(-u - left.gap)
        return force

    friction = isolator.friction if isinstance(isolator, FrictionIsolator) and not begin else 0.0
    push = oscillator.force - stops(begin)
    if not begin:
        if abs(push) <= friction:
            return begin
    else:
        push -= isolator.static_force(begin)
    side = math.copysign(1.0, push)
    end = high if side > 0.0 else low
    if push == 0.0 or begin == end:
        return begin

    def excess(way: float) -> float:
        """What still pushes outwards, `way` beyond the beginning."""
        u = begin + side * way
        return side * (oscillator.force - stops(u) - isolator.static_force(u))

    most = min(abs(end - begin), isolator.reach + abs(begin))
    way = min(most, _scale(oscillator, push))
    while excess(way) > 0.0:
        if way >= most:
            if most < abs(end - begin):
                raise InputError(
                    "isolator: it softens, and its largest force, "
                    f"{pretty(isolator.strongest, FORCE)} at {pretty(isolator.reach, LENGTH)}, "
                    f"does not balance the force of {pretty(abs(push), FORCE)} on the mass; reduce "
                    "the constant force or the preload of the stops"
                )
            return end
        way = min(2.0 * way, most)
    if way == 0.0:
        return begin
    from scipy.optimize import brentq

    # At the beginning friction, of which a first loading has all, may push back.
    least = math.ldexp(way, -1074) or math.ulp(0.0)
    if excess(least) <= 0.0:
        return begin
    return begin + side * float(brentq(excess, least, way, xtol=1e-300, rtol=1e-15, maxiter=2000))


def _scale(oscillator: Oscillator, push: float) -> float:
    """A length to begin the search with, in m."""
    stiffness = oscillator.isolator.initial_stiffness
    length = abs(push) / stiffness if stiffness else 0.0
    return length if 0.0 < length < math.inf else 1e-3
