"""Standard streams with any encoding, closed streams, and full disks."""

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
"""ASCII replacements for characters that an encoding does not have."""


def _plainly(error: UnicodeError) -> tuple[str, int]:
    assert isinstance(error, UnicodeEncodeError)
    signs = error.object[error.start : error.end]
    return "".join(_PLAIN.get(sign, "?") for sign in signs), error.end


codecs.register_error("vibroimpact.plain", _plainly)


def in_columns(line: str, encoding: str) -> str:
    """Replace characters that an encoding does not have, and keep the columns of a table aligned.

    A replacement may be longer than its character. The next gaps between columns are shortened to
    compensate for this, but at least two blanks are kept.
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
    """Return the number of columns of a text. A combining dot above a letter requires no column."""
    return sum(not unicodedata.combining(sign) for sign in text)


def take_any_encoding() -> None:
    """Make stdout and stderr replace characters that their encoding does not have."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="vibroimpact.plain")


def hold_closed_streams() -> None:
    """Reserve the numbers of closed standard streams, so that files do not get them.

    Otherwise the messages that a library writes to standard error would end in a file of results.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            held = os.open(os.devnull, os.O_RDWR)  # this is the lowest free number
            os.set_inheritable(held, True)  # child processes must not reuse it either


def flush() -> None:
    """Flush stdout so that an error is raised here, and not at the exit of the program."""
    if sys.stdout is not None:  # stdout may be closed
        sys.stdout.flush()


def give_up_stdout() -> None:
    """Discard the rest of the output, because stdout cannot be written to."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
