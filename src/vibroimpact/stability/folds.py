"""Where a branch of orbits turns back, without further results.

A linear isolator's free flight is one orbit at each frequency, the smaller the farther from its
resonance. A branch that comes from contact into free flight therefore goes on away from the
resonance, without another contact or fold: it need not be followed, and the grazing need not be
found to rounding. It turns there if it came from that side.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from vibroimpact.engine.section_map import MODE
from vibroimpact.engine.state import FLIGHT
from vibroimpact.model import Harmonic
from vibroimpact.model.clearance import clearances_at_rest
from vibroimpact.model.rig import Rig
from vibroimpact.response.analytic_free_response import free_flight_excursions, resonance_ratio
from vibroimpact.stability.fixed_points import VALUE, Orbit
from vibroimpact.stability.impact_grazing import has_rigid_stop
from vibroimpact.stability.orbit_curve import OrbitBranch, Station, near_other_contacts

FREE = "the orbit leaves the stops"
"""Why a branch in contact is not followed further."""
_NEAR = 2.0**-16
"""Of a step, to the last orbit in contact: it is then shorter than 1e-6. Of what turns in between
only pairs are missed, for the sense in which the branch must leave is known."""
_STEPS = 6
"""Of Newton's method, to the frequency at which free flight grazes."""


def bounded_by_flight(first: Orbit) -> bool:
    """Whether free flight ends what can turn: a linear isolator's, of one sine, by soft stops."""
    family = first.section.family
    linear = family.oscillator.isolator.linear and isinstance(family.excitation, Harmonic)
    return linear and not has_rigid_stop(first)


def flies(orbit: Orbit) -> bool:
    """Whether no stop is touched; a mass that stays pressed on one begins no contact either."""
    return orbit.contacts == (0, 0) and orbit.facts[MODE] == FLIGHT


@dataclass(frozen=True, eq=False)
class InContact(OrbitBranch):
    """A branch over the frequency that is followed until the stops are not touched any more."""

    left: list[Station] = field(default_factory=list)
    """The last orbit in contact."""

    def corner(self, here: Station, length: float) -> list[Station]:
        """See `Path`: if the branch leaves the stops, the last orbit that touches them."""
        if flies(here.orbit):
            return super().corner(here, length)
        aim = grazing_frequency(here.orbit)
        close = _NEAR * length
        good, bad, last, middle = 0.0, length, here, length
        # What the frequency gains by a longer way, in contact.
        pace = float(here.tangent[VALUE] * self.scale[VALUE])
        while True:
            orbit = self.stepped(here, middle)
            if orbit is None or not (flies(orbit) or orbit.contacts == here.orbit.contacts):
                return super().corner(here, length)
            before = bad - good
            if flies(orbit):
                bad = middle
            else:
                if middle > good:
                    pace = (orbit.value - last.orbit.value) / (middle - good)
                good, last = middle, self._after(here, orbit)
            if bad - good <= close:
                break
            middle = 0.5 * (good + bad)
            if pace and (middle == length or bad - good <= 0.5 * before):
                # Where the grazing is expected: just before it, or just behind if that is done.
                ahead = (aim - last.orbit.value) / pace
                expected = good + ahead + 0.4 * close * (1.0 if ahead <= close else -1.0)
                middle = expected if good < expected < bad else middle
        if not near_other_contacts(last.orbit, last.tangent, 4.0 * (bad - good)):
            return super().corner(here, length)  # free flight is another branch beside this one
        self.left.append(replace(last, grazing=True))
        return [*self.left]

    def end(self, here: Station, there: Station) -> tuple[list[Station], str] | None:
        """See `Path`."""
        return ([there], FREE) if there in self.left else super().end(here, there)


def grazing_frequency(orbit: Orbit) -> float:
    """Where free flight just reaches a stop, near an orbit's frequency (Hz); NaN if nowhere."""
    rig, shaken = orbit.rig.oscillator, orbit.rig.periodic
    assert isinstance(shaken, Harmonic)
    if not (rig.isolator.initial_stiffness > 0.0 and rig.isolator.damping > 0.0):
        return math.nan
    free = 2.0 * min(clearances_at_rest(rig).values())
    here = orbit.value
    for _ in range(_STEPS):
        beside = np.array([here, here * (1.0 + 1e-6)])
        swing, more = free_flight_excursions(Rig(rig, shaken), beside)[0]
        slope = (more - swing) / (beside[1] - here)
        away = (free - swing) / slope if slope else math.nan
        here += away
        if not (here > 0.0 and abs(away) > 1e-10 * here):
            break
    return here if here > 0.0 else math.nan


def turns_into_flight(last: Station, sense: float) -> bool:
    """Whether a branch that leaves the stops turns back; `sense` is -1 at its beginning."""
    rig, shaken = last.orbit.rig.oscillator, last.orbit.rig.periodic
    assert isinstance(shaken, Harmonic)
    resonance = resonance_ratio(Rig(rig, shaken)) * rig.natural_frequency
    outwards = 1.0 if last.orbit.value > resonance else -1.0
    return bool(sense * outwards * last.tangent[VALUE] < 0.0)
