"""Branches of orbits: a forced oscillator between stops, and a full resonance diagram."""

import math

import xarray as xr

import vibroimpact as vi
from benchmarks.peers import auto07
from benchmarks.report import Table, met, targets
from benchmarks.rounds import Spread, interleave

_ROUNDS = 11
_BRANCH = 0.02
_DIAGRAM = 2.0
_AUTO = ((1e-3, 60, 0.05), (1e-5, 400, 0.005))
_TURN = 2.0 * math.pi


def branches() -> Table:
    """Measure `vi.branch` of a known problem, and `vi.resonance_diagram` of a published rig."""
    stop = vi.Bumper(10.0, 0.0, 1.0)
    rig = vi.Oscillator(1.0, vi.Isolator(1.0, 0.1), stop, stop)
    excitation = vi.Harmonic(0.2, 2.0 / _TURN)
    case = vi.laboratory.case("B3-10mm-A3")

    def branch() -> xr.Dataset:
        return vi.branch(vi.Rig(rig, excitation), vary={"frequency": (1.0 / _TURN, 2.5 / _TURN)})

    def diagram() -> xr.Dataset:
        return vi.resonance_diagram(
            vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, 1.0)), {"frequency": (0.3, 4.0)}
        )

    table = targets("Branches of orbits, warm")
    seconds = interleave({"branch": branch, "diagram": diagram}, _ROUNDS)
    data = branch()
    spread = Spread.of(seconds["branch"])
    table.add(
        "elastic stops, whole branch with both limits, ms",
        spread.text(1e3),
        f"under {1e3 * _BRANCH:g} ms",
        met(spread.median < _BRANCH),
    )
    spread = Spread.of(seconds["diagram"])
    table.add(
        "B3-10mm-A3, 0.3 to 4 Hz, all branches to period 4, s",
        spread.text(),
        f"under {_DIAGRAM:g} s",
        met(spread.median < _DIAGRAM),
    )
    kinds = data["bifurcation_kind"].values
    folds = _TURN * data["bifurcation_value"].values[kinds == "fold"]
    grazings = _TURN * data["bifurcation_value"].values[kinds == "grazing"]
    table.notes.append(
        f"The branch with elastic stops has {data.sizes['point']} orbits. Its upper fold is at "
        f"Ω = {folds.max():.9f}, and its grazing is at Ω = {grazings.max():.12f}. No contact is "
        "smoothed."
    )
    ours = Spread.of(seconds["branch"]).median
    for smoothing, intervals, longest in _AUTO:
        auto = auto07.continued(smoothing, intervals, longest, _ROUNDS)
        if auto is None:
            table.notes.append("AUTO-07p with gfortran is not installed here: not run beside.")
            break
        took = Spread.of(auto.seconds)
        table.add(
            f"the stops by AUTO-07p, tanh width {smoothing:g}, {intervals} intervals, ms",
            took.text(1e3),
            "",
            "",
        )
        table.add("the same, times ours", f"{took.median / ours:.1f}", "", "")
        table.notes.append(
            f"AUTO with tanh width {smoothing:g}: upper fold {max(auto.folds):.5f}, lower fold "
            f"{min(auto.folds):.5f} (off by {abs(max(auto.folds) - folds.max()):.0e} and "
            f"{abs(min(auto.folds) - folds.min()):.0e})."
        )
    return table
