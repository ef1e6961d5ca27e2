"""Identification of the parameters of rigs from measurements, with their uncertainty."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from vibroimpact.arguments import check_name, check_variables
from vibroimpact.errors import InputError, alternatives, warn_of_input
from vibroimpact.identification import results
from vibroimpact.identification.equivalent_rigs import rivals
from vibroimpact.identification.fit_inputs import tests_of, ties_of
from vibroimpact.identification.free_parameters import frees, written
from vibroimpact.identification.global_search import local, search
from vibroimpact.identification.least_squares import Problem
from vibroimpact.identification.posterior import posterior as sampled
from vibroimpact.identification.profile_likelihood import Profile, limit_of, profile
from vibroimpact.identification.robust_loss import noises, weighed
from vibroimpact.identification.uncertainty import bootstrap, spread
from vibroimpact.identification.untouched_stops import untouched
from vibroimpact.model import Rig
from vibroimpact.model.argument_types import NonNegativeInt, PositiveInt, Share, String
from vibroimpact.model.public import public
from vibroimpact.model.written_units import written_for
from vibroimpact.tasks.threads import Progress

_TAIL = 3.0
"""Standard deviations from which on a point counts less than its square."""
_COARSE = 0.02
"""Noise while searching is taken as no smaller."""
_ROUNDS = 2
"""How often noise and fit are found one after the other."""


@public
def identify(
    rig: Any,
    data: Any,
    free: Mapping[str, Any] | Sequence[str] | str,
    *,
    each: Sequence[str] = (),
    ties: Mapping[str, str] | None = None,
    priors: Mapping[str, tuple[Any, Any]] | None = None,
    noise: Any = None,
    robust: bool = True,
    confidence: Share = 0.95,
    starts: PositiveInt = 6,
    tried: NonNegativeInt = 64,
    profiles: bool = True,
    draws: NonNegativeInt = 0,
    posterior: NonNegativeInt = 0,
    window: PositiveInt | None = None,
    steady: bool = False,
    seed: NonNegativeInt = 0,
    threads: PositiveInt | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Identify parameters of rigs from measurements, with their uncertainty.

    Parameters
    ----------
    rig
        The tested rig, with its known values and guesses of the unknown values. It is a `Rig`, a
        published case or its code such as ``"B2-G1-A3"``, or the path of a study file. If each test
        has its own rig, pass a list of rigs, or a mapping from the names of the tests to rigs. If
        the data state or contain the shaking, this shaking is used, and ``rig`` may be an
        `Oscillator` alone. If the shaking of the rig differs from the shaking of the data, a
        warning and a finding report it.
    data
        The measured data: a dataset of `read_measurement`, `sweep` or `simulate`, or the path of a
        file. For several tests, pass a list, or a mapping from the names of the tests to their
        data.
    free
        Parameters that are fitted. Pass their names, such as ``"isolator.stiffness,gap"``, or a
        mapping from their names to settings. A setting is a starting value, bounds (low, high),
        both (``{"start": ..., "low": ...}``), or None. With None the fit starts from the value of
        the rig. Parameters of sensors are ``displacement_scale``, ``acceleration_scale``,
        ``displacement_offset`` and ``acceleration_offset``.
    each
        Free parameters that are fitted separately for each test. All other free parameters have the
        same value in all tests. Default: none.
    ties
        Parameters that are kept equal to another parameter, such as ``{"left.gap": "right.gap"}``.
    priors
        Prior knowledge: mean and standard deviation of a normal prior, by the name of the
        parameter. Default: none.
    noise
        Standard deviation of the noise in the measured values, as a fraction of each value, such as
        0.02. Default: estimated from the fit.
    robust
        Whether outliers have less weight than in ordinary least squares.
    confidence
        Confidence level of the intervals, between 0 and 1.
    starts
        Number of local fits, each from a different starting point.
    tried
        Number of points that are tried, spread over the ranges of the free parameters. The best of
        these points become starting points.
    profiles
        Whether the intervals are computed from profiles of the likelihood. Such intervals may be
        asymmetric, and they may end at a bound. If False, the intervals are computed from the
        covariance.
    draws
        Number of bootstrap samples, which are drawn from the measured points.
    posterior
        Number of samples of the posterior distribution, for a fit to curves. They are drawn by
        emcee (``pip install emcee``).
    window
        Number of forcing cycles per segment. A time history is split into segments, and the initial
        state of each segment is fitted together with the parameters. Use more cycles for a regular
        motion, and fewer cycles for a chaotic motion. Default: 5.
    steady
        Whether the time histories are records of steady motions. If so, each history is compared
        with the steady motion that the rig reaches from the measured state at the start of the
        history. No initial states are fitted.
    seed
        Random seed of the starting points and of the bootstrap samples.
    threads
        Number of threads (default: one per processor).
    progress
        A `progress_bar`, or a function that is called with the completed and the total number of
        steps.

    Returns
    -------
    xarray.Dataset
        Over the dim ``parameter``: ``fitted_value``, ``standard_error``, the confidence
        ``interval`` (dim ``bound``: low, high), ``covariance``, ``correlation``, the profiles of
        the likelihood, and the bootstrap values. ``interval_open`` states for each end of an
        interval whether a bound, and not the data, limits it.

        Over the dim ``point``: the measured value, the fitted value, and the residual. For curves,
        a residual is a fraction of the value.

        Over the dim ``test``: the noise, and whether the residuals are systematic.

        The attribute ``findings`` summarises the result in words, with one finding per line. To get
        the fitted rig, pass the dataset to `fitted_rig`.

    Raises
    ------
    InputError
        If a value is invalid, or if there are fewer points than unknowns.

    Warns
    -----
    InputWarning
        If the shaking of the data is used, and the shaking of the rig differs from it.
    """
    threads = threads or os.cpu_count() or 1
    tests = tests_of(rig, data, noise, window, steady)
    swings = {t.name: t.swing for t in tests}
    free_list = frees(free, {t.name: t.rig for t in tests}, each, priors, swings)
    if any(one.name == "amplitude" for one in free_list):
        for test in tests:
            test.data = test.data.assign_attrs(amplitude_source="the fit")
    for test in tests:
        warn_of_input(f"data {test.name!r}", test.data.attrs["unused_shaking"].splitlines())
    for test in tests:
        test.calibrate(
            written(free_list, [one.start for one in free_list], test.rig, test.name, {})[1]
        )
    problem = Problem(
        tests, free_list, ties_of(ties, tests[0].rig), [max(t.noise, _COARSE) for t in tests], _TAIL
    )
    _enough(problem)
    steps = 3 + (len(free_list) if profiles else 0) + (1 if draws else 0)
    done = 0

    def tell() -> None:
        nonlocal done
        done += 1
        if progress:
            progress(done, steps)

    outcome = search(problem, tried, starts, seed, threads)
    tell()
    x = outcome.x
    fixed = [noise is not None] * len(tests)
    tail = _TAIL if robust else np.inf
    for _ in range(_ROUNDS):
        problem = problem.replaced(tests=weighed(problem, x, fixed))
        problem = problem.replaced(sigma=noises(problem, x, fixed), tail=tail)
        x = local(problem, x, precise=True).x
    problem = problem.replaced(sigma=noises(problem, x, fixed))
    tell()
    around = spread(problem, x)
    best, others = rivals(problem, x, outcome.others, limit_of(confidence, around.freedom))
    if best is not x:
        x, around = best, spread(problem, best)
    idle = untouched(problem, x)
    tell()
    curves: list[Profile] = []
    if profiles:
        for number in range(len(free_list)):
            kept = idle.all - {number} if number in idle.all else ()
            curves.append(profile(problem, x, number, around, confidence, kept))
            tell()
    samples = {
        "bootstrap_value": bootstrap(problem, x, around, draws, seed, threads) if draws else None,
        "posterior_value": (sampled(problem, x, around, posterior, seed) if posterior else None),
    }
    fit = results.Fit(problem, x, outcome, around, curves, others, idle)
    with written_for(*(test.rig for test in tests)):
        return results.labelled(fit, samples, confidence)


@public
def fitted_rig(result: xr.Dataset, test: String | None = None) -> Rig:
    """Return the fitted rig with the shaking of one of the tests.

    Parameters
    ----------
    result
        Dataset of `identify`.
    test
        Name of the test whose rig and shaking are returned. Default: the first test. The name is
        required if the tests have different rigs.

    Raises
    ------
    InputError
        If the dataset is not a fit, or if it does not contain the test.
    """
    check_variables(result, ["fitted_value"], "result", "the result of identify")
    rigs = json.loads(result.attrs["rigs"])
    if (
        test is None
        and len(rigs) > 1
        and len({json.dumps(r["oscillator"]) for r in rigs.values()}) > 1
    ):
        raise InputError(
            "test: missing, but the tests have different rigs; pass "
            f"{alternatives(map(repr, rigs))}"
        )
    name = next(iter(rigs)) if test is None else test
    check_name(name, rigs, "test")
    rig = results.rig_of(rigs[name])
    return Rig(rig.oscillator, rig.sine.amplitude)


def _enough(problem: Problem) -> None:
    points = sum(t.points_count for t in problem.tests)
    unknowns = len(problem.start)
    priors = sum(one.prior is not None for one in problem.free)
    if points + priors < unknowns:
        names = ", ".join(one.key for one in problem.free)
        raise InputError(
            f"free: {unknowns} unknowns ({names}), but only {points} measured values; add measured "
            "values or fit fewer parameters"
        )
