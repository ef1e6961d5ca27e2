"""Sweep the frequency of one laboratory rig up and down, list the jumps, draw the resonance curves.

python first_sweep.py [FOLDER]
"""

import sys
from pathlib import Path

import vibroimpact as vi
from vibroimpact.figures import resonance_curves, save_figure
from vibroimpact.response.resonance import features

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
folder.mkdir(parents=True, exist_ok=True)

case = vi.laboratory.case("B2-G1-A3", parameters="identified")
frequencies = [k / 100 for k in range(50, 501)]  # 0.5 to 5 Hz by 0.01 Hz
data = vi.sweep(case, frequencies)

# The dataset has labelled dimensions. This is η_a at 2 Hz in the forward and the backward sweep.
up, down = data["eta_a"].sel(frequency=2.0)
print(f"at 2 Hz, acceleration over that of free flight: {up:.3f} up, {down:.3f} down")

for jump in features(data).jumps:
    way = "up" if jump.upward else "down"
    print(f"{jump.direction} sweep jumps {way} between {jump.before:g} and {jump.after:g} Hz")

axes = resonance_curves(data, title=case.code)
print(save_figure(axes, folder / f"{case.slug}-sweep.png"))
print(vi.save(data, folder / f"{case.slug}-sweep.nc"))
