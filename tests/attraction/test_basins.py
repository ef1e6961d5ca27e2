"""Basins against following each state to its end, and what must hold of them."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from samples import sample
from vibroimpact.attraction.label_states import NO_TRAPS, SectionSetup, follow
from vibroimpact.datasets.vocabulary import VARIABLES

CODE, HERTZ = "B3-10mm-A3", 0.7
WINDOW = (-0.012, 0.012), (-0.1, 0.1)


@cache
def two(nodes: int = 60) -> xr.Dataset:
    return vi.basins(CODE, *WINDOW, frequency=HERTZ, nodes=nodes)


def test_as_each_state_followed_to_the_end_by_steady():
    nodes = sample(50, 7)
    data = two(nodes)
    case = vi.laboratory.case(CODE)
    excitation = vi.Harmonic(case.amplitude, HERTZ)
    sizes = data["displacement_excursion"].values
    assert len(sizes) == 2
    for v in data["velocity"].values:
        for u in data["displacement"].values:
            alone = vi.steady(vi.Rig(case.oscillator, excitation), vi.State(u, v), 1)
            number = int(data["basin"].sel(displacement=u, velocity=v))
            assert float(alone["displacement_excursion"]) == pytest.approx(sizes[number], rel=1e-9)


def test_what_basins_show():
    data = two()
    for name in data.variables:
        assert data[name].attrs["units"] == VARIABLES[str(name)].units
    assert list(data["motion"].values) == ["periodic"] * 2
    assert list(data["period"].values) == [1, 1]
    assert list(data["mirror_image"].values) == [0, 1]
    assert int(data["states"].sum()) == 3600
    assert float(data["share"].sum()) == pytest.approx(1.0)
    assert (data["share_low"] < data["share"]).all()
    assert (data["share"] < data["share_high"]).all()
    assert (data["border_distance"] > 1e-3).all()
    assert 0.85 < float(data["uncertainty_exponent"]) < 1.1
    assert float(data["border_entropy"]) < np.log(2.0)
    assert float(data["capture_cycles"].mean()) < 4.0
    assert "each of 60 × 60 states" in data.attrs["lattice"]


def test_shares_lie_within_those_of_states_at_random():
    data = two(sample(300, 60))
    generator = np.random.default_rng(7)
    drawn = sample(4000, 500)
    points = np.zeros((drawn, 5))
    points[:, 0] = generator.uniform(*WINDOW[0], drawn)
    points[:, 1] = generator.uniform(*WINDOW[1], drawn)
    case = vi.laboratory.case(CODE)
    stage = SectionSetup(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, HERTZ)))
    ends = follow(stage, points, None, NO_TRAPS, 150).states
    places = np.column_stack([data["section_displacement"], data["section_velocity"]])
    away = np.abs(ends[:, None, 2:4] - places).max(axis=2)
    assert (away.min(axis=1) < 1e-9).all()
    low, high = vi_interval((away.argmin(axis=1) == 0).sum(), drawn)
    assert low <= float(data["share"][0]) <= high


def vi_interval(hits: int, total: int) -> tuple[float, float]:
    from scipy.stats import binomtest

    interval = binomtest(int(hits), total).proportion_ci(0.99)
    return interval.low, interval.high


@pytest.mark.full
def test_the_mirror_image_is_that_of_half_a_cycle_later():
    case = vi.laboratory.case(CODE)
    nodes = sample(200, 60)
    pair = [
        vi.basins(
            vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.06, phase)), *WINDOW, nodes=nodes
        )
        for phase in (0.0, np.pi)
    ]
    kinds = [list(data["motion"].values) for data in pair]
    assert kinds == [["chaotic", "chaotic"]] * 2
    assert list(pair[0]["mirror_image"].values) == [1, 0]
    # A pair of mirror images: which is called the larger is decided by rounding.
    first = pair[0]["basin"].values
    second = pair[1]["basin"].values[::-1, ::-1]
    centres = [float(data["eccentricity"][0]) for data in pair]
    swapped = centres[0] * centres[1] > 0.0
    assert ((first != second) if swapped else (first == second)).all()


def test_no_thread_changes_a_state():
    one = vi.basins(CODE, *WINDOW, frequency=HERTZ, nodes=60, threads=1)
    xr.testing.assert_identical(one, two())


def test_refined_beside_borders():
    full = two(61)
    refined = vi.basins(CODE, *WINDOW, frequency=HERTZ, nodes=16, refine=2)
    assert refined["basin"].shape == (61, 61)
    followed = refined["level"].values >= 0
    assert 0.1 < followed.mean() < 0.6
    np.testing.assert_array_equal(refined["basin"].values[followed], full["basin"].values[followed])
    assert (refined["basin"].values == full["basin"].values).mean() > 0.99
    assert (refined["capture_cycles"].values[~followed] == -1).all()
    assert "may be missed" in refined.attrs["lattice"]


def test_a_window_of_its_own_holds_the_motions():
    data = vi.basins(CODE, frequency=HERTZ, nodes=20)
    for name in ("displacement", "velocity"):
        at = data[f"section_{name}"].values
        assert (data[name].values[0] < at).all()
        assert (at < data[name].values[-1]).all()


def test_nothing_behind_a_wall():
    wall = vi.RigidStop(0.8, 0.5)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), wall, None)
    data = vi.basins(vi.Rig(rig, vi.Harmonic(1.0, 0.3)), (-1.0, 1.0), (-1.0, 1.0), nodes=21)
    behind = data["displacement"].values > 0.5
    assert (data["basin"].values[:, behind] == -2).all()
    assert (data["basin"].values[:, ~behind] >= 0).all()
    assert float(data["share"].sum()) == pytest.approx(1.0)


def test_bumpers_that_remember():
    slow = vi.Bumper(680e3, 4e5, 0.005)  # 1.7 1/s
    case = vi.laboratory.case(CODE)
    rig = vi.Oscillator(550.0, case.oscillator.isolator, slow, slow)
    excitation = vi.Harmonic(case.amplitude, HERTZ)
    data = vi.basins(vi.Rig(rig, excitation), *WINDOW, nodes=4, deformation={"right": "2 mm"})
    for v in data["velocity"].values:
        for u in data["displacement"].values:
            depth = max(u - 0.005, 0.002)
            alone = vi.steady(
                vi.Rig(rig, excitation), vi.State(u, v, deformation={"right": depth}), 1
            )
            number = int(data["basin"].sel(displacement=u, velocity=v))
            size = float(data["displacement_excursion"][number])
            assert float(alone["displacement_excursion"]) == pytest.approx(size, rel=1e-8)


def test_where_nothing_dies_out_it_is_said():
    spring = vi.Bumper(680e3, 0.0, 0.005)
    rig = vi.Oscillator(550.0, vi.Isolator(26e3, 0.0), spring, spring)
    with pytest.raises(vi.InputError, match="loses no energy"):
        vi.basins(vi.Rig(rig, vi.Harmonic(0.5, HERTZ)), *WINDOW, nodes=10)


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (
            {"displacement": (0.01, -0.01)},
            "displacement: the first value, 10 mm, is not below the second, -10 mm",
        ),
        (
            {"displacement": 0.01},
            "displacement: 0.01; pass the lowest and the highest value as",
        ),
        ({"velocity": ("1 m", "2 m")}, "velocity[0]"),
        ({"nodes": 1}, "nodes: 1"),
        ({"nodes": (3, 4, 5)}, "nodes: "),
        ({"refine": 9}, "refine: 9"),
        ({"deformation": {"right": -0.001}}, "deformation.right: -0.001"),
        ({"deformation": {"top": 0.001}}, "deformation.top: this is not a stop"),
        ({"max_cycles": 0}, "max_cycles: 0"),
    ],
)
def test_what_is_refused(words, named):
    with pytest.raises(vi.InputError) as caught:
        vi.basins(CODE, frequency=HERTZ, **words)
    assert str(caught.value).startswith(named)


def test_only_a_spring_and_dashpot_keeps_a_deformation():
    """Not a formula with a number of this name, whose face follows the mass."""
    stop = vi.Law("k*d + damping*d**2*v", "2 mm", k=1e4, damping=1e3)
    rig = vi.Rig(vi.Oscillator(1.0, vi.Isolator(100.0, 4.0), stop), 1.0, 1.5)
    with pytest.raises(vi.InputError, match=r"^deformation\.right: 0.001 m, but the right"):
        vi.basins(rig, *WINDOW, nodes=2, deformation={"right": "1 mm"})
    with pytest.raises(vi.InputError, match=r"^deformation\.left: 0.001 m, but the left"):
        vi.basins(rig, *WINDOW, nodes=2, deformation={"left": "1 mm"})
