"""
Force-displacement laws
=======================

These figures show the force over the displacement for eight force laws. The first five laws are
isolators, which slide, yield, harden or soften. The last three laws are stops, which act only
during contact. You can combine any isolator with any stop on either side, and all functions of this
package accept the combination.
"""

from matplotlib.figure import Figure

import vibroimpact as vi
from vibroimpact.figures import force_loop

laws = {
    "friction pendulum": (vi.FrictionIsolator.from_pendulum("550 kg", "0.5 m", 0.05), "30 mm"),
    "lead-rubber, bilinear": (vi.BilinearIsolator("100 kN/m", "20 kN/m", "400 N", 0), "20 mm"),
    "Bouc-Wen": (vi.BoucWenIsolator("100 kN/m", "20 kN/m", "400 N", 0, exponent=2), "20 mm"),
    "wire rope, exponential": (
        vi.ExponentialIsolator("100 kN/m", "15 kN/m", "150 1/m", 0, "120 1/m", "30 N"),
        "20 mm",
    ),
    "softens, then hardens": (
        vi.PolynomialIsolator("30 kN/m", "300 N s/m", "-40 MN/m^3", "40 GN/m^5"),
        "25 mm",
    ),
    "Kelvin-Voigt bumper": (vi.Bumper("510 kN/m", "3 kN s/m", 0), "3 mm"),
    "Hertz, Hunt and Crossley": (vi.PowerBumper("50 MN/m^1.5", 0, restitution=0.6), "3 mm"),
    "Jankowski": (vi.JankowskiBumper("50 MN/m^1.5", 0, 0.6, "550 kg"), "3 mm"),
}

figure = Figure(figsize=(12.0, 5.6), layout="constrained")
for ax, (name, (law, amplitude)) in zip(figure.subplots(2, 4).flat, laws.items(), strict=True):
    force_loop(law, amplitude, "2 Hz" if "mm" in amplitude else 0.0, ax)
    ax.set_title(name, fontsize="medium")
figure
