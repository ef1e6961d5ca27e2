"""
Resonance curves in millimetres and g
=====================================

The example is a machine on an isolator between two bumpers. For engineering use, this figure shows
the largest acceleration, displacement and contact force at each frequency, in physical units.
Dotted lines are the gaps. The labels mark frequencies that matter for the machine: A is the natural
frequency of the isolator, and B is the frequency of a pump.
"""

import vibroimpact as vi
from vibroimpact.figures import frequency_marks, resonance_curves

bumper = vi.Bumper(stiffness="510 kN/m", damping="0.9 kN s/m", gap="7.5 mm")
machine = vi.Oscillator("550 kg", vi.Isolator("26.8 kN/m", "1.1 kN s/m"), right=bumper, left=bumper)
curves = vi.sweep(vi.Rig(machine, "0.05 g"), [k / 50 for k in range(25, 201)])

axes = resonance_curves(curves)
frequency_marks(axes, {"A": machine.natural_frequency, "B": "3 Hz"})
axes
