"""
Fragility: how likely is a hit?
===============================

Twelve records are applied to a base-isolated building with three different gaps to the moat walls.
The marks are the shares of records in which the building hits a wall. The curves are lognormal
fragility curves. Each curve is drawn with its confidence band. Its label contains the median θ (the
shaking for which a hit has a probability of 50 %) and the dispersion β.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import fragility_curves


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
gaps = ["60 mm", "90 mm", "120 mm"]
demands = vi.demands(
    building, records, np.linspace(1.0, 8.0, 12), intensity="PGA", vary={"gap": gaps}
)
fragility_curves(vi.fragility(demands, "impact_count"))
