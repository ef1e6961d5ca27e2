"""Answers of the whole engine, kept in a file and compared with later ones.

    python tests/answers.py keep FILE [RIGS]    before a change
    python tests/answers.py compare FILE        after it: which answers moved, and by how much

Random rigs of all laws under all kinds of shaking, random assemblies, the published campaign,
branches, exponents, basins, a map and an earthquake. It is not a test: the bits are those of one
machine, and a change may have a reason to move them. With `VIBROIMPACT_ENGINE=numba` and
`NUMBA_CPU_NAME=x86-64-v3` in one of the two runs, it compares the machine code that is shipped.

The points of a branch move along it by some 1e-10 when a last bit differs, for a branch is steered
by a difference quotient, which multiplies rounding by 1e7; they stay on the same curve to rounding.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

sys.path[:0] = [str(Path(__file__).parent)]

import vibroimpact as vi  # noqa: E402
from properties.random_assemblies import random_assembly  # noqa: E402
from properties.random_laws import any_shaking, random_rig  # noqa: E402

RIGS = 400
CYCLES = 20
SEED = 1


def answers(rigs: int) -> Iterator[tuple[str, xr.Dataset]]:
    """Yield datasets by name."""
    for i in range(rigs):
        rng = np.random.default_rng((SEED, i))
        oscillator, shaken = random_rig(rng)
        if i % 2:
            shaken = any_shaking(rng, shaken)
        cycles = None if isinstance(shaken, vi.Record) else CYCLES
        motion = vi.simulate(vi.Rig(oscillator, shaken), cycles, samples=16, max_events=3000)
        yield f"motion {i}", motion
        if motion["status"] == 0:
            yield f"totals {i}", vi.totals(motion)
            yield f"contacts {i}", vi.contacts(motion)
        try:
            masses, shaking = random_assembly(np.random.default_rng([SEED, i]))
        except vi.InputError:  # it has no equilibrium
            continue
        yield (
            f"masses {i}",
            vi.simulate(vi.Rig(masses, shaking), CYCLES // 4, samples=16, max_events=3000),
        )
    for case in vi.laboratory.campaign():
        yield f"sweep {case.code}", vi.sweep(case, case.frequencies[::5])
    for code in ("B2-G1-A3", "B3-10mm-A3"):
        yield f"branch {code}", vi.branch(code, vary={"frequency": (1.0, 3.0)}, frequency=1.0)
    chaotic = "B3-10mm-A3"
    yield "exponents", vi.lyapunov_exponents([chaotic], [0.9, 1.06, 2.0], 400)
    yield "basins", vi.basins(chaotic, (-0.03, 0.03), (-0.2, 0.2), nodes=40, frequency=0.7)
    ratios = {
        "stiffness_ratio": np.geomspace(2.0, 40.0, 4),
        "gap_ratio": np.linspace(0.0, 0.8, 4),
    }
    yield "map", vi.scenario_map(None, ratios)
    noise = np.random.default_rng(SEED).normal(size=400)
    record = vi.Record(noise, 0.05)
    yield "earthquake", vi.seismic_response(vi.Rig(vi.laboratory.case(chaotic).oscillator, record))


def arrays(rigs: int) -> tuple[dict[str, Any], dict[str, float]]:
    """Return all numbers of the answers, by names of dataset and variable, and their sizes."""
    numbers, sizes = {}, {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name, data in answers(rigs):
            for key, variable in data.variables.items():
                if variable.dtype.kind in "fiub":
                    numbers[f"{name}: {key}"] = variable.values
                    sizes[f"{name}: {key}"] = size(data, variable)
    return numbers, sizes


def size(data: xr.Dataset, variable: xr.Variable) -> float:
    """Return the largest value of a dataset in the unit of one of its variables.

    The eccentricity of a symmetric motion is the rounding of its displacement.
    """
    unit = variable.attrs.get("units")
    alike = [variable]
    if unit not in (None, "1"):
        alike += [one for one in data.variables.values() if one.attrs.get("units") == unit]
    return max(
        float(np.abs(one.values[np.isfinite(one.values)]).max(initial=0.0))
        for one in alike
        if one.dtype.kind in "fiub"
    )


def compare(before: dict[str, Any], now: dict[str, Any], sizes: dict[str, float]) -> list[str]:
    """Return a line for each kind of answer: how many are the same, and how far others moved."""
    kinds: dict[str, list[tuple[float, str]]] = {}
    for name in sorted({*before, *now}):
        kind = name.partition(" ")[0]
        by = _moved(before.get(name), now.get(name), sizes.get(name, 0.0))
        kinds.setdefault(kind, []).append((by, name))
    lines = []
    for kind, moved in kinds.items():
        same = sum(by == 0.0 for by, _ in moved)
        most, where = max(moved)
        lines.append(
            f"{kind}: {same} of {len(moved)} bit-identical"
            + (f"; most: {most:.1e} of the size, {where}" if most else "")
        )
    return lines


def _moved(before: Any, now: Any, size: float) -> float:
    """Largest difference, as a share of the size; infinite where shapes differ."""
    if before is None or now is None or before.shape != now.shape:
        return float("inf")
    if np.array_equal(before, now, equal_nan=before.dtype.kind == "f"):
        return 0.0
    before, now = before.astype(float), now.astype(float)
    if (np.isfinite(before) != np.isfinite(now)).any():
        return float("inf")
    finite = np.isfinite(before)
    return float(np.abs(before - now)[finite].max(initial=0.0) / (size or 1e-300)) or 5e-324


if __name__ == "__main__":
    command, file, *rest = sys.argv[1:]
    if command == "keep":
        count = int(rest[0]) if rest else RIGS
        np.savez_compressed(file, rigs=count, **arrays(count)[0])
    else:
        kept = dict(np.load(file))
        print(*compare(kept, *arrays(int(kept.pop("rigs")))), sep="\n")
