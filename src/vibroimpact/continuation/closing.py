"""Whether a curve that is followed has come back to a point of it."""

from __future__ import annotations

from vibroimpact.continuation.arclength import Array, P, Path, distance

_NEAR = 2.0  # steps


def crossing(path: Path[P], here: P, there: P, mark: Array, tangent: Array) -> Array | None:
    """Where a step goes, in the mark's own sense, through the plane normal to the curve in a mark.

    It returns if the solution on that plane is the mark; the chord through the two points of the
    step is a guess of it.

    Parameters
    ----------
    path
        What is followed.
    here, there
        The ends of the step.
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
    if not before < 0.0 <= behind:
        return None
    step = distance(path, here.y, there.y)
    if min(distance(path, end.y, mark) for end in (here, there)) > _NEAR * step:
        return None
    guess: Array = here.y + before / (before - behind) * (there.y - here.y)
    return guess
