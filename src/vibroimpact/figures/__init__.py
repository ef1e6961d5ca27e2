"""Datasets in, matplotlib Axes out: a figure a file.

Nothing else in the package imports matplotlib, and nothing here touches pyplot's global state:
without given axes a figure is made of its own, which the returned axes carry as ``.figure``.
A notebook shows what is returned; `save_figure` writes it to a file.
"""

from vibroimpact.figures.accelerogram import accelerogram
from vibroimpact.figures.basin_shares import basin_shares
from vibroimpact.figures.basins import basin_portrait
from vibroimpact.figures.branches import branch_diagram
from vibroimpact.figures.cases import scenario_cases
from vibroimpact.figures.clearance import clearances
from vibroimpact.figures.curves import bifurcation_curves
from vibroimpact.figures.cycle import hysteresis_cycle
from vibroimpact.figures.demands import fragility_curves, incremental_curves
from vibroimpact.figures.design import design_chart, pareto_front
from vibroimpact.figures.earthquake import earthquake_page
from vibroimpact.figures.ensembles import resonance_bands, sensitivity_bars
from vibroimpact.figures.exponents import exponent_curves
from vibroimpact.figures.family import family_legend, resonance_family
from vibroimpact.figures.feature import feature_map
from vibroimpact.figures.fit import fit_history, fit_profiles, fit_residuals
from vibroimpact.figures.history import time_history
from vibroimpact.figures.lines import spectrum_lines
from vibroimpact.figures.loops import force_loop
from vibroimpact.figures.marks import frequency_marks
from vibroimpact.figures.page import motion_page
from vibroimpact.figures.portrait import phase_portrait
from vibroimpact.figures.record import record_history
from vibroimpact.figures.resonance import resonance_curves
from vibroimpact.figures.response_spectra import response_spectra
from vibroimpact.figures.scenarios import Mark, scenario_map
from vibroimpact.figures.sections import section_diagram
from vibroimpact.figures.style import save_figure

__all__ = [
    "Mark",
    "accelerogram",
    "basin_portrait",
    "basin_shares",
    "bifurcation_curves",
    "branch_diagram",
    "clearances",
    "design_chart",
    "earthquake_page",
    "exponent_curves",
    "family_legend",
    "feature_map",
    "fit_history",
    "fit_profiles",
    "fit_residuals",
    "force_loop",
    "fragility_curves",
    "frequency_marks",
    "hysteresis_cycle",
    "incremental_curves",
    "motion_page",
    "pareto_front",
    "phase_portrait",
    "record_history",
    "resonance_bands",
    "resonance_curves",
    "resonance_family",
    "response_spectra",
    "save_figure",
    "scenario_cases",
    "scenario_map",
    "section_diagram",
    "sensitivity_bars",
    "spectrum_lines",
    "time_history",
]
