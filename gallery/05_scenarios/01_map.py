"""
Map of the seven scenarios
==========================

A scenario is a class of resonance curves, which describes the shape of the curves of a rig. This
map shows the scenario over the stiffness of the bumpers (horizontal) and the gap (vertical), both
dimensionless. For example, it shows where the resonance jumps (S2), where there are secondary
resonances (S3), and where some motions are not regular (S4). The dashed line is the border at which
jumps begin. It does not depend on the grid of the map, because it is computed separately and
exactly.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import Mark, scenario_map
from vibroimpact.scenarios.borders import jump_border

data = vi.scenario_map(
    None,
    {"stiffness_ratio": np.geomspace(0.5, 100.0, 17), "gap_ratio": np.linspace(0.0, 1.1, 17)},
    step=0.03,
)
published = Mark("published rigs B2 and B3", "o", [19.4, 25.9], [0.217, 0.217])
scenario_map(data, border=jump_border(data, lines=6), marks=[published])
