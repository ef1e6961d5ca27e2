"""How a computation ended, in codes for the kernels and in words for people."""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """Outcome of a trajectory or of a held frequency."""

    DONE = 0
    NOT_SETTLED = 1
    TOO_MANY_EVENTS = 2
    TOO_MUCH_WORK = 3
    NOT_FINITE = 4
    STOPPED = 5
    REVERSED = 6

    @property
    def advice(self) -> str:
        """What happened, and what the user can do about it."""
        return _ADVICE[self]


MORE_CYCLES = "max_cycles in Python"
"""How advice names the argument; a command that has it as an option names that instead."""

_ADVICE = {
    Status.DONE: "done",
    Status.NOT_SETTLED: (
        "the motion had not settled when the last cycle allowed for it ended, and was measured "
        f"from there; if you expect a slow transient, raise {MORE_CYCLES}"
    ),
    Status.TOO_MANY_EVENTS: (
        "more contacts and detachments in one forcing cycle, or steps between them, than are "
        "followed: the mass chatters (give the stop more damping or less restitution, or raise "
        "max_events in Python), or a damping_exponent below 1 is too stiff near rest (raise it)"
    ),
    Status.TOO_MUCH_WORK: (
        "the fastest rate of the rig is too many times the forcing frequency to follow one "
        "cycle; raise the frequency or lower the largest stiffness or damping"
    ),
    Status.NOT_FINITE: "the motion left the range of numbers; check the orders of magnitude",
    Status.STOPPED: "stopped on request",
    Status.REVERSED: (
        "the motion went beyond where the softening isolator still pushes back, and its law is "
        "hardly meant there; lower the amplitude, or give the isolator a term that hardens"
    ),
}

# The same for kernels, whose constants are plain numbers.
DONE = int(Status.DONE)
NOT_SETTLED = int(Status.NOT_SETTLED)
TOO_MANY_EVENTS = int(Status.TOO_MANY_EVENTS)
TOO_MUCH_WORK = int(Status.TOO_MUCH_WORK)
NOT_FINITE = int(Status.NOT_FINITE)
STOPPED = int(Status.STOPPED)
