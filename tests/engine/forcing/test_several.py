"""Several harmonics of one phasor."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from engine.forcing.plans import begun
from vibroimpact.engine.forcing import several
from vibroimpact.engine.linear.layout import (
    MOST,
    RATE,
    SCALED_W,
    STEEPEST,
    TABLES,
    WAVE_C,
    WAVE_S,
    H,
)
from vibroimpact.engine.parameters import Drive
from vibroimpact.engine.yielding.layout import PLAN

SHAPE = vi.Periodic(1.0, [0.6, 0.0, 0.9, 0.3], [0.2, 0.0, -1.0, 2.5])
OMEGA = 2.0 * math.pi * 0.5
WEIGHTS = tuple(
    (size * math.cos(angle), size * math.sin(angle))
    for size, angle in zip(SHAPE.amplitudes, SHAPE.phases, strict=True)
)


@pytest.mark.parametrize("of", ["acceleration", "displacement"])
def test_their_sum_is_that_of_the_model(of: str) -> None:
    moved = of == "displacement"
    drive = Drive(1.0, -1.0 if moved else 1.0, 2.0 if moved else 0.0, WEIGHTS)
    plan = begun(several, drive, 1.0, OMEGA)
    model = vi.Periodic(0.5, SHAPE.amplitudes, SHAPE.phases, of=of)
    angles = np.linspace(0.0, 7.0, 40)
    sums = [several.value(plan, math.sin(a), math.cos(a)) for a in angles]
    np.testing.assert_allclose(sums, model.at(angles), atol=1e-12)
    # Bounds on the sum and on its slope.
    assert np.abs(sums).max() <= plan[MOST]
    slopes = np.diff(model.at(OMEGA * np.linspace(0.0, 2.0, 4001))) / 5e-4
    assert np.abs(slopes).max() <= plan[STEEPEST]


def test_each_has_its_rate_and_its_place() -> None:
    plan = begun(several, Drive(weights=WEIGHTS), 2.0, OMEGA)
    assert several.count(plan) == 4
    assert several.pace(plan) == 4 * OMEGA
    assert len(plan) == several.plan_length(4)
    places = [several.plane(plan, n) for n in (1, 2, 3, 4)]
    assert places[0] == 0
    assert TABLES + places[1] == PLAN + 2 * 4
    assert np.diff(places[1:]).tolist() == [PLAN - TABLES] * 2
    assert places[3] + PLAN == len(plan)
    for n in (1, 2, 3, 4):
        wave, mirrored = several.wave(plan, n, False), several.wave(plan, n, True)
        assert (wave.amplitude, wave.rate) == (2.0, n * OMEGA)
        # Half a turn later an even harmonic is as it was: seen from the other side it is turned.
        sign = 1.0 if n % 2 else -1.0
        assert (mirrored.sine, mirrored.cosine) == (sign * wave.sine, sign * wave.cosine)


def test_powers_of_a_phasor() -> None:
    s, c = math.sin(0.3), math.cos(0.3)
    sn, cn = s, c
    for n in range(2, 9):
        sn, cn = several.raised(s, c, sn, cn)
        assert (sn, cn) == pytest.approx((math.sin(0.3 * n), math.cos(0.3 * n)), abs=1e-14)


def test_lets_go_where_it_first_exceeds_a_level() -> None:
    """However near the end of a window that is."""
    plan = begun(several, Drive(weights=WEIGHTS), 2.0, OMEGA)
    h = 0.25 / several.pace(plan)
    for n in (1, 2, 3, 4):
        wave, there = several.wave(plan, n, False), TABLES + several.plane(plan, n)
        size = wave.amplitude * h * h
        plan[there + H], plan[there + RATE], plan[there + SCALED_W] = h, 1.0 / h, wave.rate * h
        plan[there + WAVE_S], plan[there + WAVE_C] = size * wave.sine, size * wave.cosine
    for angle in np.linspace(0.0, 6.0, 25):
        s, c = math.sin(angle), math.cos(angle)
        for wait in np.linspace(0.001, 3.0 * h, 40):
            clocks = [several.turned(plan, s, c, t) for t in np.linspace(0.0, wait, 200)]
            shaking = [several.value(plan, *clock) for clock in clocks]
            if max(shaking[:-1]) >= shaking[-1]:
                continue
            t, _, _ = several.release_time(plan, 1.0, shaking[-1], s, c, 1.0)
            assert t == pytest.approx(wait, abs=1e-12)
