"""
Where the energy goes
=====================

Absolute acceleration over displacement is, but for the mass, the force on it; the area inside is
what isolator and bumpers take in a period. The spikes are the bumpers.
"""

import vibroimpact as vi
from vibroimpact.figures import hysteresis_cycle

case = vi.laboratory.case("B2-G1-A3")
first, second = vi.coexisting_motions(
    vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, "2 Hz")), samples=1024
)
hysteresis_cycle({"forward": first, "backward": second})
