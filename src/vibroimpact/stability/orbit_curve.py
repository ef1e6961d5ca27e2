"""The branch of orbits as a curve in the state and a parameter, with the changes of its contacts.

Where the contacts change (grazing) the map is continuous, but its derivative may jump: the branch
may have a corner there, and may turn back in it. The last orbit with the old contacts is found by
bisection of the step, to rounding; the derivative just beyond, and with it the new tangent,
follows from the map where it already has the new contacts; the branch goes on from there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from vibroimpact.continuation.arclength import distance, is_other_curve, predicted
from vibroimpact.continuation.closing import returned
from vibroimpact.engine.status import Status
from vibroimpact.response.engine_system import engine_system
from vibroimpact.stability.chatter import Rested, completed_elsewhere, placed_at_rest, rests
from vibroimpact.stability.fixed_points import (
    VALUE,
    Orbit,
    at_phase,
    beyond,
    corrected,
    evaluated,
    images,
    margin_of,
    seen_at,
)
from vibroimpact.stability.impact_grazing import at_wall, dies_out, has_rigid_stop, taken_up
from vibroimpact.stability.parent_branches import is_of_simpler_map, parent, shrinks_onto, simplest

_Array = NDArray[np.float64]

CLOSED = "it is closed"
"""Why a branch is not followed further that has come back to its first orbit."""
CONTINUUM = (
    "a multiplier stays 1, and motions next to an orbit, such as motions with another offset, are "
    "orbits too"
)
"""Why a branch is not followed further where orbits fill a surface."""
_APART, _NEUTRAL = 1e-4, 1e-9
"""Arclength between two orbits, and distance of a multiplier of both from 1, by which orbits are
not isolated: at a bifurcation a multiplier is 1 at one orbit only."""
_UNBOUNDED, _STANDS = 1e4, 1e-2
"""Distance from the first orbit, scaled, and share of the parameter's way so far that would be left
if the motion went on to grow as it does, by which it is reported to grow without bound."""
PHASES = (1.0, 2.1, 3.3, 0.4)
"""rad, by which the section is moved in turn."""
_TOUCHES = 1e-8  # scaled margin of an orbit that grazes, to rounding
_BISECTIONS = 55
_REST = 1e-12
"""Arclength between two orbits at rest whose contacts differ."""
_LOOK = 12  # bisections after which a grazing must show
_BEYOND = (1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7)
"""Scaled distances behind a grazing at which the map must have the new contacts."""
_RESTART = (1e-6, 1e-5, 1e-4, 1e-7, 1e-3)
"""Scaled distances after a grazing at which the branch is continued."""


@dataclass(frozen=True, eq=False)
class Station:
    """An orbit on a branch."""

    orbit: Orbit
    tangent: _Array
    """Unit tangent in scaled components."""
    arclength: float
    piece: int
    """Number of the smooth piece of the branch: it changes at every grazing."""
    grazing: bool = False
    """Whether it is the grazing orbit itself, at the end of its piece."""
    phases_tried: int = 0
    """How often the section was moved at this very orbit."""
    critical: bool = False
    """Whether it is a bifurcation at which a multiplier lies on the unit circle."""

    @property
    def y(self) -> _Array:
        """The state at the section, and the parameter."""
        return self.orbit.point


@dataclass(frozen=True, eq=False)
class OrbitBranch:
    """What is followed (see `continuation.arclength.Path`): orbits of one map along a parameter."""

    first: Station
    low: float
    high: float
    """Range of the parameter; the branch ends on it."""
    marks: dict[float, list[tuple[_Array, _Array]]] = field(default_factory=dict)
    """Sections of the first orbit, and the branch's tangents there, by the forcing's phase."""
    rested: Rested = field(default_factory=Rested)
    """The orbits along which the mass rests on a rigid stop."""

    @property
    def seen(self) -> _Array:
        """Components by which lengths and angles are measured."""
        return self.first.orbit.section.seen

    @property
    def scale(self) -> _Array:
        """Sizes of the state's components and the parameter."""
        return self.first.orbit.section.scale

    def stepped(self, here: Station, length: float) -> Orbit | None:
        """Predict and correct: an orbit of the same branch, whatever its contacts."""
        section = here.orbit.section
        aim, normal = predicted(self, here, length), here.tangent
        mode = here.orbit.mode
        bound = min(max(aim[VALUE], self.low), self.high)
        limited = section.family.parameter.most is not None or not section.family.straight
        if limited and bound not in (aim[VALUE], here.orbit.value):
            # Beyond the bound there may be no such rig.
            length = (bound - here.orbit.value) / (here.tangent[VALUE] * self.scale[VALUE])
            aim, normal = predicted(self, here, length), section.held
            aim[VALUE] = bound
        status, orbit = corrected(section, aim, mode, normal)
        if (
            status is not Status.DONE
            or is_other_curve(self, orbit.point, aim, length)
            or is_of_simpler_map(orbit)
        ):
            return None
        return placed_at_rest(orbit)

    def step(self, here: Station, length: float) -> tuple[Station | None, bool]:
        """See `Path`."""
        orbit = self.stepped(here, length)
        if orbit is None:
            return None, False
        if orbit.contacts != here.orbit.contacts:
            return None, True
        return self._after(here, orbit), False

    def _after(self, here: Station, orbit: Orbit) -> Station:
        arclength = here.arclength + distance(self, orbit.point, here.y)
        return Station(orbit, orbit.tangent(here.tangent), arclength, here.piece)

    def end(self, here: Station, there: Station) -> tuple[list[Station], str] | None:
        """See `Path`."""
        value, written = there.orbit.value, there.orbit.section.family.written
        if not self.low <= value <= self.high:
            bound = self.low if value < self.low else self.high
            return self._on_bound(here, bound), f"the range ends at {written(bound, 9)}"
        if value in (self.low, self.high):
            return [there], f"the range ends at {written(value, 9)}"
        if is_of_simpler_map(there.orbit):
            # The impacts by which it differed are gone: beyond, the same orbits come again.
            return [replace(there, tangent=-here.tangent)], _born_grazing(simplest(there.orbit))
        if self.rested.repeats(here.orbit):
            return (
                [],
                f"beyond {here.orbit.place}, the branch repeats the orbits in which the mass "
                "comes to rest",
            )
        if self._returned(here, there):
            return [there], CLOSED
        if there.arclength - here.arclength >= _APART and neutral(here) and neutral(there):
            return [], f"orbits are not isolated beyond {here.orbit.place}: {CONTINUUM}"
        if (pole := self._pole(here, there)) is not None:
            return [there], pole
        met = None if here.orbit.section.count % 2 else parent(here.orbit, there.orbit)
        if met is not None:
            # Beyond, the same orbits come again, half a period later.
            cycles = met.section.count
            return [there], f"it meets the orbits of period {cycles} at {met.place}"
        return None

    def _pole(self, here: Station, there: Station) -> str | None:
        """Why a branch ends whose motion grows towards a value that the parameter never passes.

        As beside the resonance of a linear rig without damping, the size is taken to grow in
        inverse proportion to the distance from that value.
        """
        first, times = self.first.y, distance(self, there.y, self.first.y)
        growth = times - distance(self, here.y, first)
        if times < _UNBOUNDED or not growth > 0.0:
            return None
        value = there.orbit.value
        left = times * (value - here.orbit.value) / growth
        if abs(left) > _STANDS * abs(value - self.first.orbit.value):
            return None
        near = there.orbit.section.family.equation(value + left)
        damped = engine_system(there.orbit.rig.system).has_dashpot
        beyond = f"beyond {times:.1g} times the first orbit" if damped else "without bound"
        limit = "damping may limit it" if damped else f"{times:.1g} times the first orbit"
        return f"the motion grows {beyond} near {near} ({limit})"

    def _on_bound(self, here: Station, value: float) -> list[Station]:
        """The orbit at the end of the range, if there is one."""
        share = (value - here.orbit.value) / (here.tangent[VALUE] * self.scale[VALUE])
        point = predicted(self, here, share)
        point[VALUE] = value
        mode = here.orbit.mode
        status, orbit = corrected(here.orbit.section, point, mode)
        if status is not Status.DONE or orbit.contacts != here.orbit.contacts:
            return []
        return [self._after(here, orbit)]

    def _returned(self, here: Station, there: Station) -> bool:
        """Whether a step has passed the first orbit, seen a whole number of cycles later or not."""
        if there.orbit.contacts != self.first.orbit.contacts:
            return False
        section = there.orbit.section
        phase = section.family.phase
        if here.orbit.section.family.phase != phase:
            return False
        if phase not in self.marks:
            self.marks[phase] = list(self._marks(phase))
        mode = there.orbit.mode

        def solved(guess: _Array, normal: _Array) -> _Array | None:
            status, orbit = corrected(section, guess, mode, normal)
            return orbit.point if status is Status.DONE else None

        return returned(self, here, there, self.marks[phase], solved)

    def _marks(self, phase: float) -> list[tuple[_Array, _Array]]:
        first = self.first.orbit
        turned = first.section.turned(phase)
        start = seen_at(first, phase)
        if start is None:
            return []
        status, seen, _ = evaluated(turned, *start)
        if status is not Status.DONE:
            return []
        marks = []
        for image, mode in images(seen, mirrored=False):
            status, orbit, _ = evaluated(turned, image, mode)
            if status is not Status.DONE:
                break
            # The parameter is the same for all of them, and so is its sense.
            tangent = orbit.tangent(turned.held)
            sense = math.copysign(1.0, tangent[VALUE] * self.first.tangent[VALUE])
            marks.append((image, sense * tangent))
        return marks

    def in_other_coordinates(self, here: Station) -> Station | None:
        """See `Path`: at another section, for where an event falls on it there is a corner."""
        for number in range(here.phases_tried, len(PHASES)):
            orbit = at_phase(here.orbit, here.orbit.section.family.phase + PHASES[number])
            if orbit is None or orbit.contacts != here.orbit.contacts:
                continue
            tangent = orbit.tangent(orbit.section.held * math.copysign(1.0, here.tangent[VALUE]))
            return Station(orbit, tangent, here.arclength, here.piece, phases_tried=number + 1)
        return None

    def lost(self, here: Station) -> str:
        """See `Path`."""
        if (met := shrinks_onto(here.orbit)) is not None:
            return _born_grazing(met)
        return beyond(here.orbit, "orbit", here.orbit.place)

    def corner(self, here: Station, length: float) -> list[Station]:
        """See `Path`: the last orbit with the contacts of `here`, and one just after it."""
        contacts = here.orbit.contacts
        if (passed := self._through_rest(here, length)) is not None:
            return passed
        rigid = has_rigid_stop(here.orbit)
        back = replace(here, tangent=-here.tangent)
        if rigid and (met := dies_out(here.orbit, lambda length: self.stepped(back, length))):
            clear, sense = met
            arclength = here.arclength + distance(self, clear.point, here.y)
            return [
                Station(
                    clear,
                    clear.tangent(sense * clear.section.held),
                    arclength,
                    here.piece + 1,
                    True,
                )
            ]
        good, bad = 0.0, length
        last = here.orbit
        margin = margin_of(last)
        # Just behind the grazing of a rigid stop the way back is no way on.
        grazing = abs(margin) < _TOUCHES and not (rigid and margin < 0.0)
        for number in range(_BISECTIONS):
            middle = 0.5 * (good + bad)
            if middle in (good, bad):
                break
            if number == _LOOK and not near_other_contacts(last, here.tangent, 4.0 * (bad - good)):
                if grazing:
                    break
                return []  # the step failed for another reason
            orbit = self.stepped(here, middle)
            if orbit is not None and orbit.contacts == contacts:
                good, last = middle, orbit
            else:
                bad = middle
        if good > 0.0:
            last, good = self._refined(here, last, good)
        tangent = last.tangent(here.tangent) if good > 0.0 else here.tangent
        before = Station(last, tangent, here.arclength + good, here.piece, True)
        if rigid and (born := taken_up(last)) is not None:
            arclength = before.arclength + distance(self, born[0].point, last.point)
            return [before, Station(*born, arclength, here.piece + 1)]
        for sense in (1.0, -1.0) if grazing else (1.0,):
            # Behind a stiff bumper the old tangent may lead deeper into the contact.
            behind = self._behind(before, sense * tangent)
            if behind is not None:
                return [before, behind]
        return []

    def _through_rest(self, here: Station, length: float) -> list[Station] | None:
        """Where the contacts change between two orbits at which the mass rests; None if it leaves.

        Their map does not depend on the state, so that a grazing is no corner that could turn.
        """
        if not rests(here.orbit):
            return None
        good, bad, last, other = 0.0, length, here.orbit, self.stepped(here, length)
        while bad - good > _REST:
            middle = 0.5 * (good + bad)
            orbit = self.stepped(here, middle)
            if orbit is not None and orbit.contacts == here.orbit.contacts:
                good, last = middle, orbit
            else:
                bad, other = middle, orbit
        if other is None or not rests(other) or other.contacts == last.contacts:
            return None
        there = self._after(here, other)
        if completed_elsewhere(last, other):
            return [there]
        before = replace(self._after(here, last), grazing=True)
        return [before, replace(there, piece=here.piece + 1)]

    def _behind(self, before: Station, tangent: _Array) -> Station | None:
        """The branch just behind a grazing."""
        last, contacts = before.orbit, before.orbit.contacts
        # The map just beyond, where it has the new contacts: at a point that is no orbit yet.
        for ahead in _BEYOND:
            point = last.point + ahead * tangent * self.scale
            status, other, _ = evaluated(last.section, point, last.mode)
            if status is Status.DONE and other.contacts != contacts:
                break
        else:
            return None
        if at_wall(last, other):
            return None  # the way back (`dies_out` finds the way on)
        mode = other.mode
        for sign in (1.0, -1.0):
            elsewhere = None
            # Forwards first: a corner may turn the branch back, but need not.
            along = sign * other.tangent(tangent)
            for reach in _RESTART:
                guess = last.point + reach * along * self.scale
                status, orbit = corrected(last.section, guess, mode, along)
                away = distance(self, orbit.point, last.point)
                if status is Status.DONE and orbit.contacts != contacts and away <= 3.0 * reach:
                    arclength = before.arclength + away
                    there = Station(orbit, orbit.tangent(along), arclength, before.piece + 1)
                    if orbit.contacts == other.contacts:
                        return there
                    elsewhere = elsewhere or there
            if elsewhere is not None:
                return elsewhere
        return None

    def _refined(self, here: Station, last: Orbit, good: float) -> tuple[Orbit, float]:
        """Go on to where the turning point touches: the bisection may stop a little before."""
        inner = good * (1.0 - 1e-3)
        earlier = self.stepped(here, inner)
        if earlier is None or earlier.contacts != last.contacts:
            return last, good
        first, second = margin_of(earlier), margin_of(last)
        if not (abs(second) < abs(first) and second != first):
            return last, good
        target = good - second * (good - inner) / (second - first)
        for share in (1.0, 1.0 - 1e-9, 1.0 - 1e-6):
            length = good + share * (target - good)
            if not good < length < good + 1e-6:
                continue
            orbit = self.stepped(here, length)
            if orbit is not None and orbit.contacts == last.contacts:
                return orbit, length
        return last, good


def neutral(here: Station) -> bool:
    """Whether a multiplier is 1, to rounding."""
    return bool(np.abs(here.orbit.multipliers - 1.0).min() <= _NEUTRAL)


def solved(start: Station, length: float) -> Orbit | None:
    """The orbit after a part of a step, whatever its contacts."""
    return OrbitBranch(start, -math.inf, math.inf).stepped(start, length)


def _born_grazing(met: Orbit) -> str:
    """Why a branch ends that has shrunk onto a simpler orbit, which grazes."""
    period = met.section.count
    whose = "that are their own mirror image" if met.section.mirror else f"of period {period}"
    return f"it meets the orbits {whose} at {met.place}, where they graze"


def near_other_contacts(last: Orbit, along: _Array, ahead: float) -> bool:
    """Whether the map has other contacts a little further along the branch."""
    point = last.point + ahead * last.tangent(along) * last.section.scale
    status, other, _ = evaluated(last.section, point, last.mode)
    return status is Status.DONE and other.contacts != last.contacts
