"""
A base-isolated building in an earthquake
=========================================

The example is a building on yielding isolators between two moat walls. Bands in the figure mark
contacts with the walls, from their exact beginning to their exact end. After the earthquake, the
building has a residual displacement.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import record_history


def quake(seed, peak="0.3 g"):
    """Make a synthetic strong motion; ``vi.Record.read`` reads a measured one."""
    rng = np.random.default_rng(seed)
    time = np.arange(2000) * 0.01
    waves = np.sin(2 * np.pi * np.outer(time, np.linspace(0.2, 8, 80)) + rng.uniform(0, 6.28, 80))
    swell = (time / 4.0) ** 2 * np.exp(-time / 2.0)
    return vi.Record(swell * waves.sum(axis=1), "10 ms").scaled(peak=peak)


bumper = vi.Bumper("40 MN/m", "200 kN s/m", "90 mm")
isolator = vi.BilinearIsolator("8 MN/m", "1 MN/m", "120 kN", "60 kN s/m")
building = vi.Oscillator("200 t", isolator, right=bumper, left=bumper)

motion = vi.simulate(vi.Rig(building, quake(1, "0.35 g")), tail="5 s", samples=4)
record_history(motion)
