"""Files of further networks: what they hold, and what of their headers contradicts their values."""

from __future__ import annotations

import random
from collections.abc import Callable

import numpy as np
import pytest

import vibroimpact as vi
from records import layouts
from records.layouts import EVEN, UNEVEN, VALUES
from samples import sample
from vibroimpact.model import GRAVITY
from vibroimpact.records.read import FORMATS
from vibroimpact.tables.file import File

pytestmark = pytest.mark.filterwarnings("ignore::vibroimpact.InputWarning")

CM, G = 0.01, GRAVITY
Layout = Callable[..., list[str]]


@pytest.fixture
def written(tmp_path) -> Callable[[list[str]], str]:
    def written(lines: list[str], end: str = "\n") -> str:
        path = tmp_path / "record.dat"
        path.write_bytes((end.join(lines) + end).encode("latin-1"))
        return str(path)

    return written


ONE = {
    "csmip_pairs": ("CSMIP", 0.1 * G, "00001, NOWHERE - MAIN STREET", "45 DEG", EVEN),
    "renadic": ("RENADIC", 0.1 * G, "NOWHERE - MAIN STREET", "EW", None),
    "cosmos_counts": ("COSMOS", G, "XX-NWH, XX Nowhere - Main Street", "45 Deg", None),
    "smc_pairs": ("USGS SMC", CM, "NWH, Nowhere, Main Street", "45", EVEN),
    "csmnc": ("CSMNC", CM, "00NWH", "EW", None),
}
THREE = {
    "knet_csv": ("K-NET CSV", "NWH001", ["N-S", "E-W", "U-D"]),
    "cwb": ("CWB", "NWH", ["U", "N", "E"]),
    "nsmn": ("NSMN", "0001, NOWHERE", ["N-S", "E-W", "U-D"]),
    "unam": ("UNAM", "NWHR", ["V", "N00E", "N90E"]),
}
"""Files of three components in gal: the values, their double and their triple."""


@pytest.mark.parametrize("name", ONE)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_one_component_is_read(written, name, end):
    form, unit, station, component, times = ONE[name]
    layout: Layout = getattr(layouts, name)
    lines = layout(times) if times else layout()
    lines = [line.replace("LENGTH = .081", "LENGTH = .090") for line in lines]
    record = vi.Record.read(written(lines, end))
    values = np.round(VALUES, 3) if unit == 0.1 * G else np.array(VALUES)  # as they are written
    np.testing.assert_allclose(record.acceleration, unit * values, rtol=1e-12)
    assert record.step == 0.01
    about = record.about
    assert (about.format, about.station, about.component) == (form, station, component)


@pytest.mark.parametrize("name", THREE)
def test_three_components_are_read(written, name):
    form, station, components = THREE[name]
    path = written(getattr(layouts, name)())
    for factor, component in enumerate(components, start=1):
        record = vi.Record.read(path, component)
        np.testing.assert_allclose(record.acceleration, CM * factor * np.array(VALUES), rtol=1e-12)
        assert record.step == pytest.approx(0.01, rel=1e-12)
        about = record.about
        assert (about.format, about.station, about.component) == (form, station, component)
    with pytest.raises(vi.InputError, match=f"has 3 components; pass '{components[0]}'"):
        vi.Record.read(path)


def test_the_borehole_and_the_surface_of_a_kiknet_csv_file(written):
    path = written(layouts.knet_csv("1(gal),2(gal),3(gal),4(gal),5(gal),6(gal)"))
    assert vi.Record.read(path, "5").about.component == "E-W, surface"
    assert vi.Record.read(path, "5").peak == pytest.approx(5 * 3.5 * CM)
    assert vi.Record.read(path, "U-D, borehole").peak == pytest.approx(3 * 3.5 * CM)
    with pytest.raises(vi.InputError, match="'E-W' matches 2 components"):
        vi.Record.read(path, "E-W")


SAMPLES: dict[str, Layout] = {
    name: getattr(layouts, name)
    for name in ("peer", "smc", "smc_pairs", "cosmos", "cosmos_counts", "csmip", "csmip_pairs",
                 "renadic", "geonet", "knet", "knet_csv", "esm", "lvm", "cwb", "nsmn", "csmnc",
                 "unam")
}  # fmt: skip
OF_TEXT = {form.name for form in FORMATS} - {"miniSEED", "SAC", "columns"}


def test_each_file_is_of_one_format(written):
    formats = set()
    for name, layout in SAMPLES.items():
        file = File(written(layout()))
        forms = [form.name for form in FORMATS[:-1] if form.recognises(file)]
        assert len(forms) == 1, name
        formats |= set(forms)
    assert formats == OF_TEXT


CONTRADICTED = {
    "csmip_pairs": [
        ({"count": "12"}, "the values end here after 10 of 12"),
        ({"count": "5"}, "announces 5 values, but 10 follow"),
        ({"count": "8"}, "has 10 values up to this line, but its header announces 8"),
        ({"times": EVEN, "lasts": ".500"}, "but 10 samples in steps of 0.01 s last 0.09 s"),
        (
            {"times": EVEN, "lasts": ".09", "peak": "-3.50 G"},
            "a peak of 3.5 .*, but the largest value is 0.35 ",
        ),
        (
            {"times": EVEN, "lasts": ".09", "unit": "G"},
            "a peak of 0.35 .*, but the largest value is 3.5 ",
        ),
    ],
    "renadic": [
        ({"count": "12"}, "the values end here after 10 of 12"),
        ({"lasts": "0.200"}, "but 10 samples in steps of 0.01 s last 0.09 s"),
        ({"peak": "0.450 G"}, "a peak of 0.45 .*, but the largest value is 0.35 "),
    ],
    "smc_pairs": [
        ({"count": 24}, "the file ends after 20 of 24 values"),
        (
            {"times": EVEN, "least": " -0.3600000E+01"},
            "a peak of 3.6 .*, but the largest value is 3.5 ",
        ),
    ],
    "knet_csv": [
        ({"lasts": "0.2"}, "announces 20 values, but 10 follow"),
        ({"lasts": "0.05", "rate": "200"}, "a step of 0.005 s, but its times have steps of 0.01 s"),
    ],
    "cwb": [
        ({"lasts": "0.2"}, "announces 20 values, but 10 follow"),
        ({"lasts": "0.2", "rate": "50"}, "a step of 0.02 s, but its times have steps of 0.01 s"),
        ({"most": "2.0~  -35.0"}, "a peak of 35 .*, but the largest value is 3.5 "),
    ],
    "nsmn": [
        ({"count": "12"}, "announces 12 values, but 10 follow"),
        ({"count": "8"}, "announces 8 values, but 10 follow"),
        ({"peak": "3.4"}, ""),
        ({"peak": "350.0"}, "a peak of 350 .*, but the largest value is 3.5 "),
    ],
    "csmnc": [
        ({"count": "12"}, "the file ends after 10 of 12 values"),
        ({"count": "8"}, "announces 8 values, but 10 follow"),
        ({"step": "0.02"}, "but 10 samples in steps of 0.02 s last 0.18 s"),
        ({"peak": "35.0"}, "a peak of 35 .*, but the largest value is 3.5 "),
    ],
    "unam": [
        ({"count": "12"}, "announces 12 values, but 10 follow"),
        ({"step": "0.02"}, "a step of 0.01 s, but its intervals have steps of 0.02 s"),
        ({"lasts": "1.0"}, "but 10 samples in steps of 0.01 s last 0.09 s"),
        ({"peak": "-0.0035"}, "a peak of 0.0035 .*, but the largest value is 3.5 "),
    ],
}


@pytest.mark.parametrize("name", CONTRADICTED)
def test_a_statement_that_the_values_contradict_is_refused_with_both_numbers(written, name):
    component = None if name in ONE else 1
    for said, both in CONTRADICTED[name]:
        path = written(SAMPLES[name](**said))
        if not both:  # agrees within the digits of the header
            assert vi.Record.read(path, component).peak == pytest.approx(3.5 * CM)
            continue
        with pytest.raises(vi.InputError, match=rf"^record: .*, line \d+.*{both}") as refused:
            vi.Record.read(path, component)
        assert "\n" not in str(refused.value)


def test_the_argument_of_the_user_replaces_a_contradicted_statement(written):
    # The values are in m/s², although the header states G.
    path = written(layouts.csmip_pairs(EVEN, unit="G", peak="-.357 G", lasts=".9"))
    with pytest.raises(vi.InputError, match=r"line 11 states 'RECORD LENGTH = \.9 SEC', but 10 "):
        vi.Record.read(path, unit="m/s^2")
    with pytest.raises(vi.InputError, match=r"a peak of 0\.357 g, but the largest value is 3.5 g"):
        vi.Record.read(path, step=0.01)
    record = vi.Record.read(path, step=0.01, unit="m/s^2")
    assert record.peak == 3.5
    assert "the unit m/s^2 replaces the unit in the file, g" in record.about.notes


def test_the_older_formats_compare_their_headers_too(written):
    lines = layouts.csmip(corrected=False, above="   10 POINTS OF ACCEL DATA EQUALLY SPACED AT .01 "
                          "SEC. (UNITS: G)")  # fmt: skip
    peak = "UNITS OF UNCOR ACCEL IS G.                 MAX  =   {} G, AT   9.425 SEC."
    length = "NO. OF POINTS =  {}  RECORD LENGTH = {} SEC"
    knet, esm, geonet = layouts.knet(), layouts.esm(), layouts.geonet(corrected=False)
    at = geonet.index("text")

    def between(head: list[str], at: int, *more: str) -> list[str]:
        return [*head[:at], *more, *head[at:]]

    lasts = "but 10 samples in steps of 0.01 s last 0.09 s"
    for path, both in (
        (between(lines, 5, peak.format("3.500")), ""),
        (between(lines, 5, peak.format("0.350")), "a peak of 0.35 g, but the largest value is 3.5"),
        (between(lines, 5, length.format(10, "0.1")), ""),
        (between(lines, 5, length.format(11, "0.1")), "10 values here, but 11 in line 6"),
        (between(lines, 5, length.format(10, "1.0")), lasts),
        ([x.replace("3331.25", "333.125") for x in knet], "peak of 333.125 .* value is 3000 "),
        (between(esm, 4, "PGA_CM/S^2: -3.5", "DURATION_S: 0.1"), ""),
        (between(esm, 4, "PGA_CM/S^2: ", "DURATION_S: "), ""),
        (between(esm, 4, "PGA_CM/S^2: 35.0"), "a peak of 35 .* largest value is 3.5 "),
        (between(esm, 4, "DURATION_S: 10.0"), lasts),
        (
            [*geonet[:at], "Acceleration:  Peak   35.0 mm/s/s at  0.03 s", *geonet[at + 1 :]],
            "a peak of 35 mm.* largest value is 3.5 mm",
        ),
        ([*geonet[:at], "Number of points    10    Duration 1.10 s", *geonet[at + 1 :]], lasts),
        (
            [*geonet[:at], "Number of points    20    Duration 0.10 s", *geonet[at + 1 :]],
            "announces 20 values here, but 10 in line 20",
        ),
    ):
        if not both:
            vi.Record.read(written(path))
            continue
        with pytest.raises(vi.InputError, match=both):
            vi.Record.read(written(path))


NO_UNIT = {
    "csmip_pairs": {"times": EVEN, "lasts": ".09", "unit": "...", "peak": "0 G"},
    "cwb": {"unit": ""},
    "nsmn": {"unit": "()", "peak": "0"},
    "csmnc": {"unit": ""},
    "unam": {"unit": "", "peak": "0"},
}


@pytest.mark.parametrize("name", NO_UNIT)
def test_a_unit_that_is_stated_nowhere_is_asked_for(written, name):
    path = written(SAMPLES[name](**NO_UNIT[name]))
    component = None if name in ONE else 1
    with pytest.raises(vi.InputError, match=r'^unit: missing, .* unit="g" \(--unit g\)$'):
        vi.Record.read(path, component)
    assert vi.Record.read(path, component, unit="gal").peak == pytest.approx(3.5 * CM)


def test_a_step_that_is_stated_nowhere_is_asked_for(written):
    for lines, line in ((layouts.nsmn(step="0.00"), 6), (layouts.csmnc(step="0.000"), 6)):
        with pytest.raises(
            vi.InputError, match=rf"^step: missing, but .* has no step in line {line}"
        ):
            vi.Record.read(written(lines), 1)


TRUNCATED = {
    "csmip_pairs": (-2, "the file ends after 5 of 10 values"),
    "renadic": (-2, "the file ends after 5 of 10 values"),
    "cosmos_counts": (-2, "the file ends after 8 of 10 values"),
    "smc_pairs": (-1, "the file ends after 16 of 20 values"),
    "knet_csv": (-3, "announces 10 values, but 7 follow"),
    "cwb": (-3, "announces 10 values, but 7 follow"),
    "nsmn": (-3, "announces 10 values, but 7 follow"),
    "csmnc": (-1, "the file ends after 8 of 10 values"),
    "unam": (-3, "announces 10 values, but 7 follow"),
}


@pytest.mark.parametrize("name", TRUNCATED)
def test_a_truncated_file_is_refused(written, name):
    end, both = TRUNCATED[name]
    lines = SAMPLES[name]()
    component = None if name in ONE else 1
    with pytest.raises(vi.InputError, match=both):
        vi.Record.read(written(lines[:end]), component)
    for end in range(1, len(lines) - 1):  # within the header, too
        with pytest.raises(vi.InputError) as refused:
            vi.Record.read(written(lines[:end]), component)
        assert "\n" not in str(refused.value)


@pytest.mark.parametrize("name", TRUNCATED)
def test_whatever_is_damaged_is_read_or_refused_in_one_line(tmp_path, name):
    rng = random.Random(name)
    path = tmp_path / "record.dat"
    messages = []
    for _ in range(sample(1500, 150)):
        text = "\n".join(SAMPLES[name]())
        at, length = rng.randrange(len(text)), rng.randint(0, 12)
        signs = "".join(rng.choice(" 0-9.,;aEN\n:|/()=#") for _ in range(rng.randint(0, 6)))
        path.write_text(text[:at] + signs + text[at + length :], encoding="utf-8")
        try:
            record = vi.Record.read(path, 1, step=rng.choice([None, 0.004]))
        except vi.InputError as error:
            messages.append(str(error))
        else:
            assert np.isfinite(record.acceleration).all()
    assert len(messages) > 20
    assert not any("\n" in line for line in messages)


@pytest.mark.parametrize("name", ["knet_csv", "cwb", "nsmn", "unam"])
def test_a_row_without_a_number_is_refused_with_its_line(written, name):
    lines = SAMPLES[name]()
    separator = "," if name == "knet_csv" else " "
    last = lines[-1].rsplit(separator, 1)[0]
    for damaged, why in (
        (last, "the row has . columns, but the header announces"),
        (f"{last}{separator}---", "'---' is not a number"),
        (f"{last}{separator}nan", "'nan' is not finite"),
    ):
        with pytest.raises(vi.InputError, match=f"line {len(lines)}: .*{why}"):
            vi.Record.read(written([*lines[:-1], damaged]), 1)


def test_uneven_times_are_interpolated_at_the_step_of_the_user(written):
    for layout, unit in ((layouts.csmip_pairs, 0.1 * G), (layouts.smc_pairs, CM)):
        path = written(layout())
        with pytest.raises(
            vi.InputError,
            match=r"its times are uneven, with steps from 0\.004 to 0\.013 s; pass a step as step=",
        ):
            vi.Record.read(path)
        record = vi.Record.read(path, step="1 ms")  # all times are multiples of it
        assert record.step == 0.001
        at = np.round(np.array(UNEVEN) / 0.001).astype(int)
        values = np.round(VALUES, 3) if unit == 0.1 * G else np.array(VALUES)
        np.testing.assert_allclose(record.acceleration[at], unit * values, rtol=1e-9)
        assert len(record.acceleration) == 82
        middle = unit * (VALUES[3] + (VALUES[4] - VALUES[3]) / 9.0)
        assert record.acceleration[22] == pytest.approx(middle, rel=1e-12)
        note = "10 values at uneven times were interpolated at steps of 1 ms, which lowers the peak"
        assert f"the {note} by 0.00 %" in record.about.notes
        coarse = vi.Record.read(path, step="5 ms")
        expected = np.interp(0.005 * np.arange(17), UNEVEN, unit * values)
        np.testing.assert_allclose(coarse.acceleration, expected, rtol=1e-9, atol=1e-12)
        share = 100.0 * (1.0 - np.abs(expected).max() / (3.5 * unit))
        assert f"lowers the peak by {share:.2f} %" in "; ".join(coarse.about.notes)
        for step in ("1 s", "1 ps"):
            with pytest.raises(vi.InputError, match=r"^step: 1.* is outside \["):
                vi.Record.read(path, step=step)


def test_columns_that_touch_are_cut_at_their_width(written):
    lines = layouts.unam(peak="0")
    lines[-1] = f"{-1000.25:10.4f}{-2000.5:10.4f}{0.0:10.4f}"
    assert vi.Record.read(written(lines), "V").peak == pytest.approx(10.0025)


def test_times_that_decrease_are_refused(written):
    wrong = [*UNEVEN[:4], 0.001, *UNEVEN[5:]]
    with pytest.raises(vi.InputError, match=r"line 28: the time 0\.021 s is followed by 0\.001 s"):
        vi.Record.read(written(layouts.csmip_pairs(wrong)), step=0.01)


def test_rounded_times_give_their_average_step(written):
    times = [0.011 if n == 1 else 0.01 * n for n in range(10)]
    record = vi.Record.read(written(layouts.csmip_pairs(times, lasts=".090")))
    assert record.step == 0.01
    assert "so the average step of" in "; ".join(record.about.notes)


def test_values_in_tenths_of_g_below_a_line_that_describes_them(written):
    above = "   10 POINTS OF ACCEL DATA EQUALLY SPACED AT  .010 SEC.  (UNITS: {})"
    for unit, size in (("G/10", 0.1 * G), ("G", G), ("CM/SEC/SEC", CM)):
        lines = layouts.csmip(above=above.format(unit), corrected=False)
        assert vi.Record.read(written(lines)).peak == pytest.approx(3.5 * size)


def test_an_evenly_sampled_smc_file_with_times(written):
    record = vi.Record.read(written(layouts.smc_pairs(EVEN, rate="  0.1000000E+03")))
    np.testing.assert_allclose(record.acceleration, CM * np.array(VALUES), rtol=1e-12)
    lines = layouts.smc()  # values alone, of which every other one rises
    lines[28:] = layouts.lines_of([layouts.short(v) for v in sorted(VALUES)], 8)
    assert len(vi.Record.read(written(lines)).acceleration) == 10


def test_the_line_after_the_pairs_of_an_smc_file_is_reported(written):
    lines = layouts.smc_pairs(EVEN)
    record = vi.Record.read(written([*lines, lines[-2]]))
    assert len(record.acceleration) == 10
    assert "line 32, after the 20 numbers that the header announces, is not read" in (
        record.about.notes
    )
    with pytest.raises(vi.InputError, match="announces 20 values, but 36 follow"):
        vi.Record.read(written([*lines, lines[-2], lines[-2]]))


def test_counts_of_cosmos_without_the_size_of_a_count(written):
    note = "the counts were multiplied by 2.5e-07 g, computed from the header"
    assert note in vi.Record.read(written(layouts.cosmos_counts())).about.notes
    record = vi.Record.read(written(layouts.cosmos_counts(gain="4.000000")))
    assert record.peak == pytest.approx(3.5 * G / 4.0)
    record = vi.Record.read(written(layouts.cosmos_counts(gain="-999.000000")))
    assert f"{note}, which states no gain: a gain of 1 was assumed" in record.about.notes
    velocity = [
        line.replace("       0       1", "       0       2") for line in layouts.cosmos_counts()
    ]
    for lines in (
        layouts.cosmos_counts(size="-999.000000"),
        layouts.cosmos_counts(sensitivity="-999.000000"),
        velocity,
    ):
        with pytest.raises(vi.InputError, match=r"unit: missing, and the values in .* are counts"):
            vi.Record.read(written(lines))
    for old, new, both in (
        ("14000000.", " 1400000.", "a peak of 0.35 g, but the largest value is 3.5 g"),
        ("     0.100000", "     1.000000", r"but 10 samples in steps of 0.01 s last 0.09 s"),
    ):
        with pytest.raises(vi.InputError, match=both):
            vi.Record.read(written([x.replace(old, new) for x in layouts.cosmos_counts()]))
