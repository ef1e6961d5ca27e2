"""
An isolated frame at its wall
=============================

A frame of three storeys on isolators stands in a moat. When its base hits the wall, the impact
runs upwards, and the storeys accelerate several times as strongly as in a wide moat. Their drifts
grow, too. Only the isolators are deformed less.
"""

import numpy as np

import vibroimpact as vi
from vibroimpact.figures import mass_envelopes, mass_histories


def quake(seed, peak="0.3 g"):
    """Make a synthetic strong motion; ``vi.Record.read`` reads a measured one."""
    rng = np.random.default_rng(seed)
    time = np.arange(2000) * 0.01
    waves = np.sin(2 * np.pi * np.outer(time, np.linspace(0.2, 8, 80)) + rng.uniform(0, 6.28, 80))
    swell = (time / 4.0) ** 2 * np.exp(-time / 2.0)
    return vi.Record(swell * waves.sum(axis=1), "10 ms").scaled(peak=peak)


storey = vi.Isolator("150 MN/m", "0.8 MN s/m")
wall = vi.Bumper("400 MN/m", "3 MN s/m", "12 cm")
frame = vi.Assembly(
    masses={"base": "300 t", "first": "250 t", "second": "250 t", "roof": "200 t"},
    links={
        "isolator": vi.Link("ground", "base", vi.Isolator("7 MN/m", "0.5 MN s/m")),
        "storey_1": vi.Link("base", "first", storey),
        "storey_2": vi.Link("first", "second", storey),
        "storey_3": vi.Link("second", "roof", storey),
    },
    stops={
        "wall_right": vi.Link("base", "ground", wall),
        "wall_left": vi.Link("ground", "base", wall),
    },
)
motion = vi.simulate(vi.Rig(frame, quake(1, "0.5 g")), tail="3 s", samples=4)
mass_histories(motion, quantity="acceleration")

# %%
free = vi.simulate(vi.Rig(frame.replace(stops={}), quake(1, "0.5 g")), tail="3 s", samples=4)
mass_envelopes({"moat wall": motion, "wide moat": free})
