"""The error and the warning of input, and what to say of a name that does not exist."""

from __future__ import annotations

import difflib
import re
import warnings
from collections.abc import Iterable

_LONGEST = 1200
"""Letters of a message; lists of names that are accepted have some hundreds."""
_LONG_WORD = re.compile(r"(\S{60})\S{140,}")
"""A value that was given whole; a path may have 200 letters."""


class InputError(ValueError):
    """A value that the caller gave cannot be used.

    The message is one line that names the field, the value and what is accepted; of a line that is
    very long, because a name or a value is, the middle is left out.
    """

    def __init__(self, message: object = "") -> None:
        text = _LONG_WORD.sub(r"\1...", " ".join(printable(str(message)).split()))
        if len(text) > _LONGEST:
            text = f"{text[: _LONGEST // 2]} ... {text[-_LONGEST // 4 :]}"
        super().__init__(text)


class InputWarning(UserWarning):
    """A value is used, but part of it had to be assumed, or it is probably not what was meant.

    Commands print it as a line; datasets keep it in their attribute ``notes``.
    """


def warn_of_input(what: str, notes: Iterable[str], stacklevel: int = 3) -> None:
    """Issue one `InputWarning` about one input, if there is anything to note.

    Parameters
    ----------
    what
        The input, such as ``"record 'quake.csv'"``.
    notes
        What was assumed for it, or is doubted, in words.
    stacklevel
        As of `warnings.warn`; 3 is the caller of the function that calls this.
    """
    if told := "; ".join(notes):
        warnings.warn(f"{what}: {told}", InputWarning, stacklevel=stacklevel)


def shown(value: object) -> str:
    """Show a refused value on one short line."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."


def meant(name: object, accepted: Iterable[str]) -> str:
    """Words for the name that a wrong one is nearest to, such as ``did you mean gap?``, or none."""
    if not isinstance(name, str):
        return ""
    written = name.strip().lower().replace("-", "_")
    close = difflib.get_close_matches(written, list(accepted), n=1, cutoff=0.8)
    return f"did you mean {close[0]}? " if close else ""


def unknown(name: object, accepted: Iterable[str]) -> str:
    """Words for a message about a name that is none of those accepted."""
    names = list(accepted)
    hint = meant(name, names)
    return f"{shown(name)}; {hint}{'One' if hint else 'one'} of {', '.join(names)} is accepted"


UNPRINTABLE = re.compile("[\x00-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
"""Control characters, by which terminals can be steered, and those that turn text round."""


def printable(text: str) -> str:
    r"""Write control characters as escapes such as \x1b; line breaks and tabs stay."""
    return UNPRINTABLE.sub(lambda one: one[0] if one[0] in "\n\t" else ascii(one[0])[1:-1], text)
