"""How the time of what grows with a number of things grows: exponents over two decades."""

from collections.abc import Callable

import numpy as np

import vibroimpact as vi
from benchmarks.report import Table, met, targets
from benchmarks.rounds import interleave
from vibroimpact.response.sweep import periodic_rigs
from vibroimpact.tasks.threads import each

_MOST = 1.2
"""Above it a time is not in proportion."""
_DECADES = (1.0, 10.0**0.5, 10.0, 10.0**1.5, 100.0)
_ROUNDS = 5

Call = Callable[[], object]


def _of_motion(function: Callable[..., object]) -> Callable[[int], Call]:
    def call(cycles: int) -> Call:
        motion = vi.simulate("B2-G1-A3", cycles, frequency="1.2 Hz", samples=8)
        return lambda: function(motion)

    return call


def _of_names(count: int) -> Call:
    rigs = ["B2-G1-A3"] * count
    return lambda: periodic_rigs(rigs)


def _of_tasks(count: int) -> Call:
    items = list(range(count))
    return lambda: each(lambda item, _: item, items, threads=2, progress=lambda *_: None)


GROWING = {
    "contacts of 300 to 30,000 cycles": (300, _of_motion(vi.contacts)),
    "impact_section of 300 to 30,000 cycles": (300, _of_motion(vi.impact_section)),
    "names of 100 to 10,000 rigs": (100, _of_names),
    "polling of 300 to 30,000 tasks": (300, _of_tasks),
}
"""The least number of things, and what makes a call for a number of them."""


def exponent(sizes: list[int], seconds: list[float]) -> float:
    """Slope of the time over the size, both as logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])


def growth() -> Table:
    """Measure at five sizes over two decades."""
    table = targets("Growth of the time with the number of things, exponent over two decades")
    for name, (least, made) in GROWING.items():
        sizes = [round(least * times) for times in _DECADES]
        times = interleave({str(size): made(size) for size in sizes}, _ROUNDS)
        seconds = [min(times[str(size)]) for size in sizes]
        found = exponent(sizes, seconds)
        value = f"{found:.2f}; {seconds[-1]:.3g} s at last"
        table.add(name, value, f"under {_MOST:g}", met(found < _MOST))
    return table
