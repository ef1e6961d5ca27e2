"""
From a bent resonance to a jump
===============================

This figure compares five bumpers. The stiffness ratio λ is the stiffness of a bumper divided by the
stiffness of the isolator. It ranges from 0.5 to 80. Soft bumpers bend the resonance curve, but they
do not fold it: upward and downward sweeps give the same curve. Above some stiffness, the curve
folds over, and the sweeps jump. The left panel shows the displacement, and the right panel shows
the acceleration.
"""

from matplotlib.figure import Figure

import vibroimpact as vi
from vibroimpact.figures import family_legend, resonance_family

rigs = {
    f"λ = {ratio}": vi.from_dimensionless(
        stiffness_ratio=ratio, gap=0.2, relaxation_time=0.01, damping_ratio=0.15
    )
    for ratio in (0.5, 1.5, 5, 20, 80)
}
first = next(iter(rigs.values()))
natural = float(first.oscillator.natural_frequency)
curves = vi.sweeps(rigs, [natural * k / 50 for k in range(20, 251)])

figure = Figure(figsize=(10.0, 4.2), layout="constrained")
axes = figure.subplots(1, 2)
for ax, quantity in zip(axes, ("eta_d", "eta_a"), strict=True):
    resonance_family(curves, ax, quantity=quantity, legend=False)
    ax.set_xlim(0.06, 0.56)
handles = family_legend(axes[0])
figure.legend(handles=handles, loc="outside right center", frameon=False)
figure
