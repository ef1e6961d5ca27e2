"""The results that stand in README.md, as numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

README = Path(__file__).with_name("README.md")

_TABLE = re.compile(r"^### (.+)\n\n((?:\|.*\n)+)", re.MULTILINE)
_RATIO = re.compile(r"times as long|times ours|over that")
_TARGET = re.compile(r"(under|at most|at least|over) ([\d,.e+-]+)")


def number(text: str) -> float:
    """The first number of a cell: ``"1,353 (1,342 to 1,373)"`` is 1353."""
    numbers = re.findall(r"\d[\d,]*\.?\d*(?:e[+-]?\d+)?", text)
    return float(numbers[0].replace(",", ""))


def tables() -> dict[str, list[dict[str, str]]]:
    """Rows of each table by its heading, each row by its columns."""
    by_heading = {}
    for heading, body in _TABLE.findall(README.read_text(encoding="utf-8")):
        lines = [
            [cell.strip() for cell in line.strip("|\n").split("|")] for line in body.splitlines()
        ]
        by_heading[heading] = [dict(zip(lines[0], line, strict=True)) for line in lines[2:]]
    return by_heading


def rows(begins: str) -> list[dict[str, str]]:
    """The table whose heading begins so."""
    (only,) = (table for heading, table in tables().items() if heading.startswith(begins))
    return only


def against_others() -> Iterator[tuple[str, float]]:
    """How many times as long other programs take, by what they do."""
    for heading, table in tables().items():
        before = ""
        for row in table:
            what = row.get("Measured", row.get("Solver", ""))
            if "vibroimpact" not in what and "Times the engine's" in row:
                yield f"{_short(heading)}: {what}", number(row["Times the engine's"])
            elif _RATIO.search(what):
                name = before if what.startswith("the same") else what
                name = re.sub(r"[,:]? (times as long|over that).*|, (m?s|µs)$", "", name)
                yield f"{_short(heading)}: {name}", number(row["Value"])
            before = what
    short = {row["Solver"]: row for row in rows("Short runs")}
    for periods in ("1 period", "10 periods"):
        other, ours = (
            short[name][periods] for name in ("heyoka, general", "vibroimpact, vi.simulate")
        )
        yield f"a run of {periods} by vi.simulate: heyoka, general", number(other) / number(ours)


def margins() -> Iterator[tuple[str, float]]:
    """How far each target is from what was measured: 2 is twice as good as asked for."""
    for heading, table in tables().items():
        for row in table:
            if target := _TARGET.match(row.get("Target", "")):
                value, asked = number(row["Value"].split("=")[-1]), number(target[2])
                margin = asked / value if target[1] in ("under", "at most") else value / asked
                yield f"{_short(heading)}: {row['Measured']}", margin


def _short(heading: str) -> str:
    return re.split(r"[,:]| of problem", heading)[0]
