"""Rigid stops and bumpers that overlap, in the reference integrator: against closed forms."""

import pytest
from mpmath import mp, mpf

from reference.chatter import accumulation
from reference.fifty_digits import integrate
from reference.pieces import Shaken, largest_difference, pieces
from reference.rig import Reference, Rig, State, Stop, Wall
from samples import sample

# With M = K = 1; the isolator's damping ratio is 0.05 unless said.
SHAKEN = (1.0, 0.25, 0.3)
REST = (0.0, 0.0, 0.0, 0.0)
BUMPER = Stop(20.0, 0.9, 0.1)
PRELOADED = Stop(6.0, 0.8, -0.2)


def rig(right: Stop | Wall | None, left: Stop | Wall | None, damping: float = 0.1) -> Rig:
    return Rig(1.0, 1.0, damping, right, left)


def pressed(u: float, v: float, setup: Rig) -> tuple[float | mpf, ...]:
    """A start with the bumpers as far pressed as the mass reaches into them."""
    with mp.workdps(60):
        deformations = [
            sign * max(sign * mpf(u) - mpf(stop.gap), mpf(0)) if isinstance(stop, Stop) else 0.0
            for sign, stop in ((1, setup.right), (-1, setup.left))
        ]
    return (u, v, *deformations)


RUNS: dict[str, tuple[Rig, Shaken, tuple[float, float]]] = {
    "two walls": (rig(Wall(0.8, 0.5), Wall(0.6, 0.4)), SHAKEN, (0.0, 0.0)),
    "a wall, no gap": (rig(Wall(0.7, 0.0), None), SHAKEN, (-0.1, 0.0)),
    "walls with room on one side only": (rig(Wall(0.5, 0.6), Wall(0.9, -0.2)), SHAKEN, (0.3, 1.0)),
    "a wall faces a bumper": (rig(Wall(0.7, 0.3), BUMPER), SHAKEN, (0.0, 0.0)),
    "a wall faces an elastic bumper": (rig(Stop(20.0, 0.0, 0.1), Wall(0.4, 0.2)), SHAKEN, (0, 0)),
    "chatter and rest": (rig(Wall(0.5, -0.4), None), (1.0, 0.08, 0.0), (-1.0, 0.0)),
    "chatter and rest on both sides": (
        rig(Wall(0.3, 0.2), Wall(0.6, 0.1)),
        (1.0, 0.05, 0.0),
        (0.0, 0.0),
    ),
    "chatter on a wall, pressed by a bumper": (
        rig(Wall(0.6, 0.1), Stop(5.0, 0.3, -0.4)),
        (1.0, 0.06, 0.0),
        (0.05, 0.0),
    ),
    "chatter while a bumper relaxes": (
        rig(Stop(1.0, 2.8, 0.5), Wall(0.5, 0.0), 1.9),
        (1.0, 0.16, 0.0),
        (0.0, 0.0),
    ),
    "sticking": (rig(Wall(0.0, 0.2), Wall(0.0, 0.3)), (1.0, 0.1, 0.0), (0.0, 0.0)),
    "no loss": (rig(Wall(1.0, 0.2), Wall(1.0, -0.1)), SHAKEN, (0.15, 0.0)),
    "rest at the start": (rig(Wall(0.5, -0.4), None), (0.5, 0.2, 0.0), (-0.4, 0.0)),
    "one preload": (rig(PRELOADED, None), SHAKEN, (-0.1, 0.0)),
    "equal preloads": (rig(PRELOADED, PRELOADED), (6.0, 0.3, 0.3), (0.0, 0.0)),
    "unequal preloads": (
        rig(Stop(6.0, 0.8, -0.3), Stop(50.0, 2.0, -0.05)),
        (2.0, 0.4, 1.0),
        (0.1, -0.2),
    ),
    "overlap without preload on the left": (
        rig(Stop(6.0, 0.1, -0.3), Stop(30.0, 0.05, 0.2)),
        (1.5, 0.3, 0.0),
        (0.0, 0.0),
    ),
    "elastic preloads": (
        rig(Stop(6.0, 0.0, -0.3), Stop(9.0, 0.0, -0.1)),
        (5.0, 0.4, 0.3),
        (0.0, 0.0),
    ),
    "overdamped preloads": (
        rig(Stop(3.0, 20.0, -0.3), Stop(9.0, 15.0, -0.2)),
        (20.0, 0.25, 0.3),
        (0.0, 0.0),
    ),
}


def run_of(name: str, cycles: int = 3, **options: int) -> Reference:
    setup, shaken, (u, v) = RUNS[name]
    return integrate(setup, *shaken, pressed(u, v, setup), cycles, **options)


@pytest.mark.full
@pytest.mark.parametrize("name", sample([*RUNS], [*RUNS][::4]))
def test_every_phase_is_its_closed_form_and_ends_at_its_first_zero(name: str) -> None:
    setup, shaken, (u, v) = RUNS[name]
    run = run_of(name)
    assert run.events
    deformations = zip(("right", "left"), pressed(u, v, setup)[2:], strict=True)
    touched = frozenset(side for side, deformation in deformations if deformation)
    tiny = mpf(10) ** -48
    seen = set()
    with mp.workdps(70):
        for piece, event in pieces(setup, shaken, run, touched):
            (begin, _), (end, state) = piece.begin, piece.end
            seen.add(piece.touched)
            side = event.kind.split("_")[1] if event else ""
            if (
                event
                and event.kind.startswith("contact")
                and isinstance(getattr(setup, side), Wall)
            ):
                # The impacts before the limit are not all listed.
                assert state[1] == 0
                assert state[0] == (1 if side == "right" else -1) * mpf(getattr(setup, side).gap)
                continue
            arrived = (*piece.motion(end), piece.bumper("right", end), piece.bumper("left", end))
            assert max(abs(a - b) for a, b in zip(arrived, state, strict=True)) < tiny
            if event is not None:
                assert abs(piece.margin(side, end)) < tiny
            for n in range(1, 40):
                t = begin + (end - begin) * n / 40
                assert min(piece.margin(other, t) for other in piece.stops) > -tiny
    if "preload" in name and name != "one preload":
        assert frozenset({"right", "left"}) in seen


@pytest.mark.parametrize("name", sample([*RUNS], [*RUNS][1::6]))
def test_order_and_digits_change_nothing(name: str) -> None:
    def without_chatter(run: Reference) -> Reference:
        """Without impacts whose number depends on the digits: those close before a rest."""
        rests = [e.time for e in run.events if e.kind.startswith("contact")]
        return Reference(
            run.states,
            [
                e
                for e in run.events
                if not e.kind.startswith("impact")
                or abs(e.v) > mpf(10) ** -2
                or all(e.time > rest for rest in rests)
            ],
        )

    run = without_chatter(run_of(name))
    assert largest_difference(run, without_chatter(run_of(name, order=45))) < mpf(10) ** -46
    assert largest_difference(run, without_chatter(run_of(name, digits=30))) < mpf(10) ** -26


def test_a_rest_may_end_with_the_period() -> None:
    """Without a gap it ends where sin θ = 0: there, and not a rounding later once more."""
    setup = rig(Wall(0.0, 0.0), None, 0.0)
    run = integrate(setup, 1.0, 0.16, 0.0, (-1.0, 0.0, 0, 0), 4)
    assert [e.kind for e in run.events] == ["impact_right", "contact_right", "detach_right"] * 4
    with mp.workdps(60):
        for n, event in enumerate(run.events[2::3]):
            assert abs(event.time - (n + 1) / mpf(0.16)) < mpf(10) ** -48


def test_an_impact_at_the_start_is_an_event() -> None:
    setup = rig(Wall(0.0, -5.0), Wall(0.5, 9.0))
    run = integrate(setup, 1.0, 0.16, 0.0, (-5.0, 2.0, 0, 0), 2)
    assert [(e.kind, e.time) for e in run.events] == [("impact_right", 0), ("contact_right", 0)]


@pytest.mark.parametrize("name", ["chatter and rest", "sticking", "rest at the start"])
def test_rest_ends_when_nothing_presses(name: str) -> None:
    setup, (amplitude, frequency, phase), _ = RUNS[name]
    leaves = [e for e in run_of(name).events if e.kind.startswith("detach")]
    assert leaves
    with mp.workdps(70):
        for event in leaves:
            sign = 1 if event.kind.endswith("right") else -1
            wall = setup.right if sign == 1 else setup.left
            angle = 2 * mp.pi * mpf(frequency) * event.time + phase
            force = sign * (-mpf(amplitude) * mp.sin(angle) - sign * mpf(wall.gap))
            slope = -sign * mpf(amplitude) * mp.cos(angle)
            assert abs(force) < mpf(10) ** -48
            assert slope < 0
            assert event.v == 0


def bounces(e: mpf, shaken: Shaken, time: mpf, speed: mpf) -> mpf:
    """Where the impacts on a right wall accumulate, added up one by one (K = C = 0, M = 1).

    The distance d from the wall obeys d″ = A sin(ω t + φ). So after a time s its rate is
    v - A (cos(θ + ω s) - cos θ)/ω, and it is v s - A (sin(θ + ω s) - sin θ - ω s cos θ)/ω².
    """
    amplitude, frequency, phase = map(mpf, shaken)
    omega = 2 * mp.pi * frequency
    while speed > mpf(10) ** -62:
        angle = omega * time + phase
        sine, cosine = mp.sin(angle), mp.cos(angle)
        flight = -2 * speed / (amplitude * sine)
        for _ in range(60):
            turned = mp.sin(angle + omega * flight) - sine - omega * flight * cosine
            v = speed - amplitude * (mp.cos(angle + omega * flight) - cosine) / omega
            change = (speed * flight - amplitude * turned / omega**2) / v
            flight -= change
            if abs(change) < mpf(10) ** -80 * flight:
                break
        time, speed = time + flight, -e * v
    return time


@pytest.mark.parametrize("e", sample([0.2, 0.5, 0.9], [0.5]))
def test_the_limit_of_a_chatter_is_that_of_all_its_impacts(e: float) -> None:
    shaken = (1.0, 0.05, -2.0)
    setup = Rig(1.0, 0.0, 0.0, Wall(e, 0.3))
    run = integrate(setup, *shaken, (0.3, -0.2, 0, 0), 1)
    rest = next(event for event in run.events if event.kind == "contact_right")
    with mp.workdps(250):  # a tiny flight is a difference of sines
        limit = bounces(mpf(e), shaken, mpf(0), mpf(0.2))
        assert abs(rest.time - limit) < mpf(10) ** -48


def test_extrapolation_of_a_geometric_series() -> None:
    with mp.workdps(80):
        e = mpf("0.8")
        times = (1 - 3 * e**n + e ** (2 * n) / 7 for n in range(1000))
        assert abs(accumulation(times, e, mpf(10) ** -60) - 1) < mpf(10) ** -60
    with pytest.raises(ArithmeticError):
        accumulation((mpf(n) for n in range(1000)), mpf("0.5"), mpf(10) ** -20)


@pytest.mark.full
def test_without_losses_energy_stays() -> None:
    setup = Rig(2.0, 3.0, 0.0, Wall(1.0, 0.25), Wall(1.0, -0.1))
    run = integrate(setup, 0.0, 0.2, 0.0, (0.2, 1.0, 0, 0), 10)
    assert sum(event.kind.startswith("impact") for event in run.events) > 100
    with mp.workdps(60):
        energies = [setup.mass * v**2 + setup.stiffness * u**2 for u, v, *_ in run.states]
        assert max(energies) - min(energies) < mpf(10) ** -46


def test_two_elastic_bumpers_that_never_let_go_are_one_spring() -> None:
    setup = Rig(1.0, 1.0, 0.3, Stop(4.0, 0.0, -5.0), Stop(7.0, 0.0, -3.0))
    run = integrate(setup, *SHAKEN, pressed(0.1, 0.2, setup), 5)
    assert run.events == []
    # 1 u + 4 (u + 5) + 7 (u - 3) = 0 + 12 u - 1
    spring = Rig(1.0, 12.0, 0.3)
    with mp.workdps(80):
        centre = mpf(1) / 12
        start = (mpf(0.1) - centre, 0.2, 0, 0)
    other = integrate(spring, *SHAKEN, start, 5)
    with mp.workdps(80):
        for one, two in zip(run.states, other.states, strict=True):
            assert abs(one[0] - centre - two[0]) < mpf(10) ** -48
            assert abs(one[1] - two[1]) < mpf(10) ** -48


@pytest.mark.parametrize("name", ["two walls", "a wall faces a bumper", "unequal preloads"])
def test_the_mirrored_rig_moves_mirrored(name: str) -> None:
    setup, (amplitude, frequency, phase), (u, v) = RUNS[name]
    swapped = rig(setup.left, setup.right)
    mirror = integrate(swapped, -amplitude, frequency, phase, pressed(-u, -v, swapped), 3)
    run = run_of(name)

    def back(state: State) -> State:
        return -state[0], -state[1], -state[3], -state[2]

    with mp.workdps(80):
        images = [back(state) for state in mirror.states]
    assert largest_difference(Reference(run.states, []), Reference(images, [])) < mpf(10) ** -50
    sides = {"right": "left", "left": "right"}
    for event, image in zip(run.events, mirror.events, strict=True):
        what, side = image.kind.split("_")
        assert event.kind == f"{what}_{sides[side]}"


@pytest.mark.parametrize(
    ("setup", "start"),
    [
        (rig(Wall(1.1, 0.1), None), REST),
        (rig(Wall(-0.1, 0.1), None), REST),
        (rig(Wall(0.5, -0.1), None), REST),
        (rig(Wall(0.5, 0.1), None), (0.0, 0.0, 0.01, 0.0)),
        (rig(PRELOADED, None), REST),
    ],
)
def test_the_impossible_is_refused(setup: Rig, start: tuple[float, ...]) -> None:
    with pytest.raises(ValueError):
        integrate(setup, *SHAKEN, start, 1)
