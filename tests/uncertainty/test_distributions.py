"""Distributions in words: those of scipy.stats with the same numbers."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

import vibroimpact as vi
from vibroimpact.model.parameters import PARAMETERS
from vibroimpact.uncertainty.distributions import check_values, distribution, text_of

GAP = PARAMETERS["gap"]
SHARES = np.array([0.01, 0.3, 0.5, 0.99])


@pytest.mark.parametrize(
    ("text", "known"),
    [
        ("normal:7.5 mm:0.5 mm", stats.norm(7.5e-3, 0.5e-3)),
        ("Normal: 5%", stats.norm(8e-3, 0.4e-3)),
        ("normal:0.05", stats.norm(8e-3, 0.4e-3)),
        ("normal:7mm:2mm:5mm:10mm", stats.truncnorm(-1.0, 1.5, 7e-3, 2e-3)),
        ("lognormal:7.5 mm:0.2", stats.lognorm(0.2, scale=7.5e-3)),
        ("lognormal:20%", stats.lognorm(0.2, scale=8e-3)),
        ("uniform:5mm:10mm", stats.uniform(5e-3, 5e-3)),
        ("uniform:25%", stats.uniform(6e-3, 4e-3)),
        ("triangular:4mm:5mm:8mm", stats.triang(0.25, 4e-3, 4e-3)),
    ],
)
def test_in_words(text, known):
    law = distribution(text, GAP, lambda: 8e-3, "x")
    np.testing.assert_allclose(law.ppf(SHARES), known.ppf(SHARES), rtol=1e-12)


def test_one_of_scipy_stays():
    law = stats.beta(2.0, b=3.0, scale=1e-2)
    assert distribution(law, GAP, lambda: 8e-3, "x") is law
    assert text_of(law) == "beta(2, b=3, scale=0.01)"
    assert text_of("normal:5%") == "normal:5%"


@pytest.mark.parametrize(
    "wrong",
    [
        "gauss:5%",
        "normal",
        "normal:1mm:2mm:3mm",
        "normal:5 kg:1mm",
        "normal:5mm:0mm",
        "uniform:5mm:5mm",
        "triangular:4mm:9mm:8mm",
        "lognormal:-1mm:0.2",
        "normal:-5%",
        stats.norm,
        7.0,
    ],
)
def test_refused(wrong):
    with pytest.raises(vi.InputError, match=r"^x"):
        distribution(wrong, GAP, lambda: 8e-3, "x")


@pytest.mark.parametrize("kind", ["uniform:3mm:7", "normal:3mm:7", "triangular:0:3mm:7"])
def test_units_of_some_numbers_only_are_refused(kind):
    with pytest.raises(vi.InputError, match=r"^x: '3mm' has a unit and '7' has none; write both"):
        distribution(kind, GAP, lambda: 8e-3, "x")


@pytest.mark.parametrize(
    ("name", "value", "accepted"),
    [
        ("gap", np.inf, "finite values"),
        ("isolator.damping", -1.0, "at least 0"),
        ("stops.stiffness", 0.0, "more than 0"),
        ("stops.restitution", 1.1, "at least 0 and at most 1"),
        ("stops.exponent", 0.5, "at least 1"),
    ],
)
def test_draws_that_cannot_be(name, value, accepted):
    with pytest.raises(vi.InputError, match=accepted):
        check_values(np.array([0.5, value]), PARAMETERS[name], "x")
