"""Whether a curve that is followed has come back to a point of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from vibroimpact.continuation.arclength import Array, P, Path, distance

SAME = 1e-6
"""Scaled distance within which two points are one."""
_NEAR = 2.0  # steps


def returned(
    path: Path[P],
    here: P,
    there: P,
    marks: Iterable[tuple[Array, Array]],
    solved: Callable[[Array, Array], Array | None],
) -> bool:
    """Whether a step passes one of some points of the curve, in its sense.

    Parameters
    ----------
    marks
        Unknowns of the points, and the curve's tangents there.
    solved
        The solution on the plane through a guess normal to a tangent, None if there is none.
    """
    for mark, tangent in marks:
        guess = crossing(path, here, there, mark, tangent)
        solution = None if guess is None else solved(guess, tangent)
        if solution is not None and distance(path, solution, mark) <= SAME:
            return True
    return False


def crossing(path: Path[P], here: P, there: P, mark: Array, tangent: Array) -> Array | None:
    """Where a step goes, in the mark's own sense, through the plane normal to the curve in a mark.

    It returns if the solution on that plane is the mark; the chord through the two points of the
    step is a guess of it.

    Parameters
    ----------
    mark, tangent
        Unknowns of the point that it may return to, and the curve's tangent there.

    Returns
    -------
    ndarray or None
        The guess; None if the step is elsewhere, or goes the other way.
    """
    normal = tangent * path.seen
    before = float((here.y - mark) / path.scale @ normal)
    behind = float((there.y - mark) / path.scale @ normal)
    # From the mark itself the first step only leaves it.
    if not before < -SAME <= behind:
        return None
    step = distance(path, here.y, there.y)
    if min(distance(path, end.y, mark) for end in (here, there)) > _NEAR * step:
        return None
    return here.y + before / (before - behind) * (there.y - here.y)
