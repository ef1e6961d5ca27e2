"""What a page shows: one immutable value, and the values that it had before."""

from __future__ import annotations

from typing import Literal, NamedTuple

from vibroimpact.errors import InputError
from vibroimpact.model import Harmonic, Oscillator
from vibroimpact.model.read_rig import AnyRig, as_rig
from vibroimpact.model.rig import Rig
from vibroimpact.scenarios.axes import one_sine

Direction = Literal["forward", "backward"]

MOST_STEPS = 100
"""Steps that can be undone: a page that stays open must not grow."""
LOWEST, HIGHEST = 0.45, 4.5
"""Range of the sweeps over the natural frequency, as wide as that of the published tests."""
_CHOSEN = 1.8
"""Initial frequency divided by the natural frequency: within the hysteresis of the published
rig."""
ON_DEMAND = ("branch", "map", "basins")
"""Pictures that are made on request only."""


class State(NamedTuple):
    """What a page shows."""

    name: str
    """Of the rig it began with."""
    oscillator: Oscillator
    shaking: Harmonic
    """Its frequency is that of the selected motion."""
    span: tuple[float, float]
    """Lowest and highest frequency of the sweeps, Hz."""
    direction: Direction = "forward"
    """The sweep on whose curve the motion was chosen."""
    together: bool = True
    """Whether both stops have one knob."""
    physical: bool = False
    """Whether the curves are in mm and g rather than η."""
    shown: frozenset[str] = frozenset()
    """Pictures of `ON_DEMAND` that are shown."""

    @property
    def rig(self) -> Rig:
        """The rig, at the frequency of the selected motion."""
        return Rig(self.oscillator, self.shaking)


def begin(rig: AnyRig, name: str = "", span: tuple[float, float] | None = None) -> State:
    """Return the state that a rig begins with.

    Parameters
    ----------
    rig
        The rig: a `Rig`, a published laboratory case or its code such as ``"B2-G1-A3"``, or the
        path of a study file.
    name
        What it is called; that of a case is its code.
    span
        Lowest and highest frequency in Hz; None for those of the published tests, over the
        natural frequency.

    Raises
    ------
    InputError
        If it is not a rig, is not shaken by one sine, or its mass has no spring.
    """
    given = one_sine(as_rig(rig), "amplitude")
    oscillator, shaken = given.oscillator, given.sine
    natural = oscillator.natural_frequency
    low, high = span or (_short(LOWEST * natural), _short(HIGHEST * natural))
    if not 0.0 < low < high:
        raise InputError(
            f"span: {low:g} to {high:g} Hz is not valid; a rising range above 0 is accepted"
        )
    chosen = min(max(_short(_CHOSEN * natural), low), high)
    return State(
        name or given.name or "rig",
        oscillator,
        shaken.replace(frequency=chosen),
        (low, high),
        together=oscillator.right == oscillator.left,
    )


def _short(value: float) -> float:
    """Round to two digits."""
    return float(f"{value:.1e}")


class History(NamedTuple):
    """The state, where it began, and the ones that undo and redo lead to."""

    first: State
    """What reset leads to, and what the ranges of the knobs lie around."""
    now: State
    past: tuple[State, ...] = ()
    future: tuple[State, ...] = ()
    gesture: str = ""
    """What the last step belongs to: the many states of one drag are one step."""

    def to(self, state: State, gesture: str = "") -> History:
        """Go on to a state."""
        if state == self.now:
            return self._replace(gesture=gesture)
        if gesture and gesture == self.gesture:
            return self._replace(now=state, future=())
        past = (*self.past, self.now)[-MOST_STEPS:]
        return self._replace(now=state, past=past, future=(), gesture=gesture)

    def undo(self) -> History:
        """Go back by one step, if there is one."""
        if not self.past:
            return self
        *past, now = self.past
        future = (self.now, *self.future)[:MOST_STEPS]
        return self._replace(now=now, past=tuple(past), future=future, gesture="")

    def redo(self) -> History:
        """Take back an undo, if there was one."""
        if not self.future:
            return self
        now, *future = self.future
        past = (*self.past, self.now)[-MOST_STEPS:]
        return self._replace(now=now, past=past, future=tuple(future), gesture="")

    def anew(self, state: State) -> History:
        """Begin with another rig; undo leads back to this one."""
        return self.to(state)._replace(first=state)
