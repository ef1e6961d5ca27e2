"""
Up and down are not the same way
================================

Swept upwards, the mass stays on a motion that hits both bumpers.
"""

import vibroimpact as vi
from vibroimpact.figures import resonance_curves

case = vi.laboratory.case("B2-G1-A3")
curves = vi.sweep(case.oscillator, case.amplitude, [k / 50 for k in range(25, 201)])
resonance_curves(curves, title="B2-G1-A3")
