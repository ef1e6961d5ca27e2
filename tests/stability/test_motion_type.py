"""The judgement on made-up growths, and on motions whose kind is known by another way."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

import vibroimpact as vi
from reference.zero_one import rotation_number, zero_one
from vibroimpact.cli import main
from vibroimpact.stability.motion_type import averages, judge, recurrence, settling


def noise(*shape: int, seed: int = 5) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal(shape)


def growth(mean: float, spread: float, cycles: int = 20_000, seed: int = 5) -> np.ndarray:
    return np.column_stack([mean + spread * noise(cycles, seed=seed), np.full(cycles, -1.0 - mean)])


WANDERING = noise(20_000, 4, seed=6)


@pytest.mark.parametrize(
    ("mean", "spread", "kind"),
    [
        (0.5, 1.0, "chaotic"),
        (0.02, 0.2, "chaotic"),
        (0.0, 0.01, "quasi-periodic"),
        (-0.1, 0.3, "undecided"),  # falls, but does not repeat
        (0.002, 1.0, "undecided"),  # grows no more than its own noise
    ],
)
def test_growth_in_the_mean(mean, spread, kind):
    assert judge(growth(mean, spread), WANDERING).motion == kind


def test_growth_like_a_shear_is_quasi_periodic():
    """Neighbouring tori without dissipation: a disturbance grows in proportion to time."""
    logarithms = np.column_stack([np.diff(np.log(1.0 + np.arange(20_001))), np.zeros(20_000)])
    assert judge(logarithms, WANDERING).motion == "quasi-periodic"


def test_a_long_period_is_found():
    points = np.tile(noise(37, 4), (600, 1))[:20_000]
    verdict = judge(growth(-0.1, 0.3), points)
    assert (verdict.motion, verdict.period) == ("periodic", 37)
    assert verdict.evidence == "the section repeats after 37 cycles"
    assert recurrence(points) == 37
    assert recurrence(WANDERING) == 0
    # One near return is no period.
    points = noise(100, 2)
    points[89] = points[99]
    assert recurrence(points) == 0


def test_too_few_cycles():
    verdict = judge(growth(0.5, 1.0, 10), WANDERING[:10])
    assert verdict.motion == "undecided"
    assert "10 cycles" in verdict.evidence
    assert judge(growth(0.5, 0.1, 0), WANDERING[:0]).motion == "undecided"


def test_a_bounded_growth_over_few_cycles_says_nothing():
    assert judge(growth(0.0, 0.01, 900), WANDERING[:900]).motion == "undecided"
    assert judge(growth(0.0, 0.01, 1100), WANDERING[:1100]).motion == "quasi-periodic"
    case = vi.laboratory.case("B3-10mm-A3")
    data = vi.steady(vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.1)), exponent_cycles=60)
    assert data["motion"].item() == "undecided"


@pytest.mark.parametrize(("cycles", "kind"), [(1000, "undecided"), (20_000, "chaotic")])
def test_weak_chaos_is_never_a_torus(cycles, kind):
    """Its growth over few cycles is less than that on some tori."""
    verdict = judge(growth(0.01, 0.15, cycles), WANDERING[:cycles])
    assert verdict.motion == kind
    assert judge(growth(0.0, 0.15, 1000), WANDERING[:1000]).bounded


def test_weak_chaos_of_neighbours(tmp_path, capsys):
    """The largest exponent is 0.0123 ± 0.0005 per cycle."""
    path = tmp_path / "neighbours.toml"
    assert main(["init", str(path), "--kind", "neighbours"]) == 0
    options = {"samples": 4, "window": 4, "exponent_cycles": 1000}
    kinds = [
        vi.steady(path, frequency=frequency, **options)["motion"].item()
        for frequency in (2.7903, 2.8005, 2.802, 2.8025)
    ]
    assert not {"quasi-periodic", "periodic"} & set(kinds)
    data = vi.bifurcation_diagram(path, {"frequency": (2.8025, 2.803)}, 2)
    assert data["motion"].sel(frequency=2.8025).values.tolist() == ["chaotic", "chaotic"]


def test_a_diagram_follows_a_torus_until_it_is_one():
    rig, shaken, _ = remembering()
    frequency = shaken.frequency
    data = vi.bifurcation_diagram(
        vi.Rig(rig, shaken), {"frequency": (frequency, 1.0001 * frequency)}, 2, directions="up"
    )
    assert data["motion"].values.ravel().tolist() == ["quasi-periodic"] * 2
    assert data["section_displacement"].sizes["section_point"] == 200


def test_no_torus_where_areas_shrink_as_the_damping_says():
    """Where bumpers forget (docs/theory.md, 6.5); without damping there are tori, and attractors
    of bumpers that remember."""
    cycles = 3000
    wandering = 0.3 * np.sin(np.arange(cycles + 1.0))
    first = np.diff(wandering)
    section = np.column_stack([np.sin(math.sqrt(2) * np.arange(cycles))] * 4)
    for damping, total, kind in (
        (0.04, 0.04, "undecided"),
        (0.0, 0.0, "quasi-periodic"),
        (0.04, 0.02, "quasi-periodic"),
    ):
        logarithms = np.column_stack([first, -total - first])
        verdict = judge(logarithms, section, np.full(cycles, damping))
        assert verdict.motion == kind
        assert (verdict.returns > 0) == (kind == "undecided")


def test_uncertainty_is_that_of_the_mean():
    """Of independent cycles it is σ/√N; of slow drifts it is larger."""
    estimates = [averages(growth(0.3, 1.0, 3200, seed)) for seed in range(300)]
    many, spreads = [mean[0] for mean, _ in estimates], [spread[0] for _, spread in estimates]
    assert np.mean(spreads) == pytest.approx(1.0 / math.sqrt(3200), rel=0.05)
    assert np.std(many) == pytest.approx(np.mean(spreads), rel=0.15)
    slow = np.repeat(noise(32), 100)
    _, spread = averages(np.column_stack([slow, slow]))
    assert spread[0] > 0.1
    assert np.isinf(averages(growth(0.3, 1.0, 31))[1]).all()


def symmetric(stiffness, damping, isolator, gap):
    bumper = vi.Bumper(stiffness, damping, gap)
    return vi.Oscillator(1.0, vi.Isolator(1.0, isolator), bumper, bumper)


def soft_impact(omega: float) -> tuple[vi.Oscillator, vi.Harmonic]:
    """x″ + 2ξx′ + x + β (x − e) H(x − e) = a ω² sin ωτ: the soft impact oscillator.

    β = 29, ξ = 0.01, e = 1.26, a = 0.7 are the parameters of J. Ing, E. Pavlovskaia,
    M. Wiercigroch, S. Banerjee, Phil. Trans. R. Soc. A 366 (2008) 679.
    """
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.02), vi.Bumper(29.0, 0.0, 1.26), None)
    return rig, vi.Harmonic(0.7 * omega**2, omega / (2 * math.pi), math.pi)


def free() -> tuple[vi.Oscillator, vi.Harmonic, vi.State]:
    """Undamped free flight at √2 times the natural frequency: a torus in closed form."""
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), None, None)
    return rig, vi.Harmonic(1.0, math.sqrt(2) / (2 * math.pi), math.pi), vi.State(0.3, 0.0)


def conservative() -> tuple[vi.Oscillator, vi.Harmonic, vi.State]:
    """Undamped elastic stops, near an elliptic orbit: a torus of Kolmogorov, Arnold and Moser."""
    start = vi.State(0.02, 2.869576927971126)
    return symmetric(4.0, 0.0, 0.0, 1.0), vi.Harmonic(1.0, 1.5 / (2 * math.pi), math.pi), start


def remembering() -> tuple[vi.Oscillator, vi.Harmonic, vi.State]:
    """Bumpers that relax more slowly than they are struck: an attracting torus."""
    return symmetric(0.01, 0.2, 0.02, 0.6), vi.Harmonic(1.0, 1.376 / (2 * math.pi)), vi.State()


@cache
def settled(which: str):
    rig, shaken, start = {
        "chaos": (*soft_impact(0.905), None),
        "period 1": (*soft_impact(0.92), None),
        "period 5": (*soft_impact(0.81), None),
        "free": free(),
        "conservative": conservative(),
        "remembering": remembering(),
    }[which]
    return vi.steady(vi.Rig(rig, shaken), start, 4, window=4000, max_cycles=5000)


def points(which: str) -> tuple[np.ndarray, np.ndarray]:
    data = settled(which)
    return data["displacement"].values[:-1:4], data["velocity"].values[:-1:4]


@pytest.mark.parametrize(
    ("which", "kind", "period"),
    [
        ("chaos", "chaotic", 0),
        ("period 1", "periodic", 1),
        ("period 5", "periodic", 5),
        ("free", "quasi-periodic", 0),
        ("conservative", "quasi-periodic", 0),
        ("remembering", "quasi-periodic", 0),
    ],
)
def test_known_kinds(which, kind, period):
    data = settled(which)
    assert data["motion"].item() == kind
    assert int(data["period"]) == period


def test_chaos_by_the_zero_one_test():
    assert zero_one(points("chaos")[0]) > 0.9
    assert float(settled("chaos")["exponents"][0]) > 0.03
    # Neighbours part at the rate of the exponent, until they are as far apart as can be.
    rig, shaken = soft_impact(0.905)
    one = settled("chaos")["final_state"]
    first = vi.State(*(float(v) for v in one.values[:2]), phase=float(one.values[4]))
    other = first.replace(displacement=first.displacement + 1e-11)
    distance = []
    for cycles in (10, 20, 30, 40, 50, 60, 70):
        ends = [
            vi.simulate(vi.Rig(rig, shaken), cycles, s, 0)["final_state"] for s in (first, other)
        ]
        distance.append(float(abs(ends[0] - ends[1])[:2].max()))
    rate = np.polyfit([10, 20, 30, 40, 50, 60, 70], np.log(distance), 1)[0]
    expected = float(settled("chaos")["exponents"][0]) / shaken.frequency
    assert rate == pytest.approx(expected, rel=0.5)
    assert distance[-1] > 1e3 * distance[0]


@pytest.mark.parametrize("which", ["free", "conservative", "remembering"])
def test_tori_by_the_zero_one_test_and_rotation_number(which):
    x, y = points(which)
    assert zero_one(x) < 0.1
    # A rotation number that has converged: the same from either half, to many digits.
    half = len(x) // 2
    first, second = rotation_number(x[:half], y[:half]), rotation_number(x[half:], y[half:])
    assert first == pytest.approx(second, abs=2e-6)
    known = {"free": 1.0 - 1.0 / math.sqrt(2.0), "conservative": 0.78997027732, "remembering": None}
    if known[which]:
        assert min(abs(first - known[which]), abs(1 - first - known[which])) < 1e-8


def test_exponents_of_tori():
    for which in ("free", "conservative"):
        np.testing.assert_allclose(settled(which)["exponents"], 0.0, atol=3e-4)
    largest, second = settled("remembering")["exponents"].values
    assert abs(largest) < 1e-4
    assert second < -0.01


@pytest.mark.parametrize(
    ("omega", "which"), [(0.905, "chaos"), (0.92, "period 1"), (0.81, "period 5")]
)
def test_a_given_displacement_of_the_base_is_the_same_at_each_frequency(omega, which):
    """The published rig is shaken by a ω² sin ωτ: a base displacement of one size."""
    rig, plain = soft_impact(omega)
    moved = vi.Harmonic(0.7, omega / (2 * math.pi), of="displacement")
    one, other = (vi.simulate(vi.Rig(rig, shaken), 20, samples=8) for shaken in (plain, moved))
    np.testing.assert_allclose(one["displacement"], other["displacement"], atol=1e-10)
    known = settled(which)
    motion = vi.steady(vi.Rig(rig, moved), None, 4, window=4000, max_cycles=5000)
    assert motion["motion"].item() == known["motion"].item()
    assert int(motion["period"]) == int(known["period"])


def test_it_grazes_where_the_free_flight_reaches_the_stop():
    """a ω²/√((1 − ω²)² + (2ξω)²) = e along ω, at the displacement a of the base."""
    rig, _ = soft_impact(0.8)
    xi, a, e = 0.01, 0.7, 1.26
    # (e² − a²) ω⁴ + e² (4ξ² − 2) ω² + e² = 0
    squares = np.roots([e**2 - a**2, e**2 * (4 * xi**2 - 2), e**2])
    exact = float(np.sqrt(squares.min()))
    shaken = vi.Harmonic(a, 0.7 / (2 * math.pi), of="displacement")
    start = vi.simulate(vi.Rig(rig.without_bumpers(), shaken), 300, samples=0)["final_state"].values
    begin = vi.State(start[0], start[1], phase=start[4])
    data = vi.branch(
        vi.Rig(rig, shaken), begin, vary={"frequency": (0.6 / (2 * math.pi), 0.85 / (2 * math.pi))}
    )
    at = 2 * math.pi * data["bifurcation_value"].values
    grazing = at[data["bifurcation_kind"].values == "grazing"]
    assert np.abs(grazing - exact).min() < 1e-11


def test_growth_without_bound_is_judged_without_a_warning():
    """A wall that is met at no speed stretches disturbances without bound."""
    logarithms = growth(0.5, 1.0)
    logarithms[7] = np.inf, -np.inf
    assert judge(logarithms, WANDERING).motion == "undecided"


def spiral(cycles: int, multiplier: complex, scale: float = 1.0) -> np.ndarray:
    """Sections of a motion that comes to an orbit away from zero, or leaves it."""
    away = scale * multiplier ** np.arange(cycles)
    return np.column_stack([1.0 + away.real, away.imag, np.zeros((cycles, 3))])


def test_a_motion_that_grows_has_no_kind():
    growing = np.linspace(1.0, 4.0, 4000)[:, np.newaxis] * noise(4000, 2, seed=7)
    section = np.column_stack([growing, np.zeros((4000, 3))])
    verdict = judge(growth(0.0, 0.01, 4000), section)
    assert verdict.motion == "undecided"
    assert "the motion grows" in verdict.evidence


def test_settling_is_seen_until_nothing_is_left():
    turn = np.exp(0.7j)
    assert settling(spiral(1000, 0.998 * turn))
    assert not settling(spiral(1000, 0.998 * turn, 1e-9))  # what is left is rounding
    assert not settling(spiral(1000, turn))  # a torus
    assert not settling(noise(1000, 5, seed=8))  # chaos
    assert not settling(spiral(50, 0.9 * turn))  # too short to tell
