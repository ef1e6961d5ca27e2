"""Where a plan keeps what a Taylor step needs.

It begins as every plan (`linear.layout`): the rig, the forcing, and the header of a table, which
here is that of the piece in hand. Times are in units of the plan's own, a power of two.
"""

from __future__ import annotations

from vibroimpact.engine.linear.layout import SIZE, TABLES
from vibroimpact.law_numbers import WORDS

DEGREE = 20
"""Highest power of a step's series."""

ROOM = 24
"""Numbers kept for one series."""

HEADER = TABLES
"""The header of the piece in hand."""

# Addresses of kernels, one for each case of `kernels.Slot`; then the laws that they have.
KERNELS = TABLES + SIZE
LAWS = KERNELS + 48
ROOTS = LAWS + 1  # of each side: the exponent for which a stop has a kernel in a root, and the root
UNIT = ROOTS + 4  # s
SHAKES_UNIT = UNIT + 1  # s, of what follows
NUMBERS_UNIT = UNIT + 2  # s, of NUMBERS
LACKING = UNIT + 3  # 0, or 1 where no series holds or no kernel was made, or OVERFLOWED
SHAKES = UNIT + 4  # coefficients of what shakes the mass, but for two factors, in units of time
X = SHAKES + ROOM  # the mode's own coordinate
Z = X + ROOM  # the isolator's memory
SHAKEN = Z + ROOM  # −A_t and the constant force
V = SHAKEN + ROOM  # of a step in a stop's root: velocity and time
T = V + ROOM

OVERFLOWED = 2.0
"""In the place of LACKING, where the terms of a series have left the range of numbers."""

# Numbers of the forces in a mode, in units of time.
NUMBERS = T + ROOM
NAMES = (
    "stiffness",
    "damping",
    "offset",
    "cubic",
    "quintic",
    "sinh",
    "sinh_rate",
    "hysteretic",
    "slope",
    "bend",
    "drag",
    "drag_exponent",
    "push",
    "push_exponent",
    "push_dissipation",
    "push_viscous",
    "other",
    "other_exponent",
    "other_dissipation",
    "other_viscous",
    "apart",
    "load",
    "rate",
    "way",
    "closing",
    "side",
    "per_unit",
    "own_weight",
)
FOUND = NUMBERS + len(NAMES)
# What a kernel finds: length, state and its rates at the end, bounds on second and third rates, by
# how much its last terms are too large, and what the forcing must be there (times length²).
(F_H, F_X, F_V, F_A, F_BEND, F_JERK, F_Z, F_R, F_BEND_Z, F_EXCESS, F_OWES, F_WEIGHT, F_T) = range(
    13
)
# Where a zero was last looked for: the time, and the state and its rates there.
(A_T, A_X, A_V, A_A) = range(13, 17)

SLOT = FOUND + 20  # the kernel that made the step in hand

OWN_FORCE = SLOT + 1  # of an isolator's formula: its value and slopes
MADE = OWN_FORCE + 3  # operations of the formulas that the kernels were made for
ASKED = MADE + 3 * WORDS  # event functions in hand: an acceleration, a force, a velocity
PUSH = ASKED + ROOM  # what the stops push with
BY_X = PUSH + 2 * ROOM  # slopes of the forces: by displacement, by velocity, by the dissipations
BY_V = BY_X + ROOM
BY_CHI = BY_V + ROOM
BY_Z = BY_CHI + 2 * ROOM  # of z′, by velocity and, with the sign turned, by z
BY_Z_OF_Z = BY_Z + ROOM
D_X = BY_Z_OF_Z + ROOM  # a disturbance
D_V = D_X + ROOM
D_Z = D_V + ROOM
END = D_Z + ROOM
