"""Random rigs over nine decades: no hang, no NaN, no penetration, no pull.

A sample runs with the tests. All 100,000: `python tests/properties/test_fuzz.py 100000`.
"""

from __future__ import annotations

import math
import sys
import time
from collections import Counter

import numpy as np

from vibroimpact.engine import batch
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.engine.state import ONE_MASS
from vibroimpact.engine.status import Status

CYCLES, SAMPLES, MAX_EVENTS = 20, 16, 1000


def random_rig(rng: np.random.Generator) -> dict[str, object]:
    """A rig of unit mass and natural frequency, forced at 0.1 to 10 times that."""
    ratio = 10.0 ** rng.uniform(-1, 1)
    damping_ratio = rng.choice([0.0, 0.001, 0.05, 0.15, 1.0, 10.0 ** rng.uniform(-3, 2)])
    amplitude = 1.0 / math.hypot(1 - ratio**2, 2 * max(damping_ratio, 0.02) * ratio)

    def bumper() -> tuple[float, float, float] | None:
        if rng.random() < 0.1:
            return None
        stiffness = 10.0 ** rng.uniform(-3, 6)
        damping = 2 * rng.choice([0.0, 10.0 ** rng.uniform(-4, 3)]) * math.sqrt(1 + stiffness)
        gap = rng.choice(
            [0.0, amplitude * rng.uniform(0, 1.2), amplitude * 10.0 ** rng.uniform(-6, 0)]
        )
        return stiffness, damping, gap

    return {
        "damping": 2 * damping_ratio,
        "right": bumper(),
        "left": bumper(),
        "ratio": ratio,
        "phase": rng.uniform(0, 2 * math.pi),
    }


def faults(case: dict[str, object]) -> tuple[Status, list[str]]:
    """Run one rig from rest; say what is wrong with its motion."""
    right, left = case["right"], case["left"]
    state = np.zeros(ONE_MASS.width)
    out = np.full((record_layout.SAMPLE, CYCLES * SAMPLES + 1), np.nan)
    events = np.empty((MAX_EVENTS * (CYCLES + 1) + 1, record_layout.EVENT))
    _, _, outcome = batch.trajectory(
        rig_vector(1.0, 1.0, case["damping"], right, left),
        1.0,
        case["ratio"] / (2 * math.pi),
        case["phase"],
        state,
        0.0,
        float(CYCLES),
        SAMPLES,
        MAX_EVENTS,
        out,
        events,
    )
    if outcome != Status.DONE:
        return Status(outcome), []
    problems = []
    if not (np.isfinite(out[: record_layout.CLEARANCE]).all() and np.isfinite(state).all()):
        problems.append("not finite")
    u = out[record_layout.DISPLACEMENT]
    depth_r, depth_l = out[record_layout.DEFORMATION :][: record_layout.STOPS]
    scale = np.abs(u).max()
    for bumper, inside in ((right, u - depth_r), (left, -depth_l - u)):
        if bumper and (inside - bumper[2]).max() > 1e-13 * max(scale, bumper[2]):
            problems.append(f"penetration {(inside - bumper[2]).max() / scale:.1e}")
    if min(depth_r.min(), depth_l.min()) < -1e-13 * scale:
        problems.append("a bumper was pulled")
    return Status(outcome), problems


def survey(count: int, seed: int) -> tuple[Counter[str], list[str], float]:
    """Outcomes, faults and the longest run in seconds."""
    rng = np.random.default_rng(seed)
    batch.trajectory.prepare()
    outcomes: Counter[str] = Counter()
    wrong = []
    longest = 0.0
    for i in range(count):
        case = random_rig(rng)
        begin = time.perf_counter()
        status, problems = faults(case)
        took = time.perf_counter() - begin
        if took > longest:
            longest = took
            print(f"longest so far: {took:.3f} s, rig {i} {case}") if __name__ == "__main__" else 0
        outcomes[status.name] += 1
        wrong += [f"rig {i} of seed {seed}: {fault}; {case}" for fault in problems]
    return outcomes, wrong, longest


def test_random_rigs_have_sound_motions() -> None:
    outcomes, wrong, _ = survey(2000, seed=1)
    assert not wrong, "\n".join(wrong)
    assert set(outcomes) <= {"DONE", "TOO_MANY_EVENTS", "TOO_MUCH_WORK"}
    assert outcomes["DONE"] > 1950


if __name__ == "__main__":
    begun = time.perf_counter()
    totals, bad, slowest = survey(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    print(dict(totals), f"{time.perf_counter() - begun:.0f} s, longest {slowest:.2f} s")
    print("\n".join(bad) or "no faults")
