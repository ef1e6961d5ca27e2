"""Which branch of each curved law holds: two bits of the mode for each row that has branches."""

from __future__ import annotations

from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.jit import Vector, kernel


@kernel
def _bit(plan: Vector, f: int, which: int) -> int:
    branch = int(plan[int(plan[at.LAWS]) + f * of.WIDTH + of.BRANCH])
    return int(plan[at.STOPS]) + which * int(plan[at.BRANCHES]) + branch


@kernel
def way_of_slide(plan: Vector, f: int, mode: int) -> float:
    """The sign of s′ at a row with branches."""
    return -1.0 if mode >> _bit(plan, f, 0) & 1 else 1.0


@kernel
def side_of(plan: Vector, f: int, mode: int) -> float:
    """The other bit of a row with branches as a sign: −1 if it is set."""
    return -1.0 if mode >> _bit(plan, f, 1) & 1 else 1.0


@kernel
def _with(mode: int, bit: int, value: bool) -> int:
    return mode | 1 << bit if value else mode & ~(1 << bit)


@kernel
def with_way(plan: Vector, f: int, mode: int, way: float) -> int:
    """The mode in which s′ has this sign at a row."""
    new_mode: int = _with(mode, _bit(plan, f, 0), way < 0.0)
    return new_mode


@kernel
def with_side(plan: Vector, f: int, mode: int, side: float) -> int:
    """The mode in which a row has this side."""
    new_mode: int = _with(mode, _bit(plan, f, 1), side < 0.0)
    return new_mode
