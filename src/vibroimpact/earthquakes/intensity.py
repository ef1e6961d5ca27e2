"""How strong a record is: the measure by which a suite of records is scaled."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.errors import InputError, shown
from vibroimpact.model import Record, to_si
from vibroimpact.model.quantities import ACCELERATION, DIMENSIONLESS, TIME, Quantity
from vibroimpact.response.response_spectrum import response_spectrum

_Array = NDArray[np.float64]


class Measure(NamedTuple):
    """An intensity measure."""

    name: str
    """For datasets."""
    quantity: Quantity
    period: float | None = None
    """Of a spectral acceleration (s)."""
    damping: float = 0.05

    @property
    def units(self) -> str:
        """As datasets write them."""
        return "1" if self.quantity is DIMENSIONLESS else "m s-2"

    def of(self, records: list[Record]) -> _Array:
        """Of each record as it is."""
        if self.quantity is DIMENSIONLESS:
            return np.ones(len(records))
        if self.period is None:
            return np.array([one.peak for one in records])
        spectra = [response_spectrum(one, self.period, self.damping) for one in records]
        return np.array([float(one["pseudo_acceleration"]) for one in spectra])

    def factors(self, records: list[Record], levels: _Array) -> tuple[_Array, _Array]:
        """The intensity of each record, and what it is multiplied by at each level.

        Raises
        ------
        InputError
            If a record is 0 throughout.
        """
        intensities = self.of(records)
        for i in np.flatnonzero(intensities == 0.0):
            raise InputError(
                f"records[{i}]: all samples are 0, so the record cannot be scaled to a "
                f"{self.name}; remove this record"
            )
        return intensities, levels / intensities[:, np.newaxis]


def measure(choice: Any) -> Measure:
    """Read an intensity measure: "factor", "PGA", or a natural period and a damping ratio."""
    if isinstance(choice, str) and choice == "factor":
        return Measure("factor of the record", DIMENSIONLESS)
    if isinstance(choice, str) and choice == "PGA":
        return Measure("peak ground acceleration", ACCELERATION)
    if not isinstance(choice, tuple | list) or len(choice) != 2:
        raise InputError(
            f'intensity: {shown(choice)}; pass "factor", "PGA", or the natural period (s) and the '
            "damping ratio of a spectral acceleration, such as (1.0, 0.05)"
        )
    period = to_si(choice[0], TIME, "intensity[0]", above=0.0)
    damping = to_si(choice[1], DIMENSIONLESS, "intensity[1]", minimum=0.0)
    name = f"pseudo-acceleration at T = {period:.6g} s, ζ = {damping:.4g}"
    return Measure(name, ACCELERATION, period, damping)
