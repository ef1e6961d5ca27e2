"""
Fit of a time history
=====================

The dots are noisy measurements of a motion with contacts. The line is the motion of the fitted rig.
The initial state of this motion is fitted, too.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import fit_history
from vibroimpact.measurements.read import as_measured

case = vi.laboratory.case("B2-G1-A3")
motion = vi.simulate(case, 12, samples=48, frequency="2 Hz")
noise = np.random.default_rng(3).normal(size=(2, motion.sizes["time"]))
test = as_measured(
    motion[["base_acceleration"]].assign(
        displacement=motion["displacement"] + 1e-4 * noise[0],
        acceleration=motion["acceleration"] + 0.05 * noise[1],
    )
)

bumper = vi.Bumper("700 kN/m", "0.5 kN s/m", "7.5 mm")
guess = vi.Oscillator("550 kg", case.oscillator.isolator, bumper, bumper)
fit = vi.identify(guess, test, "stops.stiffness,stops.damping,gap", starts=1, profiles=False)
fit_history(fit)
