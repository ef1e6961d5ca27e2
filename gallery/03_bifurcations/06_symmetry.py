"""
Symmetry breaking
=================

If a rig is its own mirror image, its motions may still be asymmetric. A measure of the asymmetry is
the eccentricity, which is the mean of the largest and the smallest displacement. It is zero while
the mass hits both sides in the same way. After the symmetry breaking, there are two motions, each
of which is the mirror image of the other. Their periods double repeatedly, until the motions are
chaotic.
"""

import vibroimpact as vi
from vibroimpact.figures import branch_diagram

orbits = vi.resonance_diagram("B3-10mm-A3", {"frequency": ("0.95 Hz", "1.3 Hz")}, random=0)
branch_diagram(orbits, quantity="eccentricity")
