"""Random rigs: shares from 0 to 1 are converted to parameters of rigs."""

from __future__ import annotations

import math
from typing import Any, Literal, NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from vibroimpact.datasets.description import rig_parameters, system_parameters
from vibroimpact.errors import InputError
from vibroimpact.model import Repeated
from vibroimpact.model.parameters import Parameter, parameter, set_values
from vibroimpact.model.read_rig import RigOrSystem, as_rig_of_any_masses
from vibroimpact.model.rig import Rig
from vibroimpact.model.system import System
from vibroimpact.model.written_units import as_first_argument
from vibroimpact.uncertainty.distributions import (
    Distribution,
    check_names,
    check_values,
    distribution,
    text_of,
)

_Array = NDArray[np.float64]

Method = Literal["sobol", "latin", "random"]

_ROUNDING = 1e-9


class Uncertain(NamedTuple):
    """A rig and the distributions of some of its parameters."""

    base: Rig
    parameters: tuple[Parameter, ...]
    distributions: tuple[Distribution, ...]
    texts: dict[str, str]

    @property
    def names(self) -> list[str]:
        """Names of the parameters."""
        return [one.name for one in self.parameters]

    def values(self, shares: _Array) -> _Array:
        """Return the quantiles of the parameters at these shares, one column per parameter.

        Raises
        ------
        InputError
            If a parameter does not accept a value.
        """
        # A share of 0 or 1 may lie at infinity.
        inside = np.clip(shares, 2.0**-53, 1.0 - 2.0**-53)
        columns = [one.ppf(inside[:, i]) for i, one in enumerate(self.distributions)]
        for column, varied in zip(columns, self.parameters, strict=True):
            check_values(column, varied, f"distributions[{varied.name!r}]")
        return np.column_stack(columns)

    @property
    def shaken(self) -> Repeated | None:
        """The shaking, unless it is open."""
        return None if self.base.shaking is None else self.base.periodic

    def rig(self, values: _Array) -> Rig:
        """Return the rig at one value of each parameter.

        Raises
        ------
        InputError
            If the values are invalid together.
        """
        return set_values(self.base, dict(zip(self.names, map(float, values), strict=True)))

    def rigs(self, values: _Array) -> list[Rig]:
        """Return one rig per row of values.

        Raises
        ------
        InputError
            If a rig is invalid, or two parameters set the same number.
        """
        sample_rigs = [self.rig(row) for row in values]
        first = sample_rigs[0]
        for varied, value in zip(self.parameters, values[0], strict=True):
            if not math.isclose(varied.read(first), value, rel_tol=_ROUNDING, abs_tol=1e-300):
                others = [repr(one.name) for one in self.parameters if one is not varied]
                raise InputError(
                    f"distributions: {varied.name!r} sets the same property of the rig as "
                    f"{' or '.join(others)}; remove one of them"
                )
        return sample_rigs

    def about(self) -> dict[str, Any]:
        """Return the attributes for a dataset."""
        if self.shaken is None:
            rig = system_parameters(self.base.system)
        else:
            rig = rig_parameters(self.base)
        return {**rig, "distributions": self.texts}


def uncertain(rig: RigOrSystem, distributions: Any) -> Uncertain:
    """Read a rig and the distributions of its parameters.

    Raises
    ------
    InputError
        If a distribution is invalid, or the rig has no such parameter.
    """
    alone = isinstance(rig, System)
    base = as_rig_of_any_masses(rig, oscillator_alone=True)
    return _read(base, None if alone else base.periodic, distributions)


@as_first_argument
def _read(base: Rig, shaken: Repeated | None, distributions: Any) -> Uncertain:
    entries = check_names(distributions)
    parameters, made = [], []
    for name, one in entries.items():
        field = f"distributions[{name!r}]"
        varied = parameter(name, base, "distributions")
        if shaken is None and varied.name in ("frequency", "amplitude", "gap_ratio"):
            raise InputError(
                f"{field}: {varied.name} requires sinusoidal shaking, but the rig is an oscillator "
                "without shaking; pass Rig(oscillator, amplitude) as the rig"
            )

        def current_value(varied: Parameter = varied) -> float:
            return varied.read(base)

        current_value()  # refuses what the rig does not have
        parameters.append(varied)
        made.append(distribution(one, varied, current_value, field))
    texts = {
        varied.name: text_of(one) for varied, one in zip(parameters, entries.values(), strict=True)
    }
    if len(texts) < len(parameters):
        names = [one.name for one in parameters]
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(f"distributions: {twice!r} is given twice; remove one of the two")
    return Uncertain(base, tuple(parameters), tuple(made), texts)


def shares(count: int, columns: int, method: Method, seed: int) -> _Array:
    """Return points that fill the unit cube: one row per sample, one column per parameter.

    Raises
    ------
    InputError
        If the count is not a power of 2 for Sobol's points.
    """
    if method == "sobol":
        check_power(count)
        points: _Array = scipy.stats.qmc.Sobol(columns, rng=seed).random(count)
    elif method == "latin":
        points = scipy.stats.qmc.LatinHypercube(columns, rng=seed).random(count)
    else:
        points = np.random.default_rng(seed).random((count, columns))
    return points


def check_power(draws: int) -> None:
    """Raise an error unless a number is a power of 2, and suggest the next one."""
    if draws & (draws - 1):
        raise InputError(
            f"draws: {draws} is not a power of 2, which Sobol's points require; pass a power of 2, "
            f"such as {1 << draws.bit_length()}"
        )
