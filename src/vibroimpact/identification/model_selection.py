"""Fits of other contact or isolator laws to the same measurements, compared with the rig's own."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from vibroimpact.errors import InputError, alternatives
from vibroimpact.identification.comparison import MODELS, asked_of, compare_fits, remodelled
from vibroimpact.identification.identify import fitted_rig, identify
from vibroimpact.model import Oscillator, Rig
from vibroimpact.tasks.threads import Progress

OWN_MODEL = "as given"
"""Name of the rig's own laws among several models."""
_SEARCH = {"profiles": False, "starts": 2, "tried": 16}
"""Search of the fits that are only compared: no intervals, few starts."""

Bar = Callable[[str], AbstractContextManager[Progress]]


class ModelFits(NamedTuple):
    """Fits by model, the rig's own first."""

    fits: dict[str, xr.Dataset]
    comparison: xr.Dataset | None
    """Dataset of `compare_fits`; None without other models."""

    @property
    def own_fit(self) -> xr.Dataset:
        """The fit of the rig's own laws."""
        return self.fits[OWN_MODEL]

    @property
    def best_name(self) -> str:
        """Name of the model that fits best."""
        return OWN_MODEL if self.comparison is None else str(self.comparison["model"].values[0])

    @property
    def best(self) -> xr.Dataset:
        """The fit of the model that fits best."""
        return self.fits[self.best_name]


def fit_models(
    rig: Any,
    data: list[xr.Dataset],
    free: Mapping[str, Any],
    others: Sequence[str],
    *,
    draws: int = 0,
    bar: Bar,
    **options: Any,
) -> ModelFits:
    """Fit the rig's own laws, and other models that start from this fit.

    Parameters
    ----------
    rig, data, free, draws, options
        As in `identify`.
    others
        Names of other models, of `MODELS`. Only if one of them fits best, it gets intervals and
        bootstrap samples.
    bar
        Context manager that shows progress; it is called with the name of the step.

    Raises
    ------
    InputError
        If there is no such model, or as of `identify`.
    """
    if strange := sorted(set(others) - set(MODELS)):
        raise InputError(f"compare: unknown model {strange[0]!r}; use {alternatives(MODELS)}")
    oscillator = rig.oscillator if isinstance(rig, Rig) else rig
    for other in others:
        remodelled(other, oscillator, depth=1e-3)  # refused before anything is computed
    asked = {"free": free, **options}
    with bar("fitting") as progress:
        own = identify(rig, data, draws=draws, progress=progress, **asked)
    fits = {OWN_MODEL: own}
    if not others:
        return ModelFits(fits, None)
    for other in others:
        fits[other] = _other(other, own, data, asked)
    model_fits = ModelFits(fits, compare_fits(fits))
    if model_fits.best_name != OWN_MODEL:
        with bar(f"fitting {model_fits.best_name}") as progress:
            again = {**asked, "draws": draws, "progress": progress}
            fits[model_fits.best_name] = _finished(
                model_fits.best_name, model_fits.best, data, again
            )
    return model_fits


def _other(
    model: str, fit: xr.Dataset, data: list[xr.Dataset], asked: dict[str, Any]
) -> xr.Dataset:
    """Fit another model to the same data, from the first fit."""
    rigs = {}
    for test in fit["test"].values.tolist():
        rig = fitted_rig(fit, test)
        depth = _depth(fit, rig.oscillator) if model == "hertz" else 0.0
        rigs[test] = Rig(remodelled(model, rig.oscillator, depth), rig.amplitude)
    return identify(rigs, data, **{**asked_of(model, asked), **_SEARCH})


def _finished(
    model: str, fit: xr.Dataset, data: list[xr.Dataset], asked: dict[str, Any]
) -> xr.Dataset:
    """Repeat a fit of another model from where it ended, with its intervals."""
    rigs = {test: fitted_rig(fit, test) for test in fit["test"].values.tolist()}
    return identify(rigs, data, **{**asked_of(model, asked), "starts": 1, "tried": 0})


def _depth(fit: xr.Dataset, oscillator: Oscillator) -> float:
    """How far the mass goes into a stop (m), about: half the largest excursion less the gap."""
    gap = min(float(stop.gap) for stop in oscillator.stops.values())
    variable = fit["point_variable"].values
    swing = fit["measured_value"].values[variable == "displacement_excursion"]
    reach = 0.5 * float(np.nanmax(swing)) if len(swing) else 1.5 * gap
    return max(0.7 * (reach - gap), 1e-4 * max(gap, 1e-3))
