"""How a computation ended: status codes for the kernels, and advice in words."""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """Outcome of a trajectory, or of the motion at one frequency."""

    DONE = 0
    NOT_SETTLED = 1
    TOO_MANY_EVENTS = 2
    TOO_MUCH_WORK = 3
    NOT_FINITE = 4
    STOPPED = 5
    REVERSED = 6

    @property
    def advice(self) -> str:
        """Describe what happened, and what the user can do about it."""
        return _ADVICE[self]


MORE_CYCLES = "max_cycles in Python"
"""Name of the argument in the advice. A command replaces it by the name of its option."""

_ADVICE = {
    Status.DONE: "done",
    Status.NOT_SETTLED: (
        "the motion did not settle within the allowed number of cycles, so it was measured over "
        f"the cycles after this limit; for a slow transient, raise {MORE_CYCLES}; to distinguish a "
        "slow transient from chaos, start `steady` from `section`"
    ),
    Status.TOO_MANY_EVENTS: (
        "one forcing cycle or record step has more events (contacts, detachments, yielding and "
        "turning points) than max_events allows, or too many integration steps between them; if "
        "the mass chatters, give the stop more damping or less restitution, or raise max_events in "
        "Python; if a damping_exponent below 1 makes the motion too stiff near rest, raise the "
        "exponent"
    ),
    Status.TOO_MUCH_WORK: (
        "the fastest rate of the rig is too large to compute one forcing cycle or record step; "
        "raise the frequency, or lower the largest stiffness or damping"
    ),
    Status.NOT_FINITE: (
        "the motion exceeded the range of floating-point numbers; check the orders of magnitude "
        "of the input"
    ),
    Status.STOPPED: "stopped on request",
    Status.REVERSED: (
        "the displacement exceeded the range in which the softening isolator has a restoring "
        "force, so its law is hardly valid; lower the amplitude, or add a hardening term to the "
        "isolator"
    ),
}

# The same for kernels, whose constants are plain numbers.
DONE = int(Status.DONE)
NOT_SETTLED = int(Status.NOT_SETTLED)
TOO_MANY_EVENTS = int(Status.TOO_MANY_EVENTS)
TOO_MUCH_WORK = int(Status.TOO_MUCH_WORK)
NOT_FINITE = int(Status.NOT_FINITE)
STOPPED = int(Status.STOPPED)
