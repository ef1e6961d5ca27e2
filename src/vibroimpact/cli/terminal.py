"""Where words go: terminals and pipes of any encoding, disks that are full."""

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
"""What is written where an encoding lacks a sign."""


def _plainly(error: UnicodeError) -> tuple[str, int]:
    assert isinstance(error, UnicodeEncodeError)
    signs = error.object[error.start : error.end]
    return "".join(_PLAIN.get(sign, "?") for sign in signs), error.end


codecs.register_error("vibroimpact.plain", _plainly)


def in_columns(line: str, encoding: str) -> str:
    """Write in plain letters what an encoding lacks, without moving the columns of a table.

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
    """How many columns text takes: a dot above a letter takes none."""
    return sum(not unicodedata.combining(sign) for sign in text)


def take_any_encoding() -> None:
    """Let stdout and stderr write what their encoding lacks in plain letters."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="vibroimpact.plain")


def hold_closed_streams() -> None:
    """Let nothing that is opened take the place of a standard stream that is closed.

    What a library writes to standard error would end in a file of results.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            held = os.open(os.devnull, os.O_RDWR)  # it takes the lowest number that is free
            os.set_inheritable(held, True)  # nor may it in the processes that this one starts


def flush() -> None:
    """Write out what is held back; where that fails, it fails here and not at the exit."""
    if sys.stdout is not None:  # it may be closed
        sys.stdout.flush()


def give_up_stdout() -> None:
    """Throw away what is held back, for whoever should read it cannot."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
