"""
Frequency of the jump down
==========================

The axes of this map are the stiffness of the bumpers and the gap, both dimensionless. For each rig,
the map shows the frequency at which an upward sweep jumps down, divided by the natural frequency.
Stiff bumpers with a small gap shift the resonance to several times the natural frequency.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import feature_map

data = vi.scenario_map(
    None,
    {"stiffness_ratio": np.geomspace(1.0, 100.0, 13), "gap_ratio": np.linspace(0.05, 0.95, 11)},
    step=0.03,
)
feature_map(data, "jump_down_ratio")
