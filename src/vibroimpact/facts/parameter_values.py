"""The parameters of a rig by path, with their present values."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

from rich.console import Group, RenderableType
from rich.text import Text

from vibroimpact.errors import InputError
from vibroimpact.facts.tables import sheet
from vibroimpact.model.excitation import Repeated
from vibroimpact.model.parameters import parameters, whole_number_paths
from vibroimpact.model.rig import Rig
from vibroimpact.model.units import pretty

_WHOLE = "a whole number, which cannot be varied"


def facts(rig: Rig) -> dict[str, Any]:
    """Return the values (SI units) by path.

    The value is None for a frequency, which is open, and if the stops have different ones. A
    parameter without a meaning for the rig, such as a ratio of numbers that it has not, is left
    out.
    """
    values: dict[str, Any] = {}
    for name, one in parameters(rig).items():
        if name == "frequency":
            if isinstance(rig.shaking, Repeated):
                values[name] = None
        elif len(set(one.numbers(rig))) > 1:
            values[name] = None
        else:
            with suppress(InputError):
                values[name] = one.read(rig)
    return values | whole_number_paths(rig.system)


def text(rig: Rig) -> RenderableType:
    """Return the paths with their values and units."""
    known, whole = parameters(rig), whole_number_paths(rig.system)
    rows = [
        (name, str(value), _WHOLE)
        if name in whole
        else (name, _text(name) if value is None else pretty(value, known[name].quantity))
        for name, value in facts(rig).items()
    ]
    title = Text("Parameters by path", style="bold")
    return Group(Text(), title, sheet(rows))


def _text(name: str) -> str:
    return "open" if name == "frequency" else "differs between the stops"
