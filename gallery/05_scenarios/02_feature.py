"""
How far the peak is carried
===========================

The same plane, and one number of each rig: the frequency at which a sweep up falls off, over the
natural one. Hard bumpers with a small gap carry the resonance to several times where it would be
without them.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import feature_map

data = vi.scenario_map(
    None,
    ("stiffness_ratio", np.geomspace(1.0, 100.0, 13)),
    ("gap_ratio", np.linspace(0.05, 0.95, 11)),
    step=0.03,
)
feature_map(data, "jump_down_ratio")
