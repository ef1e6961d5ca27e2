"""Pounding beside OpenSees (McKenna et al. 2010), whose steps converge to what is found here.

A bumper there is a node without mass on a spring and a dashpot, behind an element that only takes
pressure (`benchmarks/peers/opensees_peer.py`); its ViscoelasticGap pulls at the end of a contact
and is another law. The bilinear isolator is its Steel01.
"""

from __future__ import annotations

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
