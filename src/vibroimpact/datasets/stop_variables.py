"""Output variables that have a value for each stop (dim ``stop``), or that name a stop."""

from __future__ import annotations

from functools import partial

from vibroimpact.datasets.variable import Variable, text, truth

_of_stop = partial(Variable, part="stop")

_RIGID = "infinite if a rigid stop was hit"
_CHATTER = (
    "a chatter that ends at rest on a rigid stop has infinitely many impacts; only the impacts "
    "before the chatter is regarded as complete are counted"
)

OF_STOPS: dict[str, Variable] = {
    "stop": text("name of the stop", "right or left for an oscillator; only the stops that it has"),
    # one motion
    "deformation": _of_stop(
        "m", "deformation of the stop", "positive when compressed; 0 for a rigid stop"
    ),
    "clearance": _of_stop("m", "clearance between the two bodies of the stop"),
    "touching": truth("whether the two bodies of the stop touch", part="stop"),
    "contact_force": _of_stop(
        "N",
        "contact force of the stop, positive when it pushes its bodies apart",
        "without the infinite force of an impact; at a jump: the value just after the event; for a "
        "measurement: with the sign of the sensor",
    ),
    "event_stop": text("name of the stop of the event"),
    "event_deformation": _of_stop(
        "m", "deformation of the stop at the event", "positive when compressed"
    ),
    "contact_stop": text("name of the stop of the contact"),
    "section_deformation": _of_stop(
        "m", "deformation of the stop at the section", "positive when compressed"
    ),
    # sweeps, branches and earthquakes
    "impacts": _of_stop("1", "contacts with the stop per forcing cycle", _CHATTER),
    "peak_force": _of_stop("N", "largest contact force of the stop", _RIGID),
    "peak_impulse": _of_stop("N s", "largest impulse of an impact on the rigid stop"),
    "bifurcation_peak_force": _of_stop("N", "largest contact force of the stop", _RIGID),
    "impulse": _of_stop("N s", "impulse of the stop's contact force"),
    "impact_count": _of_stop("1", "number of contacts with the stop"),
    # sizing
    "required_gap": _of_stop("m", "smallest gap of the side without contact"),
}
