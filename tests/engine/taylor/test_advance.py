"""Taylor steps from event to event: linear rigs as by the tables, all others as by DOP853."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import assume, given

import vibroimpact as vi
from engine.taylor.integrated import integrated
from engine.taylor.rigs import ISOLATORS, SHAKEN, between, followed, pairs, started
from properties.strategies import Motion, examples, motions
from reference.stored_energy import stored_by_stop
from samples import sample
from vibroimpact.engine.motion import FACES, ISOLATOR, U, V
from vibroimpact.engine.one_mass.table import mirror_image
from vibroimpact.engine.state import MODE
from vibroimpact.response.engine_input import engine_state

CYCLES = 8
SEEN = [U, V, ISOLATOR]


@examples(sample(400, 90))
@given(motions(all_stops=True))
def test_linear_rigs_as_by_the_tables(motion: Motion) -> None:
    """Of those that do not blow up small disturbances."""
    rig, shaken, _ = motion
    start = engine_state(rig, motion.start)
    try:
        exact = followed(rig, shaken, CYCLES, start, curved=False)
        others = list(disturbed(rig, shaken, start))
    except AssertionError:  # it chatters
        assume(False)
    unit = rig.angular_frequency
    speeds = [abs(start[V]), abs(exact[V]), shaken.amplitude / shaken.angular_frequency]
    size = max(abs(start[U]), abs(exact[U]), max(speeds) / unit)
    # A stiff bumper makes a velocity of each rounding of the displacement.
    bumpers = [stop for stop in rig.stops.values() if isinstance(stop, vi.Bumper)]
    dashpots = [one.damping / rig.mass for one in bumpers]
    springs = [math.sqrt(one.stiffness / rig.mass) for one in bumpers]
    rate = max([unit, *dashpots, *springs])
    scale = np.array([1.0, 1.0, size, rate * size, size, size, 1.0, np.inf])
    # Wherever it is disturbed on its way, the end differs by hardly more.
    assume(all(np.abs((other - exact) / scale).max() < 1e-8 for other in others))
    end = followed(rig, shaken, CYCLES, start)
    assert np.abs((end - exact) / scale).max() < 1e-13


def disturbed(rig: vi.Oscillator, shaken: vi.Harmonic, start: np.ndarray) -> Iterator[np.ndarray]:
    """The end of the motion shaken a little more, or pushed a little at the end of any cycle."""
    stronger = shaken.replace(amplitude=shaken.amplitude * (1 + 1e-9))
    yield followed(rig, stronger, CYCLES, start, curved=False)
    state = start
    for left in range(CYCLES, 0, -1):
        pushed = state.copy()
        pushed[V] += 1e-9 * max(abs(state[V]), shaken.amplitude / shaken.angular_frequency)
        yield followed(rig, shaken, left, pushed, curved=False)
        state = followed(rig, shaken, 1, state, curved=False)


@pytest.mark.parametrize(
    "isolator", [name for name in ISOLATORS if name not in ("fluid", "friction")]
)
def test_each_isolator_against_dop853(isolator: str) -> None:
    rig = between(isolator, None)
    exact = integrated(*ISOLATORS[isolator].engine_numbers(), SHAKEN, 10)
    end = followed(rig, SHAKEN, 10, started(rig))
    np.testing.assert_allclose(end[SEEN], exact, atol=2e-12)


@pytest.mark.parametrize(("isolator", "stop"), pairs())
def test_a_motion_can_be_cut_anywhere(isolator: str, stop: str) -> None:
    rig = between(isolator, stop)
    whole = followed(rig, SHAKEN, 3, started(rig, 0.1, 0.3))
    for cut in (0.137, 0.5, 1.618, 2.9):
        state = followed(rig, SHAKEN, cut, started(rig, 0.1, 0.3))
        behind = SHAKEN.replace(phase=SHAKEN.phase + math.tau * cut)
        parts = followed(rig, behind, 3 - cut, state)
        np.testing.assert_allclose(parts[:7], whole[:7], atol=1e-12)
        assert parts[MODE] == whole[MODE]


@pytest.mark.parametrize(("isolator", "stop"), pairs())
def test_the_mirror_image_moves_as_the_mirror_image(isolator: str, stop: str) -> None:
    other = "bumper" if stop != "bumper" else "hunt-crossley"
    rig, turned = between(isolator, stop, other), between(isolator, other, stop)
    end = followed(rig, SHAKEN, 3, started(rig, 0.1, 0.3))
    assert end[FACES + 1] >= 0.0
    opposite = SHAKEN.replace(phase=SHAKEN.phase + math.pi)
    image = followed(turned, opposite, 3, started(turned, -0.1, -0.3))
    np.testing.assert_allclose(mirror_image(image), end, atol=1e-12)


STARTS = [(0.45, 2.0), (-0.3, -1.5)]


@pytest.mark.parametrize(("isolator", "stop"), pairs())
def test_passive_laws_never_create_energy(isolator: str, stop: str) -> None:
    """Of a mass left to itself: kinetic energy and that of a spring below all springs there are."""
    rig = between(isolator, stop)
    still = vi.Harmonic(1e-300, 1.0)
    for start in STARTS:
        state = started(rig, *start)
        energies = []
        times = np.linspace(0.05, 6.0, 40)
        for t in times:
            end = followed(rig, still, t, state)
            energies.append(stored(rig, isolator, stop, end))
        first = stored(rig, isolator, stop, state)
        rises = np.diff([first, *energies])
        assert rises.max() <= 1e-13 * first


def stored(rig: vi.Oscillator, isolator: str, stop: str, state: np.ndarray) -> float:
    """Energy (J) of the mass, the isolator's springs and the stops' springs."""
    u, v, z = state[SEEN]
    k, _, law = ISOLATORS[isolator].engine_numbers()
    total = 0.5 * v * v + 0.5 * k * u * u + law.cubic * u**4 / 4.0 + law.quintic * u**6 / 6.0
    if law.sinh:
        total += 2.0 * law.sinh / law.sinh_rate * (math.cosh(law.sinh_rate * u) - 1.0)
    # What yields is a slider behind the spring of the memory.
    total += 0.5 * law.hysteretic * z * z / law.slope
    for side, sign in ((1, 1.0), (2, -1.0)):
        stop_law = rig.right if side == 1 else rig.left
        if isinstance(stop_law, vi.Bumper):
            total += 0.5 * stop_law.stiffness * state[U + 1 + side] ** 2
        elif not isinstance(stop_law, vi.RigidStop) and int(state[MODE]) & side:
            depth = max(sign * u - stop_law.gap, 0.0)
            total += stored_by_stop(stop_law, depth)
    return float(total)
