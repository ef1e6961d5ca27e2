"""
The road to chaos
=================

The gap of a rig is turned up and down again, and the motion is looked at once a cycle when it has
settled. One point becomes two, two become four; below 4.7 mm there is chaos, with windows of
order in it. The exponent below says the same in one number: above zero, disturbances grow.
"""

import vibroimpact as vi
from vibroimpact.figures import section_diagram

case = vi.laboratory.case("B3-10mm-A3")
shaking = vi.Harmonic(case.amplitude, "1.12 Hz")
diagram = vi.bifurcation_diagram(
    vi.Rig(case.oscillator, shaking), "gap", (0.0034, 0.0054), 321, points=100
)
section_diagram(diagram)
