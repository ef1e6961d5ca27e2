"""The reference integrator against closed forms, its own limits and the physics it stands for."""

import math

import pytest
from mpmath import mp, mpc, mpf

from reference.fifty_digits import integrate
from reference.first_zero import first_zero
from reference.pieces import Piece, closed_form, largest_difference, pieces
from reference.rig import Reference, Rig, State, Stop
from samples import sample

MASS, STIFFNESS, FREQUENCY, AMPLITUDE = 550.0, 26290.0, 1.1, 0.05 * 9.80665
NATURAL = math.sqrt(STIFFNESS / MASS)
DAMPING = 2 * 0.15 * NATURAL * MASS
SHAKEN = (AMPLITUDE, FREQUENCY, 0.0)
REST = (0.0, 0.0, 0.0, 0.0)
POINTS = sample(40, 10)
"""At which a phase is looked at, between its ends."""


def stop(stiffness: float = 510e3, relaxation: float = 0.01, gap: float = 0.0075) -> Stop:
    """A bumper with the paper's dimensionless relaxation time omega_0 C_j / K_j."""
    return Stop(stiffness, relaxation * stiffness / NATURAL, gap)


def rig(right: Stop | None, left: Stop | None, damping: float = DAMPING) -> Rig:
    return Rig(MASS, STIFFNESS, damping, right, left)


def both(*, damping: float = DAMPING, **changes: float) -> Rig:
    return rig(stop(**changes), stop(**changes), damping)


PRESSED = (0.0125, 0.1, 0.005, 0.0)
RUNS = {
    "typical": (both(), REST),
    "soft": (both(stiffness=0.25 * STIFFNESS), REST),
    "hard": (both(stiffness=1e5 * STIFFNESS), REST),
    "hard and elastic": (both(stiffness=1e5 * STIFFNESS, relaxation=0.0), REST),
    "elastic": (both(relaxation=0.0), REST),
    "all but elastic": (both(relaxation=1e-8), REST),
    "overdamped contact": (both(relaxation=10.0), REST),
    "no gap": (both(gap=0.0), REST),
    "no gap, elastic": (both(gap=0.0, relaxation=0.0), REST),
    "no gap, elastic, unequal": (
        rig(stop(1.6e7, 0.0, 0.0), stop(1.7e8, 0.0, 0.0), 0.0),
        (0.0, -0.45, 0.0, 0.0),
    ),
    "no gap on the left": (rig(stop(), stop(gap=0.0)), REST),
    "no bumper on the left": (rig(stop(), None), REST),
    "undamped isolator": (both(damping=0.0), REST),
    "overdamped isolator": (both(damping=20 * DAMPING, gap=1e-4), REST),
    "unequal": (rig(stop(gap=0.004), stop(1e6, 0.3, 0.009)), REST),
    "pressed start": (both(), PRESSED),
    "pressed start, elastic": (both(relaxation=0.0), PRESSED),
    "deformed bumpers": (both(), (0.0, 0.0, 0.003, -0.004)),
}


@pytest.mark.parametrize("damping", [0.0, DAMPING, 100 * DAMPING])
def test_free_flight_is_the_closed_form(damping: float) -> None:
    run = integrate(rig(None, None, damping), AMPLITUDE, FREQUENCY, 0.0, (0.01, -0.2, 0, 0), 10)
    assert run.events == []
    with mp.workdps(70):
        coefficients = (mpf(STIFFNESS) / MASS, mpf(damping) / mpf(MASS), mpf(0))
        motion = closed_form(coefficients, SHAKEN, mpf(0), run.states[0])
        for n, state in enumerate(run.states):
            u, v = motion(n / mpf(FREQUENCY))
            assert abs(state[0] - u) < mpf(10) ** -50
            assert abs(state[1] - v) < mpf(10) ** -50


@pytest.mark.parametrize("name", sample([*RUNS], [*RUNS][::4]))
def test_every_phase_is_its_closed_form_and_ends_at_its_first_zero(name: str) -> None:
    setup, start = RUNS[name]
    run = integrate(setup, AMPLITUDE, FREQUENCY, 0.0, start, 3)
    assert run.events
    with mp.workdps(70):
        for piece, event in pieces(setup, SHAKEN, run):
            (begin, _), (end, state) = piece.begin, piece.end
            arrived = (*piece.motion(end), piece.bumper("right", end), piece.bumper("left", end))
            differences = [abs(a - b) for a, b in zip(arrived, state, strict=True)]
            assert max(differences) < mpf(10) ** -48
            # Contact force and clearance are zero at their event, and never negative before.
            if event is not None:
                assert abs(piece.margin(event.kind.split("_")[1], end)) < mpf(10) ** -48
            for n in range(1, POINTS):
                t = begin + (end - begin) * n / POINTS
                assert min(piece.margin(name, t) for name in piece.stops) > -(mpf(10) ** -48)


@pytest.mark.parametrize(
    "name", sample(["typical", "elastic", "overdamped contact", "no gap", "unequal"], ["unequal"])
)
def test_base_work_is_dissipated_or_stored(name: str) -> None:
    setup, start = RUNS[name]
    run = integrate(setup, AMPLITUDE, FREQUENCY, 0.0, start, 2)
    with mp.workdps(50):
        omega = 2 * mp.pi * mpf(FREQUENCY)

        def energy(state: State) -> mpf:
            held = setup.mass * state[1] ** 2 + setup.stiffness * state[0] ** 2
            for stop, deformation in ((setup.right, state[2]), (setup.left, state[3])):
                held += stop.stiffness * deformation**2 if stop else 0
            return held / 2

        balance = energy(run.states[0]) - energy(run.states[-1])
        for piece, _ in pieces(setup, SHAKEN, run):

            def gain(t: mpf, piece: Piece = piece) -> mpf:
                v = piece.motion(t)[1]
                power = -setup.mass * mpf(AMPLITUDE) * mp.sin(omega * t) * v - setup.damping * v**2
                for name, (_, stop) in piece.stops.items():
                    if name in piece.pressed:
                        power -= stop.damping * v**2
                    elif stop.damping:
                        # A free bumper burns what it holds.
                        power -= (stop.stiffness * piece.bumper(name, t)) ** 2 / stop.damping
                return power

            # Relaxation is the fastest rate here: it sets how the quadrature is divided.
            parts = 1 + int((piece.end[0] - piece.begin[0]) * 30)
            nodes = mp.linspace(piece.begin[0], piece.end[0], parts + 1)
            balance += mp.quad(gain, nodes, method="gauss-legendre", maxdegree=5)
        assert abs(balance) < mpf(10) ** -25 * energy((mpf("0.01"), mpf("0.1"), 0, 0))


@pytest.mark.parametrize(
    "name", sample(["typical", "hard", "overdamped contact", "no gap"], ["typical"])
)
def test_order_and_digits_change_nothing(name: str) -> None:
    setup, start = RUNS[name]
    run = integrate(setup, AMPLITUDE, FREQUENCY, 0.3, start, 5)
    other_order = integrate(setup, AMPLITUDE, FREQUENCY, 0.3, start, 5, order=45)
    fewer_digits = integrate(setup, AMPLITUDE, FREQUENCY, 0.3, start, 5, digits=30)
    assert largest_difference(run, other_order) < mpf(10) ** -48
    assert largest_difference(run, fewer_digits) < mpf(10) ** -28


def test_the_mirrored_rig_moves_mirrored() -> None:
    setup, _ = RUNS["unequal"]
    run = integrate(setup, AMPLITUDE, FREQUENCY, 0.3, (0.001, 0.1, 0.002, 0.0), 3)
    swapped = rig(setup.left, setup.right)
    mirror = integrate(swapped, -AMPLITUDE, FREQUENCY, 0.3, (-0.001, -0.1, 0.0, -0.002), 3)
    with mp.workdps(80):
        back = [(-u, -v, -left, -right) for u, v, right, left in mirror.states]
    assert largest_difference(Reference(run.states, []), Reference(back, [])) < mpf(10) ** -55
    sides = {"right": "left", "left": "right"}
    for event, image in zip(run.events, mirror.events, strict=True):
        what, side = image.kind.split("_")
        assert event.kind == f"{what}_{sides[side]}"


@pytest.mark.parametrize("stiffness", [510e3, 1e5 * STIFFNESS])
@pytest.mark.parametrize("relaxation", [0.0, 0.01])
@pytest.mark.parametrize("depth", ["1e-8", "1e-24", "-1e-24"])
def test_no_grazing_pass_is_missed_or_invented(
    depth: str, relaxation: float, stiffness: float
) -> None:
    with mp.workdps(80):
        omega = 2 * mp.pi * mpf(FREQUENCY)
        swing = -mpf(AMPLITUDE) / mpc(
            mpf(STIFFNESS) / mpf(MASS) - omega**2, mpf(DAMPING) / mpf(MASS) * omega
        )
        start = (mp.im(swing), omega * mp.re(swing), 0, 0)
        grazed = stop(stiffness, relaxation, abs(swing) * (1 - mpf(depth)))
    run = integrate(rig(grazed, None), AMPLITUDE, FREQUENCY, 0.0, start, 1)
    passed = ["contact_right", "detach_right"] if mpf(depth) > 0 else []
    assert [event.kind for event in run.events] == passed


def test_a_touching_start_goes_where_force_and_motion_point() -> None:
    def first(setup: Rig, start: tuple[float, float, float, float], amplitude: float) -> str:
        return integrate(setup, amplitude, FREQUENCY, 0.0, start, 1).events[0].kind

    for relaxation in (0.0, 0.01):
        closed = both(gap=0.0, relaxation=relaxation)
        # The acceleration is zero at the start; what follows is its slope, against the base's.
        assert first(closed, REST, AMPLITUDE) == "detach_left"
        assert first(closed, REST, -AMPLITUDE) == "detach_right"
        assert first(closed, (0.0, 0.1, 0.0, 0.0), AMPLITUDE) == "detach_right"
        assert first(closed, (0.0, -0.1, 0.0, 0.0), AMPLITUDE) == "detach_left"
    # The mass leaves a deformed damped bumper faster than it relaxes: flight from the start.
    assert first(both(), (0.0125, -5.0, 0.005, 0.0), AMPLITUDE) == "contact_left"


@pytest.mark.parametrize(
    ("setup", "start"),
    [
        (both(), (0.02, 0.0, 0.0, 0.0)),
        (both(), (0.0, 0.0, -0.001, 0.0)),
        (both(relaxation=0.0), (0.0, 0.0, 0.001, 0.0)),
        (both(stiffness=-1.0), REST),
        (both(gap=-0.001), REST),
    ],
)
def test_the_impossible_is_refused(setup: Rig, start: tuple[float, float, float, float]) -> None:
    with pytest.raises(ValueError):
        integrate(setup, AMPLITUDE, FREQUENCY, 0.0, start, 1)


@pytest.mark.parametrize(
    ("zeros", "first"),
    [
        (["0.5"], "0.5"),
        (["0.7", "0.71", "0.2"], "0.2"),
        (["0.25", "0.25", "0.75"], "0.75"),
        (["0.3", "0.3000000000000000000001", "0.9"], "0.3"),
        (["0.5", "0.6", "0.8"], "0.5"),
        (["1e-88", "0.3", "0.6"], "0"),
        (["1.2", "-0.4"], None),
    ],
)
def test_the_first_zero_is_the_first(zeros: list[str], first: str | None) -> None:
    with mp.workdps(70):
        series = [mpf(1)]
        for zero in zeros:
            shifted = [mpf(0), *series]
            series = [mpf(zero) * a - b for a, b in zip([*series, mpf(0)], shifted, strict=True)]
        if series[0] < 0:
            series = [-value for value in series]
        found = first_zero(series)
        if first is None:
            assert found is None
        else:
            assert found is not None
            assert abs(found - mpf(first)) < mpf(10) ** -40
