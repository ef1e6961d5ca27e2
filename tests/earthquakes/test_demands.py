"""Many runs at once: each is the response by itself, in whatever order, however often stopped."""

from __future__ import annotations

import json
import shutil

import numpy as np
import pytest
import xarray as xr

import vibroimpact as vi
from earthquakes.rigs import RIGS, noise
from vibroimpact.earthquakes.run_plan import blocks

RECORDS = {"a": noise(8, count=120), "b": noise(9, count=150, step=0.01), "c": noise(10, count=90)}
SCALES = [0.2, 0.7, 1.3]
PEAKS = (
    "peak_displacement",
    "displacement_max",
    "displacement_min",
    "peak_acceleration",
    "peak_force",
    "impulse",
    "impact_count",
    "residual_displacement",
)


def test_every_run_is_the_response_by_itself() -> None:
    vary = {"gap": ["20 mm", 0.05], "stops.stiffness": [200.0, 900.0]}
    data = vi.demands(RIGS["bumpers"], RECORDS, SCALES, vary=vary)
    assert data["peak_force"].dims == ("record", "scale", "gap", "stops.stiffness", "stop")
    assert data["gap"].attrs["units"] == "m"
    assert (data["status"] == 0).all()
    np.testing.assert_array_equal(data["factor"], np.tile(SCALES, (3, 1)))
    for name, record in RECORDS.items():
        for scale in SCALES:
            for gap in (0.02, 0.05):
                for stiffness in (200.0, 900.0):
                    rig = RIGS["bumpers"].replace(
                        right=vi.Bumper(stiffness, 3.0, gap), left=vi.Bumper(stiffness, 1.5, gap)
                    )
                    here = {"scale": scale, "gap": gap, "stops.stiffness": stiffness}
                    one = data.sel(record=name, **here)
                    direct = vi.seismic_response(vi.Rig(rig, record.scaled(scale)))
                    for peak in PEAKS:
                        np.testing.assert_allclose(one[peak], direct[peak], rtol=1e-11, atol=1e-14)
    assert float(data["impact_count"].max()) > 3


@pytest.mark.full
def test_rigs_by_name_with_other_laws_and_stops() -> None:
    data = vi.demands(RIGS, [*RECORDS.values()], 1.0, threads=2)
    assert data["record"].values.tolist() == ["0", "1", "2"]
    assert data["rig"].values.tolist() == list(RIGS)
    for name, rig in RIGS.items():
        direct = vi.seismic_response(vi.Rig(rig, RECORDS["b"]))
        one = data.isel(record=1, scale=0).sel(rig=name)
        assert float(one["peak_acceleration"]) == float(direct["peak_acceleration"]) or float(
            one["peak_acceleration"]
        ) == pytest.approx(float(direct["peak_acceleration"]), rel=1e-11)
        force = one["peak_force"].dropna("stop")
        assert force["stop"].values.tolist() == direct["stop"].values.tolist()
        np.testing.assert_allclose(force, direct["peak_force"], rtol=1e-11)
    assert np.isinf(data["peak_force"].sel(rig="walls")).any()


@pytest.mark.parametrize(
    ("intensity", "of"),
    [
        ("PGA", lambda record: record.peak),
        (
            ("0.8 s", 0.05),
            lambda record: float(vi.response_spectrum(record, 0.8)["pseudo_acceleration"]),
        ),
    ],
)
def test_scales_in_an_intensity_measure(intensity, of) -> None:
    data = vi.demands(RIGS["bumpers"], RECORDS, ["0.1 g", 3.0], intensity=intensity, tail="1 s")
    assert data["scale"].attrs["units"] == "m s-2"
    for name, record in RECORDS.items():
        one = data.sel(record=name)
        assert float(one["intensity"]) == pytest.approx(of(record))
        scaled = record.scaled(3.0 / of(record))
        assert of(scaled) == pytest.approx(3.0)
        direct = vi.seismic_response(vi.Rig(RIGS["bumpers"], scaled), tail=1.0)
        assert float(one["peak_displacement"][1]) == pytest.approx(
            float(direct["peak_displacement"]), rel=1e-10
        )


def test_threads_and_blocks_change_no_bit() -> None:
    whole = vi.demands(
        RIGS["friction"], RECORDS, SCALES, vary={"gap": [0.01, 0.02, 0.03]}, threads=1
    )
    for block, threads in ((1, 2), (2, 1), (4, 3)):
        other = vi.demands(
            RIGS["friction"],
            RECORDS,
            SCALES,
            vary={"gap": [0.01, 0.02, 0.03]},
            threads=threads,
            block=block,
        )
        for name in whole.data_vars:
            np.testing.assert_array_equal(whole[name], other[name])


def test_blocks_cover_all_runs_once() -> None:
    for shape in ((3,), (5, 1, 4), (2, 7, 3)):
        for most in (1, 3, 8, 100):
            seen = np.zeros(shape, dtype=int)
            for n, one in enumerate(blocks(shape, most)):
                assert one.number == n
                seen[(one.records, *one.rigs)] += 1
                assert seen[(one.records, *one.rigs)].size <= most
            assert (seen == 1).all()


class _KilledError(Exception):
    pass


def test_what_was_stopped_is_completed_to_the_same(tmp_path) -> None:
    arguments = (RIGS["bumpers"], RECORDS, SCALES)
    how = {"vary": {"gap": [0.02, 0.03, 0.05]}, "block": 2}
    whole = vi.demands(*arguments, **how)
    store = tmp_path / "demands"
    steps: list[int] = []

    def kill(done: int, total: int) -> None:
        steps.append(done)
        if done > total // 2:
            raise _KilledError

    with pytest.raises(_KilledError):
        vi.demands(*arguments, **how, store=store, progress=kill)
    held = xr.open_zarr(store, consolidated=False)
    done = int((held["status"] == 0).sum())
    assert 0 < done < held["status"].size
    # What is there is not computed again: it is marked.
    marked = float(held["peak_acceleration"].values.flat[0])
    assert marked == float(whole["peak_acceleration"].values.flat[0])
    counts: list[int] = []
    again = vi.demands(*arguments, **how, store=store, progress=lambda n, _: counts.append(n))
    assert counts[-1] == whole["status"].size
    for name in whole.data_vars:
        np.testing.assert_array_equal(whole[name], again[name])
    assert again.attrs["parameters"] == whole.attrs["parameters"]
    # Finished, it is read, and by nobody else's values.
    third = vi.demands(*arguments, **how, store=store, progress=lambda n, _: 1 / 0)
    assert third.identical(again)
    with pytest.raises(
        vi.InputError, match="contains a set of demands with other values of scales"
    ):
        vi.demands(RIGS["bumpers"], RECORDS, [1.0], **how, store=store)
    shutil.rmtree(store / "status")
    with pytest.warns(vi.InputWarning, match="is damaged; [0-9]+ of its [0-9]+ parts are computed"):
        mended = vi.demands(*arguments, **how, store=store)
    assert mended.identical(whole)


def test_runs_that_are_given_up_are_told() -> None:
    coarse = noise(8, step=0.5)
    with pytest.warns(
        RuntimeWarning,
        match=r"demands: \d of 2 runs could not be computed: one forcing cycle or record step has "
        "more events",
    ):
        data = vi.demands(RIGS["walls"], coarse, [1e-6, 1.0], max_events=1)
    assert data["status"].values.ravel().tolist() == [0, 2]
    assert np.isnan(data["peak_displacement"].values[0, 1])
    assert np.isfinite(data["peak_displacement"].values[0, 0])
    assert "too_many_events" in data["status"].attrs["flag_meanings"]


def test_it_is_saved_and_read(tmp_path) -> None:
    data = vi.demands(RIGS, RECORDS, SCALES)
    vi.save(data, tmp_path / "demands.nc")
    again = vi.load(tmp_path / "demands.nc")
    np.testing.assert_array_equal(again["peak_force"], data["peak_force"])
    assert json.loads(again.attrs["parameters"])["scales"] == SCALES


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ({"records": []}, "records: missing; pass at least one Record"),
        ({"records": [3]}, r"records\['0'\]: 3 is not a record; pass a Record"),
        (
            {"records": vi.Record([0.0, 0.0], 0.1), "intensity": "PGA"},
            r"records\[0\]: all samples are 0",
        ),
        ({"rig": []}, "rig: the list is empty"),
        ({"rig": 3}, "rig: 3 is not a rig"),
        ({"scales": []}, "scales: the list is empty"),
        ({"scales": [1.0, 0.5]}, r"scales\[1\]: 0.5 follows 1; sort"),
        ({"scales": [0.0]}, r"scales\[0\]: 0"),
        ({"scales": ["3 m"]}, r"scales\[0\]: '3 m'"),
        ({"intensity": "PGV"}, 'intensity: \'PGV\'; pass "factor", "PGA"'),
        ({"intensity": (0.0, 0.05)}, r"intensity\[0\]: 0"),
        ({"vary": {"gap": 0.01}}, r"vary\['gap'\]: 0.01 is not a list"),
        ({"vary": {"gap": []}}, r"vary\['gap'\]: the list is empty"),
        ({"vary": {"gap": [0.01, 0.01]}}, r"vary\['gap'\]: 10 mm is given twice"),
        ({"vary": {"gap": ["1 kg"]}}, r"vary\['gap'\]\[0\]: "),
        ({"vary": {"length": [1.0]}}, "vary: 'length' is unknown; use "),
        (
            {"vary": {"amplitude": [1.0]}},
            "vary: 'amplitude' depends on the shaking, which is not varied here; remove it",
        ),
        ({"vary": {"restitution": [0.5]}}, "vary: 'restitution' is not a parameter of this rig"),
        ({"tail": -1.0}, "tail: -1"),
        ({"block": 0}, "block: 0"),
        ({"threads": 0}, "threads: 0"),
    ],
)
def test_wrong_input(arguments: dict, line: str) -> None:
    keywords = {"rig": RIGS["bumpers"], "records": RECORDS["a"], **arguments}
    with pytest.raises(vi.InputError, match=f"^{line}"):
        vi.demands(**keywords)
