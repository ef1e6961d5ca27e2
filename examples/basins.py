"""Draw which motion a mass settles on that bounces on a stop, hard or soft.

    python examples/basins.py [FOLDER] [NODES]

draws docs/images/basins.png and manifolds.png, and writes basins.nc, into FOLDER (out).
"""

from __future__ import annotations

import sys
from pathlib import Path

import vibroimpact as vi
from vibroimpact.figures import basin_portrait, save_figure

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
nodes = int(sys.argv[2]) if len(sys.argv) > 2 else 700
folder.mkdir(parents=True, exist_ok=True)

wall = vi.RigidStop(restitution=0.9, gap=0.0)
isolator = vi.Isolator(stiffness=1.0, damping=0.02)
rig = vi.Oscillator(mass=1.0, isolator=isolator, right=wall, left=None)
found = vi.basins(vi.Rig(rig, vi.Harmonic(1.0, 0.5252)), (-1.05, 0.0), (-1.25, 1.25), nodes=nodes)
vi.save(found, folder / "basins.nc")
save_figure(basin_portrait(found), folder / "basins.png")
for number in found["attractor"].values:
    one = found.sel(attractor=number)
    share = f"{one['share'].item():.1%} ({one['share_low'].item():.1%} to"
    print(number + 1, "period", one["period"].item(), share, f"{one['share_high'].item():.1%})")

# A softer stop: the borders are the stable curves of a saddle.
soft = vi.Oscillator(1.0, vi.Isolator(1.0, 0.06), vi.Bumper(30.0, 0.6, 0.5), None)
shaking = vi.Harmonic(1.0, 0.5411)
curves = vi.manifolds(vi.Rig(soft, shaking), longest=40.0)
softly = vi.basins(vi.Rig(soft, shaking), nodes=nodes)
save_figure(basin_portrait(softly, manifolds=curves), folder / "manifolds.png")
