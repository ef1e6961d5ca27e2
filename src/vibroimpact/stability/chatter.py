"""Motions that come to rest on a rigid stop: their chatter has infinitely many impacts.

Some are followed one by one (`engine.stops.rigid_events`). Where another one is followed before the
chatter is completed, the count of contacts changes though the motion does not: no grazing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine import batch, section_map
from vibroimpact.engine import parameters as par
from vibroimpact.engine.observers.record import CONTACT_BEGINS, DETACHMENT, IMPACT
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.status import Status
from vibroimpact.stability.fixed_points import (
    MAX_EVENTS,
    VALUE,
    Orbit,
    at_phase,
    corrected,
    evaluated,
    vector_of,
)
from vibroimpact.stability.impact_grazing import has_rigid_stop

_Array = NDArray[np.float64]

_APART = 1e-7
"""Share of a forcing cycle by which impacts of two neighbouring orbits that are one may differ."""
_SPEED = 1e-10
"""Scaled speed of an impact up to which it is the beginning of a flight, rounded."""
_FIXED = 1e-9
"""Scaled distance from its image at which a mass placed on its stop is the orbit."""


def rests(orbit: Orbit) -> bool:
    """Whether the mass comes to rest on a rigid stop: there all disturbances of it end."""
    return has_rigid_stop(orbit) and not orbit.carried[:2, :2].any()


@dataclass
class Rested:
    """The last orbit of a branch at which the mass rests, and whether the branch has left them."""

    last: Orbit | None = None
    left: bool = False

    def repeats(self, here: Orbit) -> bool:
        """Whether a branch that has left these orbits follows them again.

        A chatter that is not completed any more ends in a cascade of grazings, in which a branch
        may turn back.
        """
        if not rests(here):
            self.left = self.last is not None
            return False
        last, left = self.last, self.left
        self.last, self.left = here, False
        if last is None or not left:
            return False
        point = last.point.copy()
        point[VALUE] = here.value
        status, there = corrected(last.section, point, last.mode)
        seen = at_phase(there, here.section.family.phase) if status is Status.DONE else None
        if seen is None or seen.section.count != here.section.count or not rests(seen):
            return False
        away = here.section.scaled(seen.point - here.point)
        return bool(np.abs(away).max() <= _FIXED)


def placed_at_rest(orbit: Orbit) -> Orbit:
    """The same orbit with the mass at rest on its stop at the section, if it rests there.

    A state beside it, without velocity but in flight, would have a contact more.
    """
    mode = int(orbit.mode)
    if not mode or orbit.section.family.of_several_masses:
        return orbit
    system = orbit.section.family.system(orbit.value)
    for stop, sign in enumerate((1.0, -1.0)):
        at = par.stop_at(stop)
        if not (mode >> stop & 1 and system[at + par.KIND] == par.RIGID):
            continue
        point = orbit.point.copy()
        point[:2] = sign * system[at + par.GAP], 0.0
        status, there, _ = evaluated(orbit.section, point, float(mode))
        fewer = sum(there.contacts) < sum(orbit.contacts)
        if status is Status.DONE and fewer and there.facts[section_map.RESIDUAL] <= _FIXED:
            return there
    return orbit


def completed_elsewhere(one: Orbit, other: Orbit) -> bool:
    """Whether two neighbouring orbits differ only in how many impacts of a chatter are followed."""
    if not (rests(one) and rests(other)):
        return False
    first, second = _chatters(one), _chatters(other)
    if first is None or second is None or len(first) != len(second):
        return False
    return all(_same(*pair) for pair in zip(first, second, strict=True))


def _same(one: _Array, other: _Array) -> bool:
    """Whether two lists of events up to a rest are one but for impacts at the end of the longer."""
    shorter, longer = sorted((one[:-1], other[:-1]), key=len)
    if (one[-1, 1:] != other[-1, 1:]).any():
        return False
    extra, common = longer[len(shorter) :], longer[: len(shorter)]
    if (extra[:, 1] != IMPACT).any() or (extra[:, 2] != one[-1, 2]).any():
        return False
    apart = np.abs(common[:, 0] - shorter[:, 0])
    return bool((common[:, 1:] == shorter[:, 1:]).all() and (apart <= _APART).all())


def _chatters(orbit: Orbit) -> list[_Array] | None:
    """Return the events of a period (time in cycles, kind, stop), cut where each rest begins."""
    section = orbit.section
    system = section.family.system(orbit.value)
    phase, frequency = section.family.phase, float(system[section_map.FREQUENCY])
    events = np.empty(((section.count + 1) * MAX_EVENTS + 2, record_layout.EVENT))
    _, count, outcome = batch.trajectory(
        system,
        float(system[section_map.AMPLITUDE]),
        frequency,
        phase,
        vector_of(orbit),
        0.0,
        float(section.count),
        0,
        MAX_EVENTS,
        np.empty((record_layout.SAMPLE, 0)),
        events,
    )
    if outcome != Status.DONE:
        return None
    seen = events[:count]
    time = seen[:, record_layout.E_CYCLE] + seen[:, record_layout.E_TIME] * frequency
    rows = np.column_stack([time, seen[:, record_layout.E_KIND], seen[:, record_layout.E_STOP]])
    # A release may fall on the section itself, and be followed by an impact without speed.
    met = np.abs(seen[:, record_layout.E_V]) > _SPEED * section.scale[1]
    rests_there = rows[:, 1] == CONTACT_BEGINS
    rows = rows[(rows[:, 1] != DETACHMENT) & (met | rests_there)]
    ends = np.flatnonzero(rows[:, 1] == CONTACT_BEGINS) + 1
    return [part for part in np.split(rows, ends) if len(part)]
