"""What the engine writes down of a motion, as a dataset's variables."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vibroimpact.datasets.stops import by_stop, stop_names
from vibroimpact.engine.assembly import record as several
from vibroimpact.engine.observers.record import CONTACT_BEGINS, DETACHMENT
from vibroimpact.engine.one_mass import record_layout
from vibroimpact.model import Assembly, Oscillator, Record, Repeated
from vibroimpact.model.assembly import numbers
from vibroimpact.model.unknown_keys import listed as words

_Array = NDArray[np.float64]

_FEW_EVENTS = 100
"""Below which integration steps, not events, were too many."""
_BUSY = 0.25
"""Share of the events at the busiest stop that another one needs to be named."""


class EngineRecord(NamedTuple):
    """What the engine wrote down of a motion."""

    out: _Array
    """Samples."""
    events: list[_Array]
    """Rows of events, in parts."""
    interval: float
    """Length of a cycle or of a step of a record (s)."""
    shaking: Repeated | Record
    phase: float
    """Where a repeated forcing begins (rad)."""
    forcing: str
    """Name of the history of the shaking."""
    values: _Array
    """That history at the samples."""

    @property
    def force_on_mass(self) -> Repeated | None:
        """The shaking, if it is a force on a mass."""
        if isinstance(self.shaking, Record) or self.shaking.moves_base:
            return None
        return self.shaking


def sampled(out: _Array, oscillator: Oscillator) -> dict[str, Any]:
    """The samples; what the isolator remembers, if it does."""
    rows = {
        "displacement": record_layout.DISPLACEMENT,
        "velocity": record_layout.VELOCITY,
        "acceleration": record_layout.ACCELERATION,
        **({"isolator_memory": record_layout.MEMORY} if oscillator.isolator.remembers else {}),
    }
    samples: dict[str, Any] = {name: ("time", out[row]) for name, row in rows.items()}
    mode = out[record_layout.TOUCHED].astype(np.int8)[:, np.newaxis]
    by_side = {
        "deformation": out[record_layout.DEFORMATION :][: record_layout.STOPS].T,
        "clearance": out[record_layout.CLEARANCE :][: record_layout.STOPS].T,
        "touching": mode >> np.arange(record_layout.STOPS, dtype=np.int8) & 1 > 0,
    }
    return samples | {
        name: (("stop", "time"), by_stop(oscillator, values).T) for name, values in by_side.items()
    }


def transmitted(
    variables: dict[str, Any],
    oscillator: Oscillator,
    force: _Array | float = 0.0,
    event_force: _Array | float = 0.0,
) -> dict[str, Any]:
    """The force of isolator and stops on the base (N): F(t) + F_0 − M times the acceleration.

    Parameters
    ----------
    force, event_force
        Force F(t) on the mass (N) at the samples and at the events; 0 if the base moves.
    """
    sources = {
        "transmitted_force": ("acceleration", force),
        "event_transmitted_force_before": ("event_acceleration_before", event_force),
        "event_transmitted_force_after": ("event_acceleration_after", event_force),
    }
    made = {}
    for name, (acceleration, pushed) in sources.items():
        dim, values = variables[acceleration]
        carried = -oscillator.mass * values
        carried += pushed + oscillator.force
        carried += 0.0  # no -0.0
        made[name] = (dim, carried)
    return made


def listed(parts: list[_Array], period: float, oscillator: Oscillator) -> dict[str, Any]:
    """The contacts and detachments, in cycles or steps of this length (s).

    Columns are joined one by one, so that the parts are not kept a third time.
    """
    integers = {
        "event_cycle": record_layout.E_CYCLE,
        "event_contact": record_layout.E_KIND,
    }
    columns = {
        "event_cycle_time": record_layout.E_TIME,
        "event_displacement": record_layout.E_U,
        "event_velocity": record_layout.E_V,
        "event_acceleration_before": record_layout.E_BEFORE,
        "event_acceleration_after": record_layout.E_BEHIND,
    }
    if oscillator.isolator.remembers:
        columns["event_isolator_memory"] = record_layout.E_MEMORY

    def column(at: int) -> _Array:
        return np.concatenate([part[:, at] for part in parts])

    time = column(record_layout.E_CYCLE) * period + column(record_layout.E_TIME)
    deformation = np.column_stack(
        [column(record_layout.E_DEFORMATION + stop) + 0.0 for stop in range(record_layout.STOPS)]
    )
    return {
        "event_time": ("event", time),
        "event_stop": ("event", stop_names(column(record_layout.E_STOP))),
        "event_deformation": (("event", "stop"), by_stop(oscillator, deformation)),
        **{name: ("event", column(at).astype(np.int64)) for name, at in integers.items()},
        **{name: ("event", column(at) + 0.0) for name, at in columns.items()},  # no -0.0
    }


def sampled_by_mass(
    out: _Array, assembly: Assembly, force: _Array, on: str | None
) -> dict[str, Any]:
    """Return the samples of an assembly by mass and stop, and the force on the base (N).

    `force` acts on the mass `on` at the samples; None if the base moves.
    """
    n, stops = len(assembly.names), len(assembly.stops)
    variables: dict[str, Any] = {
        one: (("mass", "time"), out[i * n : (i + 1) * n] + 0.0)
        for i, one in enumerate(("displacement", "velocity", "acceleration"))
    }
    for i, one in enumerate(("clearance", "contact_force", "deformation")):
        first = 3 * n + i * stops
        variables[one] = (("stop", "time"), out[first : first + stops] + 0.0)
    # The force that would balance the masses if the base moved them as a rigid body.
    of = numbers(assembly)
    _, acceleration = variables["acceleration"]
    carried = -(of.mass @ of.influence) @ acceleration + of.influence @ of.force
    if on is not None:
        carried += of.influence[assembly.names.index(on)] * force
    variables["transmitted_force"] = ("time", carried + 0.0)
    return variables


def listed_by_mass(rows: _Array, period: float, assembly: Assembly) -> dict[str, Any]:
    """Return the contacts and detachments of an assembly, in cycles or steps of this length (s)."""
    events = list(_events(rows, assembly))
    section = np.array([one.section for one in events], dtype=np.int64)
    since = np.array([one.time for one in events], dtype=float)
    stops = list(assembly.stops)
    variables: dict[str, Any] = {
        "event_time": ("event", section * period + since),
        "event_contact": ("event", np.array([one.kind for one in events], dtype=np.int64)),
        "event_stop": ("event", np.array([stops[one.stop] for one in events], dtype=np.str_)),
        "event_cycle": ("event", section),
        "event_cycle_time": ("event", since),
    }
    for name in ("displacement", "velocity"):
        values = np.array([getattr(one, name) for one in events]).reshape(-1, len(assembly.names))
        variables[f"event_{name}"] = (("event", "mass"), values + 0.0)
    return variables


class _Event(NamedTuple):
    section: int
    time: float
    """Since the section began (s)."""
    stop: int
    kind: float
    displacement: _Array
    velocity: _Array


def _events(rows: _Array, assembly: Assembly) -> Iterator[_Event]:
    """Yield what happens at the stops, with the states just before it."""
    n, rigid = len(assembly.names), [one.stop.rigid for one in assembly.stops.values()]
    for row in rows:
        section, stop = int(row[several.E_CYCLE]), int(row[several.E_STOP])
        time, kind = float(row[several.E_TIME]), row[several.E_KIND]
        u, v, behind = np.split(row[several.E_MASSES :], [n, 2 * n])
        before, after = int(row[several.E_BEFORE]), int(row[several.E_BEHIND])
        rests = rigid[stop] and after >> stop & 1 > 0
        if kind != DETACHMENT:
            # Other rests of bodies that are hit end.
            for g in range(len(rigid)):
                if g != stop and rigid[g] and before & ~after & 1 << g:
                    yield _Event(section, time, g, DETACHMENT, u, v)
        if not (rests and kind == CONTACT_BEGINS):
            yield _Event(section, time, stop, kind, u, v)
        if rests:
            # The impact after which the bodies rest is followed by the rest.
            yield _Event(section, time, stop, CONTACT_BEGINS, u, behind)


def busiest_by_mass(rows: _Array, section: int, assembly: Assembly) -> str:
    """Describe which parts cause too many events or steps in a section; may be empty."""
    own = rows[rows[:, several.E_CYCLE] == section]
    counts = np.bincount(own[:, several.E_STOP].astype(np.int64), minlength=len(assembly.stops))
    if len(own) < _FEW_EVENTS:
        blunt = [
            f"links.{name}.damping_exponent = {link.isolator.damping_exponent:g}"
            for name, link in assembly.links.items()
            if link.isolator.damping_exponent < 1.0
        ]
        return f"with {len(own)} events, check {words(blunt)}" if blunt else ""
    names = [
        name
        for name, count in zip(assembly.stops, counts, strict=True)
        if count >= _BUSY * counts.max()
    ]
    lossless = [
        f"stops.{name}.restitution = 1"
        for name in names
        if getattr(assembly.stops[name].law, "restitution", None) == 1.0
        and assembly.stops[name].stop.rigid
    ]
    cause = f"most of these {len(own)} events are at {words(names)}"
    if lossless:
        cause += (
            f"; with {words(lossless)}, bodies that are pushed together bounce without end: "
            "use a smaller value"
        )
    return cause


def doubts_by_mass(rows: _Array, undecided: bool, section: str) -> list[str]:
    """What the engine decided by a rule, or could not decide."""
    notes = []
    by_rule = rows[rows[:, several.E_ORDERED] > 0.0]
    if ordered := len(by_rule):
        first = int(by_rule[0, several.E_CYCLE])
        where = f" (the first in {section} {first})"
        notes.append(
            f"{ordered} impact{'s' if ordered > 1 else ''} at the same instant as another impact "
            f"or rest of the same mass{where}; their order is that of the stops in the assembly, "
            "because restitution alone does not determine the result"
        )
    if undecided:
        notes.append(
            "the search for an event was given up and counted as no event; check the orders of "
            "magnitude of the input"
        )
    return notes
