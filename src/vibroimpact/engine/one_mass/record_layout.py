"""Where the numbers of a record stand: its samples and its events."""

from __future__ import annotations

from vibroimpact.engine.memory import stack
from vibroimpact.engine.state import ONE_MASS

STOPS = ONE_MASS.stops

# Rows of the samples: a row a variable, so that each is one piece of memory.
# DEFORMATION and CLEARANCE are of stop 0, and those of others follow; the stops touched are bits.
DISPLACEMENT, VELOCITY, ACCELERATION, DEFORMATION = range(4)
CLEARANCE = DEFORMATION + STOPS
TOUCHED = CLEARANCE + STOPS
MEMORY, SAMPLE = TOUCHED + 1, TOUCHED + 2

BLOCK = 64
"""Samples that are computed together."""
U = SAMPLE
"""Behind the rows of a block: the displacement, where the mode's own coordinate is still needed."""
samples = stack((SAMPLE + 1) * BLOCK)
"""Room for a block."""

# Columns of an event: the state there, and the absolute acceleration just before and behind.
E_CYCLE, E_TIME, E_KIND, E_STOP, E_U, E_V, E_DEFORMATION = range(7)
E_BEFORE, E_BEHIND, E_MEMORY, EVENT = range(E_DEFORMATION + STOPS, E_DEFORMATION + STOPS + 4)
