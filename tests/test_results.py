"""Results of public functions have the names, dims and kinds of the vocabulary."""

from __future__ import annotations

import warnings
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import arguments
import vibroimpact as vi
from vibroimpact.datasets.vocabulary import NAMED_DIMS, VARIABLES
from vibroimpact.engine.status import Status

NO_DATASET = {
    "chain",
    "explore",
    "fit_report",
    "fitted_rig",
    "floor_record",
    "for_each_rig",
    "from_dimensionless",
    "laboratory.case",
    "progress_bar",
    "save",
    "show_versions",
    "to_dimensionless",
    "to_table",
}
"""Functions that make a rig, a record, a file or a table, or print; their docstrings say which."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("results")
    arguments.write_files(path)
    return path


@cache
def _result(name: str, folder: Path) -> Any:
    function, keywords = arguments.calls(folder)[name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # the calls are short on purpose
        warnings.simplefilter("ignore", UserWarning)
        return function(**keywords)


FUNCTIONS = sorted(set(arguments.public()) - {"explore"})


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_valid_call_is_one_and_returns_a_dataset(name: str, folder: Path) -> None:
    result = _result(name, folder)
    if isinstance(getattr(vi, name), type) or name in NO_DATASET:
        assert not isinstance(result, xr.Dataset)
        return
    assert isinstance(result, xr.Dataset)
    if name not in {"load", "read_measurement"}:
        assert result.attrs["created_by"] == f"vibroimpact.{name}"
    for variable in result.variables:
        assert variable in VARIABLES, variable
        assert "units" in result[variable].attrs, variable
        assert "long_name" in result[variable].attrs, variable
        known, dims = VARIABLES[str(variable)], list(result[variable].dims)
        assert _kind(result[variable]) == known.kind, variable
        assert dims == [variable] or known.has_dims(dims, NAMED_DIMS), variable


def _kind(values: xr.DataArray) -> str:
    return {"i": "integer", "f": "number", "b": "truth", "U": "text", "T": "text"}[
        values.dtype.kind
    ]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_status_says_what_its_numbers_mean(name: str, folder: Path) -> None:
    result = _result(name, folder)
    if isinstance(result, xr.Dataset) and "status" in result:
        assert list(result["status"].attrs["flag_values"]) == [int(one) for one in Status]
        if "message" in result.attrs and not result["status"].dims:
            assert result.attrs["message"] == Status(result["status"].item()).advice
