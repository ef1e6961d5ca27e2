"""A dataset is given its units and origin, and keeps what it says of itself."""

from __future__ import annotations

import json

import pytest
import xarray as xr

from vibroimpact.datasets.description import describe


def test_units_meaning_and_origin():
    data = describe(xr.Dataset({"eta_d": 1.0, "status": 0}), "made.here", {"a": 1})
    assert data["eta_d"].attrs["units"] == "1"
    assert "any frequency" in data["eta_d"].attrs["comment"]
    assert data["status"].attrs["flag_meanings"].split()[0] == "done"
    assert data.attrs["created_by"] == "made.here"
    assert json.loads(data.attrs["parameters"]) == {"a": 1}


def test_what_is_known_stays():
    data = describe(xr.Dataset({"eta_d": 1.0}), "first", {"a": 1})
    again = describe(data.assign(eta_a=2.0), "second")
    assert json.loads(again.attrs["parameters"]) == {"a": 1}
    assert again.attrs["created_by"] == "first"
    assert again["eta_a"].attrs["units"] == "1"


def test_a_variable_of_no_registry_is_refused():
    with pytest.raises(KeyError, match="nothing"):
        describe(xr.Dataset({"nothing": 1.0}), "made.here", {})


def test_dims_of_no_registry_are_refused_in_tests(monkeypatch):
    data = xr.Dataset({"eta_d": ("event", [1.0])})
    with pytest.raises(ValueError, match=r"^eta_d: its dims \['event'\] are none of"):
        describe(data, "made.here", {})
    monkeypatch.setattr("vibroimpact.datasets.description.CHECKS_DIMS", False)
    describe(data, "made.here", {})


def test_notes_of_the_input_are_an_attribute_where_there_are_any():
    data = describe(xr.Dataset({"eta_d": 1.0}), "made.here", {}, ["unit m/s²", "doubtful"])
    assert data.attrs["notes"] == "unit m/s²\ndoubtful"
    assert "notes" not in describe(xr.Dataset({"eta_d": 1.0}), "made.here", {}).attrs
