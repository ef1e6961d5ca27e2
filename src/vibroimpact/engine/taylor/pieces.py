"""A stretch as polynomials: a Taylor step is cut in two, each half a series about its middle.

They look as those from tables (`linear.pieces`): 12 terms in y = (t − t_middle) / half a step,
|y| ≤ 1/2, right to rounding, so that whoever asks a motion for something asks both alike. Forces
and accelerations of a piece are written beside its series, which they leave alone.
"""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.forcing.dispatch import pace, turn, turned, value
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import RATE, RESTING, SCALED_W, H
from vibroimpact.engine.linear.window_bounds import ANYWHERE, Enclosed
from vibroimpact.engine.memory import beyond
from vibroimpact.engine.motion import LEFT, Motion, changed, facing, main_stop, pack, unpacked
from vibroimpact.engine.one_mass.record_layout import ACCELERATION, BLOCK, MEMORY, VELOCITY
from vibroimpact.engine.series.events import PIECES, shifted
from vibroimpact.engine.series.kernels import SLOPES, run
from vibroimpact.engine.series.layout import (
    ASKED,
    DEGREE,
    HEADER,
    NUMBERS_UNIT,
    PUSH,
    ROOM,
    SHAKEN,
    SLOT,
    X,
    Z,
)
from vibroimpact.engine.series.step_control import at, hold_still, scale, shake, write_header
from vibroimpact.engine.series.values import Frame
from vibroimpact.engine.state import Clock
from vibroimpact.engine.stops.curved import curved_stop
from vibroimpact.engine.stops.kelvin_voigt import relaxed_faces
from vibroimpact.engine.stops.places import total_gap
from vibroimpact.engine.stops.rigid import resting
from vibroimpact.engine.taylor.mode_forces import acceleration_of, frame_of, stands, way_of
from vibroimpact.engine.taylor.step_setup import ahead_of, branched, stepped_on, varies

_SMALL = 0.4  # rad, over which `turn` is right to rounding


class Cursor(NamedTuple):
    """Where on a stretch a piece lies.

    A step begins `t` seconds behind the stretch's start, with the motion `start`, and takes
    `step` seconds; the piece is its half `i`; `table` is where its header stands.
    """

    table: int
    i: int
    length: float
    t: float
    step: float
    start: Motion


@kernel
def coordinate(plan: Vector, motion: Motion) -> float:
    """The mode's own coordinate; without a dashpot's memory it follows from the displacement."""
    if not motion.mode:
        return motion.u
    stop = main_stop(motion.mode)
    at = par.stop_at(stop)
    if plan[at + par.KIND] == par.KELVIN_VOIGT:
        return motion.faces[stop]
    x: float = facing(stop) * motion.u - plan[at + par.GAP]
    return x


@kernel
def displacement(plan: Vector, mode: int, x: float) -> float:
    """The displacement of the mass from the mode's own coordinate."""
    frame = frame_of(plan, mode)
    return frame.sign * (x + frame.offset) if mode else x


@kernel
def begun(plan: Vector, motion: Motion, longest: float) -> tuple[Frame, float]:
    """Write the series of the step that begins with this motion; return its frame and length."""
    frame = frame_of(plan, motion.mode)
    x = coordinate(plan, motion)
    z = frame.sign * motion.z
    held = stands(plan, motion)
    matters, anew = branched(plan, motion), varies(plan, motion.mode)
    ahead = ahead_of(plan, motion, frame, x, longest, matters, anew)
    if held:
        length = min(longest, 1.0 / max(pace(plan), 1e-300))
        hold_still(plan, frame, x, z, motion.clock, length)
    else:
        unit = ahead.unit
        v = frame.sign * motion.v * unit
        h, _ = stepped_on(plan, motion.clock, x, v, z, ahead, longest / unit)
        length = h * unit
        scale(plan, h, plan[par.HYSTERETIC] != 0.0)
        shake(plan, frame.sign, motion.clock, length, SHAKEN)
        load = frame.load - ahead.way * plan[par.FRICTION]
        plan[SHAKEN] += load * length * length
    write_header(plan, length / PIECES, motion.mode == LEFT)
    plan[HEADER + RESTING] = 1.0 if held else 0.0
    return frame, length


@kernel
def clock_at(plan: Vector, clock: Clock, y: float) -> Clock:
    """The clock y pieces after the step's start."""
    angle = plan[HEADER + SCALED_W] * y
    if abs(angle) < _SMALL:
        return turn(plan, clock[0], clock[1], angle)
    return turned(plan, clock[0], clock[1], y * plan[HEADER + H])


@kernel
def at_coordinate(plan: Vector, motion: Motion, x: float) -> Motion:
    """The same motion with the mass where the mode's own coordinate says."""
    mode, fresh, _, v, faces, z, age, clock = motion
    u = displacement(plan, mode, x)
    for stop in range(2):
        at = par.stop_at(stop)
        if mode >> stop & 1 and plan[at + par.KIND] == par.KELVIN_VOIGT:
            faces = changed(faces, stop, x if stop == main_stop(mode) else -u - plan[at + par.GAP])
    return Motion(mode, fresh, u, v, faces, z, age, clock)


@kernel
def motion_at(plan: Vector, start: Motion, frame: Frame, y: float) -> Motion:
    """The motion at the share y of the step, nothing having happened on the way."""
    mode, _, _, _, faces, z, age, clock = start
    x, slope = at(plan, X, y)
    v = frame.sign * slope * (plan[HEADER + RATE] / PIECES)
    if plan[par.HYSTERETIC] != 0.0:
        z, _ = at(plan, Z, y)
        z *= frame.sign
    t = y * PIECES * plan[HEADER + H]
    faces = relaxed_faces(plan, mode, faces, t)
    clock = clock_at(plan, clock, y * PIECES)
    return at_coordinate(plan, Motion(mode, 0, 0.0, v, faces, z, age + t, clock), x)


@kernel
def window(plan: Vector, motion: Motion, length: float, t: float) -> Cursor:
    """The first piece of the step that begins t seconds behind the stretch's start."""
    _, step = begun(plan, motion, length - t) if t < length else (frame_of(plan, 0), 0.0)
    return Cursor(HEADER, 0, length, t, step, motion)


@kernel
def begin(plan: Vector, motion: Motion, length: float) -> Cursor:
    """The first piece of the stretch of so many seconds that starts with this motion."""
    return window(plan, motion, length, 0.0)


@kernel
def has_piece(plan: Vector, cursor: Cursor) -> bool:
    """Whether there is a piece here."""
    return cursor.t < cursor.length


@kernel
def following_window(plan: Vector, cursor: Cursor) -> Cursor:
    """The first piece of the next step."""
    _, _, length, t, step, start = cursor
    behind = motion_at(plan, start, frame_of(plan, start.mode), 1.0)
    t = t + step if t + step < length * (1.0 - 1e-15) else length
    return window(plan, behind, length, t)


@kernel
def next_piece(plan: Vector, cursor: Cursor) -> Cursor:
    """The next piece."""
    table, i, length, t, step, start = cursor
    if i + 1 < PIECES:
        return Cursor(table, i + 1, length, t, step, start)
    return following_window(plan, cursor)


@kernel
def write_cursor(plan: Vector, cursor: Cursor, buffer: Vector) -> None:
    """Write a cursor into memory; the step's series stay in the plan."""
    table, i, length, t, step, start = cursor
    buffer[0], buffer[1], buffer[2], buffer[3], buffer[4] = table, i, length, t, step
    pack(start, beyond(buffer, 5))


@kernel
def read_cursor(plan: Vector, buffer: Vector) -> Cursor:
    """The cursor that was written."""
    start = unpacked(beyond(buffer, 5))
    return Cursor(int(buffer[0]), int(buffer[1]), buffer[2], buffer[3], buffer[4], start)


@kernel
def bound_window(
    plan: Vector, cursor: Cursor, before: Motion, seen: Enclosed, buffer: Vector
) -> tuple[bool, Enclosed]:
    """Nothing is computed ahead, because a piece's series is known already."""
    return False, seen


@kernel
def enclosed(plan: Vector, cursor: Cursor, buffer: Vector) -> Enclosed:
    """Bounds on a piece: none."""
    return ANYWHERE


@kernel
def expanded(plan: Vector, cursor: Cursor, series: Vector) -> tuple[float, float, float]:
    """Write the series of x; return how far the piece reaches, and the phasor in its middle."""
    shifted(plan, X, 2 * cursor.i + 1, series)
    s, c = clock_at(plan, cursor.start.clock, cursor.i + 0.5)
    if cursor.start.mode == LEFT:
        s, c = -s, -c
    return 0.5, s, c


@kernel
def facing_of(mode: int, stop: int) -> float:
    """−1 where a stop's deformation falls with the mode's own coordinate: the left one of both."""
    return 1.0 if stop == main_stop(mode) else -1.0


@kernel
def push_series(plan: Vector, mode: int, stop: int) -> None:
    """Write the force per unit mass of the pressed bumper on a side, over the step, to ASKED."""
    way = facing_of(mode, stop)
    at = par.stop_at(stop)
    stiffness = plan[at + par.BUMPER_STIFFNESS]
    damping = plan[at + par.BUMPER_DAMPING] * (plan[HEADER + RATE] / PIECES)
    for n in range(DEGREE):
        moved = stiffness * plan[X + n] + damping * ((n + 1) * plan[X + n + 1])
        plan[ASKED + n] = way * moved
    if way < 0.0:
        plan[ASKED] -= stiffness * total_gap(plan)
    plan[ASKED + DEGREE] = 0.0


@kernel
def sloped(plan: Vector, length: float) -> None:
    """Write the slopes of the forces and what stops push with, on the step in hand (s long)."""
    for n in range(2 * ROOM):
        plan[PUSH + n] = 0.0  # of stops that are left out
    slot = int(plan[SLOT])
    run(plan, slot + SLOPES, 0.0, 0.0, 0.0, 0.0, length / plan[NUMBERS_UNIT], 0.0, 0.0)


@kernel
def power_series(plan: Vector, cursor: Cursor, stop: int) -> None:
    """As `push_series`, of a stop that follows a power: nothing where its push is left out."""
    sloped(plan, cursor.step)
    way = facing_of(cursor.start.mode, stop)
    pushes = PUSH if way > 0.0 else PUSH + ROOM
    for n in range(DEGREE + 1):
        plan[ASKED + n] = plan[pushes + n] / (cursor.step * cursor.step)


@kernel
def expanded_force(plan: Vector, cursor: Cursor, mode: int, stop: int, series: Vector) -> None:
    """Write the series of what the pressed stop on a side pushes with, per unit mass."""
    if curved_stop(plan, stop):
        power_series(plan, cursor, stop)
    else:
        push_series(plan, mode, stop)
    shifted(plan, ASKED, 2 * cursor.i + 1, series)


@kernel
def moment(plan: Vector, cursor: Cursor, before: Motion, x: float, v: float, y: float) -> Motion:
    """The motion at y of a piece, whose coordinate is x and whose velocity is v; not its clock."""
    mode, _, _, _, faces, z, age, clock = before
    if plan[par.HYSTERETIC] != 0.0:
        z, _ = at(plan, Z, (cursor.i + 0.5 + y) / PIECES)
        z = -z if mode == LEFT else z
    return at_coordinate(plan, Motion(mode, 0, 0.0, v, faces, z, age, clock), x)


@kernel
def accelerated(plan: Vector, cursor: Cursor, s: float, c: float, series: Vector) -> float:
    """Replace the series of x by that of the absolute acceleration; return its unit, 1/step².

    ü + A_t on a base that moves, ü on one that stands still; at rest it is that of the base.
    """
    shaking = plan[par.BASE]
    frame = frame_of(plan, cursor.start.mode)
    load = frame.load
    if plan[par.FRICTION] != 0.0 and plan[HEADER + RESTING] == 0.0:
        load -= frame.sign * way_of(plan, cursor.start) * plan[par.FRICTION]
    square = 1.0 / (plan[HEADER + RATE] / PIECES) ** 2
    for n in range(DEGREE - 1):
        plan[ASKED + n] = (n + 1) * (n + 2) * plan[X + n + 2] - shaking * plan[SHAKEN + n]
    plan[ASKED] += shaking * load * square
    plan[ASKED + DEGREE - 1] = 0.0
    plan[ASKED + DEGREE] = 0.0
    shifted(plan, ASKED, 2 * cursor.i + 1, series)
    return 1.0 / square  # type: ignore[no-any-return]


@kernel
def acceleration(plan: Vector, motion: Motion) -> float:
    """Absolute acceleration of the mass, in the direction of u."""
    s, c = motion.clock
    base: float = plan[par.BASE] * value(plan, s, c)
    if resting(plan, motion.mode):
        return base
    return acceleration_of(plan, motion) + base


@kernel
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
    """See `motions.sample_stretch`; `series` is not needed."""
    frame = frame_of(plan, before.mode)
    for j in range(n):
        tau = max((i + j) * step - t, 0.0)
        while tau >= cursor.t + cursor.step and cursor.t + cursor.step < cursor.length:
            cursor = following_window(plan, cursor)
        y = (tau - cursor.t) * (plan[HEADER + RATE] / PIECES)
        here = motion_at(plan, cursor.start, frame, y)
        buffer[j], buffer[VELOCITY * BLOCK + j] = coordinate(plan, here), frame.sign * here.v
        buffer[ACCELERATION * BLOCK + j] = frame.sign * acceleration(plan, here)
        buffer[MEMORY * BLOCK + j] = here.z
    return cursor
