"""Where the numbers of a curved row are: its behaviour, its tape, those of its law."""

from __future__ import annotations

from vibroimpact.engine import parameters as par
from vibroimpact.engine.series import layout as series

SMOOTH, HYSTERETIC, BILINEAR, DRAG, FRICTION, OWN, POWER, OWN_STOP, MEMORY_STOP = range(1, 10)
"""What a row does; 0: it is a linear stop."""

(
    BEHAVIOUR,
    BRANCH,
    FIRST_OP,
    KNOWN,
    LAST_OP,
    S_NODE,
    V_NODE,
    Z_NODE,
    FORCE_NODE,
    FLOW_NODE,
    RAW_NODE,
    # While a mode lasts: whether the force acts.
    ACTIVE,
    # For disturbances.
    SLOPE_CONSTANTS,
    LAST_SLOPE,
    BY_S,
    BY_V,
    BY_Z,
    BY_CHI,
    FLOW_BY_V,
    FLOW_BY_Z,
    FLOW_BY_S,
    # Of a stop with a memory: whether this is the deformation while it is pressed.
    TIED,
) = range(22)
"""Of a row: the place of its two bits among those with branches (−1: it has none), its operations,
of which the first are known (constants and what goes in), and the nodes of what goes in and comes
out. Then come the operations of the slopes of the force, by s, s′, z and a stop's dissipation, and
of the memory's rate."""
NAMES = 24
"""Then the numbers of its forces by name (`series.layout.NAMES`), as the mode has them."""
NUMBERS = NAMES + len(series.NAMES)
"""Then the law as that of a rig of 1 kg with one stop (`parameters`)."""
WIDTH = NUMBERS + par.SIZE

OP_WIDTH = 4
"""Of the tape: the operation, two nodes, a number."""

ORDER, CODE_ORDER = 24, 27
"""Of series, and of those that code writes (`emitted`), where a term more costs less."""

NEW = 1.0
"""In the place of how far to leap: the branches of the links are still to be found."""

V_FRESH, SIDE_FRESH = 1, 2
"""What is zero at a link's row by construction: s′, and the function of its side or yield."""

DEPTH_FRESH, RATE_FRESH, FORCE_FRESH = 1, 2, 3
"""What is zero at a stop that pushes: deformation, its rate (or 1 + χ δ′), a formula's force."""
