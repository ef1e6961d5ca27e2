"""Motions through records, drawn."""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.figures import record_history

RIG = vi.Oscillator(2.0, vi.Isolator(8.0, 0.8), vi.RigidStop(0.5, 0.2), vi.Bumper(90.0, 2.0, 0.1))
RECORD = vi.Record(3.0 * np.sin(0.3 * np.arange(100)), 0.1)


def test_the_record_lies_above_the_response() -> None:
    data = vi.simulate(RIG, RECORD, tail=2.0)
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
    assert words == ["gaps", "right contact", "left contact", "impact"]
    assert "acceleration" in axes[0].get_ylabel()
    assert axes[3].get_xlabel() == "time (s)"


def test_other_motions_are_refused() -> None:
    for data in (
        vi.simulate(RIG, vi.Harmonic(1.0, 0.5), 2),
        vi.simulate(RIG, RECORD, samples=0),
    ):
        with pytest.raises(vi.InputError, match=r"^motion: this is no motion through a record; "):
            record_history(data)
