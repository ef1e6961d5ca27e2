"""Motions that are known in closed form, or by another way of computing them."""

from __future__ import annotations

import math

import numpy as np
import pytest

import vibroimpact as vi
from engine.assembly.following import follow_sections, sections
from engine.assembly.systems import System, joined, neighbours, record, row, shaken, storeys
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.plan import GROUND, Forcing, Stop, base_motion
from vibroimpact.engine.event import REST_ENDS


def still(n: int) -> Forcing:
    return Forcing(np.zeros((n, 2)))


def run(system: System, state, lines, tables=True, **kwargs):
    plan = system.plan(tables)
    count = follow_sections(plan, system.amplitude, system.omega, state, lines, **kwargs)
    assert count >= 0
    assert plan[at.UNDECIDED] == 0
    return count, plan


def free_row(n: int, e: float, gap: float = 0.1, mass=None) -> System:
    mass = np.eye(n) if mass is None else np.diag(mass)
    stops = [Stop(i, i + 1, gap, restitution=e) for i in range(n - 1)]
    return System(mass, np.zeros((n, n)), np.zeros((n, n)), stops, still(n))


@pytest.mark.parametrize("e", [0.3, 0.7, 1.0])
def test_first_arrivals_in_a_row_of_free_masses(e: float) -> None:
    n = 6
    system = free_row(n, e)
    log = np.zeros((500, 4))
    state = system.state(v=[1.0] + [0.0] * (n - 1))
    # Watched until the last has just been hit.
    speed = [((1 + e) / 2) ** i for i in range(n)]
    time = sum(0.1 / v for v in speed[: n - 1])
    run(system, state, np.array([[0.0, 1.0, time * (1 + 1e-9)]]), log=log)
    assert state[2 + 2 * n - 1] == pytest.approx(speed[-1], rel=1e-14)
    arrivals = [log[log[:, 2] == f][0, 1] for f in range(n - 1)]
    assert arrivals == pytest.approx(np.cumsum([0.1 / v for v in speed[: n - 1]]), rel=1e-13)


def test_equal_masses_that_only_exchange_their_velocities() -> None:
    """Without loss they pass through each other like ghosts."""
    n, gap = 6, 0.1
    rng = np.random.default_rng(3)
    system = free_row(n, 1.0, gap)
    u = rng.uniform(-0.02, 0.02, n)
    v = np.sort(rng.normal(size=n))[::-1].copy()
    state = system.state(u, v)
    count, _ = run(system, state, np.array([[0.0, 1.0, 4.0]]))
    assert count == n * (n - 1) // 2
    places = np.sort(u + gap * np.arange(n) + 4.0 * v)
    assert state[2 : 2 + n] + gap * np.arange(n) == pytest.approx(places, abs=1e-13)
    assert state[2 + n : 2 + 2 * n] == pytest.approx(np.sort(v), rel=1e-14)


@pytest.mark.parametrize("tables", [True, False])
def test_momentum_and_energy_over_many_impacts(tables: bool) -> None:
    n = 3
    mass = [1.0, 1.7, 0.6]
    c, k = joined(n, [(0, 1, 40.0, 0.0), (1, 2, 60.0, 0.0)])
    system = free_row(n, 1.0, 0.01, mass)._replace(damping=c, stiffness=k)
    u, v = np.array([0.004, 0.0, -0.003]), np.array([0.9, -0.4, 0.3])
    v -= np.dot(mass, v) / sum(mass)  # what flies away loses the digits of its deformations
    state = system.state(u, v)
    count, _ = run(system, state, sections(0.0, 1.0, 2000), tables)
    assert count > 10_000
    u1, v1 = state[2:5], state[5:8]
    # Of the momenta at the start: those of the instant at the end may be small by chance.
    assert abs(np.dot(mass, v1)) <= 1e-12 * np.dot(mass, abs(v))
    energy = [0.5 * np.dot(mass, b**2) + 0.5 * a @ k @ a for a, b in ((u, v), (u1, v1))]
    assert energy[1] == pytest.approx(energy[0], rel=1e-12)


def test_superposed_modes() -> None:
    system = storeys()._replace(stops=[], amplitude=1.7)
    n, cycles = system.n, 12
    a = np.zeros((2 * n, 2 * n))
    a[:n, n:] = np.eye(n)
    a[n:, :n], a[n:, n:] = -system.stiffness, -system.damping
    values, vectors = np.linalg.eig(a)
    push = np.zeros(2 * n)
    push[n:] = -system.amplitude
    # A sin θ is the imaginary part of A exp(iθ), θ = ωt + 0.3.
    steady = np.linalg.solve(1j * system.omega * np.eye(2 * n) - a, push)
    start = np.concatenate([[0.01, -0.02, 0.0, 0.03], [0.1, 0.0, 0.2, -0.1]])
    free = np.linalg.solve(vectors, start - (steady * np.exp(0.3j)).imag)
    t = cycles * system.period
    end = (vectors @ (free * np.exp(values * t))).real
    end += (steady * np.exp(1j * (0.3 + system.omega * t))).imag
    for tables in (True, False):
        state = system.state(start[:n], start[n:])
        run(system, state, sections(0.3, system.period, cycles), tables)
        assert abs(state[2 : 2 + 2 * n] - end).max() <= 1e-12 * abs(end).max()


def test_a_ball_in_a_shaken_cavity() -> None:
    """Walls at ±b of a cavity that moves as A sin t: the symmetric orbit in closed form."""
    e, b, amplitude = 0.6, 1.0, 0.4
    s = (1 - e) / (1 + e)
    sigma = 2 * s / math.pi
    # (y − b)² + σ²y² = A², the larger root.
    p, q = 1 + sigma**2, b
    y = (q + math.sqrt(q * q - p * (b * b - amplitude**2))) / p
    speed = 2 * y / math.pi
    phase = math.atan2((y - b) / amplitude, -sigma * y / amplitude)
    assert (y, speed, phase) == pytest.approx((1.33855, 0.85215, 2.13246), abs=1e-5)
    stops = [Stop(0, GROUND, b, restitution=e), Stop(GROUND, 0, b, restitution=e)]
    none = np.zeros((1, 1))
    # The cavity's acceleration is −A sin t.
    system = System(np.eye(1), none, none, stops, base_motion(-np.eye(1), np.ones(1)), amplitude)
    # The section lies half a second after an impact, when the ball has gone on with −V.
    later = phase + 0.5
    ball = y - 0.5 * speed
    orbit = (ball - amplitude * math.sin(later), -speed - amplitude * math.cos(later))
    for off, cycles, tolerance in ((0.0, 20, 1e-12), (1e-3, 300, 1e-10)):
        state = system.state([orbit[0]], [orbit[1] * (1 - off)])
        count, _ = run(system, state, sections(later, 2 * math.pi, cycles))
        assert count == 2 * cycles
        assert state[2:4] == pytest.approx(orbit, abs=tolerance)


def test_an_impact_damper() -> None:
    """The symmetric orbit of two impacts a cycle, to the digits that are known."""
    e, zeta, ratio, clearance = 0.75, 0.01, 0.05, 30.0
    speed, phase, x, v = 14.78340654, 2.97163566, 8.22172069, -1.47834065
    mass = np.diag([1.0, ratio])
    c, k = joined(2, [(0, GROUND, 1.0, 2 * zeta)])
    half = clearance / 2
    stops = [Stop(1, 0, half, restitution=e), Stop(0, 1, half, restitution=e)]
    system = System(mass, c, k, stops, Forcing(np.array([[1.0, 0.0], [0.0, 0.0]])), 1.0)
    # The phase is that of the host's motion without the ball, which is a quarter turn late.
    phase += math.pi / 2
    after = [x, x + half, v, -speed]
    state = system.state([x + 0.05, x + half], [v, -speed])
    log = np.zeros((10_000, 4))
    count, _ = run(system, state, sections(phase, 2 * math.pi, 1500), log=log)
    right = log[:count][log[:count, 2] == 0][-1]
    assert right[1] % (2 * math.pi) == pytest.approx(0.0, abs=2e-8) or right[1] == pytest.approx(
        2 * math.pi, abs=2e-8
    )
    # Just after an impact, of the stable orbit to which it has come.
    run(system, state, np.array([[math.sin(phase), math.cos(phase), 1e-9]]))
    # The phase is known to 1e-8, in which the ball goes 1.5e-7.
    assert state[2:4] == pytest.approx(after[:2], abs=2e-7)
    assert state[4:6] == pytest.approx(after[2:], abs=2e-7)


@pytest.mark.parametrize("tables", [True, False])
@pytest.mark.parametrize("e", [None, 0.55])
def test_a_pair_moves_as_one_mass_of_their_reduced_mass(e: float | None, tables: bool) -> None:
    """Two bodies of equal ω and ζ: u₁ − u₂ obeys the equation of one mass, rest included."""
    m = np.array([1.3, 0.8])
    reduced = m[0] * m[1] / m.sum()
    w, zeta, gap = 7.0, 0.02, 0.015
    law = {"stiffness": 1e4, "damping": 12.0} if e is None else {"restitution": e}
    # A constant and a slow periodic force press them together, which lets go of them again.
    constant = np.array([3.0, -2.0])
    weights = np.array([[0.0, 0.0], [0.0, 8.0]])
    pair = System(
        np.diag(m),
        np.diag(2 * zeta * w * m),
        np.diag(w * w * m),
        [Stop(0, 1, gap, **law)],
        Forcing(weights),
        1.0,
        1.3,
        constant,
    )
    scale = reduced / m
    one = System(
        np.diag([reduced]),
        np.diag([2 * zeta * w * reduced]),
        np.diag([w * w * reduced]),
        [Stop(0, GROUND, gap, **law)],
        Forcing(scale[0] * weights[:1] - scale[1] * weights[1:]),
        1.0,
        1.3,
        np.array([scale[0] * constant[0] - scale[1] * constant[1]]),
    )
    u, v = [0.004, -0.003], [0.5, -0.2]
    two, single = pair.state(u, v), one.state([u[0] - u[1]], [v[0] - v[1]])
    lines = sections(0.2, one.period, 6)
    logs = np.zeros((2, 2000, 4))
    counts = [
        run(pair, two, lines, tables, log=logs[0])[0],
        run(one, single, lines, tables, log=logs[1])[0],
    ]
    assert counts[0] == counts[1] >= 6
    if e is not None:
        assert REST_ENDS in logs[1, :, 3]
    relative = [two[2] - two[3], two[4] - two[5]]
    assert relative == pytest.approx(single[2:4], abs=1e-11)


def test_a_ball_that_bounces_until_it_rests() -> None:
    e, height, g = 0.8, 0.3, 9.81
    none = np.zeros((1, 1))
    system = System(
        np.eye(1),
        none,
        none,
        [Stop(GROUND, 0, 0.0, restitution=e)],
        still(1),
        1.0,
        1.0,
        np.array([-g]),
    )
    fall = math.sqrt(2 * height / g)
    state, log = system.state([height]), np.zeros((500, 4))
    count, _ = run(system, state, np.array([[0.0, 1.0, 20.0]]), log=log)
    assert int(state[0]) == 1
    assert abs(state[2]) <= 1e-13
    assert state[3] == 0.0
    ends = fall + 2 * fall * e / (1 - e)
    # The series is completed: its rest of the last returns lasts for less than 1e-6 s here.
    assert log[count - 1, 1] == pytest.approx(ends, abs=2e-6)
    assert log[:3, 1] == pytest.approx([fall, fall * (1 + 2 * e), fall * (1 + 2 * e + 2 * e * e)])


def test_masses_that_touch_are_hit_in_the_order_of_names() -> None:
    system = free_row(3, 1.0)
    stops = [system.stops[0], system.stops[1]._replace(gap=0.0)]
    system = system._replace(stops=stops)
    state = system.state(v=[1.0, 0.0, 0.0])
    count, plan = run(system, state, np.array([[0.0, 1.0, 1.0]]))
    assert count == 2
    assert list(state[5:8]) == [0.0, 0.0, 1.0]
    assert plan[at.ORDERED] == 1.0


def test_impacts_at_the_same_instant_that_share_no_mass_need_no_rule() -> None:
    system = free_row(4, 0.5)
    system = system._replace(stops=[system.stops[0], system.stops[2]])
    state = system.state(v=[1.0, 0.0, 1.0, 0.0])
    count, plan = run(system, state, np.array([[0.0, 1.0, 0.3]]))
    assert count == 2
    assert plan[at.ORDERED] == 0.0
    assert list(state[6:8]) == list(state[8:10])


@pytest.mark.parametrize("tables", [True, False])
def test_restarted_anywhere_it_is_the_same(tables: bool) -> None:
    for system, lines in (
        (row(), None),
        (row(0.8), None),
        (neighbours(), None),
        (shaken(), record(300)),
    ):
        if lines is None:
            angles = 0.3 + 2 * math.pi * np.arange(9 * 40) / 9
            length = system.period / 9
            lines = np.column_stack([np.sin(angles), np.cos(angles), np.full(len(angles), length)])
        whole = system.state()
        run(system, whole, lines, tables)
        plan, again, modes = system.plan(tables), system.state(), set()
        for line in lines:
            plan = system.plan(tables)
            follow_sections(plan, system.amplitude, system.omega, again, line[None])
            modes.add(int(again[0]))
        assert (whole == again).all()
        assert len(modes) > 1 or system.stops[0].restitution is not None


def test_the_order_of_the_masses_does_not_matter() -> None:
    system = row(0.8)
    order = [2, 0, 1]
    place = {old: new for new, old in enumerate(order)} | {GROUND: GROUND}
    turned = system._replace(
        mass=system.mass[np.ix_(order, order)],
        damping=system.damping[np.ix_(order, order)],
        stiffness=system.stiffness[np.ix_(order, order)],
        stops=[s._replace(left=place[s.left], right=place[s.right]) for s in system.stops],
        forcing=Forcing(system.forcing.weights[order], shaken=True),
        constant=system.constant[order],
    )
    states = system.state(), turned.state()
    counts = [
        run(one, state, sections(0.3, one.period, 10))[0]
        for one, state in zip((system, turned), states, strict=True)
    ]
    assert counts[0] == counts[1] > 20
    assert states[1][2:5] == pytest.approx(states[0][2:5][order], abs=1e-12)


def test_bodies_that_touch_for_ever_without_a_force_end() -> None:
    system = free_row(2, 0.5, 0.0)
    state = system.state(v=[1.0, 1.0])
    count, _ = run(system, state, np.array([[0.0, 1.0, 10.0]]))
    assert count == 0
    assert list(state[2:4]) == [10.0, 10.0]


@pytest.mark.parametrize("kind", ["bumpers", "rigid", "rest"])
def test_one_mass_as_by_its_own_flow(kind: str) -> None:
    mass, k, c, frequency, cycles = 550.0, 26_290.0, 1_140.0, 1.3, 20
    right = vi.Bumper(6.8e5, 980.0, 0.012)
    left = vi.Bumper(5.1e5, 0.0, 0.010)
    stops = [Stop(0, GROUND, 0.012, 6.8e5, 980.0), Stop(GROUND, 0, 0.010, 5.1e5)]
    if kind != "bumpers":
        e = 0.7 if kind == "rigid" else 0.3
        right, left = vi.RigidStop(e, 0.012), vi.RigidStop(e, 0.010)
        stops = [Stop(0, GROUND, 0.012, restitution=e), Stop(GROUND, 0, 0.010, restitution=e)]
    if kind == "rest":
        frequency = 0.4
    isolator = vi.Isolator(k, c)
    amplitude = 1.1
    rig = vi.Rig(vi.Oscillator(mass, isolator, right, left), vi.Harmonic(amplitude, frequency))
    end = vi.simulate(rig, cycles, samples=1)
    matrix = np.array([[mass]])
    system = System(
        matrix,
        np.array([[c]]),
        np.array([[k]]),
        stops,
        base_motion(matrix, np.ones(1)),
        amplitude,
        2 * math.pi * frequency,
    )
    for tables in (True, False):
        log = np.zeros((5000, 4))
        state = system.state()
        count, _ = run(system, state, sections(0.0, system.period, cycles), tables, log=log)
        if kind == "rest":
            assert REST_ENDS in log[:count, 3]
        scale = abs(end["velocity"].values).max()
        assert state[2] == pytest.approx(float(end["displacement"][-1]), abs=1e-13)
        assert state[3] == pytest.approx(float(end["velocity"][-1]), abs=1e-12 * scale)


@pytest.mark.parametrize("consistent", [False, True])
def test_a_bar_that_hits_a_wall(consistent: bool) -> None:
    """Siconos's example: in contact until the wave is back, with the force S v √(E ρ)."""
    modulus, area, density, n, speed = 210e9, 3.14e-4, 7800.0, 60, 0.1
    part = 1.0 / n
    k, mass = np.zeros((n + 1, n + 1)), np.zeros((n + 1, n + 1))
    element = np.array([[2, 1], [1, 2]]) / 6 if consistent else np.eye(2) / 2
    for i in range(n):
        k[i : i + 2, i : i + 2] += modulus * area / part * np.array([[1, -1], [-1, 1]])
        mass[i : i + 2, i : i + 2] += density * area * part * element
    stop = [Stop(GROUND, 0, 5e-5, restitution=0.0)]
    system = System(mass, np.zeros_like(k), k, stop, still(n + 1), 0.0)
    state, log = system.state(v=np.full(n + 1, -speed)), np.zeros((1000, 4))
    count, _ = run(system, state, np.array([[0.0, 1.0, 0.0015]]), log=log)
    wave = math.sqrt(modulus / density)
    first, last = log[0, 1], log[count - 1, 1]
    assert first == pytest.approx(5e-5 / speed, rel=1e-10)
    assert last - first == pytest.approx(2 / wave, rel=0.03)
    impulse = float((mass @ (state[2 + n + 1 : 2 + 2 * (n + 1)] + speed)).sum())
    force = impulse / (2 / wave)
    assert force == pytest.approx(area * speed * math.sqrt(modulus * density), rel=0.02)
