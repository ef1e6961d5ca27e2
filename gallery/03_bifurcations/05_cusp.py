"""
Where jumps begin
=================

The two folds of a resonance, followed over frequency and gap. They meet in a cusp: a wider gap
has no jump. Outside the grazing curve the bumpers are not touched at all.
"""

import vibroimpact as vi
from vibroimpact.figures import bifurcation_curves

case = vi.laboratory.case("B2-G1-A3")
rig, shaking = case.oscillator, vi.Harmonic(case.amplitude, "2 Hz")
found = vi.resonance_diagram(vi.Rig(rig, case.amplitude), ("1 Hz", "4 Hz"))
kinds = list(found["bifurcation_kind"].values)
curves = {
    kind: vi.bifurcation_curve(
        vi.Rig(rig, shaking),
        found.isel(bifurcation=kinds.index(kind)),
        spans=(("0.3 Hz", "5 Hz"), ("1 mm", "40 mm")),
        parameters=("frequency", "gap"),
    )
    for kind in ("fold", "grazing")
}
bifurcation_curves(curves)
