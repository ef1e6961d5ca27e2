"""Response spectra, printed and by another program; poundings beside OpenSees."""

from __future__ import annotations

from functools import cache

import numpy as np

import vibroimpact as vi
from earthquakes.rigs import noise
from literature.comparisons.comparison import AbsentError, Comparison, Number, data

INCH = 0.0254

# --- A. K. Chopra's peak deformations under El Centro, 1940, S00E, in inches

CHOPRA = "Chopra, *Dynamics of Structures*"
CHOPRA_TABLE = {
    (0.5, 0.02): "2.67",
    (1.0, 0.02): "5.97",
    (2.0, 0.02): "7.47",
    (2.0, 0.0): "9.91",
    (2.0, 0.05): "5.37",
}
"""By period (s) and damping ratio."""


@cache
def el_centro() -> vi.Record:
    """Another digitisation of that accelerogram."""
    return vi.Record.read(data("boucwen_frame/ElCentroAccelNoScaling.txt"), unit="m/s^2")


def _chopra(period: float, damping: float, printed: str) -> Comparison:
    def ours() -> float:
        spectrum = vi.response_spectrum(el_centro(), [period], [damping])
        return float(spectrum["spectral_displacement"].squeeze()) / INCH

    # Digitisations of this accelerogram differ.
    within = 0.007 * float(printed)
    words = f"El Centro: peak deformation (in), T = {period:g} s, ξ = {damping:g}"
    return Comparison(CHOPRA, words, printed, ours, within)


# --- eqsig's test

EQSIG = "eqsig"


def eqsig_table() -> np.ndarray:
    """Periods (s) and spectral accelerations (g of 9.81 m/s²)."""
    path = data("eqsig/test_motion_true_spectra_acc.csv")
    return np.loadtxt(path, delimiter=",", skiprows=1, encoding="utf-8-sig")


def eqsig_record() -> vi.Record:
    """Printed with three digits at 0.01 s."""
    return vi.Record.read(data("eqsig/test_motion_dt0p01.txt"), unit="m/s^2")


def _eqsig(near: float) -> Comparison:
    def row() -> np.ndarray:
        table = eqsig_table()
        return table[np.abs(table[:, 0] - near).argmin()]

    def ours() -> float:
        spectrum = vi.response_spectrum(eqsig_record(), [row()[0]], 0.05)
        return float(spectrum["pseudo_acceleration"].squeeze()) / 9.81

    words = f"its record: spectral acceleration (g), ξ = 0.05, near T = {near:g} s"
    return Comparison(EQSIG, words, lambda: float(row()[1]), ours, 0.002)


# --- poundings by OpenSees

OPENSEES = "OpenSeesPy 3.7.1.2"
POUNDING = {
    "B3-G3-A3": vi.laboratory.case("B3-G3-A3").oscillator,
    "B1-G1-A3": vi.laboratory.case("B1-G1-A3").oscillator,
    "one side": vi.Oscillator(
        400.0, vi.Isolator("20 kN/m", "0.4 kN s/m"), None, vi.Bumper(3e5, 900.0, 0.012)
    ),
    "unequal": vi.Oscillator(
        550.0,
        vi.Isolator("26 kN/m", "1.1 kN s/m"),
        vi.Bumper(5e5, 700.0, 0.008),
        vi.Bumper(1e5, 2000.0, 0.015),
    ),
    "bilinear": vi.Oscillator(
        550.0,
        vi.BilinearIsolator("60 kN/m", "6 kN/m", "300 N", "0.5 kN s/m"),
        vi.Bumper(5e5, 700.0, 0.010),
        vi.Bumper(5e5, 700.0, 0.010),
    ),
}
POUNDING_PEAKS = {
    "B3-G3-A3": "20.6112",
    "B1-G1-A3": "20.3456",
    "one side": "36.9680",
    "unequal": "24.5158",
    "bilinear": "14.9529",
}
"""mm, under `pounding_record`."""


def pounding_record(seed: int = 8) -> vi.Record:
    """Five seconds of a made-up strong motion."""
    return noise(seed, peak=2.0, count=251)


def opensees_peak(rig: vi.Oscillator, record: vi.Record, divisions: int) -> float:
    """The largest displacement (m) at any step of OpenSees."""
    try:
        from benchmarks.peers.opensees_peer import peak
    except ImportError:
        raise AbsentError("OpenSeesPy") from None
    return peak(rig, record, divisions)


def _pounding(name: str) -> Comparison:
    rig = POUNDING[name]

    def ours() -> float:
        response = vi.seismic_response(vi.Rig(rig, pounding_record()), tail=0.0)
        return 1e3 * float(response["peak_displacement"])

    again: Number = lambda: 1e3 * opensees_peak(rig, pounding_record(), 64)  # noqa: E731
    printed = POUNDING_PEAKS[name]
    words = f"pounding under a record, {name}: peak displacement (mm)"
    return Comparison(OPENSEES, words, printed, ours, 2e-4 * float(printed), again=again)


COMPARISONS = [
    *(_chopra(*key, printed) for key, printed in CHOPRA_TABLE.items()),
    *(_eqsig(near) for near in (0.2, 0.5, 1.0, 2.0)),
    *(_pounding(name) for name in POUNDING),
]
