"""Files of all formats from their networks: counts, steps, peaks and times as the files state."""

from __future__ import annotations

import importlib.util
from typing import NamedTuple

import numpy as np
import pytest

import vibroimpact as vi
from measured import measured
from vibroimpact.model import GRAVITY
from vibroimpact.records.read import read_channel

pytestmark = pytest.mark.filterwarnings("ignore::vibroimpact.InputWarning")
"""What is noted is tested in test_notes.py."""


class Stated(NamedTuple):
    """Of one component."""

    component: str | int | None
    count: int
    step: float
    peak: float
    time: float
    """When the peak is, s; None where the header takes another of two."""


G, CM, MM, SI = GRAVITY, 0.01, 0.001, 1.0
FILES: dict[str, tuple[str, float, list[Stated]]] = {
    "peer_at2/RSN763_LOMAP_GIL067.AT2": (
        "PEER AT2",
        G,
        [Stated(None, 7999, 0.005, -0.35853, 3.365)],
    ),
    "peer_at2/RSN10590_ComalTX11-10-20_IU.CCM.BH1.00.AT2": (
        "PEER AT2",
        G,
        [Stated(None, 15306, 0.05, -2.58532e-6, 311.05)],
    ),
    "peer_at2/NIS090.AT2": ("PEER AT2", G, [Stated(None, 4096, 0.01, -0.502749, 7.09)]),
    "cosmos/NCMLI--n.00725272.HNE.--.V1c": (
        "COSMOS",
        CM,
        [Stated("HNE", 19200, 0.01, -24.29485, 53.83)],
    ),
    "cosmos/CE23837.V1C.gz": (
        "COSMOS",
        G,
        [
            Stated("360", 13400, 0.005, -0.105433, 31.575),
            Stated("up", 13400, 0.005, 0.048757, 30.085),
            Stated("HNE", 13400, 0.005, -0.059022, 32.075),
        ],
    ),
    "cosmos/us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c.gz": (
        "COSMOS",
        CM,
        [Stated(None, 42000, 0.005, -6.851512, 76.215)],
    ),
    "cosmos/Cosmos12TimeSeriesTest.v1": (
        "COSMOS",
        CM,
        [Stated("340", 7000, 0.010, -161.9618, 27.85)],
    ),
    "csmip/CE89146.V1": (
        "CSMIP",
        G,
        [
            Stated("360", 13200, 0.005, 0.07918, 30.590),
            Stated("Up", 13200, 0.005, 0.021055, 30.590),
            Stated("90 Deg", 13200, 0.005, -0.04529, 30.575),
        ],
    ),
    "csmip/ce23583r_HESPERIA.RAW.gz": (
        "CSMIP",
        G,
        [
            Stated("90", 12001, 0.005, 0.057921, 9.425),
            Stated("Up", 12001, 0.005, 0.04203, 10.235),
            Stated("180", 12001, 0.005, -0.090583, 9.615),
        ],
    ),
    "csmip/ce36456p_CE36456.V2": (
        "CSMIP",
        CM,
        [
            Stated("90", 3251, 0.02, -267.957, 10.94),
            Stated("UP", 3250, 0.02, -94.805, 11.68),
            Stated("0", 3250, 0.02, -256.231, 7.74),
        ],
    ),
    "csmip/CE58667.V2.gz": (
        "CSMIP",
        CM,
        [
            Stated("H1", 7500, 0.01, 27.11358, 32.57),
            Stated(2, 7500, 0.01, 11.24367, 36.70),
            Stated("3", 7500, 0.01, -26.41128, 30.72),
        ],
    ),
    "usgs_smc/0111a.smc": ("USGS SMC", CM, [Stated("360", 6001, 0.005, 104.41, 10.17)]),
    "usgs_smc/0165a_u.smc": ("USGS SMC", CM, [Stated("90", 6012, 0.005, -263.49, 3.40)]),
    "usgs_smc/A-CAT090.AT2.smc": ("USGS SMC", CM, [Stated(None, 1646, 0.02, 41.355427, 11.42)]),
    "sac/BRIHN1.GS..sac": ("SAC", SI, [Stated("HN1", 12500, 0.01, 0.9013136, 33.46)]),
    "sac/HAWABHN.US..sac": ("SAC", SI, [Stated(None, 9600, 0.025, -8.93317e-5, 145.35)]),
    "mseed/NP.2825..HNE.mseed": ("miniSEED", SI, [Stated("HNE", 43470, 0.005, -75694.0, 74.11)]),
    "mseed/CE.79435.10.HNE__20211220T201310Z__20211220T202040Z.mseed": (
        "miniSEED",
        SI,
        [Stated(None, 45000, 0.01, -12703.0, 62.18)],
    ),
    "mseed/GS.SEW..HN1.mseed": ("miniSEED", SI, [Stated(None, 12784, 0.01, -1.66268, 32.65)]),
    "geonet/20161113_110313_THZ_20.V1A.gz": (
        "GeoNet",
        MM,
        [
            Stated("S90E", 59200, 0.005, 399.7, 115.365),
            Stated("n00e", 59200, 0.005, 484.6, 93.845),
            Stated("Up", 59200, 0.005, -249.1, 117.74),
        ],
    ),
    # The printed times leave out the 250 samples of the lead: 43.68, 43.66 and 40.36 s there.
    "geonet/20180212_211557_WPWS_20.V2A.gz": (
        "GeoNet",
        MM,
        [
            Stated("S16W", 5800, 0.02, -41.6, 48.68),
            Stated("S74E", 5800, 0.02, -194.0, 48.66),
            Stated("Up", 5800, 0.02, -27.3, 45.36),
        ],
    ),
}


def test_there_are_as_many_as_were_kept():
    assert len(FILES) == 21
    kept = [p for p in measured("records").glob("*/*") if p.parent.name != "LICENSES"]
    assert {f"{p.parent.name}/{p.name}" for p in kept} == set(FILES)


@pytest.mark.parametrize("name", FILES)
def test_what_is_read_is_what_the_file_states(name):
    form, unit, components = FILES[name]
    if form in ("SAC", "miniSEED") and not importlib.util.find_spec("obspy"):
        pytest.skip("obspy is not installed")
    path = measured(f"records/{name}")
    for stated in components:
        said = "m/s^2" if form in ("miniSEED", "SAC") else None  # neither states a unit
        record = vi.Record.read(path, stated.component, unit=said)
        assert record.about.format == form
        values = record.acceleration
        assert len(values) == stated.count
        assert record.step == pytest.approx(stated.step, rel=1e-12)
        at = int(np.abs(values).argmax())
        assert values[at] / unit == pytest.approx(stated.peak, rel=1e-5)
        assert record.peak_time == pytest.approx(stated.time, abs=1e-9)
    if len(components) > 1:
        with pytest.raises(
            vi.InputError, match=r"component: missing, but .* has 3 components; pass '"
        ) as refused:
            vi.Record.read(path)
        assert "\n" not in str(refused.value)
        _, _, names = read_channel(path, components[0].component)
        for one in names:
            assert repr(one) in str(refused.value)


def test_counts_need_a_unit():
    pytest.importorskip("obspy")
    path = measured("records/mseed/NP.2825..HNE.mseed")
    with pytest.raises(
        vi.InputError, match=r"unit: missing, and the values in .* are counts, not acc.*--scale"
    ):
        vi.Record.read(path)
    record = vi.Record.read(path, unit="m/s^2").scaled(1 / 214748)
    assert record.peak == pytest.approx(0.353, rel=2e-3)
    left, large, scaled = record.about.notes
    assert large.startswith("the peak is 7.72e+03 g, more than the 5 g of usual records")
    assert left.startswith("the mean, ")
    assert left.endswith(" or 46.2 % of the peak, was not subtracted")
    assert scaled == "scaled by 4.65662e-06"
    assert "mean subtracted: -0.16298" in record.levelled().about.notes[-1]


def test_the_unit_of_a_sac_file_is_asked_for():
    pytest.importorskip("obspy")
    with pytest.raises(vi.InputError, match=r"^unit: missing, because .* the largest .* is 0\.901"):
        vi.Record.read(measured("records/sac/BRIHN1.GS..sac"))


def test_a_record_of_one_header_line_with_count_and_step():
    record = vi.Record.read(measured("eqsig/test_motion_dt0p01.txt"), unit="m/s^2")
    assert len(record.acceleration) == 4684
    assert record.step == 0.01
    assert record.peak == pytest.approx(1.41, rel=1e-2)


def test_three_channels_of_unequal_length():
    path = measured("usgs/CICLC.v1.gz")
    record = vi.Record.read(path, "90")
    assert (len(record.acceleration), record.step) == (31932, 0.01)
    assert record.peak / GRAVITY == pytest.approx(0.344250, rel=1e-6)
    assert len(vi.Record.read(path, "up").acceleration) == 32190
