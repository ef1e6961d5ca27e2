"""Where a plan keeps what a Taylor step needs.

It begins as every plan (`linear.layout`): the rig, the forcing, and the header of a table, which
here is that of the piece in hand. The series of the step in hand follow.
"""

from __future__ import annotations

from vibroimpact.engine.linear.layout import SIZE, TABLES

DEGREE = 22
"""Highest power of a step's series. With it a step goes 0.16 of the way to the nearest
singularity; fewer terms cost more steps, more terms more a step."""

ROOM = DEGREE + 2
"""Numbers kept for one series."""

HEADER = TABLES
"""The header of the piece in hand."""

X = TABLES + SIZE  # the mode's own coordinate
Z = X + ROOM  # the isolator's memory
SHAKEN = Z + ROOM  # −A_t and the constant force
U = SHAKEN + ROOM  # displacement, as the isolator has it
SQUARE = U + ROOM  # u²
CUBE = SQUARE + ROOM  # u³
FIFTH = CUBE + ROOM  # u⁵
RISING = FIFTH + ROOM  # exp(β u)
FALLING = RISING + ROOM  # exp(−β u)
BENT = FALLING + ROOM  # z′/u′
SPEED = BENT + ROOM  # |x′|
DRAG = SPEED + ROOM  # |x′|^α
PRESSED = DRAG + ROOM  # of the other stop that is pressed, its deformation
PUSH = PRESSED + ROOM  # powers of δ, four of the stop that the coordinate is of, four of the other
ASKED = PUSH + 8 * ROOM  # what is asked of the motion: its acceleration, a force, a velocity
BY_X = ASKED + ROOM  # slopes of the forces: by displacement, by velocity, by the closing speeds
BY_V = BY_X + ROOM
BY_SPEED = BY_V + ROOM
BY_Z = BY_SPEED + 2 * ROOM  # of z′, by velocity and, with the sign turned, by z
BY_Z_OF_Z = BY_Z + ROOM
D_X = BY_Z_OF_Z + ROOM  # a disturbance
D_V = D_X + ROOM
D_Z = D_V + ROOM
# Of a leap, sixteen numbers each, from a cache line's beginning on: the displacement first.
NODES = (D_Z + ROOM + 7) // 8 * 8
NODES_V = NODES + 16
NODES_Z = NODES + 32
NODES_A = NODES + 48  # acceleration
NODES_R = NODES + 64  # z′
NODES_SHAKEN = NODES + 80
NODES_T = NODES + 96  # time, where it is not the variable
NODES_P = NODES + 112  # in between
SPECTRA = NODES + 128  # the first five and the time in Legendre's polynomials
POWERS = SPECTRA + 96  # z², z³, … for which a plan has room to the end
END = POWERS + ROOM  # of all but these powers
