"""
Two components: RotD50 and RotD100
==================================

An instrument records the ground motion in two fixed directions, but a building may have another
orientation. Therefore the peak response is computed for all directions in the horizontal plane.
RotD50 is the median of the peak response over these directions, and RotD100 is its largest value.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import response_spectra


def quake(seed, peak="0.3 g"):
    """Make a synthetic strong motion; ``vi.Record.read`` reads a measured one."""
    rng = np.random.default_rng(seed)
    time = np.arange(2000) * 0.01
    waves = np.sin(2 * np.pi * np.outer(time, np.linspace(0.2, 8, 80)) + rng.uniform(0, 6.28, 80))
    swell = (time / 4.0) ** 2 * np.exp(-time / 2.0)
    return vi.Record(swell * waves.sum(axis=1), "10 ms").scaled(peak=peak)


both = vi.response_spectrum([quake(1), quake(2)], np.geomspace(0.05, 10.0, 80), damping=0.05)
response_spectra(both, quantity="spectral_displacement")
