"""Random rigs of all laws: no hang, no NaN, nothing created of a motion left to itself.

A script, not yet a test: `python tests/properties/survey_laws.py 20000`.
"""

from __future__ import annotations

import faulthandler
import math
import sys
import warnings
from collections import Counter

import numpy as np

import vibroimpact as vi

CYCLES = 8
LONGEST = 60.0
"""s; a rig takes milliseconds. One that hangs ends the process, with its number."""

RELATIONS = ("exact", "hunt-crossley", "lankarani-nikravesh", "flores", "gonthier")


def random_isolator(rng: np.random.Generator):
    """Of about unit stiffness, for motions of about unit size."""
    damping = float(rng.choice([0.0, 0.01, 0.3, 10.0 ** rng.uniform(-3, 0.5)]))
    drag = float(rng.choice([1.0, 1.0, 1.0, 2.0, 0.5, rng.uniform(0.3, 2.5)]))
    elastic, after = 10.0 ** rng.uniform(0, 1.5), 10.0 ** rng.uniform(-1.5, 0)
    force = elastic * 10.0 ** rng.uniform(-2, 0.5)
    kind = int(rng.integers(6))
    options = {"damping_exponent": drag}
    if kind == 0:
        return vi.FrictionIsolator(1.0, damping, 10.0 ** rng.uniform(-2, 0.3), **options)
    if kind == 1:
        cubic, quintic = 10.0 ** rng.uniform(-2, 1, 2)
        return vi.PolynomialIsolator(1.0, damping, cubic, quintic, **options)
    if kind == 2:
        return vi.BilinearIsolator(elastic, after, force, damping, **options)
    if kind == 3:
        n, beta = int(rng.integers(1, 6)), rng.uniform(0.1, 1.0)
        gamma = beta * rng.uniform(-0.9, 1.0)
        return vi.BoucWenIsolator(elastic, after, force, damping, n, beta, gamma, **options)
    if kind == 4:
        decay = 10.0 ** rng.uniform(-0.5, 1.5)
        return vi.ExponentialIsolator(elastic, after, decay, damping, **options)
    return vi.Isolator(1.0, damping, **options)


def random_stop(rng: np.random.Generator):
    gap = float(rng.choice([0.0, rng.uniform(0.05, 1.5), rng.uniform(0.05, 1.5)]))
    stiffness = 10.0 ** rng.uniform(-1, 5)
    kind = int(rng.integers(6))
    if kind == 0:
        return None
    if kind == 1:
        return vi.RigidStop(float(rng.uniform(0.1, 1.0)), gap)
    if kind == 2:
        return vi.Bumper(stiffness, float(rng.choice([0.0, 0.1])) * math.sqrt(stiffness), gap)
    if kind == 3:
        return vi.PowerBumper(stiffness, gap, rng.uniform(1, 3), dissipation=rng.uniform(0, 2))
    if kind == 4:
        e, relation = rng.uniform(0.2, 1.0), str(rng.choice(RELATIONS))
        return vi.PowerBumper(stiffness, gap, restitution=e, relation=relation)
    return vi.JankowskiBumper(stiffness, gap, rng.uniform(0.2, 0.99), 1.0)


def random_rig(rng: np.random.Generator) -> tuple[vi.Oscillator, vi.Harmonic]:
    right, left = random_stop(rng), random_stop(rng)
    if isinstance(right, vi.RigidStop) and isinstance(left, vi.RigidStop):
        left = left.replace(gap=left.gap + 0.05)
    shaken = vi.Harmonic(
        10.0 ** rng.uniform(-1, 0.7), 10.0 ** rng.uniform(-0.7, 0.7) / math.tau, rng.uniform(0, 6)
    )
    return vi.Oscillator(1.0, random_isolator(rng), right, left), shaken


def survey(count: int, seed: int) -> tuple[Counter[str], list[str]]:
    """Outcomes and faults."""
    rng = np.random.default_rng(seed)
    outcomes: Counter[str] = Counter()
    wrong = []
    for i in range(count):
        rig, shaken = random_rig(rng)
        print(f"rig {i} of seed {seed}: {rig!r}, {shaken!r}", flush=True)
        faulthandler.dump_traceback_later(LONGEST, exit=True)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)
            data = vi.simulate(rig, shaken, CYCLES, samples=8, max_events=3000)
        faulthandler.cancel_dump_traceback_later()
        status = data.attrs["status"].split(":")[0]
        outcomes[status] += 1
        about = f"rig {i} of seed {seed}: {{}}; {rig!r}, {shaken!r}"
        if "range of numbers" in status:
            wrong.append(about.format(status))
        names = ("displacement", "velocity", "acceleration", "final_state")
        wrong += [about.format(name) for name in names if not np.isfinite(data[name]).all()]
        for name, side in (("right", 1.0), ("left", -1.0)):
            if getattr(rig, name) is not None and (side * data[f"{name}_bumper"] < -1e-12).any():
                wrong.append(about.format(f"the {name} stop was pulled"))
    return outcomes, wrong


if __name__ == "__main__":
    totals, bad = survey(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    print(dict(totals))
    print("\n".join(bad) or "no faults")
