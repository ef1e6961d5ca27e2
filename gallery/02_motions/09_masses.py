"""
Several masses with their links and stops
=========================================

An isolated building stands beside a neighbour. Each link and each stop is a row between its two
bodies. The base is hatched. The gaps (blue) are to scale.
"""

import vibroimpact as vi
from vibroimpact.figures import assembly_drawing

isolator = vi.Isolator("5 MN/m", "0.2 MN s/m")
storey = vi.Isolator("200 MN/m", "1 MN s/m")
moat = vi.Bumper("60 MN/m", "0.9 MN s/m", "10 cm")
building = vi.Assembly(
    masses={"base": "300 t", "floor": "250 t", "roof": "200 t"},
    links={
        "isolator": vi.Link("ground", "base", isolator),
        "storey_1": vi.Link("base", "floor", storey),
        "storey_2": vi.Link("floor", "roof", storey),
    },
    stops={
        "moat_left": vi.Link("ground", "base", moat),
        "moat_right": vi.Link("base", "ground", moat),
        "neighbour": vi.Link("roof", "ground", vi.RigidStop(restitution=0.6, gap="25 cm")),
    },
)
assembly_drawing(building)
