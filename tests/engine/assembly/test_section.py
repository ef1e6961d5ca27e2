"""States at a section: placed, disturbed, and carried with their disturbances."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from engine.assembly.following import follow_sections, sections
from engine.assembly.systems import neighbours, row
from vibroimpact.engine import lyapunov
from vibroimpact.engine.assembly import section
from vibroimpact.engine.assembly.advance import build
from vibroimpact.engine.assembly.plan import make_vector
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.rigless_entry import rigless_entry
from vibroimpact.engine.status import DONE

PLACE, DISTURB, DESCRIBE = range(3)


@rigless_entry("f8(i8, f8[::1], f8, f8, f8[::1], f8[:, ::1], f8[::1])")
def ask(
    placeholder: Any,
    what: int,
    memory: Vector,
    amplitude: float,
    omega: float,
    state: Vector,
    q: Vector,
    numbers: Vector,
) -> float:
    plan, here = pointer(memory), pointer(state)
    build(plan, amplitude, omega)
    if what == PLACE:
        section.place(plan, here)
    elif what == DISTURB:
        return section.disturb(plan, here, int(numbers[0]), numbers[1], numbers[2])
    else:
        numbers[0] = section.parts(plan)
        numbers[1] = section.stiff_rate(plan)
        numbers[2] = section.size(plan, here)
        numbers[3] = section.too_much_work(plan, 1.0)
        numbers[4] = section.too_much_work(plan, 1e9)
        section.units(plan, pointer(q))
    return 0.0


def test_a_state_is_described() -> None:
    system = neighbours()
    q, numbers = np.zeros((1, 6)), np.zeros(5)
    state = system.state([0.003, -0.001], [0.2, -0.1])
    ask(DESCRIBE, system.plan(), system.amplitude, system.omega, state, q, numbers)
    parts, rate, size, little, much = numbers
    assert (parts, little, much) == (6, 0, 1)
    assert list(q[0]) == [rate, rate, 1.0, 1.0, rate, rate]
    fastest = np.sqrt(222.0 / 0.9)
    assert fastest <= rate <= 1.2 * fastest
    assert size == max(0.2, rate * 0.003)


def test_states_are_placed() -> None:
    system = row(0.8)
    state = system.state([0.03, 0.0, 0.0])
    ask(PLACE, system.plan(), 1.0, 1.0, state, np.zeros((1, 1)), np.zeros(1))
    # 20 mm too far: masses of 1 and 1.3 kg are moved apart about their centre.
    assert state[2] - state[3] == pytest.approx(0.01, abs=1e-15)
    assert state[2] + 1.3 * state[3] == pytest.approx(0.03, abs=1e-15)
    assert state[0] == 0

    system = row()
    state = system.state([0.03, 0.0, 0.0], [0.0, 0.0, 0.0])
    ask(PLACE, system.plan(), 1.0, 1.0, state, np.zeros((1, 1)), np.zeros(1))
    assert state[0] == 1
    assert state[8] == pytest.approx(0.02, abs=1e-15)
    # Too fast away for the dashpot to press.
    state = system.state([0.011, 0.0, 0.0], [-5.0, 0.0, 0.0])
    ask(PLACE, system.plan(), 1.0, 1.0, state, np.zeros((1, 1)), np.zeros(1))
    assert state[0] == 0
    assert state[8] == pytest.approx(0.001, abs=1e-15)


def test_parts_are_disturbed_that_outlive_a_period() -> None:
    system = neighbours()
    slow = [s._replace(stiffness=100.0, damping=60.0) for s in system.stops]
    for stops, outlives in ((system.stops, False), (slow, True)):
        one = system._replace(stops=stops)
        for part in range(6):
            state = one.state()
            before = state.copy()
            numbers = np.array([part, 1e-6, one.period])
            by = ask(DISTURB, one.plan(), 1.0, one.omega, state, np.zeros((1, 1)), numbers)
            assert by == (1e-6 if part < 4 or outlives else 0.0)
            assert state[2 + part] - before[2 + part] == by


def test_disturbances_of_a_section_are_carried() -> None:
    """As the rows that `follow_sections` carries."""
    system = neighbours()
    line = sections(0.3, system.period, 1)
    state = system.state()
    follow_sections(system.plan(), system.amplitude, system.omega, state, np.tile(line, (7, 1)))
    plain, q, damping = state.copy(), np.zeros((6, 6)), np.zeros(1)
    rows = np.eye(6)
    plan = system.plan(tables=False)
    follow_sections(plan, system.amplitude, system.omega, plain, line, disturbances=rows)
    vector = make_vector(*system[:5], tables=False)
    frequency, kept = system.omega / math.tau, state[:-2].copy()
    done = lyapunov.monodromy(vector, system.amplitude, frequency, 0.3, kept, 1, 1000, q, damping)
    assert done == DONE
    np.testing.assert_allclose(kept[2:], plain[2:-2], rtol=1e-12, atol=1e-16)
    np.testing.assert_allclose(q, rows, rtol=0, atol=1e-11 * abs(rows).max())
