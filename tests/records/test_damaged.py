"""Files that were cut, that unpack to too much, or that state a scale."""

from __future__ import annotations

import gzip
import random
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

import vibroimpact as vi
from measured import measured
from samples import sample

CUTS = sample(120, 15)
FILES = ("GS.SEW..HN1", "NP.2825..HNE")


@pytest.mark.parametrize("name", FILES)
def test_a_miniseed_file_that_ends_within_a_record_is_refused(tmp_path, name):
    pytest.importorskip("obspy")
    data = measured(f"records/mseed/{name}.mseed").read_bytes()
    draw = random.Random(2)
    for _ in range(CUTS):
        size = draw.randrange(1, len(data))
        size -= size % 512 == 0
        (tmp_path / "cut.mseed").write_bytes(data[:size])
        with pytest.raises(vi.InputError) as refused:
            vi.Record.read(tmp_path / "cut.mseed", unit="m/s^2")
        assert "\n" not in str(refused.value)


def test_a_packed_file_that_becomes_too_large_is_refused_before_it_is_unpacked(tmp_path):
    path = tmp_path / "bomb.gz"
    part = gzip.compress(bytes(2**24))
    path.write_bytes(part * 17)
    with pytest.raises(vi.InputError, match="has more than 256 MiB of data"):
        vi.Record.read(path)
    assert path.stat().st_size < 2**19


def traces(path: Path, *parts: tuple[str, str, float, np.ndarray], form: str = "MSEED", **about):
    obspy = pytest.importorskip("obspy")
    stream = obspy.Stream()
    for station, channel, at, values in parts:
        head = {"network": "XX", "station": station, "channel": channel, "delta": 0.01}
        head["starttime"] = obspy.UTCDateTime(2020, 1, 1) + at
        stream.append(obspy.Trace(values, {**head, **about}))
    stream.write(str(path), form)
    return str(path)


def test_two_stations_are_told_apart(tmp_path):
    values = np.sin(0.1 * np.arange(500))
    path = traces(tmp_path / "a", ("AAA", "HNE", 0, values), ("BBB", "HNE", 0, 2.0 * values))
    with pytest.raises(vi.InputError, match=r"has 2 components; pass 'XX\.AAA HNE', 'XX\.BBB HNE'"):
        vi.Record.read(path, unit="m/s^2")
    assert vi.Record.read(path, "XX.BBB HNE", unit="m/s^2").peak == pytest.approx(2.0, rel=1e-3)


def test_an_overlap_is_no_gap(tmp_path):
    values = np.sin(0.1 * np.arange(500))
    for at, message in ((3.0, "has overlapping parts that differ"), (7.0, "has gaps")):
        path = traces(tmp_path / "a", ("AAA", "HNE", 0, values), ("AAA", "HNE", at, -1.0 - values))
        with pytest.raises(vi.InputError, match=message):
            vi.Record.read(path, unit="m/s^2")


def test_a_gap_of_years_takes_no_memory(tmp_path):
    """One flipped bit of a date: obspy would fill the gap with samples."""
    values = np.sin(0.1 * np.arange(500))
    for at in (5e5, 1e9):  # 5e7 and 1e11 samples
        path = traces(tmp_path / "a", ("AAA", "HNE", 0, values), ("AAA", "HNE", at, values))
        tracemalloc.start()
        with pytest.raises(vi.InputError, match="has gaps"):
            vi.Record.read(path, unit="m/s^2")
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < 2**26


def test_the_scale_of_sac_is_used_of_counts_and_noted_of_others(tmp_path):
    counts = np.round(1000.0 * np.sin(0.1 * np.arange(500))).astype(np.float32)
    path = traces(tmp_path / "a.sac", ("AAA", "HNE", 0, counts), form="SAC", calib=1e-3)
    with pytest.warns(
        vi.InputWarning, match="the values were multiplied by 0.001, the scale in the header"
    ):
        record = vi.Record.read(path, unit="m/s^2")
    np.testing.assert_allclose(record.acceleration, 1e-3 * counts, rtol=1e-6)
    scaled = (counts / 3000.0).astype(np.float32)
    path = traces(tmp_path / "b.sac", ("AAA", "HNE", 0, scaled), form="SAC", calib=1e-3)
    with pytest.warns(vi.InputWarning, match="scale in the header, 0.001, is not used"):
        record = vi.Record.read(path, unit="m/s^2")
    np.testing.assert_array_equal(record.acceleration, scaled.astype(float))
