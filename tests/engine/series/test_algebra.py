"""Series of formulas against those of mpmath, and slopes against what they are slopes of."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from vibroimpact.engine.series.algebra import Rate, Shifted, StateSeries
from vibroimpact.engine.series.code_generation import Plain
from vibroimpact.engine.series.functions import exponential, power

DEGREE = 20
STATE = [0.7, -0.4, 0.3, 0.11, -0.05, 0.02, 0.013, -0.004, 0.003]
STATE += [0.1 ** (n / 2.0) * (-1) ** n for n in range(9, DEGREE + 2)]

FORMULAE: dict[str, Callable[[Any, Any, Any], Any]] = {
    "cube": lambda machine, u, v: 0.3 * u**3,
    "fifth": lambda machine, u, v: 0.3 * u**3 - 0.7 * u**5,
    "seventh": lambda machine, u, v: u**7,
    "product": lambda machine, u, v: u * v * (2.0 - u),
    "square of a rate": lambda machine, u, v: v * v,
    "sinh": lambda machine, u, v: exponential(machine, 2.0 * u) - exponential(machine, -2.0 * u),
    "power": lambda machine, u, v: power(machine, u, 1.37) * (1.0 + 0.2 * v),
    "softening": lambda machine, u, v: u / (1.0 + u * u),
    "inverse": lambda machine, u, v: 3.0 / u,
}


class Precise:
    """A machine of mpmath's numbers, for formulas of plain values."""

    def exponential(self, one: Any) -> Any:
        return mpmath.exp(one)

    def power(self, one: Any, exponent: Any) -> Any:
        return one**exponent


def displacement(t: Any) -> Any:
    return mpmath.fsum(c * t**n for n, c in enumerate(STATE))


def velocity(t: Any) -> Any:
    return mpmath.fsum(n * c * t ** (n - 1) for n, c in enumerate(STATE) if n)


@pytest.mark.parametrize("name", FORMULAE)
def test_coefficients(name: str) -> None:
    """One by one, and older ones summed two at a time from the fourth on."""
    formula, machine = FORMULAE[name], Plain(None, ())
    state = StateSeries(machine, STATE[:1])
    series = formula(machine, Shifted(state, STATE[0]), Rate(state))
    coefficients = []
    for n in range(DEGREE + 1):
        state.coefficients.append(STATE[n + 1])  # the rate is one ahead of the state
        coefficients.append(series[n])
    with mpmath.workdps(60):
        exact = mpmath.taylor(lambda t: formula(Precise(), displacement(t), velocity(t)), 0, DEGREE)
    np.testing.assert_allclose(coefficients, [float(c) for c in exact], rtol=1e-9, atol=1e-11)


@pytest.mark.parametrize("name", FORMULAE)
def test_what_is_older_needs_no_newest_coefficient(name: str) -> None:
    """Coefficient n is what is older and the slopes times the newest, whatever that is."""
    formula, machine = FORMULAE[name], Plain(None, ())
    for n in (1, 4, 5, 9):
        values = []
        for newest in (0.3, -1.1):
            state, rate = StateSeries(machine, STATE[:n]), StateSeries(machine, STATE[1 : n + 1])
            series = formula(machine, Shifted(state, STATE[0]), rate)
            for m in range(n):
                series[m]
            older = series.older(n)
            state.coefficients.append(newest)
            rate.coefficients.append(2.0 * newest)
            by = (
                series.slopes.get(state, 0.0) * newest + series.slopes.get(rate, 0.0) * 2.0 * newest
            )
            values.append(older)
            assert series[n] == pytest.approx(older + by, rel=1e-12, abs=1e-14)
        assert values[0] == values[1]
