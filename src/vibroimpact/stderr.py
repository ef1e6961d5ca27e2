"""Lines of the program on standard error, which may be closed or full."""

from __future__ import annotations

import sys
from contextlib import suppress

from vibroimpact.errors import printable


def print_line(text: str) -> None:
    """Print a line on standard error if that can be written to; a computation goes on without it.

    Without a standard error (a daemon, ``pythonw``) `print` would write to standard output.
    """
    if sys.stderr is None:
        return
    with suppress(OSError, ValueError):  # a full disk, a stream that was closed
        print(f"vibroimpact: {printable(text)}", file=sys.stderr, flush=True)
