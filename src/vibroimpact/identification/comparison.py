"""Compare fits of several models to the same data."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any, TypeAlias

import numpy as np
import xarray as xr

from vibroimpact.arguments import check_mapping, check_variables
from vibroimpact.datasets.description import describe
from vibroimpact.errors import InputError, unknown
from vibroimpact.identification.residual_structure import CERTAIN
from vibroimpact.model import Oscillator, PolynomialIsolator, PowerBumper
from vibroimpact.model.parameters import PARAMETERS, canonical
from vibroimpact.model.public import public

_CLEAR = 10.0
"""Difference of Akaike's criterion from which on a model has no support (Burnham and Anderson)."""


Fits: TypeAlias = Annotated[
    Mapping[str, xr.Dataset], partial(check_mapping, what="a dict of results of identify by name")
]
"""Results of `identify` by name."""


@public
def compare_fits(fits: Fits) -> xr.Dataset:
    """Compare fits of several models to the same data, by information criteria and residuals.

    Parameters
    ----------
    fits
        Fits, as a mapping from the name of each model to its dataset of `identify`.

    Returns
    -------
    xarray.Dataset
        The dim ``model`` lists the models, the best one first. The variables are:

        - ``akaike``, Akaike's information criterion, corrected for few points, and
          ``akaike_weight``;
        - ``bayes``, the Bayesian information criterion;
        - ``parameter_count``, the number of fitted parameters;
        - ``noise``, the standard deviation of the noise;
        - ``residual_chance``: a small value means that the residuals are systematic.

        The attribute ``findings`` summarises the comparison in words.

    Raises
    ------
    InputError
        If there are fewer than two fits, if one of the datasets is not a fit, or if the fits belong
        to different data.
    """
    if len(fits) < 2:
        raise InputError(f"fits: {len(fits)} given; pass the fits of at least two models")
    reference, first = next(iter(fits.items()))
    for name, fit in fits.items():
        needed = ("akaike", "measured_value")
        check_variables(fit, needed, f"fits[{name!r}]", "the result of identify")
        same = fit.sizes["point"] == first.sizes["point"] and np.array_equal(
            fit["measured_value"].values, first["measured_value"].values, equal_nan=True
        )
        if not same:
            raise InputError(
                f"fits[{name!r}]: this model was fitted to other data than {reference!r}; fit both "
                "models to the same data"
            )
    order = sorted(fits, key=lambda name: float(fits[name]["akaike"]))
    akaike = np.array([float(fits[n]["akaike"]) for n in order])
    weight = np.exp(-0.5 * np.minimum(akaike - akaike[0], 1400.0))
    data = xr.Dataset(coords={"model": order})
    data["akaike"] = ("model", akaike)
    data["akaike_weight"] = ("model", weight / weight.sum())
    data["bayes"] = ("model", [float(fits[n]["bayes"]) for n in order])
    data["parameter_count"] = ("model", [fits[n].sizes["parameter"] for n in order])
    data["noise"] = ("model", [float(fits[n]["noise"].max()) for n in order])
    chance = [float(fits[n]["residual_chance"].min()) for n in order]
    data["residual_chance"] = ("model", chance)
    best = order[0]
    lines = []
    for i, name in enumerate(order[1:], 1):
        less = akaike[i] - akaike[0]
        how = (
            "the data do not support this model"
            if less > _CLEAR
            else "these data cannot distinguish the two models"
            if less < 2.0
            else "this model is less likely"
        )
        lines.append(f"{name}: Akaike's criterion is {less:.1f} above that of {best}: {how}")
    for name, one in zip(order, chance, strict=True):
        if one < CERTAIN:
            lines.append(f"{name}: its residuals are not noise, so this model is incomplete")
    if chance[0] < CERTAIN:
        lines.append(
            "none of these models is complete: even the residuals of the best model are not noise"
        )
    data.attrs["findings"] = "\n".join(lines)
    return describe(data, "vibroimpact.compare_fits")


MODELS = ("hertz", "softening")
"""Names of the laws that are tried beside the one of a rig."""

_STOPS = ("stops", "stops.right", "stops.left")
_DISSIPATION = {f"{whose}.damping": f"{whose}.dissipation" for whose in _STOPS}
_OTHER_UNITS = {f"{whose}.stiffness" for whose in _STOPS}


def remodelled(model: str, oscillator: Oscillator, depth: float) -> Oscillator:
    """Return the rig with another law of similar strength.

    `depth` (m) is the penetration into a stop.

    Raises
    ------
    InputError
        If the model does not exist, or the rig has no part that it replaces.
    """
    if model not in MODELS:
        raise InputError(f"model: {unknown(model, MODELS)}")
    return hertzian(oscillator, depth) if model == "hertz" else softening(oscillator)


def asked_of(model: str, asked: Mapping[str, Any]) -> dict[str, Any]:
    """Translate the free parameters, with guesses and bounds, into those of another model.

    ``free`` and ``priors`` are mappings here. Bounds and priors of parameters with another meaning
    in the model are left out.
    """
    names = _DISSIPATION if model == "hertz" else {}
    changed = _OTHER_UNITS | set(names) if model == "hertz" else set()
    added = {} if model == "hertz" else {"isolator.cubic": None}

    def of(name: str) -> str:
        key = canonical(name, PARAMETERS)
        return names.get(key, key)

    free = {
        of(name): None if canonical(name, PARAMETERS) in changed else value
        for name, value in asked["free"].items()
    }
    return {
        **asked,
        "free": free | added,
        "each": [of(name) for name in asked["each"]],
        "ties": {of(tied): of(to) for tied, to in asked["ties"].items()},
        "priors": {
            name: prior
            for name, prior in asked["priors"].items()
            if canonical(name, PARAMETERS) not in changed
        },
    }


def hertzian(oscillator: Oscillator, depth: float) -> Oscillator:
    """Return the rig with Hertz contacts instead of its bumpers.

    At a penetration depth (m), their spring and damping forces are those of the bumper.

    Raises
    ------
    InputError
        If it has no `Bumper`.
    """
    sides = {}
    for side in ("right", "left"):
        stop = getattr(oscillator, side)
        if stop is not None and stop.spring_and_dashpot is not None:
            stiffness, damping = stop.spring_and_dashpot
            made = stiffness / math.sqrt(depth)
            # c δ' against k δ: so is χ δ' against 1.
            lost = damping / (stiffness * depth)
            sides[side] = PowerBumper(made, stop.gap, 1.5, dissipation=lost)
    if not sides:
        raise InputError(
            "oscillator: it has no linear bumper, which the model 'hertz' replaces; remove 'hertz' "
            "from compare"
        )
    return oscillator.replace(**sides)


def softening(oscillator: Oscillator) -> Oscillator:
    """Return the rig with an isolator that has a cubic term, initially 0.

    Raises
    ------
    InputError
        If its isolator is not linear.
    """
    isolator = oscillator.isolator
    if not isolator.linear:
        raise InputError(
            f"oscillator: its isolator is {isolator}, but the model 'softening' replaces a linear "
            "one; remove 'softening' from compare"
        )
    return oscillator.replace(
        isolator=PolynomialIsolator(
            isolator.initial_stiffness, isolator.damping, cubic=0.0, quintic=0.0
        )
    )
