"""The resonance diagram: what its dataset says of its branches."""

from __future__ import annotations

import vibroimpact as vi


def test_one_branch_has_the_attributes_of_any():
    case = vi.laboratory.case("B3-0mm-A3")
    data = vi.resonance_diagram(case.oscillator, case.amplitude, 3.0, 4.0)
    assert set(data["branch"].values) == {0}
    assert data.attrs["branch_0_closed"] == 0
    assert {data.attrs[f"branch_0_ended_{end}"] for end in ("low", "high")} == {
        "the range ends at 3",
        "the range ends at 4",
    }
