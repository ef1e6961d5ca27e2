"""Assemblies with curved links and stops: the flow of one mass, closed forms and other solvers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import vibroimpact as vi
from reference.stored_by_assembly import stored
from vibroimpact.response import assembly_rig

pytestmark = pytest.mark.filterwarnings("ignore:.*encountered:RuntimeWarning")
"""Without the compiler; terms that leave the range of numbers are found so."""

LINEAR = vi.Isolator(100.0, 1.0)
BOUC_WEN = vi.BoucWenIsolator(
    elastic_stiffness=400.0, post_yield_stiffness=60.0, yield_force=3.0, damping=0.5
)
SHARP = vi.BoucWenIsolator(
    elastic_stiffness=400.0, post_yield_stiffness=60.0, yield_force=3.0, damping=0.5, exponent=2
)
BILINEAR = vi.BilinearIsolator(
    elastic_stiffness=400.0, post_yield_stiffness=60.0, yield_force=2.0, damping=0.5
)
FRICTION = vi.FrictionIsolator(stiffness=100.0, friction=0.5, damping=0.3)
HUNT = vi.PowerBumper(2e5, 0.01, dissipation=0.5)
RESTITUTION = vi.PowerBumper(2e5, 0.012, restitution=0.5)
BUMPER = vi.Bumper(1e4, 10.0, 0.01)
WALL = vi.RigidStop(0.6, 0.012)
SHAKEN = vi.Harmonic(2.0, 1.6)
STILL = vi.Harmonic(1e-200, 1.6)

LAWS: dict[str, tuple[Any, Any, Any]] = {
    "cubic": (vi.PolynomialIsolator(stiffness=100.0, damping=1.0, cubic=4e4), BUMPER, WALL),
    "hertz": (LINEAR, vi.PowerBumper(2e5, 0.01), None),
    "hunt-crossley": (LINEAR, HUNT, RESTITUTION),
    "jankowski": (LINEAR, vi.JankowskiBumper(2e5, 0.01, 0.6, 1.0), None),
    "bouc-wen": (BOUC_WEN, BUMPER, None),
    "sharp": (SHARP, vi.PowerBumper(2e5, 0.01), WALL),
    "bilinear": (BILINEAR, BUMPER, WALL),
    "friction": (FRICTION, BUMPER, WALL),
    "square": (vi.Isolator(100.0, 3.0, damping_exponent=2.0), BUMPER, None),
    "power": (vi.Isolator(100.0, 3.0, damping_exponent=1.5), BUMPER, None),
    "formula": (
        vi.Law("k*u + q*sinh(b*u) + c*v*abs(v)", k="100 N/m", q=1.0, b=30.0, c=1.0),
        vi.Law("max(k*d*(1+chi*v), 0)", gap=0.01, k=1e4, chi=0.5),
        None,
    ),
    "tanh": (
        vi.Law("k*u + q*tanh(b*v) + r*u*abs(u)", k="100 N/m", q=1.0, b=3.0, r=500.0),
        BUMPER,
        None,
    ),
}


def follow(
    masses: dict[str, float],
    links: dict[str, Any],
    stops: dict[str, Any],
    shaking: Any = SHAKEN,
    cycles: float = 3,
    start: Any = None,
    **rest: Any,
) -> Any:
    parts = {
        part: {name: vi.Link(*one) for name, one in table.items()}
        for part, table in (("links", links), ("stops", stops))
    }
    rig = vi.Rig(vi.Assembly(masses=masses, **parts, **rest), shaking)
    return vi.simulate(rig, cycles, start=start, samples=32)


def apart(one: Any, other: Any) -> float:
    """The largest difference, as a share of the largest value."""
    one, other = np.asarray(one).ravel(), np.asarray(other).ravel()
    return float(np.abs(one - other).max() / np.abs(other).max())


@pytest.mark.parametrize("name", LAWS)
def test_one_mass_moves_as_an_oscillator(name: str) -> None:
    isolator, right, left = LAWS[name]
    oscillator = vi.Oscillator(1.0, isolator, right=right, left=left)
    expected = vi.simulate(vi.Rig(oscillator, SHAKEN), 10, samples=32)
    stops = {"r": ("m", "ground", right)} | ({"l": ("ground", "m", left)} if left else {})
    motion = follow({"m": 1.0}, {"i": ("ground", "m", isolator)}, stops, cycles=10)
    assert apart(motion.displacement, expected.displacement) < 1e-12
    assert apart(motion.velocity, expected.velocity) < 1e-11  # in a steep contact
    assert len(motion.event) == len(expected.event) > 0
    assert motion.event_time.values * 1.6 == pytest.approx(
        expected.event_time.values * 1.6, rel=0.0, abs=1e-13
    )
    assert (motion.event_contact.values == expected.event_contact.values).all()


@pytest.mark.parametrize(
    ("formula", "k", "c"),
    [
        ("k*d**2 + c*d*v", 1e6, 5e3),
        ("k*d**3 + c*d*v", 1e8, 5e3),
        ("k*d**3 + c*d**2*v", 1e8, 1e6),
        ("k*d**4 + c*d**3*v", 2.9e9, 7e5),
        ("k*d**2 + c*d*v*abs(v)", 1e6, 4e3),
    ],
)
def test_a_formula_without_stiffness_at_first_touch_moves_as_an_oscillator(
    formula: str, k: float, c: float
) -> None:
    """It ceases to push while it is pressed, at another root than that where it is left."""
    law = vi.Law(f"max({formula}, 0)", gap=0.01, k=k, c=c)
    expected = vi.simulate(vi.Rig(vi.Oscillator(1.0, LINEAR, right=law), SHAKEN), 10, samples=32)
    motion = follow(
        {"m": 1.0}, {"i": ("ground", "m", LINEAR)}, {"r": ("m", "ground", law)}, cycles=10
    )
    assert motion.attrs["message"] == "done"
    assert apart(motion.displacement, expected.displacement) < 1e-12
    assert apart(motion.velocity, expected.velocity) < 1e-11
    assert (motion.event_contact.values == expected.event_contact.values).all()
    assert len(motion.event) >= 20


@pytest.mark.parametrize(
    ("isolator", "stop"),
    [(BOUC_WEN, HUNT), (BILINEAR, BUMPER), (FRICTION, vi.RigidStop(0.6, 0.01))],
)
def test_two_copies_side_by_side_move_as_one(isolator: Any, stop: Any) -> None:
    storey = vi.Isolator(900.0, 1.0)
    one = follow(
        {"a": 1.0, "c": 0.7},
        {"i": ("ground", "a", isolator), "j": ("a", "c", storey)},
        {"s": ("a", "ground", stop)},
    )
    two = follow(
        {"a": 1.0, "b": 1.0, "c": 0.7, "d": 0.7},
        {
            "i1": ("ground", "a", isolator),
            "i2": ("ground", "b", isolator),
            "j1": ("a", "c", storey),
            "j2": ("b", "d", storey),
        },
        {"s1": ("a", "ground", stop), "s2": ("b", "ground", stop)},
    )
    assert len(two.event) == 2 * len(one.event) > 0
    for copy, original in (("a", "a"), ("b", "a"), ("c", "c"), ("d", "c")):
        u = two.displacement.sel(mass=copy)
        assert apart(u, one.displacement.sel(mass=original)) < 1e-13


@pytest.mark.parametrize(
    ("law", "stop"),
    [
        (None, HUNT),
        (None, vi.JankowskiBumper(2e5, 0.01, 0.6)),
        (BOUC_WEN, RESTITUTION),
        (BILINEAR, vi.RigidStop(0.5, 0.01)),
        (FRICTION, BUMPER),
    ],
)
def test_two_bodies_of_one_frequency_are_one_of_the_meeting_mass(law: Any, stop: Any) -> None:
    m1, m2 = 1.0, 2.5
    meets = m1 * m2 / (m1 + m2)

    def held(mass: float) -> vi.Isolator:
        return vi.Isolator(100.0 * mass, 0.5 * mass)

    between = {"x": ("b", "a", law)} if law else {}
    both = follow(
        {"a": m1, "b": m2},
        {"g1": ("ground", "a", held(m1)), "g2": ("ground", "b", held(m2)), **between},
        {"s": ("a", "b", stop)},
        start=vi.State(displacement={"a": -0.02, "b": 0.03}, velocity={"a": 0.5}),
    )
    across = {"x": ("ground", "r", law)} if law else {}
    alone = follow(
        {"r": meets},
        {"g": ("ground", "r", held(meets)), **across},
        {"s": ("r", "ground", stop)},
        STILL,
        start=vi.State(displacement={"r": -0.05}, velocity={"r": 0.5}),
    )
    closing = both.displacement.sel(mass="a") - both.displacement.sel(mass="b")
    assert apart(closing, alone.displacement) < 1e-12
    assert len(both.event) == len(alone.event) > 0


@pytest.mark.parametrize(
    ("exponent", "speeds"),
    [(1.5, [-0.0709524, 0.0764030, 0.9945493]), (1.0, [-0.1302617, 0.1502296, 0.9800321])],
)
def test_three_touching_masses(exponent: float, speeds: list[float]) -> None:
    law = vi.PowerBumper(1e7, 0.0, exponent=exponent)
    motion = follow(
        {"a": 1.0, "b": 1.0, "c": 1.0},
        {},
        {"ab": ("a", "b", law), "bc": ("b", "c", law)},
        vi.Harmonic(1e-300, 1.0),
        1,
        start=vi.State(velocity={"a": 1.0}),
    )
    assert motion.velocity[:, -1].values == pytest.approx(speeds, abs=6e-8)
    assert float(motion.velocity[:, -1].sum()) == pytest.approx(1.0, rel=1e-13)
    assert float((motion.velocity[:, -1] ** 2).sum()) == pytest.approx(1.0, rel=1e-12)


def test_smooth_links_between_masses_against_another_solver() -> None:
    cubic = vi.PolynomialIsolator(stiffness=300.0, damping=0.4, cubic=2e5)
    sinh = vi.Law("k*u + q*sinh(b*u) + c*v", k="50 N/m", q=2.0, b=20.0, c=0.3)
    motion = follow(
        {"a": 1.0, "b": 0.6},
        {"g": ("ground", "a", sinh), "x": ("a", "b", cubic)},
        {},
        vi.Harmonic(6.0, 1.6),
        5,
    )
    omega = 2.0 * np.pi * 1.6

    def rate(t: float, y: Any) -> Any:
        a, b, va, vb = y
        s, w = b - a, vb - va
        link = 300.0 * s + 2e5 * s**3 + 0.4 * w
        base = 50.0 * a + 2.0 * np.sinh(20.0 * a) + 0.3 * va
        shaking = 6.0 * np.sin(omega * t)
        return [va, vb, link - base - shaking, -link / 0.6 - shaking]

    times = motion.time.values
    solution = solve_ivp(
        rate, (0.0, times[-1]), np.zeros(4), "DOP853", times, rtol=3e-14, atol=1e-16
    )
    assert apart(motion.displacement, solution.y[:2]) < 3e-12


def test_links_stuck_at_once_and_the_most_overloaded_slides_first() -> None:
    """A stack of two: the base holds 3 N, what stands on it 1 N. Each stays while it can."""
    low, high, weak = (
        vi.FrictionIsolator(stiffness=0.0, friction=one, damping=0.0) for one in (3.0, 1.0, 1.5)
    )
    links = {"low": ("ground", "a", low), "high": ("a", "b", high)}
    masses = {"a": 1.0, "b": 0.5}
    # Together 1.5 kg: held at the ground below 2 m/s², b on a below 2 m/s²: nothing moves.
    still = follow(masses, links, {}, vi.Harmonic(1.9, 1.0), 2)
    assert not still.displacement.values.any()
    # Of a weaker base all goes together, at the friction of the base alone.
    links["low"] = ("ground", "a", weak)
    moved = follow(masses, links, {}, vi.Harmonic(1.4, 1.0), 2)
    assert (moved.displacement[0] == moved.displacement[1]).all()
    assert np.abs(moved.displacement).max() > 1e-3
    # One mass of 1.5 kg on the same friction.
    alone = follow({"m": 1.5}, {"low": ("ground", "m", weak)}, {}, vi.Harmonic(1.4, 1.0), 2)
    assert apart(moved.displacement[0], alone.displacement) < 1e-12
    # A spring pulls b with 4 N, which friction does not hold, and a with 3 N, which it does.
    links["low"] = ("ground", "a", vi.FrictionIsolator(stiffness=0.0, friction=3.5, damping=0.0))
    links["high"] = ("a", "b", vi.FrictionIsolator(stiffness=4.0, friction=1.0, damping=0.0))
    start = vi.State(displacement={"b": 1.0})
    slides = follow(masses, links, {}, vi.Harmonic(1e-300, 1.0), 1, start=start)
    assert not slides.displacement[0].values.any()
    time = slides.time.values
    expected = 0.25 + 0.75 * np.cos(np.sqrt(8.0) * time)
    assert slides.displacement[1].values == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize(
    "beside",
    [
        vi.BilinearIsolator(8.345, 0.03627, 2.4186, 0.11965),
        vi.BoucWenIsolator(8.345, 0.03627, 2.4186, 0.11965),
        vi.Isolator(1.0, 0.2, damping_exponent=2.0),
        vi.Law("k*u + c*v*abs(v)", k="1 N/m", c=0.2),
    ],
)
@pytest.mark.parametrize("friction", [0.1, 0.788])
def test_the_order_of_links_beside_each_other(beside: Any, friction: float) -> None:
    """Both turn at the same instant, of which one is the first; friction holds both, or neither."""
    links = {
        "base": ("ground", "a", vi.Isolator(6.0, 0.5)),
        "friction": ("a", "b", vi.FrictionIsolator(1.0, 0.01, friction)),
        "beside": ("b", "a", beside),
    }
    shaken, masses = vi.Harmonic(1.96, 0.0477, 2.419), {"a": 1.5, "b": 1.75}
    one, other = (
        follow(masses, {name: links[name] for name in names}, {}, shaken, cycles=2)
        for names in (list(links), list(links)[::-1])
    )
    assert apart(one.displacement, other.displacement) < 1e-12
    assert apart(one.velocity, other.velocity) < 1e-12


def test_a_motion_goes_on_from_any_place() -> None:
    masses, links = (
        {"a": 1.0, "b": 0.6},
        {"g": ("ground", "a", BOUC_WEN), "x": ("a", "b", FRICTION)},
    )
    stops = {"s": ("a", "b", RESTITUTION), "w": ("a", "ground", HUNT)}
    whole = follow(masses, links, stops, cycles=3)
    for share in (1.0, 1.37, 2.2):
        first = follow(masses, links, stops, cycles=share)
        rest = follow(masses, links, stops, cycles=3 - share, start=first)
        assert apart(rest.displacement[:, -1], whole.displacement[:, -1]) < 1e-12
        assert apart(rest.velocity[:, -1], whole.velocity[:, -1]) < 1e-12


def test_more_parts_than_a_mode_has_bits_for_are_refused() -> None:
    links = {f"x{i}": vi.Link("ground", "a", FRICTION) for i in range(18)}
    rig = vi.Rig(vi.Assembly(masses={"a": 1.0}, links=links), SHAKEN)
    with pytest.raises(vi.InputError, match="18 curved parts of links need 54 bits") as error:
        vi.simulate(rig, 1)
    assert "\n" not in str(error.value)


def test_more_parts_than_a_state_has_room_for_are_refused(monkeypatch: Any) -> None:
    """The engine's room of 1,024 numbers is made smaller: so many masses take long to build."""
    linked = vi.Assembly(
        {"a": 1.0, "b": 1.0},
        {"x": vi.Link("ground", "a", LAWS["cubic"][0]), "y": vi.Link("ground", "b", LINEAR)},
        {"z": vi.Link("a", "b", BUMPER)},
    )
    record = vi.Record([0.0, 1.0, 0.0], 0.01)
    problem = (
        r"masses: a state of 2 masses, 1 stops and 1 curved .* 6 numbers .* at most 5 are possible"
    )
    monkeypatch.setattr(assembly_rig, "MOST_PARTS", 6)
    vi.simulate(vi.Rig(linked, record), samples=1)
    monkeypatch.setattr(assembly_rig, "MOST_PARTS", 5)
    with pytest.raises(vi.InputError, match=problem):
        vi.simulate(vi.Rig(linked, record), samples=1)
    with pytest.raises(vi.InputError, match=problem):
        vi.demands(linked, record)


@pytest.mark.parametrize("name", ["hunt-crossley", "bouc-wen", "friction"])
def test_sweeps_of_one_mass_are_those_of_an_oscillator(name: str) -> None:
    isolator, right, left = LAWS[name]
    oscillator = vi.Oscillator(1.0, isolator, right=right, left=left)
    stops = {"right": vi.Link("m", "ground", right)}
    if left:
        stops["left"] = vi.Link("ground", "m", left)
    links = {"i": vi.Link("ground", "m", isolator)}
    assembly = vi.Assembly(masses={"m": 1.0}, links=links, stops=stops)
    frequencies = [1.5, 1.9, 2.3]
    expected, several = (
        vi.sweep(vi.Rig(one, SHAKEN), frequencies) for one in (oscillator, assembly)
    )
    for variable in ("peak_displacement", "peak_acceleration"):
        values = several[variable].sel(mass="m").values
        assert values == pytest.approx(expected[variable].values, rel=1e-9)
    assert several.peak_transmitted_force.values == pytest.approx(
        expected.peak_transmitted_force.values, rel=1e-9
    )
    assert (several.period.values == expected.period.values).all()
    assert several.impacts.values.max() > 0


@pytest.mark.parametrize(("isolator", "stop"), [(BOUC_WEN, WALL), (BILINEAR, BUMPER)])
def test_orbits_of_one_mass_are_those_of_an_oscillator(isolator: Any, stop: Any) -> None:
    oscillator = vi.Oscillator(1.0, isolator, right=stop)
    assembly = vi.Assembly(
        masses={"m": 1.0},
        links={"i": vi.Link("ground", "m", isolator)},
        stops={"right": vi.Link("m", "ground", stop)},
    )
    expected, several = (vi.orbit(vi.Rig(one, SHAKEN)) for one in (oscillator, assembly))
    assert float(several.effective_damping) == pytest.approx(
        float(expected.effective_damping), rel=1e-10
    )
    assert several.displacement.values.ravel() == pytest.approx(
        expected.displacement.values.ravel(), rel=0.0, abs=1e-11
    )


@pytest.mark.parametrize("exponent", [0.5, 0.8])
def test_a_drag_is_nothing_while_friction_holds(exponent: float) -> None:
    """A power of the velocity below 1 is steep there, and must not shorten the steps."""
    law = vi.FrictionIsolator(100.0, 0.5, 0.5, damping_exponent=exponent)
    one = vi.Assembly({"m": 1.0}, {"i": vi.Link("ground", "m", law)})
    rigs = (vi.Rig(system, vi.Harmonic(2.0, 1.6)) for system in (vi.Oscillator(1.0, law), one))
    expected, several = (vi.simulate(rig, 4, samples=0) for rig in rigs)
    assert several.attrs["message"] == "done"
    ends = [data["final_state"].values[:2] for data in (expected, several)]
    assert ends[1] == pytest.approx(ends[0], abs=1e-10)


@pytest.mark.parametrize("cycles", [3.3, 3.62])
@pytest.mark.parametrize("name", LAWS)
def test_energies_of_one_mass_are_those_of_an_oscillator(name: str, cycles: float) -> None:
    """Also of a motion that ends in a contact, whose stop still holds energy."""
    isolator, right, left = LAWS[name]
    sides = {"right": right, "left": left}
    stops = {
        side: vi.Link(*(("a", "ground") if side == "right" else ("ground", "a")), stop)
        for side, stop in sides.items()
        if stop is not None
    }
    one = vi.Oscillator(1.0, isolator, **sides)
    several = vi.Assembly({"a": 1.0}, {"x": vi.Link("ground", "a", isolator)}, stops)
    motions = [vi.simulate(vi.Rig(system, SHAKEN), cycles) for system in (one, several)]
    expected, actual = (vi.totals(motion) for motion in motions)
    size = float(expected["total_isolator"] + expected["total_bumpers"])
    for mine, theirs in (("links", "isolator"), ("stops", "bumpers"), ("supplied", "supplied")):
        lost = float(actual[f"total_{mine}"].sum())
        assert lost == pytest.approx(float(expected[f"total_{theirs}"]), abs=1e-10 * size)
    state = [stored(several, motions[1][f"{when}_state"]) for when in ("initial", "final")]
    assert float(actual["total_stored"]) == pytest.approx(state[1] - state[0], abs=1e-10 * size)


def test_a_stop_that_is_pressed_at_the_end_has_lost_nothing() -> None:
    """What an elastic contact holds comes back; the balance is closed with it."""
    struck = vi.Assembly(
        {"a": 1.0, "b": 2.0},
        {"x": vi.Link("ground", "a", LINEAR), "y": vi.Link("ground", "b", LINEAR)},
        {"z": vi.Link("a", "b", vi.PowerBumper(2e5, 0.0))},
    )
    rig = vi.Rig(struck, STILL)
    start = vi.State(velocity={"a": 1.0})
    whole = vi.simulate(rig, 0.2, start)
    end = float(whole["event_time"][1])
    motion = vi.simulate(rig, 1.6 * 0.6 * end, start, 512)
    assert motion["final_state"].sel(component="touching.z") == 1.0
    totals = vi.totals(motion)
    assert abs(float(totals["total_stops"].item())) < 1e-13
    spent = totals["total_links"].sum() + totals["total_stops"].sum() + totals["total_stored"]
    assert float(spent) == pytest.approx(0.0, abs=1e-13)
    # It goes on from there: what was stored is given back, none of it a second time.
    rest = vi.totals(vi.simulate(rig, 1.0, motion, 64))
    assert abs(float(rest["total_stops"].item())) < 1e-13


def test_losses_of_two_yielding_links_are_known_as_a_sum_only() -> None:
    linked = vi.Assembly(
        {"a": 1.0, "b": 2.0},
        {
            "x": vi.Link("ground", "a", BOUC_WEN),
            "y": vi.Link("a", "b", FRICTION),
            "z": vi.Link("ground", "b", LAWS["cubic"][0]),
        },
    )
    motion = vi.simulate(vi.Rig(linked, SHAKEN), 3)
    totals = vi.totals(motion)
    assert np.isnan(totals["total_links"]).values.tolist() == [True, True, False]
    assert "total_links of x, y is NaN" in totals.attrs["notes"]
    rest = totals["total_supplied"] - totals["total_links"].sel(link="z") - totals["total_stored"]
    assert float(rest) > 0.0


@pytest.mark.parametrize("exponent", [3.0, 5.0, 8.0])
def test_samples_of_long_steps_near_the_limit_of_a_stiff_memory(exponent: float) -> None:
    # z is at its limit, to which it returns 500 times as fast as the mass moves: in another unit
    # of time, the rounding of its series grew to 10⁶ within a step that is certified in its own.
    law = vi.BoucWenIsolator(
        *(1.02071, 0.370691, 0.0124304, 0.005), exponent=exponent, beta=0.35374, gamma=0.0774663
    )
    rig = vi.Assembly({"a": 1.80505}, {"link": vi.Link("ground", "a", law)})
    for amplitude in np.linspace(0.1, 0.6, 9):
        shaken = vi.Harmonic(amplitude, 0.0965529, 5.57661)
        motion = vi.simulate(vi.Rig(rig, shaken), 3, samples=800)
        u, v, t = (motion[name].values for name in ("displacement", "velocity", "time"))
        moved = np.diff(t) * 0.5 * (v[:, 1:] + v[:, :-1])
        assert np.abs(np.diff(u) - moved).max() < 1e-4 * np.abs(v).max() * t[1]


@pytest.mark.parametrize(
    "isolator", [vi.Isolator(100.0, 1.0), vi.BoucWenIsolator(300.0, 60.0, 3.0, 0.8)]
)
def test_a_pressed_stop_moves_a_mass_at_rest(isolator: Any) -> None:
    """Where the shaking begins at 0, nothing else has a size from which a step has its length."""
    stop, shaking = vi.PowerBumper(2e4, -0.001, 1.5), vi.Harmonic(5.0, 2.0)
    system = vi.Assembly(
        {"m": 1.0},
        {"isolator": vi.Link("ground", "m", isolator)},
        {"face": vi.Link("m", "ground", stop)},
    )
    several = vi.simulate(vi.Rig(system, shaking), 4, vi.State(displacement={"m": 0.0}), samples=0)
    one = vi.simulate(
        vi.Rig(vi.Oscillator(1.0, isolator, stop), shaking), 4, vi.State(0.0, 0.0), samples=0
    )
    np.testing.assert_allclose(several["final_state"][:2], one["final_state"][:2], rtol=1e-9)
