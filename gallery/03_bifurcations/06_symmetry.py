"""
A symmetry is lost
==================

The rig is its own mirror image, its motion need not be. The middle of the motion tells: zero
while both sides are hit alike, and two mirror images once they are not. Their periods double, and
double again, on the way to the chaos in between.
"""

import vibroimpact as vi
from vibroimpact.figures import branch_diagram

case = vi.laboratory.case("B3-10mm-A3")
orbits = vi.resonance_diagram(
    vi.Rig(case.oscillator, case.amplitude), ("0.95 Hz", "1.3 Hz"), random=0
)
branch_diagram(orbits, quantity="eccentricity")
