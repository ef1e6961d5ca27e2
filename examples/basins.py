"""Draw the basins of attraction of a mass that bounces on a stop, rigid or soft.

    python examples/basins.py [FOLDER] [NODES]

The script writes basins.png and manifolds.png, which docs/images contains, and basins.nc to FOLDER.
Defaults: out, and 700 nodes along each axis.
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
ball = vi.Oscillator(mass=1.0, isolator=isolator, right=wall, left=None)
found = vi.basins(vi.Rig(ball, 1.0, 0.5252), (-1.05, 0.0), (-1.25, 1.25), nodes=nodes)
vi.save(found, folder / "basins.nc")
save_figure(basin_portrait(found), folder / "basins.png")
for number in found["attractor"].values:
    one = found.sel(attractor=number)
    share = f"{one['share'].item():.1%} ({one['share_low'].item():.1%} to"
    print(number + 1, "period", one["period"].item(), share, f"{one['share_high'].item():.1%})")

# A softer stop. The borders are the stable curves of a saddle.
softer = vi.Oscillator(1.0, vi.Isolator(1.0, 0.06), vi.Bumper(30.0, 0.6, 0.5), None)
rig = vi.Rig(softer, 1.0, 0.5411)
curves = vi.manifolds(rig, longest=40.0)
found = vi.basins(rig, nodes=nodes)
save_figure(basin_portrait(found, manifolds=curves), folder / "manifolds.png")
