"""Where a plan keeps what: the rig's numbers, the forcing, and a table for each mode.

One vector holds everything that the kernels read: they pass it on as one argument, and a table
is the position where it begins.
"""

from __future__ import annotations

from typing import NamedTuple

from vibroimpact.engine import parameters as par
from vibroimpact.engine.memory import TERMS

NODES = 16
"""Intervals in a table; node j is j steps after the table's start."""

STEP = 0.25
"""A step times the fastest rate of the phase: the curve is nearly a parabola over a step."""

FINE = 32
"""Points in an interval from which a short Taylor series reaches the next one to rounding:
with a radius of 1/40 step, (0.25/40)^6 / 6! = 8e-17."""

RADIUS = 1.0 / 40.0
"""How far a short series reaches, in steps."""

ORDER = TERMS
"""Coefficients of the long series about the middle of an interval, in y = (t − t_middle) / step.
It covers the interval to rounding: 0.125^12 / 12! = 2e-20."""

FORGOTTEN = 44.0
"""exp(−44) = 8e-20: what has decayed by this much is below the rounding of what it is added to."""

# Layout of a table: a header of single numbers, then rows.
H = 0  # step, s
BAND_X = 1  # bound on |x″| h²/8 from a state: BAND_X |x − x_s| + BAND_V |x′| + BAND_0
BAND_V = 2
BAND_0 = 3
FORCE_X = 4  # the same for the contact force per unit mass, F″ h²/8
FORCE_V = 5
FORCE_0 = 6
REST = 7  # x_s = d / k, static equilibrium
VALID_FROM = 8  # age of the phase (s) from which the table holds
SCALED_C = 9  # c h
SCALED_K = 10  # k h²
SCALED_D = 11  # d h²
SCALED_A = 12  # A h²
SCALED_W = 13  # what the clock turns over a step: ω h
LATE = 14  # 1 where the fast part of the motion is projected out
RATE = 15  # 1 / h
RESTING = 16  # 1 where a rigid stop holds the mass
WAVE_S = 17  # of one harmonic among several: what its sin nθ and cos nθ pull, times h²
WAVE_C = 18
FOURTH = 19  # bound on |x⁗| h⁴ where |x″| h² ≤ b: FOURTH b + FOURTH_0
FOURTH_0 = 20
THIRD_X = 21  # bound on |x‴| h³ from a state, as that of BAND
THIRD_V = 22
THIRD_0 = 23
HEADER = 24

# A node's rows: x and x′ as functions of the state row at the start, then the cosine and
# sine of the angle that the forcing turns until there, then what the rounding of the first two
# columns has left out.
ROW_V = 5
COSINE = 10
SINE = 11
LEFT_OUT = 12
WIDTH = 16
NODE = HEADER  # nodes 1..NODES
FINE_NODE = NODE + NODES * WIDTH  # points 0..FINE-1 of an interval
MIDDLE = FINE_NODE + FINE // 2 * WIDTH
FORCE = FINE_NODE + FINE * WIDTH  # contact force at nodes 1..NODES, 5 numbers each
TAYLOR = FORCE + NODES * 5  # long series of x: 5 columns of ORDER
TAYLOR_F = TAYLOR + 5 * ORDER  # long series of the contact force
SIZE = TAYLOR_F + 5 * ORDER

SLOTS = 5
"""Tables from the start of a mode: flight, pressed right, pressed left, and pressed on both sides
as seen from the right and from the left. As many again hold once a mode's fast part is gone."""

LATE_TABLES = SLOTS * SIZE
"""From a mode's early table to its late one."""

AMPLITUDE = par.SIZE  # of A_t, m/s²; below 0 where it pulls the other way
OMEGA = par.SIZE + 1  # rad/s
MOST = par.SIZE + 2  # sup |A_t|, m/s²
STEEPEST = par.SIZE + 3  # sup |A_t′|, m/s³
TABLES = par.SIZE + 4
"""Where the tables begin in a plan."""

PLAN = TABLES + 2 * LATE_TABLES
"""Length of a plan: the rig's numbers (`parameters`), the forcing, and the tables."""

COLUMNS = 5
"""Of a state row: x, x′, the two numbers of the forcing's clock, 1."""


class Row(NamedTuple):
    """The state row, but for its 1: a mode's own coordinate, its rate, and the forcing's phasor.

    x is the displacement in flight and the pressed bumper's deformation in contact, measured
    towards the bumper: what is pressed on the left is seen in the mirror.
    """

    x: float
    v: float
    s: float
    c: float
