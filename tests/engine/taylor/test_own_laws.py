"""A law given as a formula against the same law built in, a closed form, and differences."""

from __future__ import annotations

import ast

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import vibroimpact as vi
from engine.taylor.rigs import followed
from engine.taylor.test_carry import carried
from samples import sample
from vibroimpact.engine.batch import trajectory
from vibroimpact.engine.flow_dispatch import carries
from vibroimpact.engine.motion import STATE, U, V
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.engine.parameters import OWN, rig_vector
from vibroimpact.engine.series.program import unpack
from vibroimpact.engine.state import MODE
from vibroimpact.law_numbers import SYMBOLS, IsolatorNumbers, OwnStop, PowerLaw, Program, pack

SHAKEN = vi.Harmonic(0.6, 0.17, 0.4)


def program(*operations: str | int, numbers: tuple[float, ...] = ()) -> list[float]:
    codes = [one if isinstance(one, int) else SYMBOLS.index(one) for one in operations]
    return pack(Program(tuple(codes), numbers), 0.0)


def end_of(rig: np.ndarray, cycles: int = 20) -> np.ndarray:
    state = np.zeros(STATE)
    state[U] = 0.2
    *_, outcome = trajectory(
        rig, 0.8, 0.2, 0.3, state, 0.0, cycles, 0, 3000,
        np.empty((0, record_layout.SAMPLE)), np.empty((3001, record_layout.EVENT)),
    )  # fmt: skip
    assert outcome == 0
    return state[[U, V]]


def test_an_emitted_formula_is_the_built_in_law() -> None:
    """The cubic spring, the drag of the velocity's square and two stops, each in both ways."""
    cubic = program("number", 0, "x", "power", 3, "*", numbers=(0.7,))
    drag = program("number", 0, "v", "*", "|v|", "*", numbers=(0.05,))
    deep = tuple(program("number", 0, "x", "power", 2, "*", numbers=(30.0,)))
    square = PowerLaw(30.0, 2.0, 0.0, 0.0, 0.4)
    for built_in, own in (
        (rig_vector(1.0, 1.0, 0.02, None, None, law=IsolatorNumbers(cubic=0.7)),
         rig_vector(1.0, 1.0, 0.02, None, None, law=IsolatorNumbers(own=cubic))),
        (rig_vector(2.0, 1.0, 0.05, None, None, law=IsolatorNumbers(drag=2.0)),
         rig_vector(2.0, 1.0, 0.0, None, None, law=IsolatorNumbers(own=drag))),
        (rig_vector(1.0, 1.0, 0.05, square, square, law=IsolatorNumbers(cubic=0.3)),
         rig_vector(
             1.0, 1.0, 0.05, OwnStop(deep, 0.4), OwnStop(deep, 0.4), law=IsolatorNumbers(cubic=0.3)
         )),
    ):  # fmt: skip
        np.testing.assert_allclose(end_of(own), end_of(built_in), atol=2e-12)


@pytest.mark.parametrize("gap", sample([0.3, 0.0, -0.05], [-0.05]))
def test_a_formula_is_as_exact_as_the_built_in_law_in_a_contact_of_a_power(gap: float) -> None:
    """Both are followed in the same root of the deformation."""
    stop = vi.PowerBumper(40.0, gap, dissipation=0.3)
    ends = []
    for isolator in (
        vi.Law("k*u*(1 + q*u**2) + c*v", k=1.0, q=0.5, c=0.1),
        vi.Law("k*u*(1 + q*abs(u)*abs(u)) + c*v", k=1.0, q=0.5, c=0.1),
        vi.PolynomialIsolator(1.0, 0.1, 0.5),
    ):
        rig = vi.Rig(vi.Oscillator(1.0, isolator, stop, stop.replace(gap=0.3)), SHAKEN)
        data = vi.simulate(rig, 2, start=vi.State(gap - 0.1, 0.9))
        assert data["event_time"].size >= 4
        ends.append(data["final_state"].values[:2])
    np.testing.assert_allclose(ends[0], ends[2], atol=3e-14, rtol=0.0)
    np.testing.assert_allclose(ends[1], ends[2], atol=3e-12 if gap < 0.0 else 3e-14, rtol=0.0)


@pytest.mark.full
def test_a_narrow_bend_in_a_contact_of_a_power() -> None:
    """In a root of the deformation, too, no step passes it: against steps in time."""
    law = vi.Law("k*u + c*v*exp(-(v/b)**2)", k=1.0, c=2.0, b=5e-3)
    ends = []
    for exponent in (1.5, 1.5 + 1e-13):  # of which only the first has a root
        stop = vi.PowerBumper(40.0, 0.3, exponent)
        data = vi.simulate(vi.Rig(vi.Oscillator(1.0, law, stop, stop), SHAKEN), 2,
                           start=vi.State(0.1, 0.9))  # fmt: skip
        ends.append(data["final_state"].values[:2])
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-11, rtol=0.0)


def test_a_program_is_packed_and_unpacked() -> None:
    rng = np.random.default_rng(1)
    for count in (1, 9, 10, 11, 49, 50):
        symbols = (*rng.integers(1, 5, count - 1).tolist(), 7)
        rig = rig_vector(
            3.0,
            1.0,
            0.0,
            None,
            None,
            law=IsolatorNumbers(own=pack(Program(symbols, (1.5, 2.5)), 6.0)),
        )
        assert unpack(rig, 0) == symbols
        assert unpack(rig, 1) == ()
        other = rig.copy()
        other[OWN] += 1.0
        assert carries(rig, rig.copy())
        assert not carries(rig, other)


FORMULAS = {
    "softening": ("k*u/(1 + abs(u)/a)", lambda u, v: u / (1.0 + abs(u) / 0.5)),
    "turning": ("f*sin(u/b) + k*u", lambda u, v: 2.0 * np.sin(4.0 * u) + u),
    "bounded": ("f*tanh(u/b) + c*v", lambda u, v: 2.0 * np.tanh(4.0 * u) + v / 16.0),
    "root": ("k*u*sqrt(1 + (u/a)**2)", lambda u, v: u * np.sqrt(1.0 + 4.0 * u * u)),
    "broken power": ("k*u*(1 + (u/a)**2)**-0.3", lambda u, v: u * (1.0 + 4.0 * u * u) ** -0.3),
    "drag": ("k*u + c*v/(1 + (v/k)**2)", lambda u, v: u + v / 16.0 / (1.0 + v * v)),
    "exponential": ("k*u*exp(-(u/a)**2) + c*v*cosh(u/k)", lambda u, v: u * np.exp(-4.0 * u * u)
                    + v / 16.0 * np.cosh(u)),
}  # fmt: skip
NUMBERS = {"q": 1.0, "k": 1.0, "a": 0.5, "b": 0.25, "f": 2.0, "c": 0.0625}


@pytest.mark.parametrize("name", sample([*FORMULAS], [*FORMULAS][::3]))
def test_a_motion_agrees_with_a_general_integrator(name: str) -> None:
    """DOP853, begun anew where u passes 0."""
    formula, force = FORMULAS[name]
    names = {node.id for node in ast.walk(ast.parse(formula)) if isinstance(node, ast.Name)}
    law = vi.Law(formula, **{one: NUMBERS[one] for one in NUMBERS if one in names})
    data = vi.simulate(vi.Rig(vi.Oscillator(1.0, law), SHAKEN), 1, start=vi.State(0.3, 0.2))
    omega, phase = SHAKEN.angular_frequency, SHAKEN.phase

    def rates(t, y):
        u, v = y
        return [v, -force(u, v) - SHAKEN.amplitude * np.sin(omega * t + phase)]

    t, y, side = 0.0, np.array([0.3, 0.2]), 1.0
    while t < SHAKEN.period:

        def passes(t, y):
            return y[0]

        passes.terminal, passes.direction = True, -side
        solution = solve_ivp(
            rates, (t, SHAKEN.period), y, "DOP853", events=passes, rtol=1e-13, atol=1e-15,
            max_step=0.1,
        )  # fmt: skip
        t, y, side = solution.t[-1], solution.y[:, -1].copy(), -side
    np.testing.assert_allclose(data["final_state"].values[:2], y, atol=3e-12)


CARRIED = {
    "softening": (vi.Law("k*u/(1 + abs(u)/a) + c*v", k=1.0, a=0.5, c=0.1), None),
    "bounded between formulas": (
        vi.Law("f*tanh(u/b) + c*v", f=0.5, b=0.3, c=0.1),
        vi.Law("k*d + k3*d**3 + c*v", gap=0.3, k=20.0, k3=300.0, c=0.4),
    ),
    "linear between formulas": (
        vi.Isolator(1.0, 0.1), vi.Law("k*d**2*(1 + chi*v) + k*d", gap=0.3, k=30.0, chi=0.4)
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CARRIED)
def test_derivative_agrees_with_central_differences(name: str) -> None:
    isolator, stop = CARRIED[name]
    rig = vi.Oscillator(1.0, isolator, stop, stop)
    start = np.zeros(STATE)
    start[U], start[V] = 0.1, 0.9
    rows, _, end = carried(rig, start, 1, SHAKEN)
    for at, row in ((U, 0), (V, 1)):
        differences = []
        for size in (1e-5, 5e-6):
            ends = []
            for step in (size, -size):
                moved = start.copy()
                moved[at] += step
                ends.append(followed(rig, SHAKEN, 1, moved))
                assert ends[-1][MODE] == end[MODE]
            differences.append((ends[0] - ends[1])[[U, V]] / (2.0 * size))
        difference = (4.0 * differences[1] - differences[0]) / 3.0
        assert np.abs(difference - rows[row][:2]).max() < 1e-6 * max(np.abs(rows[row]).max(), 1.0)


def test_a_stop_by_a_formula_keeps_the_energy_of_its_spring() -> None:
    """Undamped: pressed by a constant acceleration and back, u̇²/2 + ∫F − g δ."""
    stop = vi.Law("f*(exp(d/a) - 1)", gap=0.1, f=2.0, a=0.05)
    rig = vi.Oscillator(1.0, vi.Isolator(0.0, 0.0), stop, vi.RigidStop(1.0, 10.0))
    motion = vi.simulate(vi.Rig(rig, vi.Record([-1.0] * 4, 0.5)), samples=60, start=vi.State())
    u, v = motion["displacement"].values, motion["velocity"].values
    depth = np.maximum(u - 0.1, 0.0)
    held = 2.0 * (0.05 * np.expm1(depth / 0.05) - depth)
    np.testing.assert_allclose(0.5 * v**2 + held - u, 0.0, atol=2e-14)
    assert depth.max() > 0.02


@pytest.mark.parametrize(
    ("formula", "numbers", "force"),
    [
        (
            "k*u + f*tanh(u/a)",
            {"k": 1.0, "f": 0.5, "a": 1e-3},
            lambda u: u + 0.5 * np.tanh(1e3 * u),
        ),
        (
            "k*u + q*u*exp(-(u/a)**2)",
            {"k": 1.0, "q": 400.0, "a": 5e-3},
            lambda u: u + 400.0 * u * np.exp(-((u / 5e-3) ** 2)),
        ),
        (
            "k*u + q*u*(1 + (u/a)**2)**-20",
            {"k": 1.0, "q": 400.0, "a": 5e-2},
            lambda u: u + 400.0 * u * (1.0 + (u / 5e-2) ** 2) ** -20.0,
        ),
    ],
)
def test_no_step_passes_a_narrow_bend(formula: str, numbers: dict[str, float], force) -> None:
    """Of motions a thousand times as large: flat on both sides, so that no coefficient shows it."""
    rig = vi.Oscillator(1.0, vi.Law(formula, **numbers))
    start = vi.State(1.0, 0.0)
    shaken = vi.Harmonic(1e-3, 0.3)
    data = vi.simulate(vi.Rig(rig, shaken), 1, start=start)

    def rates(t, y):
        return [y[1], -force(y[0]) - 1e-3 * np.sin(shaken.angular_frequency * t)]

    known = solve_ivp(
        rates, (0.0, shaken.period), (1.0, 0.0), "DOP853", rtol=1e-13, atol=1e-15, max_step=1e-3
    )
    np.testing.assert_allclose(data["final_state"].values[:2], known.y[:, -1], atol=1e-10)
