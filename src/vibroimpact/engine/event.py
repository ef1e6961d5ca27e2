"""What ends a stretch: an event, which is a kind and the number of the stop where it happens.

Kernels hand both on as one number, which fits into a register and into `state.EVENT`. Here alone it
is made and read. A kind without a stop has the number 0, and is the event itself.
"""

from __future__ import annotations

from vibroimpact.engine.jit import inlined

(
    # Nothing happens: the time limit, the end of a step, and more steps than can be counted or a
    # motion that is no longer finite.
    LIMIT,
    PASSED,
    GIVEN_UP,
    # At a stop: a deformable one is met; a rigid one is hit, or a chatter there ends in rest (the
    # mode shows which); a deformable one is left; a rest on a rigid one ends.
    CONTACT,
    IMPACT,
    DETACHMENT,
    REST_ENDS,
    # Another piece of a curved law begins, of which nothing is reported: at a turn, or where
    # friction lets go.
    TURN,
    # Further ends of a piece, within a stretch: an isolator reaches its yield limit, its memory
    # changes its sign, so does a stop's force without being left, and so does u.
    YIELD,
    UNBENT,
    EASED,
    CENTRED,
    # A piece ends and another way to go on must be found, or there is none.
    NEITHER,
    LACKS,
) = range(14)

_BITS = 4
_KIND = (1 << _BITS) - 1


@inlined
def event_of(kind: int, stop: int) -> int:
    """The event of a kind at a stop."""
    return kind | stop << _BITS


@inlined
def kind_of(event: int) -> int:
    """What an event is."""
    return event & _KIND


@inlined
def stop_of(event: int) -> int:
    """At which stop an event is."""
    return event >> _BITS


@inlined
def at_stop(event: int) -> bool:
    """Whether an event is one of a stop, which ends a phase."""
    return CONTACT <= event & _KIND <= REST_ENDS


@inlined
def begins_contact(event: int) -> bool:
    """Whether a stop is met, which is counted as a contact."""
    return event & _KIND in (CONTACT, IMPACT)
