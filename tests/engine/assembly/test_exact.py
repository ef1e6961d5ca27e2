"""Against motions in 50 digits."""

from __future__ import annotations

import numpy as np
import pytest

import samples
from engine.assembly.exact import Exact
from engine.assembly.following import follow_sections, sections
from engine.assembly.systems import System, full_mass, neighbours, record, row, shaken, storeys

SYSTEMS = {
    "neighbours": neighbours(),
    "storeys": storeys(),
    "row": row(),
    "rigid row": row(0.8),
    "full mass": full_mass(),
    "record": shaken(),
}


def lines_of(name: str, system: System, cycles: int):
    if name == "record":
        return record(25 * cycles)
    return sections(0.3, system.period, cycles)


@pytest.mark.parametrize("tables", [True, False])
@pytest.mark.parametrize(
    "name", samples.sample([*SYSTEMS], ["neighbours", "rigid row", "full mass", "record"])
)
def test_states_and_times(name: str, tables: bool, exact_motion) -> None:
    system = SYSTEMS[name]
    exact = exact_motion(name)
    lines = lines_of(name, system, CYCLES)
    state, log = system.state(), np.zeros((4000, 4))
    count = follow_sections(
        system.plan(tables), system.amplitude, system.omega, state, lines, log=log
    )
    n = system.n
    assert count == len(exact.events)
    assert len({event[2] for event in exact.events}) == len(system.stops)
    log = log[:count]
    assert [int(x) for x in log[:, 2]] == [event[2] for event in exact.events]
    for mine, true in zip(log, exact.events, strict=True):
        there = true[0] * system.period if name != "record" else true[0] * 0.02
        here = mine[0] * system.period if name != "record" else mine[0] * 0.02
        assert mine[1] + here == pytest.approx(true[1] + there, abs=1e-11)
    u, v = np.array(exact.y[:n], float), np.array(exact.y[n : 2 * n], float)
    assert abs(state[2 : 2 + n] - u).max() <= 1e-11 * abs(u).max()
    assert abs(state[2 + n : 2 + 2 * n] - v).max() <= 1e-11 * abs(v).max()
    for f in range(len(system.stops)):
        true = float(exact.deformation(f))
        assert state[2 + 2 * n + f] == pytest.approx(true, rel=1e-9, abs=1e-30)


CYCLES = samples.sample(20, 3)


@pytest.fixture(scope="module")
def exact_motion():
    made: dict[str, Exact] = {}

    def make(name: str) -> Exact:
        if name not in made:
            system = SYSTEMS[name]
            made[name] = exact = Exact(
                *system[:5], system.amplitude, system.omega, system.constant, grid=1.5e-3
            )
            for k, (s, c, length) in enumerate(lines_of(name, system, CYCLES)):
                exact.advance(length, k, (s, c))
        return made[name]

    return make
