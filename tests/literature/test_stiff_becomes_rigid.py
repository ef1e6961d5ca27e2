"""Ever stiffer bumpers with the restitution of force release approach a rigid stop.

The contact takes a time of order λ^(-1/2), and that is the distance of the motions.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import vibroimpact as vi
from reference.public_motion import events


@pytest.mark.parametrize("e", [0.3, 0.65, 0.9])
@pytest.mark.parametrize(
    ("gaps", "frequency", "cycles"),
    [
        ((0.0, None), 0.318, 2),
        ((0.3, 0.4), 0.25, 1),
        ((-0.1, None), 0.35, 2),
        ((0.2, None), 0.7, 4),
    ],
)
def test_motions_approach(e: float, gaps, frequency: float, cycles: int) -> None:
    shaken = vi.Harmonic(1.0, frequency, 0.4)
    isolator = vi.Isolator(1.0, 0.1)

    def end(stop) -> np.ndarray:
        right, left = (gap if gap is None else stop(gap) for gap in gaps)
        rig = vi.Oscillator(1.0, isolator, right, left)
        start = vi.State(min(g for g in gaps if g is not None) - 0.05)
        data = vi.simulate(vi.Rig(rig, shaken), cycles, start, samples=0)
        return data["final_state"].values[:2]

    rigid = end(lambda gap: vi.RigidStop(e, gap))
    errors = [
        np.abs(end(lambda gap, k=k: vi.Bumper.from_restitution(1.0, k, e, gap)) - rigid).max()
        for k in (1e4, 1e6, 1e8)
    ]
    coarse, fine = (one / other for one, other in pairwise(errors))
    assert errors[0] < 0.3
    assert coarse > 8.0
    assert 9.0 < fine < 11.0  # 10 in the limit


def test_a_chatter_is_approached_too() -> None:
    """The rigid mass rests on the wall; the soft one stays in contact after its last bounces."""
    shaken = vi.Harmonic(1.0, 0.08)
    isolator = vi.Isolator(1.0, 0.1)
    left = {}
    for name, stop in {
        "rigid": vi.RigidStop(0.5, -0.4),
        **{f"{k:g}": vi.Bumper.from_restitution(1.0, k, 0.5, -0.4) for k in (1e4, 1e6)},
    }.items():
        rig = vi.Oscillator(1.0, isolator, stop)
        data = vi.simulate(vi.Rig(rig, shaken), 6, vi.State(-1.0), samples=1)
        left[name] = np.array([one.time for one in events(data) if one.kind == "detach_right"])
    # The soft mass leaves in between its bounces too; one of its times is near each rigid one.
    coarse, fine = (
        np.abs(left[name] - left["rigid"][:, np.newaxis]).min(axis=1).max()
        for name in ("10000", "1e+06")
    )
    assert len(left["rigid"]) >= 5
    assert fine < 1e-3
    assert fine < 0.2 * coarse
