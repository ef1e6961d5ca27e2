"""Points of a family: periodic orbits with their derivative, corrected by Newton's method."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray

from vibroimpact.continuation.arclength import unit_tangent
from vibroimpact.engine import orbit, section_map
from vibroimpact.engine.flow_dispatch import carries
from vibroimpact.engine.state import MODE
from vibroimpact.engine.status import Status
from vibroimpact.model.rig import Rig
from vibroimpact.response.prepared_rig import PreparedRig
from vibroimpact.stability.parameter_family import Family

_Array = NDArray[np.float64]

MAX_EVENTS = 1000

_GRAZES = 1e-4
_FIXED = 1e-9
"""Of the scaled residual: so near to its image, a point is fixed."""

_LINES = 12
"""Lines that are tried one after the other, each of which touches where the one before has led."""
_TOUCHED = 1e-8
"""Of the parameter's size: so near to where it touches, a line is right to rounding."""

VALUE = -1
"""Where a point has its parameter: behind the parts of its state."""


@cache
def _components(first: int, size: int) -> _Array:
    """1 for so many components of a point, the first ones, and for its parameter; else 0."""
    mask = np.zeros(size)
    mask[:first] = mask[VALUE] = 1.0
    return mask


@dataclass(frozen=True)
class Section:
    """The map whose fixed points are sought: how far it goes, and whether it mirrors."""

    family: Family
    count: int
    """Forcing cycles; or half cycles, each followed by the mirror. The period of fixed points."""
    mirror: bool
    scale: _Array
    """Sizes of the parts of a state (of one mass u, u̇, u_R, u_L, z), and of the parameter."""

    @cached_property
    def held(self) -> _Array:
        """Normal of the plane on which the parameter does not change."""
        return _components(0, len(self.scale))

    @cached_property
    def seen(self) -> _Array:
        """Components by which lengths and angles along a branch are measured.

        A bumper's deformation is left out: at a section that passes from flight into contact it
        begins to move with the mass, and a smooth branch would have a corner.
        """
        return _components(2 * self.family.layout.masses, len(self.scale))

    def scaled(self, change: _Array) -> _Array:
        """Return a change of a point in scaled components, of which lengths count those `seen`."""
        scaled_change: _Array = change / self.scale * self.seen
        return scaled_change

    def with_map(self, count: int, *, mirror: bool) -> Section:
        """Another map of the same rig."""
        return Section(self.family, count, mirror, self.scale)

    def parent(self) -> Section | None:
        """The map from whose fixed points those of this one may branch off, if any.

        Over half the period; or, for an odd number of cycles of a symmetric rig, over half a cycle
        more often, each followed by the mirror.
        """
        if self.mirror:
            return None
        if self.count % 2 == 0:
            return self.with_map(self.count // 2, mirror=False)
        return self.with_map(self.count, mirror=True) if self.family.symmetric else None

    def turned(self, phase: float) -> Section:
        """The same at another forcing phase of the section."""
        return replace(self, family=self.family.with_phase(phase))


@dataclass(frozen=True, eq=False)
class Orbit:
    """A fixed point of a section's map."""

    section: Section
    point: _Array
    """The parts of the state, and the parameter."""
    facts: _Array
    """See `engine.orbit`."""
    carried: _Array
    """Row i is what becomes of a unit disturbance of component i."""
    slope: _Array
    """Derivative of the map with respect to the parameter."""

    @property
    def value(self) -> float:
        """The parameter."""
        return float(self.point[VALUE])

    @property
    def mode(self) -> float:
        """Which stops are touched at the section."""
        return float(self.facts[section_map.MODE])

    @property
    def place(self) -> str:
        """The parameter as text, with its unit."""
        return self.section.family.written(self.value, 9)

    @cached_property
    def contacts(self) -> tuple[int, ...]:
        """Contacts with each stop in a period; of one mass with the right and the left one."""
        counts = tuple(int(count) for count in self.facts[section_map.CONTACTS :])
        if not self.section.mirror:
            return counts
        # The other half of a motion that is its own mirror image.
        partners = self.section.family.layout.partners
        return tuple(count + counts[other] for count, other in zip(counts, partners, strict=True))

    @property
    def map_derivative(self) -> _Array:
        """The map's derivative; of the isolator's memory only where it has one."""
        states = self.section.family.states
        return self.carried[:states, :states].T

    @cached_property
    def map_multipliers(self) -> NDArray[np.complex128]:
        """Eigenvalues of the map's derivative, the largest first."""
        eigenvalues = np.linalg.eigvals(self.map_derivative).astype(complex)
        return eigenvalues[np.argsort(-np.abs(eigenvalues), kind="stable")]

    @property
    def multipliers(self) -> NDArray[np.complex128]:
        """Floquet multipliers over the period."""
        if not self.section.mirror:
            return self.map_multipliers
        # An odd number of half cycles, twice.
        return self.map_multipliers**2

    @property
    def monodromy(self) -> _Array:
        """Derivative of the state after one period."""
        matrix = self.map_derivative
        return matrix @ matrix if self.section.mirror else matrix

    @property
    def stable(self) -> bool:
        """Whether all multipliers lie within the unit circle."""
        return bool(np.abs(self.map_multipliers[0]) < 1.0)

    @cached_property
    def jacobian(self) -> _Array:
        """Derivative of P(z; p) − z in scaled components, shape (parts, parts + 1)."""
        scale = self.section.scale
        states = scale[:VALUE]
        matrix = np.empty((len(states), len(scale)))
        matrix[:, :VALUE] = self.carried.T * states / states[:, np.newaxis]
        matrix[np.diag_indices(len(states))] -= 1.0
        matrix[:, VALUE] = self.slope * scale[VALUE] / states
        return matrix

    def tangent(self, along: _Array) -> _Array:
        """Unit tangent of the branch in scaled components, in the sense of `along`.

        Its length is that of the components that `Section.seen` names.
        """
        return unit_tangent(self.jacobian, along, self.section.seen)

    @cached_property
    def missed(self) -> tuple[float, _Array] | None:
        """Residual as a fixed point of the simpler map, and the step to its image, scaled."""
        simpler = self.section.parent()
        if simpler is None:
            return None
        status, seen, image = evaluated(simpler, self.point, self.mode)
        if status is not Status.DONE:
            return None
        return float(seen.facts[section_map.RESIDUAL]), simpler.scaled(image - seen.point)

    @property
    def rig(self) -> Rig:
        """The rig of the orbit."""
        return self.section.family.at(self.value)


def _blank(section: Section, point: _Array, mode: float) -> Orbit:
    """What the engine writes an orbit into."""
    states = section.family.layout
    facts = np.zeros(section_map.CONTACTS + states.stops)
    facts[section_map.MODE] = mode
    return Orbit(
        section,
        np.array(point, dtype=np.float64),
        facts,
        np.zeros((states.parts, states.parts)),
        np.zeros(states.parts),
    )


def corrected(
    section: Section, point: _Array, mode: float, normal: _Array | None = None
) -> tuple[Status, Orbit]:
    """Newton's method on the plane through a point; the orbit is of use only if `Status.DONE`.

    Parameters
    ----------
    normal
        Normal of the plane, scaled; of its components only those in `Section.seen` count. Default:
        the plane on which the parameter is held.
    """
    normal = section.held if normal is None else normal
    rig = section.family.flow_rig(float(point[VALUE]))
    for _ in range(_LINES):
        fam = section.family.near(float(point[VALUE]))
        solution = _blank(section, point, mode)
        outcome = orbit.correct(
            rig,
            fam.base,
            fam.direction,
            fam.phase,
            section.count,
            section.mirror,
            MAX_EVENTS,
            section.scale,
            normal * section.seen,
            solution.point,
            solution.facts,
            solution.carried,
            solution.slope,
        )
        settled = Status(outcome) is Status.DONE
        if (not settled and not fam.straight) or (settled and fam.one_flow):
            break
        there = fam.flow_rig(solution.value)
        # From bumpers that are apart to such that overlap, it begins again from where it was.
        carried = carries(rig, there)
        moved = abs(solution.value - float(point[VALUE]))
        touches = fam.straight or moved <= _TOUCHED * section.scale[VALUE]
        if carried and touches:
            break
        if carried:
            point = solution.point
        rig = there
    else:
        if not section.family.straight:
            return Status.NOT_SETTLED, solution
    return Status(outcome), solution


def evaluated(section: Section, point: _Array, mode: float) -> tuple[Status, Orbit, _Array]:
    """The map and its derivative at a point that need not be fixed, and the point's image."""
    trial = _blank(section, point, mode)
    image = trial.point.copy()
    fam = section.family.near(trial.value)
    outcome = orbit.evaluate(
        fam.flow_rig(trial.value),
        fam.base,
        fam.direction,
        fam.phase,
        section.count,
        section.mirror,
        MAX_EVENTS,
        section.scale,
        trial.point,
        trial.facts,
        trial.carried,
        trial.slope,
        image,
    )
    return Status(outcome), trial, image


def is_fixed(section: Section, periodic_orbit: Orbit) -> bool:
    """Whether an orbit is fixed under another map."""
    status, image, _ = evaluated(section, periodic_orbit.point, periodic_orbit.mode)
    return status is Status.DONE and bool(image.facts[section_map.RESIDUAL] <= _FIXED)


def margin_of(periodic_orbit: Orbit) -> float:
    """Scaled distance from grazing: see `engine.one_mass.margin`."""
    section = periodic_orbit.section
    value: float = orbit.grazing_margin(
        section.family.system(periodic_orbit.value),
        section.family.phase,
        section.count,
        MAX_EVENTS,
        periodic_orbit.point,
        periodic_orbit.facts,
    )
    return value / float(section.scale[0])


def beyond(periodic_orbit: Orbit, what: str, where: str) -> str:
    """Why nothing may be found beyond the last orbit of a curve, in words."""
    margin = abs(margin_of(periodic_orbit))
    grazes = what != "grazing" and margin < _GRAZES
    detail = (
        f"the orbit nearly grazes a stop, by {margin:.1g} of its size"
        if grazes
        else "at the smallest step"
    )
    return f"no {what} could be found beyond {where} ({detail})"


def vector_of(periodic_orbit: Orbit) -> _Array:
    """The state at the section as the engine's vector."""
    mode = periodic_orbit.mode
    return periodic_orbit.section.family.layout.vector(periodic_orbit.point[:VALUE], mode)


def seen_at(periodic_orbit: Orbit, phase: float) -> tuple[_Array, float] | None:
    """Point and mode of the same motion at another forcing phase; None if a limit is met there."""
    section = periodic_orbit.section
    system = section.family.system(periodic_orbit.value)
    amplitude, frequency = section.family.forcing
    # Of its numbers, since the family's own forcing is another where a second parameter varies.
    here = section.family.excitation.replace(
        amplitude=float(system[amplitude]),
        frequency=float(system[frequency]),
    )
    ahead = ((phase - here.phase) / (2.0 * math.pi)) % 1.0
    state = vector_of(periodic_orbit)
    if ahead > 0.0:
        status, state = PreparedRig(Rig(section.family.rig.system, here), system).propagate(
            state, ahead, MAX_EVENTS
        )
        if status is not Status.DONE:
            return None
    point = np.append(section.family.layout.point(state), periodic_orbit.value)
    return point, float(state[MODE])


def at_phase(periodic_orbit: Orbit, phase: float) -> Orbit | None:
    """The same orbit seen at another section, if Newton's method confirms it."""
    section = periodic_orbit.section
    if phase == section.family.phase:
        return periodic_orbit
    seen = seen_at(periodic_orbit, phase)
    if seen is None:
        return None
    status, there = corrected(section.turned(phase), *seen)
    return there if status is Status.DONE else None


def images(periodic_orbit: Orbit, *, mirrored: bool) -> Iterator[tuple[_Array, float]]:
    """Points and modes of an orbit's sections a cycle apart; if `mirrored`, its mirror image's too.

    Those of an orbit that is its own mirror image are half a cycle apart, each mirrored: as many as
    its period has cycles, an odd number.
    """
    section = periodic_orbit.section
    point, mode = periodic_orbit.point, periodic_orbit.mode
    yield point, mode
    halves = mirrored or section.mirror
    one = Section(section.family, 1, halves, section.scale)
    for _ in range((2 if mirrored and not section.mirror else 1) * section.count - 1):
        status, evaluation, point = evaluated(one, point, mode)
        if status is not Status.DONE:
            return
        mode = evaluation.mode
        yield point, mode
