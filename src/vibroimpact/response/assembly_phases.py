"""What an assembly's motion shows between its events: ranges, impulses, energies and impacts."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.assembly import layout
from vibroimpact.engine.status import Status
from vibroimpact.model import Assembly, Record, Repeated
from vibroimpact.model.assembly import numbers
from vibroimpact.response.assembly_motion import Sections
from vibroimpact.response.assembly_pieces import (
    NODES,
    Follower,
    Seen,
    final_mode,
    integrals,
    ranges,
)

_Array = NDArray[np.float64]
_Flags = NDArray[np.bool_]

_AT_ONCE = 128
"""Sections of which all nodes are in memory."""
_SAME = 1e-15
"""Share of a section within which a piece ends where the log has its event."""
_AT_REST = 1e-12
"""A closing speed below this share of the largest speed is none: rest begins without an impact."""
MAX_EVENTS = 10_000


class Impacts(NamedTuple):
    """Impacts on rigid stops, in the order of time."""

    piece: NDArray[np.int64]
    """The piece that ends in it."""
    stop: NDArray[np.int64]
    before: _Array
    """Velocities of the masses just before it, shape (impact, mass)."""
    after: _Array
    impulse: _Array
    """In N s."""
    lost: _Array
    """Kinetic energy that is lost (J)."""


class _Impact(NamedTuple):
    piece: int
    stop: int
    before: _Array
    after: _Array
    impulse: float
    lost: float


class Measured(NamedTuple):
    """Pieces of a motion, in the order of time."""

    begin: _Array
    """Since the motion began (s)."""
    length: _Array
    angle: _Array
    """The forcing's phase at both ends, counted in each cycle anew, shape (piece, 2); NaN through a
    `Record`."""
    pressed: _Flags
    """Which stops are touched, shape (piece, stop)."""
    displacement: _Array
    """Least and largest of each mass, shape (piece, mass, 2)."""
    acceleration: _Array
    drift: _Array
    """The same of u_right − u_left of each link."""
    carried: _Array
    """The same of the force on the base, shape (piece, 2)."""
    force: _Array
    """The largest of each stop, shape (piece, stop)."""
    depth: _Array
    impulse: _Array
    stop_lost: _Array
    """Energy that the dashpot of each stop loses, touched or not (J)."""
    link_lost: _Array
    """Of each link, shape (piece, link); NaN of a curved one."""
    damping_lost: _Array
    """What damping loses that is not of a link (J), shape (piece,)."""
    work: _Array
    """Of the shaking on the masses (J)."""
    u: _Array
    """Displacements at both ends, shape (piece, 2, mass)."""
    v: _Array
    d: _Array
    """Deformations at both ends, shape (piece, 2, stop)."""
    impacts: Impacts
    final: _Array
    """The engine's state at the end."""
    status: Status

    def stored(self, of: AssemblyParts) -> float:
        """Return by how much kinetic and potential energy have grown (J)."""
        n = self.u.shape[2]
        end = layout.PARTS + 2 * n
        last = self.final[layout.PARTS : end]
        first = of.energy(self.u[0, 0], self.v[0, 0], self.d[0, 0])
        return of.energy(last[:n], last[n:], self.final[end : end + self.d.shape[2]]) - first


class AssemblyParts:
    """The numbers of an assembly that its energies need."""

    def __init__(self, assembly: Assembly) -> None:
        of = numbers(assembly)
        self.mass, self.stiffness, self.damping = of.mass, of.stiffness, of.damping
        self.influence, self.constant = of.influence, of.force
        links, stops = assembly.links.values(), assembly.stops.values()
        self.stretch = -_rows([assembly.closing(link) for link in links], len(of.mass))
        """What makes u_right − u_left of each link."""
        self.closing = _rows([assembly.closing(stop) for stop in stops], len(of.mass))
        self.dashpots = np.array(
            [link.law.damping if link.law.linear else math.nan for link in links]  # type: ignore[union-attr]
        )
        pairs = [one.stop.spring_and_dashpot for one in stops]
        self.springs = np.array([0.0 if pair is None else pair[0] for pair in pairs])
        self.stop_dashpots = np.array([0.0 if pair is None else pair[1] for pair in pairs])
        self.rigid = np.array([one.stop.rigid for one in stops], dtype=bool)
        self.relaxing = np.array([pair is not None for pair in pairs], dtype=bool)
        self.linear = not np.isnan(self.dashpots).any()
        response = np.linalg.solve(of.mass, self.closing.T).astype(np.float64)
        self.coupling: _Array = self.closing @ response

    def watch(self, stretch: _Array) -> None:
        """Measure other drifts than those of the links."""
        self.stretch = stretch
        self.dashpots = np.zeros(len(stretch))

    def energy(self, u: _Array, v: _Array, d: _Array) -> float:
        """Return kinetic and potential energy; of curved links it is not known (NaN)."""
        if not self.linear:
            return math.nan
        springs = float(u @ self.stiffness @ u) + float(self.springs @ (d * d))
        return 0.5 * (float(v @ self.mass @ v) + springs) - float(self.constant @ u)

    def impulses(self, stops: list[int], change: _Array) -> _Array:
        """Return the impulses of stops that change the velocities of the masses like this."""
        pushed = self.closing[stops] @ change
        coupled = self.coupling[np.ix_(stops, stops)]
        return np.linalg.lstsq(coupled, pushed, rcond=None)[0].astype(np.float64)


def _places(flags: _Flags) -> list[int]:
    return [int(i) for i in np.flatnonzero(flags)]


def _rows(rows: list[_Array], width: int) -> _Array:
    return np.array(rows) if rows else np.empty((0, width))


class Measurer:
    """Follows motions of an assembly, and measures their pieces.

    Parameters
    ----------
    assembly, shaking
        What vibrates, and what shakes it.
    max_events
        In one section, at which a motion is given up.
    nodes
        See `Follower`. Energies need `NODES`.
    stretch : ndarray, shape (row, mass)
        What makes the drifts that are measured. Default: those of the links.
    """

    def __init__(
        self,
        assembly: Assembly,
        shaking: Repeated | Record,
        max_events: int = MAX_EVENTS,
        nodes: int = NODES,
        stretch: _Array | None = None,
    ) -> None:
        self.parts = AssemblyParts(assembly)
        if stretch is not None:
            self.parts.watch(stretch)
        self.shaking = shaking
        self.follower = Follower(assembly, shaking, max_events, nodes)
        self.on = None
        if not isinstance(shaking, Record) and not shaking.moves_base:
            self.on = assembly.names.index(shaking.on or assembly.names[0])

    def follow(
        self, state: _Array, sections: Sections, told: Callable[[int], None] | None = None
    ) -> Measured:
        """Follow a motion over sections, in place, and measure its pieces.

        ``told`` is called with the number of sections that are done.
        """
        chunks: list[dict[str, _Array]] = []
        impacts: list[tuple[int, int, bool]] = []
        pieces, status = 0, Status.DONE
        for first in range(0, len(sections.lines), _AT_ONCE):
            lines = sections.lines[first : first + _AT_ONCE]
            seen = self.follower.over(state, lines)
            status = seen.status
            chunks.append(self._measured(seen, lines, first, sections))
            impacts += self._impacts(seen, pieces, sections.interval)
            pieces += len(seen.begin)
            if told is not None:
                told(first + len(lines))
            if status is not Status.DONE:
                break
        if not chunks:
            nothing = self.follower.over(state.copy(), sections.lines[:0])
            chunks.append(self._measured(nothing, sections.lines[:0], 0, sections))
        columns = {name: np.concatenate([one[name] for one in chunks]) for name in chunks[0]}
        return self._with_impacts(columns, impacts, state, status)

    def _measured(
        self, seen: Seen, lines: _Array, first: int, sections: Sections
    ) -> dict[str, _Array]:
        parts = self.parts
        length = seen.end - seen.begin
        lasts = length[:, np.newaxis]
        v, force = seen.velocity, seen.force
        u_ends, v_ends, d_ends = (
            np.moveaxis(one[:, :, [0, -1]], 2, 1)
            for one in (seen.displacement, v, seen.deformation)
        )
        pressed = (seen.clearance == 0.0).all(axis=2)
        # Of a piece without length, all that is seen is one instant.
        pressed &= (lasts > 0.0) | (force != 0.0).any(axis=2)
        stretch, closing = np.matmul(parts.stretch, v), np.matmul(parts.closing, v)
        link_lost = parts.dashpots * lasts * integrals(stretch * stretch)
        all_lost = length * integrals(np.einsum("pin,ij,pjn->pn", v, parts.damping, v))
        known = np.where(np.isnan(parts.dashpots), 0.0, link_lost).sum(axis=1)
        # What a stop without memory takes up while it is touched, it gives back or loses.
        touched = lasts * np.where(
            parts.relaxing,
            parts.stop_dashpots * integrals(closing * closing),
            integrals(force * closing),
        )
        relaxed = 0.5 * parts.springs * (d_ends[:, 0] ** 2 - d_ends[:, 1] ** 2)
        since = seen.begin[:, np.newaxis] + lasts * self.follower.tau
        drive, angle = self._drive(seen, since, lines, sections)
        carried = parts.influence @ parts.constant - np.einsum(
            "i,pin->pn", parts.mass @ parts.influence, seen.acceleration
        )
        if self.on is None:
            power = -drive * np.einsum("i,pin->pn", parts.mass @ parts.influence, v)
        else:
            carried = carried + parts.influence[self.on] * drive
            power = drive * v[:, self.on]
        return {
            "begin": (first + seen.section) * sections.interval + seen.begin,
            "length": length,
            "angle": angle,
            "pressed": pressed,
            "displacement": ranges(seen.displacement),
            "acceleration": ranges(seen.acceleration),
            "drift": ranges(np.matmul(parts.stretch, seen.displacement)),
            "carried": ranges(carried),
            "force": np.where(pressed, ranges(force)[..., 1], 0.0),
            "depth": np.where(pressed, ranges(seen.deformation)[..., 1], 0.0),
            "impulse": np.where(pressed, lasts * integrals(force), 0.0),
            "stop_lost": np.where(pressed, touched, relaxed),
            "link_lost": link_lost,
            "damping_lost": all_lost - known,
            "work": length * integrals(power),
            "u": u_ends,
            "v": v_ends,
            "d": d_ends,
        }

    def _drive(
        self, seen: Seen, since: _Array, lines: _Array, sections: Sections
    ) -> tuple[_Array, _Array]:
        """Return the base acceleration or the force at the nodes, and the phase at both ends."""
        if isinstance(self.shaking, Record):
            s, c = (lines[seen.section, i][:, np.newaxis] for i in (0, 1))
            return s + c * since, np.full((len(since), 2), np.nan)
        angle = sections.turn + 2.0 * math.pi / sections.interval * since
        return self.shaking.at(angle), angle[:, [0, -1]]

    def _impacts(self, seen: Seen, before: int, interval: float) -> list[tuple[int, int, bool]]:
        """Return the impacts: the piece, the stop, and whether the one before it was the same."""
        found, row, last = [], 0, len(seen.begin) - 1
        slack = _SAME * interval
        ends = list(zip(seen.section.tolist(), seen.end.tolist(), strict=True))
        for i, (section, time, stop, what) in enumerate(seen.log):
            while row < last and ends[row] < (section, time - slack):
                row += 1
            if what == layout.IMPACT:
                again = i > 0 and tuple(seen.log[i - 1, :3]) == (section, time, stop)
                found.append((before + row, int(stop), bool(again)))
            row += 1
        return found

    def _with_impacts(
        self,
        columns: dict[str, _Array],
        found: list[tuple[int, int, bool]],
        state: _Array,
        status: Status,
    ) -> Measured:
        parts = self.parts
        n, mode = len(parts.mass), final_mode(state)
        v, pressed = columns["v"], columns["pressed"]
        kept = []
        for piece, stop, again in found:
            if piece + 1 < len(v):
                behind, held = v[piece + 1, 0], pressed[piece + 1]
            else:
                behind = state[layout.PARTS + n : layout.PARTS + 2 * n]
                held = np.array([mode >> f & 1 > 0 for f in range(len(parts.closing))])
            ahead = v[piece, 1]
            change = ahead - behind
            stops = [stop, *(g for g in _places(held & parts.rigid) if g != stop)]
            impulses = parts.impulses(stops, change)
            closing = abs(float(parts.closing[stop] @ ahead))
            moving = closing > _AT_REST * float(np.abs(ahead).max())
            for g, one in zip(stops[1:], impulses[1:], strict=True):
                if piece + 1 < len(v):
                    columns["impulse"][piece + 1, g] += one
            if not held[stop] or (moving and not again):
                lost = 0.5 * float(change @ parts.mass @ (ahead + behind))
                kept.append(_Impact(piece, stop, ahead, behind, float(impulses[0]), lost))
        impacts = Impacts(
            np.array([one.piece for one in kept], dtype=np.int64),
            np.array([one.stop for one in kept], dtype=np.int64),
            _rows([one.before for one in kept], n),
            _rows([one.after for one in kept], n),
            np.array([one.impulse for one in kept]),
            np.array([one.lost for one in kept]),
        )
        return Measured(**columns, impacts=impacts, final=state, status=status)  # type: ignore[arg-type]
