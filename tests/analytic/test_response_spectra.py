"""Response spectra against closed forms, the general motion, and 40 digits."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pytest
from mpmath import mp, mpf

import vibroimpact as vi
from samples import sample

EXACT = 1e-12


def ramp_response(t: mpf, omega: mpf, zeta: mpf) -> tuple[mpf, mpf]:
    """Displacement and velocity at t under A_t = t from rest, from the textbook's closed form."""
    if t <= 0:
        return mpf(0), mpf(0)
    damped = omega * mp.sqrt(1 - zeta**2)
    fade, c, s = mp.exp(-zeta * omega * t), mp.cos(damped * t), mp.sin(damped * t)
    level, slope = 2 * zeta / omega**3, -1 / omega**2
    # u = level + slope t + fade (p c + q s), with u and its velocity 0 at 0
    p = -level
    q = (-slope + zeta * omega * p) / damped
    u = level + slope * t + fade * (p * c + q * s)
    v = slope + fade * ((damped * q - zeta * omega * p) * c - (damped * p + zeta * omega * q) * s)
    return u, v


class Straight(NamedTuple):
    """A record as a sum of ramps and steps, with 40 digits."""

    samples: list[float]
    step: float

    def motion(self, t: mpf, omega: mpf, zeta: mpf) -> tuple[mpf, mpf]:
        """Displacement and velocity: a step is the rate of a ramp."""
        h = mpf(self.step)
        slopes = [(mpf(b) - mpf(a)) / h for a, b in pairwise(self.samples)]
        u = v = mpf(0)
        for n, change in enumerate([slopes[0], *(b - a for a, b in pairwise(slopes)), -slopes[-1]]):
            du, dv = ramp_response(t - n * h, omega, zeta)
            u, v = u + change * du, v + change * dv
        ends = ((0, mpf(self.samples[0])), (len(self.samples) - 1, -mpf(self.samples[-1])))
        for n, size in ends:
            du, dv = ramp_response(t - n * h, omega, zeta)
            # The response to a step: u' of the ramp's, and u'' from the equation of motion.
            if t > n * h:
                u += size * dv
                v += size * (-2 * zeta * omega * dv - omega**2 * du - (t - n * h))
        return u, v

    def largest(self, period: float, ratio: float) -> tuple[float, float, float]:
        """The largest |u|, |u'| and |u'' + A_t|, each turning point found by bisection."""
        omega, zeta = 2 * mp.pi / mpf(period), mpf(ratio)
        end = (len(self.samples) - 1) * mpf(self.step)
        last = end + mpf(1.1) * mpf(period)
        knots = [n * mpf(self.step) for n in range(len(self.samples))]
        times = sorted({*knots, *(last * n / 160 for n in range(161))})

        def base(t: mpf) -> mpf:
            n = min(int(t / mpf(self.step)), len(self.samples) - 2)
            a, b = mpf(self.samples[n]), mpf(self.samples[n + 1])
            return a + (b - a) * (t / mpf(self.step) - n) if t < end else mpf(0)

        def slope(t: mpf) -> mpf:
            n = min(int(t / mpf(self.step)), len(self.samples) - 2)
            a, b = mpf(self.samples[n]), mpf(self.samples[n + 1])
            return (b - a) / mpf(self.step) if t < end else mpf(0)

        def rates(t: mpf) -> tuple[mpf, mpf, mpf]:
            u, v = self.motion(t, omega, zeta)
            bend = -2 * zeta * omega * v - omega**2 * u - base(t)
            return v, bend, -2 * zeta * omega * bend - omega**2 * v

        def sizes(t: mpf) -> tuple[mpf, mpf, mpf]:
            u, v = self.motion(t, omega, zeta)
            return abs(u), abs(v), abs(2 * zeta * omega * v + omega**2 * u)

        every = [sizes(t) for t in times]
        most = [max(one[what] for one in every) for what in range(3)]
        tiny = last * mpf(10) ** -25
        for n, (left, right) in enumerate(pairwise(times)):
            large = [max(every[n][k], every[n + 1][k]) > 0.6 * most[k] for k in range(3)]
            if not any(large):
                continue
            # Within a line, whose rates jump at its ends.
            before, after = rates(left + tiny), rates(right - tiny)
            for what in range(3):
                if large[what] and before[what] * after[what] < 0:
                    a, b = left + tiny, right - tiny
                    for _ in range(30):
                        middle = (a + b) / 2
                        if rates(middle)[what] * before[what] > 0:
                            a = middle
                        else:
                            b = middle
                    most[what] = max(most[what], sizes(a)[what])
        return float(most[0]), float(most[1]), float(most[2])


HALF_SINE = [math.sin(math.pi * n / 12) for n in range(13)]
ROUGH = np.random.default_rng(4).uniform(-3.0, 3.0, 14).tolist()
STRAIGHT = {
    "a half sine": (Straight(HALF_SINE, 0.05), sample([0.03, 0.21, 0.8, 1.2, 5.0], [0.21])),
    "rough": (Straight(ROUGH, 0.1), sample([0.07, 0.3, 1.0, 40.0], [1.0])),
    "one long line": (Straight([1.0, -2.0], 1.0), [0.045, 0.5]),
}


@pytest.mark.parametrize("name", STRAIGHT)
def test_ramps_and_steps_added_up_with_forty_digits(name: str) -> None:
    record, periods = STRAIGHT[name]
    dampings = sample([0.0, 0.05, 0.7], [0.05])
    spectrum = vi.response_spectrum(vi.Record(record.samples, record.step), periods, dampings)
    with mp.workdps(40):
        for i, ratio in enumerate(dampings):
            for j, period in enumerate(periods):
                u, v, a = record.largest(period, ratio)
                at = {"damping_ratio": i, "natural_period": j}
                one = spectrum.isel(at)
                assert float(one["spectral_displacement"]) == pytest.approx(u, rel=EXACT)
                assert float(one["spectral_velocity"]) == pytest.approx(v, rel=EXACT)
                assert float(one["spectral_acceleration"]) == pytest.approx(a, rel=EXACT)
                omega = math.tau / period
                assert float(one["pseudo_velocity"]) == pytest.approx(omega * u, rel=EXACT)
                assert float(one["pseudo_acceleration"]) == pytest.approx(omega**2 * u, rel=EXACT)


PERIODS = np.array([0.013, 0.05, 0.31, 1.0, 1.9, 7.0])


def test_a_step_that_lasts() -> None:
    """u = A/ω² (1 + exp(-π ζ / √(1 − ζ²))), and 2 A/ω² if nothing damps."""
    for ratio in (0.0, 0.02, 0.3, 0.95):
        spectrum = vi.response_spectrum(vi.Record([2.0] * 300, 0.1), PERIODS, ratio)
        over = 1.0 + math.exp(-math.pi * ratio / math.sqrt(1.0 - ratio**2))
        np.testing.assert_allclose(spectrum["pseudo_acceleration"], 2.0 * over, rtol=EXACT)


def test_a_step_that_ends_and_what_comes_behind_it() -> None:
    """Undamped: 2 A/ω² sin(π t/T) behind the end if it lasts less than half a period."""
    lasts = 0.4
    spectrum = vi.response_spectrum(vi.Record([1.5] * 5, lasts / 4), PERIODS, 0.0)
    grown = np.where(2.0 * lasts > PERIODS, 1.0, np.sin(math.pi * lasts / PERIODS))
    np.testing.assert_allclose(spectrum["spectral_acceleration"], 3.0 * grown, rtol=EXACT)


def test_a_ramp_to_a_level() -> None:
    """Undamped: 1 + |sin(π t/T)| / (π t/T) times the level."""
    rises = 0.37
    values = np.concatenate([np.linspace(0.0, 3.0, 4), np.full(400, 3.0)])
    spectrum = vi.response_spectrum(vi.Record(values, rises / 3), PERIODS, 0.0)
    ratio = math.pi * rises / PERIODS
    level = 3.0 * (1.0 + np.abs(np.sin(ratio)) / ratio)
    np.testing.assert_allclose(spectrum["pseudo_acceleration"], level, rtol=EXACT)


def test_a_half_sine_is_approached_with_the_square_of_the_step() -> None:
    """Undamped, pulse of duration d longer than half a period: the textbook's maximum under it."""
    lasts, period = 1.0, 0.7
    beta = period / (2.0 * lasts)
    # u ω²/A = (sin πt/d − β sin ωt)/(1 − β²), turning where ω t = 2 π n − π t/d.
    turning = max(
        (
            (math.sin(math.pi * t) - beta * math.sin(math.tau * t / period)) / (1.0 - beta**2)
            for n in range(1, 4)
            if (t := n / (0.5 + 1.0 / period) * 1.0) <= 1.0
        ),
        key=abs,
    )
    errors = []
    for count in (20, 40, 80, 160):
        record = vi.Record(np.sin(math.pi * np.arange(count + 1) / count), lasts / count)
        largest = float(vi.response_spectrum(record, period, 0.0)["pseudo_acceleration"])
        errors.append(largest / abs(turning) - 1.0)
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 2.0, atol=0.02)
    assert abs((4.0 * errors[3] - errors[2]) / 3.0) < 1e-7


def made(kind: str) -> vi.Record:
    rng = np.random.default_rng(8)
    values = rng.normal(size=1500) * np.sin(np.linspace(0.0, math.pi, 1500)) ** 2
    if kind == "smooth":
        values = np.convolve(values, np.hanning(25), "same")
    return vi.Record(values, 0.02)


@pytest.mark.parametrize("kind", ["noise", "smooth"])
@pytest.mark.parametrize("period", [0.02, 0.11, 0.9, 3.0, 15.0])
@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.4])
def test_as_a_rig_without_stops(kind: str, period: float, ratio: float) -> None:
    """The general motion, its extremes by `totals`, in numbers that share no code with these."""
    record, omega = made(kind), math.tau / period
    rig = vi.Oscillator(3.0, vi.Isolator(3.0 * omega**2, 6.0 * ratio * omega))
    spectrum = vi.response_spectrum(record, period, ratio)
    totals = vi.totals(vi.simulate(vi.Rig(rig, record), tail=1.5 * period))
    for name, of in (("displacement", "displacement"), ("acceleration", "acceleration")):
        peak = max(abs(float(totals[f"{of}_max"])), abs(float(totals[f"{of}_min"])))
        assert float(spectrum[f"spectral_{name}"]) == pytest.approx(peak, rel=EXACT)


def split(record: vi.Record, parts: int) -> vi.Record:
    """The same straight lines, cut into parts."""
    steps = np.arange((len(record.acceleration) - 1) * parts + 1) / parts
    values = np.interp(steps, np.arange(len(record.acceleration)), record.acceleration)
    return vi.Record(values, record.step / parts)


@pytest.mark.parametrize("parts", [2, 7, 400])
def test_nothing_depends_on_where_lines_are_cut(parts: int) -> None:
    """On lines of many cycles, too, of which only those at either end are searched."""
    record = vi.Record(np.random.default_rng(2).normal(size=12), 1.0)
    periods, dampings = [0.011, 0.04, 0.17, 0.9, 4.0], [0.0, 0.003, 0.05, 0.5]
    one = vi.response_spectrum(record, periods, dampings)
    other = vi.response_spectrum(split(record, parts), periods, dampings)
    for name in one.data_vars:
        np.testing.assert_allclose(one[name], other[name], rtol=1e-11)


CHANGES: dict[str, tuple[Callable[[vi.Record], vi.Record], float, float]] = {
    "mirrored": (lambda r: vi.Record(-r.acceleration, r.step), 1.0, 1.0),
    "larger": (lambda r: vi.Record(1e3 * r.acceleration, r.step), 1e3, 1.0),
    "slower": (lambda r: vi.Record(r.acceleration, 4.0 * r.step), 16.0, 4.0),
    "later": (
        lambda r: vi.Record(np.concatenate([[0.0] * 9, r.acceleration]), r.step),
        1.0,
        1.0,
    ),
}


@pytest.mark.parametrize("name", CHANGES)
def test_laws_of_scaling(name: str) -> None:
    change, size, time = CHANGES[name]
    record = made("noise").cut(0.0, "6 s")
    values = np.concatenate([[0.0], record.acceleration, [0.0]])
    record = vi.Record(values, record.step)
    one = vi.response_spectrum(record, PERIODS, [0.0, 0.05])
    other = vi.response_spectrum(change(record), time * PERIODS, [0.0, 0.05])
    np.testing.assert_allclose(
        other["spectral_displacement"], size * one["spectral_displacement"], rtol=1e-12
    )


def test_at_short_periods_it_tends_to_the_peak_of_the_ground() -> None:
    record = vi.Record(np.concatenate([[0.0], made("smooth").acceleration, [0.0]]), 0.02)
    periods = [0.0, 1e-9, 1e-7, 1e-5, 1e-3]
    spectrum = vi.response_spectrum(record, periods, [0.0, 0.05])
    for name in ("spectral_acceleration", "pseudo_acceleration"):
        ratio = spectrum[name].values / record.peak
        assert (ratio[:, 0] == 1.0).all()
        np.testing.assert_allclose(ratio[:, 1], 1.0, atol=1e-6)
        assert (np.diff(np.abs(ratio - 1.0)[:, 1:], axis=1) > -1e-9).all()
    for name in ("spectral_displacement", "spectral_velocity", "pseudo_velocity"):
        assert (spectrum[name].values[:, 0] == 0.0).all()


def test_at_long_periods_it_tends_to_the_displacement_of_the_ground() -> None:
    record = made("smooth").levelled()
    time = np.linspace(0.0, record.duration, 200_001)
    acceleration = record.at(time)
    dt = time[1]
    velocity = np.concatenate([[0.0], np.cumsum(0.5 * dt * (acceleration[1:] + acceleration[:-1]))])
    moved = np.concatenate([[0.0], np.cumsum(0.5 * dt * (velocity[1:] + velocity[:-1]))])
    spectrum = vi.response_spectrum(record, 1e6, 0.05)
    assert float(spectrum["spectral_velocity"]) == pytest.approx(np.abs(velocity).max(), rel=1e-3)
    behind = abs(velocity[-1]) * 1e6 / math.tau  # what is left drifts for a quarter of a period
    assert float(spectrum["spectral_displacement"]) <= np.abs(moved).max() + 1.1 * behind
