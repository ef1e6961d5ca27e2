"""What the fifty-digit reference is asked about, and what it tells."""

from dataclasses import dataclass
from typing import NamedTuple

from mpmath import mpf

State = tuple[mpf, mpf, mpf, mpf]


@dataclass(frozen=True)
class Stop:
    """A massless bumper: stiffness (N/m, positive), damping (N s/m), initial gap (m)."""

    stiffness: float
    damping: float
    gap: float


@dataclass(frozen=True)
class Wall:
    """A rigid stop: restitution from 0 to 1, gap (m)."""

    restitution: float
    gap: float


@dataclass(frozen=True)
class Rig:
    """A mass (kg) on an isolator (N/m, N s/m) between two optional stops; a constant force (N)."""

    mass: float
    stiffness: float
    damping: float
    right: Stop | Wall | None = None
    left: Stop | Wall | None = None
    force: float = 0.0


class Event(NamedTuple):
    """A change of phase: its time (s), what happened, and the state there.

    `kind` is 'contact_right', 'detach_right', 'impact_right', or the same on the left. On a rigid
    stop contact and detachment are the beginning and the end of rest. The velocity of an impact is
    that before it. Of a chatter the first impacts are listed, as many as its limit was found from.
    """

    time: mpf
    kind: str
    u: mpf
    v: mpf
    u_right: mpf
    u_left: mpf


@dataclass(frozen=True)
class Reference:
    """The states (u, v, u_R, u_L) at the end of every span (a forcing period, or the line between
    two samples of a record), and the events in order of time."""

    states: list[State]
    events: list[Event]


class Side:
    """One stop with its sign: +1 on the right, -1 on the left; `wall` is its rest position."""

    def __init__(self, name: str, sign: int, stop: Stop | Wall) -> None:
        self.name = name
        self.sign = sign
        self.wall = sign * mpf(stop.gap)
        self.restitution: mpf | None = None
        self.rate: mpf | None = None
        if isinstance(stop, Wall):
            if not 0 <= stop.restitution <= 1:
                raise ValueError(f"impossible {name} stop: {stop}")
            self.restitution = mpf(stop.restitution)
            return
        if not (stop.stiffness > 0 and stop.damping >= 0):
            raise ValueError(f"impossible {name} stop: {stop}")
        self.stiffness = mpf(stop.stiffness)
        self.damping = mpf(stop.damping)
        # Relaxation rate; an elastic bumper is back at rest at once and remembers nothing.
        self.rate = self.stiffness / self.damping if stop.damping > 0 else None
