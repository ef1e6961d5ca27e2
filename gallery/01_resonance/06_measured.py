"""
A measured test and the model
=============================

The points are the measured values of a test. The curves are those of the model, with the parameters
that were identified from the test. The frequency of the test was changed in steps, so a jump is
located only to within one step. The figure shows this step.
"""

import numpy as np
import xarray as xr

import vibroimpact as vi
from vibroimpact.figures import resonance_curves
from vibroimpact.measurements.read import as_measured

case = vi.laboratory.case("B2-G1-A3", parameters="identified")
model = vi.sweep(case, [k / 50 for k in range(25, 201)])

# A synthetic test in steps of 0.1 Hz, with 4 % noise. ``vi.read_measurement`` reads a real test.
held = vi.sweep(case, [k / 10 for k in range(5, 41)])
noise = np.random.default_rng(1).normal(1.0, 0.04, size=(2, 2, 36))
names = ["displacement_excursion", "acceleration_excursion"]
test = as_measured(xr.Dataset({n: held[n] * e for n, e in zip(names, noise, strict=True)}))

resonance_curves(model, measured=test)
