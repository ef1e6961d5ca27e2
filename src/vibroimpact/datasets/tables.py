"""Datasets as tidy tables, for spreadsheets and data frames."""

from __future__ import annotations

import pandas as pd
import xarray as xr

from vibroimpact.errors import InputError, shown
from vibroimpact.model.public import public

_COLUMNS = {
    "stop",
    "component",
    "exponent",
    "multiplier",
    "component_after",
    "component_before",
    "bound",
}
"""Dims with few labelled values; each of these values becomes a column, such as
``peak_force.right``."""


@public
def to_table(dataset: xr.Dataset, rows: str | None = None) -> pd.DataFrame:
    """Convert a dataset to a tidy table with one row per frequency, sample, orbit or contact.

    Parameters
    ----------
    dataset
        Dataset that was returned by a function of this package.
    rows
        The dim whose entries become the rows, such as ``"event"`` or ``"contact_number"`` for a
        motion. Default: the main dims of the dataset. These are rig, direction and frequency for a
        sweep, the time for a motion, and the points for a branch.

    Returns
    -------
    pandas.DataFrame
        There is one column for each coordinate and for each variable along the rows. A variable
        with stops, or with components such as a state, has one column for each of them:
        ``peak_force.right``, ``section.velocity``. Variables with other
        additional dims are left out. ``attrs["units"]`` contains the units of the columns.

    Raises
    ------
    InputError
        If ``dataset`` is not a dataset, or if none of its variables has the dim ``rows``.
    """
    if not isinstance(dataset, xr.Dataset):
        raise InputError(
            f"dataset: {shown(dataset)} is not a dataset; pass the result of a function such as "
            "sweep"
        )
    along = [variable.dims for variable in dataset.data_vars.values() if variable.dims]
    main = [tuple(dim for dim in dims if dim not in _COLUMNS) for dims in along]
    # Of a dataset of nothing but stops, such as that of `required_gap`, these are the rows.
    alone = [dims for dims in along if "component" not in dims] or [("component",)]
    about = next((dims for dims in main if dims), alone[0])
    dims = about if rows is None else (rows,)
    is_name = rows is None or isinstance(rows, str)
    if not is_name or not any(set(dims) <= set(own_dims) for own_dims in along):
        known = dict.fromkeys(str(dim) for own_dims in main for dim in own_dims)
        raise InputError(
            f"rows: {shown(rows)} is not a dimension of this dataset; pass one of "
            f"{', '.join(known)}"
        )
    parts: dict[str, xr.DataArray] = {}
    for name, variable in dataset.data_vars.items():
        others = [dim for dim in variable.dims if dim not in dims]
        if len(others) == len(variable.dims) or not _COLUMNS.issuperset(map(str, others)):
            continue
        parts |= _side_by_side(str(name), variable, others)
    frame = xr.Dataset(parts).to_dataframe(dim_order=list(dims)).reset_index()
    first = [name for name in dataset.coords if name in frame and name not in dims]
    order = [*dims, *first]
    frame = frame[[*order, *(name for name in frame if name not in order)]]
    frame.attrs["units"] = {
        name: (parts[name] if name in parts else dataset[name]).attrs.get("units", "1")
        for name in frame
    }
    return frame


def _side_by_side(name: str, variable: xr.DataArray, dims: list[object]) -> dict[str, xr.DataArray]:
    """Return one array for each entry along the dims, named after the entry."""
    if not dims:
        return {name: variable}
    dim, *rest = dims
    arrays: dict[str, xr.DataArray] = {}
    for i in range(variable.sizes[dim]):
        label = variable[dim].values[i] if dim in variable.coords else i
        arrays |= _side_by_side(f"{name}.{label}", variable.isel({dim: i}, drop=True), rest)
    return arrays


def as_text(dataset: xr.Dataset) -> str:
    """Return the table of a dataset as comma-separated values, with units in the column names."""
    frame = to_table(dataset)
    units = frame.attrs["units"]
    frame.columns = [
        name if units[name] == "1" else f"{name} ({units[name]})" for name in frame.columns
    ]
    text: str = frame.to_csv(index=False)
    return text
