"""Check that no text uses the words that the project avoids (CONTRIBUTING.md, "Style").

python docs/check_words.py PATH...

A Markdown page is read without its code. Of a Python file, the strings of three words or more are
read: docstrings, help and messages.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

AVOIDED = [
    (r"(?i)\btold\b(?!\s+(?:apart|from))", "is reported, prints, states"),
    (
        r"(?i)\btells?\b(?!(?:\s+[^\s.,;:]+){0,5}?\s+(?:apart|from)\b)",
        "states, returns, shows, determines",
    ),
    (
        r"(?i)\b(?:is|are|was|were|be|been)\s+said\b|\bunless\s+said\b|\bwhat\s+is\s+said\b",
        "is stated, prints",
    ),
    (
        r"(?i)\bbehind\s+(?:it|them|this|each|which|the\s+(?:event|events|record|records|impact|"
        r"impacts|last|first|end|cycle|cycles|step|contact|contacts|jump|resonance|peak|fold))\b",
        "after, beyond",
    ),
    (
        r"(?<!\b[Tt]here\s)\b(?:is|are|was|were)\s+no\s+"
        r"(?!longer\b|more\b|less\b|fewer\b|better\b|worse\b|other\b|such\b|[a-z]+er\b)[a-z]+",
        "is not a",
    ),
    (
        r"(?i)\bone\s+an?\s+(?:processor|thread|rig|record|value|cycle|node|line|column|frequency|"
        r"row|side|step|hold|test|motion)\b",
        "one per",
    ),
    (r"(?i)\bnobody\s+knows\b", "an unknown number"),
    (r"(?i)\basked\s+(?:of|for\s+of)\b", "required of, computed for"),
    (r"(?i)\blook(?:s|ed)?\s+at\b", "inspect, check"),
    (
        r"(?i)\bby\s+hand\s+of\b|\bgoes\s+ahead\b|\btheir\s+own\s+of\b|\bits\s+own\s+of\b|"
        r"\btaken\s+up\s+again\b|\bhang\s+together\b|\bwhat\s+follows\s+what\b",
        "a plain clause",
    ),
    (r"(?i)\bwhat\s+(?:is|was)\s+(?:found|given|asked|taken|sought)\b", "the result, the argument"),
    (
        r"(?i)\bunless\s+(?:another|one|it|they)\s+is\s+(?:given|named)\b|"
        r"\bof\s+a\s+(?:case|frequency)\s+\d",
        "Default:",
    ),
]
"""Patterns, and what to write instead."""

_LEAST_WORDS = 3
"""Strings with fewer words are names, keys and units."""
_CODE = re.compile(r"^(```+|~~~+).*?^\1|<!--.*?-->|(`+).+?\2", re.DOTALL | re.MULTILINE)


def sentences(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the texts of a file, with their first lines."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        for line, one in _strings(ast.parse(text)):
            if len(one.split()) >= _LEAST_WORDS:
                yield line, _without_code(one)
    else:
        yield 1, _without_code(text)


def _strings(tree: ast.Module) -> Iterator[tuple[int, str]]:
    formatted = [node for node in ast.walk(tree) if isinstance(node, ast.JoinedStr)]
    parts = {id(part) for node in formatted for part in node.values}
    for node in formatted:
        words = [one.value if isinstance(one, ast.Constant) else "``" for one in node.values]
        yield node.lineno, "".join(map(str, words))
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in parts:
            yield node.lineno, node.value


def _without_code(text: str) -> str:
    plain = _CODE.sub(lambda code: "``" + "\n" * code[0].count("\n"), text)
    return re.sub(r"\n[ \t]+", "\n", plain)


def avoided(path: Path) -> list[str]:
    """Return a line for each use of an avoided word in a file."""
    lines = []
    for line, text in sentences(path):
        for pattern, better in AVOIDED:
            for use in re.finditer(pattern, text):
                at = line + text.count("\n", 0, use.start())
                lines.append(f"{path}:{at}: {' '.join(use[0].split())!r}; write: {better}")
    return lines


def files(paths: list[Path]) -> Iterator[Path]:
    """Yield the pages and modules among files and folders."""
    for path in paths:
        if path.is_dir():
            yield from sorted(one for one in path.rglob("*") if one.suffix in (".md", ".py"))
        else:
            yield path


if __name__ == "__main__":
    uses = [use for path in files([Path(word) for word in sys.argv[1:]]) for use in avoided(path)]
    for use in uses:
        print(use)
    sys.exit(bool(uses))
