"""Whether residuals are noise: false alarms as rare as said, and a small wave is seen."""

import numpy as np
import pytest

from vibroimpact.identification.residual_structure import CERTAIN, HINT, ResidualSeries, structure

PLACES = np.arange(23.0)


def judged(wave, noise=1.0, count=400, across=True):
    """Chances of tests of two quantities in two directions, 23 frequencies each."""
    draw = np.random.default_rng(0)
    structures = []
    for _ in range(count):
        rows = [
            ResidualSeries(
                name,
                PLACES,
                wave * np.sin(PLACES / 3.0 + k) + noise * draw.normal(size=23),
                np.full(23, 1.0 if across else float(way)),
            )
            for k, name in enumerate(("displacement", "acceleration"))
            for way in (1, 2)
        ]
        size = float(np.sqrt(np.mean([r.residual**2 for r in rows])))
        structures.append(structure(rows, size, 1.0, 92.0, 9.2))
    return structures


def test_noise_is_taken_for_noise():
    structures = judged(0.0)
    chances = np.array([one.chance for one in structures])
    assert np.mean(chances < HINT) == pytest.approx(HINT, abs=0.03)
    assert np.mean(chances < CERTAIN) < 0.01
    assert np.mean([one.excess_chance < CERTAIN for one in structures]) < 0.01


def test_both_directions_tell_more_than_one():
    shares = [
        np.mean([one.chance < CERTAIN for one in judged(0.9, count=100, across=across)])
        for across in (True, False)
    ]
    assert shares[0] > 0.8 > shares[1] + 0.1


def test_residuals_far_above_the_noise_are_told_and_where_they_are():
    rows = [ResidualSeries("displacement", PLACES, np.where(PLACES > 17.0, 5.0, 0.1), PLACES)]
    shape = structure(rows, 3.0, 0.5, 20.0, 9.0)
    assert shape.excess == 6.0
    assert shape.excess_chance < CERTAIN
    assert shape.worst == (18.0, 22.0)


def test_no_noise_at_all_has_no_shape():
    shape = structure(
        [ResidualSeries("displacement", PLACES, 0.0 * PLACES, PLACES)], 0.0, None, 20.0, 9.0
    )
    assert shape.chance == shape.excess_chance == 1.0
