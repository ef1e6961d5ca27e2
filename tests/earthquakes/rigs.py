"""Rigs of every law and every stop, and records that make them hit, for the tests here."""

from __future__ import annotations

import numpy as np

import vibroimpact as vi

RIGS = {
    "bumpers": vi.Oscillator(
        2.0, vi.Isolator(50.0, 0.8), vi.Bumper(600.0, 3.0, 0.03), vi.Bumper(400.0, 1.5, 0.05)
    ),
    "elastic": vi.Oscillator(2.0, vi.Isolator(50.0, 0.8), None, vi.Bumper(900.0, 0.0, 0.02)),
    "walls": vi.Oscillator(
        2.0, vi.Isolator(50.0, 0.3), vi.RigidStop(0.5, 0.05), vi.RigidStop(0.3, 0.03), force=0.2
    ),
    "preloaded": vi.Oscillator(
        2.0, vi.Isolator(50.0, 0.3), vi.Bumper(500.0, 3.0, -0.02), vi.Bumper(300.0, 1.0, 0.01)
    ),
    "bilinear": vi.Oscillator(
        2.0,
        vi.BilinearIsolator(80.0, 8.0, 1.0, 0.3),
        vi.Bumper(500.0, 3.0, 0.03),
        vi.Bumper(300.0, 1.0, 0.04),
    ),
    "friction": vi.Oscillator(
        2.0,
        vi.FrictionIsolator(10.0, 0.1, 0.6),
        vi.Bumper(500.0, 3.0, 0.03),
        vi.RigidStop(0.5, 0.02),
    ),
    "curved": vi.Oscillator(
        2.0,
        vi.BoucWenIsolator(80.0, 8.0, 1.0, 0.3, 1.0, 0.5, 0.5),
        vi.PowerBumper(5000.0, 0.03, 1.5, 0.3),
        vi.JankowskiBumper(3000.0, 0.03, 0.6, 2.0),
    ),
}


def noise(seed: int, peak: float = 6.0, count: int = 300, step: float = 0.02) -> vi.Record:
    """A made-up strong motion that swells and fades."""
    rng = np.random.default_rng(seed)
    time = np.arange(count) * step
    frequency = np.linspace(0.3, 8.0, 60)
    waves = np.sin(2.0 * np.pi * np.outer(time, frequency) + rng.uniform(0.0, 2.0 * np.pi, 60))
    share = time / time[-1]
    values = waves.sum(axis=1) * np.sin(np.pi * share) ** 2
    return vi.Record(values * (peak / np.abs(values).max()), step)
