"""Computations that figures and claims share. Each runs only once, when it is first needed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, TypeVar

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.model import (
    Harmonic,
    Oscillator,
    State,
    from_dimensionless,
    laboratory,
    to_dimensionless,
)
from vibroimpact.model.rig import Rig
from vibroimpact.response.engine_input import as_state
from vibroimpact.response.resonance import Features, features
from vibroimpact.response.simulate import compute_history
from vibroimpact.response.sweep import sweeps
from vibroimpact.response.sweep_starts import arrivals
from vibroimpact.scenarios.classify import Classification, classify
from vibroimpact.scenarios.map import scenario_map
from vibroimpact.stability.branch import branch
from vibroimpact.stability.coexisting import find_motions
from vibroimpact.stability.orbit import orbit
from vibroimpact.stability.steady import steady

_T = TypeVar("_T")

STEP = 0.01
"""Step of all sweeps in Hz, which is a tenth of the step in the tests."""
LOW, HIGH = 0.5, 5.0
"""Frequency range of the tests in Hz."""

GAPS = (
    "0mm",
    "2mm",
    "5mm",
    "10mm",
    "G1",
    "G2",
    "G3",
    "G4",
    "40mm",
    "50mm",
    "60mm",
    "65mm",
    "80mm",
    "Ginf",
)
"""Total gaps of the numerical Fig. 19 (B3-A3), including the gaps of the tests."""
STIFFNESSES = ("10kN/m", "20kN/m", "40kN/m", "B1", "200kN/m", "B2", "B3", "B4", "10000kN/m")
"""Bumper stiffnesses of the numerical Fig. 20 (G3-A1), including the bumpers of the tests."""

MAP_NODES, MAP_STEP = (15, 15), 0.02
"""Number of nodes and step for the map of Fig. 21. They are coarse, so that the whole study takes
less than a minute."""


def grid(low: float = LOW, high: float = HIGH) -> NDArray[np.float64]:
    """Return frequencies in Hz with the step `STEP`."""
    first, last = round(low / STEP), round(high / STEP)
    return np.array([round(k * STEP, 10) for k in range(first, last + 1)])


class PublishedStudy:
    """Results for the published rig, which are computed when they are required.

    Parameters
    ----------
    threads
        Number of threads (default: one per processor).
    parameters
        Parameter set of the cases, unless a method is called with another set.
    """

    def __init__(
        self, threads: int | None = None, parameters: laboratory.Parameters = "table"
    ) -> None:
        self._threads = threads
        self._parameters = parameters
        self._made: dict[Any, Any] = {}

    def _case(self, code: str, parameters: laboratory.Parameters | None = None) -> laboratory.Case:
        return laboratory.case(code, parameters or self._parameters)

    def refined(self) -> PublishedStudy:
        """Return the same study for the rig with the refined isolator."""
        return self._once("refined", lambda: PublishedStudy(self._threads, "refined"))

    def _once(self, key: Any, make: Callable[[], _T]) -> _T:
        if key not in self._made:
            self._made[key] = make()
        value: _T = self._made[key]
        return value

    def campaign(self) -> xr.Dataset:
        """Return the curves of the 48 tests, 0.5 to 5 Hz. The dim ``rig`` has the case codes."""
        return self._once(
            "campaign",
            lambda: sweeps(laboratory.campaign(self._parameters), grid(), threads=self._threads),
        )

    def family(self, codes: tuple[str, ...], low: float = LOW, high: float = HIGH) -> xr.Dataset:
        """Return the resonance curves of some cases. The dim ``rig`` has the case codes."""
        return self._once(
            ("family", codes, low, high),
            lambda: sweeps(
                [self._case(code) for code in codes], grid(low, high), threads=self._threads
            ),
        )

    def by_gap(self) -> xr.Dataset:
        """Return the curves of B3-A3 with the gaps `GAPS`, 0.3 to 8 Hz (the paper's Fig. 19)."""
        return self.family(tuple(f"B3-{gap}-A3" for gap in GAPS), 0.3, 8.0)

    def by_stiffness(self) -> xr.Dataset:
        """Return the curves of G3-A1 for `STIFFNESSES`, 0.5 to 5 Hz (the paper's Fig. 20)."""
        return self.family((*(f"{stiffness}-G3-A1" for stiffness in STIFFNESSES), "B1-Ginf-A1"))

    def curves(
        self,
        code: str,
        parameters: laboratory.Parameters | None = None,
        low: float = LOW,
        high: float = HIGH,
    ) -> xr.Dataset:
        """Return the resonance curves of one case."""
        case = self._case(code, parameters)
        return self._once(
            ("curves", code, parameters, low, high),
            lambda: sweeps([case], grid(low, high), threads=self._threads).isel(rig=0),
        )

    def tested(self, code: str, parameters: laboratory.Parameters | None = None) -> xr.Dataset:
        """Return the resonance curves of one case at the frequencies of its test, 0.1 Hz apart."""
        case = self._case(code, parameters)
        return self._once(
            ("tested", code, parameters),
            lambda: sweeps([case], case.frequencies, threads=self._threads).isel(rig=0),
        )

    def features(self, code: str) -> Features:
        """Return the peaks, jumps and hysteresis of one of the 48 tests."""
        return self._once(
            ("features", code), lambda: features(self.campaign().sel(rig=code, drop=True))
        )

    def motion(
        self,
        code: str,
        frequency: float,
        direction: Literal["forward", "backward"],
        parameters: laboratory.Parameters | None = None,
        samples: int = 256,
    ) -> xr.Dataset:
        """Return the steady motion that a sweep in a direction reaches (`vibroimpact.steady`)."""
        case = self._case(code, parameters)
        excitation = Harmonic(case.amplitude, frequency)

        def make() -> xr.Dataset:
            start = arrivals(Rig(case.oscillator, excitation))[f"{direction} branch"]
            return steady(Rig(case.oscillator, excitation), start, samples)

        return self._once(("motion", code, frequency, direction, parameters, samples), make)

    def motions(self, code: str, frequency: float) -> list[xr.Dataset]:
        """Return all steady motions that `find_motions` finds at a frequency."""
        case = self._case(code)
        return self._once(
            ("motions", code, frequency),
            lambda: find_motions(Rig(case.oscillator, Harmonic(case.amplitude, frequency))),
        )

    def classification(
        self,
        code: str,
        low: float = LOW,
        high: float = HIGH,
        parameters: laboratory.Parameters | None = None,
    ) -> Classification:
        """Return the scenario of a case over the range of the tests, with its evidence."""
        case = self._case(code, parameters)
        return self._once(
            ("classification", code, low, high, parameters),
            lambda: classify(
                Rig(case.oscillator, case.amplitude), grid(low, high), threads=self._threads
            ),
        )

    def regular_places(
        self, code: str, parameters: laboratory.Parameters | None = None
    ) -> tuple[float, float, float]:
        """Return three frequencies of an S3 rig in Hz (the paper's Figs. 7, 8, 11 and 12).

        They are the secondary resonance, the valley after it, and the last frequency before the
        forward sweep jumps down. All are determined from η_a of the forward sweep.
        """
        data = self.curves(code, parameters)
        curve_features = features(data)
        mine = [p for p in curve_features.peaks if (p.direction, p.curve) == ("forward", "eta_a")]
        secondary = max((p for p in mine if not p.primary), key=lambda peak: peak.value)
        primary = next(p for p in mine if p.primary)
        between = (
            data["eta_a"]
            .sel(direction="forward")
            .sel(frequency=slice(secondary.frequency, primary.frequency))
        )
        valley = float(between["frequency"][int(between.values.argmin())])
        down = [
            j
            for j in curve_features.jumps
            if j.direction == "forward" and not j.upward and j.settled
        ]
        return secondary.frequency, valley, down[-1].before

    def other_places(self, code: str, low: float = LOW) -> tuple[float, float]:
        """Return two frequencies of an S4 rig in Hz (the paper's Figs. 15 and 16).

        They are the middle of the widest left hysteresis, and the middle of the widest range in
        which the forward sweep reaches no periodic motion.
        """
        data = self.curves(code, low=low)
        curve_features = features(data)
        left = max(
            (h for h in curve_features.hysteresis if h.side == "left"),
            key=lambda one: one.high - one.low,
        )
        wild = max(
            (r for r in curve_features.unsettled if r.direction == "forward"),
            key=lambda one: one.holds,
        )

        def middle(first: float, last: float) -> float:
            held = data["frequency"].values
            held = held[(held >= first) & (held <= last)]
            return float(held[len(held) // 2])

        return middle(left.low, left.high), middle(wild.low, wild.high)

    def mirror_image(
        self, code: str, frequency: float, direction: Literal["forward", "backward"]
    ) -> xr.Dataset:
        """Return the steady motion that starts from the mirror image of the end of `motion`."""
        case = self._case(code)
        excitation = Harmonic(case.amplitude, frequency)

        def make() -> xr.Dataset:
            motion = self.motion(code, frequency, direction)
            # Half a cycle turns the forcing round, and with it the mirror image's phase.
            end = as_state(compute_history(Rig(case.oscillator, excitation), 0.5, motion, 0))
            image = State(
                -end.displacement,
                -end.velocity,
                {"right": end.deformation.get("left"), "left": end.deformation.get("right")},
                contact=-(end.contact or 0),
            )
            return steady(Rig(case.oscillator, excitation), image)

        return self._once(("mirror image", code, frequency, direction), make)

    def antisymmetric_branch(self, code: str, low: float, high: float) -> xr.Dataset:
        """Return the branch of the motion that is reached from rest at `high`, stable or not."""
        case = self._case(code)
        return self._once(
            ("antisymmetric branch", code, low, high),
            lambda: branch(
                Rig(case.oscillator, Harmonic(case.amplitude, high)),
                vary={"frequency": (low, high)},
            ),
        )

    def antisymmetric_orbit(
        self, code: str, frequency: float, low: float, high: float
    ) -> xr.Dataset:
        """Return the orbit of `antisymmetric_branch` at one frequency between its ends."""
        case = self._case(code)

        def make() -> xr.Dataset:
            along = self.antisymmetric_branch(code, low, high)
            nearest = int(np.abs(along["frequency"].values - frequency).argmin())
            guess = along["section"].isel(point=nearest)
            return orbit(Rig(case.oscillator, Harmonic(case.amplitude, frequency)), guess)

        return self._once(("antisymmetric orbit", code, frequency, low, high), make)

    def scenarios(self) -> dict[str, str]:
        """Return the scenario of each of the 48 tests, over the range of the tests."""
        return {
            case.code: self.classification(case.code).scenario for case in laboratory.campaign()
        }

    def scenario_at(self, stiffness_ratio: float, gap: float) -> str:
        """Return the scenario at λ and δ of one side, for ξ = 0.15 and τ = 0.01 (as in Fig. 21)."""
        rig = from_dimensionless(
            stiffness_ratio, gap, laboratory.RELAXATION_TIME, laboratory.DAMPING_RATIO
        )
        return self._once(
            ("scenario at", stiffness_ratio, gap),
            lambda: classify(rig, threads=self._threads).scenario,
        )

    def twins(self, code: str) -> tuple[xr.Dataset, xr.Dataset]:
        """Return the curves of a case, and of a physically different rig with the same ratios.

        Both are computed at the same multiples of their natural frequency.
        """
        case = self._case(code)
        group = to_dimensionless(Rig(case.oscillator, case.amplitude))
        other = group.to_physical(mass=3.0, stiffness=700.0, amplitude=2.0)
        ratios = np.arange(40, 401, 2) / 100.0

        def curves(rig: Oscillator, amplitude: float) -> xr.Dataset:
            held = ratios * rig.natural_frequency
            return sweeps([Rig(rig, amplitude)], held, threads=self._threads).isel(rig=0)

        return self._once(
            ("twins", code),
            lambda: (
                curves(case.oscillator, case.amplitude),
                curves(other.oscillator, other.amplitude),
            ),
        )

    def map(self) -> xr.Dataset:
        """Return the scenarios over λ and δ0 for ξ = 0.15 and τ = 0.01 (the paper's Fig. 21)."""
        return self._once(
            "map",
            lambda: scenario_map(
                None,
                {
                    "stiffness_ratio": np.geomspace(0.5, 100.0, MAP_NODES[0]),
                    "gap_ratio": np.linspace(0.0, 1.0, MAP_NODES[1]),
                },
                step=MAP_STEP,
                refine=1,
                threads=self._threads,
            ),
        )
