"""The flow of several masses through the entries of the engine: one mass is the oscillator."""

from __future__ import annotations

import numpy as np
import pytest

from engine.assembly.systems import System
from vibroimpact.engine import batch, lyapunov, orbit, section_map
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly import measures
from vibroimpact.engine.assembly.plan import GROUND, Stop, base_motion, make_vector
from vibroimpact.engine.hold import MEASURED, OUTCOME, PERIOD, RESULTS
from vibroimpact.engine.parameters import rig_vector
from vibroimpact.engine.settling import PATIENT
from vibroimpact.engine.status import DONE

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
    width = at.PARTS + 2 + stops + 1
    found, states = swept(masses, FREQUENCIES, width, MEASURED + measures.count(1, stops))
    assert (found[:, OUTCOME] == expected[:, OUTCOME]).all()
    assert (found[:, PERIOD] == expected[:, PERIOD]).all()
    settled = expected[:, PERIOD] > 0
    assert settled.sum() >= 4
    u, a, of_base, of_stop = found[:, 3:5], found[:, 5:7], found[:, 7:9], found[:, 9:]
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
    found = []
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
        state = np.zeros(8 if parts == 5 else at.PARTS + parts + 1)
        state[2:4] = point[:2]
        done = lyapunov.monodromy(
            vector, amplitude, frequency, phase, state, 1, 1000, again, damping
        )
        assert done == DONE
        np.testing.assert_allclose(again, columns, rtol=0, atol=1e-9 * abs(columns).max())
        contacts = facts[section_map.CONTACTS :][:stops]
        found.append((point[:2], columns[:2, :2], slope[:2], contacts, damping[0]))
    (u, matrix, rate, hits, lost), (mine, mine_matrix, mine_rate, mine_hits, mine_lost) = found
    np.testing.assert_allclose(mine, u, rtol=0, atol=1e-13 * abs(u).max())
    np.testing.assert_allclose(mine_matrix, matrix, rtol=0, atol=1e-12 * abs(matrix).max())
    np.testing.assert_allclose(mine_rate, rate, rtol=0, atol=1e-6 * abs(rate).max())
    assert mine_hits.tolist() == hits.tolist()
    assert hits.sum() >= 1
    assert mine_lost == pytest.approx(lost, rel=1e-12)
