"""Curved isolators by scipy's DOP853, begun anew wherever a sign in the law changes."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

import vibroimpact as vi
from vibroimpact.law_numbers import IsolatorNumbers


def integrated(
    k: float, c: float, law: IsolatorNumbers, shaken: vi.Harmonic, cycles: float
) -> np.ndarray:
    """u, u̇ and z behind so many cycles from rest, of a mass of 1 kg without stops or friction."""
    amplitude, omega, phase = shaken.amplitude, shaken.angular_frequency, shaken.phase
    n, limit = int(law.sharpness), law.limit

    def rates(t, y, way, side):
        u, v, z = y
        force = k * u + law.cubic * u**3 + law.quintic * u**5 + law.hysteretic * z
        force += c * v if law.drag == 1.0 else way * c * abs(v) ** law.drag
        force += 2.0 * law.sinh * np.sinh(law.sinh_rate * u)
        if not law.hysteretic:
            flows = 0.0
        elif np.isfinite(limit):
            flows = 0.0 if abs(z) >= limit and way * z > 0.0 else v
        elif n % 2:
            flows = v * (law.slope - (law.knee * side + law.turning * way) * z**n)
        else:
            flows = v * (law.slope - (law.knee + law.turning * way * side) * z**n)
        return [v, -force - amplitude * np.sin(omega * t + phase), flows]

    def event(function, direction):
        function.terminal, function.direction = True, direction
        return function

    end = cycles * shaken.period
    t, y = 0.0, np.zeros(3)
    way = side = float(np.sign(-amplitude * np.sin(phase)))
    while t < end:
        events = [event(lambda t, y: y[1], -way)]
        yields = np.isfinite(limit)
        if yields and (abs(y[2]) < limit or way * y[2] < 0.0):
            events.append(event(lambda t, y: abs(y[2]) - limit, 1.0))
        elif not yields and law.hysteretic:
            events.append(event(lambda t, y: y[2], -side))
        solution = solve_ivp(
            rates, (t, end), y, "DOP853", args=(way, side), events=[
                event(lambda t, y, *_, one=one: one(t, y), one.direction) for one in events
            ], rtol=1e-13, atol=1e-15, max_step=0.1,
        )  # fmt: skip
        t, y = solution.t[-1], solution.y[:, -1].copy()
        if solution.status != 1:
            break
        if len(solution.t_events[0]):
            y[1], way = 0.0, -way
        elif yields:
            y[2] = np.copysign(limit, y[2])
        else:
            y[2], side = 0.0, way
    return y
