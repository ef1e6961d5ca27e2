"""What is observed on a stretch, against the equations of motion and against other stretches."""

from __future__ import annotations

import numpy as np
import pytest

from engine.assembly.following import follow_sections, sections
from engine.assembly.systems import full_mass, neighbours, record, row, shaken, storeys
from vibroimpact.engine.assembly.plan import GROUND

SYSTEMS = {
    "neighbours": neighbours(),
    "storeys": storeys(),
    "row": row(),
    "rigid row": row(0.8),
    "full mass": full_mass(),
    "record": shaken(),
}


def observed(system, lines, tau, tables=True):
    n, stops = system.n, len(system.stops)
    samples = np.full((20000, 2 + 3 * n + 3 * stops), np.nan)
    state = system.state()
    plan = system.plan(tables)
    assert (
        follow_sections(
            plan, system.amplitude, system.omega, state, lines, samples=samples, tau=tau
        )
        > 0
    )
    samples = samples[~np.isnan(samples[:, 0])]
    parts = np.split(samples, np.cumsum([1, 1, n, n, n, stops, stops]), axis=1)
    return state, dict(
        zip(
            ("section", "t", "u", "v", "absolute", "clearance", "force", "deformation"),
            parts,
            strict=True,
        )
    )


@pytest.mark.parametrize("tables", [True, False])
@pytest.mark.parametrize("name", SYSTEMS)
def test_equations_of_motion(name: str, tables: bool) -> None:
    system = SYSTEMS[name]
    shaken = name == "record"
    lines = record(200) if shaken else sections(0.3, system.period, 8)
    end, seen = observed(system, lines, 0.37, tables)
    plain = system.state()
    follow_sections(system.plan(tables), system.amplitude, system.omega, plain, lines)
    assert (plain == end).all()
    line = lines[seen["section"][:, 0].astype(int)]
    t = seen["t"][:, 0]
    if shaken:
        waves = (line[:, 0] + line[:, 1] * t)[:, None]
        forces = waves * system.forcing.weights
    else:
        angle = 0.3 + system.omega * t
        count = system.forcing.weights.shape[1] // 2
        waves = np.column_stack(
            [f((q + 1) * angle) for q in range(count) for f in (np.sin, np.cos)]
        )
        forces = system.amplitude * waves @ system.forcing.weights.T
    base = forces
    forces = forces - seen["u"] @ system.stiffness.T - seen["v"] @ system.damping.T
    if system.constant is not None:
        forces = forces + system.constant
    for f, stop in enumerate(system.stops):
        force = seen["force"][:, f]
        closing = np.zeros(len(t))
        speed = np.zeros(len(t))
        for body, sign in ((stop.left, 1.0), (stop.right, -1.0)):
            if body != GROUND:
                forces[:, body] -= sign * force
                closing += sign * seen["u"][:, body]
                speed += sign * seen["v"][:, body]
        d, clearance = seen["deformation"][:, f], seen["clearance"][:, f]
        size = abs(closing).max()
        assert (force >= -1e-9).all()
        assert (clearance >= -1e-13 * size).all()
        assert abs(clearance - (stop.gap - closing + d)).max() <= 1e-13 * size
        if stop.restitution is None:
            touching = force > 0.0
            assert touching.any()
            law = stop.stiffness * d + stop.damping * speed
            assert abs(force - law)[touching].max() <= 1e-11 * abs(law).max()
    if system.forcing.shaken:
        forces = forces - base
    absolute = np.linalg.solve(system.mass, forces.T).T
    assert abs(seen["absolute"] - absolute).max() <= 1e-12 * abs(absolute).max()
