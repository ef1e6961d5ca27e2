"""
Profile likelihood: how accurate is a fit?
==========================================

A profile shows the uncertainty of a fitted parameter. To compute the profile, this parameter is
fixed at values away from its optimum, and all other parameters are fitted again. The ends of the
confidence interval are where the curve crosses the dotted line. In this example, the damping of the
bumpers is ten times less certain than their stiffness.
"""

import numpy as np
import xarray as xr

import vibroimpact as vi
from vibroimpact.figures import fit_profiles
from vibroimpact.measurements.read import as_measured

# The test has 2 % noise, and the starting values of the fit are far from the solution.
case = vi.laboratory.case("B2-G2-A2", "identified")
swept = vi.sweep(case, [k / 10 for k in range(8, 35)])
noise = np.random.default_rng(0).normal(1.0, 0.02, size=(2, 2, 27))
names = ["displacement_excursion", "acceleration_excursion"]
test = as_measured(xr.Dataset({n: swept[n] * e for n, e in zip(names, noise, strict=True)}))

bumper = vi.Bumper("400 kN/m", "0.5 kN s/m", "10 mm")
guess = vi.Oscillator("550 kg", vi.Isolator("25 kN/m", "1.5 kN s/m"), bumper, bumper)

free = "isolator.stiffness,isolator.damping,stops.stiffness,stops.damping"
fit = vi.identify(vi.Rig(guess, "0.04 g"), test, free, starts=2)
fit_profiles(fit)
