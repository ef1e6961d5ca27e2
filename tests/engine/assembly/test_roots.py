"""First roots against sampling in extended precision: near-touches, with memory and without."""

from __future__ import annotations

from math import comb
from typing import Any

import numpy as np

import samples
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.roots import NONE, first_fall
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.memory import pointer
from vibroimpact.engine.rigless_entry import rigless_entry


@rigless_entry("f8(f8[::1], f8, f8, f8[::1])")
def find(placeholder: Any, b: Vector, d: float, x: float, plan: Vector) -> float:
    return first_fall(pointer(b), d, x, 1.0, 0, 1e-300, pointer(plan))


def buffer() -> Vector:
    plan = np.zeros(at.HEADER + 64 * 17)
    plan[at.ROOM], plan[at.WIDTHS] = at.HEADER, at.HEADER + 64 * 16
    return plan


def basis(x: Any) -> Any:
    """Bernstein's polynomials; powers as products, which is fast in extended precision, too."""
    powers = np.ones((2, at.DEGREE + 1, len(x)), x.dtype)
    powers[:, 1:] = np.stack((x, 1 - x))[:, None]
    powers = np.cumprod(powers, axis=1)
    times = np.array([comb(at.DEGREE, i) for i in range(at.DEGREE + 1)], x.dtype)
    return (times[:, None] * powers[0] * powers[1, ::-1]).T


def test_near_touches() -> None:
    rng = np.random.default_rng(1)
    d = at.DEGREE
    nodes = 0.5 - 0.5 * np.cos(np.pi * (np.arange(d + 1) + 0.5) / (d + 1))
    fit = np.linalg.inv(basis(nodes))
    kinds: dict[tuple[bool, bool], int] = {}
    plan = buffer()
    for _ in range(samples.sample(2500, 200)):
        touch = rng.uniform(0.05, 0.95)
        depth = rng.choice([-1, 1]) * 10.0 ** rng.uniform(-14, -3)
        size, rate = 0.0, 0.0
        if rng.random() < 0.5:
            size, rate = 10.0 ** rng.uniform(-6, 0), 10.0 ** rng.uniform(-1, 3)
        c = rng.normal(size=4) * 0.3
        wave = sum(c[i] * np.cos(i * nodes) for i in range(4))
        wanted = (nodes - touch) ** 2 * np.exp(wave) + depth
        b = fit @ (wanted - size * np.exp(-rate * nodes))
        grid = np.concatenate(
            [
                np.linspace(0, 1, 4001),
                touch + np.linspace(-1, 1, 401) * 3 * np.sqrt(abs(depth)),
                touch + np.linspace(-1, 1, 201) * 1e-3,
            ]
        )
        grid = np.unique(grid.clip(0, 1)).astype(np.longdouble)
        long = basis(grid) @ b.astype(np.longdouble) + size * np.exp(-rate * grid)
        if long[0] <= 0:
            continue
        crossed = np.flatnonzero((long[1:] <= 0) & (long[:-1] > 0))
        root = find(b.copy(), size, rate, plan)
        least = abs(float(long.min()))
        kinds[size > 0, len(crossed) > 0] = kinds.get((size > 0, len(crossed) > 0), 0) + 1
        if root == NONE:
            assert not len(crossed) or least < 3e-15
        elif len(crossed):
            slack = 1e-12 + 3e-15 / np.sqrt(least)
            assert grid[crossed[0]] - slack <= root <= grid[crossed[0] + 1] + slack
        else:
            assert least < 3e-15 * max(1.0, size)
    assert min(kinds.values()) > 30
    assert len(kinds) == 4
    assert plan[at.UNDECIDED] == 0


def test_what_is_zero_everywhere_has_no_root() -> None:
    assert find(np.zeros(16), 0.0, 0.0, buffer()) == NONE


def test_a_zero_by_construction_is_no_root() -> None:
    b = np.arange(16) / 15.0
    assert find(b, 0.0, 0.0, buffer()) == NONE
    assert find(-b, 0.0, 0.0, buffer()) == 0.0
