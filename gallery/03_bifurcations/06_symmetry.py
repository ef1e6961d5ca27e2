"""
Symmetry breaking
=================

A rig that is its own mirror image can have asymmetric motions. The mean of the largest and
smallest displacement (eccentricity) shows this: it is zero while both sides are hit alike. After
the symmetry breaking there are two mirror-image motions. Their periods double repeatedly, up to
chaos.
"""

import vibroimpact as vi
from vibroimpact.figures import branch_diagram

orbits = vi.resonance_diagram("B3-10mm-A3", ("0.95 Hz", "1.3 Hz"), random=0)
branch_diagram(orbits, quantity="eccentricity")
