"""
Seven scenarios
===============

All rigs at a glance: stiffness of the bumpers to the right, gap upwards, both without units.
Where does a resonance jump (S2), has it secondary resonances (S3), motions that are not regular
(S4)? On the dashed line, which is exact, jumps begin.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import Mark, scenario_map
from vibroimpact.scenarios.borders import jump_border

data = vi.scenario_map(
    None,
    ("stiffness_ratio", np.geomspace(0.5, 100.0, 17)),
    ("gap_ratio", np.linspace(0.0, 1.1, 17)),
    step=0.03,
)
published = Mark("published rigs B2 and B3", "o", [19.4, 25.9], [0.217, 0.217])
scenario_map(data, border=jump_border(data, lines=6), marks=[published])
