"""Random rigs of all laws, of about unit mass, stiffness and size."""

from __future__ import annotations

import math

import numpy as np

import vibroimpact as vi
from formula_stops import formula_stops

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
    others = list(formula_stops(stiffness, gap).values())
    kind = int(rng.integers(6 + len(others)))
    if kind > 5:
        return others[kind - 6]
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


def any_shaking(
    rng: np.random.Generator, plain: vi.Harmonic
) -> vi.Harmonic | vi.Periodic | vi.Record:
    """Another shaking of about the same size: several harmonics, even ones too, or a record."""
    if rng.random() < 0.3:
        count, step = int(rng.integers(20, 80)), plain.period * float(rng.uniform(0.02, 0.3))
        return vi.Record(3.0 * plain.amplitude * rng.uniform(-1.0, 1.0, count), step)
    of = str(rng.choice(["acceleration", "displacement", "force"]))
    unit = plain.angular_frequency**-2 if of == "displacement" else 1.0
    sizes = unit * plain.amplitude * rng.uniform(0.0, 1.0, int(rng.integers(2, 6)))
    phases = rng.uniform(0.0, math.tau, len(sizes)).tolist()
    return vi.Periodic(plain.frequency, sizes.tolist(), phases, plain.phase, of=of)
