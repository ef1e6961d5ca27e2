"""The one exception that a user's mistake raises, and what to say of a name that does not exist."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class InputError(ValueError):
    """A value that the caller gave cannot be used.

    The message is one line that names the field, the value and what is accepted.
    """


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
    return f"{name!r}; {hint}{'One' if hint else 'one'} of {', '.join(names)} is accepted"
