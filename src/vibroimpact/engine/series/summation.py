"""In which order a sum is written down: the processor adds what is known early while it waits."""

from __future__ import annotations

from typing import Any


def summed(machine: Any, pairs: Any, base: Any = 0.0, width: int = 3) -> Any:
    """Sum products in a few chains; the last two pairs, which are known last, enter last.

    The first of a pair may be lanes, which are summed side by side.
    """
    pairs = list(pairs)
    if len(pairs) <= 2:
        for a, b in pairs:
            base = machine.fma(a, b, base)
        return base
    late, early = pairs[-2:], pairs[:-2]
    width = min(width, max(1, len(early) // 2))
    sums = [base] + [0.0] * (width - 1)
    for i, (a, b) in enumerate(early):
        sums[i % width] = machine.fma(a, b, sums[i % width])
    total = tree(sums)
    for a, b in late:
        total = machine.fma(a, b, total)
    return total


def tree(numbers: Any) -> Any:
    """Sum numbers pair by pair."""
    numbers = [one for one in numbers if not (type(one) is float and one == 0.0)] or [0.0]
    while len(numbers) > 1:
        pairs = zip(numbers[::2], numbers[1::2], strict=False)
        odd = numbers[-1:] if len(numbers) % 2 else []
        numbers = [a + b for a, b in pairs] + odd
    return numbers[0]
