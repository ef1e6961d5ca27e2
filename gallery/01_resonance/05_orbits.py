"""
The unstable motion between the jumps
=====================================

If the resonance curve of a rig has a hysteresis, the upward and the downward frequency sweep jump
at different frequencies. At each frequency between the two jumps, there is a third motion, which is
unstable. A small disturbance of this motion grows until the mass settles on one of the other two
motions, so no sweep can follow the unstable motion. Numerical continuation can follow it (dashed
curve). The result shows that the three motions form one curve with two folds.
"""

import vibroimpact as vi
from vibroimpact.figures import branch_diagram

orbits = vi.resonance_diagram("B2-G1-A3", {"frequency": ("0.8 Hz", "3.4 Hz")})
swept = vi.sweep("B2-G1-A3", [k / 20 for k in range(16, 69)])
branch_diagram(orbits, quantity="eta_a", sweep=swept)
