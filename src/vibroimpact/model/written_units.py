"""Whether printed values and figures have units: those of a rig without units have none.

A rig without units is one whose numbers are dimensionless (see `Oscillator.units`). Its values are
written as plain numbers, and its forcing frequency f as the angular frequency ω = 2π f, because
dimensionless equations contain ω and not f. Datasets keep f under its usual name.

The choice applies to everything that is written inside ``with written_for(rig)``. It is a context
variable, so that each thread and each command has its own.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps
from typing import Any, Final, ParamSpec, TypeVar

_P = ParamSpec("_P")
_R = TypeVar("_R")

NONE: Final = "none"
SI: Final = "SI"

ATTRIBUTE: Final = "unit_system"
"""Attribute of a dataset that was computed from rigs without units. Its value is `NONE`."""

_unitless: ContextVar[bool] = ContextVar("unitless", default=False)


def unitless() -> bool:
    """Return whether values are written without units at present."""
    return _unitless.get()


def unit(text: str) -> str:
    """Return a unit as it follows a number or a name, or nothing if units are not written."""
    return "" if unitless() else text


@contextmanager
def written_for(*subjects: object) -> Iterator[None]:
    """Write values as these rigs, oscillators or datasets have them: with or without units.

    If some of them have units, all are written with units.
    """
    known = [has_no_units(one) for one in subjects]
    token = _unitless.set(bool(known) and all(known))
    try:
        yield
    finally:
        _unitless.reset(token)


def as_first_argument(function: Callable[_P, _R]) -> Callable[_P, _R]:
    """Write values as the first argument of the function has them, in the whole function."""

    @wraps(function)
    def wrapped(*args: _P.args, **kwargs: _P.kwargs) -> _R:
        with written_for(next(iter((*args, *kwargs.values())), None)):
            return function(*args, **kwargs)

    return wrapped


def write_for(subject: object) -> None:
    """Write values as `written_for` does, from here to the end of the context."""
    _unitless.set(has_no_units(subject))


def has_no_units(subject: Any) -> bool:
    """Return whether a rig, its system, or a dataset that was computed from them has no units.

    A mapping of such objects has no units if none of them has units.
    """
    attributes = getattr(subject, "attrs", None)
    if isinstance(attributes, Mapping):
        return attributes.get(ATTRIBUTE) == NONE
    if isinstance(subject, Mapping):
        return bool(subject) and all(has_no_units(one) for one in subject.values())
    return getattr(system_of(subject), "units", SI) == NONE


def system_of(subject: Any) -> Any:
    """Return the oscillator or the assembly of a rig or a case, and anything else as it is."""
    for name in ("system", "oscillator"):
        if hasattr(subject, name):
            return getattr(subject, name)
    return subject


def parameters_without_units(parameters: str | Mapping[str, Any]) -> bool:
    """Return whether all systems in the parameters of a dataset have no units."""
    systems = list(_systems(json.loads(parameters) if isinstance(parameters, str) else parameters))
    return bool(systems) and all(one.get("units") == NONE for one in systems)


def _systems(value: object) -> Iterator[Mapping[str, Any]]:
    """Yield the oscillators and assemblies of nested parameters, such as those of several rigs."""
    if isinstance(value, Mapping):
        for name, one in value.items():
            if name in ("oscillator", "assembly") and isinstance(one, Mapping):
                yield one
            elif name in ("oscillators", "assemblies") and isinstance(one, Mapping):
                yield from one.values()
            else:
                yield from _systems(one)
    elif isinstance(value, list | tuple):
        for one in value:
            yield from _systems(one)
