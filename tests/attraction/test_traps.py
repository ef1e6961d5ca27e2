"""What traps hold leads to the motion that they are made for."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import vibroimpact as vi
from samples import sample
from vibroimpact.attraction.find_attractors import Search
from vibroimpact.attraction.label_states import NO_TRAPS, SectionSetup, Traps, follow, parts
from vibroimpact.engine.absorption import CENTRE, REACH, form_of, trap_width

CASE = vi.laboratory.case("B3-10mm-A3")


@cache
def searched(hertz: float) -> Search:
    search = Search(SectionSetup(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, hertz))))
    generator = np.random.default_rng(0)
    points = np.zeros((60, 5))
    points[:, :2] = generator.uniform(-1.0, 1.0, (60, 2)) * [0.012, 0.1]
    search.label(points)
    return search


def inside(trap: np.ndarray, count: int) -> np.ndarray:
    """Random points in an ellipse of u and u̇, its rim among them."""
    form = trap[form_of(5) :].reshape(5, 5)[:2, :2]
    generator = np.random.default_rng(1)
    angles = generator.uniform(0.0, 2.0 * np.pi, count)
    radii = np.where(np.arange(count) % 2, 1.0, np.sqrt(generator.uniform(0.0, 1.0, count)))
    ball = radii[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    points = np.zeros((count, 5))
    points[:, :2] = trap[CENTRE : CENTRE + 2] + ball @ np.linalg.inv(np.linalg.cholesky(form))
    return points


def test_what_is_in_an_ellipse_stays_and_is_drawn_in():
    search = searched(0.7)
    assert len(search.known) == 2
    for one in search.known:
        (trap,) = one.traps
        points = inside(trap, sample(2000, 300))
        assert np.abs(points[:, 0] - trap[CENTRE]).max() <= trap[REACH]
        assert np.abs(points[:, 0] - trap[CENTRE]).max() > 0.95 * trap[REACH]
        held = Traps(trap[None], NO_TRAPS.cells, NO_TRAPS.grid)
        states = follow(search.stage, points, None, NO_TRAPS, 1).states
        for _ in range(4):
            again = follow(search.stage, None, states, held, 0)
            assert (again.owner >= 0).all()
            states = follow(search.stage, None, states, NO_TRAPS, 1).states
        ends = follow(search.stage, None, states, NO_TRAPS, 150).states
        np.testing.assert_allclose(parts(ends)[:, 0], one.points[0, 0], atol=1e-12)


def test_an_ellipse_is_no_smaller_than_it_need_be():
    search = searched(0.7)
    border = 0.0014  # from the nearer motion to the border of its basin
    for one in search.known:
        assert one.traps[0, REACH] > 0.3 * border


@pytest.mark.full
def test_chaotic_motions_are_held_by_cells():
    search = searched(1.06)
    assert [one.settled_motion.period for one in search.known] == [0, 0]
    assert all(one.traps.shape == (0, trap_width(5)) for one in search.known)
    cells, grid = search.traps.cells, search.traps.grid
    generator = np.random.default_rng(2)
    for number, one in enumerate(search.known):
        rows, columns = np.nonzero(cells == number)
        assert len(rows) > 100
        pick = generator.integers(0, len(rows), sample(3000, 500))
        share = generator.uniform(0.0, 1.0, (len(pick), 2))
        points = np.zeros((len(pick), 5))
        points[:, 0] = grid[0] + grid[2] * (columns[pick] + share[:, 0])
        points[:, 1] = grid[1] + grid[3] * (rows[pick] + share[:, 1])
        states = follow(search.stage, points, None, NO_TRAPS, 1).states
        for _ in range(3):
            again = follow(search.stage, None, states, search.traps, 0)
            np.testing.assert_array_equal(again.owner, number)
            states = follow(search.stage, None, states, NO_TRAPS, 7).states
        # The motion itself never leaves them.
        first = np.zeros((200, 5))
        first[:] = one.points[:200]
        assert (follow(search.stage, first, None, search.traps, 0).owner == number).all()


@pytest.mark.full
def test_motions_of_long_periods_have_a_trap_a_point():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), vi.RigidStop(0.9, 0.0), None)
    search = Search(SectionSetup(vi.Rig(rig, vi.Harmonic(1.0, 3.3 / (2.0 * np.pi)))))
    points = np.zeros((sample(400, 40), 5))
    generator = np.random.default_rng(3)
    points[:, :2] = generator.uniform([-1.0, -1.2], [0.0, 1.2], (len(points), 2))
    labels = search.label(points)
    assert (labels.owner >= 0).all()
    assert {8, 12} <= {one.settled_motion.period for one in search.known}
    for one in search.known:
        assert len(one.traps) == one.settled_motion.period
    # The same without any trap.
    ends = follow(search.stage, points, None, NO_TRAPS, 3000).states[:, 2:4]
    for number, one in enumerate(search.known):
        mine = ends[labels.owner == number]
        away = np.abs(mine[:, None] - one.points[None, :, :2]).max(axis=2).min(axis=1)
        assert (away < 1e-6).all()


@cache
def restituting() -> Search:
    """Two motions, one of which presses a stop at the section, not without its approach speed."""
    stop = vi.PowerBumper(stiffness=10e6, gap="5 mm", exponent=1.5, restitution=0.7)
    rig = CASE.oscillator.replace(right=stop, left=stop)
    search = Search(SectionSetup(vi.Rig(rig, vi.Harmonic("0.05 g", "2.5 Hz"))))
    points = np.zeros((40, 5))
    points[:, :2] = np.random.default_rng(4).uniform(-1.0, 1.0, (40, 2)) * [0.012, 0.2]
    assert (search.label(points).owner >= 0).all()
    return search


def test_a_motion_that_presses_such_a_stop_at_the_section_has_a_trap_too():
    search = restituting()
    assert sorted(len(one.traps) for one in search.known) == [1, 1]
    (pressed,) = (one for one in search.known if one.points[0, 2] > 0.0)
    (trap,) = pressed.traps
    # In three components: all of it is pressed, and met at some speed.
    gap = search.stage.oscillator.right.gap
    assert trap[CENTRE] - trap[REACH] > gap
    assert trap[REACH] > 1e-4
    form = trap[form_of(5) :].reshape(5, 5)
    kept = np.ix_([0, 1, 2], [0, 1, 2])
    sphere = np.random.default_rng(5).normal(size=(sample(500, 100), 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    offsets = sphere @ np.linalg.inv(np.linalg.cholesky(form[kept]))
    points = np.tile(trap[CENTRE : CENTRE + 5], (len(sphere), 1))
    points[:, :3] += offsets
    assert (points[:, 2] > 0.0).all()
    held = Traps(trap[None], NO_TRAPS.cells, NO_TRAPS.grid)
    states = follow(search.stage, points, None, NO_TRAPS, 1).states
    assert (follow(search.stage, None, states, held, 0).owner >= 0).all()
    ends = follow(search.stage, None, states, NO_TRAPS, 60).states
    np.testing.assert_allclose(
        parts(ends), np.broadcast_to(pressed.points[0], (len(ends), 5)), atol=1e-10
    )


def test_what_settles_on_a_known_motion_is_not_described_again(monkeypatch):
    def never(*_: object) -> None:
        raise AssertionError("a known motion was described once more")

    search = restituting()
    states = np.array([one.settled_motion.state for one in search.known])
    went = follow(search.stage, None, states, NO_TRAPS, 3).states
    monkeypatch.setattr("vibroimpact.attraction.find_attractors.attractor", never)
    assert [search._end_of(state)[0] for state in went] == [0, 1]
