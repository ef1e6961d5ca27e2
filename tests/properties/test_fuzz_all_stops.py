"""Random rigs with rigid stops and preloads over decades: no hang, no NaN, no penetration, no pull.

A sample runs with the tests. More: `python tests/properties/test_fuzz_all_stops.py 20000`, and any
shaking with `20000 1 shakings`.
"""

from __future__ import annotations

import math
import sys
import time
import warnings
from collections import Counter

import numpy as np

import vibroimpact as vi

CYCLES, SAMPLES, MAX_EVENTS = 20, 16, 2000
SLOWEST = 5.0
"""s; a rig takes milliseconds."""


def random_rig(rng: np.random.Generator) -> tuple[vi.Oscillator, vi.Harmonic]:
    """A rig of unit mass and natural frequency, forced at 0.1 to 10 times that."""
    ratio = 10.0 ** rng.uniform(-1, 1)
    damping_ratio = rng.choice([0.0, 0.001, 0.05, 0.15, 1.0, 10.0 ** rng.uniform(-3, 2)])
    swing = 1.0 / math.hypot(1 - ratio**2, 2 * max(damping_ratio, 0.02) * ratio)

    def gap() -> float:
        size = rng.choice([0.0, rng.uniform(0, 1.2), 10.0 ** rng.uniform(-6, 0)])
        return float(swing * size * rng.choice([1.0, 1.0, -1.0]))

    def stop() -> vi.Bumper | vi.RigidStop | None:
        kind = rng.random()
        if kind < 0.1:
            return None
        if kind < 0.55:
            e = rng.choice([0.0, 1.0, rng.uniform(0, 1), 1 - 10.0 ** rng.uniform(-6, 0)])
            return vi.RigidStop(float(e), gap())
        stiffness = 10.0 ** rng.uniform(-3, 6)
        damping = 2 * rng.choice([0.0, 10.0 ** rng.uniform(-4, 3)]) * math.sqrt(1 + stiffness)
        return vi.Bumper(stiffness, float(damping), gap())

    right, left = stop(), stop()
    if isinstance(right, vi.RigidStop) and isinstance(left, vi.RigidStop):
        buffer = swing * float(rng.choice([1e-6, 1e-3, 0.3]))
        left = left.replace(gap=max(left.gap, buffer - right.gap))
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 2 * float(damping_ratio)), right, left)
    return rig, vi.Harmonic(1.0, ratio / math.tau, rng.uniform(0, math.tau))


def any_shaking(
    rng: np.random.Generator, rig: vi.Oscillator, plain: vi.Harmonic
) -> tuple[vi.Oscillator, vi.Harmonic | vi.Periodic | vi.Record]:
    """The rig with a constant force, perhaps without its spring; another shaking or a record."""
    if len(rig.stops) == 2 and rng.random() < 0.3:
        rig = rig.replace(isolator=vi.Isolator(0.0, rig.isolator.damping))
    if rng.random() < 0.5 and len(rig.stops) == 2:
        rig = rig.replace(force=float(rng.normal()))
    if rng.random() < 0.3:
        count = int(rng.integers(2, 120))
        step = plain.period * float(10.0 ** rng.uniform(-2, 0.3))
        return rig, vi.Record(3.0 * plain.amplitude * rng.uniform(-1, 1, count), step)
    of = str(rng.choice(["acceleration", "displacement", "force"]))
    unit = plain.angular_frequency**-2 if of == "displacement" else 1.0
    sizes = unit * plain.amplitude * rng.uniform(0, 1, int(rng.integers(1, 6)))
    phases = rng.uniform(0, math.tau, len(sizes)).tolist()
    return rig, vi.Periodic(plain.frequency, sizes.tolist(), phases, plain.phase, of=of)


def faults(
    rig: vi.Oscillator, shaken: vi.Harmonic | vi.Periodic | vi.Record
) -> tuple[str, list[str]]:
    """Run one rig from its equilibrium; say what is wrong with its motion."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        cycles = None if isinstance(shaken, vi.Record) else CYCLES
        data = vi.simulate(vi.Rig(rig, shaken), cycles, samples=SAMPLES, max_events=MAX_EVENTS)
    if data["status"] != 0:
        return data.attrs["message"], []
    names = ("displacement", "velocity", "acceleration", "final_state")
    problems = [f"{name} is not finite" for name in names if not np.isfinite(data[name]).all()]
    u = data["displacement"].values
    # In contact the displacement is a bumper's gap and its deformation together.
    gaps = [abs(stop.gap) for stop in rig.stops.values()]
    scale = max(float(np.abs(u).max()), *gaps, 0.0)
    for sign, name in ((1, "right"), (-1, "left")):
        stop = getattr(rig, name)
        if stop is None:
            continue
        face = data["deformation"].sel(stop=name).values
        inside = float((sign * u - face - stop.gap).max())
        if inside > 1e-15 * scale:
            problems.append(f"penetration of the {name} stop by {inside / scale:.1e}")
        if face.min() < -1e-13 * scale:
            problems.append(f"the {name} bumper was pulled")
        if isinstance(stop, vi.RigidStop) and (face != 0.0).any():
            problems.append(f"the rigid {name} stop was pressed in")
    impacts = data["event_contact"].values == 2
    towards = np.where(data["event_stop"].values == "right", 1, -1) * data["event_velocity"].values
    if (towards[impacts] < 0.0).any():
        problems.append("an impact from behind")
    return "done", problems


def survey(count: int, seed: int, shakings: bool = False) -> tuple[Counter[str], list[str]]:
    """Outcomes and faults."""
    rng = np.random.default_rng(seed)
    outcomes: Counter[str] = Counter()
    wrong = []
    for i in range(count):
        rig, shaken = random_rig(rng)
        if shakings:
            rig, shaken = any_shaking(rng, rig, shaken)
        begin = time.perf_counter()
        status, problems = faults(rig, shaken)
        took = time.perf_counter() - begin
        if took > SLOWEST:  # the first of its flow may compile
            begin = time.perf_counter()
            faults(rig, shaken)
            took = time.perf_counter() - begin
        if took > SLOWEST:
            problems.append(f"{took:.1f} s")
        outcomes[status.split(":")[0]] += 1
        wrong += [f"rig {i} of seed {seed}: {fault}; {rig!r}, {shaken!r}" for fault in problems]
    return outcomes, wrong


def test_random_rigs_have_sound_motions() -> None:
    outcomes, wrong = survey(300, seed=1)
    assert not wrong, "\n".join(wrong)
    assert outcomes["done"] > 250


def test_random_shakings_have_sound_motions() -> None:
    outcomes, wrong = survey(150, seed=2, shakings=True)
    assert not wrong, "\n".join(wrong)
    assert outcomes["done"] > 120


if __name__ == "__main__":
    totals, bad = survey(
        int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1, "shakings" in sys.argv
    )
    print(dict(totals))
    print("\n".join(bad) or "no faults")
