"""The folder of results, and the printed output: progress, summaries and warnings."""

from __future__ import annotations

import io
import json
import logging
import math
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from vibroimpact.cli.garbage_collection import search_as_usual
from vibroimpact.cli.terminal import in_columns
from vibroimpact.errors import InputError, InputWarning, printable
from vibroimpact.stderr import print_line

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
    from rich.progress import Progress

WIDTH = 100
"""Number of columns of a summary in a file or a pipe."""

_CUT = "…"
"""Character that rich writes where it leaves out text."""


class Folder(NamedTuple):
    """A folder for results."""

    path: Path
    before: frozenset[Path]
    """Files that existed in the folder before the command."""

    def __truediv__(self, name: str) -> Path:
        return self.path / name


@contextmanager
def output_folder(text: str) -> Iterator[Folder]:
    """Make a folder, and check that it can be written to before anything is computed.

    If the computation fails, the folders that were made here are removed again if they are empty.

    Raises
    ------
    InputError
        If the path is not a folder, or if the folder cannot be made or written to.
    """
    folder = Path(text)
    made = []
    for part in (folder, *folder.parents):
        if part.exists():
            break
        made.append(part)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = "it is a file" if folder.is_file() else error.strerror or str(error)
        _remove_empty(made)
        raise InputError(
            f"--output: {text!r} cannot be written to ({reason}); "
            "pass a folder that you may write to"
        ) from None
    try:
        yield Folder(folder, frozenset(_files(folder)))
    except BaseException:
        _remove_empty(made)
        raise


def _files(folder: Path) -> Iterator[Path]:
    """Yield the files in a folder and in its subfolders, one level deep."""
    for pattern in ("*", "*/*"):
        yield from (path for path in folder.glob(pattern) if path.is_file())


def _remove_empty(folders: list[Path]) -> None:
    for folder in folders:
        try:
            folder.rmdir()
        except OSError:
            return


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int | None], None]]:
    """Yield a function that shows progress on stderr, as a bar or, in a log, as lines."""
    with search_as_usual(), _bar_or_lines(what) as progress:
        yield progress


@contextmanager
def _bar_or_lines(what: str) -> Iterator[Callable[[int, int | None], None]]:
    if not _is_terminal():
        from vibroimpact.tasks.progress import progress_lines

        yield progress_lines(what)
        return
    with _bars() as bars:
        task = bars.add_task(what, total=None)
        yield lambda done, total: bars.update(task, completed=done, total=total)


@contextmanager
def busy(what: str) -> Iterator[None]:
    """Show on a terminal, below the progress of the command, that something takes seconds."""
    if not _is_terminal():
        yield
        return
    with _bars() as bars:
        task = bars.add_task(what, total=None)
        try:
            yield
        finally:
            bars.remove_task(task)


def _is_terminal() -> bool:
    return bool(sys.stderr and sys.stderr.isatty())


_shown: list[Progress] = []
"""The bars on the terminal, which has room for one list of them."""


@contextmanager
def _bars() -> Iterator[Progress]:
    from rich.console import Console
    from rich.progress import Progress, TimeElapsedColumn

    if _shown:
        yield _shown[0]
        return
    columns = (*Progress.get_default_columns(), TimeElapsedColumn())
    with Progress(*columns, console=Console(file=sys.stderr), transient=True) as bars:
        _shown.append(bars)
        try:
            yield bars
        finally:
            _shown.clear()


def tell(
    summary: RenderableType,
    facts: dict[str, Any],
    folder: Folder,
    files: dict[str, Path],
    as_json: bool,
) -> None:
    """Print a summary, or only its facts as JSON.

    Both end with the list of written files. Files that replaced an older file are marked.
    """
    replaced = [path for path in files.values() if path in folder.before]
    if as_json:
        everything = {**facts, "files": files, "replaced": replaced}
        print(json.dumps(_plain(everything), indent=2, allow_nan=False))
        return
    from rich.console import Console
    from rich.text import Text

    lines = [f"  {path}{' (replaced)' if path in replaced else ''}" for path in files.values()]
    lines = [line.replace("\n", r"\n") for line in lines]

    # A file or a pipe has no width.
    terminal = sys.stdout is None or sys.stdout.isatty()
    console = Console(file=sys.stdout, width=None if terminal else WIDTH, highlight=False)
    console.width = _wide_enough(summary, console.width)
    with console.capture() as captured:
        console.print(_without_commands(console, summary), Text(), sep="\n")
        # A path is never wrapped or cut off.
        console.print(Text(printable("\n".join(["Files", *lines]))), soft_wrap=True)
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    for line in captured.get().splitlines():
        print(in_columns(line if terminal else line.rstrip(), encoding))


def _without_commands(console: Console, summary: RenderableType) -> RenderableType:
    """Escape control characters in names, before rich adds its own ones for colours."""
    from rich.segment import Segment, Segments

    parts = console.render(summary)
    return Segments(Segment(printable(one.text), one.style) for one in parts if not one.control)


def _wide_enough(summary: RenderableType, width: int) -> int:
    """Return a width at which no table is cut off. Narrower terminals break the lines."""
    from rich.console import Console

    while width < WIDTH:
        console = Console(file=io.StringIO(), width=width)
        with console.capture() as rendered:
            console.print(summary)
        if _CUT not in rendered.get():
            break
        width += 1
    return width


def warn(message: str) -> None:
    """Print a warning as one line on stderr."""
    print_line(f"warning: {' '.join(message.split())}")


@contextmanager
def warnings_in_lines() -> Iterator[None]:
    """Print each warning as one line on stderr. The same warning is printed only once."""
    printed: set[str] = set()
    with warnings.catch_warnings():
        usual = warnings.showwarning

        def show(
            message: Warning | str, category: type[Warning], *where: Any, **others: Any
        ) -> None:
            if not issubclass(category, InputWarning | RuntimeWarning):
                usual(message, category, *where, **others)
            elif str(message) not in printed:
                printed.add(str(message))
                warn(str(message))

        warnings.showwarning = show
        warnings.simplefilter("always", InputWarning)
        yield


@contextmanager
def font_warnings_once() -> Iterator[None]:
    """Print each message of matplotlib about a missing font once, not for each text."""
    printed: set[str] = set()

    def print_once(record: logging.LogRecord) -> bool:
        message = record.getMessage()
        if record.levelno >= logging.WARNING and message not in printed:
            printed.add(message)
            warn(message)
        return False

    log = logging.getLogger("matplotlib.font_manager")
    log.addFilter(print_once)
    try:
        yield
    finally:
        log.removeFilter(print_once)


def _plain(value: Any) -> Any:
    """Convert a value for JSON: NaN and infinity become None, and named tuples become mappings."""
    if hasattr(value, "_asdict"):
        value = value._asdict()
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return str(value) if isinstance(value, Path) else value
