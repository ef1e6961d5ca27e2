"""
The unstable motion between the jumps
=====================================

Between the two jumps there is a third motion. It is unstable: the smallest disturbance grows
until the mass is on one of the other two, so that no sweep can follow it. Continuation finds it
(dashed) and shows that the three motions are one curve with two folds.
"""

import vibroimpact as vi
from vibroimpact.figures import branch_diagram

orbits = vi.resonance_diagram("B2-G1-A3", ("0.8 Hz", "3.4 Hz"))
swept = vi.sweep("B2-G1-A3", [k / 20 for k in range(16, 69)])
branch_diagram(orbits, quantity="eta_a", sweep=swept)
