"""How an observer is found: by the type of what it notes.

An observer is a named tuple of what it has noted, and one kernel

    note(plan, notes, stretch) -> notes

that the event loop calls for each stretch between two events.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from numba.extending import overload

from vibroimpact.engine.jit import CHOSEN, Vector, kernel
from vibroimpact.engine.motion import Stretch

_OBSERVERS: dict[type, Any] = {}


def observer(notes: type) -> Callable[[Callable[..., Any]], Any]:
    """Make a function the observer that keeps such notes."""

    def register(function: Callable[..., Any]) -> Any:
        _OBSERVERS[notes] = kernel(function)
        return _OBSERVERS[notes]

    return register


def observe(plan: Vector, notes: Any, stretch: Stretch) -> Any:
    """Let the observer of these notes see one stretch."""
    return _OBSERVERS[type(notes)](plan, notes, stretch)


@overload(observe, jit_options=CHOSEN, strict=False)  # type: ignore[arg-type]
def _observe(plan: Any, notes: Any, stretch: Any) -> Any:
    return _OBSERVERS[notes.instance_class].py_func


class Unobserved(NamedTuple):
    """Nobody looks."""

    nothing: int


@observer(Unobserved)
def _unobserved(plan: Vector, notes: Unobserved, stretch: Stretch) -> Unobserved:
    return notes


UNOBSERVED = Unobserved(0)
