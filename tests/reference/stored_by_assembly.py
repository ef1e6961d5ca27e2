"""What an assembly holds of energy, from a state by its names."""

from __future__ import annotations

import xarray as xr
from scipy.integrate import quad

import vibroimpact as vi


def stored(assembly: vi.Assembly, state: xr.DataArray) -> float:
    """Energy (J) relative to the base, that of constant forces included."""

    def of(part: str, name: str) -> float:
        key = f"{part}.{name}"
        return float(state.sel(component=key)) if key in state["component"] else 0.0

    def at(body: str) -> float:
        return 0.0 if body == "ground" else of("displacement", body)

    held = 0.0
    for name, mass in assembly.masses.items():
        held += 0.5 * mass * of("velocity", name) ** 2
        held -= assembly.forces.get(name, 0.0) * at(name)
    for name, link in assembly.links.items():
        s, law = at(link.right) - at(link.left), link.law
        match law:
            case vi.PolynomialIsolator():
                held += law.stiffness * s**2 / 2 + law.cubic * s**4 / 4 + law.quintic * s**6 / 6
            case vi.BilinearIsolator() | vi.BoucWenIsolator():
                held += law.post_yield_stiffness * s**2 / 2
                held += law.hysteretic_stiffness * of("memory", name) ** 2 / 2
            case vi.ExponentialIsolator():
                held += quad(law.elastic_force, 0.0, s, epsabs=1e-14, epsrel=1e-13)[0]
                held += (law.reversal_stiffness - law.final_stiffness) * of("memory", name) ** 2
            case vi.Law():
                held += quad(law.static_force, 0.0, s, epsabs=1e-14, epsrel=1e-13)[0]
            case _:
                held += law.stiffness * s**2 / 2
    for name, link in assembly.stops.items():
        depth, law = at(link.left) - at(link.right) - link.law.gap, link.law
        if isinstance(law, vi.Bumper):
            held += law.stiffness * of("deformation", name) ** 2 / 2
        elif isinstance(law, vi.ZenerBumper):
            face, k = of("deformation", name), law.relaxing_stiffness
            d = depth if of("touching", name) else face
            stretched = d - face * (law.stiffness + k) / k
            held += law.stiffness * d**2 / 2 + k * stretched**2 / 2
        elif of("touching", name) and isinstance(law, vi.Law):
            held += quad(law.read.value, 0.0, depth, (0.0,), epsabs=1e-14)[0]
        elif of("touching", name) and not isinstance(law, vi.RigidStop):
            power = getattr(law, "exponent", 1.5)
            held += law.stiffness * max(depth, 0.0) ** (power + 1) / (power + 1)
    return held
