"""Series by code that is made for an assembly, against those of `terms`."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.engine.assembly.curved import emitted
from vibroimpact.engine.compiler import PLAIN

SHAKING = {
    "sine": vi.Harmonic(2.0, 1.6, 0.3),
    "harmonics": vi.Periodic(1.6, [2.0, 0.7], [0.1, 0.8]),
    "record": vi.Record(np.sin(np.arange(400) * 0.2) + np.cos(np.arange(400) * 0.33), 0.02),
}


def rig(n: int, shaking: str, stop: Any, between: Any = None) -> vi.Rig:
    names = ["ground", *(f"m{i}" for i in range(n))]
    links = {}
    for i, (left, right) in enumerate(pairwise(names)):
        law = vi.Isolator(150.0 - i, 0.6)
        if i % 3 == 0:
            law = vi.PolynomialIsolator(120.0, 0.5, 2e4, 3e6 if i == 3 else 0.0)
        links[f"l{i}"] = vi.Link(left, right, law)
    stops = {"end": vi.Link(names[-1], "ground", stop)}
    if n > 1:
        stops["pair"] = vi.Link(names[-2], names[-1], between or vi.Bumper(3e3, 6.0, 0.03))
    masses = {name: 1.0 + 0.1 * i for i, name in enumerate(names[1:])}
    return vi.Rig(vi.Assembly(masses, links=links, stops=stops), SHAKING[shaking])


BUMPER, WALL = vi.Bumper(2e4, 20.0, 0.01), vi.RigidStop(0.6, 0.012)
RIGS = {
    **{f"{n} masses": rig(n, "sine", BUMPER) for n in (1, 3, 5, 8)},
    "harmonics": rig(3, "harmonics", BUMPER),
    "record": rig(2, "record", BUMPER),
    "a wall": rig(4, "sine", WALL),
    "a Hertzian stop": rig(2, "sine", vi.PowerBumper(1e5, 0.012)),
    "no dashpot": rig(3, "sine", vi.Bumper(2e4, 0.0, 0.01)),
    "a plastic pair": rig(3, "sine", BUMPER, vi.RigidStop(0.0, 0.01)),
}


@pytest.mark.skipif(PLAIN, reason="no code is made without a compiler")
@pytest.mark.parametrize("name", RIGS)
def test_the_motion_is_the_same_without_code(name: str, monkeypatch) -> None:
    shaken = RIGS[name]
    periods = None if name == "record" else 6
    made = []
    shape_of = emitted.shape_of
    monkeypatch.setattr(emitted, "shape_of", lambda one: made.append(shape_of(one)) or made[-1])
    with_code = vi.simulate(shaken, periods)
    assert made[0] is not None
    monkeypatch.setattr(emitted, "shape_of", lambda one: None)
    without = vi.simulate(shaken, periods)
    for one in ("displacement", "velocity", "acceleration"):
        size = np.abs(without[one]).max()
        assert np.abs(with_code[one] - without[one]).max() < 1e-10 * size
    assert with_code.sizes["event"] == without.sizes["event"] > 0


@pytest.mark.skipif(PLAIN, reason="no code is made without a compiler")
def test_disturbances_grow_the_same_without_code(monkeypatch) -> None:
    shaken = RIGS["3 masses"]

    def exponents() -> Any:
        return vi.lyapunov_exponents(shaken, [1.6], 6, transient=0)["exponents"].values

    with_code = exponents()
    monkeypatch.setattr(emitted, "shape_of", lambda one: None)
    assert np.abs(with_code - exponents()).max() < 1e-9 * np.abs(with_code).max()
