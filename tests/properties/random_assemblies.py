"""Random assemblies of one to six masses, of about unit mass, stiffness and size."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import vibroimpact as vi
from properties.random_laws import random_isolator, random_stop

MOST_MASSES = 6


def random_assembly(rng: np.random.Generator) -> tuple[vi.Assembly, vi.Harmonic]:
    """Half of them with linear laws alone, and in half a mass is held by the ground alone."""
    n = int(rng.integers(1, MOST_MASSES + 1))
    names = [f"m{i}" for i in range(n)]
    masses = {name: float(10.0 ** rng.uniform(-0.5, 0.5)) for name in names}
    linear = bool(rng.random() < 0.5)

    def isolator() -> Any:
        if linear or rng.random() < 0.4:
            damping = float(rng.choice([0.0, 0.02, 10.0 ** rng.uniform(-2, 0)]))
            return vi.Isolator(float(10.0 ** rng.uniform(-0.5, 1.5)), damping)
        law = random_isolator(rng)
        if law.damping_exponent < 1.0 and rng.random() < 0.9:  # these take seconds
            law = law.replace(damping_exponent=1.0)
        return law

    def stop() -> Any:
        gap = float(rng.choice([0.0, rng.uniform(0.05, 1.0), rng.uniform(0.05, 1.0)]))
        if not linear and rng.random() < 0.5:
            return random_stop(rng) or vi.RigidStop(0.5, gap)
        if rng.random() < 0.4:
            return vi.RigidStop(float(rng.choice([0.0, 1.0, rng.uniform(0.1, 1.0)])), gap)
        stiffness = float(10.0 ** rng.uniform(0, 4.5))
        damping = float(rng.choice([0.0, 0.1])) * math.sqrt(stiffness)
        return vi.Bumper(stiffness, damping, gap)

    # Each mass hangs on the ground or on one before it.
    links = {}
    for i, name in enumerate(names):
        before = names[int(rng.integers(i))] if i and rng.random() < 0.6 else "ground"
        links[f"l{i}"] = vi.Link(before, name, isolator())
    if n > 1 and rng.random() < 0.4:
        one, other = rng.choice(n, 2, replace=False)
        links["across"] = vi.Link(names[int(one)], names[int(other)], isolator())
    stops = {}
    for i in range(int(rng.integers(1, n + 2))):
        one, other = rng.choice(n + 1, 2, replace=False)
        ends = [["ground", *names][int(k)] for k in (one, other)]
        stops[f"s{i}"] = vi.Link(*ends, stop())
    forces = {names[0]: float(rng.uniform(-1.0, 1.0))} if rng.random() < 0.2 else {}
    shaken = vi.Harmonic(
        float(10.0 ** rng.uniform(-1, 0.7)),
        float(10.0 ** rng.uniform(-0.7, 0.7)) / math.tau,
        float(rng.uniform(0, 6)),
    )
    if rng.random() < 0.25:  # drawn last, so that the others stay what they were
        stops = {name: relaxing(rng, one) for name, one in stops.items()}
    return vi.Assembly(masses, links=links, stops=stops, forces=forces), shaken


def relaxing(rng: np.random.Generator, stop: vi.Link) -> vi.Link:
    """The same stop, but a solid where it was a bumper."""
    law = stop.law
    if not isinstance(law, vi.Bumper):
        return stop
    first = law.stiffness * float(10.0 ** rng.uniform(-1, 1))
    solid = vi.ZenerBumper(law.stiffness, first, first * float(10.0 ** rng.uniform(-2, 1)), law.gap)
    return vi.Link(stop.left, stop.right, solid)


def mirrored(assembly: vi.Assembly, shaken: vi.Harmonic) -> tuple[vi.Assembly, vi.Harmonic]:
    """Left for right."""
    turned = {
        part: {name: vi.Link(one.right, one.left, one.law) for name, one in links.items()}
        for part, links in (("links", assembly.links), ("stops", assembly.stops))
    }
    forces = {name: -force for name, force in assembly.forces.items()}
    return assembly.replace(forces=forces, **turned), shaken.replace(phase=shaken.phase + math.pi)


def reordered(rng: np.random.Generator, assembly: vi.Assembly) -> vi.Assembly:
    """Its masses and links in another order; that of stops is part of the model."""
    names = list(rng.permutation(assembly.names))
    links = list(rng.permutation(list(assembly.links)))
    return assembly.replace(
        masses={str(name): assembly.masses[name] for name in names},
        links={str(name): assembly.links[name] for name in links},
    )
