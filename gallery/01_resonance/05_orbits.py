"""
What no sweep can hold
======================

Between the two jumps lies a third motion. It is unstable: the smallest push grows until the mass
is on one of the other two. Continuation finds it all the same, dashed, and shows that the three
are one curve, folded twice.
"""

import vibroimpact as vi
from vibroimpact.figures import branch_diagram

case = vi.laboratory.case("B2-G1-A3")
orbits = vi.resonance_diagram(vi.Rig(case.oscillator, case.amplitude), ("0.8 Hz", "3.4 Hz"))
swept = vi.sweep(case, [k / 20 for k in range(16, 69)])
branch_diagram(orbits, quantity="eta_a", sweep=swept)
