"""Motions of several masses in 50 digits: matrix exponentials, events by bisection on a grid.

Written for itself, from the equations; it shares the description of stops with the flow only.
"""

from __future__ import annotations

from typing import Any

import mpmath as mp
import numpy as np

from vibroimpact.engine.assembly.plan import GROUND, Forcing, Stop

DIGITS = 50


class Exact:
    """One motion; `advance` goes over a section and notes (time, stop, what) of its events."""

    def __init__(
        self,
        mass: Any,
        damping: Any,
        stiffness: Any,
        stops: list[Stop],
        forcing: Forcing,
        amplitude: float,
        omega: float,
        constant: Any = None,
        grid: float = 1e-3,
    ) -> None:
        mp.mp.dps = DIGITS
        self.n, self.stops, self.record = len(mass), stops, forcing.interval > 0
        n = self.n
        self.inverse = mp.matrix(np.asarray(mass).tolist()) ** -1
        self.k = self.inverse * mp.matrix(np.asarray(stiffness).tolist())
        self.c = self.inverse * mp.matrix(np.asarray(damping).tolist())
        weights = np.asarray(forcing.weights).reshape(n, -1)
        self.waves = 2 if self.record else weights.shape[1]
        scale = mp.mpf(1) if self.record else mp.mpf(amplitude) * mp.mpf(omega) ** forcing.power
        self.push = mp.zeros(n, self.waves)
        for i in range(n):
            for j in range(weights.shape[1]):
                self.push[i, j] = mp.mpf(weights[i, j]) * scale
        self.push = self.inverse * self.push
        still = np.zeros(n) if constant is None else np.asarray(constant)
        self.still = self.inverse * mp.matrix(still.tolist())
        self.omega, self.grid = mp.mpf(omega), mp.mpf(grid)
        self.size = 2 * n + self.waves + 1
        self.y = [mp.mpf(0)] * self.size
        self.y[-1] = mp.mpf(1)
        self.memory = [mp.mpf(0)] * len(stops)
        self.mode: frozenset[int] = frozenset()
        self.fresh: int | None = None
        self.events: list[tuple[float, int, str]] = []
        self.cache: dict[frozenset[int], Any] = {}

    def closing(self, f: int) -> list[Any]:
        row = [mp.mpf(0)] * self.n
        if self.stops[f].left != GROUND:
            row[self.stops[f].left] += 1
        if self.stops[f].right != GROUND:
            row[self.stops[f].right] -= 1
        return row

    def system(self, mode: frozenset[int]) -> tuple[Any, list[list[Any]]]:
        """A and the watched rows of a mode."""
        if mode in self.cache:
            return self.cache[mode]
        n, size = self.n, self.size
        a = mp.zeros(size)
        for i in range(n):
            a[i, n + i] = mp.mpf(1)
            for j in range(n):
                a[n + i, j], a[n + i, n + j] = -self.k[i, j], -self.c[i, j]
            for j in range(self.waves):
                a[n + i, 2 * n + j] = self.push[i, j]
            a[n + i, size - 1] = self.still[i]
        for q in range(self.waves // 2):
            at = 2 * n + 2 * q
            a[at, at + 1] = mp.mpf(1) if self.record else self.omega * (q + 1)
            a[at + 1, at] = mp.mpf(0) if self.record else -self.omega * (q + 1)
        rows = []
        resting = [f for f in sorted(mode) if self.stops[f].restitution is not None]
        for f, stop in enumerate(self.stops):
            w = self.closing(f)
            row = [mp.mpf(0)] * size
            if f not in mode:
                for i in range(n):
                    row[i] = -w[i]
                row[-1] = mp.mpf(stop.gap)
            elif f not in resting:
                k, c = mp.mpf(stop.stiffness), mp.mpf(stop.damping)
                for i in range(n):
                    row[i], row[n + i] = k * w[i], c * w[i]
                row[-1] = -k * mp.mpf(stop.gap)
                pushed = self.inverse * mp.matrix(w)
                for i in range(n):
                    for j in range(size):
                        a[n + i, j] -= pushed[i] * row[j]
            rows.append(row)
        if resting:
            w = mp.matrix([self.closing(f) for f in resting])
            ahead = a[n : 2 * n, :]
            force = (w * self.inverse * w.T) ** -1 * (w * ahead)
            back = self.inverse * w.T * force
            for i in range(n):
                for j in range(size):
                    a[n + i, j] -= back[i, j]
            for r, f in enumerate(resting):
                rows[f] = [force[r, j] for j in range(size)]
        listed = [[a[i, j] for j in range(size)] for i in range(size)]
        sparse = [[(j, x) for j, x in enumerate(row) if x] for row in listed]
        step = mp.expm(a * self.grid, method="taylor")
        full = [[step[i, j] for j in range(size)] for i in range(size)]
        self.cache[mode] = sparse, rows, full
        return self.cache[mode]

    def after(self, y: list[Any], t: Any) -> list[Any]:
        """y after less than a grid step."""
        sparse, _, _ = self.system(self.mode)
        total, term = list(y), list(y)
        for k in range(1, 200):
            term = [mp.fdot((x, term[j]) for j, x in row) * t / k for row in sparse]
            total = [a + b for a, b in zip(total, term, strict=True)]
            if max(abs(x) for x in term) < mp.mpf(10) ** -DIGITS:
                break
        return total

    def rate(self, f: int) -> Any:
        stop = self.stops[f]
        return mp.mpf(stop.stiffness) / mp.mpf(stop.damping) if stop.damping else mp.mpf(0)

    def value(self, f: int, y: list[Any], t: Any) -> Any:
        _, rows, _ = self.system(self.mode)
        total = mp.fdot(zip(rows[f], y, strict=True))
        if f not in self.mode and self.memory[f]:
            total += self.memory[f] * mp.exp(-self.rate(f) * t)
        return total

    def advance(self, length: float, section: int, clock: tuple[float, float]) -> None:
        n = self.n
        length = mp.mpf(length)
        s, c = mp.mpf(clock[0]), mp.mpf(clock[1])
        sine, cosine = s, c
        for q in range(self.waves // 2):
            self.y[2 * n + 2 * q], self.y[2 * n + 2 * q + 1] = sine, cosine
            sine, cosine = sine * c + cosine * s, cosine * c - sine * s
        t = mp.mpf(0)
        while t < length:
            t += self.to_event(length - t, section, t)

    def to_event(self, left: Any, section: int, begun: Any) -> Any:
        _, _, step = self.system(self.mode)
        y, t = self.y, mp.mpf(0)
        checked = set(range(len(self.stops))) - {self.fresh}
        while True:
            dt = min(self.grid, left - t)
            if dt == self.grid:
                new = [mp.fdot(zip(row, y, strict=True)) for row in step]
            else:
                new = self.after(y, dt)
            first, which = dt, None
            for f in range(len(self.stops)):
                if f in checked and self.value(f, new, t + dt) <= 0:
                    here, there = y, t
                    root = mp.findroot(
                        lambda x, f=f, y=here, t=there: self.value(f, self.after(y, x), t + x),
                        (mp.mpf(0), dt),
                        solver="anderson",
                        tol=mp.mpf(10) ** -60,
                        verify=False,
                    )
                    if root < first or which is None:
                        first, which = root, f
                elif f not in checked and self.value(f, new, t + dt) > 0:
                    checked.add(f)
            if which is not None:
                self.y = self.after(y, first)
                t += first
                for f in range(len(self.stops)):
                    if f not in self.mode:
                        self.memory[f] *= mp.exp(-self.rate(f) * t)
                self.switch(which, (section, float(begun + t)))
                return t
            y, t = new, t + dt
            if t >= left:
                self.y = y
                self.fresh = None
                for f in range(len(self.stops)):
                    if f not in self.mode:
                        self.memory[f] *= mp.exp(-self.rate(f) * t)
                return t

    def switch(self, f: int, when: tuple[int, float]) -> None:
        n, stop, w = self.n, self.stops[f], self.closing(f)
        self.fresh = f
        if f in self.mode:
            if stop.restitution is None and stop.damping:
                self.memory[f] = mp.fdot(zip(w, self.y[:n], strict=True)) - mp.mpf(stop.gap)
            self.mode = self.mode - {f}
            self.events.append((*when, f, "free"))
            return
        self.events.append((*when, f, "touch"))
        if stop.restitution is None:
            self.memory[f] = mp.mpf(0)
            self.mode = self.mode | {f}
            return
        response = self.inverse * mp.matrix(w)
        speed = mp.fdot(zip(w, self.y[n : 2 * n], strict=True))
        kick = (1 + mp.mpf(stop.restitution)) * speed / mp.fdot(zip(w, response, strict=True))
        for i in range(n):
            self.y[n + i] -= response[i] * kick

    def deformation(self, f: int) -> Any:
        if f in self.mode and self.stops[f].restitution is None:
            return mp.fdot(zip(self.closing(f), self.y[: self.n], strict=True)) - mp.mpf(
                self.stops[f].gap
            )
        return self.memory[f]
