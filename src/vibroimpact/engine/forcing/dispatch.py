"""How a kernel finds the forcing: by the type of its plan, or by the number in it.

A forcing is a linear clock of two numbers (s, c) that goes on by itself, and A_t, the base
acceleration that it stands for, which is linear in them. It is a module with these kernels:

    begin(plan, amplitude, omega)          write AMPLITUDE, OMEGA, MOST, STEEPEST of the plan
    pace(plan)                             its own rate (1/s), which limits a table's step
    count(plan), wave(plan, n, mirrored)   the parts that it is a sum of, n from 1 on
    plane(plan, n)                         how far behind the tables those of part n lie
    value(plan, s, c)                      A_t
    turned(plan, s, c, t)                  the clock after the time t
    stepped(plan, s, c, t)                 the same, fast for a time of a step
    release_time(plan, sign, level, s, c, limit) when sign A_t first exceeds a level

and, from a mode's table,

    product(plan, at, row)                 a linear function of the state row
    expand(plan, at, row, series)          the long series of one
    short_series(plan, table, row)         seven terms of x, from the equation of motion
    turned_clock(plan, at, s, c)           the clock at a node or fine point
    turn(plan, s, c, angle)                the clock a part of a step later
    nudged(plan, s, c, angle)              the same for an angle whose square is nothing
    pull(plan, table, s, c)                A_t h² as the mode sees it, mirrored or not
    pull_series(plan, table, s, c, series) the long series of that

Only what is neither a sum of harmonics of one frequency (`Periodic`), a constant force nor a
`Record` needs another one, and only if its clock does not depend on the motion and restarts each
cycle. It is a file here with these kernels (as `ramp`), in `FORCINGS` and `_by_forcing`; a code
beside RAMP in `parameters`, which `rig_vector` writes; a type of plan in `_ADVANCE`, `_FORCING` and
`_YIELDING` of `flow_dispatch`, which `_flow` there returns; and, unless it is a sum of waves
(`wave`), more columns of the state row (`linear.layout`). In Python: a class in
`model/excitation.py` (periodic: of `Repeated`); its `Drive` in `_drive` of
`response/engine_input.py`; its free response (`response/analytic_free_response.py`) and that of
several masses (`response/assembly_rig.py`); and whatever asks for `isinstance(…, Periodic)`.
"""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Any

from vibroimpact.engine import parameters as par
from vibroimpact.engine.compiler import overload
from vibroimpact.engine.forcing import harmonic, ramp, several
from vibroimpact.engine.jit import CHOSEN, Vector, kernel

FORCINGS: dict[float, ModuleType] = {
    par.HARMONIC: harmonic,
    par.SEVERAL: several,
    par.RAMP: ramp,
}


def _by_forcing(name: str) -> Callable[..., Any]:
    one, many, line = (getattr(module, name) for module in (harmonic, several, ramp))

    def plain(plan: Any, *args: Any) -> Any:
        return getattr(FORCINGS[plan[par.FORCING]], name)(plan, *args)

    def looked_up(plan: Any, *args: Any) -> Any:
        kind = plan[par.FORCING]
        if kind == par.HARMONIC:
            return one(plan, *args)
        if kind == par.RAMP:
            return line(plan, *args)
        return many(plan, *args)

    plain.__name__ = name

    @overload(plain, jit_options=CHOSEN, strict=False)  # type: ignore[arg-type]
    def _chosen(plan: Any, *args: Any) -> Any:
        kind = getattr(plan, "forcing", par.HARMONIC)
        return looked_up if kind is None else getattr(FORCINGS[kind], name).py_func

    return plain


begin = _by_forcing("begin")
pace = _by_forcing("pace")
count = _by_forcing("count")
plane = _by_forcing("plane")
wave = _by_forcing("wave")
value = _by_forcing("value")
turned = _by_forcing("turned")
stepped = _by_forcing("stepped")
release_time = _by_forcing("release_time")
product = _by_forcing("product")
expand = _by_forcing("expand")
short_series = _by_forcing("short_series")
turned_clock = _by_forcing("turned_clock")
turn = _by_forcing("turn")
nudged = _by_forcing("nudged")
pull = _by_forcing("pull")
pull_series = _by_forcing("pull_series")


@kernel
def change_rate(plan: Vector) -> float:
    """How fast what shakes the mass changes (1/s), above 0.

    A line of a record limits no step and has no pace, but it ends: motions are judged by this rate.
    """
    rate: float = pace(plan) + 1.0 / plan[par.INTERVAL]
    return rate
