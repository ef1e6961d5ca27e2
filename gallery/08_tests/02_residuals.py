"""
Residuals of a wrong contact law
================================

A model with Hertz contacts is fitted to a test of a rig that does not have such contacts. If a
model is right, its residuals are random noise within the band, which is two standard deviations
wide to either side. In this figure, neighbouring residuals are correlated. The correlation shows
that the contact law is wrong. The figure also shows at which frequencies the law is wrong.
"""

import numpy as np
import xarray as xr

import vibroimpact as vi
from vibroimpact.figures import fit_residuals
from vibroimpact.identification.comparison import hertzian
from vibroimpact.measurements.read import as_measured

case = vi.laboratory.case("B2-G2-A2", "identified")
swept = vi.sweep(case, [k / 10 for k in range(8, 35)])
noise = np.random.default_rng(0).normal(1.0, 0.02, size=(2, 2, 27))
names = ["displacement_excursion", "acceleration_excursion"]
test = as_measured(xr.Dataset({n: swept[n] * e for n, e in zip(names, noise, strict=True)}))

bumper = vi.Bumper("400 kN/m", "0.5 kN s/m", "10 mm")
guess = vi.Oscillator("550 kg", vi.Isolator("25 kN/m", "1.5 kN s/m"), bumper, bumper)

contact = hertzian(guess, depth=0.002)
free = "isolator.stiffness,isolator.damping,stops.stiffness,stops.dissipation"
fit = vi.identify(vi.Rig(contact, "0.04 g"), test, free, starts=1, tried=0, profiles=False)
print(fit.attrs["findings"])
fit_residuals(fit)
