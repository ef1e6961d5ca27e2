"""Computations that figures and claims share, each made once, when first asked for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, TypeVar

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.model import Harmonic, laboratory
from vibroimpact.response.resonance import Features, features
from vibroimpact.response.sweep import sweeps
from vibroimpact.scenario.classify import Classification, classify
from vibroimpact.stability.coexisting import arrivals, coexisting
from vibroimpact.stability.steady import steady

_T = TypeVar("_T")

STEP = 0.01
"""Step of all sweeps in Hz, a tenth of the tests'."""
LOW, HIGH = 0.5, 5.0
"""Range of the tests in Hz."""

GAPS = ("0mm", "2mm", "5mm", "10mm", "G1", "G2", "G3", "G4", "40mm", "50mm", "60mm", "80mm", "Ginf")
"""Total gaps of the numerical Fig. 19 (B3-A3), those of the tests among them."""
STIFFNESSES = ("10kN/m", "20kN/m", "40kN/m", "B1", "200kN/m", "B2", "B3", "B4", "10000kN/m")
"""Bumper stiffnesses of the numerical Fig. 20 (G3-A1), those of the tests among them."""


def grid(low: float = LOW, high: float = HIGH) -> NDArray[np.float64]:
    """Frequencies by `STEP`, in Hz."""
    first, last = round(low / STEP), round(high / STEP)
    return np.array([round(k * STEP, 10) for k in range(first, last + 1)])


class Study:
    """The published rig, computed as far as it is asked for.

    Parameters
    ----------
    threads
        How many sweeps run at once; None for one a processor.
    """

    def __init__(self, threads: int | None = None) -> None:
        self._threads = threads
        self._made: dict[Any, Any] = {}

    def _once(self, key: Any, make: Callable[[], _T]) -> _T:
        if key not in self._made:
            self._made[key] = make()
        found: _T = self._made[key]
        return found

    def campaign(self) -> xr.Dataset:
        """Resonance curves of the 48 tests, 0.5 to 5 Hz; dim ``rig`` of case codes."""
        return self._once(
            "campaign",
            lambda: sweeps(laboratory.campaign(), grid(), threads=self._threads),
        )

    def family(self, codes: tuple[str, ...], low: float = LOW, high: float = HIGH) -> xr.Dataset:
        """Resonance curves of some cases on one grid; dim ``rig`` of case codes."""
        return self._once(
            ("family", codes, low, high),
            lambda: sweeps(
                [laboratory.case(code) for code in codes], grid(low, high), threads=self._threads
            ),
        )

    def by_gap(self) -> xr.Dataset:
        """B3-A3 with the total gaps `GAPS`, 0.3 to 8 Hz (the paper's Fig. 19)."""
        return self.family(tuple(f"B3-{gap}-A3" for gap in GAPS), 0.3, 8.0)

    def by_stiffness(self) -> xr.Dataset:
        """G3-A1 with the bumper stiffnesses `STIFFNESSES`, 0.5 to 5 Hz (the paper's Fig. 20)."""
        return self.family((*(f"{stiffness}-G3-A1" for stiffness in STIFFNESSES), "B1-Ginf-A1"))

    def curves(
        self,
        code: str,
        parameters: laboratory.Parameters = "table",
        low: float = LOW,
        high: float = HIGH,
    ) -> xr.Dataset:
        """Resonance curves of one case."""
        case = laboratory.case(code, parameters)
        return self._once(
            ("curves", code, parameters, low, high),
            lambda: sweeps([case], grid(low, high), threads=self._threads).isel(rig=0),
        )

    def features(self, code: str) -> Features:
        """Peaks, jumps and hysteresis of one of the 48 tests."""
        return self._once(
            ("features", code), lambda: features(self.campaign().sel(rig=code, drop=True))
        )

    def motion(
        self,
        code: str,
        frequency: float,
        direction: Literal["forward", "backward"],
        parameters: laboratory.Parameters = "table",
    ) -> xr.Dataset:
        """The steady motion at which a sweep in that direction arrives (`vibroimpact.steady`)."""
        case = laboratory.case(code, parameters)
        excitation = Harmonic(case.amplitude, frequency)

        def make() -> xr.Dataset:
            start = arrivals(case.oscillator, excitation)[f"{direction} branch"]
            return steady(case.oscillator, excitation, start)

        return self._once(("motion", code, frequency, direction, parameters), make)

    def motions(self, code: str, frequency: float) -> list[xr.Dataset]:
        """All steady motions found at a frequency (`vibroimpact.coexisting`)."""
        case = laboratory.case(code)
        return self._once(
            ("motions", code, frequency),
            lambda: coexisting(case.oscillator, Harmonic(case.amplitude, frequency)),
        )

    def classification(self, code: str, low: float = LOW, high: float = HIGH) -> Classification:
        """The scenario of a case over the range of the tests, with its evidence."""
        case = laboratory.case(code)
        return self._once(
            ("classification", code, low, high),
            lambda: classify(
                case.oscillator, case.amplitude, grid(low, high), threads=self._threads
            ),
        )
