"""``vibroimpact curve`` from the words typed to the files written."""

from __future__ import annotations

import json
from pathlib import Path

import h5py
import numpy as np
import pytest

import vibroimpact as vi

COMMAND = "curve"
CASE = vi.laboratory.case("B2-G1-A3")
RATIO = ("--vary", "frequency=1Hz:4Hz", "--vary", "stiffness_ratio=0.5:100")


def groups(path: Path) -> set[str]:
    with h5py.File(path) as file:
        return set(file)


def swing(rig: vi.Oscillator, amplitude: float, frequency: np.ndarray) -> np.ndarray:
    """How far the free mass swings: |A/(k − ω² + icω)| with k = K/M and c = C/M."""
    k, c = rig.isolator.stiffness / rig.mass, rig.isolator.damping / rig.mass
    omega = 2.0 * np.pi * frequency
    return amplitude / np.abs(k - omega**2 + 1j * c * omega)


def with_ratio(ratio: float) -> vi.Oscillator:
    rig = CASE.oscillator
    stiffness = ratio * rig.isolator.stiffness
    damping = rig.right.damping * stiffness / rig.right.stiffness
    bumper = rig.right.replace(stiffness=stiffness, damping=damping)
    return rig.replace(right=bumper, left=bumper)


def test_summary_and_files(run, tmp_path):
    code, out, errors = run("B2-G1-A3", *RATIO)
    assert (code, errors) == (0, "")
    lines = [line.rstrip() for line in out.splitlines()]
    stem = "B2-G1-A3-fold-frequency-stiffness-ratio"
    for line in ("B2-G1-A3", "1 fold curve", "Files", f"  out/{stem}.nc", f"  out/{stem}.png"):
        assert lines.count(line) == 1
    (cusp,) = (line for line in lines if "cusp" in line)
    words = cusp.replace(",", "").split()
    assert words[:3] == ["cusp", "at", "frequency"]
    assert words[4] == "stiffness_ratio"
    assert float(words[3]) == pytest.approx(1.61545, abs=1e-5)
    assert float(words[5]) == pytest.approx(1.62770, abs=1e-5)
    assert {path.name for path in (tmp_path / "out").iterdir()} == {f"{stem}.nc", f"{stem}.png"}


@pytest.fixture(scope="module")
def ratios(tmp_path_factory, run_in):
    folder = tmp_path_factory.mktemp("ratios")
    code, out, errors = run_in(folder, "B2-G1-A3", *RATIO, "--json")
    assert (code, errors) == (0, "")
    return json.loads(out), folder


def test_sweeps_jump_above_the_cusp_and_not_below(ratios):
    """Up and down agree where there is no fold."""
    ((_, ratio),) = ratios[0]["curves"][0]["cusps"]
    for factor, apart in ((0.9, False), (1.5, True)):
        rig = with_ratio(factor * ratio)
        swept = vi.sweep(vi.Rig(rig, CASE.amplitude), np.arange(1.5, 1.8, 0.004))
        up, down = swept["displacement_excursion"].transpose("direction", "frequency").values
        assert (np.abs(up - down).max() > 1e-4) == apart


def test_identified_parameters_over_a_plane(run, tmp_path):
    words = ("--parameters", "identified", "--bifurcation", "fold")
    plane = ("--vary", "frequency=1.6Hz:1.8Hz", "--vary", "gap=7mm:8mm")
    code, out, _ = run("B2-G1-A3", *words, *plane)
    assert code == 0
    assert "K = 26.8 kN/m" in out
    assert (tmp_path / "out/B2-G1-A3-identified-fold-frequency-gap.nc").is_file()


FIRST = ("--vary", "frequency=1.5Hz:3Hz")
SECOND = (*FIRST, "--vary", "gap=1mm:20mm")
GAPS = ("--vary", "gap=1mm:20mm")


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ([], "--vary: given 0 times; pass two parameters, such as --vary frequency"),
        ([*FIRST], "--vary: given 1 times; pass two"),
        ([*SECOND, "--vary", "mass=1:2"], "--vary: given 3 times"),
        ([*FIRST, "--vary", "colour=1:2"], "--vary: 'colour' is unknown"),
        (["--vary", "frequency", "--vary", "frequency=1Hz:2Hz"], "'frequency' is given twice"),
        ([*FIRST, "--vary", "gap=1mm:2mm:5"], "--vary: gap: a curve is followed"),
        ([*GAPS, "--vary", "frequency=1Hz"], "--vary: frequency: '1Hz'"),
        ([*FIRST, "--vary", "gap=20mm:1mm"], "--vary: gap: the first value, 20 mm"),
        ([*FIRST, "--vary", "gap=a:b"], "--vary: gap: 'a'"),
        ([*FIRST, "--vary", "gap=1Hz:2Hz"], "--vary: gap: '1Hz'"),
        ([*FIRST, "--vary", "gap=10mm:20mm"], "--vary: gap: 10 mm to 20 mm does not contain"),
        (
            [*GAPS, "--vary", "isolator.damping=1kN s/m:2kN s/m"],
            "--frequency: missing",
        ),
        (
            [*GAPS, "--vary", "gap_ratio=0.1:1", "--frequency", "2Hz"],
            "--vary: 'gap' and 'gap_ratio' are not independent of each other",
        ),
        (
            ["--vary", "frequency=3Hz:4Hz", *GAPS],
            "--bifurcation: no fold was found for frequency",
        ),
        (
            ["--bifurcation", "neimark-sacker", "--vary", "frequency=2Hz:3Hz", *GAPS],
            "no Neimark-Sacker",
        ),
        (["--bifurcation", "hopf", *SECOND], "--bifurcation"),
        (["--set", "right=none", "--set", "left=none", *SECOND], "not a parameter of this rig"),
    ],
)
def test_wrong_input_is_one_line_and_exit_2_and_nothing_written(refused, words, named):
    assert named in refused("B2-G1-A3", *words)
