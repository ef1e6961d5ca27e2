"""Measured time histories as residuals: exact motions, window by window.

Each window of the record is simulated from an initial state of its own, which is found with the
parameters: where a motion is chaotic, or long, one initial state does not determine the end.
The end of a window and the beginning of the next agree as well as the measurement shows.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from vibroimpact.errors import InputError
from vibroimpact.identification.branch_response import SteppedRig
from vibroimpact.identification.exact_motion import Joined, SampledMotion, under_record, under_sine
from vibroimpact.identification.free_parameters import SENSORS
from vibroimpact.identification.overlay import TestPoints
from vibroimpact.identification.sensor_channel import (
    corrected,
    doubt,
    kinematics,
    noise_of_channel,
    sensed,
)
from vibroimpact.model import Harmonic, Periodic, Record, State
from vibroimpact.model.rig import Rig
from vibroimpact.response.sine_fit import forcing_sine

Array = NDArray[np.float64]

_CHANNELS = ("displacement", "velocity", "acceleration")
_QUIET = 1e-3
"""Noise of a channel is taken as no smaller, as a share of its standard deviation."""
_PURE = 0.15
"""A base that a sine explains but for this share of it is shaken by that sine."""
_CYCLES = 5
"""Of the forcing, or of the rig by itself, in a window."""
_ROUGH = 1e4
"""Residual of a motion that was given up."""
_PHASES = 24
_JUMPING = ("velocity", "acceleration")
"""What jumps at a rigid stop, and where the force of a dashpot begins."""


class _Window(NamedTuple):
    """A stretch of the record that is simulated by itself."""

    begin: int
    end: int
    """Samples, the end not included."""
    state: tuple[float, float]
    """Displacement and velocity as they were measured at its beginning."""


class HistoryTest:
    """A time history, and how a rig's motion compares.

    Parameters
    ----------
    rig
        The rig and its shaking; of the shaking the amplitude alone, where the base was not
        measured.
    noise
        Standard deviation of a channel as a share of its own; None to estimate it.
    window
        Cycles that are followed at a stretch; None for `_CYCLES`.
    steady
        Whether the record is that of a steady motion, which is then found without initial states.
    """

    kind = "history"

    def __init__(
        self,
        name: str,
        data: xr.Dataset,
        rig: Rig,
        noise: float | None,
        window: int | None,
        steady: bool,
    ) -> None:
        self.name, self.data, self.steady = name, data, steady
        self.time = data["time"].values - float(data["time"][0])
        self.names = [c for c in _CHANNELS if c in data and np.isfinite(data[c]).sum() >= 8]
        if not self.names:
            raise InputError(
                f"data: {name!r} has neither displacement nor velocity nor acceleration of the "
                "mass at 8 times or more; pass a time history with at least one of them"
            )
        self.measured = {c: data[c].values for c in self.names}
        spread = {c: float(np.nanstd(v)) or 1.0 for c, v in self.measured.items()}
        own = {c: noise_of_channel(self.measured[c]) if noise is None else noise * spread[c]
               for c in self.names}  # fmt: skip
        self.size = {c: max(own[c], _QUIET * spread[c]) for c in self.names}
        self.noise, self.weights = 1.0, dict.fromkeys(self.names, 1.0)
        self.doubt = {
            c: doubt(v, self.size[c]) if c in _JUMPING else np.ones(len(v))
            for c, v in self.measured.items()
        }
        self._spread = spread
        self.rig, self.shaking = self._shaken(rig)
        self.share, self.window, self._phase = noise, window, 0.0
        self.calibrate({name: right for name, (_, right) in SENSORS.items()})

    def reversed(self, names: Iterable[str]) -> HistoryTest:
        """The same test with some channels turned round."""
        turned = self.data.assign({name: -self.data[name] for name in names})
        test = HistoryTest(self.name, turned, self.rig, self.share, self.window, self.steady)
        test.weights = self.weights
        test.calibrate(self._sensors)
        return test

    @property
    def free_phase(self) -> bool:
        """Whether the base's phase has to be found."""
        return "base_acceleration" not in self.data

    def _shaken(self, rig: Rig) -> tuple[Rig, Harmonic | Record]:
        """The sine of the base, or its record; or a sine of the mass's own frequency."""
        shaken = rig.periodic
        if isinstance(shaken, Periodic):
            raise InputError(
                "amplitude: several harmonics are not accepted; pass a rig with one sine, or an "
                "Oscillator alone if the base acceleration was measured"
            )
        base = self.data["base_acceleration"].values if not self.free_phase else None
        moved = self.measured[self.names[0]]
        sine = forcing_sine(self.time, base, moved, self.data.attrs.get("frequency"))
        if sine is None:
            raise InputError(
                f"data: the mass does not move in {self.name!r}; pass a time history in which it "
                "moves"
            )
        if base is None:
            harmonic = shaken.replace(frequency=sine.frequency)
            return Rig(rig.oscillator, harmonic), harmonic
        still = np.nanmax(np.abs(base)) == 0.0
        if sine.rest < _PURE and not still:
            harmonic = Harmonic(sine.amplitude, sine.frequency, sine.phase % (2.0 * math.pi))
            return Rig(rig.oscillator, harmonic), harmonic
        step = float(np.median(np.diff(self.time)))
        even = np.arange(round(float(self.time[-1]) / step) + 1) * step
        known = np.isfinite(base)
        record = Record(np.interp(even, self.time[known], base[known]), step)
        return Rig(rig.oscillator, Harmonic(max(record.peak, 1e-12), sine.frequency)), record

    def _windows(self) -> list[_Window]:
        """Cut the record where the mass is far from the stops, and read the states there."""
        u, v = self._kinematics()
        frequency = self.rig.periodic.frequency
        if isinstance(self.shaking, Record):
            frequency = self.rig.oscillator.angular_frequency / (2.0 * math.pi) or frequency
        length = (_CYCLES if self.window is None else self.window) / frequency
        count = 1 if self.steady else max(1, round(float(self.time[-1]) / length))
        step = float(np.median(np.diff(self.time)))
        reach = max(1, int(0.5 / frequency / step))
        begins = [0]
        for k in range(1, count):
            middle = int(np.searchsorted(self.time, k * self.time[-1] / count))
            low, high = max(begins[-1] + 2, middle - reach), min(len(u) - 2, middle + reach)
            if low < high:
                begins.append(low + int(np.argmin(np.abs(u[low:high]))))
        ends = [*begins[1:], len(self.time)]
        return [
            _Window(begin, end, (float(u[begin]), float(v[begin])))
            for begin, end in zip(begins, ends, strict=True)
        ]

    def _kinematics(self) -> tuple[Array, Array]:
        """Displacement and velocity at all times, measured or derived."""
        known = {
            c: corrected(c, np.interp(self.time, self.time[np.isfinite(v)], v[np.isfinite(v)]),
                         self._sensors)
            for c, v in self.measured.items()
        }  # fmt: skip
        base = None if self.free_phase else self.data["base_acceleration"].values
        return kinematics(self.time, known, base)

    def calibrate(self, sensors: dict[str, float]) -> None:
        """Read the initial states again, by what the sensors are taken to show at first."""
        self._sensors = sensors
        self.windows = self._windows()
        if self.free_phase:
            self._phase = self._best_phase()

    def _best_phase(self) -> float:
        """The phase of the base at which the rig fits best."""
        shares = np.linspace(0.0, 2.0 * math.pi, _PHASES, endpoint=False)
        states = self.unknowns[0][1:]
        costs = []
        for phase in shares:
            residuals, _ = self.residuals(
                self.rig, self._sensors, np.concatenate([[phase], states])
            )
            costs.append(np.sum(np.abs(residuals[: self.points_count])))
        return float(shares[int(np.argmin(costs))])

    @property
    def shares(self) -> Array:
        """A residual as a share of its channel."""
        parts = [
            self.doubt[c][np.isfinite(v)] * self.size[c] * self.weights[c] / self._spread[c]
            for c, v in self.measured.items()
        ]
        return np.concatenate(parts)

    @property
    def channels(self) -> list[str]:
        """What each of its measured values is."""
        return [c for c, v in self.measured.items() for _ in range(np.isfinite(v).sum())]

    @property
    def swing(self) -> float:
        """How far the mass was seen to move (m)."""
        return float(np.ptp(self._kinematics()[0])) / 2.0

    blind = False

    def reach(self, rig: Rig, unknowns: Array) -> tuple[float, float]:
        """How far the mass goes to the right and to the left (m)."""
        motion = self.moved(rig, unknowns)
        return (math.inf, math.inf) if motion is None else motion.reach

    @property
    def points_count(self) -> int:
        """Number of measured values."""
        return sum(int(np.isfinite(v).sum()) for v in self.measured.values())

    @property
    def count(self) -> int:
        """Those, and what joins the windows."""
        return self.points_count + 2 * (len(self.windows) - 1)

    @property
    def unknowns(self) -> tuple[Array, Array]:
        """The base's phase if it was not measured, and each window's initial state."""
        phase = [self._phase] if self.free_phase else []
        if self.steady:
            return np.array(phase), np.ones(len(phase))
        u, v = self._kinematics()
        sizes = [float(np.std(u)) or 1.0, float(np.std(v)) or 1.0]
        states = [value for window in self.windows for value in window.state]
        return np.array(phase + states), np.array([1.0] * len(phase) + sizes * len(self.windows))

    @property
    def groups(self) -> list[list[tuple[int, NDArray[np.bool_]]]]:
        """Unknowns that can be varied at once, each with the residuals that depend on it."""
        begin = 1 if self.free_phase else 0
        groups = [[(0, np.ones(self.count, dtype=bool))]] if begin else []
        if self.steady:
            return groups
        for component in range(2):
            for parity in range(2):
                group = [
                    (begin + 2 * k + component, self._rows(k))
                    for k in range(parity, len(self.windows), 2)
                ]
                if group:
                    groups.append(group)
        return groups

    def _rows(self, k: int) -> NDArray[np.bool_]:
        """The residuals that depend on a window's initial state."""
        rows = np.zeros(self.count, dtype=bool)
        begin = 0
        window = self.windows[k]
        for values in self.measured.values():
            known = np.isfinite(values)
            inside = np.zeros(len(values), dtype=bool)
            inside[window.begin : window.end] = True
            rows[begin : begin + known.sum()] = inside[known]
            begin += int(known.sum())
        for joint in (k - 1, k):
            if 0 <= joint < len(self.windows) - 1:
                rows[begin + 2 * joint : begin + 2 * joint + 2] = True
        return rows

    def moved(self, rig: Rig, unknowns: Array) -> Joined | None:
        """The rig's motion at all times; None if it was given up."""
        phase = float(unknowns[0]) if self.free_phase else None
        states = unknowns[1:] if self.free_phase else unknowns
        values = {c: np.empty(len(self.time)) for c in _CHANNELS}
        gaps, reach = [], (-math.inf, -math.inf)
        for k, window in enumerate(self.windows):
            last = k + 1 == len(self.windows)
            time = self.time[window.begin : window.end + (0 if last else 1)]
            if self.steady:
                motion = self._settled(rig, window.state, phase, time)
            else:
                state = State(*states[2 * k : 2 * k + 2].tolist())
                motion = self._from(rig, state, phase, time)
            if motion is None:
                return None
            reach = (max(reach[0], motion.reach[0]), max(reach[1], motion.reach[1]))
            for c in _CHANNELS:
                values[c][window.begin : window.end] = motion.values[c][: window.end - window.begin]
            if not last:
                gaps += [a - b for a, b in zip(motion.end, states[2 * k + 2 : 2 * k + 4],
                                               strict=True)]  # fmt: skip
        return Joined(values, np.array(gaps), reach)

    def _from(
        self, rig: Rig, state: State, phase: float | None, time: Array
    ) -> SampledMotion | None:
        begin = float(time[0])
        if isinstance(self.shaking, Record):
            step = self.shaking.step
            steps = max(1, math.ceil((float(time[-1]) - begin) / step - 1e-9))
            values = self.shaking.at(begin + step * np.arange(steps + 1))
            return under_record(Rig(rig.oscillator, Record(values, step)), state, time - begin)
        shaken = rig.sine
        at = shaken.phase if phase is None else phase
        turned = shaken.replace(phase=(at + shaken.angular_frequency * begin) % (2.0 * math.pi))
        return under_sine(Rig(rig.oscillator, turned), state, time)

    def _settled(
        self,
        rig: Rig,
        start: tuple[float, float],
        phase: float | None,
        time: Array,
    ) -> SampledMotion | None:
        """The steady motion that the measured state leads to."""
        shaken = rig.sine
        at = shaken.phase if phase is None else phase % (2.0 * math.pi)
        state = SteppedRig(rig).settled(State(*start), shaken.frequency, at)
        turned = Rig(rig.oscillator, shaken.replace(phase=at))
        return None if state is None else under_sine(turned, state, time)

    def model(
        self, rig: Rig, sensors: dict[str, float], unknowns: Array
    ) -> tuple[dict[str, Array], Array] | None:
        """What the sensors would show of the rig's motion; see `moved`."""
        try:
            motion = self.moved(rig, unknowns)
        except InputError:  # a state that cannot be, such as inside a rigid stop
            return None
        if motion is None:
            return None
        return {c: sensed(c, motion.values[c], sensors) for c in self.names}, motion.gaps

    def residuals(
        self, rig: Rig, sensors: dict[str, float], unknowns: Array
    ) -> tuple[Array, NDArray[np.bool_]]:
        """Of points over the noise of their channel; of the joints over that of the state."""
        model = self.model(rig, sensors, unknowns)
        if model is None:
            return np.full(self.count, _ROUGH), np.zeros(self.count, dtype=bool)
        values, gaps = model
        parts = []
        for c in self.names:
            known = np.isfinite(self.measured[c])
            off = (values[c] - self.measured[c]) / (self.size[c] * self.weights[c] * self.doubt[c])
            parts.append(off[known])
        if len(gaps):
            parts.append(gaps / np.resize(self._joint, len(gaps)))
        residuals = np.concatenate(parts)
        return residuals, np.ones(len(residuals), dtype=bool)

    @property
    def _joint(self) -> Array:
        """How well displacement and velocity of a joint have to agree."""
        omega = 2.0 * math.pi * self.rig.periodic.frequency
        if "displacement" in self.size:
            u = self.size["displacement"]
        elif "velocity" in self.size:
            u = self.size["velocity"] / omega
        else:
            u = self.size["acceleration"] / omega**2
        return np.array([u, omega * u])

    def test_points(self, rig: Rig, sensors: dict[str, float], unknowns: Array) -> TestPoints:
        """Each point beside what the rig has there."""
        model = self.model(rig, sensors, unknowns)
        values = {} if model is None else model[0]
        place, variable, measured, modelled, residual = [], [], [], [], []
        for c in self.names:
            known = np.isfinite(self.measured[c])
            here = values.get(c, np.full(len(self.time), np.nan))[known]
            place.append(self.data["time"].values[known])
            variable += [c] * int(known.sum())
            measured.append(self.measured[c][known])
            modelled.append(here)
            residual.append((here - measured[-1]) / (self.size[c] * self.doubt[c][known]))
        return TestPoints(
            np.concatenate(place),
            [""] * len(variable),
            variable,
            np.concatenate(measured),
            np.concatenate(modelled),
            np.concatenate(residual),
        )
