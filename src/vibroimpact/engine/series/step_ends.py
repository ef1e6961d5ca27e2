"""Where a step ends: sums of its series there, written down for the flow."""

from __future__ import annotations

from typing import Any, NamedTuple

from vibroimpact.engine.series import layout as at
from vibroimpact.engine.series.code_generation import LANES


class Sums(NamedTuple):
    """Of a series but for its first coefficient, at a time h: value, h x′, h² x″ and the like."""

    value: Any
    rate: Any
    gain: Any
    bend: Any
    """Of the sizes of what `gain` is made of, and of the third rate's."""
    jerk: Any


def sums(machine: Any, series: Any, reached: list[Any]) -> Sums:
    """Sum a series from its first coefficient on, four side by side."""
    count = len(reached)
    terms = [
        machine.lanes([series[LANES * i + j + 1] for j in range(LANES)]) * reached[i]
        for i in range(count)
    ]
    orders = [[LANES * i + j + 1 for j in range(LANES)] for i in range(count)]
    value: Any = None
    rate: Any = None
    gain: Any = None
    bend: Any = None
    jerk: Any = None
    for term, order in zip(terms, orders, strict=True):
        second = term * [n * (n - 1) for n in order]
        sizes = second.absolute()
        value = term if value is None else value + term
        rate = term.times(order, rate)
        gain = second if gain is None else gain + second
        bend = sizes if bend is None else bend + sizes
        jerk = sizes.times([max(n - 2, 0) for n in order], jerk)
    return Sums(*(one.total() for one in (value, rate, gain, bend, jerk)))


def powers(machine: Any, h: Any, degree: int) -> list[Any]:
    """H to h^degree, four side by side."""
    square = h * h
    fourth = square * square
    vectors = [machine.lanes([h, square, square * h, fourth])]
    step = fourth
    for _ in range(1, degree // LANES):
        vectors.append(vectors[0] * step)
        step = step * fourth
    return vectors


class Along(NamedTuple):
    """How far a step goes, in powers and in their inverses."""

    h: Any
    inverse: Any
    squared: Any
    reached: list[Any]


def along_of(machine: Any, h: Any) -> Along:
    """Return the powers of a step's length."""
    inverse = 1.0 / h
    return Along(h, inverse, inverse * inverse, powers(machine, h, at.DEGREE))


def end_of(machine: Any, totals: Sums, first: Any, step: Along) -> tuple[Any, Any]:
    """Write where the coordinate of a step ends, with its derivatives; return it and its rate."""
    end, rate = totals.value + first, totals.rate * step.inverse
    for place, number in (
        (at.F_H, step.h),
        (at.F_X, end),
        (at.F_V, rate),
        (at.F_A, totals.gain * step.squared),
        (at.F_BEND, totals.bend * step.squared),
        (at.F_JERK, totals.jerk * (step.squared * step.inverse)),
    ):
        machine.store(at.FOUND + place, number)
    return end, rate


def memory_end(machine: Any, totals: Sums, first: Any, step: Along) -> Any:
    """Write where the memory of a step ends, with its rate; return it."""
    end = totals.value + first
    machine.store(at.FOUND + at.F_Z, end)
    machine.store(at.FOUND + at.F_R, totals.rate * step.inverse)
    machine.store(at.FOUND + at.F_BEND_Z, totals.bend * step.squared)
    return end
