"""The layouts of the formats, whole and damaged, in small made-up files."""

from __future__ import annotations

import gzip
import random
import sys
from collections.abc import Callable

import numpy as np
import pytest

import vibroimpact as vi
from records.layouts import VALUES, cosmos, csmip, esm, geonet, knet, peer, smc
from samples import sample
from vibroimpact.model import GRAVITY

pytestmark = pytest.mark.filterwarnings("ignore::vibroimpact.InputWarning")
"""What is noted is tested in test_notes.py."""

G, CM, MM = GRAVITY, 0.01, 0.001


@pytest.fixture
def written(tmp_path) -> Callable[[list[str]], str]:
    def written(lines: list[str], name: str = "record.dat", end: str = "\n") -> str:
        path = tmp_path / name
        path.write_bytes((end.join(lines) + end).encode())
        return str(path)

    return written


WHOLE = {
    "peer": (peer(), "PEER AT2", G, "Nowhere - Main Street", "045"),
    "peer, no comma": (peer("NPTS= 10, DT= 0.01 SEC"), "PEER AT2", G, None, None),
    "peer, values first": (peer("  10    0.0100    NPTS, DT"), "PEER AT2", G, None, None),
    "peer, an exponent": (peer("NPTS=10,DT=1.0E-02 SEC"), "PEER AT2", G, None, None),
    "peer, one a line": (peer(each=1), "PEER AT2", G, None, None),
    "peer, three a line": (peer(each=3), "PEER AT2", G, None, None),
    "peer, words behind": ([*peer(), "", "filtered at 0.1 Hz"], "PEER AT2", G, None, None),
    "peer, in m/s²": (peer(stated="IN UNITS OF M/SEC/SEC."), "PEER AT2", 1.0, None, None),
    "smc": (smc(), "USGS SMC", CM, "NWH, Nowhere, Main Street", "45"),
    "smc, wider": (smc(14), "USGS SMC", CM, None, "45"),
    "cosmos": (cosmos(), "COSMOS", CM, "XX-NWH, XX Nowhere - Main Street", "45 Deg"),
    "cosmos, g": (cosmos(unit="g.     (02)"), "COSMOS", G, None, "45 Deg"),
    "cosmos, no direction": (cosmos("Other"), "COSMOS", CM, None, "HNZ"),
    "csmip, V2": (csmip(), "CSMIP", CM, "00001, NOWHERE - MAIN STREET", "45 DEG"),
    "csmip, V1": (
        csmip(
            above="   10 Accelerogram points at 100 pts/sec in units of g .  Format: (8f10.3)",
            corrected=False,
        ),
        "CSMIP",
        G,
        None,
        "45 DEG",
    ),
    "csmip, an old end": ([*csmip(), "\x1a" * 40], "CSMIP", CM, None, "45 DEG"),
    "geonet, V2A": (geonet(), "GeoNet", MM, "NWH, Nowhere, Main Street", "N45E"),
    "geonet, V1A": (geonet(corrected=False), "GeoNet", MM, None, "N45E"),
    "esm": (esm(), "ESM", CM, "XX.NWH", "HNE"),
}


@pytest.mark.parametrize("name", WHOLE)
def test_what_stands_there_is_read(written, name):
    lines, form, unit, station, component = WHOLE[name]
    for end in ("\n", "\r\n"):
        record = vi.Record.read(written(lines, end=end))
        np.testing.assert_allclose(record.acceleration, unit * np.array(VALUES), rtol=1e-15)
        assert record.step == pytest.approx(0.01, rel=1e-14)
        about = record.about
        assert about.format == form
        weak = "the peak is 0.000357 g, less than the 0.001 g of usual records: is its unit m/s^2?"
        assert about.notes == ((weak,) if form == "GeoNet" else ())
        if station is not None:
            assert about.station == station
        if component is not None:
            assert about.component == component
        words = dict(record.rows())
        assert words["samples"] == "10"
        assert words["format"] == form


def test_knet_keeps_its_offset_and_says_so(written):
    record = vi.Record.read(written(knet()))
    np.testing.assert_allclose(
        record.acceleration, CM * (1000.0 * np.array(VALUES) + 1000.0), rtol=1e-14
    )
    assert record.step == 0.1
    assert (record.about.station, record.about.component) == ("NWH001", "N-S")
    (left,) = vi.Record.read(written(knet())).about.notes
    assert left.startswith("the mean, 0.847639 g or 27.7 % of the peak, was not subtracted")
    assert vi.Record.read(written(knet("5"))).about.component == "E-W, surface"
    assert vi.Record.read(written(knet("1")), "N-S").about.component == "N-S, borehole"


def test_packed_by_gzip_under_any_name(written, tmp_path):
    packed = tmp_path / "any.name"
    packed.write_bytes(gzip.compress("\n".join(esm()).encode()))
    assert vi.Record.read(packed) == vi.Record.read(written(esm()))
    packed.write_bytes(packed.read_bytes()[:-20])
    with pytest.raises(vi.InputError, match=r"^record: .* is a damaged gzip file \("):
        vi.Record.read(packed)


@pytest.mark.parametrize("layout", [csmip, cosmos, geonet])
def test_one_of_several_components(written, layout):
    names = ["45 DEG", "Up", "135 DEG"] if layout is not geonet else ["N45E", "Up", "S45E"]
    how = "towards" if layout is csmip else "component"
    lines = [line for name in names for line in layout(**{how: name})]
    path = written(lines)
    for number, name in enumerate(names, start=1):
        for chosen in (name, name.lower(), name.split()[0], number, str(number)):
            assert vi.Record.read(path, chosen).about.component == name
    with pytest.raises(vi.InputError) as refused:
        vi.Record.read(path)
    listed = ", ".join(map(repr, names))
    accepted = f"pass {listed}, or a number from 1 to 3"
    assert str(refused.value) == f"component: missing, but {path!r} has 3 components; {accepted}"
    for wrong in ("90", "4", "", "0"):
        with pytest.raises(vi.InputError) as refused:
            vi.Record.read(path, wrong)
        assert (
            str(refused.value) == f"component: {wrong!r} is not a component of {path!r}; {accepted}"
        )


def test_a_name_that_two_components_have(written):
    path = written([*csmip(1, "UP"), *csmip(2, "UP")])
    with pytest.raises(vi.InputError, match="component: 'up' matches 2 components of "):
        vi.Record.read(path, "up")
    assert vi.Record.read(path, 2).peak == 3.5 * CM


def replaced(lines: list[str], old: str, new: str) -> list[str]:
    assert any(old in line for line in lines)
    return [line.replace(old, new) for line in lines]


DAMAGED = {
    "peer, truncated": (peer()[:-1], 5, "the file ends after 5 of 10 values"),
    "peer, more than announced": ([*peer(each=3), "1.0"], 9, "announces 10 values, but 11 follow"),
    "peer, fewer announced": (
        peer("NPTS= 8, DT= .01 SEC"),
        6,
        "the file has 10 values up to this line, but its header announces 8",
    ),
    "peer, more announced": (peer("NPTS= 12, DT= .01 SEC"), 6, "the file ends after 10 of 12"),
    "peer, two headers": (peer() + peer(), 10, "a second header"),
    "peer, decimal commas": (replaced(peer(), ".0000000E+00", ",0000000E+00"), 5, "has a comma"),
    "peer, separated by commas": (replaced(peer(), "E+00 ", "E+00,"), 5, "has a comma"),
    "peer, not a number": (replaced(peer(), "2.0000000E+00", "NaN"), 5, "'NaN' is not finite"),
    "peer, stars": (replaced(peer(), "1.0000000E+00", "***"), 6, r"'\*\*\*' is not a number"),
    "peer, no count": (peer("NPTS, DT= .01 SEC"), 4, "states no number of values"),
    "peer, none": (peer("NPTS= 0, DT= .01 SEC"), 4, "0 values"),
    "smc, truncated": (smc()[:-1], 29, "the file ends after 8 of 10 values"),
    "smc, header alone": (smc()[:20], 20, "the file ends within the header"),
    "smc, no comments": (replaced(smc(), "| made", "  made"), 28, "this line is not a comment"),
    "cosmos, truncated": (cosmos()[:-2], 46, "the file ends after 8 of 10 values"),
    "cosmos, in the header": (cosmos()[:30], 30, "the file ends after"),
    "cosmos, too many": (
        replaced(cosmos(), "   10  accel", "    8  accel"),
        47,
        "announces 8 values, but 10 follow",
    ),
    "cosmos, two headers": (cosmos()[:-1] + cosmos(), 48, "does not end the data of the channel"),
    "csmip, truncated": (csmip()[:-5], 13, "the file ends after 8 of 10"),
    "csmip, too few": (
        replaced(csmip(), "   10 POINTS OF ACC", "    8 POINTS OF ACC"),
        11,
        "announces 8 values, but 10 follow",
    ),
    "csmip, letters": (replaced(csmip(), "-3.5000", "-3.5O00"), 10, "'-3.5O00' is not a number"),
    "csmip, two headers": (csmip()[:8] + csmip(), 9, "a second header"),
    "csmip, a stray line": ([*csmip()[:11], "stray"], 12, "'stray' does not end the channel"),
    "geonet, truncated": (geonet()[:-1], 28, "the file ends after 0 of 10"),
    "geonet, not a number": (replaced(geonet(), " -1.2500", "     nan"), 27, "'nan' is not finite"),
    "geonet, a second header": (geonet()[:27] + geonet(), 28, "the values end here after 0 of 10"),
    "knet, truncated": (knet()[:-1], 18, "the file ends after 8 of 10"),
    "knet, no scale": (knet(scale="none"), 14, "'none' is not a Scale Factor"),
    "knet, too long": (knet() + knet()[-1:], 20, "announces 10 values, but 12 follow"),
    "esm, truncated": (esm()[:-2], 19, "the file ends after 8 of 10"),
    "esm, two headers": (esm() + esm(), 22, "a second header"),
    "esm, count": (replaced(esm(), "NDATA: 10", "NDATA: ten"), 7, "NDATA: 'ten' is not a number"),
    "esm, decimal commas": (replaced(esm(), "-3.5", "-3,5"), 15, "'-3,500000' has a comma"),
    "columns, rows": (
        ["0 1", "0.1 2", "0.2"],
        3,
        "the row has 1 number, but the rows above have 2",
    ),
    "columns, nan": (["0 1", "0.1 nan", "0.2 3"], 2, "a value is missing"),
    "columns, announced": (["3 0.01", "1", "2"], 1, "the file announces 3 values, but 2 follow"),
}


@pytest.mark.parametrize("name", DAMAGED)
def test_what_is_damaged_is_refused_in_one_line_that_names_the_files(written, name):
    lines, at, why = DAMAGED[name]
    path = written(lines)
    with pytest.raises(vi.InputError, match=f"line {at}: .*{why}") as refused:
        vi.Record.read(path)
    assert str(refused.value).startswith(f"record: {path!r}, line {at}: ")
    assert "\n" not in str(refused.value)


NO_STEP = {
    "peer": (peer("NPTS= 10"), "line 4"),
    "peer, of 0": (peer("NPTS= 10, DT= .0000 SEC"), "line 4"),
    "smc": (replaced(smc(), "0.1000000E+03", "0.1700000E+39"), "line 18"),
    "cosmos": (replaced(cosmos(), "    10.000000", "  -999.000000"), "line 36"),
    "csmip": (replaced(csmip(), "EQUALLY SPACED AT  .010 SEC", "EQUALLY SPACED"), "line 9"),
    "geonet": (replaced(geonet(), "  0.0100", "  0.0000"), "line 23"),
    "esm": ([line for line in esm() if "INTERVAL" not in line], "line 10"),
}


@pytest.mark.parametrize("name", NO_STEP)
def test_no_step_is_told_with_the_line_where_it_should_stand(written, name):
    lines, where = NO_STEP[name]
    path = written(lines)
    with pytest.raises(vi.InputError) as refused:
        vi.Record.read(path)
    none = f"has no step in {where}; pass the time between two samples, such as"
    assert str(refused.value).startswith(
        f'step: missing, but {path!r} {none} step="10 ms" (--step 10ms)'
    )
    assert vi.Record.read(path, step="20 ms").step == 0.02


def test_what_the_file_says_can_be_overridden(written):
    path = written(peer())
    record = vi.Record.read(path, unit="m/s^2", step="20 ms", station="elsewhere", label="up")
    np.testing.assert_array_equal(record.acceleration, VALUES)
    assert (record.step, record.about.station, record.about.unit) == (0.02, "elsewhere", "m/s^2")
    assert record.about.component == "up"
    assert record.about.notes == (
        "the step 20 ms replaces the step in the file, 0.01 s",
        "the unit m/s^2 replaces the unit in the file, g",
    )
    with pytest.raises(vi.InputError, match=r"^unit: '1 N' is a force"):
        vi.Record.read(path, unit="N")
    with pytest.raises(vi.InputError, match=r"^record: .*: unit: '1 cm/s' is a velocity"):
        vi.Record.read(written(cosmos(unit="cm/sec(05)")))
    with pytest.raises(
        vi.InputError, match=r"^unit: missing, and the values in .* are counts, not acc"
    ):
        vi.Record.read(written(cosmos(unit="counts(50)")))


LAYOUTS = {f.__name__: f for f in (peer, smc, cosmos, csmip, geonet, knet, esm)}


@pytest.mark.parametrize("name", LAYOUTS)
def test_whatever_is_damaged_is_read_or_refused_in_one_line(tmp_path, name):
    """Cut off, a sign changed, signs left out or put in, a line left out or twice."""
    rng = random.Random(name)
    path = tmp_path / "record.dat"
    messages: list[str] = []
    for _ in range(sample(3000, 300)):
        lines = LAYOUTS[name]()
        text = "\n".join(lines)
        at, length = rng.randrange(len(text)), rng.randint(1, 30)
        signs = "".join(rng.choice(" 0-9.,;aEN\n:|/()=\0") for _ in range(length))
        line = rng.randrange(len(lines))
        text = rng.choice(
            [
                text[:at],
                text[:at] + signs[0] + text[at + 1 :],
                text[:at] + text[at + length :],
                text[:at] + signs + text[at:],
                "\n".join(lines[:line] + lines[line + 1 :]),
                "\n".join(lines[: line + 1] + lines[rng.randrange(len(lines)) :]),
            ]
        )
        path.write_text(text, encoding="utf-8")
        try:
            record = vi.Record.read(path)
        except vi.InputError as error:
            messages.append(str(error))
        else:
            assert np.isfinite(record.acceleration).all()
    assert len(messages) > 100
    assert not any("\n" in line for line in messages)


def test_a_text_that_begins_with_blanks_is_no_miniseed(written):
    words = ["      Record of nothing", "dt = 0.1", *map(str, VALUES)]
    assert vi.Record.read(written(words), unit="g").about.format == "columns"


def test_without_obspy_it_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "obspy", None)
    path = tmp_path / "record.mseed"
    path.write_bytes(b"000001D " + b"\0" * 504)
    with pytest.raises(vi.InputError, match="pip install obspy") as refused:
        vi.Record.read(path)
    assert "\n" not in str(refused.value)


def test_sac_in_either_order_of_bytes_and_miniseed(tmp_path):
    obspy = pytest.importorskip("obspy")
    head = {"network": "XX", "station": "NWH", "channel": "HNE", "delta": 0.01}
    values = np.array(VALUES * 60, dtype=np.float32)
    trace = obspy.Trace(values, head)
    for order in ("<", ">"):
        trace.write(str(tmp_path / "record.sac"), format="SAC", byteorder=order)
        record = vi.Record.read(tmp_path / "record.sac", unit="m/s^2")
        np.testing.assert_array_equal(record.acceleration, values)
        assert record.step == pytest.approx(0.01, rel=1e-7)
        assert (record.about.station, record.about.component) == ("XX.NWH", "HNE")
    trace.stats.sac = {"idep": 7}
    trace.write(str(tmp_path / "velocity.sac"), format="SAC")
    with pytest.raises(
        vi.InputError, match=r"unit: missing, and the values in .* are velocities, not acc"
    ):
        vi.Record.read(tmp_path / "velocity.sac")

    other = obspy.Trace(2 * values, {**head, "channel": "HNN"})
    both = tmp_path / "both.mseed"
    obspy.Stream([trace, other]).write(str(both), format="MSEED", encoding="FLOAT32")
    assert vi.Record.read(both, "HNN", unit="m/s^2").peak == 7.0
    late = obspy.Trace(values, {**head, "starttime": trace.stats.endtime + 5.0})
    obspy.Stream([trace, late]).write(str(both), format="MSEED", encoding="FLOAT32")
    with pytest.raises(vi.InputError, match="has gaps"):
        vi.Record.read(both)
    obspy.Stream([trace]).write(str(both), format="MSEED", encoding="FLOAT32", reclen=512)
    both.write_bytes(both.read_bytes()[:-300])
    with pytest.raises(vi.InputError, match="is a damaged MSEED file"):
        vi.Record.read(both)


def test_negative_numbers_of_free_format_that_touch_each_other(tmp_path):
    head = peer("NPTS=   4, DT= .01 SEC")[:4]
    path = tmp_path / "touching.AT2"
    path.write_text("\n".join([*head, "-12.009201-12.014842 -1.5E+00", "  3.000000", ""]))
    np.testing.assert_allclose(
        vi.Record.read(path).acceleration / 9.80665, [-12.009201, -12.014842, -1.5, 3.0]
    )
