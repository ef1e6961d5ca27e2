"""Timing by interleaved rounds: A B C A B C ..., so that a busy moment hits all alike."""

import gc
import statistics
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Spread:
    """Median and range of repeated measurements."""

    median: float
    least: float
    most: float

    @classmethod
    def of(cls, values: Sequence[float]) -> "Spread":
        """Summarise measurements."""
        return cls(statistics.median(values), min(values), max(values))

    def text(self, scale: float = 1.0) -> str:
        """Three significant digits; the range in brackets."""
        median, least, most = (
            digits(scale * value) for value in (self.median, self.least, self.most)
        )
        return f"{median} ({least} to {most})"


def digits(value: float) -> str:
    """Three significant digits, without an exponent."""
    if abs(value) >= 100.0:
        return f"{value:,.0f}"
    return f"{value:#.3g}"


def interleave(
    contestants: Mapping[str, Callable[[], object]],
    rounds: int,
    turn: float = 0.02,
    clock: Callable[[], float] = time.perf_counter,
) -> dict[str, list[float]]:
    """Time each contestant once a round.

    Parameters
    ----------
    contestants
        What to call. All are called once beforehand, untimed.
    rounds
        How many rounds.
    turn
        In its turn a contestant is called as often as fills about this time (s), at least once.
    clock
        What tells the time. `time.thread_time` is the calling thread's processor time: where
        that thread does all the work it is what a quiet machine's clock shows, and other
        processes do not count.

    Returns
    -------
    dict
        For each contestant the time of one call (s) in each round.
    """
    calls = {}
    for name, call in contestants.items():
        call()
        begin = clock()
        call()
        calls[name] = max(1, round(turn / (clock() - begin)))
    seconds: dict[str, list[float]] = {name: [] for name in contestants}
    gc.collect()
    gc.disable()
    try:
        for _ in range(rounds):
            for name, call in contestants.items():
                begin = clock()
                for _ in range(calls[name]):
                    call()
                seconds[name].append((clock() - begin) / calls[name])
    finally:
        gc.enable()
    return seconds


def ratio(slow: Sequence[float], fast: Sequence[float]) -> Spread:
    """How many times slower, round by round."""
    return Spread.of([a / b for a, b in zip(slow, fast, strict=True)])
