"""
Resonance curves of an uncertain rig
====================================

The parameters of a rig vary, for example because gaps are set by hand or rubber comes from another
batch. At each frequency, the band contains the values of nine rigs out of ten. A band is widest
where some rigs jump and others do not.
"""

from functools import partial

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import resonance_bands

spread = {
    "gap": "normal:5%",
    "stops.stiffness": "lognormal:0.2",
    "isolator.damping": "lognormal:0.1",
}
grid = np.arange(0.5, 3.6, 0.04)
rigs = vi.ensemble("B2-G1-A3", spread, partial(vi.sweeps, frequencies=grid), 256)
resonance_bands(rigs, nominal=vi.sweep("B2-G1-A3", grid))
