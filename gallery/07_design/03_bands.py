"""
Resonance curves of an uncertain rig
====================================

Gaps that are set by hand, rubber from another batch: bands of resonance curves that contain nine
rigs of ten. Where a band is widest, some rigs jump and others do not.
"""

from functools import partial

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import resonance_bands

spread = {"gap": "normal:5%", "bumper_stiffness": "lognormal:0.2", "damping": "lognormal:0.1"}
grid = np.arange(0.5, 3.6, 0.04)
rigs = vi.ensemble("B2-G1-A3", spread, partial(vi.sweeps, frequencies=grid), 256)
resonance_bands(rigs, nominal=vi.sweep("B2-G1-A3", grid))
