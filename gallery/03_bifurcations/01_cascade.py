"""
Bifurcation diagram: period doubling to chaos
=============================================

The gap of a rig is varied upwards and downwards, and each steady motion is sampled once per forcing
cycle. If the gap becomes smaller, one point becomes two, and two become four. This is called a
period-doubling cascade. Below 4.7 mm, the motion is chaotic, except in small ranges of the gap in
which it is periodic (periodic windows). The lower panel shows the largest Lyapunov exponent. Where
it is positive, small disturbances grow.
"""

import vibroimpact as vi
from vibroimpact.figures import section_diagram

diagram = vi.bifurcation_diagram(
    "B3-10mm-A3", {"gap": (0.0034, 0.0054)}, 321, frequency="1.12 Hz", points=100
)
section_diagram(diagram)
