"""The grazing of a rigid stop: a branch loses an impact there, or gains one.

With the velocity of the impact the map becomes steep like a square root, and Newton's method on
it converges from ever closer only. The branch itself is smooth in w = √depth, where depth is that
to which the impact would go without its stop (`engine.one_mass.margin`), in proportion to the
velocity. With an impact of that velocity, P(z) - z = J δ + k w and the depth is -g δ, so that

    J δ = -k w,  g δ = -w²

is where the branch lies beside the grazing orbit, J and g being taken where there is no impact.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from vibroimpact.engine.status import Status
from vibroimpact.stability.fixed_points import (
    VALUE,
    Orbit,
    corrected,
    evaluated,
    margin_of,
)

_Array = NDArray[np.float64]

_SHALLOW = 1e-4
"""Scaled depth below which an impact is seen to die out."""
_BACK = (0.3, 0.1, 0.03)
"""Steps of w at which the branch is checked on its way to the grazing."""
_ASIDE = (1e-6, 1e-5, 1e-7, 1e-4)
"""Scaled change of the parameter at which the orbit without the impact is sought."""
_CLOSE, _GRAZES = 1e-14, 1e-10
"""Scaled clearance of an orbit that grazes: where the search for it ends, and what it may miss."""
_HALVINGS = 60
_PROBE = 1e-7
_FLAT = 1e-12
_PROBED = (1e-8, 1e-10, 1e-12)
"""Scaled depths at which the map with the impact is evaluated, one after the other. The last impact
of a long chatter changes little, so that the map is steep only close to the grazing."""
_STEEP = 30.0
"""How much steeper than without the impact it must be there."""
_W = (1e-5, 3e-6, 1e-6, 3e-5, 1e-4)
"""Values of w at which the branch with the impact is taken up."""
_GROWN, _FAR = 3.0, 3e-3
"""By which w grows from orbit to orbit, and how far."""


def has_rigid_stop(orbit: Orbit) -> bool:
    """Whether an impact can vanish at all."""
    family = orbit.section.family
    if family.of_several_masses:  # whose branches end at a grazing of a rigid stop
        return False
    return any(stop.rigid for stop in family.oscillator.stops.values())


def fewer(one: Orbit, other: Orbit) -> bool:
    """Whether one orbit has fewer contacts than the other."""
    return sum(one.contacts) < sum(other.contacts)


def at_wall(hit: Orbit, clear: Orbit) -> bool:
    """Whether what one orbit hardly hits, and the other misses, is a rigid stop and no bumper."""
    steep = np.abs(hit.jacobian).max() >= _STEEP * np.abs(clear.jacobian).max()
    return has_rigid_stop(hit) and fewer(clear, hit) and bool(steep)


def dies_out(last: Orbit, earlier: Callable[[float], Orbit | None]) -> tuple[Orbit, float] | None:
    """The orbit without the impact that vanishes, at its grazing, and where it exists.

    `last` has an impact of small velocity; `earlier` returns the orbit so far back on its branch.

    Returns
    -------
    orbit, sense
        The orbit that grazes, and whether the clearance grows with the parameter (1) or falls (-1).
    """
    depth = -margin_of(last)
    if not 0.0 < depth < _SHALLOW:
        return None
    here = math.sqrt(depth)
    for share in _BACK:
        back = [earlier(share * here * times) for times in (1.0, 2.0)]
        if any(one is None or one.contacts != last.contacts for one in back):
            continue
        seen = [last, *(one for one in back if one is not None)]
        w = np.sqrt([max(-margin_of(one), 0.0) for one in seen])
        if not w[0] < w[1] < w[2]:
            return None
        guess = _at([(w[i], one.point) for i, one in enumerate(seen)], 0.0)
        return _clear_of(last, guess, last.point - seen[1].point)
    return None


def _clear_of(last: Orbit, guess: _Array, ahead: _Array) -> tuple[Orbit, float] | None:
    """The orbit without an impact whose clearance vanishes, near a guess, and ahead of the last."""
    section, mode = last.section, last.mode
    for aside in _ASIDE:
        for sense in (1.0, -1.0):
            point = guess + sense * aside * section.held * section.scale
            status, orbit = corrected(section, point, mode)
            if status is Status.DONE and fewer(orbit, last) and margin_of(orbit) > 0.0:
                orbit = _closest(orbit, sense)
                # Of a poor guess both sides may be clear, or it leads to another branch.
                missed, gone, way = (
                    section.scaled(change)
                    for change in (orbit.point - guess, orbit.point - last.point, ahead)
                )
                nearer = missed @ missed < gone @ gone
                if margin_of(orbit) <= _GRAZES and nearer and gone @ way > 0.0:
                    return orbit, sense
    return None


def _closest(clear: Orbit, sense: float) -> Orbit:
    """Go on along the parameter to where the clearance vanishes: by secants from its clear side."""
    section, margin = clear.section, margin_of(clear)
    step = 1e-8 * section.scale[VALUE]  # towards the grazing
    for _ in range(_HALVINGS):
        point = clear.point - sense * step * clear.section.held
        status, orbit = corrected(section, point, clear.mode)
        left = margin_of(orbit) if status is Status.DONE else math.nan
        if not (orbit.contacts == clear.contacts and 0.0 <= left < margin):
            step *= 0.5
            continue
        rise = (margin - left) / step
        clear, margin = orbit, left
        if margin <= _CLOSE:
            break
        step = margin / rise
    return clear


def taken_up(grazing: Orbit) -> tuple[Orbit, _Array] | None:
    """The branch with the impact beside the orbit that grazes, and its tangent."""
    section, mode = grazing.section, grazing.mode
    gradient = _margin_gradient(grazing)
    size = float(gradient @ gradient)
    if not _FLAT < size < 1.0 / _FLAT:
        return None
    for depth in _PROBED:
        point = _beside(grazing, -depth / size * gradient)
        status, hit, image = evaluated(section, point, mode)
        if status is Status.DONE and at_wall(hit, grazing):
            break
    else:
        return None
    kick = (image - point)[:VALUE] / section.scale[:VALUE]
    kick -= grazing.jacobian @ (-depth / size * gradient)
    matrix = np.vstack([grazing.jacobian, gradient])
    try:
        first = np.linalg.solve(matrix, np.append(-kick / math.sqrt(depth), 0.0))
        second = np.linalg.solve(matrix, np.append(np.zeros(len(kick)), -1.0))
    except np.linalg.LinAlgError:
        return None
    along = first / float(np.linalg.norm(first * section.seen))

    def corrected_at(w: float, guess: _Array) -> Orbit | None:
        # The depth, small of second order itself, is what the velocity follows from.
        for _ in range(3):
            status, there, _ = evaluated(section, guess, mode)
            missed = margin_of(there) + w * w if status is Status.DONE else math.inf
            if not abs(missed) < w:
                return None
            guess = guess + _beside(grazing, missed * second) - grazing.point
        status, orbit = corrected(section, guess, mode, along)
        return orbit if status is Status.DONE and orbit.contacts == hit.contacts else None

    orbit = None
    for w in _W:
        orbit = corrected_at(w, _beside(grazing, w * first + w * w * second))
        if orbit is not None:
            break
    if orbit is None:
        return None
    seen = [(0.0, grazing.point)]
    side = _side_of_fold(orbit)
    last, way = orbit, (orbit.point - grazing.point) / section.scale
    # A fold close to the grazing is found later, from orbits on both sides of it.
    while orbit is not None and _side_of_fold(orbit) == side:
        last, way = orbit, (orbit.point - seen[-1][1]) / section.scale
        seen.append((math.sqrt(max(-margin_of(orbit), 0.0)), orbit.point))
        w = _GROWN * seen[-1][0]
        orbit = corrected_at(w, _at(seen[-3:], w)) if 0.0 < w < _FAR else None
    return last, last.tangent(way)


def _side_of_fold(orbit: Orbit) -> float:
    """Sign of det(M − I) of an orbit's map, which changes at a fold."""
    return float(np.sign(np.linalg.det(orbit.map_derivative - np.eye(len(orbit.map_derivative)))))


def _at(seen: Sequence[tuple[float, _Array]], w: float) -> _Array:
    """The polynomial through some points of a branch that is smooth in w."""
    point: _Array = np.zeros(len(seen[0][1]))
    for i, (here, there) in enumerate(seen):
        others = [other for j, (other, _) in enumerate(seen) if j != i]
        point += there * math.prod((w - other) / (here - other) for other in others)
    return point


def _beside(orbit: Orbit, change: _Array) -> _Array:
    """An orbit's point changed by scaled components; what has no scale does not change."""
    scale = orbit.section.scale
    moved = np.multiply(change, scale, out=np.zeros_like(change), where=change != 0.0)
    return orbit.point + moved


def _margin_gradient(orbit: Orbit) -> _Array:
    """How the scaled clearance changes with the point, in scaled components."""
    section, gradient = orbit.section, np.zeros(len(orbit.point))
    for j in np.flatnonzero(section.seen):
        ends = []
        for step in (_PROBE, -_PROBE):
            point = orbit.point.copy()
            point[j] += step * section.scale[j]
            status, there, _ = evaluated(section, point, orbit.mode)
            ends.append(margin_of(there) if status is Status.DONE else math.nan)
        gradient[j] = (ends[0] - ends[1]) / (2.0 * _PROBE)
    return gradient
