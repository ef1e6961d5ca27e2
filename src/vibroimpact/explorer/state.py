"""The state of a page, as one immutable value, and its history for undo and redo."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator
from vibroimpact.model.frequency_text import forcings
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.model.rig import Rig
from vibroimpact.model.written_units import has_no_units, written_for
from vibroimpact.scenarios.axes import one_sine

Direction = Literal["forward", "backward"]

MOST_STEPS = 100
"""Largest number of steps that can be undone. It bounds the memory of a page that stays open."""
LOWEST, HIGHEST = 0.45, 4.5
"""Ends of the range of the sweeps, divided by the natural frequency, as in the published tests."""
_CHOSEN = 1.8
"""Initial frequency divided by the natural frequency: within the hysteresis of the published
rig."""
ON_DEMAND = ("branch", "map", "basins")
"""Pictures that are computed only on request."""


class PageState(NamedTuple):
    """The state of a page: its rig, its selected motion, and its choices."""

    name: str
    """Name of the rig with which the page started."""
    oscillator: Oscillator
    shaking: Harmonic
    """The shaking, at the frequency of the selected motion."""
    span: tuple[float, float]
    """Lowest and highest frequency of the sweeps, in Hz."""
    direction: Direction = "forward"
    """Sweep direction of the curve on which the motion was selected."""
    together: bool = True
    """Whether one knob sets the values of both stops."""
    physical: bool = False
    """Whether the curves are in mm and g, or without units, instead of normalised (η)."""
    shown: frozenset[str] = frozenset()
    """Pictures of `ON_DEMAND` that are shown."""

    @property
    def rig(self) -> Rig:
        """The rig, at the frequency of the selected motion."""
        return Rig(self.oscillator, self.shaking)


def begin(rig: AnyRig, name: str = "", span: tuple[float, float] | None = None) -> PageState:
    """Return the initial state for a rig.

    Parameters
    ----------
    rig
        A `Rig`, a published case or its code such as ``"B2-G1-A3"``, or the path of a study file.
    name
        Name of the rig. Default: its own name; for a laboratory case, its code.
    span
        Lowest and highest frequency in Hz. Default: 0.45 and 4.5 times the natural frequency, as
        in the published tests.

    Raises
    ------
    InputError
        If the rig is invalid or is not shaken by one sine, or if its isolator has no stiffness.
    """
    sine_rig = one_sine(as_rig(rig), "amplitude")
    oscillator, shaken = sine_rig.oscillator, sine_rig.sine
    # Round numbers of the frequency that the page shows.
    turn = math.tau if has_no_units(oscillator) else 1.0
    natural = turn * oscillator.natural_frequency
    low, high = span or (_short(LOWEST * natural) / turn, _short(HIGHEST * natural) / turn)
    if not 0.0 < low < high:
        with written_for(oscillator):
            raise InputError(
                f"span: {forcings(low, high)} is not valid; pass a lowest frequency above 0, then "
                "a higher one"
            )
    chosen = min(max(_short(_CHOSEN * natural) / turn, low), high)
    return PageState(
        name or sine_rig.name or "rig",
        oscillator,
        shaken.replace(frequency=chosen),
        (low, high),
        together=oscillator.right == oscillator.left,
    )


def _short(value: float) -> float:
    """Round to two digits."""
    return float(f"{value:.1e}")


class UndoHistory(NamedTuple):
    """The present state of a page, its first state, and the states for undo and redo."""

    first: PageState
    """The first state, to which reset returns. The ranges of the knobs contain its values."""
    now: PageState
    past: tuple[PageState, ...] = ()
    future: tuple[PageState, ...] = ()
    gesture: str = ""
    """Name of the last gesture. All states of one gesture, such as a drag, are one step of undo."""

    def to(self, state: PageState, gesture: str = "") -> UndoHistory:
        """Return the history with a new present state."""
        if state == self.now:
            return self._replace(gesture=gesture)
        if gesture and gesture == self.gesture:
            return self._replace(now=state, future=())
        past = (*self.past, self.now)[-MOST_STEPS:]
        return self._replace(now=state, past=past, future=(), gesture=gesture)

    def undo(self) -> UndoHistory:
        """Return to the previous state, if there is one."""
        if not self.past:
            return self
        *past, now = self.past
        future = (self.now, *self.future)[:MOST_STEPS]
        return self._replace(now=now, past=tuple(past), future=future, gesture="")

    def redo(self) -> UndoHistory:
        """Return to the state before the last undo, if there was one."""
        if not self.future:
            return self
        now, *future = self.future
        past = (*self.past, self.now)[-MOST_STEPS:]
        return self._replace(now=now, past=past, future=tuple(future), gesture="")

    def restart(self, state: PageState) -> UndoHistory:
        """Start with another rig. Undo returns to the present rig."""
        return self.to(state)._replace(first=state)
