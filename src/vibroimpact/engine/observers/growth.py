"""How two disturbances of a motion grow: their directions carried on, their sizes summed up.

One disturbance is carried, and what its flow keeps of a second one (`dispatch.grow`).
"""

from __future__ import annotations

from vibroimpact.engine.jit import Vector, kernel

FIRST, BOTH, DISSIPATION = range(3)
"""Of the notes: the logarithms of how much one disturbance and the area of both have grown since
the section, and the integral of the damping."""
SHRUNK, LENGTH = 3, 4
"""A bound on how much they may have shrunk since they were last brought to unit size, and when the
section comes again (s)."""


@kernel
def start_notes(notes: Vector, length: float) -> None:
    """Begin at a section."""
    for i in range(LENGTH):
        notes[i] = 0.0
    notes[LENGTH] = length
