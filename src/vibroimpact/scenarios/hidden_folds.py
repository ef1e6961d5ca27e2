"""Where a branch may turn back between two neighbouring frequencies of a sweep, and none shows it.

Where both directions go over the same motions, two folds can only hide within one step. They are
born in a cusp, where a curve goes as the cube root of the distance, or in a grazing, where the
contacts change. So between two frequencies nothing hides where both motions are the same in either
direction, of one cycle, with the same contacts, and the step of the curve is no higher than those
beside it.
"""

from __future__ import annotations

import numpy as np

from vibroimpact.response.curve_pair import Array, Flags, Swept
from vibroimpact.scenarios.resonance_curves import Holds

_STEEP = 1.5
"""Times as high as the higher step two places away. At a cusp, anywhere within the step, it is at
least 1 / (2^(1/3) - 1) = 3.8 times as high, and more with a jump; beyond the ends of a sweep
nothing is known, and nothing stands beside it."""
_FLAT = 0.003
"""Least height of a step, as a share of the curve's height."""
_SAME = 1e-6
"""Of a curve's height: by more two directions do not differ that follow the same motions."""


def hidden_stretches(both: Swept, ended: Holds) -> list[tuple[int, int]]:
    """The stretches in which folds may hide: numbers of the first and the last frequency."""
    contacts = ended.contacts
    touching = np.asarray(both.touching.any(axis=0))
    other = (contacts[:, 1:] != contacts[:, :-1]).any(axis=(0, 2))
    plain = (ended.period == 1).all(axis=0)
    may = other | ~(plain[1:] & plain[:-1])
    for curve in (both.eta_a, both.eta_d):
        may |= _steep(curve) | _differing_intervals(curve)
    stretches: list[tuple[int, int]] = []
    for i in np.flatnonzero(may & (touching[1:] | touching[:-1])).tolist():
        if stretches and i <= stretches[-1][1] + 1:
            stretches[-1] = stretches[-1][0], i + 1
        else:
            stretches.append((i, i + 1))
    return stretches


def _height(curve: Array) -> float:
    return float(np.fmax.reduce(curve, axis=None))


def _steep(curve: Array) -> Flags:
    """Between which neighbours either direction rises or falls much more than beside them."""
    step = np.abs(np.diff(curve))
    around = np.pad(step, ((0, 0), (2, 2)))
    beside = np.fmax(around[:, :-4], around[:, 4:])
    gentle: Flags = (step <= _STEEP * beside + _FLAT * _height(curve)).all(axis=0)
    return ~gentle  # of what was given up nothing is known


def _differing_intervals(curve: Array) -> Flags:
    """Between which neighbours the two directions differ at one of them."""
    differ = np.abs(curve[0] - curve[1]) > _SAME * _height(curve)
    return np.asarray(differ[1:] | differ[:-1])
