"""
What to test next
=================

A dwell is a test at one frequency and one level of shaking. For every possible next dwell, this map
shows how much information the dwell would give about all parameters together. The bright ridges are
the best choices. They lie just above the level of shaking at which the mass begins to touch the
bumpers, and just before a jump.
"""

import numpy as np
import xarray as xr
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

import vibroimpact as vi
from vibroimpact.measurements.read import as_measured

case = vi.laboratory.case("B2-G2-A2", "identified")
swept = vi.sweep(case, [k / 10 for k in range(8, 35)])
noise = np.random.default_rng(0).normal(1.0, 0.02, size=(2, 2, 27))
names = ["displacement_excursion", "acceleration_excursion"]
test = as_measured(xr.Dataset({n: swept[n] * e for n, e in zip(names, noise, strict=True)}))

bumper = vi.Bumper("400 kN/m", "0.5 kN s/m", "10 mm")
guess = vi.Oscillator("550 kg", vi.Isolator("25 kN/m", "1.5 kN s/m"), bumper, bumper)

free = "isolator.stiffness,isolator.damping,stops.stiffness,stops.damping"
fit = vi.identify(vi.Rig(guess, "0.04 g"), test, free, starts=1, profiles=False)
levels = 9.80665 * np.linspace(0.02, 0.1, 17)
told = vi.next_test(fit, frequencies=np.linspace(0.6, 4.0, 69), amplitudes=levels)

figure = Figure(figsize=(7.0, 4.4), layout="constrained")
ax = figure.subplots()
gain = told["information"].sel(direction="forward")
scale = LogNorm(1e-3, 1.0)
drawn = ax.pcolormesh(gain["frequency"], levels / 9.80665, gain, cmap="cividis", norm=scale)
figure.colorbar(drawn, extend="both", label="information (nats)")
ax.set_xlabel("frequency of the dwell, in an upward sweep (Hz)")
ax.set_ylabel("base acceleration (g)")
figure
