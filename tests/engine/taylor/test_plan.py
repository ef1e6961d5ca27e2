"""What of a rig a Taylor flow needs before it starts."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine.flow_dispatch import flow_of, planned
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.engine.taylor.plan import build, stiff_rate, too_much_work
from vibroimpact.law_numbers import IsolatorNumbers


def plan(stiffness: float, law: IsolatorNumbers, omega: float = 2.0) -> np.ndarray:
    rig = rig_vector(2.0, stiffness, 0.1, None, None, law=law)
    made = planned(flow_of(rig), rig)
    build(made, 1.0, omega)
    return made


@pytest.mark.parametrize(
    ("stiffness", "law", "rate"),
    [
        (8.0, IsolatorNumbers(cubic=3.0), 2.0),
        (8.0, IsolatorNumbers(hysteretic=10.0, limit=0.1), 3.0),
        (2.0, IsolatorNumbers(sinh=2.0, sinh_rate=1.5), 2.0),
        (0.0, IsolatorNumbers(cubic=1.0), 2.0),  # without a spring it is the forcing's
    ],
)
def test_small_motions_have_this_frequency(
    stiffness: float, law: IsolatorNumbers, rate: float
) -> None:
    assert stiff_rate(plan(stiffness, law)) == pytest.approx(rate, rel=1e-14)


def test_what_would_take_too_long() -> None:
    soft, stiff = plan(8.0, IsolatorNumbers(cubic=1.0)), plan(1e30, IsolatorNumbers(cubic=1.0))
    assert not too_much_work(soft, math.pi)
    assert too_much_work(stiff, math.pi)
    with pytest.warns(
        RuntimeWarning,
        match="the fastest rate of the rig is too large to compute one forcing cycle",
    ):
        vi.simulate(
            vi.Rig(
                vi.Oscillator(1.0, vi.PolynomialIsolator(1e30, 0.0, 1.0)), vi.Harmonic(1.0, 1.0)
            ),
            1,
        )
