# mypy: disable-error-code="empty-body"
"""Motions and disturbances, whichever flow carries the mass: a stretch is followed in pieces.

On a piece the coordinate x of the mode is a series in y, from -1/2 to 1/2 of the piece's step. A
flow has a `Cursor` of its own, which says where on a stretch a piece lies.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from vibroimpact.engine.dispatch import by_laws
from vibroimpact.engine.jit import Vector
from vibroimpact.engine.linear import advance, contact_free, pieces, tables, window_bounds
from vibroimpact.engine.linear import carry as linear_carry
from vibroimpact.engine.linear.window_bounds import Enclosed
from vibroimpact.engine.motion import Motion, Stretch
from vibroimpact.engine.state import Clock
from vibroimpact.engine.taylor import carry as taylor_carry
from vibroimpact.engine.taylor import pieces as steps
from vibroimpact.engine.taylor import plan as taylor
from vibroimpact.engine.yielding import plan as yielding

Cursor: TypeAlias = Any


@by_laws(tables.build, taylor.build, yielding.build)
def build(plan: Vector, amplitude: float, omega: float) -> None:
    """Make the plan for one forcing: its size (m/s², m or N) and ω (rad/s)."""


@by_laws(advance.too_much_work, taylor.too_much_work)
def too_much_work(plan: Vector, period: float) -> bool:
    """Whether one cycle takes too many steps."""


@by_laws(contact_free.undisturbed, taylor.undisturbed)
def undisturbed(
    plan: Vector, motion: Motion, clock: Clock, dying: float
) -> tuple[bool, float, float, float, Motion]:
    """Free flight that touches nothing any more, if it is known without following it.

    Returns
    -------
    is_flight, displacement, acceleration, transmitted, motion
        Half the excursions (m, m/s²) of displacement, of the mass's absolute acceleration and of
        the transmitted force per unit mass, and the motion at the section.
    """


@by_laws(pieces.begin, steps.begin)
def begin(plan: Vector, motion: Motion, length: float) -> Cursor:
    """The first piece of the stretch of so many seconds that starts with this motion."""


@by_laws(pieces.has_piece, steps.has_piece)
def has_piece(plan: Vector, cursor: Cursor) -> bool:
    """Whether there is a piece here."""


@by_laws(pieces.next_piece, steps.next_piece)
def next_piece(plan: Vector, cursor: Cursor) -> Cursor:
    """The next piece."""


@by_laws(pieces.write_cursor, steps.write_cursor)
def write_cursor(plan: Vector, cursor: Cursor, buffer: Vector) -> None:
    """Write a cursor into memory, of at most `channels.CURSOR_SIZE` numbers."""


@by_laws(pieces.read_cursor, steps.read_cursor)
def read_cursor(plan: Vector, buffer: Vector) -> Cursor:
    """The cursor that was written."""


@by_laws(window_bounds.bound_window, steps.bound_window)
def bound_window(
    plan: Vector, cursor: Cursor, before: Motion, seen: Enclosed, buffer: Vector
) -> tuple[bool, Enclosed]:
    """Whether the pieces from here on lie within what was seen, as far as that is easily known.

    The cursor is at the first piece of a window.

    Returns
    -------
    within, seen
        Of the pieces that were checked, whether all do; if not, what was seen, widened.
    """


@by_laws(window_bounds.enclosed, steps.enclosed)
def enclosed(plan: Vector, cursor: Cursor, buffer: Vector) -> Enclosed:
    """Bounds on the piece, by what `bound_window` has noted."""


@by_laws(pieces.expanded, steps.expanded)
def expanded(plan: Vector, cursor: Cursor, series: Vector) -> tuple[float, float, float]:
    """Write the series of x; return how far the piece reaches, and the clock in its middle."""


@by_laws(pieces.expanded_force, steps.expanded_force)
def expanded_force(plan: Vector, cursor: Cursor, mode: int, stop: int, series: Vector) -> None:
    """Write the series of what a pressed stop pushes with, per unit mass."""


@by_laws(pieces.accelerated, steps.accelerated)
def accelerated(plan: Vector, cursor: Cursor, s: float, c: float, series: Vector) -> float:
    """Turn the series of x into that of the absolute acceleration; return its unit, 1/step².

    The clock s, c is that in the piece's middle.
    """


@by_laws(pieces.moment, steps.moment)
def moment(plan: Vector, cursor: Cursor, before: Motion, x: float, v: float, y: float) -> Motion:
    """The motion at y of a piece, whose coordinate is x and whose velocity is v; not its clock."""


@by_laws(pieces.sample_stretch, steps.sample_stretch)
def sample_stretch(
    plan: Vector,
    cursor: Cursor,
    before: Motion,
    t: float,
    step: float,
    i: int,
    n: int,
    series: Vector,
    buffer: Vector,
) -> Cursor:
    """Write the motion at n instants, not before where the cursor is; return where they end.

    Parameters
    ----------
    before
        The motion at the stretch's start, which is at the time t (s).
    step, i
        The first instant is the time i · step (s), and they are a step apart.
    series, buffer
        Written: the mode's own coordinate and its rate, the absolute acceleration as they are seen,
        and what the isolator remembers if it does, each in its row of
        `record_layout.samples`, the first in row 0.
    """


@by_laws(pieces.coordinate, steps.coordinate)
def coordinate(plan: Vector, motion: Motion) -> float:
    """The mode's own coordinate x."""


@by_laws(pieces.displacement, steps.displacement)
def displacement(plan: Vector, mode: int, x: float) -> float:
    """The displacement of the mass from it (m)."""


@by_laws(pieces.acceleration, steps.acceleration)
def acceleration(plan: Vector, motion: Motion) -> float:
    """Absolute acceleration of the mass, in the direction of u."""


@by_laws(linear_carry.carry, taylor_carry.carry)
def carry(plan: Vector, stretch: Stretch, q: Vector, rows: int) -> float:
    """Carry disturbances (rows of q) through a stretch and the event that ends it.

    Returns
    -------
    float
        The integral of minus the divergence of (u, u̇) and of what the isolator remembers, impacts
        included.
    """
