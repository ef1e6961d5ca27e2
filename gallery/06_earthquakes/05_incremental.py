"""
Incremental dynamic analysis
============================

Each of twelve records is scaled up step by step, and the peak responses of a base-isolated building
are computed at each step. A fractile is the response that a given share of the records does not
exceed. Where a fractile of the displacement reaches the gap, the building hits the moat walls. At
stronger shaking, displacements grow more slowly than at weaker shaking, while accelerations keep
growing.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import incremental_curves


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

records = {f"quake {seed}": quake(seed) for seed in range(12)}
demands = vi.demands(building, records, np.linspace(0.375, 6.0, 16), intensity="PGA")
incremental_curves(demands, limit=0.09)
