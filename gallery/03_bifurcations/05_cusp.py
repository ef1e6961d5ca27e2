"""
A cusp: where jumps begin
=========================

A resonance curve that jumps has two folds, that is, points at which it turns back. This figure
follows both folds in the plane of frequency and gap. The folds meet in a cusp. If the gap is wider
than at the cusp, there is no jump. On the grazing curve, the mass just touches the bumpers. Outside
this curve, the mass does not touch them.
"""

import vibroimpact as vi
from vibroimpact.figures import bifurcation_curves

rig = vi.laboratory.case("B2-G1-A3").rig.at("2 Hz")
found = vi.resonance_diagram(rig, {"frequency": ("1 Hz", "4 Hz")})
kinds = list(found["bifurcation_kind"].values)
curves = {
    kind: vi.bifurcation_curve(
        rig,
        found.isel(bifurcation=kinds.index(kind)),
        vary={"frequency": ("0.3 Hz", "5 Hz"), "gap": ("1 mm", "40 mm")},
    )
    for kind in ("fold", "grazing")
}
bifurcation_curves(curves)
