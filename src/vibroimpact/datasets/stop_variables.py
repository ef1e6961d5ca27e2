"""Output variables that have a value for each stop (dim ``stop``), or that name a stop.

A ``long_name`` contains *the stop* or *the rigid stop*, of which labels make *the right stop*.
"""

from __future__ import annotations

from functools import partial

from vibroimpact.datasets.variable import (
    ANY_PEAKS,
    CONTACTS,
    SECTION,
    SHAKEN,
    STEADY,
    Variable,
    along,
    text,
    truth,
)

_of_stop = partial(Variable, part="stop")

_RIGID = "infinite if a rigid stop was hit"
_CHATTER = (
    "a chatter that ends at rest on a rigid stop has infinitely many impacts; only the impacts "
    "before the chatter is regarded as complete are counted"
)

OF_STOPS: dict[str, Variable] = {
    **along(
        "stop",
        stop=text(
            "name of the stop", "right or left for an oscillator; only the stops that it has"
        ),
    ),
    **along(
        "time",
        deformation=_of_stop(
            "m", "deformation of the stop", "positive when compressed; 0 for a rigid stop"
        ),
        clearance=_of_stop("m", "clearance between the two bodies of the stop"),
        touching=truth("whether the two bodies of the stop touch", part="stop"),
        contact_force=_of_stop(
            "N",
            "contact force of the stop, positive when it pushes its bodies apart",
            "without the infinite force of an impact; at a jump: the value just after the event; "
            "for a measurement: with the sign of the sensor",
        ),
    ),
    **along(
        "event",
        event_stop=text("name of the stop of the event"),
        event_deformation=_of_stop(
            "m", "deformation of the stop at the event", "positive when compressed"
        ),
    ),
    **along(CONTACTS, contact_stop=text("name of the stop of the contact")),
    **along(
        SECTION,
        section_deformation=_of_stop(
            "m", "deformation of the stop at the section", "positive when compressed"
        ),
    ),
    **along(
        STEADY,
        impacts=_of_stop("1", "contacts with the stop per forcing cycle", _CHATTER),
        peak_impulse=_of_stop("N s", "largest impulse of an impact on the rigid stop"),
    ),
    **along(ANY_PEAKS, peak_force=_of_stop("N", "largest contact force of the stop", _RIGID)),
    **along(
        "bifurcation",
        bifurcation_peak_force=_of_stop("N", "largest contact force of the stop", _RIGID),
    ),
    **along(
        SHAKEN,
        impulse=_of_stop("N s", "impulse of the stop's contact force"),
        impact_count=_of_stop("1", "number of contacts with the stop"),
    ),
    **along("*", required_gap=_of_stop("m", "smallest gap of the side without contact")),
}
