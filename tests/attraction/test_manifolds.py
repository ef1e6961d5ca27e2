"""Stable curves lie on borders, unstable ones lead to the motions, and both map into themselves."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
import xarray as xr
from scipy.spatial import KDTree

import vibroimpact as vi
from samples import sample
from vibroimpact.attraction.adaptive_curve import (
    CYCLES,
    LONGEST,
    LOST,
    Allowance,
    CurveMetric,
    refined,
)
from vibroimpact.attraction.crossings import crossings
from vibroimpact.attraction.label_states import NO_TRAPS, SectionSetup, follow, images
from vibroimpact.attraction.saddles import _places
from vibroimpact.datasets.vocabulary import VARIABLES

CASE = vi.laboratory.case("B3-10mm-A3")
EXCITATION = vi.Harmonic(CASE.amplitude, 0.7)
STAGE = SectionSetup(vi.Rig(CASE.oscillator, EXCITATION))
WINDOW = (-0.011, 0.011), (-0.104, 0.104)
SIDES = np.ptp(np.array(WINDOW), axis=1)


STEPS: list[tuple[int, int | None]] = []
"""Of `dataset`: done and total."""


@cache
def dataset() -> xr.Dataset:
    def tell(done: int, total: int | None) -> None:
        STEPS.append((done, total))

    return vi.manifolds(vi.Rig(CASE.oscillator, EXCITATION), None, *WINDOW, progress=tell)


def test_progress_counts_states_then_places_then_parts_of_curves():
    curves = dataset().sizes["curve"]
    ends = [one for one, later in zip(STEPS, [*STEPS[1:], (0, 0)], strict=True) if later < one]
    states, places, parts = ends[-3:]
    assert states == (1600, 1600)
    assert places == (6, 6)
    assert parts == (100 * curves, 100 * curves)


def curve(data: xr.Dataset, number: int, scale: object = SIDES) -> np.ndarray:
    mine = data["curve_number"].values == number
    both = np.column_stack([data["curve_displacement"], data["curve_velocity"]])
    return both[mine] / scale


def curves(kind: str) -> list[np.ndarray]:
    numbers = np.flatnonzero(dataset()["curve_kind"].values == kind)
    return [curve(dataset(), int(number)) for number in numbers]


def inside(points: np.ndarray) -> np.ndarray:
    return points[(np.abs(points) <= 0.5).all(axis=1)]


def begun(points: np.ndarray) -> np.ndarray:
    states = np.zeros((len(points), 5))
    states[:, :2] = points * SIDES
    return states


def basin_of(points: np.ndarray) -> np.ndarray:
    """Which of the two motions states lead to, followed to the end."""
    ends = follow(STAGE, begun(points), None, NO_TRAPS, 120).states
    return ends[:, 3] > 0.0


def test_what_is_found():
    data = dataset()
    for name in data.variables:
        assert data[name].attrs["units"] == VARIABLES[str(name)].units
    assert list(data["curve_kind"].values) == ["stable", "stable", "unstable", "unstable"]
    assert list(data["saddle_period"].values) == [1]
    alone = vi.orbit(
        vi.Rig(CASE.oscillator, EXCITATION),
        vi.State(float(data["saddle_displacement"][0]), float(data["saddle_velocity"][0])),
    )
    sizes = np.abs(alone["multiplier_real"].values)
    assert sizes[0] == pytest.approx(float(data["multiplier_growing"][0]), rel=1e-6)
    assert sizes[1] == pytest.approx(abs(float(data["multiplier_dying"][0])), rel=1e-4)
    assert data.sizes["crossing"] == 0


def test_neighbours_are_as_close_as_asked_for():
    for number in range(4):
        points = curve(dataset(), number)
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        in_view = (np.abs(points[1:]) <= 0.5).all(axis=1)
        assert steps[in_view].max() <= 0.01 * (1.0 + 1e-9)
        assert steps[in_view].mean() > 0.0003


def test_tight_spirals_are_round():
    """Where a curve winds up to a motion, lines between its points stay close to it."""
    corner = np.array([0.5, 0.5])
    measure = CurveMetric(-corner, corner, 0.01, 30.0, 1, 10**9)

    def spiral(at: np.ndarray) -> np.ndarray:
        radius = 0.02 * np.exp(-2.0 * at)
        return radius[:, None] * np.column_stack([np.cos(40.0 * at), np.sin(40.0 * at)])

    points, ended = refined(spiral, 0.0, 1.0, measure, 30.0, Allowance(measure))
    assert ended == ""
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).max() <= 0.01
    chords = points[2:] - points[:-2]
    aside = points[1:-1] - points[:-2]
    across = np.abs(chords[:, 0] * aside[:, 1] - chords[:, 1] * aside[:, 0])
    # A point is four times as far from the chord of its neighbours as its lines from the curve.
    bows = across / np.linalg.norm(chords, axis=1) / 4.0
    assert bows.max() < 0.025 * 0.01
    assert len(points) < 500


def test_beside_a_stable_curve_states_part():
    for points in curves("stable"):
        middle = inside(points)[5 :: sample(2, 9)]
        way = np.gradient(inside(points), axis=0)[5 :: sample(2, 9)]
        across = np.column_stack([-way[:, 1], way[:, 0]])
        across *= 1e-5 / np.linalg.norm(across, axis=1, keepdims=True)
        assert (basin_of(middle + across) != basin_of(middle - across)).all()


def test_the_border_of_a_grid_lies_on_stable_curves():
    data = vi.basins(vi.Rig(CASE.oscillator, EXCITATION), *WINDOW, nodes=sample(300, 80))
    labels = data["basin"].values
    u, v = data["displacement"].values / SIDES[0], data["velocity"].values / SIDES[1]
    tree = KDTree(np.vstack(curves("stable")))
    rows, columns = np.nonzero(labels[:, 1:] != labels[:, :-1])
    assert len(rows) > 50
    between = np.column_stack([0.5 * (u[columns] + u[columns + 1]), v[rows]])
    away, _ = tree.query(between)
    assert away.max() < 0.5 * (u[1] - u[0]) + 0.006  # half the nodes' and half the points' distance


def test_unstable_curves_end_on_the_motions():
    data = vi.basins(vi.Rig(CASE.oscillator, EXCITATION), *WINDOW, nodes=20)
    motions = np.column_stack([data["section_displacement"], data["section_velocity"]]) / SIDES
    ends = np.array([points[-1] for points in curves("unstable")])
    away = np.linalg.norm(ends[:, None] - motions[None], axis=2)
    assert away.min(axis=1).max() < 1e-3
    assert set(away.argmin(axis=1)) == {0, 1}
    assert list(dataset()["curve_ended"].values[2:]) == ["the curve ends at a steady motion"] * 2


@pytest.mark.parametrize("kind", ["stable", "unstable"])
def test_the_map_takes_a_curve_into_itself(kind):
    for points in curves(kind):
        dense = np.vstack([np.linspace(a, b, 9)[:-1] for a, b in pairwise(points)])
        tree = KDTree(dense)
        picked = inside(points)[1:-2]
        went, known = images(STAGE, begun(picked))
        assert known.all()
        away, _ = tree.query(went[:, :2] / SIDES)
        # As far as straight lines between points follow a bent curve.
        assert np.quantile(away, 0.9) < 2e-4
        assert away.max() < 3e-3


def test_states_on_a_stable_curve_come_to_the_saddle():
    data = dataset()
    saddle = np.array([data["saddle_displacement"][0], data["saddle_velocity"][0]]) / SIDES
    for points in curves("stable"):
        nearest = np.full(len(picked := inside(points)), np.inf)
        states = follow(STAGE, begun(picked), None, NO_TRAPS, 0).states
        for _ in range(12):
            away = np.linalg.norm(states[:, 2:4] / SIDES - saddle, axis=1)
            nearest = np.minimum(nearest, away)
            states = follow(STAGE, None, states, NO_TRAPS, 1).states
        assert nearest.max() < 1e-4


def test_given_saddles_are_those_that_borders_lead_to():
    first = vi.State(0.0053, 0.002)
    orbit = vi.orbit(vi.Rig(CASE.oscillator, EXCITATION), first)
    for saddles in (first, orbit, [orbit]):
        data = vi.manifolds(vi.Rig(CASE.oscillator, EXCITATION), saddles, *WINDOW, longest=0.5)
        assert float(data["saddle_velocity"][0]) == pytest.approx(
            float(dataset()["saddle_velocity"][0]), rel=1e-7
        )
        # The side of a direction is told by nothing.
        pieces = [curve(data, number)[-1] for number in (0, 1)]
        tree = KDTree(np.vstack(curves("stable")))
        assert tree.query(pieces)[0].max() < 0.006


@pytest.mark.full
def test_tangles_are_found_where_curves_cross():
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.06), vi.Bumper(30.0, 0.6, 0.5), None)
    shaking, sides = vi.Harmonic(1.0, 3.3 / (2.0 * np.pi)), np.array([2.1, 3.6])
    window, start = ((-1.1, 1.0), (-1.8, 1.8)), vi.State(0.4624, 0.4448)
    data = vi.manifolds(vi.Rig(rig, shaking), start, *window, period=3, spacing=0.01, longest=3.0)
    kinds = data["curve_kind"].values
    assert data.sizes["crossing"] > 10
    assert (kinds[data["crossing_stable"].values] == "stable").all()
    assert (kinds[data["crossing_unstable"].values] == "unstable").all()
    # What begins there comes to the saddle; a crossing is known as well as the lines are.
    points = np.zeros((data.sizes["crossing"], 5))
    points[:, 0], points[:, 1] = data["crossing_displacement"], data["crossing_velocity"]
    saddles = np.column_stack([data["saddle_displacement"], data["saddle_velocity"]]) / sides
    stage = SectionSetup(vi.Rig(rig, shaking))
    states = follow(stage, points, None, NO_TRAPS, 0).states
    nearest = np.full(len(points), np.inf)
    for _ in range(24):
        away = np.linalg.norm(states[:, None, 2:4] / sides - saddles, axis=2).min(axis=1)
        nearest = np.minimum(nearest, away)
        states = follow(stage, None, states, NO_TRAPS, 1).states
    assert np.quantile(nearest, 0.9) < 0.01, np.quantile(nearest, [0.1, 0.5, 0.9, 1.0])


TANGLE = vi.Rig(
    vi.Oscillator(1.0, vi.Isolator(1.0, 0.06), vi.Bumper(30.0, 0.6, 0.5), None),
    vi.Harmonic(1.0, 3.3 / (2.0 * np.pi)),
)


def tangle(cycles: int, longest: float = 3.0) -> xr.Dataset:
    window, start = ((-1.1, 1.0), (-1.8, 1.8)), vi.State(0.4624, 0.4448)
    return vi.manifolds(TANGLE, start, *window, period=3, longest=longest, curve_cycles=cycles)


@pytest.mark.full
def test_work_is_bounded_and_what_is_left_out_is_told(monkeypatch):
    """With few cycles, each curve is the beginning of the one with many."""
    used = []
    use = Allowance.use
    monkeypatch.setattr(Allowance, "use", lambda one, n: (used.append(n), use(one, n)))
    short = tangle(12_000)
    # One point more may cost the preimages of all levels, or those of a piece refined once.
    assert sum(used) < 2 * 12_000
    long = tangle(100_000)
    ended = short["curve_ended"].values
    assert (ended == CYCLES).any()
    (line,) = [one for one in short.attrs["notes"].splitlines() if "curve_cycles" in one]
    count = int((ended == CYCLES).sum())
    assert line.startswith(f"{count} of {len(ended)} curves continue beyond their ends")
    for number in np.flatnonzero(ended == CYCLES):
        part, whole = curve(short, int(number), 1.0), curve(long, int(number), 1.0)
        assert 2 < len(part) < len(whole)
        # The last piece of the longer one may have been refined more.
        away, _ = KDTree(whole).query(part)
        assert away.max() < 1e-6


def test_a_strong_stretch_is_refined_only_up_to_the_length():
    """A piece that the map stretches to hundreds of thousands of windows keeps its beginning."""
    measure = CurveMetric(np.zeros(2), np.ones(2), 0.01, 3.0, 400, 10**9)
    asked = []

    def at(parameters: np.ndarray) -> np.ndarray:
        asked.append(len(parameters))
        angle = 1e6 * (parameters - 7.0)  # never whole turns apart
        return 0.5 + 0.3 * np.column_stack([np.cos(angle), np.sin(angle)])

    points, ended = refined(at, 7.0, 8.0, measure, 3.0, Allowance(measure))
    assert ended == LONGEST
    assert measure.length(points) == pytest.approx(3.0, abs=0.02)
    assert sum(asked) < 5_000


def test_what_was_given_up_ends_a_piece():
    measure = CurveMetric(np.zeros(2), np.ones(2), 0.01, 3.0, 400, 10**9)

    def at(parameters: np.ndarray) -> np.ndarray:
        lost = parameters > 7.5
        return np.column_stack([np.where(lost, np.nan, parameters - 7.0), parameters - 7.0])

    points, ended = refined(at, 7.0, 8.0, measure, 3.0, Allowance(measure))
    assert ended == LOST
    np.testing.assert_allclose(points[-1], [0.5, 0.5], atol=0.01)


def test_all_borders_are_searched_before_any_is_searched_again():
    labels = np.repeat(np.arange(12, dtype=np.int8), 20).reshape(12, 20).T
    places, borders = _places(labels)
    assert borders == 11
    flat = labels.ravel()
    kinds = [(flat[a], flat[b]) for a, b in places]
    assert len(set(kinds[:11])) == 11
    assert len(kinds) == 36
    mixed = np.random.default_rng(0).integers(0, 12, (40, 40)).astype(np.int8)
    places, borders = _places(mixed)
    assert (len(places), borders) == (36, 66)


def test_saddles_and_borders_that_were_left_out_are_told(monkeypatch):
    monkeypatch.setattr("vibroimpact.attraction.saddles._MOST", 0)
    data = vi.manifolds(vi.Rig(CASE.oscillator, EXCITATION), None, *WINDOW)
    assert data.sizes["saddle"] == 0
    assert data.attrs["notes"].startswith("1 saddle orbits were found; only the 0 of the shortest")


def test_crossings_of_lines_that_are_known():
    x = np.linspace(0.0, 3.5 * np.pi, 400)
    wave = np.column_stack([x, np.sin(x)])
    line = np.array([[-1.0, 0.0], [2.0, 0.0], [20.0, 0.0]])
    met = crossings(wave[1:], line)
    np.testing.assert_allclose(met[:, 0], np.pi * np.array([1, 2, 3]), atol=1e-3)
    parted = np.insert(line, 1, np.nan, axis=0)  # only the second piece is left
    np.testing.assert_allclose(crossings(wave[1:], parted), met, atol=1e-12)
    assert crossings(wave, line + np.array([0.0, 2.0])).shape == (0, 2)
    assert crossings(wave[:1], line).shape == (0, 2)


@pytest.mark.parametrize(
    ("saddles", "words", "named"),
    [
        (
            vi.State(0.0026, -0.027),
            {},
            "saddles[0]: this orbit is not a saddle, because the absolute values of its "
            "multipliers are",
        ),
        (xr.Dataset(), {}, "saddles[0]: this dataset is not an orbit"),
        (None, {"spacing": 0.0}, "spacing: "),
        (None, {"longest": -1.0}, "longest: "),
        (None, {"period": 0}, "period: 0"),
        (
            None,
            {"displacement": (1.0, 0.0)},
            "displacement: the first value, 1 m, is not below the second, 0 m",
        ),
    ],
)
def test_what_is_refused(saddles, words, named):
    with pytest.raises(vi.InputError) as caught:
        vi.manifolds(vi.Rig(CASE.oscillator, EXCITATION), saddles, **words)
    assert str(caught.value).startswith(named)


def test_an_orbit_at_another_phase_is_refused():
    orbit = vi.orbit(vi.Rig(CASE.oscillator, EXCITATION), vi.State(0.0053, 0.002))
    with pytest.raises(
        vi.InputError, match="phase of this orbit is 0 rad, but the phase of the excitation is 1"
    ):
        vi.manifolds(vi.Rig(CASE.oscillator, EXCITATION.replace(phase=1.0)), orbit, *WINDOW)


def test_what_remembers_has_no_curves_in_the_plane():
    slow = vi.Bumper(680e3, 4e5, 0.005)
    rig = vi.Oscillator(550.0, CASE.oscillator.isolator, slow, slow)
    with pytest.raises(vi.InputError, match="a bumper needs more than one cycle to relax"):
        vi.manifolds(vi.Rig(rig, EXCITATION))


@pytest.mark.full
def test_a_saddle_that_presses_a_stop_with_a_restitution_is_refused_at_that_phase():
    stop = vi.PowerBumper(stiffness=10e6, gap="5 mm", exponent=1.5, restitution=0.7)
    rig = CASE.oscillator.replace(right=stop, left=stop)
    shaking = vi.Harmonic("0.05 g", "2.5 Hz")
    with pytest.raises(vi.InputError, match="a phase at which the mass touches no stop"):
        vi.manifolds(vi.Rig(rig, shaking))
    data = vi.manifolds(vi.Rig(rig, shaking.replace(phase=1.6)), longest=1.0)
    near = vi.State(
        float(data["saddle_displacement"][0]), float(data["saddle_velocity"][0]), phase=1.6
    )
    saddle = vi.orbit(vi.Rig(rig, shaking), near)
    first = saddle["multiplier_real"].values[:2]
    both = [float(data["multiplier_growing"][0]), float(data["multiplier_dying"][0])]
    np.testing.assert_allclose(both, first, rtol=1e-6)
    # The same orbit where it presses the stop, given.
    there = vi.simulate(vi.Rig(rig, shaking), 1.0 - 1.6 / (2.0 * np.pi), saddle)
    with pytest.raises(vi.InputError, match="whose force depends on the impact speed"):
        vi.manifolds(vi.Rig(rig, shaking), vi.orbit(vi.Rig(rig, shaking), there))
