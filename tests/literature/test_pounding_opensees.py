"""Pounding beside OpenSees (McKenna et al. 2010), whose steps converge to what is found here.

A bumper there is a node without mass on a spring and a dashpot, behind an element that only takes
pressure (`benchmarks/peers/opensees_peer.py`); its ViscoelasticGap pulls at the end of a contact
and is another law. The bilinear isolator is its Steel01.
"""

from __future__ import annotations

import pytest

import vibroimpact as vi
from samples import sample
from seismic.rigs import noise

RIGS = {
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
SEEDS = (8, 9, 12)
DIVISIONS = sample((4, 16, 64), (2, 8, 32))


@pytest.mark.parametrize("seed", sample(SEEDS, SEEDS[:1]))
@pytest.mark.parametrize("name", RIGS)
def test_its_peaks_converge_to_ours(name: str, seed: int) -> None:
    opensees = pytest.importorskip(
        "benchmarks.peers.opensees_peer", reason="OpenSeesPy is absent", exc_type=ImportError
    )
    rig, record = RIGS[name], noise(seed, peak=2.0, count=251)
    ours = vi.seismic_response(rig, record, tail=0.0)
    assert int(ours["impact_count"]) >= 2
    exact = float(ours["peak_displacement"])
    errors = [abs(opensees.peak(rig, record, n) / exact - 1.0) for n in DIVISIONS]
    assert errors[-1] < 2e-3
    assert errors[-1] < 0.5 * errors[0]
