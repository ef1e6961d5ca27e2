"""Samples of the posterior by emcee, where it is installed."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.identification.least_squares import Problem
from vibroimpact.identification.robust_loss import moments
from vibroimpact.identification.uncertainty import Spread

_BURN = 0.3
"""Share of the steps that are left out at the beginning."""
_WALKERS = 4
"""A parameter."""


def posterior(
    problem: Problem, x: NDArray[np.float64], around: Spread, draws: int, seed: int
) -> NDArray[np.float64]:
    """Draw parameters from their posterior, flat within the bounds but for priors; a row each.

    Raises
    ------
    InputError
        If emcee is not installed, or the tests have unknowns of their own.
    """
    try:
        import emcee
    except ImportError:
        raise InputError(
            "posterior: emcee is not installed; install it with: pip install emcee"
        ) from None
    count = len(problem.free)
    if len(x) > count:
        raise InputError(
            f"posterior: not available for time histories, whose {len(x) - count} initial values "
            "are also unknown; fit resonance curves only, or pass draws for a bootstrap instead"
        )
    factor = moments(problem.tail).deviance

    def log_density(y: Any) -> float:
        if (y < problem.low).any() or (y > problem.high).any():
            return -np.inf
        return -factor * problem.cost(np.asarray(y))

    walkers = max(_WALKERS * count, 2 * count + 2)
    steps = max(1, round(draws / walkers / (1.0 - _BURN)))
    random = np.random.default_rng(seed)
    root = np.linalg.cholesky(
        around.covariance / np.outer(problem.scale[:count], problem.scale[:count])
        + 1e-18 * np.eye(count)
    )
    start = np.clip(
        x + 0.5 * random.normal(size=(walkers, count)) @ root.T, problem.low, problem.high
    )
    sampler = emcee.EnsembleSampler(walkers, count, log_density)
    state = np.random.RandomState(seed).get_state()
    sampler.run_mcmc(emcee.State(start, random_state=state), steps)
    kept = sampler.get_chain(discard=int(_BURN * steps), flat=True)
    samples: NDArray[np.float64] = kept[-draws:] * problem.scale[:count]
    return samples
