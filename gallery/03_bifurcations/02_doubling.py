"""
Brute force and continuation, together
======================================

Dots are where motions settle; lines are bifurcations that a branch of orbits has located to ten
digits. Where dots split, a line stands.
"""

import vibroimpact as vi
from vibroimpact.figures import section_diagram

case = vi.laboratory.case("B3-10mm-A3")
shaking = vi.Harmonic(case.amplitude, "1.12 Hz")
low, high = "4.72 mm", "5.1 mm"
diagram = vi.bifurcation_diagram(case.oscillator, shaking, "gap", low, high, 77)
branch = vi.branch(case.oscillator, shaking, parameter="gap", low=low, high=high)
section_diagram(diagram, branches=branch)
