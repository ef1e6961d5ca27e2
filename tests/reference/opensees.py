"""Rigs of many laws by OpenSeesPy's materials and Newmark's average acceleration.

Only tests use it, those that skip where OpenSeesPy is not installed. One element a law, between the
base and the mass; the parameters of each material are those of our law in other words:

- `Steel01` of BilinearIsolator: F_y, k_e and k_p/k_e;
- `BoucWen` of BoucWenIsolator: its z is ours, so that its γ and β are ours over u_yⁿ, and A = 1;
- `HystereticSmooth` of ExponentialIsolator with Q = 1: k_a, k_b, f̄ = (k_a − k_b)/(2 α) and β;
- `ElasticPPGap` of a Bumper without damping, which never yields;
- `Hertzdamp` of a PowerBumper by a restitution: k, d, gap and n, whatever relation gives d;
- `JankowskiImpact` of JankowskiBumper: k, ξ, m and gap.

These stops are pressed where their element becomes shorter than a gap below 0.
"""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

import vibroimpact as vi
from benchmarks.peers.opensees_peer import ops

_EXACT = ("NormDispIncr", 1e-15, 200)
"""So far, that what is left of the iterations does not hide the order of the steps."""


def _material(tag: int, law: Any) -> None:
    """Make the material of a law, without the dashpot."""
    make = ops.uniaxialMaterial
    match law:
        case vi.Isolator():
            make("Elastic", tag, law.stiffness)
        case vi.BilinearIsolator():
            softer = law.post_yield_stiffness / law.elastic_stiffness
            make("Steel01", tag, law.yield_force, law.elastic_stiffness, softer)
        case vi.BoucWenIsolator():
            softer = law.post_yield_stiffness / law.elastic_stiffness
            scale = law.yield_displacement**-law.exponent
            shape = (float(law.exponent), law.gamma * scale, law.beta * scale, 1.0)
            make("BoucWen", tag, softer, law.elastic_stiffness, *shape, 0.0, 0.0, 0.0, 1e-16, 50)
        case vi.ExponentialIsolator():
            assert law.hardening_force == 1.0
            ends = (law.reversal_stiffness, law.final_stiffness)
            make("HystereticSmooth", tag, *ends, law.hysteretic_force, law.hardening)
        case vi.Bumper():
            assert law.damping == 0.0
            make("ElasticPPGap", tag, law.stiffness, -1e30, -law.gap)
        case vi.PowerBumper():
            make("Hertzdamp", tag, law.stiffness, law.dissipation_number, -law.gap, law.exponent)
        case vi.JankowskiBumper():
            make("JankowskiImpact", tag, law.stiffness, law.damping_ratio, law.mass, -law.gap)
        case _:
            raise NotImplementedError(type(law).__name__)


def _build(rig: vi.Oscillator, shaken: vi.Harmonic | vi.Record, duration: float) -> None:
    ops.logFile(os.devnull, "-noEcho")  # it tells of every impact
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, rig.mass)
    # An element is as long as the second of its nodes is to the right of the first.
    for tag, law, nodes in (
        (1, rig.isolator, (1, 2)),
        (2, rig.right, (2, 1)),
        (3, rig.left, (1, 2)),
    ):
        if law is not None:
            _material(tag, law)
            ops.element("zeroLength", tag, *nodes, "-mat", tag, "-dir", 1)
    ops.uniaxialMaterial("Viscous", 4, rig.isolator.damping, rig.isolator.damping_exponent)
    ops.element("zeroLength", 4, 1, 2, "-mat", 4, "-dir", 1)
    if isinstance(shaken, vi.Record):
        # One value more, or a last step that ends a rounding too late would find no load.
        values = [*shaken.acceleration.tolist(), shaken.acceleration[-1]]
        ops.timeSeries("Path", 1, "-dt", shaken.step, "-values", *values)
    else:
        wave = ("-factor", shaken.amplitude, "-shift", shaken.phase)
        # No longer than needed, for OpenSees integrates it over all of its duration.
        ops.timeSeries("Trig", 1, 0.0, 1.1 * duration, shaken.period, *wave)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("ProfileSPD")
    ops.test(*_EXACT)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def follow(
    rig: vi.Oscillator,
    shaken: vi.Harmonic | vi.Record,
    span: float,
    spans: int,
    steps: int,
) -> NDArray[np.float64]:
    """Displacement and velocity, from rest, at the ends of so many spans (s) of so many steps.

    The shaking must begin with 0, for OpenSees takes the acceleration at the start for 0.
    """
    begin = shaken.acceleration[0] if isinstance(shaken, vi.Record) else math.sin(shaken.phase)
    assert begin == 0.0
    _build(rig, shaken, span * spans)
    states = np.empty((spans, 2))
    for row in states:
        if ops.analyze(steps, span / steps):
            raise ArithmeticError("OpenSees gave up")
        row[:] = ops.nodeDisp(2, 1), ops.nodeVel(2, 1)
    return states
