# mypy: disable-error-code="empty-body"
"""A forcing, whichever it is: by the type of a plan, or by the number in it.

A forcing is a linear clock of two numbers (s, c) that goes on by itself, and A_t, the base
acceleration that it stands for, which is linear in them. It is a module with the kernels that are
declared here.

Only what is neither a sum of harmonics of one frequency (`Periodic`), a constant force nor a
`Record` needs another one, and only if its clock does not depend on the motion and restarts each
cycle. It is a file here with these kernels (as `ramp`), named in each declaration below and in
`by_forcing`; a code beside RAMP in `parameters`, which `rig_vector` writes; two classes in
`flow_dispatch`, of linear laws and of those that yield; and, unless it is a sum of waves (`wave`),
more columns of the state row (`linear.layout`). In Python: a class in `model/excitation.py`
(periodic: of `Repeated`); its `Drive` in `_drive` of `response/engine_input.py`; its free response
(`response/analytic_free_response.py`) and that of several masses (`response/assembly_rig.py`); and
whatever asks for `isinstance(…, Periodic)`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from vibroimpact.engine import parameters as par
from vibroimpact.engine.dispatch import F, in_place_of
from vibroimpact.engine.forcing import harmonic, ramp, several
from vibroimpact.engine.forcing.wave import Wave
from vibroimpact.engine.jit import Vector, kernel
from vibroimpact.engine.linear.layout import Row


def by_forcing(
    one: Callable[..., Any], many: Callable[..., Any], line: Callable[..., Any]
) -> Callable[[F], F]:
    """Declare a function that calls the kernel of one sine, several harmonics, or a record.

    A plan whose type has no forcing counts as one sine.
    """
    kernels = {par.HARMONIC: one, par.SEVERAL: many, par.RAMP: line}

    def plain(plan: Any, *args: Any) -> Any:
        return kernels[plan[par.FORCING]](plan, *args)

    def by_number(plan: Any, *args: Any) -> Any:
        kind = plan[par.FORCING]
        if kind == par.HARMONIC:
            return one(plan, *args)
        if kind == par.RAMP:
            return line(plan, *args)
        return many(plan, *args)

    def of_type(plan: Any) -> Any:
        kind = getattr(plan, "forcing", par.HARMONIC)
        return by_number if kind is None else kernels[kind]

    return in_place_of(kernels.values(), plain, of_type)


@by_forcing(harmonic.begin, several.begin, ramp.begin)
def begin(plan: Vector, amplitude: float, omega: float) -> None:
    """Write AMPLITUDE, OMEGA, MOST and STEEPEST of the plan."""


@by_forcing(harmonic.pace, several.pace, ramp.pace)
def pace(plan: Vector) -> float:
    """Its own rate (1/s), which limits a table's step."""


@by_forcing(harmonic.count, several.count, ramp.count)
def count(plan: Vector) -> int:
    """How many parts it is a sum of."""


@by_forcing(harmonic.wave, several.wave, ramp.wave)
def wave(plan: Vector, n: int, mirrored: bool) -> Wave:
    """Part n, from 1 on."""


@by_forcing(harmonic.plane, several.plane, ramp.plane)
def plane(plan: Vector, n: int) -> int:
    """How far behind the tables those of part n lie."""


@by_forcing(harmonic.value, several.value, ramp.value)
def value(plan: Vector, s: float, c: float) -> float:
    """A_t."""


@by_forcing(harmonic.turned, several.turned, ramp.turned)
def turned(plan: Vector, s: float, c: float, t: float) -> tuple[float, float]:
    """The clock after the time t (s)."""


@by_forcing(harmonic.stepped, several.stepped, ramp.stepped)
def stepped(plan: Vector, s: float, c: float, t: float) -> tuple[float, float]:
    """The same, fast for a time of a step."""


@by_forcing(harmonic.release_time, several.release_time, ramp.release_time)
def release_time(
    plan: Vector, sign: float, level: float, s: float, c: float, limit: float
) -> tuple[float, float, float]:
    """When sign A_t first exceeds a level: t, infinite if not within the limit, and the clock."""


@by_forcing(harmonic.product, several.product, ramp.product)
def product(plan: Vector, at: int, row: Row) -> float:
    """From a mode's table, a linear function of the state row."""


@by_forcing(harmonic.expand, several.expand, ramp.expand)
def expand(plan: Vector, at: int, row: Row, series: Vector) -> None:
    """The long series of one."""


@by_forcing(harmonic.short_series, several.short_series, ramp.short_series)
def short_series(
    plan: Vector, table: int, row: Row
) -> tuple[float, float, float, float, float, float, float]:
    """Seven terms of x, from the equation of motion."""


@by_forcing(harmonic.turned_clock, several.turned_clock, ramp.turned_clock)
def turned_clock(plan: Vector, at: int, s: float, c: float) -> tuple[float, float]:
    """The clock at a node or fine point."""


@by_forcing(harmonic.turn, several.turn, ramp.turn)
def turn(plan: Vector, s: float, c: float, angle: float) -> tuple[float, float]:
    """The clock a part of a step later; `angle` is what SCALED_W makes of it (a record: a time)."""


@by_forcing(harmonic.nudged, several.nudged, ramp.nudged)
def nudged(plan: Vector, s: float, c: float, angle: float) -> tuple[float, float]:
    """The same for an angle whose square is nothing."""


@by_forcing(harmonic.pull, several.pull, ramp.pull)
def pull(plan: Vector, table: int, s: float, c: float) -> float:
    """A_t h² as the mode sees it, mirrored or not."""


@by_forcing(harmonic.pull_series, several.pull_series, ramp.pull_series)
def pull_series(plan: Vector, table: int, s: float, c: float, series: Vector) -> None:
    """The long series of that."""


@kernel
def change_rate(plan: Vector) -> float:
    """How fast what shakes the mass changes (1/s), above 0.

    A line of a record limits no step and has no pace, but it ends: motions are judged by this rate.
    """
    rate: float = pace(plan) + 1.0 / plan[par.INTERVAL]
    return rate
