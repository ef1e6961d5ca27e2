"""What a rig of any law holds of energy, from its samples."""

from __future__ import annotations

import xarray as xr
from scipy.integrate import quad

import vibroimpact as vi
from vibroimpact.model import Stop


def stored(oscillator: vi.Oscillator, data: xr.Dataset, at: int) -> float:
    """Energy (J) relative to the base, the constant force's included."""
    isolator = oscillator.isolator
    u, v = (float(data[name][at]) for name in ("displacement", "velocity"))
    z = float(data["isolator_memory"][at]) if "isolator_memory" in data else 0.0
    held = 0.5 * oscillator.mass * v**2 - oscillator.force * u
    match isolator:
        case vi.PolynomialIsolator():
            held += isolator.stiffness * u**2 / 2 + isolator.cubic * u**4 / 4
            held += isolator.quintic * u**6 / 6
        case vi.BilinearIsolator() | vi.BoucWenIsolator():
            held += isolator.post_yield_stiffness * u**2 / 2
            held += isolator.hysteretic_stiffness * z**2 / 2
        case vi.ExponentialIsolator():
            held += quad(isolator.elastic_force, 0.0, u, epsabs=1e-14, epsrel=1e-13)[0]
            held += (isolator.reversal_stiffness - isolator.final_stiffness) * z**2
        case vi.Law():
            held += quad(isolator.static_force, 0.0, u, epsabs=1e-14, epsrel=1e-13)[0]
        case _:
            held += isolator.stiffness * u**2 / 2
    for stop, side in ((oscillator.right, 1), (oscillator.left, -1)):
        if stop is None:
            continue
        depth = side * u - stop.gap
        name = "right" if side == 1 else "left"
        touched = bool(data["touching"].sel(stop=name)[at])
        if isinstance(stop, vi.Bumper):
            x = float(data["deformation"].sel(stop=name)[at])
            held += stop.stiffness * x**2 / 2
        elif touched and not isinstance(stop, vi.RigidStop):
            held += stored_by_stop(stop, depth)
    return held


def stored_by_stop(stop: Stop, depth: float) -> float:
    """Energy (J) that a deformable stop without memory returns, if it is left slowly."""
    if isinstance(stop, vi.PowerBumper | vi.JankowskiBumper):
        return stop.stiffness * depth ** (stop.exponent + 1) / (stop.exponent + 1)
    return float(quad(stop.static_force, 0.0, depth, epsabs=1e-14, epsrel=1e-13)[0])
