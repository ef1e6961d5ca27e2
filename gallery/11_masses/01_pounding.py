"""
Neighbours that pound each other
================================

Two frames of different periods stand 2 cm apart. In an earthquake, they move out of phase and
pound each other at two levels. Bands mark the contacts, from their exact beginning to their exact
end, in the panels of the masses that meet.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import contact_forces, mass_envelopes, mass_histories, pair_portrait


def quake(seed, peak="0.3 g"):
    """Make a synthetic strong motion; ``vi.Record.read`` reads a measured one."""
    rng = np.random.default_rng(seed)
    time = np.arange(2000) * 0.01
    waves = np.sin(2 * np.pi * np.outer(time, np.linspace(0.2, 8, 80)) + rng.uniform(0, 6.28, 80))
    swell = (time / 4.0) ** 2 * np.exp(-time / 2.0)
    return vi.Record(swell * waves.sum(axis=1), "10 ms").scaled(peak=peak)


def frame(name, stiffness):
    """Return the links of a frame of two storeys."""
    storey = vi.Isolator(stiffness, "0.8 MN s/m")
    return {
        f"{name}_lower": vi.Link("ground", f"{name}1", storey),
        f"{name}_upper": vi.Link(f"{name}1", f"{name}2", storey),
    }


pounding = vi.Bumper("500 MN/m", "2 MN s/m", "2 cm")
neighbours = vi.Assembly(
    masses={"west1": "200 t", "west2": "180 t", "east1": "250 t", "east2": "220 t"},
    links={**frame("west", "60 MN/m"), **frame("east", "130 MN/m")},
    stops={
        "level_1": vi.Link("west1", "east1", pounding),
        "level_2": vi.Link("west2", "east2", pounding),
    },
)
motion = vi.simulate(vi.Rig(neighbours, quake(1, "0.4 g")), samples=4)
mass_histories(motion)

# %%
# The largest contact force is that of the upper level, where the frames move most:
contact_forces(motion)

# %%
# Pounding multiplies the accelerations of the masses that meet. The largest displacements change
# much less:
apart = vi.simulate(vi.Rig(neighbours.replace(stops={}), quake(1, "0.4 g")), samples=4)
mass_envelopes({"pounding": motion, "far apart": apart})

# %%
# In the plane of the two roofs, the bumper is pressed in the shaded area:
pair_portrait(motion, "west2", "east2")
