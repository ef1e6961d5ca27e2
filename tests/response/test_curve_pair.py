"""A sweep's dataset as plain arrays."""

from __future__ import annotations

import pytest
import xarray as xr

import vibroimpact as vi
from vibroimpact.response.resonance import (
    features,
)


def test_several_rigs_are_refused():
    case = vi.laboratory.case("B2-G1-A3")
    data = vi.sweeps([case], [1.0, 2.0])
    with pytest.raises(vi.InputError, match=r"isel\(rig=0\)"):
        features(data)
    assert features(data.isel(rig=0)).peaks
    with pytest.raises(vi.InputError, match="not the sweep"):
        features(xr.Dataset())
