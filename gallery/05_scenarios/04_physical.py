"""
Scenario map in physical units
==============================

A scenario is a class of resonance curves, such as curves with a jump. This map shows the scenarios
of one laboratory rig over the gap and the stiffness of its bumpers, in physical units.
"""

from pathlib import Path
from tempfile import mkdtemp

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import figure_size, save_figure, scenario_map

data = vi.scenario_map(
    "B2-G1-A3",
    {"gap": np.linspace(2e-3, 36e-3, 15), "proportional_stiffness": np.geomspace(2e4, 2e6, 13)},
    step=0.03,
)
with figure_size("86 mm"):  # for one column of a journal
    column = scenario_map(data)
save_figure(column, Path(mkdtemp(), "map.pdf"))
scenario_map(data)
