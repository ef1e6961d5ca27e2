"""What the page without a server knows of the package: presets, knobs, units, limits and words."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Iterator
from functools import cache
from typing import Any

from vibroimpact.attraction import state_window
from vibroimpact.engine.parameters import free_rig
from vibroimpact.errors import InputError
from vibroimpact.explorer import change, controls, laws, presets, share
from vibroimpact.explorer import state as states
from vibroimpact.explorer.engine_layout import layout_of_engine
from vibroimpact.explorer.pictures import basins, curves, motion
from vibroimpact.figures import resonance_panels
from vibroimpact.model import GRAVITY, Bumper, Isolator, Oscillator, Rig, RigidStop
from vibroimpact.model.excitation import QUANTITIES
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.model.quantities import (
    DIMENSIONLESS,
    FREQUENCY,
    IMPULSE,
    Quantity,
)
from vibroimpact.model.size_checks import LARGEST, SMALLEST
from vibroimpact.model.units import accepted, read
from vibroimpact.model.validation import Accepts, in_order
from vibroimpact.response import resonance

Table = dict[str, Any]

STOPS = (laws.NONE, Bumper.kind, RigidStop.kind)
"""Laws of stops that the page computes."""
_LAWS = {"": Oscillator, "isolator": Isolator, Bumper.kind: Bumper, RigidStop.kind: RigidStop}
_ONLY_LINEAR = "damping_exponent"
"""A field that the page leaves as it is: with another value the law is not linear."""
_FITTING = re.compile(r"\([GMk]?N(?: s)?\)")
"""A unit of a force or an impulse."""
_UNITS = {
    "length": "m dm cm mm µm km in inch ft",
    "mass": "kg gram t tonne lb",
    "force": "N mN kN MN GN lbf",
    "time": "s ms min h",
    "frequency": "Hz mHz kHz rad/s rpm 1/s deg/s",
    "acceleration": "g mg gal m/s² cm/s² mm/s²",
    "stiffness": "N/m kN/m MN/m GN/m N/mm kN/mm N/cm kN/cm kg/s²",
    "damping": "N s/m|kN s/m|MN s/m|N s/mm|kN s/mm|kg/s",
    "unbalance": "kg m|kg mm|kg cm|g m|g mm",
    "dimensionless number": "%",
}
"""Units that are known by heart: without a server there is no library that reads all others."""


def facts(first: states.PageState) -> Table:
    """Return all that the page without a server has of the package, as JSON can hold it."""
    return {**_known(), "first": table(first)}


@cache
def _known() -> Table:
    """What does not depend on the rig."""
    quantities = {one.name: one for one in _quantities()}
    return {
        "engine": {**layout_of_engine(), "free": [_number(one) for one in free_rig()]},
        "presets": [[group, names] for group, names in presets.names()],
        "tables": {
            name: table(presets.preset(name)) for _, names in presets.names() for name in names
        },
        "stops": STOPS,
        "words": laws.words_of_stops(),
        "quantities": {name: _quantity(one) for name, one in quantities.items()},
        "amplitudes": {
            of: [*controls.AMPLITUDES[of], one.name, accepted(one, above=0.0)]
            for of, one in QUANTITIES.items()
        },
        "fields": {kind: _fields(law) for kind, law in _LAWS.items()},
        "ratios": {name: _ratio(name) for name in (*change.OF_RIG, *change.DIMENSIONLESS)},
        "knobs": {
            "ranges": controls.RANGES,
            "symbols": controls.SYMBOLS,
            "labels": controls.LABELS,
            "factor": controls.TENFOLD,
            "wide": controls.WIDE,
        },
        "laws": {
            "restitution": laws.RESTITUTION,
            "stiffer": laws.STIFFER,
            "pressed": laws.PRESSED,
            "relaxation": Bumper.like(1.0, 1.0, 0.0, 0.5, 1.0, 1.0).damping,
        },
        "axes": {"frequency": curves.AXIS, "motion": motion.AXES, "basins": basins.AXES},
        "labels": {of: _labels(amplitude) for of, amplitude in _EITHER.items()},
        "frequency": accepted(FREQUENCY, above=0.0),
        "limits": {
            "most": LARGEST,
            "least": SMALLEST,
            "steps": states.MOST_STEPS,
            "rounded": change.ROUNDED,
            "address": share.MOST,
        },
        "sweeps": {
            "coarse": curves.COARSE,
            "fine": curves.FINE,
            "patience": curves.PATIENCE,
            "window": curves.WINDOW,
            "gravity": GRAVITY,
            "apart": resonance.APART,
            "unsettled_apart": resonance.UNSETTLED_APART,
            "step": resonance.STEP,
            "seen": resonance_panels.SEEN,
        },
        "motions": {
            "samples": motion.SAMPLES,
            "most": motion.MOST_CYCLES,
            "window": motion.WINDOW,
            "highest": motion.HIGHEST,
        },
        "basins": {
            "coarse": basins.COARSE,
            "fine": basins.FINE,
            "patience": basins.PATIENCE,
            "wider": state_window.WIDER,
            "first": state_window.FIRST,
            "lattice": state_window.LATTICE,
        },
    }


def check(state: states.PageState) -> None:
    """Refuse a state that only Python computes.

    Raises
    ------
    InputError
        If a law of the rig is not linear, or if it has no units.
    """
    state.oscillator.check_linear("page without a server")
    if state.oscillator.units != "SI":
        raise InputError(
            "oscillator.units: a rig without units has no page without a server; use "
            "vibroimpact explore"
        )


_EITHER = {"moving": "1 m/s²", "still": "1 N"}
"""What shakes a rig whose base moves, or stands still."""


def _labels(amplitude: str) -> dict[str, list[str]]:
    """Labels of all panels of resonance curves, with {} in place of a unit that fits the values."""
    labels = {}
    # Force and impulse have panels where stops of either law are hit.
    for stop in (Bumper(9.0, 0.1, 1e-3), RigidStop(0.5, 1e-3)):
        rig = Oscillator("2 kg", Isolator(1.0, 0.1), stop)
        state = states.begin(Rig(rig, amplitude))
        data = curves.swept(state._replace(span=(0.05, 0.2)), fine=False)
        for physical in (False, True):
            picture = curves.curves(state._replace(physical=physical), data, fine=False)
            for one in picture["panels"]:
                text = "\n".join(one["label"])
                labels[one["name"]] = _FITTING.sub("({})", text).split("\n")
    return labels


def table(state: states.PageState) -> Table:
    """A state as an address holds it."""
    text = share.address(state)
    table: Table = json.loads(base64.urlsafe_b64decode(text + "=" * (-len(text) % 4)))
    return table


def _quantities() -> Iterator[Quantity]:
    yield from QUANTITIES.values()
    yield from (DIMENSIONLESS, FREQUENCY, IMPULSE)
    for law in _LAWS.values():
        yield from (one.quantity for _, one in _accepts(law))
    for name in change.OF_RIG:
        yield PARAMETERS[name].quantity


def _quantity(one: Quantity) -> Table:
    known = _UNITS.get(one.name, "")
    texts = known.split("|" if "|" in known else None)
    return {
        "phrase": one.phrase,
        "scales": [[scale.least, scale.size, scale.symbol] for scale in one.scales],
        "units": {
            text: read(f"1 {text}", one)
            for text in dict.fromkeys([*(scale.symbol for scale in one.scales), *texts])
        },
    }


def _accepts(law: Any) -> Iterator[tuple[str, Accepts]]:
    for name in in_order(law):
        rule = next((o for o in law.model_fields[name].metadata if isinstance(o, Accepts)), None)
        if rule is not None and name != _ONLY_LINEAR:
            yield name, rule


def _fields(law: Any) -> Table:
    return {
        name: _bounded(one.quantity, above=one.above, minimum=one.minimum, maximum=one.maximum)
        for name, one in _accepts(law)
    }


def _ratio(name: str) -> Table:
    bound = {"above": 0.0} if name in change.OF_RIG else {"minimum": 0.0}
    return _bounded(PARAMETERS[name].quantity, **bound)


def _bounded(quantity: Quantity, **bounds: float | None) -> Table:
    return {"quantity": quantity.name, **bounds, "accepted": accepted(quantity, **bounds)}


def _number(value: float) -> float | str:
    return float(value) if abs(value) < float("inf") else str(value)
