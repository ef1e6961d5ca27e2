"""A state as text: an address, a study file, and a Python program that computes its curves."""

from __future__ import annotations

import base64
import binascii
import json
import re
from typing import Any, get_args

from vibroimpact.errors import InputError, shown, unknown
from vibroimpact.explorer.change import joined, looked
from vibroimpact.explorer.pictures.curves import FINE
from vibroimpact.explorer.state import Direction, PageState
from vibroimpact.model import Harmonic, Oscillator, to_si
from vibroimpact.model.excitation import QUANTITIES, sized
from vibroimpact.model.frequency_text import forcings
from vibroimpact.model.quantities import FREQUENCY
from vibroimpact.model.rig import Rig
from vibroimpact.model.study import study_text
from vibroimpact.model.units import pretty
from vibroimpact.model.written_units import as_first_argument, written_for
from vibroimpact.scenarios.axes import one_sine

MOST = 8000
"""Largest number of characters of an address."""
_LONGEST_NAME = 80


def address(state: PageState) -> str:
    """Return the part after ``#`` of the address of a page that shows this state."""
    table = {
        "name": state.name,
        "oscillator": state.oscillator.model_dump(),
        "amplitude": state.shaking.amplitude,
        "of": state.shaking.of,
        "phase": state.shaking.phase,
        "frequency": state.shaking.frequency,
        "span": list(state.span),
        "direction": state.direction,
        "together": state.together,
        "physical": state.physical,
        "shown": sorted(state.shown),
    }
    text = json.dumps(table, separators=(",", ":"), ensure_ascii=False)
    return base64.urlsafe_b64encode(text.encode()).decode().rstrip("=")


def from_address(text: object) -> PageState:
    """Return the state that an address contains.

    The address contains only numbers, names of laws and names of choices. They are checked in the
    same way as the values of a study file. Nothing in an address is run or opened.

    Raises
    ------
    InputError
        If the address cannot be read, or if a value in it is invalid.
    """
    if not isinstance(text, str) or not 0 < len(text) <= MOST:
        raise InputError(
            f"address: {shown(text)} is not valid; copy the whole address of the page again"
        )
    try:
        padded = text + "=" * (-len(text) % 4)
        table = json.loads(base64.b64decode(padded, altchars=b"-_", validate=True))
    except (binascii.Error, UnicodeDecodeError, ValueError, RecursionError):
        raise InputError(
            "address: it cannot be read; copy the whole address of the page again"
        ) from None
    return _from_table(table)


def _from_table(table: Any) -> PageState:
    fields = {
        "name", "oscillator", "amplitude", "of", "phase", "frequency", "span", "direction",
        "together", "physical", "shown",
    }  # fmt: skip
    if not isinstance(table, dict) or set(table) != fields:
        raise InputError(
            "address: it does not describe a page; copy the whole address of the page again"
        )
    name, of, direction, span = (table[key] for key in ("name", "of", "direction", "span"))
    if not isinstance(name, str) or len(name) > _LONGEST_NAME or not name.isprintable():
        raise InputError(
            f"address: the name {shown(name)} is not valid; use a string of at most "
            f"{_LONGEST_NAME} printable characters"
        )
    if direction not in get_args(Direction):
        raise InputError(f"address: direction {unknown(direction, get_args(Direction))}")
    if of not in list(QUANTITIES):
        raise InputError(f"address: quantity of the shaking {unknown(of, QUANTITIES)}")
    if not (isinstance(span, list) and len(span) == 2):
        raise InputError(
            f"address: the range of frequencies {shown(span)} is not valid; use two frequencies "
            "(Hz), such as [0.5, 5]"
        )
    oscillator = Oscillator.model_validate(table["oscillator"], where="oscillator")
    size, _ = sized(table["amplitude"], of, "amplitude", positive=True)
    low, high = (to_si(end, FREQUENCY, "span", above=0.0) for end in span)
    hertz = to_si(table["frequency"], FREQUENCY, "frequency", minimum=low, maximum=high)
    if not low < high:
        with written_for(oscillator):
            raise InputError(
                f"address: the range from {forcings(low, high)} is empty; use a lower first "
                "frequency"
            )
    shaken = Harmonic(size, hertz, table["phase"], of)
    one_sine(Rig(oscillator, shaken), "amplitude")
    state = PageState(name, oscillator, shaken, (low, high), direction)
    listed = table["shown"]
    if not isinstance(listed, list) or not all(isinstance(item, str) for item in listed):
        raise InputError("address: the entry 'shown' is not valid; use a list of pictures")
    state = looked(state, {**dict.fromkeys(listed, True), "physical": table["physical"] is True})
    if table["together"] is True and oscillator.right == oscillator.left:
        return joined(state, True)
    return joined(state, False)


@as_first_argument
def study(state: PageState) -> str:
    """Return the study file of a state, which all commands accept."""
    low, high = state.span
    step = (high - low) / (FINE - 1)
    lines = [
        study_text(Rig(state.oscillator, state.shaking, name=state.name)),
        "[sweep]",
        f"from = {low!r}",
        f"to = {high!r}",
        f"step = {step!r}",
        "",
        "[simulate]",
        f"frequency = {state.shaking.frequency!r}",
    ]
    return "\n".join(lines) + "\n"


@as_first_argument
def program(state: PageState) -> str:
    """Return a Python program that computes the curves and the motion of a state."""
    low, high = state.span
    oscillator, shaken = state.oscillator, state.shaking
    kinds = {type(oscillator).__name__, type(oscillator.isolator).__name__}
    kinds |= {type(stop).__name__ for stop in oscillator.stops.values()} | {"Harmonic"}
    written = repr(oscillator)
    for kind in kinds:
        written = _prefixed(written, kind)
    # The name may come from an address: a comment of one line can do nothing.
    name = "".join(sign if sign.isprintable() else " " for sign in state.name)
    return f'''"""Resonance curves, scenario and one motion."""

# {" ".join(name.split())}

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import resonance_curves, save_figure

oscillator = {written}
shaking = {_prefixed(repr(shaken), "Harmonic")}  # {pretty(shaken.amplitude, shaken.quantity)}
rig = vi.Rig(oscillator, shaking)

frequencies = np.linspace({low!r}, {high!r}, {FINE})
curves = vi.sweep(rig, frequencies)
axes = resonance_curves(curves, physical={state.physical!r})
save_figure(axes[0], "curves.png")
found = vi.classify_scenario(rig)
print(found.attrs["label"], found.attrs["evidence"])

held = curves.sel(direction={state.direction!r}).sel(
    frequency={shaken.frequency!r}, method="nearest"
)
motion = vi.steady(rig, held.section, frequency=float(held.frequency))
print(motion.motion.item(), motion.period.item(), motion.attrs["evidence"])
'''


def _prefixed(text: str, kind: str) -> str:
    """With ``vi.`` before the constructor."""
    return re.sub(rf"\b{kind}\(", f"vi.{kind}(", text)
