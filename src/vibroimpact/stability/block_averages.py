"""Growth of disturbances over many cycles, kept in a memory that does not grow with them.

Of up to `GROUPS` cycles each is kept. Of more cycles only sums over groups of them are kept, and
stretches of the section that lie evenly over all cycles.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vibroimpact.stability.motion_type import LONGEST, averages, settling

_Array = NDArray[np.float64]

GROUPS = 65_536
"""Groups of cycles, at most: with the points of the section they take 4 MB."""
STRETCH = 2 * LONGEST
"""Cycles of a stretch of the section."""


class Averaged:
    """What is kept of the rows of `engine.lyapunov.growth`.

    Parameters
    ----------
    cycles
        How many rows there will be, at most.
    parts
        Parts of a state, with which a row ends.
    count
        Exponents, with whose logarithms a row begins; the damping is between them and the state.
    """

    def __init__(self, cycles: int, parts: int = 5, count: int = 2) -> None:
        self.done = 0
        self._summed = count + 1
        self._group = -(-cycles // GROUPS)
        self._sums = np.empty((-(-cycles // self._group), self._summed))
        self._waiting = np.empty((0, self._summed))
        self._apart = max(STRETCH, -(-cycles * STRETCH // GROUPS))
        """Cycles from the beginning of a stretch to that of the next."""
        self._section = np.empty((min(cycles, GROUPS), parts))
        self._kept = 0
        self._last = self._section[:0]

    def add(self, rows: _Array) -> None:
        """Take the rows that follow."""
        self._add_sums(rows[:, : self._summed])
        section = rows[:, self._summed :]
        cycle = np.arange(self.done, self.done + len(rows))
        chosen = section[cycle % self._apart < STRETCH][: len(self._section) - self._kept]
        self._section[self._kept : self._kept + len(chosen)] = chosen
        self._kept += len(chosen)
        self._last = np.concatenate([self._last, section])[-STRETCH:]
        self.done += len(rows)

    def _add_sums(self, rows: _Array) -> None:
        """Sum complete groups, so that it does not matter how many rows come at once."""
        held = np.concatenate([self._waiting, rows])
        count = len(held) // self._group
        whole = held[: count * self._group].reshape(count, self._group, self._summed)
        begin = self.done // self._group
        self._sums[begin : begin + count] = whole.sum(axis=1)
        self._waiting = held[count * self._group :]

    def exponents(self) -> tuple[_Array, _Array]:
        """Exponents per cycle, and their standard uncertainties."""
        return averages(self._used()[:, :-1], self._group, self.done)

    def damping(self) -> float:
        """The damping per unit mass, integrated over a cycle, on average."""
        return float(self._used()[:, -1].sum() / self.done)

    def is_settling(self, size: _Array) -> bool:
        """Whether the motion still comes closer to a periodic one; `size`: units of its points."""
        section = self._section[: self._kept] / size
        if self._apart == STRETCH:
            return settling(section)
        stretches = np.split(section, range(STRETCH, len(section), STRETCH))
        return settling(*stretches, self._last / size)

    def _used(self) -> _Array:
        """Sums of all groups, the last of which may be incomplete."""
        whole = self._sums[: self.done // self._group]
        if not len(self._waiting):
            return whole
        return np.vstack([whole, self._waiting.sum(axis=0)])
