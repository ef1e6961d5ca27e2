"""The laws beside the materials of OpenSeesPy, whose error must fall towards our motion.

OpenSees goes on by Newmark's average acceleration and sees stops at the ends of steps only. From
that follows how its error falls with the length h of a step:

- h² where materials follow their law exactly along a step, between elastic stops;
- h for Bouc and Wen's, whose memory takes backward Euler steps of the displacement;
- h for a Hertzian stop with damping, for the speed at which it is met is that at the end of a step;
- h^1.25 for Jankowski's, whose damping begins with the fourth root of the time.

Where in a step an event falls is chance, so that the error at a length is that of several nearby.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

import vibroimpact as vi
from samples import sample

opensees = pytest.importorskip(
    "reference.opensees", reason="OpenSeesPy is not installed", exc_type=ImportError
)

HALVINGS = sample(5, 3)
NEARBY = 7
"""Numbers of steps that stand for one step length."""
MASS = 2.0
EIGHTHS = 8


def elastic(gap: float, stiffness: float = 20.0) -> vi.Bumper:
    return vi.Bumper(stiffness, 0.0, gap)


def hertz(gap: float, **rest: Any) -> vi.PowerBumper:
    return vi.PowerBumper(60.0, gap, **rest)


def pounding(gap: float, restitution: float) -> vi.JankowskiBumper:
    return vi.JankowskiBumper(60.0, gap, restitution, MASS)


def quake(size: float, seed: int) -> vi.Record:
    """A rough record of 12 s."""
    values = np.random.default_rng(seed).uniform(-size, size, 49)
    values[0] = 0.0
    return vi.Record(values, 0.25)


class Pair(NamedTuple):
    """A rig of a law, and how OpenSees comes near its motion."""

    isolator: Any
    right: Any
    left: Any
    shaken: vi.Harmonic | vi.Record
    order: float
    near: float
    """How near the motion extrapolated from three halvings is, over the largest values of ours."""

    @property
    def rig(self) -> vi.Oscillator:
        return vi.Oscillator(MASS, self.isolator, self.right, self.left)

    @property
    def steps(self) -> int:
        """In an eighth of a period, or between two samples of the record, at first."""
        return 16 if isinstance(self.shaken, vi.Record) else 64


WAVE = vi.Harmonic(1.0, 0.17)
SPRING = vi.Isolator(1.0, 0.2)
BOUC_WEN = vi.BoucWenIsolator(3.0, 0.5, 0.6, 0.1, 2, 0.7, 0.3)
EXPONENTIAL = vi.ExponentialIsolator(4.0, 0.5, 5.0, 0.1, 1.2)
BILINEAR = vi.BilinearIsolator(3.0, 0.5, 0.6, 0.1)
STOPS = (elastic(0.6), elastic(0.5))
CLOSE = (elastic(0.4), elastic(0.3))
FLORES = {"relation": "flores"}
PAIRS = {
    "bilinear": Pair(BILINEAR, *STOPS, WAVE, 2.0, 5e-6),
    "bilinear, record": Pair(BILINEAR, *CLOSE, quake(4.0, 1), 2.0, 5e-6),
    "bouc-wen": Pair(BOUC_WEN, *STOPS, WAVE, 1.0, 1e-4),
    "exponential": Pair(EXPONENTIAL, *STOPS, WAVE, 2.0, 5e-6),
    "exponential, record": Pair(EXPONENTIAL, *CLOSE, quake(4.0, 2), 2.0, 5e-6),
    "drag, 0.5": Pair(vi.Isolator(1.0, 0.2, 0.5), *STOPS, WAVE, 2.0, 5e-6),
    "drag, 2": Pair(vi.Isolator(1.0, 0.4, 2.0), *STOPS, WAVE, 2.0, 5e-6),
    "elastic hertz": Pair(SPRING, hertz(0.6), hertz(0.5), WAVE, 2.0, 2e-7),
    "power 2.2": Pair(SPRING, hertz(0.6, exponent=2.2), hertz(0.5, exponent=2.2), WAVE, 2.0, 2e-7),
    "restitution": Pair(
        SPRING,
        hertz(0.6, restitution=0.7, **FLORES),
        hertz(0.5, restitution=0.5, **FLORES),
        WAVE,
        1.0,
        2e-4,
    ),
    "restitution, record": Pair(
        SPRING,
        hertz(0.4, restitution=0.7, **FLORES),
        hertz(0.3, restitution=0.5, **FLORES),
        quake(4.0, 3),
        1.0,
        2e-4,
    ),
    "hunt-crossley, record": Pair(
        SPRING,
        hertz(0.4, restitution=0.6, relation="hunt-crossley"),
        elastic(0.3),
        quake(4.0, 4),
        1.0,
        2e-4,
    ),
    "elastic hertz, record": Pair(SPRING, hertz(0.4), hertz(0.3), quake(4.0, 3), 2.0, 2e-5),
    "jankowski": Pair(SPRING, pounding(0.6, 0.7), pounding(0.5, 0.5), WAVE, 1.25, 2e-4),
    "jankowski, record": Pair(
        SPRING, pounding(0.4, 0.7), pounding(0.3, 0.5), quake(4.0, 3), 1.25, 2e-4
    ),
}


@cache
def ours(name: str) -> tuple[float, NDArray[np.float64]]:
    """The time between two looks, and the states there: every eighth of a period for two."""
    pair = PAIRS[name]
    if isinstance(pair.shaken, vi.Record):
        data = vi.simulate(vi.Rig(pair.rig, pair.shaken))
        span = pair.shaken.step
    else:
        data = vi.simulate(vi.Rig(pair.rig, pair.shaken), 2, samples=EIGHTHS)
        span = pair.shaken.period / EIGHTHS
    assert data["status"] == 0
    assert set(np.where(data["event_stop"].values == "right", 1, -1).tolist()) == {-1, 1}
    return span, np.stack([data[name].values[1:] for name in ("displacement", "velocity")], axis=-1)


def opensees_beside(name: str, halvings: int) -> tuple[NDArray[np.float64], float]:
    """OpenSees' errors, each time with twice as many steps; and that of the extrapolated motion.

    Errors are root mean squares over displacements and velocities, each over its largest.
    """
    pair, (span, exact) = PAIRS[name], ours(name)
    size = abs(exact).max(axis=0)
    shares = 1.0 + 0.04 * (np.arange(NEARBY) - NEARBY // 2)
    counts = np.rint(np.outer(pair.steps * 2 ** np.arange(halvings + 1), shares)).astype(int)
    states = np.array(
        [
            opensees.follow(pair.rig, pair.shaken, span, len(exact), steps) / size
            for steps in counts.ravel().tolist()
        ]
    )
    squares = np.mean((states - exact / size) ** 2, axis=(1, 2))
    # The motion at h = 0, and an error in proportion to h^p, that fit all runs, fine ones best.
    weights = counts.ravel() ** pair.order
    columns = np.stack([weights, np.ones_like(weights)], axis=-1)
    fitted = np.linalg.lstsq(columns, states.reshape(len(weights), -1) * weights[:, None])[0]
    off = fitted[0].reshape(exact.shape) - exact / size
    return np.sqrt(squares.reshape(counts.shape).mean(axis=1)), float(np.sqrt(np.mean(off**2)))


@pytest.mark.parametrize("name", PAIRS)
def test_opensees_converges_to_our_motion(name: str) -> None:
    pair = PAIRS[name]
    errors, left = opensees_beside(name, HALVINGS)
    order = -np.polyfit(np.arange(HALVINGS + 1), np.log2(errors), 1)[0]
    assert order == pytest.approx(pair.order, abs=0.25)
    assert left <= sample(0.1, 1.0) * pair.near
