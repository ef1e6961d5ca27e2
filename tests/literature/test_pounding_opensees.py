"""Pounding beside OpenSees (McKenna et al. 2010), whose steps converge to what is found here.

A bumper there is a node without mass on a spring and a dashpot, behind an element that only takes
pressure (`benchmarks/peers/opensees_peer.py`); its ViscoelasticGap pulls at the end of a contact
and is another law. The bilinear isolator is its Steel01.
"""

from __future__ import annotations

import numpy as np
import pytest

import vibroimpact as vi
from literature.comparisons.comparison import AbsentError
from literature.comparisons.records import POUNDING, opensees_peak, pounding_record
from samples import sample

SEEDS = (8, 9, 12)
DIVISIONS = sample((4, 16, 64), (2, 8, 32))


@pytest.mark.parametrize("seed", sample(SEEDS, SEEDS[:1]))
@pytest.mark.parametrize("name", POUNDING)
def test_its_peaks_converge_to_ours(name: str, seed: int) -> None:
    rig, record = POUNDING[name], pounding_record(seed)
    ours = vi.seismic_response(vi.Rig(rig, record), tail=0.0)
    assert int(ours["impact_count"].sum()) >= 2
    exact = float(ours["peak_displacement"])
    try:
        errors = [abs(opensees_peak(rig, record, n) / exact - 1.0) for n in DIVISIONS]
    except AbsentError as error:
        pytest.skip(str(error))
    assert errors[-1] < 2e-3
    assert errors[-1] < 0.5 * errors[0]


def test_a_building_at_its_moat_converges_to_ours_at_the_order_of_its_steps(monkeypatch) -> None:
    """Newmark's average acceleration is of order 2; steps that contacts divide differ from it."""
    peer = pytest.importorskip(
        "benchmarks.peers.opensees_assembly", reason="OpenSeesPy is absent", exc_type=ImportError
    )
    # The contact element is so stiff that what it gives way is less than the error of the steps.
    monkeypatch.setattr("benchmarks.peers.opensees_peer._PENALTY", 1e6)
    storey, bumper = vi.Isolator("400 MN/m", "2 MN s/m"), vi.Bumper("60 MN/m", "0.6 MN s/m", "4 cm")
    building = vi.Assembly(
        {"base": "300 t", "first": "250 t", "roof": "200 t"},
        links={
            "isolator": vi.Link("ground", "base", vi.Isolator("8 MN/m", "0.8 MN s/m")),
            "lower": vi.Link("base", "first", storey),
            "upper": vi.Link("first", "roof", storey),
        },
        stops={
            "right": vi.Link("base", "ground", bumper),
            "left": vi.Link("ground", "base", bumper),
        },
    )
    time = 0.01 * np.arange(2000)
    record = vi.Record(1.6 * np.sin(3.3 * time) * np.sin(0.16 * time) ** 2, 0.01)
    motion = vi.simulate(vi.Rig(building, record))
    assert int((motion["event_contact"] == 1).sum()) > 3
    exact = motion["displacement"].sel(mass="roof").values[: len(time)]
    size = float(np.abs(exact).max())
    coarse, fine = (
        float(np.abs(peer.follow(building, "roof", record, n) - exact).max()) / size
        for n in (4, 32)
    )
    assert fine < 1e-5
    assert np.log(coarse / fine) / np.log(8.0) > 1.8
