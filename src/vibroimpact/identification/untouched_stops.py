"""Stops that a fitted rig never touches: nothing of them shows but that their gaps are wide."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from vibroimpact.errors import InputError
from vibroimpact.identification.free_parameters import SENSORS, FitNumber
from vibroimpact.identification.least_squares import Array, Problem, Test
from vibroimpact.model.parameters import parameter


class Untouched(NamedTuple):
    """Free parameters of stops that are never touched, by their numbers."""

    gaps: Mapping[int, float]
    """Those that move a gap, each with its value at which the mass would just reach the stop."""
    others: frozenset[int]

    @property
    def all(self) -> frozenset[int]:
        """Both."""
        return self.others | frozenset(self.gaps)


def untouched(problem: Problem, x: Array) -> Untouched:
    """Find the free parameters of stops that no motion of the fitted rig reaches."""
    idle = [_idle(problem, x, number) for number in range(len(problem.tests))]
    gaps, others = {}, set()
    for number, one in enumerate(problem.free):
        mine = [(test, sides) for test, sides in zip(problem.tests, idle, strict=True)
                if one.test in (None, test.name)]  # fmt: skip
        moved = [_moved(problem, x, number, one, test) for test, _ in mine]
        pairs = list(zip(moved, (sides for _, sides in mine), strict=True))
        if not all(far and far <= set(sides) for far, sides in pairs):
            continue
        if one.name.endswith(("gap", "gap_ratio")):
            share = max(sides[side] for far, sides in pairs for side in far)
            gaps[number] = share * float(x[number] * problem.scale[number])
        else:
            others.add(number)
    return Untouched(gaps, frozenset(others))


def _idle(problem: Problem, x: Array, number: int) -> dict[str, float]:
    """The sides of a test's rig whose stop is never reached, and how much of the gap is used."""
    test = problem.tests[number]
    rig, _ = problem.rig_of(x, test)
    reach = test.reach(rig, problem.of_test(x, number))
    gap_shares = {}
    for side, far in zip(("right", "left"), reach, strict=True):
        stop = getattr(rig.oscillator, side)
        if stop is not None and far < stop.gap:
            gap_shares[side] = max(far, 0.0) / stop.gap if stop.gap > 0.0 else 1.0
    return gap_shares


def _moved(problem: Problem, x: Array, number: int, one: FitNumber, test: Test) -> set[str]:
    """The sides whose stop depends on a parameter; none if anything else does."""
    if one.name in SENSORS:
        return set()
    other = x.copy()
    value = float(x[number] * problem.scale[number])
    rig, _ = problem.rig_of(x, test)
    other[number] = parameter(one.name, rig).beside(value) / problem.scale[number]
    try:
        changed, _ = problem.rig_of(other, test)
    except InputError:
        return set()
    now, then = rig.oscillator, changed.oscillator
    if changed.shaking != rig.shaking or then.replace(right=now.right, left=now.left) != now:
        return set()
    return {side for side in ("right", "left") if getattr(then, side) != getattr(now, side)}
