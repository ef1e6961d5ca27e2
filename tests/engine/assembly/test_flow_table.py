"""The flow of several masses through the entries of the engine: one mass is the oscillator."""

from __future__ import annotations

import math

import numpy as np
import pytest

from engine.assembly.following import follow_sections, sections
from engine.assembly.systems import System, neighbours, row
from vibroimpact.engine import (
    batch,
    event_loop,
    flow,
    lyapunov,
    orbit,
    section_map,
)
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly import measures
from vibroimpact.engine.assembly.plan import GROUND, Stop, base_motion, make_vector
from vibroimpact.engine.entry import entry
from vibroimpact.engine.flow_dispatch import planned
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.parameters import FORCING, rig_vector
from vibroimpact.engine.settling import PATIENT
from vibroimpact.engine.state import FIRST, copy, load, measures_buffer, state_buffer, width
from vibroimpact.engine.status import DONE
from vibroimpact.engine.steady_response import MEASURED, OUTCOME, PERIOD, RESULTS

MASS, STIFFNESS, DAMPING = 1.3, 150.0, 2.0
BUMPER, WALL = (2.0e4, 25.0, 0.01), (0.6, 0.02)


def vector_of(system: System, tables: bool = False) -> np.ndarray:
    return make_vector(*system[:5], constant=system.constant, tables=tables)


def one_mass(rigid: bool) -> tuple[np.ndarray, np.ndarray]:
    """The same oscillator in both flows: two bumpers, or a wall on the right."""
    right = WALL if rigid else BUMPER
    left = None if rigid else (1.0e4, 30.0, 0.015)
    known = rig_vector(MASS, STIFFNESS, DAMPING, right, left)
    stops = [Stop(0, GROUND, 0.02, restitution=0.6)]
    if not rigid:
        stops = [Stop(0, GROUND, 0.01, 2.0e4, 25.0), Stop(GROUND, 0, 0.015, 1.0e4, 30.0)]
    forcing = base_motion(np.array([[MASS]]), np.ones(1))
    matrices = ([[MASS]], [[DAMPING]], [[STIFFNESS]])
    masses = make_vector(*map(np.array, matrices), stops, forcing, tables=False)
    return known, masses


def swept(vector, frequencies, width, measured, amplitude=3.0):
    results = np.empty((len(frequencies), measured))
    states = np.empty((len(frequencies), width))
    batch.sweep(
        vector,
        np.full(len(frequencies), amplitude),
        np.asarray(frequencies, dtype=float),
        0.3,
        np.zeros(width),
        1e-12,
        2000,
        50,
        10_000,
        PATIENT,
        results,
        states,
        np.zeros(2, dtype=np.int64),
    )
    return results, states


FREQUENCIES = [0.9, 1.2, 1.6, 2.3, 6.0]
"""At lower ones the mass rests on the wall, and the flows complete a chatter in different ways."""


@pytest.mark.parametrize("rigid", [False, True])
def test_one_mass_is_swept_alike(rigid: bool) -> None:
    known, masses = one_mass(rigid)
    stops = 1 if rigid else 2
    expected, ends = swept(known, FREQUENCIES, 8, RESULTS)
    width = FIRST + 2 + stops + 1
    rows, states = swept(masses, FREQUENCIES, width, MEASURED + measures.count(1, stops))
    assert (rows[:, OUTCOME] == expected[:, OUTCOME]).all()
    assert (rows[:, PERIOD] == expected[:, PERIOD]).all()
    settled = expected[:, PERIOD] > 0
    assert settled.sum() >= 4
    u, a, of_base, of_stop = rows[:, 3:5], rows[:, 5:7], rows[:, 7:9], rows[:, 11:]
    for mine, theirs in (
        (u, expected[:, 3:5]),
        (a, expected[:, 5:7]),
        (of_base / MASS, expected[:, 13:15]),
        (of_stop[:, 0::3], expected[:, 7 : 7 + stops]),
        (of_stop[:, 1::3] / MASS, expected[:, 9 : 9 + stops]),
        (of_stop[:, 2::3] / MASS, expected[:, 11 : 11 + stops]),
        (states[:, 2:4], ends[:, 2:4]),
    ):
        scale = np.abs(theirs[settled][np.isfinite(theirs[settled])]).max()
        np.testing.assert_allclose(mine[settled], theirs[settled], rtol=0, atol=1e-12 * scale)
    assert (of_stop[:, 0::3].sum(1)[settled] > 0).any()


@pytest.mark.parametrize("rigid", [False, True])
def test_one_mass_has_the_same_orbit_and_multipliers(rigid: bool) -> None:
    known, masses = one_mass(rigid)
    frequency, amplitude, phase = 1.2, 3.0, 0.3
    stops = 1 if rigid else 2
    _, ends = swept(known, [frequency], 8, RESULTS)
    orbits = []
    for vector, parts in ((known, 5), (masses, 2 + stops)):
        numbers = section_map.SYSTEM - 2 if parts == 5 else len(vector)
        base = np.append(vector[:numbers], [amplitude, 0.0])
        direction = np.zeros(numbers + 2)
        direction[-1] = 1.0
        point = np.zeros(parts + 1)
        point[:2], point[-1] = ends[0, 2:4] * 1.001, frequency
        scale = np.append(np.full(parts, 0.02), 1.0)
        scale[1] = 0.2
        facts, columns, slope = (
            np.zeros(5 + max(stops, 2)),
            np.zeros((parts, parts)),
            np.zeros(parts),
        )
        normal = np.append(np.zeros(parts), 1.0)
        outcome = orbit.correct(
            vector,
            base,
            direction,
            phase,
            1,
            False,
            1000,
            scale,
            normal,
            point,
            facts,
            columns,
            slope,
        )
        assert outcome == DONE
        damping, again = np.zeros(1), np.zeros((parts, parts))
        state = np.zeros(8 if parts == 5 else FIRST + parts + 1)
        state[2:4] = point[:2]
        done = lyapunov.monodromy(
            vector, amplitude, frequency, phase, state, 1, 1000, again, damping
        )
        assert done == DONE
        np.testing.assert_allclose(again, columns, rtol=0, atol=1e-9 * abs(columns).max())
        contacts = facts[section_map.CONTACTS :][:stops]
        orbits.append((point[:2], columns[:2, :2], slope[:2], contacts, damping[0]))
    (u, matrix, rate, hits, lost), (mine, mine_matrix, mine_rate, mine_hits, mine_lost) = orbits
    np.testing.assert_allclose(mine, u, rtol=0, atol=1e-13 * abs(u).max())
    np.testing.assert_allclose(mine_matrix, matrix, rtol=0, atol=1e-12 * abs(matrix).max())
    np.testing.assert_allclose(mine_rate, rate, rtol=0, atol=1e-6 * abs(rate).max())
    assert mine_hits.tolist() == hits.tolist()
    assert hits.sum() >= 1
    assert mine_lost == pytest.approx(lost, rel=1e-12)


def test_every_function_of_the_table_is_there() -> None:
    for module in flow.FLOWS:
        for name in flow.SIGNATURES:
            assert callable(getattr(module, name)), name
    assert at.FLOW == FORCING


CYCLE, EXTREMES, TANGENT, MIRRORED = range(4)


@entry("i8(f8[::1], f8, f8, f8, i8, f8[::1], f8[:, ::1])", "disturbed")
def watched(memory, rig, amplitude, frequency, phase, which, state, q):
    """A cycle unobserved and observed; or a state mirrored."""
    plan = planned(memory, rig)
    flow.build(plan, amplitude, 2.0 * math.pi * frequency)
    here, notes = state_buffer(), measures_buffer()
    s, c = math.sin(phase), math.cos(phase)
    load(plan, pointer(state), here, s, c)
    events = 0
    if which == CYCLE:
        events = flow.cycle(plan, here, s, c, 1.0 / frequency, 1000)
    elif which == EXTREMES:
        flow.nothing(plan, notes)
        events = event_loop.extremes(plan, here, s, c, 1.0 / frequency, 1000, notes)
    elif which == TANGENT:
        section_map.start_notes(plan, notes)
        flow.unit_disturbances(plan, here, pointer(q))
        events = event_loop.tangent(plan, here, s, c, 1.0 / frequency, 1000, notes, pointer(q))
    else:
        flow.mirror(plan, here, pointer(q))
    copy(here, pointer(state), width(plan))
    return events


@pytest.mark.parametrize("tables", [False, True])
@pytest.mark.parametrize("name", ["neighbours", "row", "rigid row"])
def test_observers_do_not_disturb_a_motion(name: str, tables: bool) -> None:
    system = {"neighbours": neighbours(), "row": row(), "rigid row": row(0.8)}[name]
    vector, parts = vector_of(system, tables), 2 * system.n + len(system.stops)
    ends, counts = [], []
    for which in (CYCLE, EXTREMES, TANGENT):
        state, q = system.state()[:-2].copy(), np.zeros((parts, parts))
        count = 0
        for _ in range(9):
            count += watched(
                vector, system.amplitude, system.omega / math.tau, 0.4, which, state, q
            )
        ends.append(state)
        counts.append(count)
    assert counts[0] >= 9
    assert counts[1] == counts[2] == counts[0]
    assert ends[1].tolist() == ends[2].tolist() == ends[0].tolist()


def test_a_mirror_image_is_turned_back() -> None:
    system = neighbours()
    stops = [Stop(0, GROUND, 0.02, 3e4, 30.0), Stop(GROUND, 0, 0.02, 3e4, 30.0)]
    system = system._replace(stops=stops)
    vector = vector_of(system)
    assert vector[at.SYMMETRIC] == 1.0
    assert vector_of(neighbours())[at.SYMMETRIC] == 0.0
    assert vector_of(system._replace(constant=np.array([1.0, 0.0])))[at.SYMMETRIC] == 0.0
    state = system.state([0.021, 0.004], [0.3, -0.2])[:-2].copy()
    state[0], state[1] = 1.0, 16.0 * (4 * 2 + 2) + 3.0
    state[6:8] = 0.001, 0.0005
    before, q = state.copy(), np.arange(36.0).reshape(6, 6)
    watched(vector, 1.0, 1.0, 0.0, MIRRORED, state, q)
    assert state[0] == 2.0
    assert state[1] == 16.0 * (4 * 1 + 2) + 3.0
    assert state[2:8].tolist() == [-0.021, -0.004, -0.3, 0.2, 0.0005, 0.001]
    assert q[0].tolist() == [0.0, -1.0, -2.0, -3.0, 5.0, 4.0]
    watched(vector, 1.0, 1.0, 0.0, MIRRORED, state, q)
    assert state.tolist() == before.tolist()


def test_numbers_that_follow_from_others_are_put_right() -> None:
    """A system on the line from one vector to another is the one between."""
    first, last = neighbours(), neighbours()
    stops = [one._replace(damping=3.0 * one.damping, gap=2.0 * one.gap) for one in last.stops]
    last = last._replace(stops=stops, stiffness=3.0 * last.stiffness)
    middle = [one._replace(damping=2.0 * one.damping, gap=1.5 * one.gap) for one in first.stops]
    between = first._replace(stops=middle, stiffness=2.0 * first.stiffness)
    vectors = [np.append(vector_of(one), [3.0, 1.7]) for one in (first, last, between)]
    direction = np.where(vectors[1] != vectors[0], vectors[1] - vectors[0], 0.0)
    maps = []
    for base, line, value in (
        (vectors[0], direction, 0.5),
        (vectors[2], np.zeros(len(direction)), 0.5),
    ):
        point, facts = np.zeros(7), np.zeros(section_map.CONTACTS + 2)
        point[:4], point[-1] = [0.001, 0.002, 0.1, -0.3], value
        columns, slope, image = np.zeros((6, 6)), np.zeros(6), np.zeros(7)
        done = orbit.evaluate(
            base[:-2],
            base,
            line,
            0.2,
            2,
            False,
            1000,
            np.ones(7),
            point,
            facts,
            columns,
            slope,
            image,
        )
        assert done == DONE
        assert facts[section_map.CONTACTS :].sum() >= 2
        maps.append((image[:6], columns))
    np.testing.assert_allclose(maps[0][0], maps[1][0], rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(maps[0][1], maps[1][1], rtol=1e-9, atol=1e-12)


def test_extremes_bound_what_is_sampled_and_are_met() -> None:
    """Of every mass, every stop and the base, beside 20,000 samples a cycle."""
    system = row()
    n, stops = system.n, len(system.stops)
    size = MEASURED + measures.count(n, stops)
    result, state = np.zeros(size), system.state()
    plan = system.plan(tables=False)
    line = sections(0.3, system.period, 1)
    follow_sections(plan, system.amplitude, system.omega, state, np.tile(line, (5, 1)))
    point, facts = np.append(state[2 : 2 + 2 * n + stops], 0.0), np.zeros(5 + stops)
    facts[section_map.MODE] = state[0]
    numbers = np.append(vector_of(system), [system.amplitude, system.omega / math.tau])
    assert orbit.measure_orbit(numbers, 0.3, point, facts, 1, 1000, result) == DONE
    turns = 0.3 + math.tau * np.arange(20_000) / 20_000
    lasts = np.full(20_000, system.period / 20_000)
    parts = np.column_stack([np.sin(turns), np.cos(turns), lasts])
    rows = np.full((80_000, 2 + 3 * n + 3 * stops), np.nan)
    follow_sections(plan, system.amplitude, system.omega, state, parts, samples=rows, tau=0.0)
    rows = rows[~np.isnan(rows[:, 0])]
    u, absolute = rows[:, 2 : 2 + n], rows[:, 2 + 2 * n : 2 + 3 * n]
    forces = rows[:, 2 + 3 * n + stops : 2 + 3 * n + 2 * stops]
    seen = result[MEASURED:]
    base = measures.OF_MASS * n
    carried = -absolute @ np.diag(system.mass) + system.constant.sum()
    for low, high, samples in (
        *((seen[4 * i], seen[4 * i + 1], u[:, i]) for i in range(n)),
        *((seen[4 * i + 2], seen[4 * i + 3], absolute[:, i]) for i in range(n)),
        (seen[base], seen[base + 1], carried),
    ):
        reach = samples.max() - samples.min()
        assert -1e-9 * reach <= samples.min() - low <= 1e-4 * reach
        assert -1e-9 * reach <= high - samples.max() <= 1e-4 * reach
    pushed = seen[base + measures.OF_BASE + measures.PUSHED :: measures.OF_STOP]
    hits = seen[base + measures.OF_BASE + measures.HITS :: measures.OF_STOP]
    assert hits.sum() >= 2
    np.testing.assert_allclose(pushed, forces.max(0), rtol=1e-3)
    assert (pushed >= forces.max(0) * (1 - 1e-9)).all()
