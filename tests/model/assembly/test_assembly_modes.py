"""Matrices, natural frequencies and modes against formulas."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from vibroimpact.errors import InputError

GROUND = "ground"


def row(masses, stiffnesses, **others):
    """Return a chain without damping."""
    return vi.chain(masses, stiffnesses, 0.0, **others)


def test_two_masses_have_the_frequencies_of_the_quadratic():
    m1, m2, k1, k2 = 3.0, 2.0, 50.0, 20.0
    # m1 m2 λ² − (m1 k2 + m2 (k1 + k2)) λ + k1 k2 = 0
    squares = np.sort(np.roots([m1 * m2, -(m1 * k2 + m2 * (k1 + k2)), k1 * k2]))
    frequencies = row([m1, m2], [k1, k2]).natural_frequencies
    np.testing.assert_allclose(frequencies, np.sqrt(squares) / math.tau, rtol=1e-13)


@pytest.mark.parametrize("count", [1, 2, 5, 30])
def test_a_chain_of_equal_masses_has_the_frequencies_of_a_free_end(count):
    k, m = 200e6, 250e3
    j = np.arange(1, count + 1)
    expected = 2.0 * math.sqrt(k / m) * np.sin((2 * j - 1) * math.pi / (2 * (2 * count + 1)))
    chain = row([m] * count, [k] * count)
    np.testing.assert_allclose(math.tau * chain.natural_frequencies, expected, rtol=1e-11)
    # φ_ji = sin((2j−1) i π/(2n+1)), and the frequencies of the rows belong to them.
    shapes = np.sin(np.outer(2 * j - 1, j) * math.pi / (2 * count + 1))
    largest = np.take_along_axis(shapes, np.abs(shapes).argmax(1)[:, np.newaxis], 1)
    np.testing.assert_allclose(np.abs(chain.mode_shapes), np.abs(shapes / largest), atol=1e-9)


def test_a_chain_between_two_walls_has_the_frequencies_of_fixed_ends():
    count, k, m = 6, 7.0, 2.0
    names = [f"m{i}" for i in range(count)]
    bodies = [GROUND, *names, GROUND]
    links = {
        f"k{i}": vi.Link(bodies[i], bodies[i + 1], vi.Isolator(k, 0.0)) for i in range(count + 1)
    }
    assembly = vi.Assembly(dict.fromkeys(names, m), links)
    j = np.arange(1, count + 1)
    expected = 2.0 * math.sqrt(k / m) * np.sin(j * math.pi / (2 * (count + 1)))
    np.testing.assert_allclose(math.tau * assembly.natural_frequencies, expected, rtol=1e-12)


def test_one_mass_is_the_oscillator():
    isolator = vi.Isolator("26.8 kN/m", "1.1 kN s/m")
    bumper = vi.Bumper("510 kN/m", "0.9 kN s/m", "7.5 mm")
    one = vi.Oscillator("550 kg", isolator, bumper)
    same = vi.Assembly(
        {"mass": "550 kg"},
        {"isolator": vi.Link(GROUND, "mass", isolator)},
        {"right": vi.Link("mass", GROUND, bumper)},
    )
    assert same.natural_frequencies == pytest.approx([one.natural_frequency], rel=1e-15)
    assert same.damping_ratios == pytest.approx([one.damping_ratio], rel=1e-15)
    assert same.angular_frequency == pytest.approx(one.angular_frequency, rel=1e-15)
    assert same.linear == one.linear


@pytest.mark.parametrize("ratio", [0.05, [0.01, 0.02, 0.1, 0.0]])
def test_modal_damping_gives_its_ratios(ratio):
    chain = vi.chain([3.0, 2.0, 2.0, 1.0], [50.0, 40.0, 30.0, 10.0], ratio)
    np.testing.assert_allclose(chain.damping_ratios, np.broadcast_to(ratio, 4), atol=1e-14)
    assert chain.is_classically_damped
    # The complex eigenvalues λ of the state matrix have |λ| = ω and −Re λ/|λ| = ζ.
    values = np.linalg.eigvals(state_matrix(chain))
    values = values[values.imag > 0.0]
    order = np.argsort(np.abs(values))
    np.testing.assert_allclose(np.abs(values)[order], math.tau * chain.natural_frequencies)
    ratios = -values.real[order] / np.abs(values)[order]
    np.testing.assert_allclose(ratios, np.broadcast_to(ratio, 4), atol=1e-12)


def state_matrix(assembly):
    m, n = assembly.mass_matrix, len(assembly.names)
    rates = -np.linalg.solve(m, np.hstack([assembly.stiffness_matrix, assembly.damping_matrix]))
    return np.vstack([np.hstack([np.zeros((n, n)), np.eye(n)]), rates])


def test_rayleigh_damping_gives_the_ratio_at_two_modes():
    chain = vi.chain([2.0] * 4, [30.0] * 4, 0.03, "rayleigh", rayleigh_modes=(1, 3))
    assert chain.damping_ratios[[0, 2]] == pytest.approx(0.03, rel=1e-12)
    assert chain.damping_ratios[1] < 0.03 < chain.damping_ratios[3]
    alpha, beta = chain.damping.mass_factor, chain.damping.stiffness_factor
    omega = math.tau * chain.natural_frequencies
    np.testing.assert_allclose(chain.damping_ratios, 0.5 * (alpha / omega + beta * omega))
    one = vi.chain([2.0], [30.0], 0.03, "rayleigh")
    assert one.damping_ratios == pytest.approx([0.03])


def test_dashpots_of_links_add_to_modal_damping():
    links = {"a": vi.Link(GROUND, "m", vi.Isolator(4.0, 0.4))}
    assembly = vi.Assembly({"m": 1.0}, links, damping=vi.ModalDamping(0.05))
    assert assembly.damping_ratios == pytest.approx([0.1 + 0.05])


def test_damping_that_couples_modes_is_reported():
    links = {
        "a": vi.Link(GROUND, "p", vi.Isolator(4.0, 0.4)),
        "b": vi.Link("p", "q", vi.Isolator(2.0, 0.0)),
    }
    coupled = vi.Assembly({"p": 1.0, "q": 1.0}, links)
    assert not coupled.is_classically_damped
    assert "do not decouple" in vi.modes(coupled).attrs["notes"]
    assert "notes" not in vi.modes(vi.chain([1.0, 1.0], [2.0, 2.0])).attrs


def test_a_free_mass_has_the_frequency_zero():
    wall = {"wall": vi.Link("ball", "host", vi.RigidStop(0.8, 1.0))}
    assembly = vi.Assembly(
        {"host": 1.0, "ball": 0.05},
        {"spring": vi.Link(GROUND, "host", vi.Isolator(1.0, 0.1))},
        wall,
    )
    assert assembly.natural_frequencies == pytest.approx([0.0, 1.0 / math.tau], rel=1e-14)
    assert np.isnan(assembly.damping_ratios[0])
    assert assembly.angular_frequency == pytest.approx(1.0)


def test_curved_links_have_their_initial_stiffness():
    law = vi.BilinearIsolator(100.0, 10.0, 5.0, 0.0)
    assembly = vi.Assembly({"m": 4.0}, {"bearing": vi.Link(GROUND, "m", law)})
    assert math.tau * assembly.natural_frequencies == pytest.approx([5.0])
    assert "initial stiffness" in vi.modes(assembly).attrs["notes"]


def test_the_effective_masses_sum_to_the_mass():
    modes = vi.modes(vi.chain([3.0, 2.0, 1.5], [50.0, 40.0, 30.0]))
    assert float(modes["effective_mass"].sum()) == pytest.approx(6.5)
    # The base moves all masses by 1: Σ Γ_j φ_j = ι.
    sum_of_modes = (modes["participation_factor"] * modes["mode_shape"]).sum("mode")
    np.testing.assert_allclose(sum_of_modes, 1.0)


def test_modes_of_a_dataset_are_described():
    modes = vi.modes(vi.Rig(vi.chain(["250 t"] * 2, ["200 MN/m"] * 2), "0.05 g"))
    assert modes["natural_frequency"].attrs["units"] == "Hz"
    assert list(modes["mass"].values) == ["floor_1", "floor_2"]
    assert list(modes["mode"].values) == [1, 2]
    with pytest.raises(InputError, match=r"^rig: an Oscillator has one mass; pass an Assembly"):
        vi.modes(vi.Oscillator(1.0, vi.Isolator(2.0, 0.1)))


SIZES = st.floats(0.1, 10.0)


@st.composite
def assemblies(draw):
    """Return masses and links from a random tree, which all hang on the ground."""
    count = draw(st.integers(2, 6))
    names = [f"m{i}" for i in range(count)]
    masses = {name: draw(SIZES) for name in names}
    links = {}
    for i, name in enumerate(names):
        other = draw(st.sampled_from([GROUND, *names[:i]]))
        ends = draw(st.permutations([name, other]))
        links[f"l{i}"] = vi.Link(*ends, vi.Isolator(draw(SIZES), draw(st.floats(0.0, 1.0))))
    return masses, links, draw(st.permutations(names))


@settings(max_examples=60, deadline=None)
@given(assemblies())
def test_the_order_of_the_masses_permutes_the_modes(parts):
    masses, links, order = parts
    first = vi.Assembly(masses, links)
    second = vi.Assembly({name: masses[name] for name in order}, links)
    place = [first.names.index(name) for name in second.names]
    assert second.names == tuple(order)
    np.testing.assert_allclose(second.natural_frequencies, first.natural_frequencies, rtol=1e-9)
    for what in ("mass_matrix", "stiffness_matrix", "damping_matrix"):
        expected = getattr(first, what)[np.ix_(place, place)]
        np.testing.assert_array_equal(getattr(second, what), expected)
    gaps = np.diff(first.natural_frequencies) / first.natural_frequencies[-1]
    if gaps.min() > 1e-3:  # the modes of equal frequencies are not unique
        alike = np.abs(second.mode_shapes) - np.abs(first.mode_shapes[:, place])
        assert np.abs(alike).max() < 1e-6


@settings(max_examples=40, deadline=None)
@given(assemblies())
def test_a_reversed_linear_link_is_the_same_link(parts):
    masses, links, _ = parts
    turned = {name: vi.Link(one.right, one.left, one.law) for name, one in links.items()}
    first, second = vi.Assembly(masses, links), vi.Assembly(masses, turned)
    np.testing.assert_array_equal(first.stiffness_matrix, second.stiffness_matrix)
    np.testing.assert_array_equal(first.damping_matrix, second.damping_matrix)
