"""What is assumed or doubted of a record reaches whoever uses it."""

from __future__ import annotations

import sys
import warnings

import numpy as np
import pytest

import vibroimpact as vi
from records.layouts import VALUES, peer
from vibroimpact.model import GRAVITY

RIG = vi.Oscillator(1.0, vi.Isolator(100.0, 1.0), right=vi.Bumper(1e4, 1.0, 0.02))
SWAY = (0.3 * np.sin(0.3 * np.arange(200)) * np.sin(np.arange(200) * np.pi / 199)).round(6)


def written(tmp_path, text: str) -> str:
    path = tmp_path / "quake.csv"
    path.write_text(text, encoding="utf-8")
    return str(path)


def noted(path: str, **said) -> tuple[vi.Record, str]:
    """A record, and all that is noted of it: the one warning holds no more and no less."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        record = vi.Record.read(path, **said)
    notes = "; ".join(record.about.notes)
    expected = [f"record {path!r}: {notes}"] if notes else []
    assert [str(one.message) for one in caught] == expected
    assert all(one.category is vi.InputWarning for one in caught)
    assert all(one.filename == __file__ for one in caught)
    return record, notes


@pytest.mark.parametrize(
    ("stated", "size"),
    [
        ("The units are (g)", GRAVITY),
        ("ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz", GRAVITY),
        ("Acceleration, units: CM/SEC/SEC", 0.01),
        ("UNITS = cm/s2", 0.01),
        ("Acceleration (m/s^2)", 1.0),
        ("accelerations in gal", 0.01),
        ("units are milli g: mg", None),
        ("Units: foot-stones", None),
    ],
)
def test_the_unit_of_an_at2_file_is_the_one_of_its_header(tmp_path, stated, size):
    path = written(tmp_path, "\n".join(peer(stated=stated)) + "\n")
    if size is None:
        with pytest.raises(vi.InputError, match=r"^record: .*: unit: '1 .*' has an? un") as error:
            vi.Record.read(path)
        assert "\n" not in str(error.value)
        return
    record, notes = noted(path)
    np.testing.assert_allclose(record.acceleration, size * np.array(VALUES), rtol=1e-14)
    assert notes == ""


def test_the_unit_of_an_at2_file_that_states_none_is_asked_for(tmp_path):
    path = written(tmp_path, "\n".join(peer(stated="Acceleration")) + "\n")
    with pytest.raises(vi.InputError, match=r'^unit: missing, .* unit="g" \(--unit g\)$'):
        vi.Record.read(path)
    record, notes = noted(path, unit="g")
    assert (record.peak, notes) == (pytest.approx(3.5 * GRAVITY, rel=1e-14), "")


@pytest.mark.parametrize(
    ("head", "scale"),
    [
        ("Time (ms),Acc (cm/s^2)", 1000),
        ("t [s],a [cm/s^2]", 1),
        ("time_ms,a_cms2", 1000),
        ("time,acceleration\nms,cm/s2", 1000),
        ("# units: cm/s/s\ntime (us),acc", 10**6),
        ("Time,acceleration cm/s/s", 1),
    ],
)
def test_units_of_columns_and_of_their_times(tmp_path, head, scale):
    rows = [f"{i * scale / 100!r},{a!r}" for i, a in enumerate((100.0 * SWAY).tolist())]
    record, notes = noted(written(tmp_path, "\n".join([head, *rows]) + "\n"))
    assert record.step == pytest.approx(0.01, rel=1e-12)
    np.testing.assert_allclose(record.acceleration, SWAY, rtol=1e-12)
    assert notes == ""


def test_times_in_a_unit_that_is_not_known(tmp_path):
    path = written(tmp_path, "Time (fortnights),a (g)\n0,1\n1,-1\n")
    with pytest.raises(
        vi.InputError, match="its times are in 'fortnights'; convert them to s, ms or us"
    ):
        vi.Record.read(path)


def test_a_unit_after_a_single_column(tmp_path):
    rows = "".join(f"{a!r}\n" for a in SWAY.tolist())
    for head in ("Acceleration in g\n", "# units: g\n", "made up\nAcc (g)\n"):
        record, notes = noted(written(tmp_path, head + "# dt: 10 ms\n" + rows))
        assert (record.about.unit, notes) == ("g", "")
    with pytest.raises(vi.InputError, match=r'^unit: missing, .* unit="g" \(--unit g\)$'):
        vi.Record.read(written(tmp_path, "# dt: 10 ms\n" + rows))


@pytest.mark.parametrize(
    ("factor", "step", "said", "doubt"),
    [
        (
            1000.0,
            0.01,
            {"unit": "m/s^2"},
            "the peak is 30.3 g, more than the 5 g of usual records: is its unit c",
        ),
        (0.02, 0.01, {"unit": "m/s^2"}, "is its unit g?"),
        (0.01, 0.01, {"unit": "g"}, ""),
        (1e-6, 0.01, {"unit": "g"}, "less than the 0.001 g of usual records"),
        (1.0, 10.0, {"unit": "m/s^2"}, "the step is 10 s, more than the 0.1 s of usual records; i"),
        (1.0, 10.0, {"unit": "m/s^2"}, "it lasts 1990 s, more than the 1800 s of usual records: a"),
        (1.0, 1e-5, {"unit": "m/s^2"}, "the step is 1e-05 s, less than the 0.0001 s of usual"),
        (1.0, 0.1, {"unit": "m/s^2"}, ""),
        (1.0, 1e-4, {"unit": "m/s^2"}, ""),
    ],
)
def test_sizes_and_times_beyond_those_of_records_are_doubted(tmp_path, factor, step, said, doubt):
    rows = "".join(f"{a!r}\n" for a in (factor * SWAY).tolist())
    _, notes = noted(written(tmp_path, rows), step=step, **said)
    assert doubt in notes
    assert bool(doubt) == bool(notes)


def test_a_file_that_was_cut_within_its_last_number(tmp_path):
    quiet = [f"{1e-6 * a:14.7E}" for a in SWAY]
    whole = [*peer(f"NPTS= {len(quiet)}, DT= 0.01 SEC")[:4], *quiet]
    text = "\n".join(whole)
    _, notes = noted(written(tmp_path, text), unit="m/s^2")  # the last number is as the others
    assert "cut" not in notes
    last = "-3.11"
    cut = "\n".join([*whole[:-1], last])
    record, notes = noted(written(tmp_path, cut))
    assert record.peak == pytest.approx(3.11 * GRAVITY)
    assert (
        "the file ends with '-3.11' and without a line break: is it incomplete within a num"
        in notes
    )
    assert "the last value, -3.11, is far from the one before it" in notes
    _, notes = noted(written(tmp_path, cut + "\n"))  # mended by an editor
    assert "line break" not in notes
    assert "the last value, -3.11, is far from the one before it" in notes


@pytest.mark.parametrize("cut", [1, 2, 3, 4, 5])
def test_each_cut_of_the_last_number_is_doubted_or_refused(tmp_path, cut):
    rows = "\n".join(f"{0.01 * i:.2f},{a:.6f}" for i, a in enumerate(SWAY))
    assert noted(written(tmp_path, "t,a (m/s^2)\n" + rows))[1] == ""
    _, notes = noted(written(tmp_path, "t,a (m/s^2)\n" + rows[:-cut]))
    assert "without a line break" in notes


def test_a_record_that_ends_in_motion_is_not_doubted(tmp_path):
    rng = np.random.default_rng(1)
    for values in (rng.normal(size=400), np.sin(0.4 * np.arange(300)), np.ones(50)):
        rows = "".join(f"{a!r}\n" for a in values.tolist())
        _, notes = noted(written(tmp_path, rows), step=0.01, unit="m/s^2")
        assert "last value" not in notes


def test_datasets_keep_what_was_noted(tmp_path):
    rows = "".join(f"{a!r}\n" for a in SWAY.tolist())
    record, notes = noted(written(tmp_path, "# dt = 20 ms\n" + rows), step=0.01, unit="m/s^2")
    assert notes == "the step 10 ms replaces the step in the file, 0.02 s"
    motion = vi.simulate(vi.Rig(RIG, record), tail=1.0)
    demands = vi.demands(RIG, {"quake": record, "made": vi.Record(SWAY, 0.01)})
    made = {
        "simulate": motion,
        "totals": vi.totals(motion),
        "contacts": vi.contacts(motion),
        "seismic_response": vi.seismic_response(vi.Rig(RIG, record)),
        "response_spectrum": vi.response_spectrum(record, 1.0),
        "required_gap": vi.required_gap(RIG, records=record),
    }
    assert {name: data.attrs.get("notes") for name, data in made.items()} == dict.fromkeys(
        made, notes
    ) | {"required_gap": f"quake.csv: {notes}"}
    assert demands.attrs["notes"] == f"quake: {notes}"
    vi.save(motion, tmp_path / "motion.nc")
    assert vi.load(tmp_path / "motion.nc").attrs["notes"] == notes
    assert "notes" not in vi.seismic_response(vi.Rig(RIG, vi.Record(SWAY, 0.01))).attrs


ROWS = "".join(f"{0.01 * n:.2f},{n % 7 - 3}\n" for n in range(40))


@pytest.mark.parametrize(
    ("head", "said"),
    [
        ("t (s),a (g)\ns,cm/s^2\n", "states two units, 'g' and 'cm/s^2'"),
        ("# units: cm/s^2\nt (s),a (g)\n", "states two units, 'g' and 'cm/s^2'"),
        ("units: cm/s^2\nunits: g\n", "states two units, 'g' and 'cm/s^2'"),
        ("t (ms),a (g)\ns,g\n", "its times are in 'ms' and in 's'; use one unit, or pass step="),
    ],
)
def test_two_units_that_differ_are_refused(tmp_path, head, said):
    path = written(tmp_path, head + ROWS)
    with pytest.raises(vi.InputError) as error:
        vi.Record.read(path)
    assert said in str(error.value)
    settled, _ = noted(path, unit="g", step=0.01)
    assert settled.peak == pytest.approx(3.0 * 9.80665)


@pytest.mark.parametrize(
    "head", ["t (s),a (gal)\ns,cm/s^2\n", "units: cm/s2\nt (s),a (CM/SEC/SEC)\n"]
)
def test_two_spellings_of_one_unit_are_no_conflict(tmp_path, head):
    record, notes = noted(written(tmp_path, head + ROWS))
    assert record.peak == pytest.approx(0.03)
    assert "unit" not in notes
    assert "name" not in notes


def test_the_ending_of_a_name_yields_to_a_line_of_units_and_is_noted(tmp_path):
    record, notes = noted(written(tmp_path, "time,acc_g\ns,cm/s^2\n" + ROWS))
    assert record.peak == pytest.approx(0.03)
    assert "read in cm/s^2, although the name of the column states g" in notes


@pytest.mark.skipif(sys.platform == "win32", reason="no such names of files")
def test_names_of_files_stations_and_components_are_text(tmp_path):
    path = tmp_path / "q\x1b[31m.csv"
    path.write_text("t (s),No\x1b[31mrth (g),East (g)\n" + ROWS.replace("\n", ",1\n"))
    record, _ = noted(str(path), component="No\x1b[31mrth")
    assert record.about.component == r"No\x1b[31mrth"
    assert record.about.source.endswith(r"q\x1b[31m.csv")
    assert vi.Record.read(path, r"No\x1b[31mrth") == record
    with pytest.raises(vi.InputError) as error:
        vi.Record.read(path)
    assert "\x1b" not in str(record) + str(error.value)
