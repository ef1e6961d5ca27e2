"""Standard error and output, which may be closed or full."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import (
    AbstractContextManager,
    ExitStack,
    contextmanager,
    nullcontext,
    redirect_stderr,
    redirect_stdout,
    suppress,
)

from vibroimpact.errors import printable

busy: Callable[[str], AbstractContextManager[object]] = nullcontext
"""Entered with a description while something takes seconds; commands show a bar on a terminal."""


def print_line(text: str) -> None:
    """Print a line on standard error. If this is not possible, do nothing.

    In a process without standard error, such as a daemon or ``pythonw``, `print` would write to
    standard output.
    """
    if sys.stderr is None:
        return
    with suppress(OSError, ValueError):  # a full disk, a stream that was closed
        print(f"vibroimpact: {printable(text)}", file=sys.stderr, flush=True)


@contextmanager
def open_streams() -> Iterator[None]:
    """Replace a standard stream that is closed, for libraries that expect an open one."""
    with ExitStack() as stack:
        for stream, redirect in ((sys.stdout, redirect_stdout), (sys.stderr, redirect_stderr)):
            if stream is None:
                nowhere = stack.enter_context(open(os.devnull, "w"))
                stack.enter_context(redirect(nowhere))
        yield
