"""What a file holds of one component, as plain numbers; and what a format provides."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.records.file import File


class Channel(NamedTuple):
    """One component of a record."""

    values: NDArray[np.float64]
    """As they stand in the file, but for a scale that the file states."""
    step: float | None
    """Time between them in s; None where the file does not say."""
    unit: str | None
    """Of the values, such as ``"cm/s^2"``; None where the file does not say."""
    station: str = ""
    component: str = ""
    also: tuple[str, ...] = ()
    """Other names of the component."""
    where: str = ""
    """Where in the file the step should stand, such as ``"line 4"``."""
    unclear: str = ""
    """What the values are if no unit may be guessed for them, such as ``"counts"``."""

    others: tuple[str, ...] = ()
    """Units that the file states of the values elsewhere."""
    of_name: str | None = None
    """The unit that the name of the column ends in, where another place states one."""
    notes: tuple[str, ...] = ()
    """What was assumed of the values or their times."""
    uneven: str = ""
    """Why times that the file has make no step, in words; empty where they do, or it has none."""

    def called(self, name: str) -> bool:
        """Whether the component has this name, in capitals or not."""
        return name.lower() in {one.lower() for one in (self.component, *self.also) if one}


class Format(NamedTuple):
    """A format: its name, whether a file is one by its content, and the file's channels.

    ``read`` raises `InputError` with the line that cannot be read.
    """

    name: str
    recognises: Callable[[File], bool]
    read: Callable[[File], list[Channel]]
