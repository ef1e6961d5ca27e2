"""
A measured test and the model
=============================

Points are a test; curves are the model with the parameters that were identified from it. The test
locates a jump only to within one of its frequency steps, and the figure shows this interval.
"""

import numpy as np
import xarray as xr

import vibroimpact as vi
from vibroimpact.figures import resonance_curves
from vibroimpact.measurements.read import as_measured

case = vi.laboratory.case("B2-G1-A3", parameters="identified")
model = vi.sweep(case, [k / 50 for k in range(25, 201)])

# A test: every tenth of a hertz, with 4 % of noise. ``vi.read_measurement`` reads a real one.
held = vi.sweep(case, [k / 10 for k in range(5, 41)])
noise = np.random.default_rng(1).normal(1.0, 0.04, size=(2, 2, 36))
names = ["displacement_excursion", "acceleration_excursion"]
test = as_measured(xr.Dataset({n: held[n] * e for n, e in zip(names, noise, strict=True)}))

resonance_curves(model, measured=test)
