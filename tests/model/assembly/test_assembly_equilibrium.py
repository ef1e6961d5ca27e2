"""The state of rest under constant forces and preloads."""

from itertools import product

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import vibroimpact as vi
from samples import sample
from vibroimpact.errors import InputError
from vibroimpact.model import equilibrium

GROUND = "ground"


def rest(assembly):
    displacement = equilibrium(assembly).displacement
    return np.array([displacement.get(name, 0.0) for name in assembly.names])


def alone(oscillator):
    """Return an oscillator as an assembly of one mass."""
    stops = {}
    if oscillator.right is not None:
        stops["right"] = vi.Link("m", GROUND, oscillator.right)
    if oscillator.left is not None:
        stops["left"] = vi.Link(GROUND, "m", oscillator.left)
    links = {"isolator": vi.Link(GROUND, "m", oscillator.isolator)}
    return vi.Assembly({"m": oscillator.mass}, links, stops, {"m": oscillator.force})


LAWS = [
    vi.Isolator(100.0, 1.0),
    vi.FrictionIsolator(100.0, 1.0, 3.0),
    vi.BilinearIsolator(100.0, 10.0, 2.0, 0.5),
    vi.PolynomialIsolator(100.0, 1.0, 2000.0),
    vi.BoucWenIsolator(100.0, 10.0, 2.0, 0.5),
    vi.ExponentialIsolator(100.0, 20.0, 30.0, 0.5),
    vi.Law("k*u + s*tanh(u/a) + c*v", k=50.0, s=2.0, a=0.01, c=1.0),
]
STOPS = [
    None,
    vi.Bumper(400.0, 1.0, 0.02),
    vi.Bumper(400.0, 1.0, -0.01),
    vi.RigidStop(0.5, 0.015),
    vi.RigidStop(0.5, -0.01),
    vi.PowerBumper(5000.0, -0.02),
    vi.JankowskiBumper(5000.0, 0.01, 0.6, 2.0),
    vi.Law("k*d + q*d**2", k=300.0, q=1000.0, gap=0.01),
]
PAIRS = sample([*product(STOPS, STOPS)], [*product(STOPS, STOPS)][::5])
"""Of a right and a left stop; the small sample has each stop on each side, too."""


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
@pytest.mark.parametrize("force", sample([0.0, 1.0, 5.0, -9.0], [0.0, -9.0]))
def test_one_mass_rests_where_the_oscillator_does(law, force):
    tried = 0
    for right, left in PAIRS:
        try:
            one = vi.Oscillator(2.0, law, right, left, force)
        except InputError:
            continue
        expected = equilibrium(one)
        state = equilibrium(alone(one))
        tried += 1
        size = max(abs(expected.displacement), 1e-6)
        assert state.displacement.get("m", 0.0) == pytest.approx(
            expected.displacement, abs=1e-8 * size
        ), (right, left)
        memory = state.memory.get("isolator", 0.0)
        assert memory == pytest.approx(expected.isolator, rel=1e-7, abs=1e-12)
    assert tried >= 0.9 * len(PAIRS)


def test_two_masses_under_forces_by_hand():
    chain = vi.chain([1.0, 1.0], [100.0, 50.0], forces={"floor_2": 10.0})
    np.testing.assert_allclose(rest(chain), [0.1, 0.3], rtol=1e-14)


def test_a_bumper_between_masses_shares_the_force():
    # The second mass is pushed to the left onto a bumper of the first: 50 and 200 N/m in parallel.
    stops = {"pad": vi.Link("floor_1", "floor_2", vi.Bumper(200.0, 1.0, 0.0))}
    chain = vi.chain([1.0, 1.0], [100.0, 50.0], stops=stops, forces={"floor_2": -10.0})
    np.testing.assert_allclose(rest(chain), [-0.1, -0.1 - 10.0 / 250.0], rtol=1e-13)


def test_a_preload_between_masses_without_forces():
    stops = {"pad": vi.Link("floor_1", "floor_2", vi.Bumper(150.0, 1.0, -0.04))}
    chain = vi.chain([1.0, 1.0], [100.0, 50.0], stops=stops)
    # 50 s = 150 (0.04 − s), and nothing else pushes the first mass.
    np.testing.assert_allclose(rest(chain), [0.0, 0.03], atol=1e-15)


def test_rigid_stops_carry_the_force_to_the_wall():
    stops = {
        "between": vi.Link("floor_1", "floor_2", vi.RigidStop(0.5, 0.01)),
        "wall": vi.Link(GROUND, "floor_1", vi.RigidStop(0.5, 0.02)),
    }
    chain = vi.chain([1.0, 1.0], [100.0, 50.0], stops=stops, forces={"floor_2": -100.0})
    np.testing.assert_allclose(rest(chain), [-0.02, -0.03], rtol=1e-13)


def test_free_masses_are_pressed_in_a_row():
    masses = dict.fromkeys(("a", "b", "c"), 1.0)
    stops = {
        "ab": vi.Link("a", "b", vi.Bumper(100.0, 0.0, 0.05)),
        "bc": vi.Link("b", "c", vi.Bumper(200.0, 0.0, 0.05)),
        "wall": vi.Link("c", GROUND, vi.Bumper(400.0, 0.0, 0.1)),
    }
    positions = rest(vi.Assembly(masses, stops=stops, forces={"a": 2.0}))
    c = 0.1 + 2.0 / 400.0
    b = c + 0.05 + 2.0 / 200.0
    np.testing.assert_allclose(positions, [b + 0.05 + 2.0 / 100.0, b, c], rtol=1e-12)


def test_a_free_mass_without_a_force_stays():
    stops = {"wall": vi.Link("ball", GROUND, vi.Bumper(100.0, 0.0, 0.05))}
    spring = {"spring": vi.Link(GROUND, "host", vi.Isolator(10.0, 0.1))}
    assembly = vi.Assembly({"host": 1.0, "ball": 1.0}, spring, stops, {"host": 1.0})
    np.testing.assert_allclose(rest(assembly), [0.1, 0.0], atol=1e-15)


def test_masses_that_no_force_reaches_move_exactly_as_their_host():
    """The order of the masses would decide whether a stop without a gap is pressed by rounding."""
    rng = np.random.default_rng(5)
    masses = dict.fromkeys("abcdefg", 1.0)
    for _ in range(20):
        springs = [vi.Isolator(float(k), 0.1) for k in rng.uniform(0.3, 3.0, 6)]
        hysteretic = vi.BilinearIsolator(5.0, 0.4, 0.6, 0.01)
        links = {
            "a": vi.Link(GROUND, "a", springs[0]),
            "b": vi.Link("a", "b", springs[1]),
            "c": vi.Link("b", "c", springs[2]),
            "d": vi.Link("c", "d", hysteretic),
            "e": vi.Link("b", "d", springs[3]),
            "dashpot": vi.Link(GROUND, "d", vi.Isolator(0.0, 0.3)),
            "f": vi.Link(GROUND, "f", vi.PolynomialIsolator(1.0, 0.1, 0.3)),
            "g": vi.Link("f", "g", springs[4]),
        }
        stops = {
            "closed": vi.Link("b", "e", vi.Bumper(40.0, 0.1, 0.1)),
            "beside": vi.Link("c", "d", vi.PowerBumper(5.0, 0.0)),
            "apart": vi.Link("f", "g", vi.Bumper(3000.0, 0.1, 0.0)),
        }
        links["ball"] = vi.Link(GROUND, "e", springs[5])
        names = [str(one) for one in rng.permutation(list(masses))]
        assembly = vi.Assembly(dict.fromkeys(names, 1.0), links, stops, {"b": 2.0})
        u = equilibrium(assembly).displacement
        assert u["c"] == u["d"] == u["b"] > u["e"] + 0.1 > 0.1
        pressed = 40.0 * (u["b"] - u["e"] - 0.1)
        assert springs[5].stiffness * u["e"] == pytest.approx(pressed, rel=1e-9)
        assert "f" not in u
        assert "g" not in u


def test_bodies_that_press_a_rigid_stop_touch_exactly():
    """With full restitution, a clearance of 1e-20 m would be the height of endless impacts."""
    rng = np.random.default_rng(6)
    for _ in range(20):
        k = [float(one) for one in 10.0 ** rng.uniform(-0.5, 1.5, 5)]
        links = {
            "a": vi.Link(GROUND, "a", vi.Isolator(k[0], 0.1)),
            "b": vi.Link("a", "b", vi.Isolator(k[1], 0.1)),
            "c": vi.Link("b", "c", vi.Isolator(k[2], 0.1)),
            "d": vi.Link(GROUND, "d", vi.Isolator(k[3], 0.1)),
        }
        gap = float(rng.uniform(0.001, 0.01))
        stops = {
            "wall": vi.Link(GROUND, "c", vi.RigidStop(1.0, 0.0)),
            "far": vi.Link("a", "d", vi.RigidStop(1.0, gap)),
            "beside": vi.Link("d", "e", vi.RigidStop(1.0, 0.0)),
            "end": vi.Link("e", GROUND, vi.RigidStop(1.0, gap)),
        }
        links["e"] = vi.Link(GROUND, "e", vi.Isolator(k[4], 0.1))
        names = [str(one) for one in rng.permutation(list("abcde"))]
        masses = dict.fromkeys(names, 1.0)
        pushed = {"a": -1.0, "d": 900.0}
        u = equilibrium(vi.Assembly(masses, links, stops, pushed)).displacement
        assert u["a"] < u["b"] < 0.0
        assert "c" not in u
        assert u["d"] == u["e"] == gap


def test_two_friction_links_stick_and_slide():
    links = {
        "lower": vi.Link(GROUND, "p", vi.FrictionIsolator(100.0, 0.0, 3.0)),
        "upper": vi.Link("p", "q", vi.FrictionIsolator(50.0, 0.0, 1.0)),
    }

    def at(force):
        return rest(vi.Assembly({"p": 1.0, "q": 1.0}, links, forces={"q": force}))

    np.testing.assert_array_equal(at(0.9), [0.0, 0.0])
    np.testing.assert_allclose(at(2.0), [0.0, 1.0 / 50.0], atol=1e-15)
    np.testing.assert_allclose(at(-5.0), [-0.02, -0.02 - 4.0 / 50.0], rtol=1e-12)


@pytest.mark.parametrize("preload", [2.3e-16, 1e-14, 1e-3])
def test_a_preload_far_below_another_gap_is_balanced(preload):
    stops = {
        "far": vi.Link("floor_1", "floor_2", vi.Bumper(1.0, 0.0, 0.25)),
        "preloaded": vi.Link("floor_2", "floor_1", vi.Bumper(1.0, 0.0, -preload)),
    }
    built = vi.chain([1.0] * 3, [1.0] * 3, stops=stops)
    # The bumper and the storey beside it share the preload.
    np.testing.assert_allclose(
        rest(built), [0.0, *2 * [-0.5 * preload]], rtol=1e-3, atol=1e-9 * preload
    )


def test_curved_links_balance_by_their_static_forces():
    links = {
        "bearing": vi.Link(GROUND, "p", vi.BoucWenIsolator(100.0, 10.0, 2.0, 0.5)),
        "storey": vi.Link("p", "q", vi.PolynomialIsolator(50.0, 0.1, 4000.0)),
    }
    assembly = vi.Assembly({"p": 1.0, "q": 1.0}, links, forces={"q": 4.0})
    p, q = rest(assembly)
    assert links["bearing"].law.static_force(p) == pytest.approx(4.0, rel=1e-8)
    assert links["storey"].law.static_force(q - p) == pytest.approx(4.0, rel=1e-8)
    assert equilibrium(assembly).memory["bearing"] == pytest.approx(
        links["bearing"].law.remembered(p)
    )


@st.composite
def linear(draw):
    """Return a chain with bumpers and rigid stops, some of them preloaded, under forces."""
    count = draw(st.integers(1, 4))
    sizes = st.floats(1.0, 100.0)
    names = [f"floor_{i + 1}" for i in range(count)]
    stops = {}
    for i in range(draw(st.integers(1, 4))):
        left, right = draw(st.permutations([*names, GROUND]))[:2]
        gap = draw(st.floats(-0.1, 0.3))
        law = vi.Bumper(draw(sizes), 0.0, gap)
        if gap > 0.0 and draw(st.booleans()):
            law = vi.RigidStop(0.5, gap)
        stops[f"s{i}"] = vi.Link(left, right, law)
    forces = {name: draw(st.floats(-10.0, 10.0)) for name in names}
    return vi.chain([1.0] * count, [draw(sizes) for _ in names], stops=stops, forces=forces)


@settings(max_examples=150, deadline=None)
@given(linear())
@example(
    vi.chain(
        [1.0],
        [7.0],
        stops={"s0": vi.Link(GROUND, "floor_1", vi.RigidStop(0.5, 5e-324))},
        forces={"floor_1": -1.0},
    )
)
@example(
    # Stops around a loop cannot all be touched at once.
    vi.Assembly(
        {"a": 1.0, "b": 1.0, "c": 1.0, "d": 1.0, "e": 1.0},
        {
            "ga": vi.Link(GROUND, "a", vi.Isolator(1.63991, 0.0)),
            "gb": vi.Link(GROUND, "b", vi.Isolator(31.0152, 0.0)),
            "ac": vi.Link("a", "c", vi.Isolator(3.48336, 0.0)),
            "cd": vi.Link("c", "d", vi.Isolator(9.07116, 0.0)),
            "be": vi.Link("b", "e", vi.Isolator(0.53955, 0.0)),
        },
        {
            "dg": vi.Link("d", GROUND, vi.RigidStop(1.0, 0.8049)),
            "bd": vi.Link("b", "d", vi.Bumper(1.41236, 0.0, 0.0)),
            "ce": vi.Link("c", "e", vi.RigidStop(1.0, 0.066376)),
            "de": vi.Link("d", "e", vi.RigidStop(1.0, 0.455991)),
            "ge": vi.Link(GROUND, "e", vi.RigidStop(0.7, 0.0)),
        },
        {"a": -0.00918568},
    )
)
def test_linear_equilibria_agree_with_all_ways_to_press_the_stops(assembly):
    positions = rest(assembly)
    best = enumerated(assembly)
    np.testing.assert_allclose(positions, best, atol=1e-9 * max(np.abs(best).max(), 1e-2))


def enumerated(assembly):
    """Return the displacements of the one set of pressed stops that agrees with its signs."""
    k, f = assembly.stiffness_matrix, assembly.constant_force
    stops = list(assembly.stops.values())
    least, best = np.inf, None
    for pressed in product((False, True), repeat=len(stops)):
        held = [stop for stop, yes in zip(stops, pressed, strict=True) if yes]
        w = np.array([assembly.closing(stop) for stop in held]).reshape(-1, len(f))
        gaps = np.array([stop.law.gap for stop in held])
        soft = [
            1.0 / stop.law.stiffness if isinstance(stop.law, vi.Bumper) else 0.0 for stop in held
        ]
        matrix = np.block([[k, w.T], [w, -np.diag(soft)]])
        solved, *_ = np.linalg.lstsq(matrix, np.concatenate([f, gaps]), rcond=None)
        u, forces = solved[: len(f)], solved[len(f) :]
        depth = [assembly.closing(stop) @ u - stop.law.gap for stop in stops]
        open_ones = [one for one, yes in zip(depth, pressed, strict=True) if not yes]
        left = np.abs(matrix @ solved - np.concatenate([f, gaps])).max()
        off = max([left, 0.0, *open_ones, *(-forces / 100.0)])
        if off < least:
            least, best = off, u
    assert least < 1e-9
    return best


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: vi.Assembly(
                {"a": 1.0, "b": 1.0},
                {"k": vi.Link("a", "b", vi.Isolator(1.0, 0.0))},
                forces={"b": "5 N"},
            ),
            r"^forces\.b: 5 N; no link and no stop holds a and b against this force",
        ),
        (
            lambda: vi.Assembly(
                {"a": 1.0},
                stops={"left": vi.Link(GROUND, "a", vi.Bumper(1.0, 0.0, 0.1))},
                forces={"a": 5.0},
            ),
            r"^forces\.a: 5 N; no link and no stop holds a against this force",
        ),
        (
            lambda: vi.Assembly(
                {"a": 1.0},
                {"slider": vi.Link(GROUND, "a", vi.FrictionIsolator(0.0, 0.0, 2.0))},
                forces={"a": 2.5},
            ),
            r"^forces\.a: 2\.5 N; no link and no stop holds a",
        ),
        (
            lambda: vi.Assembly(
                {"a": 1.0},
                {"soft": vi.Link(GROUND, "a", vi.PolynomialIsolator(100.0, 0.0, -100.0))},
                forces={"a": 100.0},
            ),
            r"^forces\.a: 100 N; no link and no stop holds a",
        ),
        (
            lambda: vi.Assembly(
                {"a": 1.0},
                {"soft": vi.Link(GROUND, "a", vi.PolynomialIsolator(100.0, 0.0, -100.0))},
                {"pad": vi.Link("a", GROUND, vi.Bumper(500.0, 0.0, -1.0))},
            ),
            r"^links\.soft: it softens, and its largest force, 38\.49 N",
        ),
    ],
)
def test_no_equilibrium_is_one_line(make, message):
    with pytest.raises(InputError, match=message) as caught:
        make()
    assert "\n" not in str(caught.value)


def test_friction_holds_up_to_its_force():
    slider = {"slider": vi.Link(GROUND, "a", vi.FrictionIsolator(0.0, 0.0, 2.0))}
    np.testing.assert_array_equal(rest(vi.Assembly({"a": 1.0}, slider, forces={"a": 1.9})), [0.0])
