"""Classify the steady motions of two laboratory rigs, list their contacts, draw them on one page.

python kinds_of_motion.py [FOLDER]
"""

import sys
from pathlib import Path

import vibroimpact as vi
from vibroimpact.figures import motion_page, save_figure

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
folder.mkdir(parents=True, exist_ok=True)

columns = {}
for code, frequency in (("B2-G1-A3", 2.6), ("B3-10mm-A3", 1.06)):
    found = vi.coexisting_motions(code, frequency=frequency)
    for number in range(found.sizes["attractor"]):
        motion = vi.steady(code, found.isel(attractor=number), frequency=frequency)
        kind = motion["motion"].item()
        columns[f"{code}, {frequency:g} Hz, motion {number + 1}:\n{kind}"] = motion
        print(f"{code} at {frequency:g} Hz, motion {number + 1}: {kind}")
        print(f"  because {motion.attrs['evidence']}")
        # The first three contacts, with force and energy loss.
        log = vi.contacts(motion).isel(contact_number=slice(3))
        for force, lost in zip(log["contact_peak_force"], log["contact_dissipated"], strict=True):
            print(f"  contact with up to {float(force) / 1e3:.2f} kN, {float(lost):.2f} J lost")

axes = motion_page(columns, title="Kinds of motion")
print(save_figure(axes, folder / "kinds-of-motion.png"))
