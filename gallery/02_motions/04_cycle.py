"""
Hysteresis cycle: where the energy goes
=======================================

For two motions that coexist at one frequency, this figure shows the absolute acceleration over the
displacement. The acceleration multiplied by the mass is the force on the mass. The area of the
cycle, multiplied by the mass, is therefore the energy that the isolator and the bumpers dissipate
in one period. The spikes are contacts with the bumpers.
"""

import vibroimpact as vi
from vibroimpact.figures import hysteresis_cycle

case = vi.laboratory.case("B2-G1-A3")
found = vi.coexisting_motions(case, frequency="2 Hz")
first, second = (
    vi.steady(case, found.isel(attractor=number), frequency="2 Hz", samples=1024)
    for number in (0, 1)
)
hysteresis_cycle({"forward": first, "backward": second})
