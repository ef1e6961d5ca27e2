"""Fits: a global fit of five parameters, bootstrap refits, and one residual by a general solver."""

import time

import numpy as np
import xarray as xr
from scipy.integrate import solve_ivp

import vibroimpact as vi
from benchmarks import ours
from benchmarks.report import Table, met, targets
from vibroimpact.identification.curve_residuals import CurveTest
from vibroimpact.measurements.read import as_measured

_FIT = 10.0
_BOOTSTRAP = 120.0
_DRAWS = 1000
_FREE = "isolator.stiffness,isolator.damping,stops.stiffness,stops.damping,gap"
_CYCLES = 40
"""Cycles that the general solver is given to settle; the engine goes on until it has."""


def general(rig: vi.Oscillator, amplitude: float, frequencies: np.ndarray) -> float:
    """Seconds for one residual evaluation by scipy: both directions, event detection, rtol 1e-8."""
    begin = time.perf_counter()
    isolator, bumper = ours.linear(rig)
    k, c, m = isolator.stiffness, isolator.damping, rig.mass

    def force(u: float, v: float, right: float, left: float) -> tuple[float, float, float]:
        """Force of both bumpers, and how fast they deform."""
        found, rates = 0.0, []
        for sign, seat in ((1.0, right), (-1.0, left)):
            reach = sign * u - bumper.gap
            push = bumper.stiffness * reach + bumper.damping * sign * v
            if reach >= seat and push > 0.0:
                found += sign * push
                rates.append(sign * v)
            else:
                rates.append(-seat * bumper.stiffness / bumper.damping)
        return found, rates[0], rates[1]

    for order in (frequencies, frequencies[::-1]):
        state = np.zeros(4)
        for f in order:
            omega = 2.0 * np.pi * f

            def rate(t: float, y: np.ndarray, omega: float = omega) -> list[float]:
                pushed, right, left = force(*y)
                drive = amplitude * np.sin(omega * t)
                return [y[1], -(c * y[1] + k * y[0] + pushed) / m - drive, right, left]

            found = solve_ivp(rate, (0.0, _CYCLES / f), state, rtol=1e-6, atol=1e-9,
                              max_step=0.02 / f)  # fmt: skip
            state = found.y[:, -1]
    return time.perf_counter() - begin


def identification() -> Table:
    """Measure a fit of forward and backward curves of 46 points with 2 % of noise."""
    case = vi.laboratory.case("B2-G1-A3", "identified")
    grid = np.round(np.arange(0.5, 5.01, 0.1), 10)
    swept = vi.sweep(case, grid)
    noise = np.random.default_rng(0).normal(1.0, 0.02, size=(2, 2, len(grid)))
    names = ("displacement_excursion", "acceleration_excursion")
    noisy = {n: swept[n] * e for n, e in zip(names, noise, strict=True)}
    data = as_measured(xr.Dataset(noisy).assign_attrs(amplitude=case.amplitude))
    rig = case.oscillator
    isolator, right = ours.linear(rig)
    bumper = vi.Bumper(1.5 * right.stiffness, 0.5 * right.damping, 1.2 * right.gap)
    isolator = vi.Isolator(1.5 * isolator.stiffness, 0.5 * isolator.damping)
    start = vi.Oscillator(rig.mass, isolator, bumper, bumper)

    table = targets("Fits of two curves of 46 points")
    begin = time.perf_counter()
    fit = vi.identify(start, data, _FREE, profiles=False, threads=2)
    seconds = time.perf_counter() - begin
    table.add("global fit of 5 parameters, 2 threads, s", f"{seconds:.1f}", f"under {_FIT:g} s",
              met(seconds < _FIT))  # fmt: skip
    begin = time.perf_counter()
    vi.identify(
        vi.fitted_rig(fit), data, _FREE, profiles=False, tried=0, starts=1, draws=_DRAWS, threads=2
    )
    seconds = time.perf_counter() - begin
    table.add(f"{_DRAWS:,} bootstrap refits, 2 threads, s", f"{seconds:.1f}",
              f"under {_BOOTSTRAP:g} s", met(seconds < _BOOTSTRAP))  # fmt: skip
    setting = vi.Rig(rig, vi.Harmonic(case.amplitude, 1.0))
    test = CurveTest("one", data, setting, None)
    scales = {"displacement_scale": 1.0, "acceleration_scale": 1.0,
              "displacement_offset": 0.0, "acceleration_offset": 0.0}  # fmt: skip
    begin = time.perf_counter()
    rounds = 20
    for _ in range(rounds):
        test.residuals(setting, scales, np.empty(0))
    own = (time.perf_counter() - begin) / rounds
    table.add("one evaluation of the residuals, ms", f"{1e3 * own:.1f}", "", "")
    others = general(rig, case.amplitude, grid)
    table.add(f"the same by solve_ivp, {_CYCLES} cycles a frequency, s", f"{others:.1f}", "", "")
    table.add("ratio", f"{others / own:,.0f}", "", "")
    table.notes.append(
        f"{fit.attrs['starts_alike']} of {fit.attrs['starts']} starts led to the same fit, with "
        f"{fit.attrs['evaluations']} evaluations. solve_ivp (RK45, rtol 1e-6, at least 50 steps "
        "per cycle) does not locate events, so it smears each contact, and its 40 cycles do not "
        "settle everywhere."
    )
    return table
