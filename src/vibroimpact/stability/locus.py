"""A curve of bifurcations as a curve in the state and two parameters."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import NDArray

from vibroimpact.continuation.arclength import distance, predicted, strays, unit_tangent
from vibroimpact.continuation.closing import returned
from vibroimpact.continuation.zero import zero_within
from vibroimpact.engine.section_map import PARAMETER
from vibroimpact.stability.defining import SEEN, Defining, Spot, solve
from vibroimpact.stability.fixed_points import beyond, images, seen_at
from vibroimpact.stability.trace import CLOSED, PHASES

_Array = NDArray[np.float64]

_PARAMETERS = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Place:
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

    first: Place
    spans: list[tuple[float, float]]
    """Ranges of both parameters."""
    marks: dict[float, list[tuple[_Array, _Array]]] = field(default_factory=dict)
    """Sections of the first orbit, and the curve's tangents there, by the forcing's phase."""
    seen = SEEN

    @property
    def scale(self) -> _Array:
        """Sizes of the state's components and the parameters."""
        return self.first.system.scale

    def solved(self, here: Place, length: float) -> Spot | None:
        """Predict and correct."""
        aim = predicted(self, here, length)
        spot = solve(here.system, aim, here.tangent)
        return None if spot is None or strays(self, spot.y, aim, length) else spot

    def step(self, here: Place, length: float) -> tuple[Place | None, bool]:
        """See `Path`."""
        spot = self.solved(here, length)
        return (None, False) if spot is None else (self._after(here, spot), False)

    def _after(self, here: Place, spot: Spot) -> Place:
        tangent = unit_tangent(spot.jacobian, here.tangent, SEEN)
        return Place(here.system, spot, tangent, here.arclength + distance(self, spot.y, here.y))

    def corner(self, here: Place, length: float) -> list[Place]:
        """See `Path`: a curve ends in its corners."""
        return []

    def end(self, here: Place, there: Place) -> tuple[list[Place], str] | None:
        """See `Path`."""
        over = here.system.plane
        for i, (low, high) in enumerate(self.spans):
            value = there.y[PARAMETER + i]
            if not low <= value <= high:
                bound = low if value < low else high
                name = (over.family.parameter, over.other)[i].name
                return self._on_bound(here, there, PARAMETER + i, bound), (
                    f"the range of {name} ends at {bound:.9g}"
                )
        return ([there], CLOSED) if self._returned(here, there) else None

    def _on_bound(self, here: Place, there: Place, which: int, bound: float) -> list[Place]:
        """The point at the end of the range, if there is one."""
        share = (bound - here.y[which]) / (there.y[which] - here.y[which])
        y = here.y + share * (there.y - here.y)
        y[which] = bound
        spot = solve(here.system, y, np.eye(PARAMETER + 2)[which])
        return [] if spot is None else [self._after(here, spot)]

    def _returned(self, here: Place, there: Place) -> bool:
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
        parameters = self.first.y[PARAMETER:]
        here = system._replace(mode=mode).value(np.append(point[:PARAMETER], parameters))
        found: list[tuple[_Array, _Array]] = []
        for image, mode in () if here is None else images(here[0], mirrored=False):
            y = np.append(image[:PARAMETER], parameters)
            spot = system._replace(mode=mode).spot(y)
            if spot is None:
                break
            # The parameters are the same for all of them, and so is their sense.
            found.append((y, unit_tangent(spot.jacobian, self.first.tangent * _PARAMETERS, SEEN)))
        return found

    def elsewhere(self, here: Place) -> Place | None:
        """See `Path`: at another section, for where an event falls on it there is a corner."""
        over = here.system.plane
        for number in range(here.phases_tried, len(PHASES)):
            phase = over.family.phase + PHASES[number]
            turned = over.family.excitation.replace(phase=phase)
            seen = seen_at(here.spot.orbit, phase)
            if seen is None:
                continue
            point, mode = seen
            system = here.system._replace(
                plane=over._replace(family=over.family._replace(excitation=turned)), mode=mode
            )
            along = here.tangent * _PARAMETERS
            spot = solve(system, np.append(point[:PARAMETER], here.y[PARAMETER:]), along)
            if spot is not None:
                tangent = unit_tangent(spot.jacobian, along, SEEN)
                return Place(system, spot, tangent, here.arclength, number + 1)
        return None

    def lost(self, here: Place) -> str:
        """See `Path`."""
        where = ", ".join(f"{value:.9g}" for value in here.y[PARAMETER:])
        return beyond(here.spot.orbit, here.system.kind, f"({where})")

    def cusp(self, here: Place, there: Place) -> Spot | None:
        """The point between two at which both parameters turn back, if they do."""
        if here.phase != there.phase or here.tangent[PARAMETER:] @ there.tangent[PARAMETER:] >= 0.0:
            return None

        def forwards(spot: Spot) -> float:
            return float(
                unit_tangent(spot.jacobian, here.tangent, SEEN)[PARAMETER:]
                @ here.tangent[PARAMETER:]
            )

        length = float((there.y - here.y) / self.scale * SEEN @ here.tangent)
        found = zero_within(here.spot, length, partial(self.solved, here), forwards)
        return None if found is None else found[0]
