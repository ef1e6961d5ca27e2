"""
A mass against a rigid wall
===========================

In this rig, a mass on a spring hits a rigid wall. The figure shows the velocity at each impact over
the forcing frequency. There are several period-doubling cascades, with chaos between them. Red
points belong to the upward sweep of the frequency, and blue points to the downward sweep. Where the
red and blue points differ, the two sweeps lead to different motions.
"""

import vibroimpact as vi
from vibroimpact.figures import section_diagram

wall = vi.RigidStop(restitution=0.8, gap=0.0)
ball = vi.Oscillator(1.0, vi.Isolator(stiffness=1.0, damping=0.02), right=wall, left=None)
diagram = vi.bifurcation_diagram(
    vi.Rig(ball, vi.Harmonic(1.0, 0.6)),
    {"frequency": (0.415, 0.545)},
    261,
    section="impacts",
    points=100,
)
section_diagram(diagram)
