"""Rigid stops and preloaded bumpers among the stops: what holds for bumpers holds for all."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

import vibroimpact as vi
from properties.strategies import (
    SAMPLES,
    Motion,
    decades,
    distance,
    examples,
    motions,
    simulated,
    states,
    tame,
)
from properties.test_energy import imbalance
from properties.test_phases import check
from properties.test_restart import CYCLES, end_of_cut_run

ROUNDING = 1e-11
ANY = motions(all_stops=True)


@examples(60)
@given(ANY)
def test_work_is_dissipated_or_stored(motion: Motion) -> None:
    assert imbalance(motion) < 1e-11


@examples(60)
@given(ANY)
def test_phases_lead_on_and_keep_their_sign(motion: Motion) -> None:
    check(motion)


@examples(50)
@given(ANY, st.floats(1e-6, CYCLES * (1 - 1e-6)))
def test_a_run_may_be_cut_anywhere(motion: Motion, cut: float) -> None:
    assert distance(tame(motion, CYCLES), end_of_cut_run(motion, cut)) < ROUNDING


@examples(50)
@given(ANY, st.integers(0), st.floats(0.01, 0.99))
def test_a_run_may_be_cut_inside_a_contact_or_a_rest(
    motion: Motion, which: int, where: float
) -> None:
    data = tame(motion, CYCLES)
    times = data["event_time"].values * motion.excitation.frequency
    touching = np.flatnonzero(data["event_contact"].values[:-1] == 1)
    touching = touching[times[touching + 1] - times[touching] > 1e-5]
    assume(len(touching))
    i = touching[which % len(touching)]
    cut = times[i] + where * (times[i + 1] - times[i])
    assert distance(data, end_of_cut_run(motion, cut)) < ROUNDING


@examples(50)
@given(ANY, st.integers(0), st.sampled_from([-1.0, 0.0, 1.0]))
def test_a_run_may_be_cut_at_an_event(motion: Motion, which: int, towards: float) -> None:
    data = tame(motion, CYCLES)
    times = data["event_time"].values * motion.excitation.frequency
    times = times[times > 1e-5]
    assume(len(times))
    cut = math.nextafter(times[which % len(times)], times[which % len(times)] + towards)
    assume(cut < CYCLES)
    assert distance(data, end_of_cut_run(motion, cut)) < ROUNDING


def test_a_run_may_be_cut_inside_a_chatter() -> None:
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), vi.RigidStop(0.8, -0.4))
    shaken = vi.Harmonic(1.0, 0.08)
    whole = vi.simulate(vi.Rig(rig, shaken), 2, vi.State(-1.0), samples=1)
    at = whole["event_time"].values * shaken.frequency
    # In the middle between impacts, and just beside them, down to the smallest.
    cuts = np.concatenate([0.5 * (at[:-1] + at[1:]), at * (1 - 1e-9), at * (1 + 1e-9)])
    for cut in cuts[(cuts > 0) & (cuts < 2)]:
        half = vi.simulate(vi.Rig(rig, shaken), cut, vi.State(-1.0), samples=0)
        end = vi.simulate(vi.Rig(rig, shaken), 2 - cut, half, samples=0)["final_state"].values
        np.testing.assert_allclose(end[:2], whole["final_state"].values[:2], atol=1e-12)


@examples(50)
@given(ANY)
def test_the_mirrored_rig_moves_mirrored(motion: Motion) -> None:
    data = tame(motion, CYCLES)
    shaken, start = motion.excitation, motion.start
    mirror = Motion(
        motion.oscillator.mirrored(),
        shaken.replace(phase=shaken.phase + math.pi),
        vi.State(-start.displacement, -start.velocity),
    )
    image = states(simulated(mirror, CYCLES, SAMPLES))
    assert distance(data, -image[[0, 1, 3, 2]]) < ROUNDING


@examples(40)
@given(
    motions(least_damping=1e-3, most_damping=0.7, all_stops=True),
    decades(-3, 3),
    decades(-3, 3),
    decades(-3, 3),
)
def test_the_dimensionless_motion_has_no_units(
    motion: Motion, mass: float, stiffness: float, amplitude: float
) -> None:
    data = tame(motion, CYCLES)
    # Of an impact at the start, rounding decides whether the first sample lies behind it.
    assume(not data.sizes["event"] or float(data["event_time"][0]) > 0.0)
    rig, shaken = motion.oscillator, motion.excitation
    plain = vi.to_dimensionless(vi.Rig(rig, shaken.amplitude))
    made = plain.to_physical(mass=mass, stiffness=stiffness, amplitude=amplitude)
    other, acceleration = made.oscillator, made.amplitude
    quicker = other.angular_frequency / rig.angular_frequency
    longer = acceleration / shaken.amplitude / quicker**2
    u, v = motion.start.displacement * longer, motion.start.velocity * longer * quicker
    # A start on a wall stays on it, whatever the rounding.
    if isinstance(other.right, vi.RigidStop):
        u = min(u, other.right.gap)
    if isinstance(other.left, vi.RigidStop):
        u = max(u, -other.left.gap)
    scaled = Motion(
        other,
        vi.Harmonic(acceleration, shaken.frequency * quicker, shaken.phase),
        vi.State(u, v),
    )
    image = states(simulated(scaled, CYCLES, SAMPLES)) / longer
    image[1] /= quicker
    assert distance(data, image) < ROUNDING


@examples(60)
@given(ANY, st.integers(1, 300), st.floats(0.1, 3.0))
def test_samples_only_look(motion: Motion, samples: int, cycles: float) -> None:
    never, once, often = (simulated(motion, cycles, n) for n in (0, 1, samples))
    for data in (once, often):
        np.testing.assert_array_equal(data["final_state"], never["final_state"])
    for name in once.data_vars:
        if str(name).startswith("event"):
            np.testing.assert_array_equal(once[name], often[name])
