"""Comparison of printed text by value: numbers may differ in their last digit, words may not.

Processors differ in fused products and libraries, so the same computation may round the last digit
that is printed to its neighbour.
"""

from __future__ import annotations

import re
from decimal import Decimal

_NUMBER = re.compile(r"(?<![\w.])[+−-]?\d+(?:,\d{3})*(?:\.\d+)?(?:[eE][+-]?\d+)?")
_LARGEST_COUNT = 100_000
"""A whole number below may be a count, which is the same everywhere."""
_ROUNDING = Decimal("1e-10")
"""Relative difference of two processors, for numbers that are printed with all their digits."""


def same_print(expected: str, printed: str) -> bool:
    """Whether printed text is what is expected.

    - A line of three dots in the expected text stands for any lines.
    - A number may differ by one unit of the last digit shown; whole numbers below 100,000 may not.
    - Runs of spaces count as one space: a number that is one letter longer moves what follows it.
    """
    lines = printed.rstrip().splitlines()
    first, *others = _parts(expected)
    if not _same_lines(first, lines[: len(first)]):
        return False
    at = len(first)
    if not others:
        return at == len(lines)
    *between, last = others
    for part in between:
        starts = range(at, len(lines) - len(part) + 1)
        place = next((i for i in starts if _same_lines(part, lines[i : i + len(part)])), None)
        if place is None:
            return False
        at = place + len(part)
    end = len(lines) - len(last)
    return end >= at and _same_lines(last, lines[end:])


def _parts(expected: str) -> list[list[str]]:
    """Split lines at those of three dots."""
    parts: list[list[str]] = [[]]
    for line in expected.rstrip().splitlines():
        if line.strip() == "...":
            parts.append([])
        else:
            parts[-1].append(line)
    return parts


def _same_lines(expected: list[str], printed: list[str]) -> bool:
    return len(expected) == len(printed) and all(map(_same_line, expected, printed))


def _same_line(expected: str, printed: str) -> bool:
    words = [_words(line) for line in (expected, printed)]
    numbers = [_NUMBER.findall(line) for line in (expected, printed)]
    return words[0] == words[1] and all(map(_same_number, *numbers))


def _words(line: str) -> list[str]:
    return [" ".join(word.split()) for word in _NUMBER.split(line)]


def _same_number(expected: str, printed: str) -> bool:
    if expected == printed:
        return True
    (a, step_a), (b, step_b) = map(_value, (expected, printed))
    if step_a == step_b == 1 and abs(a) < _LARGEST_COUNT:
        return False
    # The smaller one: 12.2 may be 12.20 without its zero, and 9.999 becomes 10.00.
    return abs(a - b) <= max(min(step_a, step_b), _ROUNDING * abs(a))


def _value(text: str) -> tuple[Decimal, Decimal]:
    """The value of a printed number, and one unit of its last digit."""
    value = Decimal(text.replace(",", "").replace("−", "-"))
    return value, Decimal((0, (1,), int(value.as_tuple().exponent)))
