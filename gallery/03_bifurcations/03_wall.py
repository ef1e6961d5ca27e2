"""
A mass against a wall
=====================

A rigid wall in place of a bumper, and the velocity at each impact over the frequency. Cascades of
doublings stand side by side, with chaos between them; where red and blue part, the way up and the
way down hold different motions.
"""

import vibroimpact as vi
from vibroimpact.figures import section_diagram

wall = vi.RigidStop(restitution=0.8, gap=0.0)
rig = vi.Oscillator(1.0, vi.Isolator(stiffness=1.0, damping=0.02), right=wall, left=None)
diagram = vi.bifurcation_diagram(
    vi.Rig(rig, vi.Harmonic(1.0, 0.6)),
    "frequency",
    (0.415, 0.545),
    261,
    section="impacts",
    points=100,
)
section_diagram(diagram)
