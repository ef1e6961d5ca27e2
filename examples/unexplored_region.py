"""Map the part of the (λ, δ0) plane that the published study leaves to future work.

Below δ0 = 0.2 the gaps are small; below λ = 2 the bumpers are soft. The script draws the scenarios,
and the numbers of left hystereses, irregular, chaotic and subharmonic ranges of each rig.

python unexplored_region.py [FOLDER] [NODES]

With 49 nodes along λ, as in docs/unexplored-region.md, it takes some minutes. An interrupted run
resumes when the script is started again.
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import vibroimpact as vi
from vibroimpact.figures import feature_map, save_figure, scenario_map
from vibroimpact.scenarios.borders import jump_border
from vibroimpact.scenarios.scenario import Scenario

COUNTS = ("left_hysteresis_count", "irregular_count", "chaotic_count", "subharmonic_count")


folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out/unexplored")
nodes = int(sys.argv[2]) if len(sys.argv) > 2 else 49
folder.mkdir(parents=True, exist_ok=True)

bands = {
    "small-gaps": (np.geomspace(0.5, 100.0, nodes), np.linspace(0.0, 0.2, nodes * 4 // 5 + 2)),
    "soft-bumpers": (np.geomspace(0.1, 2.0, nodes), np.linspace(0.0, 1.0, nodes * 4 // 5 + 2)),
}
for name, (stiffness, gap) in bands.items():
    data = vi.scenario_map(
        None,
        {"stiffness_ratio": stiffness, "gap_ratio": gap},
        store=folder / f"{name}-{nodes}.zarr",
    )
    print(f"{name}: {data['scenario'].size} rigs")
    kinds = data["scenario"].values
    for kind in Scenario:
        if (kinds == kind).any():
            words = [f"{(kinds == kind).mean():.1%}"]
            for count in COUNTS:
                values = data[count].values[kinds == kind]
                words.append(f"{count.removesuffix('_count')} {values.min()} to {values.max()}")
            print(f"  {kind.label}: {', '.join(words)}")
    print(save_figure(scenario_map(data, border=jump_border(data)), folder / f"{name}.png"))
    figure = Figure(figsize=(11.0, 8.4), layout="constrained")
    for count, axes in zip(COUNTS, figure.subplots(2, 2).flat, strict=True):
        feature_map(data, count, axes)
    print(save_figure(axes, folder / f"{name}-counts.png"))
