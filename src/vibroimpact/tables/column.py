"""A column of a table: its name, its units, and its numbers or words."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.tables.times import counts_samples
from vibroimpact.tables.units import Units

Array = NDArray[np.float64]


class TableColumn(NamedTuple):
    """A column of a table."""

    name: str
    """Name as it is written, with its unit. Empty if the file does not name it."""
    units: Units
    values: Array | NDArray[np.str_]
    """Numbers, NaN where they are missing; or words."""

    @property
    def is_numeric(self) -> bool:
        """Whether the column has numbers."""
        return self.values.dtype.kind == "f"

    @property
    def is_row_number(self) -> bool:
        """Whether the column may be the numbers of the rows."""
        return self.is_numeric and counts_samples(np.asarray(self.values, dtype=float))
