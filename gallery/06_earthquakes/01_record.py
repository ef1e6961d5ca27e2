"""
A record and its response spectrum
==================================

The upper panel shows the ground acceleration. The lower panel shows the response spectrum, that is,
the peak responses of linear oscillators over their natural period. The spectrum is exact for the
record: it includes maxima between two samples.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import accelerogram


def quake(seed, peak="0.3 g"):
    """Make a synthetic strong motion; ``vi.Record.read`` reads a measured one."""
    rng = np.random.default_rng(seed)
    time = np.arange(2000) * 0.01
    waves = np.sin(2 * np.pi * np.outer(time, np.linspace(0.2, 8, 80)) + rng.uniform(0, 6.28, 80))
    swell = (time / 4.0) ** 2 * np.exp(-time / 2.0)
    return vi.Record(swell * waves.sum(axis=1), "10 ms").scaled(peak=peak)


record = quake(1)
spectrum = vi.response_spectrum(record, np.geomspace(0.05, 10.0, 120), damping=[0.02, 0.05, 0.15])
accelerogram(record, spectrum)
