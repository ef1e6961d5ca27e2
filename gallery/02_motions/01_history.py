"""
Impact by impact
================

Two motions at one frequency: the one that a sweep up brings along hits a bumper on each side in
every cycle, the other flies free. Where a damped bumper is met the acceleration jumps, for the
dashpot resists at once.
"""

import vibroimpact as vi
from vibroimpact.figures import time_history

case = vi.laboratory.case("B2-G1-A3")
first, second = vi.coexisting_motions(
    vi.Rig(case.oscillator, vi.Harmonic(case.amplitude, "2 Hz")), samples=512
)
time_history({"forward": first, "backward": second})
