"""A building on its isolator between two bumpers under a record, by OpenSeesPy.

Method and bumpers are those of `opensees_peer`.
"""

import numpy as np
from numpy.typing import NDArray

from vibroimpact.model import Assembly, Bumper, Isolator, Record

from .opensees_peer import add_bumper, ops, shake, stepped


def follow(building: Assembly, of: str, record: Record, divisions: int) -> NDArray[np.float64]:
    """Displacements of a mass at the record's samples, with so many steps between two of them."""
    nodes = {"ground": 1} | {name: i for i, name in enumerate(building.names, start=2)}
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for node in nodes.values():
        ops.node(node, 0.0)
    ops.fix(1, 1)
    for name, mass in building.masses.items():
        ops.mass(nodes[name], mass)
    for i, link in enumerate(building.links.values(), start=1):
        assert isinstance(link.law, Isolator)
        ops.uniaxialMaterial("Elastic", i, link.law.stiffness, link.law.damping)
        ops.element("zeroLength", i, nodes[link.left], nodes[link.right], "-mat", i, "-dir", 1)
    for i, stop in enumerate(building.stops.values(), start=len(nodes) + 1):
        assert isinstance(stop.law, Bumper)
        right = stop.right == "ground"
        add_bumper(stop.law, nodes[stop.left if right else stop.right], 1 if right else -1, i)
    shake(record)
    return stepped(nodes[of], record, divisions)
