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
diagram = vi.bifurcation_diagram(vi.Rig(case.oscillator, shaking), "gap", (low, high), 77)
branch = vi.branch(vi.Rig(case.oscillator, shaking), span=(low, high), parameter="gap")
section_diagram(diagram, branches=branch)
