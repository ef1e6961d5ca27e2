"""The dataset of a response spectrum, two components, and what is refused."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys

import numpy as np
import pytest

import vibroimpact as vi

RNG = np.random.default_rng(11)
VALUES = RNG.normal(size=400) * np.hanning(400)
RECORD = vi.Record(VALUES, 0.02)
OTHER = vi.Record(RNG.normal(size=400) * np.hanning(400), 0.02)
PERIODS = [0.0, 0.1, 0.5, 2.0]


def test_dims_units_and_what_it_says_of_itself(tmp_path):
    spectrum = vi.response_spectrum(RECORD, PERIODS, [0.02, 0.05])
    assert dict(spectrum.sizes) == {"damping_ratio": 2, "natural_period": 4}
    units = {
        "natural_period": "s",
        "spectral_displacement": "m",
        "spectral_velocity": "m s-1",
        "spectral_acceleration": "m s-2",
        "pseudo_velocity": "m s-1",
        "pseudo_acceleration": "m s-2",
    }
    for name, unit in units.items():
        assert spectrum[name].attrs["units"] == unit
        assert spectrum[name].attrs["long_name"]
    (about,) = json.loads(spectrum.attrs["parameters"])["record"]
    assert about == {"samples": 400, "step": 0.02, "peak": RECORD.peak}
    assert spectrum.attrs["created_by"] == "vibroimpact.response_spectrum"
    path = vi.save(spectrum, tmp_path / "spectrum.nc")
    assert vi.load(path).equals(spectrum)
    table = vi.to_table(spectrum)
    assert list(table.columns[:2]) == ["damping_ratio", "natural_period"]
    assert len(table) == 8


def test_single_numbers_have_no_dims():
    whole = vi.response_spectrum(RECORD, PERIODS, [0.02, 0.05])
    assert vi.response_spectrum(RECORD, 0.5, 0.02).equals(
        whole.isel(natural_period=2, damping_ratio=0)
    )
    assert dict(vi.response_spectrum(RECORD, [0.5], 0.02).sizes) == {"natural_period": 1}
    assert vi.response_spectrum(RECORD, PERIODS).equals(whole.isel(damping_ratio=1))


def test_two_components():
    spectrum = vi.response_spectrum([RECORD, OTHER], PERIODS, [0.0, 0.05])
    assert spectrum["orientation"].values.tolist() == ["first", "second", "RotD50", "RotD100"]
    assert spectrum["spectral_displacement"].dims == (
        "orientation",
        "damping_ratio",
        "natural_period",
    )
    turned = [
        vi.response_spectrum(
            vi.Record(math.cos(at) * VALUES + math.sin(at) * OTHER.acceleration, 0.02),
            PERIODS,
            [0.0, 0.05],
        )
        for at in np.arange(180) * (math.pi / 180)
    ]
    for name in spectrum.data_vars:
        every = np.array([one[name].values for one in turned])
        expected = [every[0], every[90], np.median(every, axis=0), every.max(axis=0)]
        np.testing.assert_allclose(spectrum[name], expected, rtol=1e-13, atol=1e-30)


def test_components_of_a_motion_along_a_line():
    """All directions see its projection: the median is that at 45 degrees."""
    at = math.radians(30)
    pair = (RECORD.scaled(math.cos(at)), RECORD.scaled(math.sin(at)))
    one = vi.response_spectrum(RECORD, PERIODS)
    spectrum = vi.response_spectrum(pair, PERIODS)
    middle = math.cos(math.radians(45.5)) / 2 + math.cos(math.radians(44.5)) / 2
    half = {"first": math.cos(at), "second": math.sin(at), "RotD100": 1.0, "RotD50": middle}
    for name, share in half.items():
        for what in spectrum.data_vars:
            np.testing.assert_allclose(
                spectrum[what].sel(orientation=name), share * one[what], rtol=2e-4
            )


def test_components_of_another_length_or_step():
    for other, line in (
        (
            vi.Record(VALUES, 0.01),
            "record: the two components have time steps of 0.02 s and 0.01 s; pass ",
        ),
        (
            vi.Record(VALUES[:-1], 0.02),
            "record: the two components have 400 and 399 samples",
        ),
    ):
        with pytest.raises(vi.InputError) as refused:
            vi.response_spectrum([RECORD, other], 1.0)
        assert str(refused.value).startswith(line)
        assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("record", "periods", "damping", "line"),
    [
        (VALUES, 1.0, 0.05, "record: "),
        ([], 1.0, 0.05, "record: [] is not a Record; pass one Record, or two"),
        ([RECORD] * 3, 1.0, 0.05, "record: "),
        (RECORD, -1.0, 0.05, "periods: -1; pass periods of 0 s, or from 1e-9 to 1e9 s"),
        (RECORD, [1.0, math.nan], 0.05, "periods: nan; "),
        (RECORD, 1e-12, 0.05, "periods: 1e-12; "),
        (RECORD, math.inf, 0.05, "periods: inf; "),
        (RECORD, [], 0.05, "periods: []; "),
        (RECORD, [[1.0]], 0.05, "periods: [[1.0]]; "),
        (RECORD, "1 s", 0.05, "periods: '1 s'; "),
        (RECORD, 1.0, 1.0, "damping: 1; pass damping ratios from 0 to less than 1"),
        (RECORD, 1.0, -0.05, "damping: -0.05; "),
        (RECORD, 1.0, [0.05, math.nan], "damping: nan; "),
    ],
)
def test_what_is_refused(record, periods, damping, line):
    with pytest.raises(vi.InputError) as refused:
        vi.response_spectrum(record, periods, damping)
    assert str(refused.value).startswith(line)
    assert "\n" not in str(refused.value)


def test_a_record_of_nothing():
    spectrum = vi.response_spectrum(vi.Record([0.0, 0.0, 0.0], 0.1), PERIODS, [0.0, 0.05])
    for name in spectrum.data_vars:
        assert (spectrum[name] == 0.0).all()


def test_progress_is_told_until_all_is_done():
    counts = []
    vi.response_spectrum(
        RECORD, np.geomspace(0.1, 1, 20), [0.0, 0.1], progress=lambda *x: counts.append(x)
    )
    assert counts[-1] == (40, 40)


@pytest.mark.full
def test_without_the_compiler_it_is_the_same():
    code = (
        "import numpy as np, vibroimpact as vi\n"
        "values = np.sin(np.arange(12.0))\n"
        "spectrum = vi.response_spectrum(vi.Record(values, 0.1), [0.05, 0.7], [0.0, 0.2])\n"
        "print(spectrum['spectral_displacement'].values.ravel().tolist())"
    )
    outputs = [
        subprocess.run(
            [sys.executable, "-W", "error", "-c", code],
            env={**os.environ, "NUMBA_DISABLE_JIT": off},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for off in ("0", "1")
    ]
    np.testing.assert_allclose(json.loads(outputs[0]), json.loads(outputs[1]), rtol=1e-13)
