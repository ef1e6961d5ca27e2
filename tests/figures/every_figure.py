"""Every figure, with data: what the tests of all figures draw."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

import vibroimpact as vi
from earthquakes.made import lognormal
from earthquakes.rigs import RIGS, noise
from figures import test_assembly_figures as masses
from figures import test_basin_shares as shares
from figures import test_basins as basins
from figures import test_branches as branches
from figures import test_ensembles as ensembles
from figures import test_force_on_the_mass as unbalance
from figures import test_motion_style as motions
from figures import test_physical_axes as physical
from figures import test_resonance_curves as curves
from figures import test_resonance_family as family
from figures import test_scenarios as scenarios
from figures import test_sections as sections
from vibroimpact import figures

CASE = vi.laboratory.case("B2-G1-A3")
RECORD = noise(8)
PERIODS = np.geomspace(0.05, 2.0, 20)
SCALES = np.linspace(0.2, 3.0, 10)
OUTPUT = {
    "power": vi.Output(
        "mean(isolator.damping*velocity**2)",
        units="W",
        long_name="mean power of the dashpot of the isolator over one period",
    )
}
NO_UNITS = vi.Rig(vi.Oscillator(1, vi.Isolator(1, 0.1), vi.Bumper(20, 0, 2)), 0.5)
WIDE = (-0.012, 0.012), (-0.1, 0.1)


@cache
def quake() -> xr.Dataset:
    return vi.simulate(vi.Rig(RIGS["bumpers"], RECORD), tail=1.0, samples=4)


@cache
def spectra() -> dict[str, xr.Dataset]:
    mass = vi.floor_record(quake())
    return {
        "ground": vi.response_spectrum(RECORD, PERIODS),
        "mass": vi.response_spectrum(mass, PERIODS),
    }


@cache
def manifolds() -> xr.Dataset:
    return vi.manifolds("B3-10mm-A3", None, *WIDE, frequency=0.7, longest=2.0)


@cache
def designs(first: str = "gap", *others: str) -> xr.Dataset:
    """Return designs, of which some exceed a limit."""
    values = {
        "gap": np.linspace(0.01, 0.3, 5),
        "stops.stiffness": np.geomspace(100.0, 2000.0, 4),
    }
    vary = {name: values[name] for name in (first, *others)}
    limits = {"peak_displacement": 0.12}
    return vi.design_chart(
        RIGS["bumpers"], vary, records=[noise(k, count=120) for k in (8, 9)], limits=limits
    )


@cache
def fit() -> xr.Dataset:
    """Return a fit to curves and to a history of a rig that is known."""
    rig = vi.Rig(CASE.oscillator, CASE.amplitude)
    swept = vi.sweep(rig, np.arange(1.0, 4.0, 0.25))
    swept = swept[["displacement_excursion", "acceleration_excursion"]]
    for number, name in enumerate(swept):
        error = np.random.default_rng(number).standard_normal(swept[name].shape)
        swept[name] = swept[name] * (1.0 + 0.02 * error)
    history = vi.steady(vi.Rig(CASE.oscillator, vi.Harmonic(CASE.amplitude, 2.0)), samples=64)
    free = {"stops.stiffness": None, "stops.damping": None}
    return vi.identify(
        rig, {"curves": swept, "history": history}, free, tried=0, starts=1, profiles=True
    )


@cache
def demands() -> xr.Dataset:
    return lognormal(np.random.default_rng(1), 12, SCALES, 0.4)


@cache
def fragility() -> xr.Dataset:
    return vi.fragility(demands(), "peak_displacement", 1.0)


@cache
def own_outputs() -> dict[str, xr.Dataset]:
    """Return a sweep, branches and a bifurcation diagram with an output of a long name."""
    grid = np.linspace(1.0, 4.0, 16)
    return {
        "sweep": vi.sweep(CASE, grid, outputs=OUTPUT),
        "branches": vi.resonance_diagram(CASE, {"frequency": (1.0, 4.0)}, outputs=OUTPUT),
        "diagram": vi.bifurcation_diagram(
            sections.CASE, {"gap": (4.7e-3, 5e-3)}, 7, frequency=1.12, outputs=OUTPUT
        ),
    }


@cache
def no_units() -> dict[str, xr.Dataset]:
    return {
        "sweep": vi.sweep(NO_UNITS, np.linspace(0.12, 0.24, 13)),
        "motion": vi.steady(NO_UNITS, frequency=0.2),
        "branches": vi.resonance_diagram(NO_UNITS, {"frequency": (0.12, 0.24)}),
    }


@cache
def exponents() -> xr.Dataset:
    rigs = {"B3-10mm-A3": "B3-10mm-A3", "B2-G1-A3": CASE}
    return vi.lyapunov_exponents(rigs, [1.1], 64, vary={"gap": [3e-3, 4e-3, 5e-3]})


def several_masses() -> vi.Assembly:
    """Return an assembly with crossing links, a preload, and gaps of all kinds of stops."""
    spring = vi.Isolator("200 MN/m", "1 MN s/m")
    bumper = vi.Bumper("60 MN/m", "0.9 MN s/m", "10 cm")
    return vi.Assembly(
        {"base": "300 t", "lower_storey": "250 t", "roof": "200 t"},
        links={
            "isolator": vi.Link("ground", "base", vi.Isolator("5 MN/m", "0.2 MN s/m")),
            "storey": vi.Link("base", "lower_storey", spring),
            "upper_storey": vi.Link("lower_storey", "roof", spring),
            "brace": vi.Link("roof", "base", spring),
        },
        stops={
            "moat_left": vi.Link("ground", "base", bumper),
            "moat_right": vi.Link("base", "ground", bumper.replace(gap="15 cm")),
            "neighbour": vi.Link("roof", "ground", vi.RigidStop(0.6, "4 cm")),
            "pad": vi.Link("lower_storey", "roof", vi.PowerBumper("2 GN/m^1.5", "-1 mm")),
        },
    )


class Drawn(NamedTuple):
    """A figure: a function that draws it, and the number of axes that it draws on."""

    draw: Callable[..., Any]
    axes: int = 1
    """Number of axes, or 0 if it always makes a new figure."""


def _over(make: Callable[[], Any], draw: Callable[..., Any], **options: Any) -> Callable[..., Any]:
    """Return a function that draws the data that another makes when they are needed."""
    return lambda **how: draw(make(), **options, **how)


def _both(name: str, **options: Any) -> Callable[..., Any]:
    return _over(motions.both, getattr(figures, name), **options)


EVERY: dict[str, Drawn] = {
    "resonance_curves": Drawn(
        _over(partial(curves.swept, "B2-G1-A3"), figures.resonance_curves, physical=False), 2
    ),
    "resonance_curves, chaotic": Drawn(
        _over(partial(curves.swept, "B3-G1-A3"), figures.resonance_curves), 2
    ),
    "resonance_curves, physical": Drawn(
        _over(partial(physical.swept, physical.BUILDING), figures.resonance_curves, physical=True),
        3,
    ),
    "resonance_curves, unbalance": Drawn(
        _over(unbalance.swept, figures.resonance_curves, physical=False), 3
    ),
    "resonance_curves, unbalance, physical": Drawn(
        _over(unbalance.swept, figures.resonance_curves, physical=True), 4
    ),
    "resonance_curves, own output": Drawn(
        lambda **how: figures.resonance_curves(own_outputs()["sweep"], **how), 3
    ),
    "resonance_curves, no units": Drawn(
        lambda **how: figures.resonance_curves(no_units()["sweep"], physical=True, **how), 3
    ),
    "resonance_family": Drawn(_over(family.swept, figures.resonance_family)),
    "time_history": Drawn(_both("time_history"), 3),
    "time_history, unbalance": Drawn(_over(unbalance.motion, figures.time_history), 4),
    "clearances": Drawn(_both("clearances"), 2),
    "phase_portrait": Drawn(_both("phase_portrait")),
    "hysteresis_cycle": Drawn(_both("hysteresis_cycle")),
    "hysteresis_cycle, unbalance": Drawn(_over(unbalance.motion, figures.hysteresis_cycle)),
    "spectrum_lines": Drawn(
        lambda **how: figures.spectrum_lines(
            {name: vi.fourier_spectrum(one) for name, one in motions.both().items()}, **how
        )
    ),
    "motion_page": Drawn(lambda **how: figures.motion_page({"2 Hz": motions.both()}, **how), 5),
    "motion_page, no units": Drawn(
        lambda **how: figures.motion_page({"one": no_units()["motion"]}, **how), 5
    ),
    "force_loop": Drawn(
        lambda **how: figures.force_loop(vi.BilinearIsolator(5e5, 3e4, 1e3, 0.0), "20 mm", **how)
    ),
    "branch_diagram": Drawn(
        lambda **how: figures.branch_diagram(
            branches.diagram(), sweep=branches.swept(), quantity="eta_d", **how
        )
    ),
    "branch_diagram, many": Drawn(
        _over(branches.several, figures.branch_diagram, quantity="displacement_excursion")
    ),
    "branch_diagram, own output": Drawn(
        lambda **how: figures.branch_diagram(
            own_outputs()["branches"], sweep=own_outputs()["sweep"], quantity="power", **how
        )
    ),
    "branch_diagram, no units": Drawn(
        lambda **how: figures.branch_diagram(
            no_units()["branches"], sweep=no_units()["sweep"], quantity="peak_displacement", **how
        )
    ),
    "bifurcation_curves": Drawn(
        lambda **how: figures.bifurcation_curves(
            {"folds": branches.curve("fold"), "grazings": branches.curve("grazing")}, **how
        )
    ),
    "section_diagram": Drawn(
        lambda **how: figures.section_diagram(
            sections.diagram(), branches=sections.branch(), **how
        ),
        3,
    ),
    "section_diagram, own output": Drawn(
        lambda **how: figures.section_diagram(own_outputs()["diagram"], **how), 4
    ),
    "exponent_curves": Drawn(_over(exponents, figures.exponent_curves)),
    "basin_portrait": Drawn(
        lambda **how: figures.basin_portrait(basins.made(), manifolds=manifolds(), **how)
    ),
    "basin_shares": Drawn(_over(shares.made, figures.basin_shares)),
    "scenario_map": Drawn(_over(scenarios.made, figures.scenario_map)),
    "feature_map": Drawn(_over(scenarios.made, figures.feature_map, name="chaotic_count")),
    "scenario_cases": Drawn(
        lambda **how: figures.scenario_cases(
            {"B2-G1-A3": "S3", "B1-G2-A1": "S0", "B4-G4-A2": "S4", "B3-G3-A3": "S2"}, **how
        ),
        0,
    ),
    "assembly_drawing": Drawn(_over(several_masses, figures.assembly_drawing)),
    "mass_histories": Drawn(_over(masses.quake, figures.mass_histories), 6),
    "mass_histories, closing": Drawn(
        _over(masses.quake, figures.mass_histories, closing=["pounding_2", "pounding_3"]), 8
    ),
    "mass_histories, cycles": Drawn(
        _over(masses.motion, figures.mass_histories, quantity="acceleration", cycles=3), 6
    ),
    "mass_histories, no units": Drawn(_over(masses.ball, figures.mass_histories, cycles=8), 2),
    "contact_forces": Drawn(_over(masses.quake, figures.contact_forces), 3),
    "mass_envelopes": Drawn(_over(masses.compared, figures.mass_envelopes), 3),
    "mass_envelopes, one": Drawn(_over(masses.ball, figures.mass_envelopes), 3),
    "pair_portrait": Drawn(
        _over(masses.motion, figures.pair_portrait, first="north3", second="south3", cycles=3)
    ),
    "pair_portrait, approach": Drawn(
        _over(masses.ball, figures.pair_portrait, first="ball", second="host", quantity="approach")
    ),
    "mass_resonance": Drawn(_over(masses.swept, figures.mass_resonance), 6),
    "mass_resonance, forces": Drawn(
        _over(masses.swept, figures.mass_resonance, quantity="peak_force"), 3
    ),
    "mass_spectra": Drawn(
        lambda **how: figures.mass_spectra(vi.fourier_spectrum(masses.motion()), **how), 6
    ),
    "mass_spectra, no units": Drawn(
        lambda **how: figures.mass_spectra(vi.fourier_spectrum(masses.ball()), **how), 2
    ),
    "section_diagram, masses": Drawn(_over(masses.diagram, figures.section_diagram), 4),
    "basin_portrait, masses": Drawn(_over(masses.plane, figures.basin_portrait)),
    "mass_branches": Drawn(_over(masses.branch, figures.mass_branches), 2),
    "accelerogram": Drawn(
        lambda **how: figures.accelerogram(
            RECORD, vi.response_spectrum(RECORD, PERIODS, [0.02, 0.05]), **how
        ),
        2,
    ),
    "response_spectra": Drawn(
        lambda **how: figures.response_spectra(
            vi.response_spectrum(RECORD, PERIODS, [0.02, 0.05, 0.1, 0.2]), **how
        )
    ),
    "response_spectra, records": Drawn(_over(spectra, figures.response_spectra)),
    "record_history": Drawn(_over(quake, figures.record_history), 4),
    "earthquake_page": Drawn(lambda **how: figures.earthquake_page(quake(), spectra(), **how), 0),
    "incremental_curves": Drawn(_over(demands, figures.incremental_curves, limit=1.5)),
    "fragility_curves": Drawn(_over(fragility, figures.fragility_curves)),
    "design_chart": Drawn(
        _over(partial(designs, "gap", "stops.stiffness"), figures.design_chart), 2
    ),
    "design_chart, one parameter": Drawn(_over(designs, figures.design_chart), 2),
    "pareto_front": Drawn(_over(partial(designs, "gap", "stops.stiffness"), figures.pareto_front)),
    "resonance_bands": Drawn(_over(ensembles.drawn, figures.resonance_bands), 2),
    "sensitivity_bars": Drawn(
        lambda **how: figures.sensitivity_bars(ensembles.indices().isel(frequency=1), **how)
    ),
    "sensitivity_bars, curves": Drawn(_over(ensembles.indices, figures.sensitivity_bars)),
    "fit_residuals": Drawn(_over(fit, figures.fit_residuals), 2),
    "fit_profiles": Drawn(_over(fit, figures.fit_profiles), 0),
    "fit_history": Drawn(_over(fit, figures.fit_history, test="history"), 3),
}
