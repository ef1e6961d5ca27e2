"""Exact, fast dynamics of oscillators that hit deformable stops.

A mass on an isolator between two bumpers, shaken by its base::

    import vibroimpact as vi

    case = vi.laboratory.case("B2-G1-A3")
    curves = vi.sweep(case, case.frequencies)

Names are loaded when first used, so that importing the package takes no time.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from vibroimpact._version import __version__

_HOME = {
    "BilinearIsolator": "model",
    "BoucWenIsolator": "model",
    "Bumper": "model",
    "Dimensionless": "model",
    "ExponentialIsolator": "model",
    "FrictionIsolator": "model",
    "Harmonic": "model",
    "InputError": "errors",
    "Isolator": "model",
    "JankowskiBumper": "model",
    "Oscillator": "model",
    "Periodic": "model",
    "PolynomialIsolator": "model",
    "PowerBumper": "model",
    "Record": "model",
    "Rig": "model",
    "RigidStop": "model",
    "State": "model",
    "Thresholds": "scenario.thresholds",
    "basin_stability": "attraction.along",
    "basins": "attraction.grid",
    "bifurcation_curve": "stability.curves",
    "bifurcation_diagram": "stability.bifurcation_diagram",
    "branch": "stability.branch",
    "classify": "scenario.classify",
    "coexisting": "stability.coexisting",
    "compare_fits": "identification.comparison",
    "contacts": "response.contacts",
    "demands": "seismic.demands",
    "design": "sizing.chart",
    "ensemble": "uncertainty.ensemble",
    "exceedance": "seismic.suites",
    "fit_report": "reporting.identification",
    "fitted": "identification.identify",
    "explore": "explorer.run",
    "floor_record": "seismic.floor",
    "fractiles": "seismic.suites",
    "fragility": "seismic.fragility",
    "from_dimensionless": "model",
    "identify": "identification.identify",
    "impact_section": "response.section",
    "laboratory": "model",
    "least_acceleration": "sizing.best",
    "load": "response.files",
    "lyapunov_exponents": "stability.exponents",
    "manifolds": "attraction.manifolds",
    "one_by_one": "uncertainty.ensemble",
    "next_test": "identification.advice",
    "orbit": "stability.orbit",
    "progress_bar": "response.progress",
    "read_measurement": "measurement.read",
    "required_gap": "sizing.gap",
    "resonance_diagram": "stability.diagram",
    "response_spectrum": "response.response_spectrum",
    "save": "response.files",
    "scenario_map": "scenario.map",
    "seismic_response": "seismic.response",
    "sensitivity": "uncertainty.sensitivity",
    "simulate": "response.simulate",
    "spectrum": "response.spectrum",
    "steady": "stability.steady",
    "stroboscopic_section": "response.section",
    "sweep": "response.sweep",
    "sweeps": "response.sweep",
    "to_dimensionless": "model",
    "to_table": "response.table",
    "totals": "response.totals",
}

__all__ = [
    "BilinearIsolator",
    "BoucWenIsolator",
    "Bumper",
    "Dimensionless",
    "ExponentialIsolator",
    "FrictionIsolator",
    "Harmonic",
    "InputError",
    "Isolator",
    "JankowskiBumper",
    "Oscillator",
    "Periodic",
    "PolynomialIsolator",
    "PowerBumper",
    "Record",
    "Rig",
    "RigidStop",
    "State",
    "Thresholds",
    "__version__",
    "basin_stability",
    "basins",
    "bifurcation_curve",
    "bifurcation_diagram",
    "branch",
    "classify",
    "coexisting",
    "compare_fits",
    "contacts",
    "demands",
    "design",
    "ensemble",
    "exceedance",
    "explore",
    "fit_report",
    "fitted",
    "floor_record",
    "fractiles",
    "fragility",
    "from_dimensionless",
    "identify",
    "impact_section",
    "laboratory",
    "least_acceleration",
    "load",
    "lyapunov_exponents",
    "manifolds",
    "next_test",
    "one_by_one",
    "orbit",
    "progress_bar",
    "read_measurement",
    "required_gap",
    "resonance_diagram",
    "response_spectrum",
    "save",
    "scenario_map",
    "seismic_response",
    "sensitivity",
    "simulate",
    "spectrum",
    "steady",
    "stroboscopic_section",
    "sweep",
    "sweeps",
    "to_dimensionless",
    "to_table",
    "totals",
]

if TYPE_CHECKING:
    from vibroimpact.attraction.along import basin_stability
    from vibroimpact.attraction.grid import basins
    from vibroimpact.attraction.manifolds import manifolds
    from vibroimpact.errors import InputError
    from vibroimpact.explorer.run import explore
    from vibroimpact.identification.advice import next_test
    from vibroimpact.identification.comparison import compare_fits
    from vibroimpact.identification.identify import fitted, identify
    from vibroimpact.measurement.read import read_measurement
    from vibroimpact.model import (
        BilinearIsolator,
        BoucWenIsolator,
        Bumper,
        Dimensionless,
        ExponentialIsolator,
        FrictionIsolator,
        Harmonic,
        Isolator,
        JankowskiBumper,
        Oscillator,
        Periodic,
        PolynomialIsolator,
        PowerBumper,
        Record,
        Rig,
        RigidStop,
        State,
        from_dimensionless,
        laboratory,
        to_dimensionless,
    )
    from vibroimpact.reporting.identification import fit_report
    from vibroimpact.response.contacts import contacts
    from vibroimpact.response.files import load, save
    from vibroimpact.response.progress import progress_bar
    from vibroimpact.response.response_spectrum import response_spectrum
    from vibroimpact.response.section import impact_section, stroboscopic_section
    from vibroimpact.response.simulate import simulate
    from vibroimpact.response.spectrum import spectrum
    from vibroimpact.response.sweep import sweep, sweeps
    from vibroimpact.response.table import to_table
    from vibroimpact.response.totals import totals
    from vibroimpact.scenario.classify import classify
    from vibroimpact.scenario.map import scenario_map
    from vibroimpact.scenario.thresholds import Thresholds
    from vibroimpact.seismic.demands import demands
    from vibroimpact.seismic.floor import floor_record
    from vibroimpact.seismic.fragility import fragility
    from vibroimpact.seismic.response import seismic_response
    from vibroimpact.seismic.suites import exceedance, fractiles
    from vibroimpact.sizing.best import least_acceleration
    from vibroimpact.sizing.chart import design
    from vibroimpact.sizing.gap import required_gap
    from vibroimpact.stability.bifurcation_diagram import bifurcation_diagram
    from vibroimpact.stability.branch import branch
    from vibroimpact.stability.coexisting import coexisting
    from vibroimpact.stability.curves import bifurcation_curve
    from vibroimpact.stability.diagram import resonance_diagram
    from vibroimpact.stability.exponents import lyapunov_exponents
    from vibroimpact.stability.orbit import orbit
    from vibroimpact.stability.steady import steady
    from vibroimpact.uncertainty.ensemble import ensemble, one_by_one
    from vibroimpact.uncertainty.sensitivity import sensitivity


def __getattr__(name: str) -> Any:
    """Load a public name from where it lives (PEP 562)."""
    if name not in _HOME:
        raise AttributeError(f"module 'vibroimpact' has no attribute {name!r}")
    value = getattr(importlib.import_module(f"vibroimpact.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
