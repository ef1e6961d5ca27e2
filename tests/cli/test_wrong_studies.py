"""Wrong study files: each message names the key, and what is wrong with its value."""

from __future__ import annotations

import pytest

from vibroimpact.cli import main
from vibroimpact.cli.study import read_study
from vibroimpact.errors import InputError

OWN = '[oscillator]\nmass = "550 kg"\nisolator = { stiffness = "26 kN/m", damping = 1100 }\n'


def isolator(table):
    return f'[oscillator]\nmass = "550 kg"\nisolator = {{ {table} }}\n'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            isolator('frequency = "4 Hz", damping_ratio = 0.1'),
            "oscillator.isolator.frequency: unknown key; write its reciprocal, the period; this "
            "table has the keys stiffness, damping, damping_exponent, period and damping_ratio",
        ),
        (
            isolator('frequency = "4 Hz", damping = 100'),
            "oscillator.isolator.frequency: unknown key; write its reciprocal, the period; this "
            "table has the keys stiffness, damping, damping_exponent, period and damping_ratio "
            "(1 more to correct)",
        ),
        (
            isolator("stiffness = 100, damping_ratio = 0.1"),
            "oscillator.isolator.damping_ratio: given together with stiffness; replace stiffness "
            "by period, or damping_ratio by damping",
        ),
        (
            OWN + "[excitation]\namplitude = [1, 2]\n",
            "excitation.amplitude: [1, 2] is not a number or a string with a unit; write it as in "
            'amplitude = "0.05 g" (one at all frequencies); for several harmonics, amplitudes = '
            '["1 mm", "2 mm"]; for one amplitude per frequency, use sweep in Python',
        ),
        (
            OWN + "[excitation]\namplitudes = [1, [2]]\n",
            "excitation.amplitudes[1]: [2] is not a number or a string with a unit; write it as in "
            'amplitudes = ["1 mm", "0.5 mm"]',
        ),
        (
            OWN + '[excitation]\namplitude = 1\nfrequency = "2 Hz"\n',
            "excitation.frequency: unknown key; write the frequency in the table [simulate] or "
            "as --frequency; this table has the keys amplitude, amplitudes, phases, of, on, phase, "
            "record, component, step, unit and decimal",
        ),
        (
            OWN + "[excitation]\nrecord = 3\n",
            'excitation.record: 3 is not a string in quotes; write it as in record = "quake.csv"',
        ),
        (
            OWN + '[design]\nrecords = "a.csv"\n',
            "design.records: 'a.csv' is not a list in brackets; write it as in records = "
            '["first.csv", "second.csv"]',
        ),
        (
            OWN + "[design]\nvary = { gap = 3 }\n",
            "design.vary.gap: 3 is not a string in quotes; write it as in vary = { gap = "
            '"5 mm:9 mm:5" }',
        ),
        (
            OWN + "[design]\nlimits = { peak_force = [1] }\n",
            "design.limits.peak_force: [1] is not a number or a string with a unit; write it as in "
            'limits = { peak_force = "5 MN" }',
        ),
        (
            OWN + '[sweep]\ndirection = "up"\n',
            "sweep.direction: 'up' is unknown; use 'forward', 'backward' or 'both'",
        ),
        (
            OWN + '[sweep]\nfrom = "6 rad/s"\nto = 20\n',
            "sweep: from, to: '6 rad/s' has a unit and 20 has none; write both with units",
        ),
        (OWN + "[sweep]\nmax_cycles = 1.5\n", "sweep.max_cycles: 1.5 is not a whole number"),
        (OWN + "[sweep]\nmax_cycles = true\n", "sweep.max_cycles: True is not a whole number"),
        (OWN + "[sweep]\nmax_cycles = -3\n", "sweep.max_cycles: -3 is less than 1"),
    ],
)
def test_a_message_in_plain_words(tmp_path, text, message):
    path = tmp_path / "one.toml"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        read_study(path)
    assert str(caught.value) == f"study {str(path)!r}: {message}"


KEYS = {
    "oscillator": ("mass", "weight", "isolator", "right", "left", "force", "units"),
    "excitation": (
        *("amplitude", "amplitudes", "phases", "phase"),
        *("record", "component", "step", "unit", "decimal"),
    ),
    "sweep": ("from", "to", "step", "frequencies", "direction", "tolerance", "max_cycles"),
    "simulate": ("frequency", "cycles", "samples", "displacement", "velocity", "tail"),
    "design": ("records", "vary", "limits", "fractile"),
    "ensemble": ("uncertain", "draws", "method", "seed"),
    "": ("name", "case", "parameters", *("oscillator", "excitation", "sweep")),
}


@pytest.mark.parametrize("value", ["true", "[[1]]", "{ a = [1] }", "2020-01-01", "[true]"])
@pytest.mark.parametrize(("table", "key"), [(t, key) for t, keys in KEYS.items() for key in keys])
def test_no_value_of_a_wrong_kind_leaks_the_words_of_a_library(tmp_path, table, key, value):
    path = tmp_path / "one.toml"
    body = {"oscillator": 'mass = "550 kg"\nisolator = { stiffness = 1, damping = 1 }\n'}
    if table:
        if table == "oscillator":
            lines = [line for line in body[table].splitlines() if not line.startswith(f"{key} ")]
            if key == "weight":
                lines = lines[1:]
            body[table] = "\n".join([*lines, ""])
        body[table] = f"{body.get(table, '')}{key} = {value}\n"
    head = "" if table else f"{key} = {value}\n"
    if key in ("oscillator", "case"):
        body.pop("oscillator")
    path.write_text(head + "".join(f"[{name}]\n{text}" for name, text in body.items()))
    with pytest.raises(InputError) as caught:
        read_study(path).rig(path)
    message = str(caught.value)
    assert f"{table}.{key}".strip(".") in message
    for leak in ("input should", "valid", ".float", ".str", ".int", "parse", "instance"):
        assert leak not in message


@pytest.mark.parametrize("key", ["F0", "force", "unbalance"])
def test_a_force_is_written_as_the_amplitude(key, tmp_path, capsys):
    path = tmp_path / "one.toml"
    path.write_text(f'[oscillator]\nmass = 1\n[excitation]\n{key} = "500 N"\n')
    assert main(["sweep", str(path)]) == 2
    assert f"excitation.{key}: unknown key" in (error := capsys.readouterr().err)
    assert 'write it as amplitude: its unit says what it is, such as "500 N"' in error
