"""Where things are in a plan and in a state.

A plan begins with whole numbers, kept as floats: sizes, and the places of blocks; FLOW, which is
`parameters.MASSES`, stands where a rig of one mass has its FORCING. Up to `NUMBERS` it is the rig's
vector, after which a system vector has its amplitude and frequency; what follows are constants and
rooms.
A state is [mode, fresh, u (n), v (n), deformation (a number for each stop), age, s, c]. `fresh`
states which watched functions are zero by construction, and how far to leap (see
`events.pack_fresh`).
"""

from __future__ import annotations

from vibroimpact.engine.stops import rebound

(
    MASSES,
    STOPS,
    WAVES,
    RECORD,
    POWER,
    INTERVAL,
    # Of the forcing.
    AMPLITUDE,
    OMEGA,
    HIGHEST,
    # Blocks of the model.
    ROWS,
    STIFFNESS,
    DAMPING,
    SHAPE,
    PUSH,
    CONSTANT,
    STOP,
    RESPONSE,
    COUPLING,
    ROW_SUMS,
    MASS,
    CARRIED,
    LOAD,
    NUMBERS,
    LENGTH_OF_PLAN,
    SYMMETRIC,
    STIFF_RATE,
    ECONOMY,
    # What the mode says.
    MODE,
    RATE,
    PRESSED,
    FLOW,  # at `parameters.FORCING`
    RESTING,
    PRESSED_LIST,
    RESTING_LIST,
    FACTOR,
    # The motion.
    Y,
    DEFORMATION,
    ZEROS,
    AGE,
    LEVEL,
    # The last stretch.
    STRETCH_MODE,
    EVENT,
    LENGTH,
    PIECES,
    START,
    START_DEFORMATION,
    END,
    END_DEFORMATION,
    # The Taylor series of a piece.
    PIECE,
    PIECE_LENGTH,
    ORDER,
    SERIES,
    FORCE_SERIES,
    # Rooms.
    BERNSTEIN,
    ROOM,
    WIDTHS,
    SCRATCH,
    # Counters.
    STEPS,
    SPLITS,
    ORDERED,
    # Tables.
    SLOTS,
    MOST_PRESSED,
    TABLE,
    TABLE_SIZE,
    KEYS,
    SLOT_OF,
    USED,
    TABLE_NOW,
    TABLE_ROOM,
    RULES,
    MOVED,
    ACTUAL_MODE,
    PIECE_Y,
    PIECE_DEFORMATION,
    SHAKEN,
    UNDECIDED,
    COEFFICIENTS,
    # Of curved laws (`curved.layout`).
    LINKS,
    CURVED,
    LAWS,
    TAPE,
    BRANCHES,
    NODES,
    POINT,
    KEPT_Y,
    SHORT,
    # What is observed of pairs of bodies.
    DRIFTS,
    DRIFT,
    SEEN,
    ORDERED_BEFORE,
    # What a mode makes of a state (`rates`).
    ROW,
    INPUTS,
    RATES,
    RATES_SIZE,
    RATES_SLOTS,
    RATES_MODE,
    RATES_NOW,
    RATE_OF,
    OUTPUTS,
    SHARE,
    POWERS,
    # Of curved laws whose series are code (`curved.emitted`): its addresses, the modes without it.
    CODE,
    UNIT,
    AT_ONCE,
) = range(104)
HEADER = 104

LEFT, RIGHT, GAP, KIND, STOP_STIFFNESS, STOP_DAMPING, RELAXATION = range(7)
FIRST, BEHIND, PARTNER, REBOUND, RESTITUTION = range(7, 12)
"""Of a stop: its bodies (n for the ground), gap (m), kind, N/m, N s/m, κ (1/s; inf without a
dashpot), the range of masses on which it acts at once, the stop that is its mirror image (−1 if
none is), and of a rigid one its law of rebound and the numbers of that (`stops.rebound`)."""
STOP_WIDTH = REBOUND + rebound.WIDTH

DRIFT_LEFT, DRIFT_RIGHT, DRIFT_DAMPING = range(3)
"""Of a drift u_right − u_left: its bodies (n for the ground), and the dashpot between them (N s/m)
that is part of the damping."""
DRIFT_WIDTH = 3

KELVIN_VOIGT, RIGID, PUSHING, LINK = range(4)
"""Kinds of stops. A stop of a curved law pushes; curved links stand behind the stops, as rows that
"touch" while friction holds them."""

DEGREE = 15
TERMS = 28
"""Taylor coefficients, at most."""
STEP = 2.5
"""h ρ; the remainder is then 2.5²⁸/28! = 5e-19 of the state."""

MOST_STOPS = 52
"""Bits of a mode, which is kept as a float."""
