"""The rig with an isolator that softens by itself: its fit, and what becomes of the statements."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import least_squares

import samples
import vibroimpact as vi
from paper import refined
from paper.claims import CLAIMS, LINEAR
from paper.study import PublishedStudy
from vibroimpact.model import laboratory
from vibroimpact.response.analytic_free_response import reference_excursions
from vibroimpact.response.free_response import largest_flight, resonance
from vibroimpact.response.resonance import features

FULL_ONLY = pytest.mark.skipif(not samples.full, reason="sweeps the campaign again; --full")


def test_a_case_has_one_isolator_for_all_accelerations():
    cases = [laboratory.case(f"B2-G1-{a}", "refined") for a in laboratory.ACCELERATIONS]
    (isolator,) = {case.oscillator.isolator for case in cases}
    assert isolator in laboratory.REFINED.values()
    for case in cases:
        assert case.parameters == "refined"
        assert case.oscillator.right == laboratory.case(case.code).oscillator.right
    assert len(laboratory.campaign("refined")) == 48


def test_the_equivalent_of_a_linear_isolator_is_itself(monkeypatch):
    """Found from its largest free flight; an exponent all but 1 keeps the closed form away."""
    linear = vi.Isolator(28.7e3, 1190.0, damping_exponent=1.0 + 1e-12)
    monkeypatch.setitem(laboratory.REFINED, "itself", linear)
    stiffness, ratio = refined.equivalent("itself", "A2")
    # The place of a flat maximum is found to a step of its last grid.
    assert stiffness == pytest.approx(28.7e3, rel=5e-3)
    assert ratio == pytest.approx(1190.0 / (2.0 * math.sqrt(28.7e3 * laboratory.MASS)), rel=1e-4)


@pytest.mark.parametrize("name", laboratory.REFINED)
def test_each_isolator_softens_as_the_equivalent_stiffness_does(name):
    for acceleration, wanted in laboratory.ISOLATOR_STIFFNESS.items():
        stiffness, ratio = refined.equivalent(name, acceleration)
        assert stiffness == pytest.approx(wanted, rel=0.045)
        assert ratio == pytest.approx(laboratory.DAMPING_RATIO, rel=0.06)


def misses(isolator) -> np.ndarray:
    """Frequencies and heights of the largest free flight, over those of the linear isolators."""
    errors = []
    for name, a in laboratory.ACCELERATIONS.items():
        shaken = vi.Harmonic(a, 1.0)
        rig = vi.Oscillator(laboratory.MASS, isolator)
        wanted = laboratory.case(f"B1-Ginf-{name}").oscillator
        place = wanted.natural_frequency * math.sqrt(1.0 - 2.0 * laboratory.DAMPING_RATIO**2)
        errors.append(resonance(vi.Rig(rig, shaken)) / place - 1.0)
        pairs = zip(
            largest_flight(vi.Rig(rig, shaken)),
            reference_excursions(vi.Rig(wanted, shaken)),
            strict=True,
        )
        errors += [one / other - 1.0 for one, other in pairs]
    return np.array(errors)


@FULL_ONLY
@pytest.mark.parametrize("name", laboratory.REFINED)
def test_the_parameters_are_those_of_a_fit(name):
    """From a start 10 % off, least squares come back to a fit that is hardly better."""
    law = laboratory.REFINED[name]
    fields = [f for f in type(law).model_fields if getattr(law, f) and f in FITTED[name]]
    start = np.log([getattr(law, f) for f in fields])

    def residuals(logs):
        try:
            return misses(law.replace(**dict(zip(fields, np.exp(logs).tolist(), strict=True))))
        except vi.InputError:
            return np.full(9, 10.0)

    fit = least_squares(residuals, start + 0.1, diff_step=1e-3, x_scale=0.3, max_nfev=30)
    mine = np.sqrt(np.mean(residuals(start) ** 2))
    assert mine < 0.031
    assert mine < 1.1 * np.sqrt(np.mean(fit.fun**2))


FITTED = {
    "exponential": ("reversal_stiffness", "final_stiffness", "decay", "damping"),
    "Bouc-Wen": ("elastic_stiffness", "post_yield_stiffness", "yield_force", "damping"),
    "bilinear": ("elastic_stiffness", "post_yield_stiffness", "yield_force", "damping"),
}


@FULL_ONLY
def test_verdicts():
    again = [claim for claim in CLAIMS if claim not in LINEAR]
    study = PublishedStudy(threads=2)
    holds = {claim.key: claim.find(study).holds for claim in again}
    assert holds["refined-upward-jump"]
    assert not holds["refined-softening"]  # the curves bend, but both sweeps coincide


def test_the_upward_jump_moves_up():
    """In the two tests that the paper fitted, by more than 0.1 Hz."""
    grid = np.round(np.arange(1.4, 2.2, 0.02), 10)
    for code in laboratory.IDENTIFIED:
        places = []
        for parameters in ("table", "refined"):
            case = laboratory.case(code, parameters)
            data = vi.sweep(vi.Rig(case.oscillator, case.amplitude), grid, "backward")
            (up,) = [j for j in features(data).jumps if j.upward]
            places.append(up.frequency)
        assert places[1] > places[0] + 0.1
