"""An observer in one file, as a user adds it: the largest power of each stop, and when."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine import flow
from vibroimpact.engine.channels import (
    DEFORMATION,
    FORCE,
    LENGTH,
    SERIES,
    SINCE,
    extremes,
    piece_buffer,
    series_buffer,
)
from vibroimpact.engine.entry import entry
from vibroimpact.engine.event_loop import observed
from vibroimpact.engine.jit import kernel
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.opening import open_entry
from vibroimpact.engine.state import T, state_buffer
from vibroimpact.model import equilibrium
from vibroimpact.response.assembly_state import assembly_vector
from vibroimpact.response.engine_input import engine_state
from vibroimpact.response.engine_system import engine_rig


@kernel
def see_power(plan, before, ended, after, notes):
    """Note the range of the power that each stop takes up, and when the largest.

    The first note is the time of the section, then come three of each stop. A rigid stop takes up
    its energy at once: its force here has no impulses.
    """
    piece, force, depth, power = piece_buffer(), series_buffer(), series_buffer(), series_buffer()
    more = flow.first_piece(plan, before, ended, piece)
    while more:
        for stop in range(flow.stops(plan)):
            order = flow.series(plan, before, piece, FORCE, stop, force)
            flow.series(plan, before, piece, DEFORMATION, stop, depth)
            for j in range(SERIES):
                power[j] = 0.0
            for j in range(order + 1):
                for k in range(order - j):
                    power[j + k] += force[j] * depth[k + 1] * (k + 1) / piece[LENGTH]
            at = 1 + 3 * stop
            least, most, _, tau = extremes(power, order, notes[at], notes[at + 1])
            if most > notes[at + 1]:
                notes[at + 2] = notes[0] + ended[T] + piece[SINCE] + tau * piece[LENGTH]
            notes[at], notes[at + 1] = least, most
        more = flow.next_piece(plan, before, piece)


largest_power = observed(see_power)


@entry("i8(f8[::1], f8, f8, f8, f8[::1], i8, f8[::1])", "measured")
def find_power(memory, rig, amplitude, frequency, phase, state, cycles, notes):
    here, count, most_events = state_buffer(), 0, 1000
    plan, s, c, period, _ = open_entry(
        memory, rig, amplitude, frequency, phase, pointer(state), here
    )
    for cycle in range(cycles):
        notes[0] = cycle * period
        events = largest_power(plan, here, s, c, period, most_events, pointer(notes))
        if events > most_events:
            return -1
        count += events
    return count


CYCLES = 8
SHAKING = vi.Harmonic("2.5 m/s2", 0.4, 0.3)
BUMPER, WALL = vi.Bumper(20.0, 0.4, 0.4), vi.RigidStop(0.6, 0.3)


def two_masses(link: vi.Isolator, stop: vi.Bumper | vi.HertzStop) -> vi.Assembly:
    return vi.Assembly(
        {"a": 1.0, "b": 0.5},
        {"k": vi.Link("ground", "a", link), "c": vi.Link("a", "b", vi.Isolator(3.0, 0.1))},
        {"pound": vi.Link("a", "b", stop), "wall": vi.Link("a", "ground", WALL)},
    )


SYSTEMS = {
    "bumpers": vi.Oscillator(1.0, vi.Isolator(4.0, 0.1), BUMPER, BUMPER.replace(gap=0.2)),
    "pressed on both sides": vi.Oscillator(
        1.0, vi.Isolator(4.0, 0.1), BUMPER.replace(gap=-0.1), BUMPER.replace(gap=0.05)
    ),
    "cubic": vi.Oscillator(1.0, vi.PolynomialIsolator(4.0, 0.1, cubic=1.0), WALL, BUMPER),
    "two masses": two_masses(vi.Isolator(4.0, 0.1), BUMPER),
    "two masses, cubic": two_masses(vi.PolynomialIsolator(4.0, 0.1, cubic=1.0), BUMPER),
}


def law_and_closing_speed(system, motion, stop):
    v = motion["velocity"]
    if isinstance(system, vi.Oscillator):
        return getattr(system, stop), v if stop == "right" else -v
    ends = system.stops[stop]
    speeds = [v.sel(mass=end) if end != "ground" else 0.0 for end in (ends.left, ends.right)]
    return ends.law, speeds[0] - speeds[1]


@pytest.mark.parametrize("name", SYSTEMS)
def test_largest_power_of_a_stop_is_that_of_dense_samples(name: str) -> None:
    system = SYSTEMS[name]
    rig = vi.Rig(system, SHAKING)
    place = assembly_vector if isinstance(system, vi.Assembly) else engine_state
    # An oscillator has a place for each side.
    places = 2 if isinstance(system, vi.Oscillator) else len(system.stops)
    state, notes = place(system, equilibrium(system)), np.zeros(1 + 3 * places)
    numbers = engine_rig(rig)
    events = find_power(
        numbers, SHAKING.amplitude, SHAKING.frequency, SHAKING.phase, state, CYCLES, notes
    )
    motion = vi.simulate(rig, CYCLES, samples=5_000)
    assert events == len(motion["event_time"]) > CYCLES
    for i, stop in enumerate(motion["stop"].values):
        law, closing = law_and_closing_speed(system, motion, stop)
        power = np.zeros(len(motion["time"]))
        least, most, at = notes[1 + 3 * i : 4 + 3 * i]
        if not law.rigid:
            force = law.force(motion["deformation"].sel(stop=stop), closing)
            power = (force * closing * (motion["clearance"].sel(stop=stop) <= 0.0)).values
            assert power.max() > 0.0 > power.min()
            near = abs(motion["time"].values - at) < 1.01 * motion["time"].values[1]
            assert power[near].max() == power.max(), stop
        low, high = power.min(), power.max()
        assert least - 1e-12 <= low <= least + 1e-2 * (high - low), stop
        assert most - 1e-2 * (high - low) <= high <= most + 1e-12, stop
