"""Valid arguments of every public function, cheap to run, and nonsense to put in their places."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from decimal import Decimal
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

import vibroimpact as vi
from formula_stops import formula_stops

Call = tuple[Callable[..., Any], dict[str, Any]]

LONG = "x" * 100_000

NONSENSE: dict[str, Any] = {
    "None": None,
    "empty text": "",
    "text": "nonsense",
    "long text": LONG,
    "control characters": "a\x00b\nc\x1b[31m",
    "lone surrogate": "\ud800",
    "NaN": np.nan,
    "infinity": np.inf,
    "minus one": -1,
    "zero": 0,
    "half": 0.5,
    "tiny": 1e-320,
    "huge": 1e308,
    "huge whole number": 10**400,
    "large whole number": 10**12,
    "complex": 1 + 2j,
    "decimal": Decimal("sNaN"),
    "true": True,
    "bytes": b"abc",
    "empty list": [],
    "list of lists": [[1.0, 2.0], [3.0]],
    "list of None": [None, None],
    "long range": range(10**9),
    "matrix": np.eye(30),
    "array of no dimension": np.array(5.0),
    "empty array": np.array([]),
    "array of texts": np.array(["a", "b"]),
    "array of dates": np.array(["2020-01-01"], dtype="datetime64[s]"),
    "mapping": {"a": 1},
    "mapping with odd keys": {None: None, 1: LONG},
    "set": {1, 2},
    "function": lambda *args, **kwargs: None,
    "class": int,
    "object": object(),
    "empty dataset": xr.Dataset(),
    "other dataset": xr.Dataset({"a": ("b", [1.0])}, attrs={"kind": "nothing"}),
    "table": pd.DataFrame({"a": [1]}),
    "path": Path("/nowhere/at/all"),
    "folder": Path("/"),
}
"""What a user may put anywhere by mistake."""


def rig() -> vi.Oscillator:
    """A rig whose motions settle soon."""
    return vi.Oscillator(
        1.0,
        vi.Isolator(100.0, 4.0),
        right=vi.Bumper(1000.0, 5.0, 0.02),
        left=vi.Bumper(1000.0, 5.0, 0.02),
    )


def shaken() -> vi.Harmonic:
    """What shakes it."""
    return vi.Harmonic(2.0, 1.5)


def record() -> vi.Record:
    """A short record."""
    return vi.Record(3.0 * np.sin(np.arange(50) * 0.2), 0.02)


@cache
def motion() -> xr.Dataset:
    return vi.simulate(vi.Rig(rig(), shaken()), 20, samples=32)


@cache
def orbit() -> xr.Dataset:
    return vi.orbit(vi.Rig(rig(), shaken()))


@cache
def fold() -> xr.Dataset:
    """Where the large motion of a published rig ends."""
    case = vi.laboratory.case("B2-G1-A3")
    large = vi.coexisting_motions(case, frequency=2.6, random=0).isel(attractor=0)
    followed = vi.branch(
        case, large, frequency=2.6, vary={"frequency": (2.55, 2.7)}, most_points=100
    )
    (at, *_) = (followed["bifurcation_kind"].values == "fold").nonzero()[0]
    return followed.isel(bifurcation=at)


@cache
def demanded() -> xr.Dataset:
    records = [vi.Record(factor * record().acceleration, 0.02) for factor in (0.7, 1.0, 1.4, 2.0)]
    return vi.demands(rig(), records, [0.05, 0.1, 0.2, 0.3, 0.5])


@cache
def fit() -> xr.Dataset:
    data = [vi.simulate(vi.Rig(rig(), vi.Harmonic(2.0, f)), 3, samples=24) for f in (1.2, 1.6)]
    return vi.identify(
        rig(), data, {"isolator.stiffness": "90 N/m"}, starts=1, tried=1, profiles=False
    )


_SMALL: dict[str, Any] = {"max_cycles": 50, "max_events": 200}
_SWEEP: dict[str, Any] = {
    "frequencies": [1.5],
    "directions": ("forward",),
    "start": None,
    "phase": 0.0,
    "tolerance": 1e-6,
    **_SMALL,
    "window": 5,
    "outputs": None,
    "threads": 1,
}


def calls(folder: Path) -> Mapping[str, Call]:
    """A valid call of each public name that can be called, with every argument given."""
    whole = vi.Rig(rig(), shaken())
    two = {"rig": whole, "frequency": 1.5}
    swept = {"rig": vi.Rig(rig(), 2.0)}
    near = [-0.01, 0.01]
    made: dict[str, dict[str, Any]] = {
        "Assembly": {
            "masses": {"a": 1.0},
            "links": {"spring": vi.Link("ground", "a", vi.Isolator(1.0, 0.1))},
            "stops": {"wall": vi.Link("a", "ground", vi.RigidStop(0.5, 0.1))},
            "forces": {"a": 1.0},
            "damping": vi.ModalDamping(0.05),
            "units": "none",
            "matrices": None,
        },
        "Assembly.from_matrices": {
            "mass": [[1.0]],
            "damping": [[0.1]],
            "stiffness": [[2.0]],
            "names": ["a"],
            "influence": [1.0],
            "stops": {"wall": vi.Link("a", "ground", vi.RigidStop(0.5, 0.1))},
            "links": {"spring": vi.Link("ground", "a", vi.Isolator(1.0, 0.1))},
            "forces": {"a": 1.0},
            "units": "none",
            "folder": folder,
        },
        "BilinearIsolator": {
            "elastic_stiffness": 100.0,
            "post_yield_stiffness": 50.0,
            "yield_force": 1.0,
            "damping": 1.0,
            "damping_exponent": 1.0,
        },
        "BoucWenIsolator": {
            "elastic_stiffness": 100.0,
            "post_yield_stiffness": 50.0,
            "yield_force": 1.0,
            "damping": 1.0,
            "exponent": 1,
            "beta": 0.5,
            "gamma": 0.5,
            "damping_exponent": 1.0,
        },
        "Bumper": {"stiffness": 1.0, "damping": 1.0, "gap": 0.1},
        **{
            type(one).__name__: dict(one)
            for one in formula_stops(1.0, 0.1).values()
            if type(one).__name__ in vi.__all__
        },
        "Dimensionless": {"damping_ratio": 0.1, "right": None, "left": None},
        "ExponentialIsolator": {
            "reversal_stiffness": 100.0,
            "final_stiffness": 50.0,
            "decay": 30.0,
            "damping": 1.0,
            "hardening": 0.0,
            "hardening_force": 1.0,
            "damping_exponent": 1.0,
        },
        "FrictionIsolator": {
            "stiffness": 1.0,
            "damping": 1.0,
            "friction": 0.1,
            "damping_exponent": 1.0,
        },
        "Harmonic": {
            "amplitude": 1.0,
            "frequency": 1.0,
            "phase": 0.0,
            "of": "acceleration",
            "on": None,
        },
        "Isolator": {"stiffness": 1.0, "damping": 1.0, "damping_exponent": 1.0},
        "JankowskiBumper": {"stiffness": 1.0, "gap": 0.1, "restitution": 0.5, "mass": 1.0},
        "ZenerBumper": {
            "stiffness": 1.0,
            "relaxing_stiffness": 1.0,
            "damping": 0.1,
            "gap": 0.1,
        },
        "Link": {"left": "a", "right": "b", "law": vi.Isolator(1.0, 0.1)},
        "ModalDamping": {"ratio": [0.1, 0.2]},
        "RayleighDamping": {"mass_factor": 0.1, "stiffness_factor": 0.01},
        "Law": {"formula": "k*u + c*v", "gap": None, "k": 100.0, "c": 1.0},
        "Output": {"function": "max(velocity)", "units": "m/s", "long_name": "top speed"},
        "Oscillator": {
            "mass": 1.0,
            "isolator": vi.Isolator(1.0, 0.1),
            "right": vi.RigidStop(0.5, 0.1),
            "left": None,
            "force": 0.0,
            "units": "none",
        },
        "Periodic": {
            "frequency": 1.0,
            "amplitudes": [1.0, 2.0],
            "phases": [0.0, 1.0],
            "phase": 0.0,
            "of": "acceleration",
            "on": None,
        },
        "PolynomialIsolator": {
            "stiffness": 1.0,
            "damping": 1.0,
            "cubic": 1.0,
            "quintic": 1.0,
            "damping_exponent": 1.0,
        },
        "PowerBumper": {
            "stiffness": 1.0,
            "gap": 0.1,
            "exponent": 1.5,
            "dissipation": None,
            "restitution": 0.5,
            "relation": "exact",
        },
        "Record": {"acceleration": [0.0, 1.0, 0.0], "step": 0.01},
        "Record.read": {"path": folder / "record.csv"},
        "Record.from_displacement": {
            "displacement": 1e-3 * np.sin(np.arange(200) * 0.1),
            "step": 0.01,
        },
        "Rig": {"system": rig(), "shaking": 1.0, "frequency": 1.5, "name": "mine"},
        "RigidStop": {"restitution": 0.5, "gap": 0.1},
        "State": {
            "displacement": 0.0,
            "velocity": 0.0,
            "phase": None,
            "contact": None,
            "isolator": 0.0,
            "deformation": None,
            "memory": None,
            "touching": None,
        },
        "Thresholds": {"prominence": 0.02, "extent": 0.08, "touch": 0.1, "deformation": 0.1},
        "basin_stability": {
            **two,
            **_SMALL,
            "displacement": near,
            "velocity": near,
            "vary": {"frequency": [1.5]},
            "states": 4,
            "seed": 0,
            "threads": 1,
            "where": "threads",
            "progress": None,
        },
        "basins": {
            **two,
            **_SMALL,
            "displacement": near,
            "velocity": near,
            "plane": None,
            "start": None,
            "nodes": 3,
            "refine": 0,
            "deformation": None,
            "isolator": 0.0,
            "threads": 1,
            "where": "threads",
            "progress": None,
        },
        "bifurcation_curve": {
            "rig": vi.laboratory.case("B2-G1-A3"),
            "frequency": fold()["bifurcation_value"].item(),
            "start": fold(),
            "vary": {"frequency": (2.0, 3.0), "amplitude": ("0.03 g", "0.06 g")},
            "most_points": 5,
            "progress": None,
        },
        "bifurcation_diagram": {
            **two,
            **_SMALL,
            "vary": {"frequency": (1.4, 1.6)},
            "steps": 2,
            "directions": ("up",),
            "starts": None,
            "random": 0,
            "seed": 0,
            "section": "stroboscopic",
            "log": False,
            "points": 5,
            "exponent_cycles": 10,
            "tolerance": 1e-6,
            "threads": 1,
            "where": "threads",
            "outputs": None,
            "progress": None,
        },
        "branch": {
            **two,
            "start": orbit(),
            "vary": {"frequency": (1.49, 1.51)},
            "period": None,
            "most_points": 4,
            "outputs": None,
            "progress": None,
        },
        "chain": {
            "masses": [1.0, 2.0],
            "stiffnesses": [3.0, 4.0],
            "damping_ratio": 0.05,
            "damping": "rayleigh",
            "stops": {"wall": vi.Link("floor_2", "ground", vi.RigidStop(0.5, 0.1))},
            "forces": {"floor_1": 0.1},
            "rayleigh_modes": (1, 2),
            "units": "none",
        },
        "modes": {"rig": vi.chain([1.0, 2.0], [3.0, 4.0])},
        "classify_scenario": {
            **swept,
            "frequencies": [1.3, 1.4, 1.5, 1.6],
            "thresholds": None,
            "max_cycles": 50,
            "threads": 1,
            "progress": None,
        },
        "coexisting_motions": {
            **two,
            **_SMALL,
            "frequencies": [1.5],
            "starts": None,
            "random": 1,
            "seed": 0,
            "window": 5,
            "exponent_cycles": 10,
            "progress": None,
        },
        "compare_fits": {"fits": {"a": fit(), "b": fit()}},
        "contacts": {"motion": motion(), "grazing": 0.001},
        "demands": {
            "rig": rig(),
            "records": [record()],
            "scales": [1.0],
            "intensity": "factor",
            "vary": None,
            "tail": None,
            "max_events": 200,
            "store": None,
            "block": 4,
            "threads": 1,
            "where": "threads",
            "progress": None,
        },
        "design_chart": {
            "rig": rig(),
            "records": record(),
            "vary": {"gap": [0.01, 0.02]},
            "limits": None,
            "fractile": 1.0,
            "step": 0.02,
            "tail": None,
            "threads": 1,
            "where": "threads",
            "progress": None,
        },
        "ensemble": {
            "rig": vi.Rig(rig(), 2.0),
            "distributions": {"gap": "uniform:0.01:0.03"},
            "response": _response,
            "draws": 4,
            "method": "sobol",
            "seed": 0,
            "block": None,
            "progress": None,
        },
        "exceedance": {"demands": demanded(), "quantity": "peak_displacement", "limit": 0.01},
        "fit_report": {
            "result": fit(),
            "folder": folder,
            "name": "fit",
            "comparison": None,
            "figure": "png",
        },
        "fitted_rig": {"result": fit(), "test": None},
        "floor_record": {"motion": _shaken_by_record(), "mass": None},
        "fractiles": {
            "demands": demanded(),
            "quantity": "peak_displacement",
            "shares": [0.5],
        },
        "fragility": {
            "demands": demanded(),
            "quantity": "peak_displacement",
            "limit": 0.02,
            "confidence": 0.9,
        },
        "from_dimensionless": {
            "stiffness_ratio": 10.0,
            "gap": 0.5,
            "relaxation_time": 0.01,
            "damping_ratio": 0.05,
            "mass": 1.0,
            "stiffness": 1.0,
            "amplitude": 1.0,
        },
        "identify": {
            "rig": rig(),
            "data": motion(),
            "free": {"isolator.stiffness": "90 N/m"},
            "each": (),
            "ties": None,
            "priors": None,
            "noise": None,
            "robust": True,
            "confidence": 0.95,
            "starts": 1,
            "tried": 1,
            "profiles": False,
            "draws": 0,
            "posterior": 0,
            "window": None,
            "steady": False,
            "seed": 0,
            "threads": 1,
            "progress": None,
        },
        "impact_section": {"motion": motion()},
        "laboratory.case": {"code": "B2-G1-A3"},
        "least_acceleration": {
            "rig": rig(),
            "records": record(),
            "vary": {"gap": (0.01, 0.02), "isolator.stiffness": (500.0, 1000.0)},
            "gap": None,
            "limits": None,
            "fractile": 1.0,
            "step": 0.02,
            "tail": None,
            "seed": 0,
            "threads": 1,
            "where": "threads",
            "progress": None,
        },
        "load": {"path": folder / "motion.nc", "group": None},
        "lyapunov_exponents": {
            "rigs": vi.Rig(rig(), 2.0),
            "frequencies": [1.5],
            "cycles": 20,
            "transient": 5,
            "start": None,
            "vary": None,
            "count": 2,
            "phase": 0.0,
            "max_events": 200,
            "threads": 1,
            "where": "threads",
            "progress": None,
        },
        "manifolds": {
            **two,
            **_SMALL,
            "saddles": None,
            "displacement": near,
            "velocity": near,
            "period": 1,
            "spacing": 0.1,
            "longest": 1.0,
            "curve_cycles": 2000,
            "threads": 1,
            "progress": None,
        },
        "next_test": {
            "result": fit(),
            "frequencies": [1.4, 1.5],
            "amplitudes": [2.0],
            "test": None,
            "noise": None,
            "margin": 0.02,
        },
        "for_each_rig": {"function": _response, "threads": 1},
        "orbit": {**two, "start": None, "period": 1, "samples": 8},
        "progress_bar": {"what": "done", "every": 0.2},
        "read_measurement": {
            "path": folder / "measured.csv",
            "columns": None,
            "units": None,
            "direction": None,
            "group": None,
            "amplitude": None,
            "frequency": None,
            "decimal": None,
        },
        "required_gap": {
            "rig": rig(),
            "vary": None,
            "records": record(),
            "fractile": 1.0,
            "step": 0.02,
            "tail": None,
            "threads": 1,
            "where": "threads",
            "progress": None,
        },
        "resonance_diagram": {
            **swept,
            "vary": {"frequency": (1.45, 1.55)},
            "frequency": None,
            "phase": 0.0,
            "longest": 1,
            "most_branches": 1,
            "most_points": 20,
            "starts": 2,
            "random": 0,
            "seed": 0,
            "basins": (),
            "outputs": None,
            "progress": None,
        },
        "response_spectrum": {
            "record": record(),
            "periods": [0.5, 1.0],
            "damping": 0.05,
            "progress": None,
        },
        "save": {"dataset": motion(), "path": folder / "kept.nc"},
        "show_versions": {},
        "scenario_map": {
            "rig": None,
            "vary": {"gap_ratio": [0.5, 0.6], "stiffness_ratio": [10.0, 12.0]},
            "spacing": None,
            "step": 0.3,
            "refine": 0,
            "thresholds": None,
            "max_cycles": 50,
            "store": None,
            "block": 20,
            "threads": 1,
            "where": None,
            "progress": None,
        },
        "seismic_response": {
            "rig": vi.Rig(rig(), record()),
            "tail": None,
            "max_events": 200,
            "progress": None,
        },
        "sensitivity": {
            "rig": vi.Rig(rig(), 2.0),
            "distributions": {"gap": "uniform:0.01:0.03"},
            "response": _response,
            "quantity": "displacement_max",
            "draws": 4,
            "seed": 0,
            "resamples": 0,
            "block": None,
            "progress": None,
        },
        "simulate": {
            **two,
            "cycles": 3,
            "start": None,
            "samples": 8,
            "tail": None,
            "max_events": 200,
            "progress": None,
        },
        "fourier_spectrum": {"motion": motion(), "highest": 10.0},
        "steady": {
            **two,
            **_SMALL,
            "start": None,
            "samples": 8,
            "window": 5,
            "tolerance": 1e-6,
            "exponent_cycles": 10,
            "progress": None,
        },
        "stroboscopic_section": {"motion": motion(), "phase": 0.0, "cycles": None},
        "sweep": {
            **swept,
            **_SWEEP,
            "progress": None,
        },
        "sweeps": {
            "rigs": vi.Rig(rig(), 2.0),
            **_SWEEP,
            "where": "threads",
            "progress": None,
        },
        "to_dimensionless": {"rig": vi.Rig(rig(), 2.0)},
        "to_table": {"dataset": demanded(), "rows": None},
        "totals": {"motion": motion()},
    }
    return {name: (_public(name), keywords) for name, keywords in made.items()}


def public() -> list[str]:
    """Names of the package that can be called, but for errors."""
    names = [name for name in vi.__all__ if callable(getattr(vi, name))]
    return [n for n in names if not _is_error(getattr(vi, n))]


def parameters(name: str) -> list[str]:
    """The names of a public function's arguments."""
    kinds = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
    entries = inspect.signature(_public(name)).parameters.values()
    return [one.name for one in entries if one.kind in kinds]


def write_files(folder: Path) -> None:
    """Write the files that the calls read."""
    (folder / "report").mkdir(exist_ok=True)
    vi.save(motion(), folder / "motion.nc")
    lines = [f"{0.01 * n:.2f},{0.001 * (n % 7):.4f}" for n in range(60)]
    text = "time (s),displacement (m)\n" + "\n".join(lines) + "\n"
    (folder / "measured.csv").write_text(text)
    (folder / "record.csv").write_text(text.replace("displacement (m)", "acceleration (m/s2)"))


def _is_error(held: Any) -> bool:
    return isinstance(held, type) and issubclass(held, Exception)


def _public(name: str) -> Callable[..., Any]:
    held: Any = vi
    for part in name.split("."):
        held = getattr(held, part)
    return held  # type: ignore[no-any-return]


def _response(drawn: Any) -> xr.Dataset:
    return vi.sweeps(drawn, [1.5], ("forward",), max_cycles=20)


@cache
def _shaken_by_record() -> xr.Dataset:
    return vi.simulate(vi.Rig(rig(), record()), samples=4)
