"""A curve of bifurcations as a curve in the state and two parameters."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from vibroimpact.continuation.arclength import (
    TURN,
    distance,
    is_other_curve,
    predicted,
    unit_tangent,
)
from vibroimpact.continuation.closing import SAME, returned
from vibroimpact.continuation.zero import zero_within
from vibroimpact.model.units import pretty
from vibroimpact.model.written_units import written_for
from vibroimpact.stability.bifurcations import GRAZING
from vibroimpact.stability.defining_system import Defining, Spot, solve
from vibroimpact.stability.fixed_points import Orbit, beyond, images, margin_of, seen_at
from vibroimpact.stability.orbit_curve import CLOSED, PHASES

_Array = NDArray[np.float64]

_BISECTIONS = 20
_JOINED = 3.0  # of a bisected step, by which its ends may differ on one curve
_BEHIND = 1e-6  # scaled; so far behind a point the curve's tangent is taken to another section
_TOUCHED = 1e-4  # scaled; by so much rounding may move a motion that grazes a rigid stop


@dataclass(frozen=True, eq=False)
class LocusPoint:
    """A point of the curve."""

    system: Defining
    spot: Spot
    tangent: _Array
    arclength: float
    phases_tried: int = 0
    """How often the section was moved at this very orbit."""

    @property
    def y(self) -> _Array:
        """The state at the section, and both parameters."""
        return self.spot.y

    @property
    def phase(self) -> float:
        """Forcing phase of the section, rad."""
        return self.system.plane.family.phase


@dataclass(frozen=True, eq=False)
class Locus:
    """What is followed (see `continuation.arclength.Path`): bifurcations of one kind."""

    first: LocusPoint
    spans: list[tuple[float, float]]
    """Ranges of both parameters."""
    marks: dict[float, list[tuple[_Array, _Array]]] = field(default_factory=dict)
    """Sections of the first orbit, and the curve's tangents there, by the forcing's phase."""

    @property
    def seen(self) -> _Array:
        """See `Path`."""
        return self.first.system.seen

    @property
    def scale(self) -> _Array:
        """Sizes of the state's components and the parameters."""
        return self.first.system.scale

    def solved(self, here: LocusPoint, length: float) -> Spot | None:
        """Predict and correct."""
        aim = predicted(self, here, length)
        spot = solve(here.system, aim, here.tangent)
        return None if spot is None or is_other_curve(self, spot.y, aim, length) else spot

    def step(self, here: LocusPoint, length: float) -> tuple[LocusPoint | None, bool]:
        """See `Path`."""
        spot = self.solved(here, length)
        if spot is None or not (_same(here, spot.orbit) or self._passes(here, spot, length)):
            return None, False
        return self._after(here, spot), False

    def _after(self, here: LocusPoint, spot: Spot) -> LocusPoint:
        tangent = unit_tangent(spot.jacobian, here.tangent, self.seen)
        return LocusPoint(
            here.system, spot, tangent, here.arclength + distance(self, spot.y, here.y)
        )

    def _passes(self, here: LocusPoint, there: Spot, length: float) -> bool:
        """Whether the curve goes on where the contacts change within a step.

        Where contacts merge the condition is continuous. Where one comes or goes at no speed it
        jumps with a dashpot, and another curve may lie behind, close by.
        """
        good, bad, last = 0.0, length, here.spot
        for _ in range(_BISECTIONS):
            middle = 0.5 * (good + bad)
            spot = self.solved(here, middle)
            if spot is None:
                break
            if _same(here, spot.orbit):
                good, last = middle, spot
            else:
                bad, there = middle, spot
        if margin_of(last.orbit) * margin_of(there.orbit) > 0.0:
            return True
        joined = distance(self, last.y, there.y) <= _JOINED * (bad - good) + 1e-9
        return spot is not None and joined

    def corner(self, here: LocusPoint, length: float) -> list[LocusPoint]:
        """See `Path`: a curve ends in its corners."""
        return []

    def end(self, here: LocusPoint, there: LocusPoint) -> tuple[list[LocusPoint], str] | None:
        """See `Path`."""
        over = here.system.plane
        for i, (low, high) in enumerate(self.spans):
            value = there.y[i - 2]
            if not low <= value <= high:
                bound = low if value < low else high
                varied = (over.family.parameter, over.other)[i]
                with written_for(over.family.rig):
                    text = pretty(bound, varied.quantity, 9)
                return self._on_bound(here, there, i - 2, bound), (
                    f"the range of {varied.name} ends at {text}"
                )
        return ([there], CLOSED) if self._returned(here, there) else None

    def _on_bound(
        self, here: LocusPoint, there: LocusPoint, which: int, bound: float
    ) -> list[LocusPoint]:
        """The point at the end of the range, if there is one."""
        share = (bound - here.y[which]) / (there.y[which] - here.y[which])
        y = here.y + share * (there.y - here.y)
        y[which] = bound
        spot = solve(here.system, y, np.eye(len(y))[which])
        return [] if spot is None else [self._after(here, spot)]

    def _returned(self, here: LocusPoint, there: LocusPoint) -> bool:
        """Whether a step has passed the first orbit, seen a whole number of cycles later or not."""
        phase = there.phase
        if here.phase != phase:
            return False
        if phase not in self.marks:
            self.marks[phase] = self._marks(there.system)

        def solved(guess: _Array, normal: _Array) -> _Array | None:
            spot = solve(there.system, guess, normal)
            return None if spot is None else spot.y

        return returned(self, here, there, self.marks[phase], solved)

    def _marks(self, system: Defining) -> list[tuple[_Array, _Array]]:
        start = seen_at(self.first.spot.orbit, system.plane.family.phase)
        if start is None:
            return []
        point, mode = start
        parameters = self.first.y[-2:]
        here = system._replace(mode=mode).value(np.append(point[:-1], parameters))
        marks: list[tuple[_Array, _Array]] = []
        for image, mode in () if here is None else images(here[0], mirrored=False):
            y = np.append(image[:-1], parameters)
            spot = system._replace(mode=mode).spot(y)
            if spot is None:
                break
            # The parameters are the same for all of them, and so is their sense.
            marks.append(
                (y, unit_tangent(spot.jacobian, _along_parameters(self.first.tangent), self.seen))
            )
        return marks

    def in_other_coordinates(self, here: LocusPoint) -> LocusPoint | None:
        """See `Path`: at another section, for where an event falls on it there is a corner."""
        for number in range(here.phases_tried, len(PHASES)):
            same = self._at_phase(here, here.phase + PHASES[number])
            if same is not None:
                return replace(same, phases_tried=number + 1)
        return None

    def _at_phase(self, here: LocusPoint, phase: float) -> LocusPoint | None:
        """The same point at another section: the same orbit, and the curve's same sense.

        Beside a grazing Newton's method may find another bifurcation, and differences across it
        give a tangent along which the curve would go back.
        """
        over = here.system.plane
        seen, carried = seen_at(here.spot.orbit, phase), self._carried(here, phase)
        if seen is None or carried is None:
            return None
        aim = np.append(seen[0][:-1], here.y[-2:])
        system = here.system._replace(
            plane=over._replace(family=over.family.with_phase(phase)), mode=seen[1]
        )
        spot = solve(system, aim, carried)
        if spot is None or not _same(here, spot.orbit):
            return None
        tangent = unit_tangent(spot.jacobian, carried, self.seen)
        moved = distance(self, spot.y, aim)
        if here.system.kind == GRAZING:
            same = moved <= _TOUCHED
        else:
            same = moved <= SAME and float(tangent * self.seen @ carried) >= TURN
        return LocusPoint(system, spot, tangent, here.arclength) if same else None

    def _carried(self, here: LocusPoint, phase: float) -> _Array | None:
        """The curve's tangent as the motion itself carries it over to another section.

        Of a grazing, after which a motion may be another, only what no section changes: the sense
        along both parameters.
        """
        if here.system.kind == GRAZING:
            return _along_parameters(here.tangent)
        y = here.y - _BEHIND * here.tangent * self.scale
        behind = here.system.value(y)
        if behind is None or not _same(here, behind[0]):
            return None
        seen, earlier = seen_at(here.spot.orbit, phase), seen_at(behind[0], phase)
        if seen is None or earlier is None:
            return None
        change = np.append(seen[0] - earlier[0], here.y[-1] - y[-1]) / self.scale
        return change / np.linalg.norm(change * self.seen)

    def lost(self, here: LocusPoint) -> str:
        """See `Path`."""
        where = ", ".join(f"{value:.9g}" for value in here.y[-2:])
        return beyond(here.spot.orbit, here.system.kind, f"({where})")

    def cusp(self, here: LocusPoint, there: LocusPoint) -> Spot | None:
        """The point between two at which both parameters turn back, if they do."""
        if here.phase != there.phase or here.tangent[-2:] @ there.tangent[-2:] >= 0.0:
            return None

        def forwards(spot: Spot) -> float:
            return float(
                unit_tangent(spot.jacobian, here.tangent, self.seen)[-2:] @ here.tangent[-2:]
            )

        length = float((there.y - here.y) / self.scale * self.seen @ here.tangent)
        zero = zero_within(here.spot, length, partial(self.solved, here), forwards)
        return None if zero is None else zero[0]


def _along_parameters(tangent: _Array) -> _Array:
    """A tangent without its parts along the state."""
    projection = np.zeros_like(tangent)
    projection[-2:] = tangent[-2:]
    return projection


def _same(here: LocusPoint, orbit: Orbit) -> bool:
    """Whether an orbit has the contacts of a point; those of one that grazes rounding decides."""
    return here.system.kind == GRAZING or orbit.contacts == here.spot.orbit.contacts
