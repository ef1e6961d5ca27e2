"""Errors and warnings about invalid input, and suggestions for unknown names."""

from __future__ import annotations

import difflib
import itertools
import re
import sys
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

LONGEST = 320
"""Largest number of characters of a message, excluding full paths of files."""
_END = LONGEST // 3
"""Number of characters kept of its end, which states what to do."""
_LONGEST_NAME = 60
"""Largest number of characters of a wrong name that are compared with accepted names."""
_LONG_WORD = re.compile(r"(\S{60})\S{140,}")
"""A word with more than 200 characters, which is shortened. Paths may have 200 characters."""
_PATH = re.compile(r"'(?:/|[A-Za-z]:\\)[^']*'")
_LIST = re.compile(r"(?:[^\s,;:]+(?: [^\s,;:]+){0,3}, ){4,}")
"""Items of a list except for the last one. Each item has at most four words."""


class InputError(ValueError):
    """Exception that is raised if a value passed by the caller is invalid.

    The message is one line of about 300 characters at most. It states the name of the field, its
    value, and what to do.
    """

    def __init__(self, message: object = "") -> None:
        super().__init__(short_line(_LONG_WORD.sub(r"\1...", printable(str(message)))))


class DependentError(InputError):
    """Invalid input that another invalid value of the same input explains, such as the mass."""


@contextmanager
def errors_at(where: str) -> Iterator[None]:
    """Put a place, such as ``"links.base: "``, before the message of an `InputError`."""
    try:
        yield
    except InputError as error:
        raise InputError(f"{where}{error}") from None


class InputWarning(UserWarning):
    """Warning that is issued if part of an input was assumed, or if a value is probably a mistake.

    The value is used nevertheless. Commands print the warning as one line. Datasets keep it in
    their attribute ``notes``.
    """


def warn_of_input(what: str, notes: Iterable[str]) -> None:
    """Issue one `InputWarning` with all notes on one input.

    Parameters
    ----------
    what
        The input, such as ``"record 'quake.csv'"``.
    notes
        Assumptions and doubts about the input. Without notes, no warning is issued.
    """
    if text := "; ".join(notes):
        warnings.warn(f"{what}: {text}", InputWarning, stacklevel=outside())


def warn_of_result(message: str) -> None:
    """Issue a `RuntimeWarning` that a result is incomplete, or is less than it may seem."""
    warnings.warn(message, RuntimeWarning, stacklevel=outside())


_INSIDE = ("vibroimpact", "pydantic", "contextlib")
"""Packages whose frames no warning points to."""


def outside() -> int:
    """Return the stacklevel, for the caller of this function, of the code that uses the package."""
    frame, level = sys._getframe(1), 1
    while frame.f_back is not None and frame.f_globals["__name__"].partition(".")[0] in _INSIDE:
        frame, level = frame.f_back, level + 1
    return level


def short_line(message: str) -> str:
    """Return a message as one line of at most `LONGEST` characters, excluding full paths of files.

    If the message is longer, items before the last one are removed from its longest list. If this
    is not enough, its middle is removed.
    """
    text = " ".join(message.split())
    most = LONGEST + sum(len(path) for path in _PATH.findall(text))
    while len(text) > most and (lists := list(_LIST.finditer(text))):
        longest = max(lists, key=lambda one: len(one[0]))
        items = longest[0].split(", ")[:-1]
        room = len(longest[0]) - (len(text) - most) - len(f"... {len(items)} more ..., ")
        ends = itertools.accumulate(len(item) + 2 for item in items)
        kept = max(1, sum(end <= room for end in ends))
        items[kept:] = [f"... {len(items) - kept} more ..."]
        text = f"{text[: longest.start()]}{', '.join(items)}, {text[longest.end() :]}"
    if len(text) > most:
        text = f"{text[: most - _END - 5]} ... {text[-_END:]}"
    return text


def shown(value: object) -> str:
    """Return an invalid value as one short line."""
    try:
        text = " ".join(repr(value).split())
    except Exception:  # of a class that the user wrote
        text = f"a {type(value).__name__}"
    return text if len(text) <= 60 else f"{text[:57]}..."


_LIKENESS = 0.8
"""Least similarity of a wrong name to the name that is suggested."""


def suggested(words: str) -> str:
    """Return a suggestion of some words, such as ``did you mean gap? ``, or "" without words."""
    return f"did you mean {words}? " if words else ""


def meant(name: object, accepted: Iterable[str], cutoff: float = _LIKENESS) -> str:
    """Return a suggestion for a wrong name, such as ``did you mean gap? ``, or ""."""
    return suggested(similar(name, accepted, cutoff))


def advised(suggestion: str, what: str) -> str:
    """Return a suggestion or "", followed by the advice to use what is accepted."""
    return f"{suggestion}{'Use' if suggestion else 'use'} {what}"


def alternatives(names: Iterable[str]) -> str:
    """Return names as a list in words, such as ``gap, mass or amplitude``."""
    every = list(names)
    return " or ".join(filter(None, (", ".join(every[:-1]), *every[-1:])))


def similar(name: object, accepted: Iterable[str], cutoff: float = _LIKENESS) -> str:
    """Return the accepted name that a wrong name probably means, or ""."""
    written = name.strip()[:_LONGEST_NAME] if isinstance(name, str) else ""
    names = list(accepted)
    for one in (written, written.lower().replace("-", "_")):
        if close := difflib.get_close_matches(one, names, n=1, cutoff=cutoff):
            return close[0]
    return ""


def unknown(name: object, accepted: Iterable[str]) -> str:
    """Return the text of an error about an unknown name, with the accepted names."""
    names = list(accepted)
    return f"{shown(name)} is unknown; {advised(meant(name, names), alternatives(names))}"


UNPRINTABLE = re.compile("[\x00-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
"""Control characters, which can control terminals, and characters that change the text
direction."""


def printable(text: str) -> str:
    r"""Return a text in which control characters, but not line breaks and tabs, are escaped."""
    return UNPRINTABLE.sub(lambda one: one[0] if one[0] in "\n\t" else ascii(one[0])[1:-1], text)


def in_one_line(text: str) -> str:
    """Return a text, such as a file name, as one line without control characters."""
    return " ".join(printable(text).split())
