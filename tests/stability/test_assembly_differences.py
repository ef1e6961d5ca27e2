"""Bifurcations of assemblies against a continuation by differences of motions.

Of orbits, it knows no more than the states after a period: derivatives are central differences.
"""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from literature.comparisons import assemblies as known
from vibroimpact.cli.study import read_study

RESIDUAL = 5e-8
"""Of the condition of a bifurcation, at which the search for it ends: the noise of differences of
1e-8 is 2e-8."""


class Differences(NamedTuple):
    """Orbits of one period near a state in which the stop between its two masses is free or not."""

    rig: vi.Rig
    start: xr.DataArray
    gap: float

    def section(self, x: np.ndarray, frequency: float) -> np.ndarray:
        """u and v of both masses a period later."""
        moved = self.start.copy()
        moved[:4] = x
        if moved[5]:  # it is pressed here
            moved[4] = self.closing(x) - self.gap
        end = vi.simulate(self.rig, 1, moved, samples=0, frequency=frequency)
        return end["final_state"].values[:4]

    def closing(self, x: np.ndarray) -> float:
        (stop,) = self.rig.system.stops.values()
        return float(self.rig.system.closing(stop) @ x[:2])

    def jacobian(self, x: np.ndarray, frequency: float) -> np.ndarray:
        columns = []
        for i, size in enumerate((1e-8, 1e-8, 1e-7, 1e-7)):
            step = np.zeros(4)
            step[i] = size
            ends = [self.section(x + sign * step, frequency) for sign in (1.0, -1.0)]
            columns.append((ends[0] - ends[1]) / (2 * size))
        return np.array(columns).T

    def orbit(self, z: np.ndarray, fixed: int) -> tuple[np.ndarray, np.ndarray]:
        """The orbit (state and frequency) with one of these five numbers, and its Jacobian."""
        free = [i for i in range(5) if i != fixed]
        for _ in range(12):
            x, frequency, change = z[:4], z[4], 1e-7
            apart = self.section(x, frequency) - x
            jacobian = self.jacobian(x, frequency)
            sides = [self.section(x, frequency + sign * change) for sign in (1.0, -1.0)]
            whole = np.column_stack([jacobian - np.eye(4), (sides[0] - sides[1]) / (2 * change)])
            step = np.linalg.solve(whole[:, free], -apart)
            z = z.copy()
            z[free] += step
            if abs(step).max() < 1e-10:
                return z, jacobian
        raise ArithmeticError(f"no orbit with {fixed} = {z[fixed]}")

    def bifurcation(self, kind: str, z: np.ndarray, away: float) -> float:
        """The frequency of a bifurcation near an orbit, by secants from a share away from it."""
        fixed = 4 if kind == "Neimark-Sacker" else 2
        at, residuals = [z[fixed] * (1 + 2 * away), z[fixed] * (1 + away)], list[float]()
        for n in range(12):
            if n >= 2:
                (a, b), (ra, rb) = at[-2:], residuals[-2:]
                at.append(b - rb * (b - a) / (rb - ra))
            z = z.copy()
            z[fixed] = at[n]
            z, jacobian = self.orbit(z, fixed)
            residuals.append(condition(kind, jacobian))
            if abs(residuals[-1]) < RESIDUAL:
                return float(z[4])
        raise ArithmeticError(f"no {kind}: {residuals}")


def condition(kind: str, jacobian: np.ndarray) -> float:
    """What is zero at a bifurcation."""
    if kind == "Neimark-Sacker":
        return float(np.abs(np.linalg.eigvals(jacobian)).max()) - 1.0
    sign = 1.0 if kind == "fold" else -1.0
    return float(np.linalg.det(np.eye(4) * sign - jacobian))


def bifurcations_agree(
    rig: vi.Rig, branch: xr.Dataset, wanted: dict[str, int], near: float, away: float
) -> None:
    """Compare so many of each kind; leave out those with a grazing within a share `near`."""
    (stop,) = rig.system.stops.values()
    values = branch["bifurcation_value"].values
    kinds = branch["bifurcation_kind"].values
    grazing = values[kinds == "grazing"]
    compared = dict.fromkeys(wanted, 0)
    for i, kind in enumerate(kinds):
        clear = all(abs(values[i] / one - 1.0) > near for one in grazing)
        if kind not in wanted or not clear or int(branch["bifurcation_period"][i]) != 1:
            continue
        start = branch["bifurcation_section"].isel(bifurcation=i)
        by = Differences(rig, start, stop.stop.gap)
        z = np.append(start.values[:4], values[i])
        assert condition(str(kind), by.jacobian(z[:4], z[4])) == pytest.approx(0.0, abs=1e-6)
        share = away if kind == "fold" else 2e-6
        assert by.bifurcation(str(kind), z, share) == pytest.approx(values[i], rel=2e-9)
        compared[str(kind)] += 1
    assert compared == wanted


def test_tori_and_folds_of_neighbours_are_those_of_differences() -> None:
    """A fold that a grazing follows within 1e-9 is left out: differences straddle it."""
    path = Path(str(files("vibroimpact.cli").joinpath("study_files/neighbours.toml")))
    rig = read_study(path).rig(path)
    branch = vi.branch(rig, vary={"frequency": (1.5, 4.0)})
    bifurcations_agree(rig, branch, {"Neimark-Sacker": 2, "fold": 3}, 1e-8, 1e-3)


def test_doublings_of_the_period_are_those_of_differences() -> None:
    """Two masses, the first one at a one-sided spring."""
    rig, branch = known.rig_at_one_sided_spring(), known.one_sided_spring()
    wanted = {"Neimark-Sacker": 1, "period doubling": 2, "fold": 1}
    bifurcations_agree(rig, branch, wanted, 1e-8, 1e-3)
