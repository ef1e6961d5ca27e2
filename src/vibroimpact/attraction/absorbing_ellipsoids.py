"""Ellipsoids around a periodic motion that no motion leaves again.

Near a stable fixed point x of the map P over the period there is a norm in which P contracts; in it
balls are traps. A ball of radius r is taken as long as on its surface, and on those of all smaller
ones that are checked, P brings each point nearer to x: what is in the plane inside the image of a
circle stays inside, for P is continuous and one to one there. The first circle on which a point is
not brought nearer ends it (docs/decisions/0015-basins.md).

Where the section falls into the contact with a stop whose force depends on the speed at which it
was met, that speed is one more component, and all of the ball is pressed.
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import NDArray

from vibroimpact.attraction.label_states import SectionSetup, images
from vibroimpact.attraction.section_coordinates import met, remembered
from vibroimpact.engine.absorption import CENTRE, OWNER, REACH, form_of, trap_width
from vibroimpact.engine.state import ONE_MASS

_Array = NDArray[np.float64]

_TRAP = trap_width(ONE_MASS.total)
_SMALLEST = 1e-6
"""Of the motion's size: the first radius; where P is not linear to so near, no trap is made."""
_GROWTH = 1.15
"""From one radius to the next."""
_LARGEST = 1e3
"""Of the motion's size."""
_AROUND = 256
"""Points on a circle."""
_ON_SPHERE = 600
"""Points on a sphere of more dimensions."""
_NEARER = 0.999
"""Of the radius: how near each image must be, with a tenth of the way to its neighbours."""
_SLACK = 0.9
"""The same where points have no neighbours."""
_DIFFERENCE = 1e-7
"""Of the motion's size, by which P is differentiated."""
_SLOWEST = 0.9999
"""Spectral radius of P's derivative above which no norm is sought."""


def ellipsoids(stage: SectionSetup, points: _Array, size: float, owner: int) -> _Array:
    """A trap around each point of a periodic motion that has one.

    Parameters
    ----------
    points
        u, u̇, u_R, u_L, z at the sections of one period, the deformations away from the mass.
    size
        Of the motion (m).

    Returns
    -------
    ndarray, shape (traps, absorption.trap_width(parts))
    """
    parts = remembered(stage)
    if (points[:, 2:4] > 0.0)[:, parts[2:4]].any():
        return np.empty((0, _TRAP))  # what is pressed at the section has no deformation of its own
    omega = stage.excitation.angular_frequency
    rows = []
    for point in points:
        speeds = met(stage, point)
        kept = np.flatnonzero(parts | speeds)
        unit = np.where(speeds, omega, [1.0, omega, 1.0, 1.0, 1.0])[kept] * size
        # How far a ball may reach until some of it is not pressed.
        free = np.full(len(kept), np.inf)
        free[speeds[kept]] = point[kept][speeds[kept]]
        for side in np.flatnonzero(speeds[2:4]):
            free[0] = _depth(stage, point[0], int(side))
        row = _ellipsoid(
            stage, np.where(parts | speeds, point, 0.0), kept, unit, free / unit, len(points), owner
        )
        if row is not None:
            rows.append(row)
    return np.array(rows).reshape(-1, _TRAP)


def _depth(stage: SectionSetup, u: float, side: int) -> float:
    """How deep a mass presses a stop, 0 being the right one (m)."""
    stops = stage.oscillator.right, stage.oscillator.left
    stop = stops[side]
    assert stop is not None
    return (u if side == 0 else -u) - stop.gap


def _ellipsoid(
    stage: SectionSetup,
    point: _Array,
    kept: NDArray[np.int64],
    unit: _Array,
    free: _Array,
    period: int,
    owner: int,
) -> _Array | None:
    """The largest ball around one point in a norm in which P contracts; None if there is none."""

    def mapped(offsets: _Array) -> tuple[_Array, bool]:
        begun = np.tile(point, (len(offsets), 1))
        begun[:, kept] += offsets * unit
        image_points, known = images(stage, begun, period)
        return (image_points[:, kept] - point[kept]) / unit, bool(known.all())

    eye = _DIFFERENCE * np.eye(len(kept))
    ahead, there = mapped(np.vstack([eye, -eye]))
    slope = (ahead[: len(kept)] - ahead[len(kept) :]).T / (2.0 * _DIFFERENCE)
    largest = float(np.abs(np.linalg.eigvals(slope)).max()) if there else np.inf
    if not largest < _SLOWEST:
        return None
    # The norm's unit ball is mapped into `share` of itself where P is linear.
    share = max(np.sqrt(largest), 0.5)
    form = scipy.linalg.solve_discrete_lyapunov((slope / share).T, np.eye(len(kept)))
    root = np.linalg.cholesky(form).T  # |root x| is the norm
    sphere = _sphere(len(kept))
    around = sphere @ np.linalg.inv(root).T
    reach = np.sqrt(np.diag(np.linalg.inv(form)))
    most = min(_LARGEST, float((free / reach).min()))
    radius, held = _SMALLEST, 0.0
    while radius < most:
        image, there = mapped(radius * around)
        if not there or not _nearer(image @ root.T / radius, ordered=len(kept) == 2):
            break
        held, radius = radius, radius * _GROWTH
    if not held:
        return None
    parts = len(point)
    row = np.zeros(_TRAP)
    row[OWNER], row[CENTRE : form_of(parts)] = owner, point
    metric = np.zeros((parts, parts))
    metric[np.ix_(kept, kept)] = form / held**2 / np.outer(unit, unit)
    row[form_of(parts) :] = metric.ravel()
    row[REACH] = held * unit[0] * reach[0] * (1.0 + 1e-12)
    return row


def _nearer(images: _Array, ordered: bool) -> bool:
    """Whether the images of a unit sphere lie within it."""
    distance = np.linalg.norm(images, axis=1)
    if not ordered:
        return bool(distance.max() <= _SLACK)
    # Between two neighbours the image of the circle bulges, by far less where it is smooth.
    gap = np.linalg.norm(images - np.roll(images, 1, axis=0), axis=1)
    return bool((np.maximum(distance, np.roll(distance, 1)) + 0.1 * gap <= _NEARER).all())


def _sphere(dimension: int) -> _Array:
    """Points on the unit sphere; in the plane one after the other."""
    if dimension == 2:
        angles = np.linspace(0.0, 2.0 * np.pi, _AROUND, endpoint=False)
        return np.column_stack([np.cos(angles), np.sin(angles)])
    points = np.random.default_rng(0).normal(size=(_ON_SPHERE, dimension))
    axes = np.vstack([np.eye(dimension), -np.eye(dimension)])
    return np.vstack([axes, points / np.linalg.norm(points, axis=1, keepdims=True)])
