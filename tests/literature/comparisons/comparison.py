"""One number of ours beside one of a publication or of another program."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from measured import find

Number = Callable[[], float]


class AbsentError(Exception):
    """A file or a program that a number needs is not here; says which."""


class Comparison(NamedTuple):
    """What is compared, and how near the source lets it be."""

    source: str
    """Authors, title and place, or the program and its version; Markdown."""
    quantity: str
    """What is compared, of which rig, with its unit."""
    theirs: str | Number
    """As the source prints it; or computed from what it prints, or by the program itself."""
    ours: Number
    within: float | None = None
    """Largest difference that the source supports; half a unit of its last digit, unless said."""
    differs: str = ""
    """Why the two do not agree, where they do not."""
    again: Number | None = None
    """The other's program once more, to see that `theirs` is what it gives; where it is here."""

    @property
    def value(self) -> float:
        """Theirs as a number."""
        return float(self.theirs) if isinstance(self.theirs, str) else self.theirs()

    @property
    def allowed(self) -> float:
        """The same as `within`, always a number."""
        if self.within is not None:
            return self.within
        assert isinstance(self.theirs, str)
        mantissa, _, power = self.theirs.partition("e")
        return 0.5 * 10.0 ** (int(power or 0) - len(mantissa.partition(".")[2]))


def data(name: str) -> Path:
    """A file of measured or computed data that is not part of the project."""
    if (path := find(name)) is None:
        raise AbsentError(f"the file {name.rsplit('/', 1)[-1]}, which is not part of the project")
    return path
