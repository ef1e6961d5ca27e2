"""Standard streams: any encoding, closed streams, full disks."""

from __future__ import annotations

import codecs
import os
import re
import sys
import unicodedata
from contextlib import suppress

_PLAIN = {
    "η": "eta",
    "λ": "lambda",
    "δ": "delta",
    "ξ": "xi",
    "τ": "tau",
    "φ": "phi",
    "ω": "omega",
    "π": "pi",
    "µ": "u",
    "\u0307": "'",
    "²": "^2",
    "³": "^3",
    "±": "+-",
    "×": "x",
    "·": " ",
    "√": "sqrt",
    "∞": "inf",
    "°": "deg",
    "→": "->",
    "≤": "<=",
    "≥": ">=",
    "–": "-",
    "—": "-",
    "−": "-",
    "…": "...",
    "‘": "'",
    "’": "'",
    "“": '"',
    "”": '"',
    "é": "e",
    "á": "a",
}
"""Plain letters in place of signs that an encoding lacks."""


def _plainly(error: UnicodeError) -> tuple[str, int]:
    assert isinstance(error, UnicodeEncodeError)
    signs = error.object[error.start : error.end]
    return "".join(_PLAIN.get(sign, "?") for sign in signs), error.end


codecs.register_error("vibroimpact.plain", _plainly)


def in_columns(line: str, encoding: str) -> str:
    """Replace signs that an encoding lacks by plain letters, and keep the columns of a table.

    Plain letters need more room; it is taken from the next gaps, of which two blanks are kept.
    """
    owed = 0
    parts = []
    for part in re.split("( {3,})", line):
        if part.startswith("   "):
            kept = max(2, len(part) - owed)
            owed -= len(part) - kept
            parts.append(" " * kept)
        else:
            plain = part.encode(encoding, "vibroimpact.plain").decode(encoding)
            owed += _columns(plain) - _columns(part)
            parts.append(plain)
    return "".join(parts)


def _columns(text: str) -> int:
    """Return the number of columns of a text; a dot above a letter needs none."""
    return sum(not unicodedata.combining(sign) for sign in text)


def take_any_encoding() -> None:
    """Make stdout and stderr replace signs that their encoding lacks."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="vibroimpact.plain")


def hold_closed_streams() -> None:
    """Keep the numbers of closed standard streams from files that are opened later.

    What a library writes to standard error would end in a file of results.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            held = os.open(os.devnull, os.O_RDWR)  # it takes the lowest number that is free
            os.set_inheritable(held, True)  # nor may it in the processes that this one starts


def flush() -> None:
    """Flush stdout, so that an error is raised here and not at the exit."""
    if sys.stdout is not None:  # it may be closed
        sys.stdout.flush()


def give_up_stdout() -> None:
    """Discard the rest of stdout, because nobody can read it."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
