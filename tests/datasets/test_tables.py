"""Datasets as tidy tables: one row a frequency, a sample or a contact; as CSV for a spreadsheet."""

from __future__ import annotations

import csv
import itertools
import math

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import vibroimpact as vi

CODE = "B2-G1-A3"


@pytest.fixture(scope="module")
def sweep():
    return vi.sweeps([CODE, "B3-G1-A3"], [1.0, 2.0, 3.0])


@pytest.fixture(scope="module")
def motion():
    return vi.simulate(CODE, 3, frequency="2 Hz", samples=32)


def test_a_sweep(sweep):
    one = sweep.isel(rig=0, drop=True)
    table = vi.to_table(one)
    assert isinstance(table, pd.DataFrame)
    assert list(table.columns[:3]) == ["direction", "frequency", "displacement_excursion"]
    assert len(table) == 2 * 3
    rows = itertools.product(["forward", "backward"], [1.0, 2.0, 3.0])
    for (_, row), (way, hertz) in zip(table.iterrows(), rows, strict=True):
        assert (row["direction"], row["frequency"]) == (way, hertz)
        here = one.sel(direction=way, frequency=hertz)
        assert row["eta_a"] == float(here["eta_a"])
        assert row["motion"] == here["motion"].item()
        assert row["section.velocity"] == float(here["section"].sel(component="velocity"))
        assert row["free_displacement_excursion"] == float(here["free_displacement_excursion"])


def test_many_rigs(sweep):
    table = vi.to_table(sweep)
    assert list(table.columns[:3]) == ["rig", "direction", "frequency"]
    assert len(table) == 2 * 2 * 3
    assert set(table["rig"]) == {CODE, "B3-G1-A3"}


def test_times_and_events_are_not_crossed(motion):
    samples = vi.to_table(motion)
    assert len(samples) == motion.sizes["time"]
    assert list(samples.columns[:3]) == ["time", "cycle", "displacement"]
    assert not any(name.startswith("event") for name in samples)
    events = vi.to_table(motion, rows="event")
    assert len(events) == motion.sizes["event"]
    np.testing.assert_array_equal(events["event_time"], motion["event_time"])
    assert "displacement" not in events
    assert len(vi.to_table(vi.contacts(motion))) == vi.contacts(motion).sizes["contact_number"]


def test_other_datasets():
    steady = vi.steady(CODE, frequency="2 Hz")
    assert len(vi.to_table(steady)) == steady.sizes["time"]
    assert len(vi.to_table(steady, rows="contact_number")) == steady.sizes["contact_number"]
    branch = vi.branch(CODE, frequency="2 Hz", vary={"frequency": (1.98, 2.02)})
    table = vi.to_table(branch)
    assert len(table) == branch.sizes["point"]
    assert {"frequency", "eta_d", "multiplier_real.0", "section.displacement"} <= set(table)
    state = vi.to_table(vi.simulate(CODE, 3, frequency="2 Hz", samples=0))
    assert list(state["component"]) == list(steady["component"].values)


def test_rows_that_are_not_there(motion):
    with pytest.raises(
        vi.InputError,
        match=r"^rows: 'point' is not a dimension of this dataset; pass one of time, event$",
    ):
        vi.to_table(motion, rows="point")
    with pytest.raises(vi.InputError, match=r"^dataset: 3 is not a dataset"):
        vi.to_table(3)


def test_csv(sweep, motion, tmp_path):
    path = vi.save(sweep.isel(rig=0, drop=True), tmp_path / "x.csv")
    with path.open(newline="") as file:
        head, *rows = csv.reader(file)
    assert head[:4] == ["direction", "frequency (Hz)", "displacement_excursion (m)", *head[3:4]]
    assert "eta_a" in head
    assert len(rows) == 6
    back = pd.read_csv(path)
    np.testing.assert_array_equal(back["eta_a"], vi.to_table(sweep.isel(rig=0, drop=True))["eta_a"])
    assert len(pd.read_csv(vi.save(motion, tmp_path / "Y.CSV"))) == motion.sizes["time"]


def test_csv_holds_every_number_to_its_last_bit(tmp_path):
    rng = np.random.default_rng(5)
    numbers = rng.standard_normal(20_000) * 10.0 ** rng.uniform(-300, 300, 20_000)
    odd = [5e-324, 1.7976931348623157e308, 0.1 + 0.2, 1 / 3, -0.0, math.inf, -math.inf, math.nan]
    numbers[: len(odd)] = odd
    data = xr.Dataset({"a": ("time", numbers)}, {"time": np.arange(len(numbers)) / 3.0})
    with vi.save(data, tmp_path / "x.csv").open(newline="") as file:
        _, *rows = csv.reader(file)
    back = np.array([float(text or "nan") for _, text in rows])
    assert numbers.tobytes() == back.tobytes()


@pytest.mark.parametrize("name", ["x.xlsx", "x", "x.mat", "x.csv.gz"])
def test_other_endings_are_refused(motion, tmp_path, name):
    with pytest.raises(
        vi.InputError, match=r"^path: .*; use the ending .nc \(NetCDF\) or .csv \(table\)"
    ):
        vi.save(motion, tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_several_datasets_are_no_table(motion, tmp_path):
    with pytest.raises(vi.InputError, match=r"^path: .*not a dict of datasets"):
        vi.save({"a": motion, "b": motion}, tmp_path / "x.csv")
