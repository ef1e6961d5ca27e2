"""Draw two motions that coexist at one frequency: the figure of the README.

python two_motions.py [FOLDER]

The left panel shows all orbits of the rig B2-G1-A3 over the frequency, with an upward and a
downward sweep. The right panel shows the two motions at 2 Hz, one of which hits both bumpers.
"""

import sys
from pathlib import Path

from matplotlib.figure import Figure

import vibroimpact as vi
from vibroimpact.figures import branch_diagram, phase_portrait, save_figure

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
folder.mkdir(parents=True, exist_ok=True)

case = vi.laboratory.case("B2-G1-A3")
curves = vi.sweep(case, [k / 100 for k in range(60, 361, 6)])
orbits = vi.resonance_diagram(case, {"frequency": ("0.6 Hz", "3.6 Hz")})
found = vi.coexisting_motions(case, frequency="2 Hz")
motions = {}
for number in range(found.sizes["attractor"]):
    start = found.isel(attractor=number)
    name = "forward" if start["impacts"].sel(stop="right") else "backward"
    motions[name] = vi.steady(case, start, frequency="2 Hz", samples=1024)

figure = Figure(figsize=(10.0, 4.2), layout="constrained")
left, right = figure.subplots(1, 2, width_ratios=[1.4, 1.0])
branch_diagram(orbits, left, quantity="eta_a", sweep=curves)
left.set_ylabel("excursion of acceleration $\\eta_a$ (–)")
phase_portrait(motions, right)
print(save_figure(figure, folder / "two-motions.png"))
