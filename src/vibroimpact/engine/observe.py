"""How an observer is found: by the type of what it notes.

An observer is a named tuple of what it has noted, and one kernel

    note(plan, notes, before, t, event, step, after) -> notes

that the event loop calls for each stretch between two events: the motion at its start, the time
since the section there (s), what ended it, its length (s), and the motion behind it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from numba.extending import overload

from vibroimpact.engine.jit import OPTIONS, Vector, kernel
from vibroimpact.engine.motion import Motion

_OBSERVERS: dict[type, Any] = {}


def observer(notes: type) -> Callable[[Callable[..., Any]], Any]:
    """Make a function the observer that keeps such notes."""

    def register(function: Callable[..., Any]) -> Any:
        _OBSERVERS[notes] = kernel(function)
        return _OBSERVERS[notes]

    return register


def observe(
    plan: Vector, notes: Any, before: Motion, t: float, event: int, step: float, after: Motion
) -> Any:
    """Let the observer of these notes see one stretch."""
    return _OBSERVERS[type(notes)].py_func(plan, notes, before, t, event, step, after)


@overload(observe, jit_options=OPTIONS)  # type: ignore[arg-type]
def _observe(plan: Any, notes: Any, before: Any, t: Any, event: Any, step: Any, after: Any) -> Any:
    note = _OBSERVERS[notes.instance_class]

    def implementation(
        plan: Any, notes: Any, before: Any, t: Any, event: Any, step: Any, after: Any
    ) -> Any:
        return note(plan, notes, before, t, event, step, after)

    return implementation


class Unobserved(NamedTuple):
    """Nobody looks."""

    nothing: int


@observer(Unobserved)
def _unobserved(
    plan: Vector,
    notes: Unobserved,
    before: Motion,
    t: float,
    event: int,
    step: float,
    after: Motion,
) -> Unobserved:
    return notes


UNOBSERVED = Unobserved(0)
