"""Random laws given as formulas: energies balance, nothing hangs, and nothing is pulled."""

from __future__ import annotations

import ast

import numpy as np

import vibroimpact as vi
from properties.random_laws import any_shaking, random_isolator, random_rig, random_stop
from properties.test_fuzz_laws import looked_at
from samples import sample

ISOLATORS = (
    "k*u/(1 + abs(u)/a) + c*v",
    "k*u + k3*u**3/(1 + (u/a)**2) + c*v",
    "f*tanh(u/a) + c*v*abs(v) + b*v",
    "k*u*exp(-(u/a)**2) + k3*u**3 + c*v",
    "f*sinh(u/a) + c*v*(1 + (u/a)**2)",
    "k*u*sqrt(1 + (u/a)**2) + c*v/(1 + abs(v)/b)",
    "k*u + f*sin(u/a) + c*v + k3*u**7",
    "k*u*(1 + (u/a)**2)**-0.25 + c*v",
)
STOPS = (
    "k*d + k3*d**3 + c*v",
    "k*d**2*(1 + chi*v) + k*d",
    "f*(exp(d/a) - 1) + c*v*d",
    "k*d/(1 + d/a) + c*v*d**2",
    "k*d + c*v*abs(v)",
)


def own(rng: np.random.Generator, formulas: tuple[str, ...], gap: float | None = None) -> vi.Law:
    """A random formula with random numbers."""
    formula = str(rng.choice(formulas))
    stiff = 10.0 ** rng.uniform(0, 4) if gap is not None else 1.0
    sizes = {"k": stiff, "k3": stiff, "a": 0.5, "b": 0.5, "c": 0.1 * stiff**0.5, "f": 0.5 * stiff}
    sizes["chi"] = 0.3
    names = {node.id for node in ast.walk(ast.parse(formula)) if isinstance(node, ast.Name)}
    numbers = {
        name: size * 10.0 ** rng.uniform(-0.5, 0.5) for name, size in sizes.items() if name in names
    }
    return vi.Law(formula, gap, **numbers)


def random_own_rig(rng: np.random.Generator) -> tuple[vi.Oscillator, vi.Harmonic]:
    """An isolator, a stop or both by a formula."""
    _, shaken = random_rig(rng)
    which = int(rng.integers(3))
    isolator = random_isolator(rng) if which == 1 else own(rng, ISOLATORS)
    gaps = [float(rng.choice([0.0, rng.uniform(0.05, 1.0), rng.uniform(-0.3, 0.0)])) for _ in "rl"]
    if sum(gaps) < 0.0 and rng.random() < 0.5:
        gaps = [abs(gap) for gap in gaps]
    stops = [
        random_stop(rng) if which == 0 and rng.random() < 0.7 else own(rng, STOPS, gap)
        for gap in gaps
    ]
    if all(isinstance(stop, vi.RigidStop) for stop in stops):
        stops[1] = stops[1].replace(gap=stops[1].gap + 0.05)
    return vi.Oscillator(1.0, isolator, *stops), shaken


def survey(count: int, seed: int) -> tuple[int, list[str]]:
    """How many were followed to the end, and what is wrong."""
    rng = np.random.default_rng(seed)
    done, wrong = 0, []
    for i in range(count):
        rig, shaken = random_own_rig(rng)
        status, problems = looked_at(rig, shaken if i % 4 else any_shaking(rng, shaken))
        # A sine softens: a motion may go where it no longer pushes back, and ends there.
        done += status == "done" or "in which the softening isolator" in status
        wrong += [f"rig {i} of seed {seed}: {one}; {rig!r}, {shaken!r}" for one in problems]
    return done, wrong


def test_random_rigs_of_formulas() -> None:
    count = sample(2000, 2)
    done, wrong = survey(count, 5)
    assert not wrong, "\n".join(wrong)
    assert done > 0.99 * count
