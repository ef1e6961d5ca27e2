"""A rig between two bumpers under a record, by OpenSeesPy: Newmark's average acceleration.

A bumper is a node without mass on a spring and a dashpot in parallel, behind a stiff element that
only takes pressure once its gap is closed: so it deforms, forgets and never pulls, as here.
"""

import ctypes
import importlib.util
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vibroimpact.model import BilinearIsolator, Bumper, Isolator, Oscillator, Record

_PENALTY = 1e4
"""Stiffness of the contact over the bumper's."""


def _opensees() -> Any:
    """The module; its wheel has the libraries that it needs, but not where they are looked for."""
    spec = importlib.util.find_spec("openseespylinux")
    if spec is not None and spec.submodule_search_locations:
        folder = Path(spec.submodule_search_locations[0]) / "lib"
        for name in ("quadmath.so.0", "gfortran.so.4", "blas.so.3", "lapack.so.3", "gomp.so.1"):
            if (folder / f"lib{name}").exists():
                ctypes.CDLL(str(folder / f"lib{name}"), mode=ctypes.RTLD_GLOBAL)
    try:
        import openseespy.opensees as module
    except RuntimeError as error:
        raise ImportError(str(error)) from None
    return module


ops = _opensees()


def isolate(rig: Oscillator) -> None:
    """Put the isolator between the base and the mass."""
    isolator = rig.isolator
    if isinstance(isolator, BilinearIsolator):
        elastic, ratio = isolator.elastic_stiffness, isolator.post_yield_stiffness
        ops.uniaxialMaterial("Steel01", 1, isolator.yield_force, elastic, ratio / elastic)
        ops.uniaxialMaterial("Elastic", 2, 0.0, isolator.damping)
        ops.element("zeroLength", 2, 1, 2, "-mat", 2, "-dir", 1)
    else:
        assert isinstance(isolator, Isolator)
        ops.uniaxialMaterial("Elastic", 1, isolator.stiffness, isolator.damping)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)


def build(rig: Oscillator, record: Record) -> None:
    """Make the model, at rest."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, rig.mass)
    isolate(rig)
    for i, (sign, stop) in enumerate(((1, rig.right), (-1, rig.left)), start=1):
        if stop is not None:
            assert isinstance(stop, Bumper)
            add_bumper(stop, 2, sign, 2 + i)
    shake(record)


def add_bumper(stop: Bumper, mass: int, sign: int, node: int) -> None:
    """Put a bumper, with a face of its own, between the base and the right or left of a mass."""
    law, contact = 10 * node, 10 * node + 1
    ops.node(node, 0.0)
    ops.uniaxialMaterial("Elastic", law, stop.stiffness, stop.damping)
    ops.element("zeroLength", law, 1, node, "-mat", law, "-dir", 1)
    # From the mass to the bumper's face: the element shortens as the mass goes right.
    stiff = _PENALTY * stop.stiffness
    ops.uniaxialMaterial("ElasticPPGap", contact, stiff, -1e30, -stop.gap)
    ends = (mass, node) if sign == 1 else (node, mass)
    ops.element("zeroLength", contact, *ends, "-mat", contact, "-dir", 1)


def shake(record: Record) -> None:
    """Put the record under the model, and choose the method."""
    # One value more, or a last step that ends a rounding too late would find no load.
    values = [*record.acceleration.tolist(), float(record.acceleration[-1])]
    ops.timeSeries("Path", 1, "-dt", record.step, "-values", *values)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("ProfileSPD")
    ops.test("NormDispIncr", 1e-12, 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def follow(rig: Oscillator, record: Record, divisions: int) -> NDArray[np.float64]:
    """Displacements at the record's samples, with so many steps between two of them."""
    build(rig, record)
    return stepped(2, record, divisions)


def stepped(node: int, record: Record, divisions: int) -> NDArray[np.float64]:
    """Displacements of a node at the record's samples."""
    count = len(record.acceleration)
    displacement = np.zeros(count)
    for k in range(1, count):
        if ops.analyze(divisions, record.step / divisions):
            raise ArithmeticError(f"OpenSees gave up at sample {k}")
        displacement[k] = ops.nodeDisp(node, 1)
    return displacement


def peak(rig: Oscillator, record: Record, divisions: int) -> float:
    """Largest displacement to either side at any of its steps, to the end of the record."""
    build(rig, record)
    largest = 0.0
    for _ in range((len(record.acceleration) - 1) * divisions):
        if ops.analyze(1, record.step / divisions):
            raise ArithmeticError("OpenSees gave up")
        largest = max(largest, abs(ops.nodeDisp(2, 1)))
    return largest
