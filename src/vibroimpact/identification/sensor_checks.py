"""Whether a sensor that is reversed, or has an offset, is why nothing fits a history."""

from __future__ import annotations

import numpy as np

from vibroimpact.identification.free_parameters import SENSORS, FitNumber, frees
from vibroimpact.identification.global_search import local
from vibroimpact.identification.history_residuals import HistoryTest
from vibroimpact.identification.least_squares import Array, Problem
from vibroimpact.identification.robust_loss import noises
from vibroimpact.model.units import pretty

BAD = 2.0
"""Residuals over the noise from which on the cause is looked for."""
_BETTER = 0.5
"""Share of the residuals up to which is left where a sensor is the cause."""
_CLEAR = 5.0
"""Standard deviations of the noise from which on an offset is reported."""
_STEPS = 40
_NEAR = 1.2
"""Cost at the start, over the least one, up to which a reversed sensor is tried."""
_TAIL = 3.0


def sensor_doubts(problem: Problem, x: Array, number: int) -> list[str]:
    """Say which sensor of a history is probably reversed, or has an offset.

    From the start of the fit, the history is fitted again with a sensor reversed, if the rig is
    then about as near as it can be, and with offsets that are free.

    Return one line if the residuals fall to less than half, none otherwise.
    """
    test = problem.tests[number]
    if not isinstance(test, HistoryTest):
        return []
    before = noises(problem, x, [False] * len(problem.tests))[number]
    free = [one for one in problem.free if one.test in (None, test.name)]
    offsets = _offsets(test, {one.name for one in free})
    signs: list[tuple[str, ...]] = [(), *((c,) for c in test.names)]
    if not test.free_phase:
        signs.append(("base_acceleration",))
    if {"displacement", "velocity"} <= set(test.names):
        signs.append(("displacement", "velocity"))
    every = [
        Problem([test.reversed(names)], [*free, *offsets], problem.ties, [test.noise], _TAIL)
        for names in signs
    ]
    costs = [one.cost(one.start) for one in every]
    best: tuple[float, tuple[str, ...], list[float]] = (np.inf, (), [])
    for names, one, cost in zip(signs, every, costs, strict=True):
        if cost <= _NEAR * min(costs):
            end = local(one, one.start, _STEPS).x
            left = noises(one, end, [False])[0]
            if left < best[0]:
                values = (end * one.scale)[len(free) : len(free) + len(offsets)]
                best = left, names, values.tolist()
    left, names, values = best
    fixes = [f"the sign of the {name.replace('_', ' ')} reversed" for name in names]
    for offset, value in zip(offsets, values, strict=True):
        if abs(value) > _CLEAR * test.size[offset.name.removesuffix("_offset")]:
            fixes.append(f"{offset.name} {pretty(value, offset.quantity, 3)}")
    if not fixes or not left < _BETTER * before:
        return []
    return [
        f"{test.name}: with {' and '.join(fixes)}, the residuals are {left:.3g} times the noise of "
        f"the measurement instead of {before:.3g}: check this sensor, and fit again with its "
        f"{'sign changed in the data' if names else 'offset free'}"
    ]


def _offsets(test: HistoryTest, known: set[str]) -> list[FitNumber]:
    """The offsets of a test's channels that are not free yet."""
    names = [name for name in SENSORS if name.endswith("_offset") and name not in known
             and name.removesuffix("_offset") in test.names]  # fmt: skip
    if not names:
        return []
    return frees(names, {test.name: test.rig}, (), None, {test.name: test.swing})
