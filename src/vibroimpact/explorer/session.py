"""The session of one page, which computes the pictures of the newest request only.

A message changes the state at once. After that the pictures of the new state are computed, the
quick ones first. If the next message arrives, the remaining pictures are not computed any more.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable, Iterator
from functools import partial
from typing import Any, NamedTuple, NoReturn

import xarray as xr

from vibroimpact.engine import native
from vibroimpact.errors import InputError, shown
from vibroimpact.explorer import change, presets, share
from vibroimpact.explorer.controls import controls
from vibroimpact.explorer.files import made
from vibroimpact.explorer.laws import isolator_laws, stop_laws, words_of_stops
from vibroimpact.explorer.pictures import basins, branch, curves, motion, numbers, plane, scenario
from vibroimpact.explorer.state import ON_DEMAND, PageState, UndoHistory
from vibroimpact.figures.style import SCENARIOS
from vibroimpact.model.frequency_text import forcing
from vibroimpact.model.written_units import unitless, written_for
from vibroimpact.scenarios.axes import one_sine
from vibroimpact.scenarios.scenario import Scenario
from vibroimpact.tasks.threads import Progress, Stopped

Message = dict[str, Any]
MOST_SECONDS = 60.0
"""For one picture; the work that a page can ask for is bounded."""
_NO_NUMBER = (
    "value: with this value, some numbers of the rig are not finite; choose a less extreme value"
)
_PATIENCE = 0.25
"""Seconds that a coarse picture is waited for though another is asked for."""


class Stage(NamedTuple):
    """One picture that is to be computed."""

    kind: str
    key: Hashable
    """All that the picture depends on. A picture with the same key is not computed again."""
    make: Callable[[Progress], Message]

    @property
    def long(self) -> bool:
        """Whether the computation may take seconds, which is not the case for a coarse picture."""
        return isinstance(self.key, tuple) and self.key[0] != "coarse"


class Session:
    """The state of one page, and the pictures that were sent to it.

    The server calls `take` for each message, and `stages` after it. The session holds all data of a
    page, and their size is bounded.
    """

    def __init__(self, first: PageState) -> None:
        self.history = UndoHistory(first, first)
        self.asked = 0
        """Number of requests. Pictures of an older request are not computed any more."""
        self.number: int | None = None
        """Number of the last request, as the page counts."""
        self.ended = False
        """Whether the page was closed."""
        self._dragging = False
        self._sent: dict[str, Hashable] = {}
        self._sweeps: dict[bool, tuple[Hashable, xr.Dataset]] = {}

    @property
    def state(self) -> PageState:
        """The present state of the page."""
        return self.history.now

    def hello(self) -> Message:
        """Return the first message to a page: its presets, laws and scenarios."""
        return {
            "hello": True,
            "presets": presets.names(),
            "isolators": isolator_laws(),
            "stops": stop_laws(),
            "words": words_of_stops(),
            "scenarios": {name: area.colour for name, area in SCENARIOS.items()},
            "meanings": {one.label: one.meaning for one in Scenario},
            "plane": {"x": plane.STIFFNESS, "y": plane.GAP},
            "compiles": native.find_library() is None,
        }

    def take(self, message: object) -> Message:
        """Handle a message of a page, and return the answer: ``state`` with the knobs.

        If the message is invalid, the answer is ``refused`` with the reason, and the state does not
        change.
        """
        if not isinstance(message, dict) or not isinstance(message.get("do"), str):
            return {"refused": "message: it is not valid; reload the page"}
        number = message.get("n") if isinstance(message.get("n"), int) else None
        try:
            with written_for(None if message["do"] in ("preset", "open") else self.state):
                history = self._next(message)
            answer = shown_as(history)
        except (InputError, ArithmeticError) as error:
            # Numbers whose products are not finite are reported as a mistake.
            words = str(error) if isinstance(error, InputError) else _NO_NUMBER
            path = message.get("path") if isinstance(message.get("path"), str) else None
            refused = {"refused": words, "path": path, "n": number}
            return refused if message.get("do") != "open" else {**refused, **shown_as(self.history)}
        self.history = history
        self.asked += 1
        self._dragging = message.get("dragging") is True
        self.number = number
        for kind in set(ON_DEMAND) - self.state.shown:
            self._sent.pop(kind, None)  # what is put away is made again when it is asked for
        return {**answer, "n": number}

    def _next(self, message: Message) -> UndoHistory:
        """What the message makes of the history."""
        history, now, do = self.history, self.history.now, message["do"]
        if do == "undo":
            return history.undo()
        if do == "redo":
            return history.redo()
        if do == "reset":
            return history.to(history.first)
        if do == "preset":
            return history.restart(presets.preset(_text(message, "name")))
        if do == "open":
            opened = share.from_address(message.get("address"))
            return UndoHistory(opened, opened)
        if do == "change":
            value = _value(message, "value")
            gesture = str(message.get("gesture") or "")[:40]
            return history.to(change.moved(now, _text(message, "path"), value), gesture)
        if do == "law":
            return history.to(change.with_law(now, _text(message, "part"), _text(message, "kind")))
        if do == "together":
            return history.to(change.joined(now, message.get("on") is True))
        if do == "choose":
            there = change.chosen(now, _text(message, "direction"), _value(message, "frequency"))
            return history.to(there, "choose")
        if do == "look":
            there = change.looked(now, {_text(message, "what"): message.get("on") is True})
            return history.to(there, "look")
        if do == "place":
            point = (_number(message, "x"), _number(message, "y"))
            gesture = str(message.get("gesture") or "")[:40]
            return history.to(change.with_ratios(now, *point), gesture)
        raise InputError(f"message: the action {shown(do)} is unknown; reload the page")

    def stages(self) -> Iterator[Stage]:
        """Yield the pictures of the present state that are to be computed, quick ones first."""
        state = self.state
        rig = _of_sweep(state)
        look = (*rig, state.physical)
        seen = (*rig, state.direction, state.shaking.frequency)
        yield Stage("curves", ("coarse", *look), partial(self._curves, state, False))
        yield Stage("motion", ("coarse", *seen), lambda _: motion.quick(state, self._best(state)))
        yield Stage(
            "scenario", ("coarse", *rig), lambda _: scenario.quick(state, self._swept(state, False))
        )
        if self._dragging:
            return
        yield Stage("curves", ("fine", *look), partial(self._curves, state, True))
        yield Stage("motion", ("fine", *seen), lambda _: motion.careful(state, self._best(state)))
        yield Stage("scenario", ("fine", *rig), partial(scenario.careful, state))
        yield from self._on_demand(state, (*look, *seen), seen)

    def _on_demand(
        self, state: PageState, branched: tuple[Hashable, ...], seen: tuple[Hashable, ...]
    ) -> Iterator[Stage]:
        """The pictures that take seconds, where they are asked for."""
        if "branch" in state.shown:
            yield Stage(
                "branch",
                ("fine", *branched),
                lambda check: branch.branches(state, self._best(state), check),
            )
        for kind in ("map", "basins"):
            if kind not in state.shown:
                continue
            for fine in (False, True):
                word = "fine" if fine else "coarse"
                if kind == "basins":
                    yield Stage(kind, (word, *seen), partial(basins.starts, state, fine))
                    continue
                try:
                    where = plane.plane(state)
                except (InputError, ArithmeticError) as error:
                    yield Stage(kind, (word, str(error)), partial(_refuse, error))
                    break
                yield Stage(kind, (word, *where), partial(plane.scenarios, where, fine))

    def wants(self, stage: Stage) -> bool:
        """Return whether neither this picture nor a finer one was sent to the page."""
        sent = self._sent.get(stage.kind)
        assert isinstance(stage.key, tuple)
        return sent not in (stage.key, ("fine", *stage.key[1:]))

    def sent(self, stage: Stage) -> None:
        """Record that a picture was sent to the page."""
        self._sent[stage.kind] = stage.key

    def make(self, stage: Stage, asked: int, progress: Progress | None = None) -> Message:
        """Compute a picture, unless another request arrives.

        Raises
        ------
        Stopped
            If another request arrived.
        InputError
            If the computation takes too long, or if a number of the rig is not finite.
        """
        # Time of the first report of progress: what is compiled before is not counted.
        begun: float | None = None
        # A coarse picture is worth its milliseconds, or a knob that is turned fast would show none.
        patience = 0.0 if stage.long else _PATIENCE

        def check(done: int, total: int | None) -> None:
            nonlocal begun
            begun = begun or time.monotonic()
            taken = time.monotonic() - begun
            if self.asked != asked and taken >= patience:
                raise Stopped
            if taken > MOST_SECONDS:
                raise InputError(
                    f"{stage.kind}: the computation took longer than {MOST_SECONDS:g} s and was "
                    "stopped; to reduce the time, add damping or show fewer pictures"
                )
            if progress:
                progress(done, total)

        if self.asked != asked:
            raise Stopped
        return _bounded(lambda: stage.make(check))

    def file(self, kind: str, state: PageState | None = None) -> Message:
        """Return a file that the page saves. Default of the state: the present state of the page.

        Raises
        ------
        InputError
            If the kind of file is unknown.
        Stopped
            If the page was closed.
        """
        here = state or self.state

        def check(done: int, total: int | None) -> None:
            if self.ended:
                raise Stopped

        check(0, None)
        return _bounded(lambda: made(kind, here, lambda: self._swept(here, True, check)))

    def end(self) -> None:
        """Record that the page was closed, so that all its computations stop."""
        self.ended = True
        self.asked += 1

    def _swept(self, state: PageState, fine: bool, progress: Progress | None = None) -> xr.Dataset:
        """The sweep of a state; the last one of either fineness is kept."""
        key = _of_sweep(state)
        held = self._sweeps.get(fine)
        if held is None or held[0] != key:
            held = self._sweeps[fine] = (key, curves.swept(state, fine, progress))
        return held[1]

    def _best(self, state: PageState) -> xr.Dataset:
        """The fine sweep if it is there."""
        key = _of_sweep(state)
        held = self._sweeps.get(True)
        return held[1] if held and held[0] == key else self._swept(state, False)

    def _curves(self, state: PageState, fine: bool, progress: Progress | None = None) -> Message:
        return curves.curves(state, self._swept(state, fine, progress), fine)


def shown_as(history: UndoHistory) -> Message:
    """Return the present state in the form in which it is sent to a page.

    Raises
    ------
    InputError
        If several harmonics shake the rig, or if its isolator has no stiffness.
    """
    state, rig = history.now, history.now.oscillator
    with written_for(state):
        one_sine(state.rig, "amplitude")
        values = {
            "name": state.name,
            "controls": [control._asdict() for control in controls(state, history.first)],
            "laws": {
                "isolator": rig.isolator.kind,
                "right": rig.right.kind if rig.right else "none",
                "left": rig.left.kind if rig.left else "none",
            },
            "together": state.together,
            "physical": state.physical,
            "direction": state.direction,
            "without_units": unitless(),
            "frequency": numbers.forcing(state.shaking.frequency),
            "frequency_text": forcing(state.shaking.frequency, 5).removeprefix("ω = "),
            "shown": sorted(state.shown),
            "undo": len(history.past),
            "redo": len(history.future),
            "address": share.address(state),
        }
    return {"state": values}


def _bounded(make: Callable[[], Message]) -> Message:
    """Make something of a rig whose numbers may have no bound.

    Raises
    ------
    InputError
        If they have none.
    """
    try:
        return make()
    except ArithmeticError:
        raise InputError(_NO_NUMBER) from None


def _refuse(error: Exception, _: Progress) -> NoReturn:
    raise error


def _of_sweep(state: PageState) -> tuple[Hashable, ...]:
    """All that a sweep depends on, which is not the frequency of the selected motion."""
    shaken = state.shaking
    return state.oscillator, (shaken.amplitude, shaken.of, shaken.phase), state.span


def _text(message: Message, key: str) -> str:
    value = message.get(key)
    if not isinstance(value, str) or len(value) > 200:
        raise InputError(
            f"{key}: {shown(value)} is not valid; use a string of at most 200 characters"
        )
    return value


def _value(message: Message, key: str) -> float | str:
    value = message.get(key)
    if isinstance(value, int | float) and not isinstance(value, bool):
        return value
    return _text(message, key)


def _number(message: Message, key: str) -> float:
    value = _value(message, key)
    if isinstance(value, str):
        raise InputError(f"{key}: {shown(value)} is not valid; use a number")
    return value
