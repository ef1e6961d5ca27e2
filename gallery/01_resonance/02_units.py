"""
The same in millimetres and g
=============================

For a drawing office: the largest acceleration, displacement and contact force at each frequency,
with the gaps as dotted lines, and any frequency marked that matters to the plant: here A is the
isolator's own, B that of a pump.
"""

import vibroimpact as vi
from vibroimpact.figures import frequency_marks, resonance_curves

bumper = vi.Bumper(stiffness="510 kN/m", damping="0.9 kN s/m", gap="7.5 mm")
rig = vi.Oscillator("550 kg", vi.Isolator("26.8 kN/m", "1.1 kN s/m"), right=bumper, left=bumper)
curves = vi.sweep(vi.Rig(rig, "0.05 g"), [k / 50 for k in range(25, 201)])

axes = resonance_curves(curves, physical=True)
frequency_marks(axes, {"A": rig.natural_frequency, "B": "3 Hz"})
axes
