"""Result of the readers, one component of a record; and the functions of a format."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.tables.file import File
from vibroimpact.tables.statements import StatedPeak


class Channel(NamedTuple):
    """One component of a record."""

    values: NDArray[np.float64]
    """Values in the file, multiplied by the scale that the file states."""
    step: float | None
    """Time between samples in s. None if the file does not state it."""
    unit: str | None
    """Unit of the values, such as ``"cm/s^2"``. None if the file does not state it."""
    station: str = ""
    component: str = ""
    also: tuple[str, ...] = ()
    """Other names of the component."""
    where: str = ""
    """Place in the file where the step should be, such as ``"line 4"``."""
    unclear: str = ""
    """Kind of the values if their unit must not be guessed, such as ``"counts"``."""

    others: tuple[str, ...] = ()
    """Units of the values that the file states at other places."""
    of_name: str | None = None
    """Unit at the end of the name of the column, if another place states a unit, too."""
    notes: tuple[str, ...] = ()
    """Assumptions about the values or their times."""
    no_step: str = ""
    """Reason why the file does not give one step, such as uneven times, or statements that
    contradict each other. Empty if there is no such reason."""
    times: NDArray[np.float64] | None = None
    """Uneven times of the values (s), which never decrease. A step that is passed interpolates
    between them."""
    peaks: tuple[StatedPeak, ...] = ()
    """Peaks that the file states of the values."""
    damage: str = ""
    """Reason why the values cannot be used. An error is raised if the component is chosen."""

    def called(self, name: str) -> bool:
        """Return whether the component has this name. Upper and lower case do not matter."""
        return name.lower() in {one.lower() for one in (self.component, *self.also) if one}


class Format(NamedTuple):
    """A file format: its name, and functions that recognise and read its files.

    ``recognises`` judges the content of a file. ``read`` returns its channels in the units of the
    file. If a line cannot be read, it raises an `InputError` that states this line, as `File` does
    for numbers in columns or rows.

    A new format is a module with a `Format`, which stands in `FORMATS` of `records/read.py` before
    any other that would recognise its files. `records/header.py` compares stated peaks, steps and
    durations with the values. Add a synthetic file to `tests/records/layouts.py`, and one that
    contradicts its header and a truncated one to `tests/records/test_networks.py`.
    """

    name: str
    recognises: Callable[[File], bool]
    read: Callable[[File], list[Channel]]
