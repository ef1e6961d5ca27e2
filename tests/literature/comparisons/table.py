"""The table of `docs/validation.md`: every comparison with a published number or another's code.

    python tests/literature/comparisons/table.py           writes it into the page
    python tests/literature/comparisons/table.py --again   runs the other programs, where they are

A build of the documentation computes it anew, by `renewed` (`docs/_ext/validation.py`).
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[3]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from literature.comparisons import assemblies, impact_oscillators, motions, records  # noqa: E402
from literature.comparisons.comparison import AbsentError, Comparison  # noqa: E402

PAGE = ROOT / "docs" / "validation.md"
COMPARISONS: list[Comparison] = [
    *impact_oscillators.COMPARISONS,
    *motions.COMPARISONS,
    *assemblies.COMPARISONS,
    *records.COMPARISONS,
]
HEAD = "| Source | Quantity | Theirs | Ours | Difference | Allowed |"
BEGIN, END = "<!-- the table -->\n", "<!-- end of the table -->"
ROUNDING = 1e-9
"""Relative differences below this are not told: they would be others on another machine."""


def written(one: Comparison) -> str:
    """Theirs, as it is printed."""
    return one.theirs if isinstance(one.theirs, str) else f"{one.value:.9g}"


def beside(one: Comparison, value: float) -> str:
    """Ours, with two digits more than theirs; at most twelve."""
    text = written(one)
    mantissa = text.lower().lstrip("-").partition("e")[0]
    digits = len(mantissa.replace(".", "").lstrip("0"))
    if isinstance(one.theirs, str):
        digits += 2
    if float(text).is_integer() and value.is_integer():
        return f"{value:g}"
    return f"{value:.{min(digits, 12)}g}"


def difference(one: Comparison, value: float) -> str:
    """Of ours from theirs, over theirs."""
    share = value / one.value - 1.0
    if abs(share) < ROUNDING:  # the last digits are the processor's, but for counts
        return "0" if value == round(value) == one.value else "below 1e-9"
    return f"{share:+.2%}" if abs(share) >= 1e-4 else f"{share:+.1e}"


def bound(one: Comparison) -> str:
    """What the source supports, over theirs."""
    share = one.allowed / abs(one.value)
    return f"{share:.2g}" if share < 1e-3 else f"{share:.1%}"


def row(one: Comparison) -> str:
    """One line of the table."""
    value = float(one.ours())
    gap = difference(one, value)
    if one.differs:
        gap = f"**{gap}**: {one.differs}"
    cells = (one.source, one.quantity, written(one), beside(one, value), gap, bound(one))
    return f"| {' | '.join(cells)} |"


def cells(line: str) -> list[str]:
    """Of a line of the table."""
    return [cell.strip() for cell in line.strip().strip("|").split(" | ")]


def rows(before: dict[tuple[str, str], str]) -> Iterator[str]:
    """All lines; one that cannot be computed here is as it was before, and says so."""
    for one in COMPARISONS:
        try:
            yield row(one)
        except AbsentError as error:
            kept = before.get((one.source, one.quantity))
            mark = "not computed in this build: it needs"
            if kept and mark not in kept:
                kept = f"{kept.removesuffix(' |')}; {mark} {error} |"
            yield kept or f"| {one.source} | {one.quantity} | – | – | {mark} {error} | – |"


def table(text: str = "") -> str:
    """The table; `text` is the page, for what cannot be computed here."""
    before = {
        (entry[0], entry[1]): line
        for line in text.splitlines()
        if line.startswith("| ") and len(entry := cells(line)) == 6
    }
    return "\n".join([HEAD, "| --- | --- | ---: | ---: | --- | ---: |", *rows(before)]) + "\n"


def renewed(text: str) -> str:
    """The page with its table computed anew."""
    start, stop = text.index(BEGIN) + len(BEGIN), text.index(END)
    return text[:start] + table(text) + text[stop:]


def agrees(one: Comparison, value: float) -> bool:
    """Whether a value is as near as the source supports."""
    return math.isfinite(value) and abs(value - one.value) <= one.allowed


if __name__ == "__main__":
    if sys.argv[1:] == ["--again"]:
        for each in COMPARISONS:
            if each.again is not None:
                try:
                    print(each.source, "|", each.quantity, "|", each.theirs, "|", each.again())
                except AbsentError as error:
                    print(each.source, "| absent:", error)
    else:
        begin = time.process_time()
        PAGE.write_text(renewed(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
        print(f"{len(COMPARISONS)} comparisons in {time.process_time() - begin:.1f} s")
