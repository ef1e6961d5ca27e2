"""What is observed on a stretch with curved laws; see `assembly.channels`."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.assembly import channels as linear
from vibroimpact.engine.assembly import layout as at
from vibroimpact.engine.assembly.channels import close_stretch, piece_length, pieces
from vibroimpact.engine.assembly.curved import layout as of
from vibroimpact.engine.assembly.curved.advance import reopen
from vibroimpact.engine.assembly.curved.branches import way_of_slide
from vibroimpact.engine.assembly.curved.event_functions import held_force, relative
from vibroimpact.engine.assembly.curved.terms import node, remembers, row_of
from vibroimpact.engine.channels import CLEARANCE, DEFORMATION, FADING, FORCE, RATE, evaluate
from vibroimpact.engine.jit import Vector, kernel, not_inlined
from vibroimpact.engine.memory import beyond

__all__ = ["close_stretch", "open_piece", "open_stretch", "piece_length", "pieces", "value"]

_FRICTION = of.NUMBERS + par.FRICTION

open_stretch = reopen


@kernel
def open_piece(plan: Vector, i: int) -> None:
    """The stretch is one piece, whose series are there."""


@kernel
def open_instant(plan: Vector) -> bool:
    """See `assembly.channels`: which branches hold is found when a motion goes on."""
    return False


@kernel
def _of_link(plan: Vector, channel: int, f: int, out: Vector) -> int:
    """The force of a link, its s in the place of a clearance, its memory in that of a deformation.

    The force pulls the ends together.
    """
    row, order, mode = row_of(plan, f), int(plan[at.ORDER]), int(plan[at.MODE])
    if channel == CLEARANCE:
        relative(plan, f, 0, -1.0, out)
        return order
    for j in range(order + 1):
        out[j] = 0.0
    if channel == DEFORMATION:
        if remembers(plan, row):
            z = node(plan, row, of.Z_NODE, int(plan[at.NODES]))
            for j in range(order + 1):
                out[j] = plan[z + j]
        return order
    if int(plan[row + of.BEHAVIOUR]) == of.FRICTION:
        if mode >> f & 1:
            held, count = held_force(plan, f), int(plan[at.STOPS])
            for j in range(order + 1):
                out[j] = -plan[held + j * count]
        else:
            out[0] = way_of_slide(plan, f, mode) * plan[row + _FRICTION]
    elif plan[row + of.ACTIVE] != 0.0:
        force = node(plan, row, of.FORCE_NODE, int(plan[at.NODES]))
        for j in range(order + 1):
            out[j] = plan[force + j]
    return order


@kernel
def _of_memory(plan: Vector, channel: int, f: int, out: Vector) -> int:
    """A channel of a stop with a memory, which has a face while it is free."""
    row, order, base = row_of(plan, f), int(plan[at.ORDER]), int(plan[at.NODES])
    pressed = int(plan[at.MODE]) >> f & 1 == 1
    gap, added = plan[int(plan[at.STOP]) + f * at.STOP_WIDTH + at.GAP], -1
    for j in range(order + 1):
        out[j] = 0.0
    if channel == FORCE:
        added = node(plan, row, of.FORCE_NODE, base) if pressed else -1
    elif not pressed:
        added = node(plan, row, of.Z_NODE, base)
    if channel == CLEARANCE and not pressed:
        relative(plan, f, 0, -1.0, out)
        out[0] += gap
    elif channel == DEFORMATION and pressed:
        relative(plan, f, 0, 1.0, out)
        out[0] -= gap
    if added >= 0:
        for j in range(order + 1):
            out[j] += plan[added + j]
    return order


@not_inlined
def series(plan: Vector, channel: int, index: int, out: Vector) -> int:
    """Write a channel's power series in τ, 0 to 1 on the piece; returns its order."""
    if channel >= CLEARANCE:
        kind = plan[int(plan[at.STOP]) + index * at.STOP_WIDTH + at.KIND]
        out[FADING], out[RATE] = 0.0, 0.0
        order = int(plan[at.ORDER])
        if kind == at.LINK:
            order = _of_link(plan, channel, index, out)
            return order
        if kind == at.PUSHING and remembers(plan, row_of(plan, index)):
            return _of_memory(plan, channel, index, out)
        if kind == at.PUSHING and int(plan[at.MODE]) >> index & 1:
            for j in range(order + 1):
                out[j] = 0.0
            row = row_of(plan, index)
            if channel == DEFORMATION:
                relative(plan, index, 0, 1.0, out)
                out[0] -= plan[int(plan[at.STOP]) + index * at.STOP_WIDTH + at.GAP]
            elif channel == FORCE and plan[row + of.ACTIVE] != 0.0:
                force = node(plan, row, of.FORCE_NODE, int(plan[at.NODES]))
                for j in range(order + 1):
                    out[j] = plan[force + j]
            return order
    linear_order: int = linear.series(plan, channel, index, out)
    return linear_order


@kernel
def value(plan: Vector, channel: int, index: int, tau: float) -> float:
    """A channel's value on the piece."""
    out = beyond(plan, int(plan[at.ROOM]))
    order = series(plan, channel, index, out)
    channel_value: float = evaluate(out, order, tau)
    return channel_value
