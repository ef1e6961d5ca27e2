"""
An earthquake on one page
=========================

The example is a base-isolated building between two moat walls. The panels show the record, the
displacement between the walls, and the acceleration with a mark at each impact. They also show the
force over the displacement, and the response spectra of the motions of ground and floor. The floor
spectrum shows that the impacts mainly affect equipment with short natural periods.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import earthquake_page


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

record = quake(1, "0.4 g")
motion = vi.simulate(vi.Rig(building, record), tail="5 s", samples=8)
periods = np.geomspace(0.02, 5.0, 100)
spectra = {
    "ground": vi.response_spectrum(record, periods, damping=0.05),
    "floor": vi.response_spectrum(vi.floor_record(motion), periods, damping=0.05),
}
earthquake_page(motion, spectra)
