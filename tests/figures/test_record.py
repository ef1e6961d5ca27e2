"""Motions through records, drawn."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.figures import hysteresis_cycle, phase_portrait, record_history, time_history

RIG = vi.Oscillator(2.0, vi.Isolator(8.0, 0.8), vi.RigidStop(0.5, 0.2), vi.Bumper(90.0, 2.0, 0.1))
RECORD = vi.Record(3.0 * np.sin(0.3 * np.arange(100)), 0.1)


def test_the_record_lies_above_the_response() -> None:
    data = vi.simulate(vi.Rig(RIG, RECORD), tail=2.0)
    axes = record_history(data)
    assert len(axes) == 4
    lines = [max(ax.get_lines(), key=lambda line: len(line.get_xdata())) for ax in axes]
    factors = (1.0, 1e3, 1.0, 1.0)
    names = ("base_acceleration", "displacement", "acceleration", "velocity")
    for line, name, factor in zip(lines, names, factors, strict=True):
        np.testing.assert_allclose(line.get_xdata(), data["time"])
        np.testing.assert_allclose(line.get_ydata(), factor * data[name].values)
    hits = axes[1].collections
    impacts = int((data["event_contact"].values == 2).sum())
    assert impacts > 0
    assert any(len(one.get_offsets()) == impacts for one in hits)
    words = [text.get_text() for text in axes[1].get_legend().get_texts()]
    assert words == [
        "gaps",
        "left contact",
        "impact",
        "end of the record",
    ]  # a wall is struck, never pressed
    assert "acceleration" in axes[0].get_ylabel()
    assert axes[3].get_xlabel() == "time (s)"


def test_other_motions_are_refused() -> None:
    for data in (
        vi.simulate(vi.Rig(RIG, vi.Harmonic(1.0, 0.5)), 2),
        vi.simulate(vi.Rig(RIG, RECORD), samples=0),
    ):
        with pytest.raises(vi.InputError, match=r"^motion: this is not the response to a record; "):
            record_history(data)


def test_portrait_and_force_loop_of_a_record() -> None:
    """They take it; what is drawn against cycles refuses it and says what does."""
    rig = vi.Oscillator(
        2.0, vi.Isolator(5.0, 0.3), vi.Bumper(60.0, 0.9, 0.1), vi.RigidStop(0.4, 0.1)
    )
    values = np.random.default_rng(5).uniform(-4.0, 4.0, 65)
    motion = vi.simulate(vi.Rig(rig, vi.Record(values, 0.125)), samples=8)
    impact = int(np.flatnonzero(motion["event_contact"].values == 2)[0])
    arrival = float(motion["event_velocity"][impact])
    for draw in (phase_portrait, hysteresis_cycle):
        ax = draw(motion)
        u, v = ax.lines[0].get_data()
        assert len(u) == motion.sizes["time"] + 2 * motion.sizes["event"]
        assert np.isfinite(v).all()
        if draw is phase_portrait:  # an impact turns the velocity round at once
            at = int(np.flatnonzero(v == arrival)[0])
            assert v[at + 1] == -0.4 * arrival
            assert u[at + 1] == u[at]
    with pytest.raises(vi.InputError, match="is the response to a Record, which has no cycles"):
        time_history(motion)
