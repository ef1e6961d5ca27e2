"""
A time history, impact by impact
================================

This figure shows two motions that coexist at one frequency. An upward frequency sweep leads to the
motion that hits a bumper on each side in every cycle. A downward sweep leads to the other motion,
which touches no bumper (free flight). When the mass hits a damped bumper, the acceleration jumps,
because the dashpot of the bumper resists at once.
"""

import vibroimpact as vi
from vibroimpact.figures import time_history

case = vi.laboratory.case("B2-G1-A3")
found = vi.coexisting_motions(case, frequency="2 Hz")
first, second = (
    vi.steady(case, found.isel(attractor=number), frequency="2 Hz", samples=512)
    for number in (0, 1)
)
time_history({"forward": first, "backward": second})
