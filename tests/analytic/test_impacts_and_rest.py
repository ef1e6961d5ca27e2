"""Impacts, chatter, rest and their disturbances, where closed forms tell what must come."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import vibroimpact as vi
from properties.strategies import decades, examples
from reference.public_motion import events
from vibroimpact.model import equilibrium

ISOLATOR = vi.Isolator(1.0, 0.1)


@pytest.mark.parametrize("e", [0.0, 0.05, 0.5, 0.8, 0.95, 0.99])
@pytest.mark.parametrize("side", [1, -1])
def test_the_end_of_a_chatter_is_that_of_the_geometric_series(e: float, side: int) -> None:
    """Where the pressing acceleration a hardly changes, it is over after 2 w/(a (1 - e)).

    The mass is thrown off a wall that it presses by the preload; the isolator's force changes by a
    share x/G of the height of the throw, w²/(2 a) over G.
    """
    name = "right" if side == 1 else "left"
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), **{name: vi.RigidStop(e, -1.0)})
    w = 1e-4
    start = vi.State(-side, -side * w)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 1.0)), 1, start, samples=1)
    seen = events(data)
    (rest,) = [one for one in seen if one.kind.startswith("contact")]
    assert rest.kind == f"contact_{name}"
    assert rest.time == pytest.approx(2 * w / (1 - e), rel=1e-7)
    assert (rest.u, rest.v) == (-side, 0.0)
    impacts = [one for one in seen if one.kind.startswith("impact")]
    assert impacts[0].time == pytest.approx(2 * w, rel=1e-7)
    for one, other in pairwise(impacts[:6]):
        # What rounds the place at u = 1 is divided by the speed to make the time's.
        assert other.v == pytest.approx(e * one.v, rel=1e-7, abs=1e-15 / abs(one.v))
    assert list(data["final_state"].values[:2]) == [-side, 0.0]


@pytest.mark.parametrize(
    ("left", "cycles"), [(vi.RigidStop(1.0, -0.1), 700), (vi.RigidStop(1.0, 0.5), 1700)]
)
def test_an_impact_may_return_all_of_its_energy_ten_thousand_times(
    left: vi.RigidStop, cycles: int
) -> None:
    rig = vi.Oscillator(2.0, vi.Isolator(3.0, 0.0), vi.RigidStop(1.0, 0.25), left)
    start = vi.State(0.2, 1.0)
    data = vi.simulate(
        vi.Rig(rig, vi.Harmonic(0.0, rig.natural_frequency)), cycles, start, samples=1
    )
    assert data.sizes["event"] > 10_000
    energy = 2.0 * data["velocity"] ** 2 + 3.0 * data["displacement"] ** 2
    assert float(np.abs(energy / energy[0] - 1.0).max()) < 1e-12


@pytest.mark.parametrize("right", [None, vi.Bumper(40.0, 0.0, 0.25), vi.Bumper(0.7, 0.0, 0.3)])
def test_what_loses_nothing_keeps_its_energy_over_ten_thousand_cycles(
    right: vi.Bumper | None,
) -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.0), right)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 0.16)), 10_000, vi.State(0.2, 1.0), samples=1)
    energy = data["velocity"] ** 2 + data["displacement"] ** 2
    if right is not None:
        energy = energy + right.stiffness * data["deformation"].sel(stop="right") ** 2
    assert float(np.abs(energy / energy[0] - 1.0).max()) < 1e-12


@pytest.mark.parametrize("e", [0.0, 0.3, 0.9])
def test_rest_ends_exactly_when_nothing_presses(e: float) -> None:
    """Once K G + M A sin θ has fallen to zero; then the mass leaves without a jump."""
    gap, amplitude = -0.4, 0.9
    rig = vi.Oscillator(1.0, ISOLATOR, vi.RigidStop(e, gap))
    shaken = vi.Harmonic(amplitude, 0.02, -math.pi / 2)
    data = vi.simulate(vi.Rig(rig, shaken), 1, samples=400)
    left = events(data)[0]
    assert left.kind == "detach_right"
    # The base acts towards the wall while its acceleration is negative: -(K G + M A sin θ) >= 0.
    angle = math.asin(-gap / amplitude)
    assert left.time * shaken.angular_frequency == pytest.approx(angle + math.pi / 2, abs=1e-13)
    i = int(np.flatnonzero(data["event_contact"].values == 0)[0])
    before, behind = (float(data[f"event_acceleration_{w}"][i]) for w in ("before", "after"))
    assert before == pytest.approx(behind, abs=1e-14)
    assert (left.u, left.v) == (gap, 0.0)


def test_rest_that_is_never_shaken_off_lasts() -> None:
    rig = vi.Oscillator(1.0, ISOLATOR, vi.RigidStop(0.5, -0.4), vi.Bumper(3.0, 0.1, -0.2))
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.99, 0.1)), 50, samples=64)
    assert data.sizes["event"] == 0
    assert (data["displacement"] == -0.4).all()
    assert data["touching"].all()
    # The bumper's face would be at u = 0.2.
    assert (data["deformation"].sel(stop="left") == pytest.approx(0.6)).all()


@pytest.mark.parametrize("e", [0.0, 0.4, 1.0])
def test_a_contact_record_of_an_impact(e: float) -> None:
    mass, v = 3.0, 2.0
    rig = vi.Oscillator(mass, vi.Isolator(1.0, 0.0), None, vi.RigidStop(e, 0.5))
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 1.0)), 1, vi.State(0.0, -v), samples=64)
    row = vi.contacts(data).isel(contact_number=0)
    struck = math.sqrt(v**2 - 0.5**2 / mass)
    assert row["contact_stop"].item() == "left"
    assert float(row["contact_duration"]) == 0.0
    assert float(row["contact_impulse"]) == pytest.approx(mass * (1 + e) * struck, rel=1e-14)
    lost = 0.5 * mass * (1 - e**2) * struck**2
    assert float(row["contact_dissipated"]) == pytest.approx(lost, rel=1e-13, abs=1e-14)
    assert float(row["contact_restitution"]) == pytest.approx(e, abs=1e-14)


def central(rig: vi.Oscillator, shaken: vi.Harmonic, start: vi.State, cycles: int) -> np.ndarray:
    """The derivative of (u, v) after some cycles, by central differences of fourth order."""
    columns = []
    for du, dv in ((1.0, 0.0), (0.0, 1.0)):
        ends = []
        for h in (-2e-4, -1e-4, 1e-4, 2e-4):
            moved = vi.State(start.displacement + h * du, start.velocity + h * dv)
            end = vi.simulate(vi.Rig(rig, shaken), cycles, moved, samples=0)["final_state"]
            ends.append(end.values[:2])
        columns.append((ends[0] - 8 * ends[1] + 8 * ends[2] - ends[3]) / (12 * 1e-4))
    return np.array(columns).T


@pytest.mark.parametrize(
    ("right", "left", "amplitude", "frequency"),
    [
        (vi.RigidStop(0.8, 0.3), vi.RigidStop(0.6, 0.4), 1.0, 0.25),
        (vi.RigidStop(0.7, 0.3), vi.Bumper(20.0, 0.9, 0.1), 1.0, 0.25),
        (vi.RigidStop(0.7, 0.5), vi.Bumper(2.0, 0.0, -0.3), 1.0, 0.35),
        (vi.Bumper(6.0, 0.0, -0.3), vi.Bumper(9.0, 0.0, -0.1), 5.0, 0.4),
    ],
)
def test_multipliers_are_the_derivative_of_the_motion(right, left, amplitude, frequency) -> None:
    rig = vi.Oscillator(1.0, ISOLATOR, right, left)
    shaken = vi.Harmonic(amplitude, frequency)
    settled = vi.steady(vi.Rig(rig, shaken), samples=64)
    # A section at which (u, v) is the whole state: bumpers with a dashpot are back at rest.
    memory = np.zeros(settled.sizes["time"])
    for stop, name in ((right, "right"), (left, "left")):
        if isinstance(stop, vi.Bumper) and stop.damping:
            memory += settled["deformation"].sel(stop=name).values
    i = int(np.argmin(memory))
    assert memory[i] < 1e-13
    shaken = shaken.replace(phase=math.tau * float(settled["cycle"][i]))
    start = vi.State(float(settled["displacement"][i]), float(settled["velocity"][i]))
    orbit = vi.orbit(vi.Rig(rig, shaken), start, int(settled["period"]))
    monodromy = orbit["monodromy"].values[:2, :2]
    numeric = central(rig, shaken, start, int(orbit["period"]))
    np.testing.assert_allclose(numeric, monodromy, atol=1e-7 * max(1.0, np.abs(monodromy).max()))


def test_a_chatter_into_rest_forgets_all() -> None:
    """Whatever the mass did before, it leaves the wall at the same time: all multipliers are 0."""
    rig = vi.Oscillator(1.0, ISOLATOR, vi.RigidStop(0.5, -0.4))
    shaken = vi.Harmonic(1.0, 0.08)
    orbit = vi.orbit(vi.Rig(rig, shaken))
    moduli = np.hypot(orbit["multiplier_real"].values, orbit["multiplier_imag"].values)
    assert moduli.max() < 1e-12
    assert int(orbit["stable"]) == 1
    ends = [
        vi.simulate(vi.Rig(rig, shaken), 3, vi.State(-1.0, v), samples=0)["final_state"].values
        for v in (0.0, 1e-3, 0.1)
    ]
    assert np.ptp([end[0] for end in ends]) < 1e-13


@examples(60)
@given(st.floats(0.1, 0.95), decades(-9, -4))
def test_beside_grazing_the_response_is_a_square_root(e: float, depth: float) -> None:
    """Steady free flight that enters by a depth d hits with v = √(2 |a| d), and returns with e v.

    Before the impact it is v = |a| τ, d = |a| τ²/2 from the top of its path; afterwards the motion
    has lost (1 + e) v. So at the time of the top the difference from free flight is -(1 + e) v.
    """
    damping, frequency = 0.3, 0.3
    omega = math.tau * frequency
    swing = 1.0 / math.hypot(1 - omega**2, damping * omega)
    # Displacement is swing·cos(θ - peak).
    peak = math.pi / 2 - math.atan2(-damping * omega, 1 - omega**2) - math.pi
    d = depth * swing
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, damping), vi.RigidStop(e, swing - d))
    back = 0.2
    start = vi.State(swing * math.cos(-back * omega), -swing * omega * math.sin(-back * omega))
    shaken = vi.Harmonic(1.0, frequency, peak - back * omega)
    assert _free(rig, shaken, start, back) == pytest.approx((swing, 0.0), abs=1e-12)
    end = vi.simulate(vi.Rig(rig, shaken), back * frequency, start, samples=0)["final_state"].values
    v = math.sqrt(2 * swing * omega**2 * d)
    assert end[1] / v == pytest.approx(-(1 + e), rel=20 * math.sqrt(depth))


def _free(rig: vi.Oscillator, shaken: vi.Harmonic, start: vi.State, time: float) -> tuple:
    free = rig.without_bumpers()
    end = vi.simulate(vi.Rig(free, shaken), time * shaken.frequency, start, samples=0)[
        "final_state"
    ]
    return tuple(end.values[:2])


@pytest.mark.parametrize(
    ("right", "left"),
    [
        (vi.Bumper(6.0, 1.0, -0.4), None),
        (vi.Bumper(6.0, 1.0, -0.4), vi.Bumper(5.0, 0.0, 0.2)),
        (vi.Bumper(6.0, 1.0, -0.4), vi.Bumper(7.0, 3.0, -0.1)),
        (vi.RigidStop(0.5, -0.1), vi.Bumper(5.0, 0.3, 0.2)),
        (vi.RigidStop(0.5, -0.1), None),
        (vi.Bumper(6.0, 1.0, -0.4), vi.RigidStop(0.5, 0.25)),
    ],
)
def test_a_rig_that_is_not_shaken_stays_in_equilibrium(right, left) -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(2.0, 0.3), right, left)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 1.0)), 20, samples=16)
    u = equilibrium(rig).displacement
    np.testing.assert_allclose(data["displacement"], u, rtol=1e-14)
    assert float(np.abs(data["velocity"]).max()) < 1e-14
    # From elsewhere it comes back there.
    far = vi.State(u - 0.05) if isinstance(right, vi.RigidStop) else vi.State(u + 0.05)
    end = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 1.0)), 400, far, samples=0)["final_state"]
    assert float(end[0]) == pytest.approx(u, abs=1e-12)


@examples(40)
@given(st.floats(0.01, 0.999), decades(2, 6), decades(-2, 3))
def test_bumpers_from_restitution_return_it(e: float, ratio: float, mass: float) -> None:
    """On an isolator softer by `ratio`, up to its share of the force."""
    stiffness = 5.0
    bumper = vi.Bumper.from_restitution(mass, ratio * stiffness, e, 0.0)
    rig = vi.Oscillator(mass, vi.Isolator(stiffness, 0.0), bumper)
    quick = 0.5 / rig.natural_frequency
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(0.0, 1.0 / quick)), 1, vi.State(0.0, 2.0), samples=1)
    left = next(one for one in events(data) if one.kind == "detach_right")
    assert -left.v == pytest.approx(2.0 * e, rel=10.0 / ratio / min(e, 1.0))


def test_a_mass_at_rest_on_a_wall_is_seen_exactly_there() -> None:
    """Whatever the sum of a preloaded bumper's gap and deformation rounds to."""
    wall = vi.RigidStop(0.5, -1.5482546511515751)
    rig = vi.Oscillator(1.0, ISOLATOR, vi.Bumper(1.0, 0.0, -2.5), wall)
    data = vi.simulate(vi.Rig(rig, vi.Harmonic(1.0, 0.16)), 2, vi.State(-wall.gap), samples=8)
    assert (data["displacement"] == -wall.gap).all()
