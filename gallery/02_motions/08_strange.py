"""
A strange attractor
===================

This figure shows forty thousand states of a chaotic motion, one per forcing cycle. The set of these
points is called a strange attractor. The motion between impacts stretches the set, and the impacts
fold it. The result is many thin layers. Each fold ends where the mass just grazes the wall.
"""

from matplotlib.figure import Figure

import vibroimpact as vi

wall = vi.RigidStop(restitution=0.8, gap=0.0)
ball = vi.Oscillator(1.0, vi.Isolator(stiffness=1.0, damping=0.05), right=wall, left=None)
motion = vi.steady(vi.Rig(ball, vi.Harmonic(1.0, 0.445)))
print(motion["motion"].item(), f"largest exponent {float(motion['exponents'][0]):+.3f} 1/s")
points = vi.stroboscopic_section(motion, phase=1.0, cycles=40_000)

figure = Figure(figsize=(7.0, 4.6), layout="constrained")
ax = figure.subplots()
ax.plot(points["section_displacement"], points["section_velocity"], ",", color="#1f2a5a", alpha=0.6)
ax.set_xlabel("displacement (m)")
ax.set_ylabel("velocity (m/s)")
figure
