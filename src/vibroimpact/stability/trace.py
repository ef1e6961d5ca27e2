"""Following a branch of orbits: pseudo-arclength steps, folds, and changes of contact sequence.

From an orbit with unit tangent t a step of length h predicts x + h t and corrects on the plane
normal to t. A step is taken if the contacts are the same and the tangent has hardly turned.

Where the contacts change (grazing) the map is continuous, but its derivative may jump: the branch
may have a corner there, and may turn back in it. The last orbit with the old contacts is found by
bisection of the step, to rounding; the derivative just beyond, and with it the new tangent,
follows from the map where it already has the new contacts; the branch goes on from there.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import section_map
from vibroimpact.engine.status import Status
from vibroimpact.stability.orbits import (
    HELD,
    SEEN,
    Orbit,
    at_phase,
    corrected,
    evaluated,
    is_fixed,
    margin_of,
)

_Array = NDArray[np.float64]

FIRST, LEAST, MOST = 0.01, 1e-9, 0.05
"""Length of the first step, of the least and of the largest one, in scaled components."""
_TURN = 0.97  # cosine of the largest turn of the tangent in a step
_GENTLE = 0.997  # below this turn the step may grow
_MISS = 0.4  # of a step, by which the orbit may miss the prediction
_SLID = 1e-7
_BISECTIONS = 55
_LOOK = 12  # bisections after which a grazing must show
_BEYOND = (1e-12, 1e-11, 1e-10, 1e-9, 1e-8)
"""Scaled distances behind a grazing at which the map must have the new contacts."""
_RESTART = (1e-6, 1e-5, 1e-4, 1e-7)
"""Scaled distances behind a grazing at which the branch is taken up again."""


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


@dataclass
class Trace:
    """One direction of a branch."""

    stations: list[Station]
    ended: str = ""
    """Why the branch was not followed further."""
    closed: bool = False


def step(at: Station, length: float) -> tuple[Status, Orbit]:
    """Predict and correct; an orbit that is far from the prediction is on another branch."""
    section = at.orbit.section
    point = at.orbit.point + length * at.tangent * section.scale
    status, found = corrected(section, point, at.orbit.facts[section_map.MODE], at.tangent)
    if status is Status.DONE:
        miss = np.linalg.norm((found.point - point) / section.scale * SEEN)
        if miss > _MISS * length + 1e-9 or slid(found):
            return Status.NOT_SETTLED, found
    return status, found


def slid(found: Orbit) -> bool:
    """Whether an orbit has become one of a simpler map: its own mirror image, or half as long."""
    parent = found.section.parent()
    return parent is not None and is_fixed(parent, found, _SLID)


def follow_branch(
    start: Station,
    low: float,
    high: float,
    most_points: int,
    progress: Callable[[float], None] | None = None,
) -> Trace:
    """Follow a branch from an orbit along its tangent.

    Parameters
    ----------
    start
        Where to begin, and which way.
    low, high
        Range of the parameter; the branch ends on it.
    most_points
        Orbits after which it is given up.
    progress
        Called with the parameter now and then.
    """
    trace = Trace([start])
    here = start
    length = FIRST
    while True:
        if len(trace.stations) >= most_points:
            trace.ended = f"{most_points} points were reached"
            return trace
        status, found = step(here, length)
        usable = status is Status.DONE
        turned = 0.0
        tangent = here.tangent
        if usable:
            tangent = found.tangent(here.tangent)
            turned = float((tangent * SEEN) @ here.tangent)
        same = usable and found.contacts == here.orbit.contacts
        if same and turned >= _TURN:
            if not low <= found.value <= high:
                _end_on(trace, here, low if found.value < low else high)
                return trace
            here = Station(
                found, tangent, here.arclength + _distance(here.orbit, found), here.piece
            )
            trace.stations.append(here)
            if progress:
                progress(found.value)
            if _returned(trace, here):
                trace.closed = True
                trace.ended = "it is closed"
                return trace
            if turned > _GENTLE:
                length = min(1.6 * length, MOST)
            continue
        if (usable and not same) or length <= 1e-4:
            beyond = _past_grazing(here, length)
            if beyond is not None:
                before, behind = beyond
                if not low <= before.orbit.value <= high:
                    _end_on(trace, here, low if before.orbit.value < low else high)
                    return trace
                trace.stations.append(before)
                trace.stations.append(behind)
                here = behind
                length = min(1e-3, FIRST)
                continue
        length *= 0.25
        if length < 1e-5 and here.phases_tried < len(PHASES):
            # An event may fall on the section: there a smooth branch has a corner.
            moved = _at_another_phase(here)
            if moved is not None:
                trace.stations.append(moved)
                here = moved
                length = 1e-3
                continue
        if length < LEAST:
            trace.ended = f"no orbit could be found beyond {here.orbit.value:.9g} (least step)"
            return trace


def _distance(one: Orbit, other: Orbit) -> float:
    return float(np.linalg.norm((other.point - one.point) / one.section.scale * SEEN))


def _end_on(trace: Trace, here: Station, value: float) -> None:
    """Add the orbit at the end of the range."""
    point = here.orbit.point.copy()
    share = (value - here.orbit.value) / (here.tangent[4] * here.orbit.section.scale[4])
    point += share * here.tangent * here.orbit.section.scale
    point[section_map.PARAMETER] = value
    status, found = corrected(here.orbit.section, point, here.orbit.facts[section_map.MODE], HELD)
    trace.ended = f"the range ends at {value:.9g}"
    if status is Status.DONE and found.contacts == here.orbit.contacts:
        tangent = found.tangent(here.tangent)
        arclength = here.arclength + _distance(here.orbit, found)
        trace.stations.append(Station(found, tangent, arclength, here.piece))


def _returned(trace: Trace, here: Station) -> bool:
    """Whether the last step went past the beginning of the branch."""
    first, before = trace.stations[0], trace.stations[-2]
    if len(trace.stations) < 8 or here.orbit.contacts != first.orbit.contacts:
        return False
    values = [before.orbit.value, here.orbit.value]
    reach = abs(values[1] - values[0])
    if not min(values) - reach <= first.orbit.value <= max(values) + reach:
        return False
    # Sections may have been moved on the way.
    phase = first.orbit.section.family.phase
    ends = [at_phase(station.orbit, phase) for station in (before, here)]
    if ends[0] is None or ends[1] is None:
        return False
    scale = first.orbit.section.scale
    chord = (ends[1].point - ends[0].point) / scale * SEEN
    ahead = (first.orbit.point - ends[0].point) / scale * SEEN
    gap = float(np.linalg.norm(chord))
    if gap == 0.0:
        return False
    along = float(ahead @ chord) / gap
    return bool(
        0.0 <= along <= gap
        and np.linalg.norm(ahead - along * chord / gap) <= 0.2 * gap
        and chord @ first.tangent > 0.9 * gap
    )


PHASES = (1.0, 2.1, 3.3, 0.4)
"""rad, by which the section is moved in turn."""


def _at_another_phase(here: Station) -> Station | None:
    """The same orbit with the section elsewhere."""
    for number in range(here.phases_tried, len(PHASES)):
        found = at_phase(here.orbit, here.orbit.section.family.phase + PHASES[number])
        if found is None or found.contacts != here.orbit.contacts:
            continue
        tangent = found.tangent(HELD * math.copysign(1.0, here.tangent[4]))
        return Station(found, tangent, here.arclength, here.piece, phases_tried=number + 1)
    return None


def _past_grazing(here: Station, length: float) -> tuple[Station, Station] | None:
    """The last orbit with the contacts of `here` within a step, and one just behind it."""
    contacts = here.orbit.contacts
    good, bad = 0.0, length
    last = here.orbit
    for number in range(_BISECTIONS):
        middle = 0.5 * (good + bad)
        if middle in (good, bad):
            break
        if number == _LOOK and not _near_other_contacts(last, here.tangent, 4.0 * (bad - good)):
            return None  # the step failed for another reason
        status, found = step(here, middle)
        if status is Status.DONE and found.contacts == contacts:
            good, last = middle, found
        else:
            bad = middle
    if good > 0.0:
        last, good = _refined(here, last, good)
    tangent = last.tangent(here.tangent) if good > 0.0 else here.tangent
    before = Station(last, tangent, here.arclength + good, here.piece, True)
    # The map just beyond, where it has the new contacts: at a point that is no orbit yet.
    scale = last.section.scale
    for ahead in _BEYOND:
        point = last.point + ahead * tangent * scale
        status, other, _ = evaluated(last.section, point, last.facts[section_map.MODE])
        if status is not Status.DONE or other.contacts == contacts:
            continue
        for sign in (1.0, -1.0):
            # Forwards first: a corner may turn the branch back, but need not.
            along = sign * other.tangent(tangent)
            for reach in _RESTART:
                guess = last.point + reach * along * scale
                status, found = corrected(last.section, guess, other.facts[section_map.MODE], along)
                if (
                    status is Status.DONE
                    and found.contacts != contacts
                    and _distance(last, found) <= 3.0 * reach
                ):
                    arclength = before.arclength + _distance(last, found)
                    behind = Station(found, found.tangent(along), arclength, here.piece + 1)
                    return before, behind
        return None
    return None


def _refined(here: Station, last: Orbit, good: float) -> tuple[Orbit, float]:
    """Go on to where the turning point touches: the bisection may stop a little before."""
    inner = good * (1.0 - 1e-3)
    status, earlier = step(here, inner)
    if status is not Status.DONE or earlier.contacts != last.contacts:
        return last, good
    first, second = margin_of(earlier), margin_of(last)
    if not (abs(second) < abs(first) and second != first):
        return last, good
    target = good - second * (good - inner) / (second - first)
    for share in (1.0, 1.0 - 1e-9, 1.0 - 1e-6):
        length = good + share * (target - good)
        if not good < length < good + 1e-6:
            continue
        status, found = step(here, length)
        if status is Status.DONE and found.contacts == last.contacts:
            return found, length
    return last, good


def _near_other_contacts(last: Orbit, along: _Array, ahead: float) -> bool:
    """Whether the map has other contacts a little further along the branch."""
    point = last.point + ahead * last.tangent(along) * last.section.scale
    status, other, _ = evaluated(last.section, point, last.facts[section_map.MODE])
    return status is Status.DONE and other.contacts != last.contacts


def bisect(
    start: Station, length: float, function: Callable[[Orbit], float]
) -> tuple[Status, Orbit, float]:
    """Find the zero of a function of the orbit within a step, to rounding.

    Parameters
    ----------
    start
        Where the step begins.
    length
        Its length; the function has different signs at its ends.
    function
        Smooth along the branch.

    Returns
    -------
    status, orbit, length
        Where the zero is.
    """
    # Ridders' method: bracketed, and quadratic on a smooth function.
    a, b = 0.0, length
    fa = function(start.orbit)
    status, found = step(start, b)
    if status is not Status.DONE:
        return status, found, b
    fb = function(found)
    best = (abs(fb), found, b)
    for _ in range(60):
        middle = 0.5 * (a + b)
        if middle in (a, b) or fb == 0.0:
            break
        status, found = step(start, middle)
        if status is not Status.DONE:
            return status, found, middle
        fm = function(found)
        best = min(best, (abs(fm), found, middle), key=lambda item: item[0])
        root = math.sqrt(max(fm * fm - fa * fb, 0.0))
        if root == 0.0:
            break
        new = middle + (middle - a) * math.copysign(1.0, fa - fb) * fm / root
        if not a < new < b:
            break
        status, found = step(start, new)
        if status is not Status.DONE:
            return status, found, new
        fn = function(found)
        best = min(best, (abs(fn), found, new), key=lambda item: item[0])
        if fn == 0.0 or b - a < 1e-15:
            break
        ends = sorted([(a, fa), (middle, fm), (new, fn), (b, fb)])
        for (x, fx), (y, fy) in itertools.pairwise(ends):
            if fx * fy <= 0.0:
                narrowed = (y - x) < (b - a)
                a, fa, b, fb = x, fx, y, fy
                break
        if not narrowed or abs(fn) < 1e-15:
            break
    return Status.DONE, best[1], best[2]
