"""A stop that remembers: as a kind, and as a light pad on links, against its equations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import vibroimpact as vi
from cycle_derivative import both_derivatives
from vibroimpact.model import AssemblyState, equilibrium
from vibroimpact.response.assembly_state import as_assembly_state, assembly_vector

K, C, GAP = 100.0, 1.0, 0.02
DRIVE = vi.Harmonic(3.0, 2.0)
CYCLES = 6
STIFF, RELAXING, DASHPOT = 1500.0, 800.0, 40.0
"""A standard linear solid: a spring beside a spring and a dashpot in series."""


def padded(mass: float, links: dict, pads: dict) -> float:
    """Displacement after some cycles with a light pad of this mass behind a rigid stop."""
    system = vi.Assembly(
        masses={"body": 1.0, **pads},
        links={"spring": vi.Link("ground", "body", vi.Isolator(K, C)), **links},
        stops={"face": vi.Link("body", "pad", vi.RigidStop(0.0, GAP))},
    )
    motion = vi.simulate(vi.Rig(system, DRIVE), CYCLES)
    return float(motion["displacement"].sel(mass="body")[-1])


def with_bumper(mass: float) -> float:
    return padded(
        mass, {"rubber": vi.Link("ground", "pad", vi.Isolator(2000.0, 5.0))}, {"pad": mass}
    )


def with_solid(mass: float) -> float:
    links = {
        "spring_of_pad": vi.Link("ground", "pad", vi.Isolator(STIFF, 0.0)),
        "series": vi.Link("inner", "pad", vi.Isolator(RELAXING, 0.0)),
        "dashpot": vi.Link("ground", "inner", vi.Isolator(0.0, DASHPOT)),
    }
    return padded(mass, links, {"pad": mass, "inner": mass})


def solid_without_mass(cycles: float = CYCLES) -> np.ndarray:
    """u, u̇, the dashpot's end y and what the dashpot has lost, by DOP853 from event to event."""
    amplitude, omega = DRIVE.amplitude, 2.0 * np.pi * DRIVE.frequency

    def push(u: float, y: float) -> float:
        return STIFF * (u - GAP) + RELAXING * (u - GAP - y)

    def clearance(t, state, touching):
        u, _, y, _ = state
        return GAP + RELAXING * y / (STIFF + RELAXING) - u

    def pushed(t, state, touching):
        return push(state[0], state[2])

    for event in (clearance, pushed):
        event.terminal, event.direction = True, -1.0

    def rates(t, state, touching):
        u, v, y, _ = state
        force = push(u, y) if touching else 0.0
        depth = u - GAP if touching else RELAXING * y / (STIFF + RELAXING)
        acceleration = -amplitude * np.sin(omega * t) - K * u - C * v - force
        rate = RELAXING * (depth - y) / DASHPOT
        return v, acceleration, rate, DASHPOT * rate * rate

    t, state, touching = 0.0, np.zeros(4), False
    end = cycles / DRIVE.frequency
    while t < end:
        done = solve_ivp(
            rates, (t, end), state, "DOP853", args=(touching,), rtol=1e-12, atol=1e-14,
            events=pushed if touching else clearance,
        )  # fmt: skip
        t, state, touching = done.t[-1], done.y[:, -1], not touching
    return state


def bumper_without_mass() -> float:
    system = vi.Oscillator(1.0, vi.Isolator(K, C), right=vi.Bumper(2000.0, 5.0, GAP))
    return float(vi.simulate(vi.Rig(system, DRIVE), CYCLES)["displacement"][-1])


@pytest.mark.parametrize("mass", [1e-3, 1e-4, 1e-5])
@pytest.mark.parametrize(
    ("light", "massless"),
    [(with_bumper, bumper_without_mass), (with_solid, lambda: float(solid_without_mass()[0]))],
)
def test_the_difference_is_proportional_to_the_mass_of_the_pad(light, massless, mass) -> None:
    assert 0.02 * mass < light(mass) - massless() < 0.04 * mass


SOLID = vi.ZenerBumper(STIFF, RELAXING, DASHPOT, GAP)


def alone(stop: vi.ZenerBumper | vi.Bumper, *, side: str = "right") -> vi.Assembly:
    ends = ("body", "ground") if side == "right" else ("ground", "body")
    return vi.Assembly(
        masses={"body": 1.0},
        links={"spring": vi.Link("ground", "body", vi.Isolator(K, C))},
        stops={"face": vi.Link(*ends, stop)},
    )


@pytest.mark.parametrize(("cycles", "pressed"), [(CYCLES, False), (1.85, True)])
def test_a_solid_is_followed_as_its_equations_say(cycles: float, pressed: bool) -> None:
    """Losses are those of its dashpot, and the energies balance, also while it is pressed."""
    motion = vi.simulate(vi.Rig(alone(SOLID), DRIVE), cycles)
    u, v, y, lost = solid_without_mass(cycles)
    assert (float(motion["clearance"][0, -1]) == 0.0) == pressed
    assert float(motion["displacement"][0, -1]) == pytest.approx(u, rel=0.0, abs=1e-12)
    assert float(motion["velocity"][0, -1]) == pytest.approx(v, rel=0.0, abs=1e-11)
    face = float(motion["final_state"].sel(component="deformation.face"))
    assert face == pytest.approx(RELAXING * y / (STIFF + RELAXING), rel=0.0, abs=1e-13)
    whole = vi.totals(motion)
    assert float(whole["total_stops"][0]) == pytest.approx(lost, rel=1e-9)
    rest = sum(float(whole[f"total_{name}"].sum()) for name in ("links", "stops", "stored"))
    assert rest == pytest.approx(float(whole["total_supplied"]), rel=1e-12)


@pytest.mark.parametrize("periodic", [False, True])
def test_contacts_lose_what_the_whole_motion_does(periodic: bool) -> None:
    """Pressed, and free until the next contact; faces come towards the body."""
    rig = vi.Rig(alone(SOLID.replace(damping=200.0)), DRIVE)
    motion = vi.steady(rig) if periodic else vi.simulate(rig, CYCLES, samples=8)
    log, whole = vi.contacts(motion), vi.totals(motion)
    lost = log["contact_dissipated"] + log["contact_dissipated_relaxing"]
    assert float(lost.sum()) == pytest.approx(float(whole["total_stops"][0]), rel=1e-9)
    assert (log["contact_dissipated_relaxing"] > 0.0).all()
    if periodic:
        return
    # By DOP853 from event to event.
    pressed, free = [0.012367, 0.033211, 0.03345, 0.01874], [0.000697, 0.002779, 0.003896, 0.002931]
    of = {"dissipated": pressed, "dissipated_relaxing": free}
    for name, values in of.items():
        np.testing.assert_allclose(log[f"contact_{name}"][:4], values, rtol=0.0, atol=1e-6)
    begins = motion["event_contact"].values == 1
    u, v = (motion[f"event_{one}"].values[begins, 0] for one in ("displacement", "velocity"))
    rate = STIFF * RELAXING / ((STIFF + RELAXING) * 200.0)
    closing = v + rate * (u - GAP)
    np.testing.assert_allclose(log["contact_closing_speed"], closing, rtol=1e-12, atol=0.0)


@pytest.mark.parametrize("velocity", [0.0, 1e-9, -1e-9])
def test_a_body_that_stands_at_a_relaxing_face_is_met_by_it(velocity: float) -> None:
    state = AssemblyState({"body": 0.03}, {"body": velocity}, {"face": 0.01})
    motion = vi.simulate(vi.Rig(alone(SOLID), DRIVE), 1, state)
    assert float(motion["clearance"].min()) >= -1e-12
    assert float(motion["contact_force"].max()) > 1.0


def test_on_the_other_side_it_is_the_mirror_image() -> None:
    right = vi.simulate(vi.Rig(alone(SOLID), DRIVE), CYCLES)
    shifted = vi.Rig(alone(SOLID, side="left"), DRIVE.replace(phase=DRIVE.phase + np.pi))
    left = vi.simulate(shifted, CYCLES)
    np.testing.assert_allclose(
        left["displacement"].values, -right["displacement"].values, rtol=0.0, atol=1e-13
    )


@pytest.mark.parametrize(
    ("dampings", "stiffness", "power"),
    [((0.1, 0.01), STIFF, 1.0), ((1e6, 1e7), STIFF + RELAXING, -1.0)],
)
def test_a_weak_dashpot_leaves_one_spring_and_a_strong_one_both(dampings, stiffness, power) -> None:
    """The difference from elastic stops is proportional to c, or to 1/c."""
    elastic = vi.simulate(vi.Rig(alone(vi.Bumper(stiffness, 0.0, GAP)), DRIVE), 2)["displacement"]
    solids = [
        vi.simulate(vi.Rig(alone(SOLID.replace(damping=c)), DRIVE), 2)["displacement"]
        for c in dampings
    ]
    first, second = (float(abs(one - elastic).max()) for one in solids)
    assert first < 1e-3
    assert first / second == pytest.approx((dampings[0] / dampings[1]) ** power, rel=0.05)


@pytest.mark.parametrize("phase", range(7))
def test_without_a_gap_it_is_met_at_rest(phase: int) -> None:
    """Where bodies meet at u = 0, all terms of the force vanish; a gap of 1e-12 m is as good."""
    drive = vi.Harmonic(1.0, 0.5, float(phase))
    ends = [
        vi.simulate(vi.Rig(alone(SOLID.replace(gap=gap)), drive), 3)["displacement"][0, -1]
        for gap in (0.0, 1e-12)
    ]
    assert float(ends[0]) == pytest.approx(float(ends[1]), rel=0.0, abs=1e-10)


def test_derivative_of_a_cycle() -> None:
    rig = vi.Rig(alone(SOLID), DRIVE)
    final = as_assembly_state(vi.simulate(rig, 3.4)["final_state"], rig.system)
    start = assembly_vector(rig.system, final)

    exact, rows, damping = both_derivatives(rig, start, 3, 3, 1e-7)
    np.testing.assert_allclose(exact, rows, rtol=0.0, atol=1e-6 * np.abs(exact).max())
    assert np.log(abs(np.linalg.det(exact))) == pytest.approx(-damping, rel=1e-9)


def test_a_preload_that_has_lasted_is_at_rest() -> None:
    system = alone(SOLID.replace(gap=-0.01))
    state = equilibrium(system)
    u = -STIFF * 0.01 / (K + STIFF)
    assert state.displacement["body"] == pytest.approx(u, rel=1e-12)
    motion = vi.simulate(vi.Rig(system, vi.Harmonic(1e-12, 2.0)), 3, state)
    np.testing.assert_allclose(motion["displacement"].values, u, rtol=0.0, atol=1e-12)
    assert float(motion["contact_force"].min()) == pytest.approx(STIFF * (0.01 + u), rel=1e-9)


def test_its_force_along_a_contact_is_that_of_its_equations() -> None:
    t = np.linspace(0.0, 0.05, 2001)
    d, v = 0.003 * np.sin(np.pi * t / 0.05), 0.003 * np.pi / 0.05 * np.cos(np.pi * t / 0.05)
    rate = RELAXING / DASHPOT
    y = solve_ivp(
        lambda t, y: rate * (0.003 * np.sin(np.pi * t / 0.05) - y),
        (0.0, 0.05), [0.0], "DOP853", t, rtol=1e-12, atol=1e-15,
    ).y[0]  # fmt: skip
    expected = np.maximum(STIFF * d + RELAXING * (d - y), 0.0)
    np.testing.assert_allclose(SOLID.force(d, v), expected, rtol=0.0, atol=1e-5)
    assert SOLID.force(d, np.zeros_like(d)) == pytest.approx(STIFF * d)


def test_an_oscillator_refuses_it() -> None:
    with pytest.raises(vi.InputError, match=r"^left: a ZenerBumper is a stop of assemblies only"):
        vi.Oscillator(1.0, vi.Isolator(K, C), left=SOLID)
