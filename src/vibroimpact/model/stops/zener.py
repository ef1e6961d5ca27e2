"""Zener bumper: a standard linear solid."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vibroimpact.law_numbers import MemoryStop
from vibroimpact.model.quantities import DAMPING, LENGTH, STIFFNESS
from vibroimpact.model.stops.law import StopWithMemory
from vibroimpact.model.validation import Accepts, takes_fields


class ZenerBumper(StopWithMemory):
    """A massless standard linear solid, the stop of an `Assembly`: it relaxes while pressed, too.

    A spring k stands beside a Maxwell element, a spring k₁ in series with a dashpot c. With the
    deformation δ of the stop and that of the dashpot, y, the force is F = k δ + k₁ (δ - y), and c
    y' = k₁ (δ - y) (C. Zener, Elasticity and Anelasticity of Metals, 1948). A fast contact feels k
    + k₁, and a slow one k. A contact ends when the force falls to zero. The face then stands at
    k₁ y/(k + k₁), which is ``deformation`` in states, and relaxes with the time constant
    c (k + k₁)/(k k₁).

    In a study file, its ``kind`` is ``"zener"``.

    Parameters
    ----------
    stiffness
        Stiffness k in N/m, greater than 0; or a string such as ``"510 kN/m"``.
    relaxing_stiffness
        Stiffness k₁ in N/m, greater than 0, of the spring in series with the dashpot; or a string.
    damping
        Damping coefficient c in N s/m, greater than 0; or a string such as ``"0.9 kN s/m"``.
    gap
        Distance of the bodies at rest from contact, in m; or a string such as ``"7.5 mm"``. A
        negative gap is a preload.

    Raises
    ------
    InputError
        If a value is not finite, has a wrong unit or lies outside its bounds.
    """

    kind: ClassVar[str] = "zener"

    stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    relaxing_stiffness: Annotated[float, Accepts(STIFFNESS, above=0.0)]
    damping: Annotated[float, Accepts(DAMPING, above=0.0)]
    gap: Annotated[float, Accepts(LENGTH)]

    @takes_fields
    def __init__(
        self,
        stiffness: float | str,
        relaxing_stiffness: float | str,
        damping: float | str,
        gap: float | str,
    ) -> None: ...

    @property
    def _share(self) -> float:
        """The memory over the deformation of the dashpot."""
        return self.relaxing_stiffness / (self.stiffness + self.relaxing_stiffness)

    def engine_numbers(self) -> MemoryStop:
        """Return the numbers by which the engine follows the law."""
        return MemoryStop(
            "zener", (self.stiffness, self.relaxing_stiffness, self.damping), self.gap
        )

    def static_force(self, deformation: float) -> float:
        """Return the force k δ (N) at a slow deformation (m)."""
        return self.stiffness * max(deformation, 0.0)

    def remembered(self, deformation: float) -> float:
        """Return the memory (m) of a deformation (m) that has lasted for long."""
        return self._share * deformation

    def stored_energy(self, deformation: float, memory: float | None = None) -> float:
        """Return the energy (J) of both springs."""
        dashpot = deformation if memory is None else memory / self._share
        stretched = deformation - dashpot
        return 0.5 * (self.stiffness * deformation**2 + self.relaxing_stiffness * stretched**2)

    def force(self, deformation: ArrayLike, velocity: ArrayLike) -> NDArray[np.float64]:
        """Return the force (N, at least 0) along a contact, which starts at the first sample.

        Between samples the velocity is their mean, which also gives the time. Without a velocity,
        the deformation is slow.
        """
        d, v = np.asarray(deformation, dtype=np.float64), np.asarray(velocity, dtype=np.float64)
        if not v.any():
            return self.stiffness * np.maximum(d, 0.0)
        rate, y, time = self.relaxing_stiffness / self.damping, 0.0, 0.0
        dashpot = np.zeros_like(d)
        for i in range(1, len(d)):
            mean, moved = 0.5 * (v[i] + v[i - 1]), d[i] - d[i - 1]
            time = moved / mean if mean * moved > 0.0 else time
            # y' = rate (δ - y), with δ linear in time.
            lag = moved / (rate * time) if time > 0.0 else 0.0
            y = d[i] - lag - (d[i - 1] - lag - y) * math.exp(-rate * time)
            dashpot[i] = y
        return np.maximum(self.stiffness * d + self.relaxing_stiffness * (d - dashpot), 0.0)
