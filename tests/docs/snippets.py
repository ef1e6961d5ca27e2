"""The fenced blocks of a Markdown page, run as a reader would run them.

- ``python`` blocks of a page are one script. What a block prints stands in a ``text`` block
  right behind it.
- ``console`` blocks hold ``$ vibroimpact ...`` commands and what they print.
- A ``toml`` block that begins with a comment such as ``# wall.toml`` is that file.
- ``sh`` and other blocks are only read.

In what a page shows, a line of three dots stands for any lines. Blocks that take long, and those
that need their results, follow a line ``<!--full-run-->``: the daily run leaves them out.

After a change that changes what is printed: ``python tests/docs/snippets.py`` writes it into all
pages, except where a block has such dots, and what a page draws and shows to where it is shown.
"""

from __future__ import annotations

import contextlib
import io
import math
import re
import shlex
import sys
import tempfile
from collections.abc import Iterator
from filecmp import cmp
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple
from unittest.mock import patch

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))  # as a script

from printed import same_print  # noqa: E402
from vibroimpact.cli import main  # noqa: E402

PAGES = sorted(
    [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")],
)

FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"!\[[^\]]+\]\(([^)\s]+)\)")
LATER = "<!--full-run-->\n\n"
"""What stands before a block of the full run."""
_FILE = re.compile(r"# ([\w.-]+\.toml)\n")


class Shown(NamedTuple):
    """What a page says that a block prints, and what it does print."""

    start: int
    """Where in the page the shown text begins."""
    end: int
    expected: str
    printed: str

    @property
    def agrees(self) -> bool:
        """Whether the two are the same, up to the last digits of numbers."""
        return same_print(self.expected, self.printed)


def run_page(text: str, name: str = "page", full: bool = True) -> Iterator[Shown]:
    """Run a page's blocks in the present folder, one after the other."""
    blocks: list[re.Match[str] | None] = [*FENCE.finditer(text), None]
    script: dict[str, Any] = {"__name__": "__main__"}
    for block, following in pairwise(blocks):
        assert block
        kind, code = block.groups()
        if not full and text[: block.start()].endswith(LATER):
            continue
        if kind == "python":
            line = text.count("\n", 0, block.start(2))
            compiled = compile("\n" * line + code, name, "exec")
            with contextlib.redirect_stdout(io.StringIO()) as out:
                exec(compiled, script)
            at, expected = block.end(), ""
            if following and following[1] == "text" and not _between(text, block, following):
                at, expected = following.start(2), following[2]
            yield Shown(at, at + len(expected), expected, out.getvalue())
        elif kind == "console":
            yield from _console(code, block.start(2))
        elif kind == "toml" and (file := _FILE.match(code)):
            Path(file[1]).write_text(code, encoding="utf-8")


def _console(code: str, start: int) -> Iterator[Shown]:
    for piece in re.finditer(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", code, re.MULTILINE):
        words = shlex.split(piece[1], comments=True)
        if words[:1] != ["vibroimpact"]:
            raise AssertionError(f"a console block shows vibroimpact only, not {piece[1]!r}")
        out, err = io.StringIO(), io.StringIO()
        with (
            contextlib.redirect_stdout(out),
            contextlib.redirect_stderr(err),
            # A busy machine, or one that compiles, may take long enough for lines of progress.
            patch("vibroimpact.tasks.progress.LINES", math.inf),
        ):
            ended = main(words[1:])
        said = "".join(line for line in err.getvalue().splitlines(True) if "compiling" not in line)
        if piece[2] and ended != (2 if "error:" in piece[2] else 0):
            raise AssertionError(f"{piece[1]!r} ended with {ended}: {said}")
        yield Shown(start + piece.start(2), start + piece.end(2), piece[2], said + out.getvalue())


def _between(text: str, block: re.Match[str], following: re.Match[str]) -> str:
    return text[block.end() : following.start()].strip()


def _trimmed(text: str) -> str:
    return "".join(f"{line.rstrip()}\n" for line in text.rstrip().splitlines())


def _renew(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for shown in reversed(list(run_page(text, str(page)))):
            if shown.agrees:
                continue
            line = text.count("\n", 0, shown.start) + 1
            if "\n..." in f"\n{shown.expected}":
                print(f"{page}:{line} must be changed by hand to fit\n{shown.printed}")
            else:
                text = text[: shown.start] + _trimmed(shown.printed) + text[shown.end :]
                print(f"{page}:{line} renewed")
        for target in PICTURE.findall(text):
            kept = (page.parent / target).resolve()
            drawn = next(Path().rglob(kept.name), None)
            if drawn and not (kept.is_file() and cmp(drawn, kept, shallow=False)):
                kept.write_bytes(drawn.read_bytes())
                print(f"{kept} drawn")
    page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    for path in [Path(word).resolve() for word in sys.argv[1:]] or PAGES:
        _renew(path)
