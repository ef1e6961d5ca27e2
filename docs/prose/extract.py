"""Write docstrings, help texts and messages of the source as text that a prose linter reads.

python docs/prose/extract.py SOURCE FOLDER

Each module becomes a file of the same name in FOLDER, with every text at its line of the source.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

LEAST_WORDS = 3
"""Strings with fewer words are names, keys and units."""


def texts(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Yield the strings of a module that are sentences, with their lines."""
    parts = {
        id(part)
        for node in ast.walk(tree)
        if isinstance(node, ast.JoinedStr)
        for part in node.values
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            words = [
                one.value if isinstance(one, ast.Constant) else "`value`" for one in node.values
            ]
            yield node.lineno, "".join(str(word) for word in words)
        elif (
            isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in parts
        ):
            yield node.lineno, node.value


def as_text(source: str) -> str:
    """Return the sentences of a module, each at its line."""
    lines = [""] * (source.count("\n") + 2)
    for number, text in texts(ast.parse(source)):
        if len(text.split()) < LEAST_WORDS:
            continue
        for offset, line in enumerate(text.splitlines()):
            at = min(number - 1 + offset, len(lines) - 1)
            # Markup of a docstring is none of Markdown: indents would be code.
            plain = re.sub(r"``(.+?)``", r"`\1`", line.strip())
            lines[at] = f"{lines[at]} {plain}".strip()
    return "\n".join(lines)


def main(source: Path, folder: Path) -> None:
    """Write the text of each module below a folder of sources."""
    for path in source.rglob("*.py"):
        target = folder / path.relative_to(source).with_suffix(".py.md")
        target.parent.mkdir(parents=True, exist_ok=True)
        text = as_text(path.read_text(encoding="utf-8"))
        target.write_text(text, encoding="utf-8", errors="replace")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
