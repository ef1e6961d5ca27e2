"""Bifurcations on a followed branch: found by test functions, located to rounding.

=====================  =====================================================================
fold                   the tangent's component along the parameter changes its sign
symmetry breaking      of a motion that is its own mirror image: an eigenvalue of its map over
                       half a cycle and the mirror passes −1, det(H + I) changes its sign
period doubling        a multiplier passes −1: det(M + I) changes its sign
Neimark–Sacker         a complex pair passes the unit circle
branching              a multiplier passes 1 though the branch does not turn: det(M − I) changes
                       its sign. A symmetry breaking, if the orbit is its own mirror image
                       though its rig is not
grazing                the contacts change (`trace`)
=====================  =====================================================================
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.continuation.zero import between_zeros, zero_within
from vibroimpact.engine.status import Status
from vibroimpact.stability.fixed_points import VALUE, Orbit, corrected, evaluated, is_fixed
from vibroimpact.stability.orbit_curve import Station, solved
from vibroimpact.stability.parent_branches import half_plus, is_of_simpler_map, parent

_Array = NDArray[np.float64]

FOLD = "fold"
BREAKING = "symmetry breaking"
DOUBLING = "period doubling"
NEIMARK = "Neimark-Sacker"
GRAZING = "grazing"
BRANCHING = "branching"

_CERTAIN = 1e-9
"""Of det(M − I), beyond which rounding does not decide its sign."""
_MIRRORS = 1e-4
"""Scaled distance from where a multiplier passes 1, within which a mirrored orbit is the same."""
_SMALL = 1e-4
"""Of its larger value at the ends of a step, to which a test function must come down."""
_MEMORY = 1e-9
"""Modulus of the third multiplier, below which no bumper's memory has a say."""
_OFF = (1e-3, 3e-4, 1e-4, 3e-3, 1e-2)
"""Scaled distances from a bifurcation at which the branch that is born there is sought."""


class Bifurcation(NamedTuple):
    """An orbit at which something changes."""

    kind: str
    orbit: Orbit
    arclength: float
    """Along the branch on which it was found."""
    turns: bool
    """Whether the branch turns back here."""
    contacts_behind: tuple[int, ...]
    """Contacts with each stop per period beyond it; the orbit's own but for a grazing."""


def spiral(orbit: Orbit) -> float:
    """Logarithm of the largest modulus among complex multipliers; −1 if there is none."""
    values = orbit.map_multipliers
    complex_ones = np.abs(values[np.abs(values.imag) > 1e-9 * np.abs(values)])
    return math.log(complex_ones.max()) if complex_ones.size else -1.0


def nearest_pair(orbit: Orbit) -> float:
    """Logarithm of the modulus of the complex pair nearest to the unit circle; −1 without one.

    With one mass there is one pair, and it is `spiral`.
    """
    values = orbit.map_multipliers
    moduli = np.log(np.abs(values[np.abs(values.imag) > 1e-9 * np.abs(values)]))
    return float(moduli[np.abs(moduli).argmin()]) if moduli.size else -1.0


def pair(orbit: Orbit) -> float:
    """Half the logarithm of the product of the two largest moduli.

    As `spiral` where these are a complex pair; it goes on smoothly where the pair becomes real.
    """
    return float(np.log(np.abs(orbit.map_multipliers[:2]) + 1e-300).mean())


def pairs(orbit: Orbit) -> float:
    """∏ (λ_i λ_j − 1) over all pairs of multipliers: zero where a complex pair is on the circle.

    Of several masses, whose pairs may pass the unit circle one after the other. It is zero as well
    where two real multipliers are each other's inverse.
    """
    values = orbit.map_multipliers
    first, second = np.triu_indices(len(values), 1)
    return float(np.prod(values[first] * values[second] - 1.0).real)


def _turns_on_circle(orbit: Orbit) -> bool:
    """Whether a complex pair lies on the unit circle, near enough to be the one that passes."""
    values = orbit.map_multipliers
    turning = np.abs(values[np.abs(values.imag) > 1e-9 * np.abs(values)])
    return bool(turning.size and np.abs(np.log(turning)).min() <= _SMALL)


def _growing(orbit: Orbit) -> int:
    """How many multipliers lie outside the unit circle."""
    return int((np.abs(orbit.map_multipliers) > 1.0).sum())


def minus_one(orbit: Orbit) -> float:
    """det(M − I) of an orbit's map: zero where an eigenvalue is 1."""
    matrix = orbit.map_derivative
    with np.errstate(all="ignore"):
        return float(np.linalg.det(matrix - np.eye(len(matrix))))


def remembers(orbit: Orbit) -> bool:
    """Whether a bumper's deformation outlives a period, as far as the section shows it.

    It does not show it where it lies in a contact with that bumper. If none outlives a period,
    the product of the other two multipliers is that of the damping, at most 1, and no pair passes
    the unit circle (docs/theory.md, 6.5).
    """
    return bool((np.abs(orbit.map_multipliers[2:3]) > _MEMORY).any())


def find(stations: list[Station], *, turning: bool = False) -> Iterator[Bifurcation]:
    """Bifurcations on a branch, in its order; between stations of one smooth piece.

    With `turning`, of those between two orbits only the ones at which the branch turns back.
    """
    for here, there in itertools.pairwise(_between_folds(stations)):
        if here.orbit.section.family.phase != there.orbit.section.family.phase:
            continue  # one orbit, seen at two sections
        if here.piece != there.piece:
            # Followed backwards, the grazing orbit comes second.
            exact, other = (here, there) if here.grazing else (there, here)
            yield Bifurcation(
                GRAZING,
                exact.orbit,
                exact.arclength,
                bool(here.tangent[VALUE] * there.tangent[VALUE] < 0.0),
                other.orbit.contacts,
            )
            continue
        met = parent(here.orbit, there.orbit)
        for kind, function in _tests(here)[: 1 if turning else None]:
            if kind == FOLD:  # the tangents are known
                first, second = float(here.tangent[VALUE]), float(there.tangent[VALUE])
            else:
                first, second = function(here.orbit), function(there.orbit)
            # A zero at the end belongs to the next step.
            turns = kind == FOLD and met is not None
            if not (turns or first * second < 0.0 or (first == 0.0 and second != 0.0)):
                continue
            several = here.orbit.section.family.of_several_masses
            if kind == NEIMARK and not several and -1.0 in (first, second):
                continue  # a pair became complex; see `_pair_beside_real_ones`
            rounded = min(abs(first), abs(second)) <= _CERTAIN and not remembers(here.orbit)
            if kind == NEIMARK and rounded:
                continue  # only rounding passes the unit circle
            if kind == FOLD and met is not None:
                # The branch turns where it meets that of the motions which it left.
                kind, orbit = BREAKING if met.section.mirror else DOUBLING, met
                arclength = 0.5 * (here.arclength + there.arclength)
            else:
                orbit, arclength = _locate(here, there, function)
            if kind == NEIMARK and several and not _turns_on_circle(orbit):
                continue  # two real multipliers, one on each side of the circle
            yield Bifurcation(kind, orbit, arclength, turns or kind == FOLD, orbit.contacts)
        if not turning and (crossed := _pair_beside_real_ones(here, there)) is not None:
            yield crossed
        if not turning and met is None and (crossed := _branching(here, there)) is not None:
            yield crossed


def _pair_beside_real_ones(here: Station, there: Station) -> Bifurcation | None:
    """Where a complex pair passes the unit circle in a step at an end of which it is real."""
    if here.orbit.section.family.of_several_masses:
        return None  # `pairs` finds it
    if -1.0 not in (spiral(here.orbit), spiral(there.orbit)):
        return None
    if abs(_growing(here.orbit) - _growing(there.orbit)) != 2:
        return None
    orbit, arclength = _locate(here, there, pair)
    if abs(spiral(orbit)) > _SMALL:
        return None  # two real multipliers, one on each side of the circle
    return Bifurcation(NEIMARK, orbit, arclength, False, orbit.contacts)


def _branching(here: Station, there: Station) -> Bifurcation | None:
    """Where a multiplier passes 1 between two orbits though the branch does not turn, if it does.

    An orbit may be its own mirror image where the rig is not: it does not reach the stops.
    """
    ends = minus_one(here.orbit), minus_one(there.orbit)
    if ends[0] * ends[1] >= 0.0 or min(abs(end) for end in ends) < _CERTAIN:
        return None
    if here.tangent[VALUE] * there.tangent[VALUE] <= 0.0:
        return None
    orbit, arclength = _locate(here, there, minus_one)
    own = _own_image(orbit)
    kind = BRANCHING if own is None else BREAKING
    return Bifurcation(kind, own or orbit, arclength, False, orbit.contacts)


def _own_image(near: Orbit) -> Orbit | None:
    """The orbit that is its own mirror image, at its symmetry breaking near an orbit, if any.

    As a fixed point of the map over half a period and the mirror it is regular there.
    """
    section = near.section
    if section.mirror or section.count % 2 == 0 or any(near.contacts):
        return None
    if not section.family.excitation.half_wave:
        return None
    half, mode = section.with_map(section.count, mirror=True), near.mode

    def at(value: float) -> Orbit | None:
        point = near.point.copy()
        point[VALUE] = value
        status, orbit = corrected(half, point, mode)
        away = section.scaled(orbit.point - near.point)
        close = np.linalg.norm(away) <= _MIRRORS
        return orbit if status is Status.DONE and close and not any(orbit.contacts) else None

    step = 1e-6 * section.scale[VALUE]
    first, second = at(near.value), at(near.value + step)
    if first is None or second is None:
        return None
    rise = half_plus(second) - half_plus(first)
    exact = at(near.value - half_plus(first) * step / rise) if rise else None
    if exact is None:
        return None
    # With the derivative over the whole period, as the other orbits of the branch.
    status, whole, _ = evaluated(section, exact.point, mode)
    return whole if status is Status.DONE else None


def unexplained(
    stations: list[Station], bifurcations: list[Bifurcation]
) -> list[tuple[float, float]]:
    """Values of the parameter between which stability changes though no bifurcation is found."""
    listed = [one.arclength for one in bifurcations]
    changes = []
    for here, there in itertools.pairwise(stations):
        if here.orbit.stable == there.orbit.stable or here.piece != there.piece:
            continue  # a grazing explains the change from piece to piece
        if _on_unit_circle(here.orbit) or _on_unit_circle(there.orbit):
            continue  # as without damping: rounding alone decides which it is
        low, high = sorted((here.arclength, there.arclength))
        if not any(low - _CERTAIN <= one <= high + _CERTAIN for one in listed):
            changes.append((here.orbit.value, there.orbit.value))
    return changes


def _on_unit_circle(orbit: Orbit) -> bool:
    """Whether the largest multiplier lies on the unit circle, to rounding."""
    return bool(abs(np.abs(orbit.map_multipliers[0]) - 1.0) <= _CERTAIN)


def _between_folds(stations: list[Station]) -> Iterator[Station]:
    """A branch with an orbit more wherever it turns twice within a step, as beside a cusp."""
    for here, there in itertools.pairwise(stations):
        yield here
        ends, step = (
            (float(here.tangent[VALUE]), float(there.tangent[VALUE])),
            there.arclength - here.arclength,
        )
        if here.piece != there.piece or ends[0] * ends[1] <= 0.0 or not step > 0.0:
            continue
        (_, fold), *_ = _tests(here)
        mean = (there.orbit.value - here.orbit.value) / here.orbit.section.scale[VALUE] / step
        met = between_zeros(ends, mean, step, partial(solved, here), fold)
        if met is not None:
            tangent = met[0].tangent(here.tangent)
            yield Station(met[0], tangent, here.arclength + met[1], here.piece)
    yield from stations[-1:]


def _tests(here: Station) -> list[tuple[str, Callable[[Orbit], float]]]:
    along = here.tangent
    doubling = BREAKING if here.orbit.section.mirror else DOUBLING
    return [
        (FOLD, lambda orbit: float(orbit.tangent(along)[VALUE])),
        (doubling, half_plus),
        (NEIMARK, pairs if here.orbit.section.family.of_several_masses else spiral),
    ]


def _locate(
    here: Station, there: Station, function: Callable[[Orbit], float]
) -> tuple[Orbit, float]:
    """The orbit at which a test function vanishes, and its arclength.

    From either end; where neither reaches it, the end at which the function is smaller.
    """
    largest = max(abs(function(here.orbit)), abs(function(there.orbit)))
    back = replace(there, tangent=-there.tangent)
    ends = [(here, there, 1.0), (back, here, -1.0)]
    for start, end, sense in ends:
        chord = start.orbit.section.scaled(end.orbit.point - start.orbit.point)
        length = float(chord @ start.tangent)
        if length <= 0.0:
            continue
        zero = zero_within(start.orbit, length, partial(solved, start), function)
        if zero is not None and abs(function(zero[0])) <= _SMALL * largest:
            return zero[0], start.arclength + sense * zero[1]
    nearest = min((here, there), key=lambda station: abs(function(station.orbit)))
    return nearest.orbit, nearest.arclength


def own_mirror(orbit: Orbit) -> bool:
    """Whether an orbit is its own mirror image, half a period later."""
    section = orbit.section
    if not section.family.symmetric or section.count % 2 == 0:
        return False
    return is_fixed(section.with_map(section.count, mirror=True), orbit)


def bifurcating_orbits(bifurcation: Bifurcation) -> Iterator[Station]:
    """Orbits on the branches that a symmetry breaking or a period doubling gives birth to.

    One station of each pair: the other is its mirror image, or itself a period later.
    """
    section = bifurcation.orbit.section
    if bifurcation.kind == BREAKING and section.mirror:
        target = section.with_map(section.count, mirror=False)
    elif bifurcation.kind == DOUBLING:
        target = section.with_map(2 * section.count, mirror=section.mirror)
    else:
        return
    values, vectors = np.linalg.eig(bifurcation.orbit.carried.T)
    vector = np.real(vectors[:, np.argmin(np.abs(values + 1.0))]) / section.scale[:VALUE]
    normal = np.append(vector, 0.0)
    size = float(np.linalg.norm(normal * section.seen))
    if not size > 0.0:
        return  # only a bumper's deformation would differ
    normal /= size
    for distance in _OFF:
        point = bifurcation.orbit.point + distance * normal * section.scale
        status, orbit = corrected(target, point, bifurcation.orbit.mode, normal)
        if status is not Status.DONE:
            continue
        away = section.scaled(orbit.point - bifurcation.orbit.point)
        # It must not have slid back to the orbit that was there before, nor to another such one.
        if 0.3 * distance <= np.linalg.norm(away) <= 30.0 * distance and not is_of_simpler_map(
            orbit
        ):
            yield Station(orbit, orbit.tangent(normal), 0.0, 0)
            return


def with_critical(stations: list[Station], bifurcations: list[Bifurcation]) -> list[Station]:
    """A branch with the orbits of its bifurcations among the others, where they belong."""
    added = [
        Station(b.orbit, np.zeros(len(b.orbit.point)), b.arclength, -1, critical=True)
        for b in bifurcations
        if b.kind != GRAZING
    ]
    merged = sorted([*stations, *added], key=lambda station: station.arclength)
    piece = stations[0].piece
    whole = []
    for station in merged:
        piece = piece if station.critical else station.piece
        whole.append(replace(station, piece=piece))
    return whole


def joined(backward: list[Station], forward: list[Station]) -> list[Station]:
    """Both directions of a branch from one orbit as one list, in the sense of the second."""
    turned = [
        Station(s.orbit, -s.tangent, -s.arclength, -s.piece, s.grazing) for s in reversed(backward)
    ]
    return turned[:-1] + forward
