"""What lines above a table state: counts, steps, durations, peaks and units, in any wording."""

from __future__ import annotations

import pytest

from vibroimpact.tables.statements import read_statements, sampling_of


def read(*lines: str):
    return read_statements(enumerate(lines))


@pytest.mark.parametrize(
    ("line", "count"),
    [
        ("NPTS= 800, DT= .005 SEC", 800),
        ("NO. OF POINTS: 800 OF 0.005 SEC", 800),
        ("No. of data points = 800", 800),
        ("800 POINTS AT EQUALLY SPACED INTERVALS OF .02 SEC", 800),
        ("Number of samples\t800", 800),
        ('"Samples";"800"', 800),
        ("npts 800 dt 0.005", 800),
        ("record length: 800 samples", 800),
        ("8 values per line", None),
        ("NUMBER OF POINTS PER LINE: 8", None),
        ("sampled at 100 samples/s", None),
        ("FILTER POINTS: HP=0.1 Hz LP=30.0 Hz", None),
        ("format 8F10.3", None),
    ],
)
def test_counts(line, count):
    assert [one.value for one in read(line).counts] == ([count] if count else [])


@pytest.mark.parametrize(
    ("line", "step"),
    [
        ("NPTS=   7999, DT=   .0050 SEC,", 0.005),
        ("0.005 SEC", 0.005),
        ("800 PTS, 0.005 SEC, CM/SEC/SEC", 0.005),
        ("NO. OF POINTS: 800 OF 0.005 SEC., MAX. ACC.= 123.4 CM/SEC/SEC AT 5.2 SEC", 0.005),
        ("SAMPLING INTERVAL (sec) : 0.01", 0.01),
        ("SampleRate(Hz): 50", 0.02),
        (" SAMPLING RATE= 100Hz", 0.01),
        ("Sampling rate: 0.2 kHz", 0.005),
        ("Sampling Freq(Hz)  100", 0.01),
        ("sampled at 200 Hz", 0.005),
        ("100 samples/s", 0.01),
        ("dt_ms = 5", 0.005),
        ("dt (ms): 5", 0.005),
        ("dt:0,01 s", 0.01),
        ('"Sample interval";"10";"ms"', 0.01),
        ("Abtastrate;100;Hz", 0.01),
        ("Fs,100,Hz", 0.01),
        ("MAX = 0.5 AT 3.2 SEC", None),
        ("START TIME 3.2 SEC, DURATION 40 SEC", None),
        ("data rate: 19200 baud", None),
        ("step = 0.1 Hz", None),
        ("natural period 0.5 s", None),
        ("dt = 0", None),
    ],
)
def test_steps_and_rates(line, step):
    assert [one.value for one in read(line).steps] == ([pytest.approx(step)] if step else [])


def test_two_steps_that_differ_are_both_kept():
    statements = read("fs = 100", "dt = 0.02 s")
    assert (statements.step.value, statements.other_step.value) == (0.01, 0.02)
    assert read("fs = 100", "dt = 10 ms").other_step is None


@pytest.mark.parametrize(
    ("line", "value", "unit", "channel"),
    [
        ("PEAK ACCELERATION = -123.4 CM/SEC/SEC AT 5.20 SEC", 123.4, "cm/s^2", ""),
        ("PGA (g): 0.35", 0.35, "g", ""),
        ("Max. Acc. (gal)   4.078", 4.078, "gal", ""),
        ("AmplitudeMAX. U:  0.658~ -0.837", 0.837, None, "U"),
        ("MAX N-S = 12.5 gal", 12.5, "gal", "N-S"),
        ("MAX. VALUE = 0.5 AT 1.2 SEC", 0.5, None, ""),
        ("Peak velocity = 12.3 cm/s at 3 s", None, None, ""),
        ("Max. distance (km): 30", None, None, ""),
        ("maximum error: 0.01", None, None, ""),
        ("Peak to peak = 3", None, None, ""),
    ],
)
def test_peaks(line, value, unit, channel):
    peaks = read(line).peaks
    assert [(one.value, one.unit, one.channel) for one in peaks] == (
        [(value, unit, channel)] if value else []
    )


@pytest.mark.parametrize(
    ("line", "units", "hints"),
    [
        ("AmplitudeUnit:  gal. DCoffset(corr.)", ("gal",), ()),
        (" UNIT  = gal(cm/s/s)", ("gal",), ()),
        ("UNITS ARE IN CM/SEC**2", ("cm/s^2",), ()),
        ("Units: in/s^2", ("in/s^2",), ()),
        ("The units are (g)", ("g",), ()),
        ("acc_unit: mg", ("mg",), ()),
        ("unit CM/SEC/SEC", (), ("cm/s^2",)),
        ("CORRECTED ACCELEROGRAM, CM/SEC/SEC, 0.005 SEC", (), ("cm/s^2",)),
        ("(gal)", (), ("gal",)),
        ("acceleration in m/s2", (), ("m/s^2",)),
        ("Station Gilroy (G)", (), ()),
        ("3 units, built 1990", (), ()),
        ("PGA = 0.3 g", (), ()),
        ("time unit: ms", (), ()),
    ],
)
def test_units(line, units, hints):
    statements = read(line)
    assert (statements.units, statements.hints) == (units, hints)


def test_a_unit_of_times_and_a_duration():
    assert read("Time units = ms").time_unit == "ms"
    assert [one.value for one in read("RecordLength(sec): 120.00").durations] == [120.0]
    assert read("significant duration: 12 s").durations == ()


@pytest.mark.parametrize(
    ("name", "kind"),
    [("fs", "rate"), ("SampleRate", "rate"), ("Sampling Rate (Hz)", "rate"), ("dt", "step"),
     ("wf_increment", "step"), ("timeincrement", "step"), ("frequency", None), ("t", None)],
)  # fmt: skip
def test_names_of_entries(name, kind):
    assert sampling_of(name) == kind
