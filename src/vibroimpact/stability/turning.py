"""Where a branch of orbits turns back, where nothing else is asked of it.

A linear isolator's free flight is one orbit at each frequency, the smaller the farther from its
resonance. A branch that comes from contact into free flight therefore goes on away from the
resonance, without another contact or fold: it need not be followed, and the grazing need not be
found to rounding. It turns there if it came from that side.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from vibroimpact.engine.motion import FLIGHT
from vibroimpact.engine.section_map import MODE, PARAMETER
from vibroimpact.model import Harmonic
from vibroimpact.response.free_flight import resonance_ratio
from vibroimpact.stability.fixed_points import Orbit
from vibroimpact.stability.impacts import has_rigid_stop
from vibroimpact.stability.trace import Branch, Station, near_other_contacts

FREE = "it leaves the stops"
"""Why a branch in contact is not followed further."""
_HALVINGS = 16
"""Of a step, to the last orbit in contact: it is then shorter than 1e-6. Of what turns in between
only pairs are missed, for the sense in which the branch must leave is known."""


def bounded_by_flight(first: Orbit) -> bool:
    """Whether free flight ends what can turn: a linear isolator's, of one sine, by soft stops."""
    family = first.section.family
    linear = family.oscillator.isolator.linear and isinstance(family.excitation, Harmonic)
    return linear and not has_rigid_stop(first)


def flies(orbit: Orbit) -> bool:
    """Whether no stop is touched; a mass that stays pressed on one begins no contact either."""
    return orbit.contacts == (0, 0) and orbit.facts[MODE] == FLIGHT


@dataclass(frozen=True, eq=False)
class InContact(Branch):
    """A branch over the frequency that is followed until the stops are not touched any more."""

    left: list[Station] = field(default_factory=list)
    """The last orbit in contact."""

    def corner(self, here: Station, length: float) -> list[Station]:
        """See `Path`: if the branch leaves the stops, the last orbit that touches them."""
        if flies(here.orbit):
            return super().corner(here, length)
        good, bad, last, middle = 0.0, length, here, length
        for _ in range(_HALVINGS):
            found = self.stepped(here, middle)
            if found is None or not (flies(found) or found.contacts == here.orbit.contacts):
                return super().corner(here, length)
            if flies(found):
                bad = middle
            else:
                good, last = middle, self._after(here, found)
            middle = 0.5 * (good + bad)
        if not near_other_contacts(last.orbit, last.tangent, 4.0 * (bad - good)):
            return super().corner(here, length)  # free flight is another branch beside this one
        self.left.append(replace(last, grazing=True))
        return [*self.left]

    def end(self, here: Station, there: Station) -> tuple[list[Station], str] | None:
        """See `Path`."""
        return ([there], FREE) if there in self.left else super().end(here, there)


def turns_into_flight(last: Station, sense: float) -> bool:
    """Whether a branch that leaves the stops turns back; `sense` is -1 at its beginning."""
    rig, shaken = last.orbit.setting
    assert isinstance(shaken, Harmonic)
    resonance = resonance_ratio(rig, shaken) * rig.natural_frequency
    outwards = 1.0 if last.orbit.value > resonance else -1.0
    return bool(sense * outwards * last.tangent[PARAMETER] < 0.0)
